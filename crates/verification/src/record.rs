//! The one way for tests to make claims: printed, recorded and checked.

#![allow(clippy::print_stdout, reason = "the claims are what the tests show")]

use std::io::Write;
use std::path::{Path, PathBuf};

use serde_json::{Value, json};

use crate::claim::{Claim, Rule, Section};
use crate::coverage::Cell;
use crate::number;

/// Environment variable that names the folder where claims are recorded.
pub const FOLDER: &str = "STICTION_VERIFICATION";

/// Prints and records the claims.
///
/// # Panics
/// When one does not hold, after all have been printed and recorded, and where the folder that
/// [`FOLDER`] names cannot be written.
pub fn check(claims: &[Claim]) {
    for claim in claims {
        println!("{}", line(claim));
        if let Some(folder) = std::env::var_os(FOLDER) {
            append(Path::new(&folder), &to_json(claim, &test_name()));
        }
    }
    let failed: Vec<String> = claims
        .iter()
        .filter(|claim| !claim.holds())
        .map(|claim| format!("{}: {}", claim.id, claim.quantity))
        .collect();
    assert!(failed.is_empty(), "claims that do not hold: {failed:#?}");
}

fn line(claim: &Claim) -> String {
    let errors = number::list(&claim.errors, number::error);
    let mark = if claim.holds() { "" } else { "  <-- fails" };
    let rule = match claim.rule {
        Rule::Below(bound) | Rule::Falling(bound) => format!("at most {bound:e}"),
        Rule::Order(_) | Rule::AtLeastOrder(_) => {
            format!("orders {}", number::list(&claim.orders(), number::order))
        }
    };
    format!(
        "{:<12} {:<44} {errors:<38} {rule}{mark}",
        claim.id, claim.quantity
    )
}

/// Package, test binary and name of the running test, as `cargo test` calls them.
fn test_name() -> String {
    let package = std::env::var("CARGO_PKG_NAME").unwrap_or_default();
    let thread = std::thread::current();
    let name = thread.name().unwrap_or("main");
    format!("{package}/{}: {name}", binary())
}

/// Name of the test binary without the hash that Cargo appends.
fn binary() -> String {
    let path = std::env::current_exe().unwrap_or_default();
    let stem = path.file_stem().unwrap_or_default().to_string_lossy();
    stem.rsplit_once('-')
        .map_or(stem.to_string(), |(name, _)| name.to_string())
}

/// Appends to the file of this process: tests of one binary share it, each line is one write.
fn append(folder: &Path, claim: &Value) {
    let path: PathBuf = folder.join(format!("{}-{}.jsonl", binary(), std::process::id()));
    let file = std::fs::OpenOptions::new()
        .create(true)
        .append(true)
        .open(&path);
    let written = file.and_then(|mut file| file.write_all(format!("{claim}\n").as_bytes()));
    written.unwrap_or_else(|error| panic!("{}: {error}", path.display()));
}

fn to_json(claim: &Claim, test: &str) -> Value {
    let (rule, bound) = match claim.rule {
        Rule::Below(bound) => ("below", bound),
        Rule::Order(order) => ("order", order),
        Rule::AtLeastOrder(order) => ("at least order", order),
        Rule::Falling(bound) => ("falling", bound),
    };
    let covers = claim
        .covers
        .iter()
        .map(|cell| json!([cell.formulation, cell.argument, cell.joint]));
    json!({
        "section": claim.section.title(),
        "id": claim.id,
        "model": claim.model,
        "quantity": claim.quantity,
        "source": claim.source,
        "reference": claim.reference,
        "ours": claim.ours,
        "errors": claim.errors,
        "rule": rule,
        "bound": bound,
        "why": claim.why,
        "covers": covers.collect::<Vec<_>>(),
        "test": test,
    })
}

/// A recorded claim with the name of its test, or what is wrong with the line.
///
/// # Errors
/// A message where the line is not one that [`check`] wrote.
pub(crate) fn from_json(line: &str) -> Result<(String, Claim), String> {
    let value: Value = serde_json::from_str(line).map_err(|error| error.to_string())?;
    let text = |key: &str| {
        let text = value[key].as_str().map(str::to_string);
        text.ok_or_else(|| format!("no text {key} in {line}"))
    };
    // JSON has no NaN: it is written as null.
    let numbers = |key: &str| -> Vec<f64> {
        let list = value[key].as_array().into_iter().flatten();
        list.map(|x| x.as_f64().unwrap_or(f64::NAN)).collect()
    };
    let bound = value["bound"].as_f64().unwrap_or(f64::NAN);
    let rule = match text("rule")?.as_str() {
        "below" => Rule::Below(bound),
        "order" => Rule::Order(bound),
        "at least order" => Rule::AtLeastOrder(bound),
        "falling" => Rule::Falling(bound),
        other => return Err(format!("no rule {other}")),
    };
    let title = text("section")?;
    let section = Section::ALL.into_iter().find(|s| s.title() == title);
    let covers = value["covers"].as_array().into_iter().flatten();
    let word = |cell: &Value, k: usize| cell[k].as_str().unwrap_or_default().to_string();
    let claim = Claim {
        section: section.ok_or_else(|| format!("no section {title}"))?,
        id: text("id")?,
        model: text("model")?,
        quantity: text("quantity")?,
        source: text("source")?,
        reference: numbers("reference"),
        ours: numbers("ours"),
        errors: numbers("errors"),
        rule,
        why: text("why")?,
        covers: covers
            .map(|cell| Cell {
                formulation: word(cell, 0),
                argument: word(cell, 1),
                joint: word(cell, 2),
            })
            .collect(),
    };
    Ok((text("test")?, claim))
}

#[cfg(test)]
mod tests {
    use friction::parameters::JointType;

    use super::{from_json, to_json};
    use crate::{Case, Coverage, Formulation, Rule, Section};

    #[test]
    fn a_recorded_claim_is_read_back() {
        let case = Case {
            section: Section::Joint,
            id: "B04a",
            model: "pendulum",
            source: "closed form",
            covers: &[Coverage {
                joint: JointType::Revolute,
                formulation: Formulation::Original,
                arguments: &["PIN_RADIUS"],
            }],
        };
        for claim in [
            case.values("x", &[1.0], &[2.0], 0.5, "why"),
            case.vanishing("x", &[1.0, 0.5], Rule::AtLeastOrder(1.0), "why"),
            case.vanishing("x", &[1.0, 0.1], Rule::Falling(0.2), "why"),
        ] {
            let line = to_json(&claim, "a test").to_string();
            assert_eq!(from_json(&line), Ok(("a test".into(), claim)));
        }
        assert!(from_json("{}").is_err());
    }

    #[test]
    #[should_panic(expected = "is no argument of the statement")]
    fn a_case_cannot_cover_what_the_statement_does_not_have() {
        let coverage = Coverage {
            joint: JointType::Spherical,
            formulation: Formulation::Original,
            arguments: &["PIN_RADIUS"],
        };
        let _ = coverage.cells();
    }
}
