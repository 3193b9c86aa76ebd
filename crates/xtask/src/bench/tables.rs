//! Tables of what was measured, in Markdown.

use std::fmt::Write;

use super::matched::{Matched, time_at};
use super::work_precision::{Measured, Row, Setting};

/// The errors at which times are compared.
pub(crate) const TARGETS: [f64; 3] = [1e-4, 1e-5, 1e-6];

/// Section of a case: its description, times at equal errors, a picture where there is one, and all
/// rows.
pub(crate) fn section(measured: &Measured, picture: &str) -> String {
    let case = &measured.case;
    let mut text = format!(
        "## {} (`{}`)\n\n{} Error: {}. Reference: {}.\n\n",
        case.title, case.name, case.description, case.quantity, measured.source
    );
    text += &at_equal_errors(measured);
    text += "\n";
    text += picture;
    text += "| integrator | ERROR or steps | error | CPU ms | wall ms | steps | rejected | failed | \
             factorisations | residuals |\n|---|---|---|---|---|---|---|---|---|---|\n";
    for row in &measured.rows {
        text += &line(row);
    }
    text + "\n"
}

/// Names of the integrators and peers in the order of the rows.
pub(crate) fn names(rows: &[Row]) -> Vec<&'static str> {
    let mut names: Vec<&str> = rows.iter().map(|row| row.name).collect();
    names.dedup();
    names
}

fn line(row: &Row) -> String {
    let setting = match row.setting {
        Setting::Error(error) => format!("{error:.0e}"),
        Setting::Steps(steps) => format!("{steps} steps"),
    };
    let name = row.name;
    let outcome = match &row.outcome {
        Err(message) => {
            return format!("| {name} | {setting} | fails: {message} | | | | | | | |\n");
        }
        Ok(outcome) => outcome,
    };
    let mut line = format!(
        "| {name} | {setting} | {:.1e} | {} | {} |",
        outcome.error,
        milliseconds(outcome.times.processor),
        milliseconds(outcome.times.wall)
    );
    match &outcome.statistics {
        None => line += " | | | | |",
        Some(s) => {
            let counts = [
                s.steps.steps,
                s.steps.rejections,
                s.steps.failures,
                s.work.factorisations,
                s.work.residuals,
            ];
            for count in counts {
                let _ = write!(line, " {count} |");
            }
        }
    }
    line + "\n"
}

/// Milliseconds at an error, where it is reached.
pub(crate) fn cell(time: Option<Matched>) -> String {
    match time {
        None => "not reached".to_owned(),
        Some(m) if m.extrapolated => format!("{} (extrapolated)", milliseconds(m.time)),
        Some(m) => milliseconds(m.time),
    }
}

/// Three digits.
fn milliseconds(seconds: f64) -> String {
    let time = 1e3 * seconds;
    match time {
        t if t < 9.995 => format!("{t:.2}"),
        t if t < 99.95 => format!("{t:.1}"),
        t => format!("{t:.0}"),
    }
}

/// CPU milliseconds of all at equal errors.
fn at_equal_errors(measured: &Measured) -> String {
    let heading: Vec<String> = TARGETS.iter().map(|t| format!("at {t:.0e}")).collect();
    let mut text = format!("| CPU ms | {} |\n|---|---|---|---|\n", heading.join(" | "));
    for name in names(&measured.rows) {
        let cells = TARGETS.map(|target| cell(time_at(&measured.rows, name, target)));
        let _ = writeln!(text, "| {name} | {} |", cells.join(" | "));
    }
    text
}
