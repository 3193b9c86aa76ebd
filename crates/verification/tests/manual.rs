//! The manual in the repository: it covers every argument that the statement allows.
//!
//! While the manual is made, the one in the repository is of the past and not looked at.

use verification::{FOLDER, coverage, manual};

const PATH: &str = concat!(env!("CARGO_MANIFEST_DIR"), "/../../docs/verification.md");

fn page() -> Option<String> {
    if std::env::var_os(FOLDER).is_some() {
        return None;
    }
    Some(std::fs::read_to_string(PATH).expect("the manual is part of the repository"))
}

#[test]
fn every_argument_is_verified_in_every_joint_and_formulation() {
    let Some(page) = page() else { return };
    let cells = manual::cells_of(&page);
    let empty: Vec<_> = coverage::all()
        .into_iter()
        .filter(|cell| cells.get(cell).is_none_or(|text| text == manual::EMPTY))
        .collect();
    assert!(empty.is_empty(), "no claim covers {empty:#?}");
    // And nothing that the statement does not have.
    assert_eq!(cells.len(), coverage::all().len());
}

#[test]
fn every_claim_holds() {
    let Some(page) = page() else { return };
    assert!(page.contains("## Summary"));
    assert!(!page.contains(manual::FAILS), "a claim of the manual fails");
}
