//! The commands of the benchmarks come to their end and say what they measured.

use std::process::Command;

/// Standard output of a command that succeeds.
fn output(arguments: &[&str]) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_xtask"))
        .args(arguments)
        .output()
        .expect("the command starts");
    let said = String::from_utf8_lossy(&output.stdout).into_owned();
    assert!(output.status.success(), "{said}");
    said
}

/// The number in a column of the row that begins with `row`.
fn number(page: &str, row: &str, column: usize) -> f64 {
    let line = page.lines().find(|line| line.starts_with(row));
    let line = line.unwrap_or_else(|| panic!("no row {row} in\n{page}"));
    let cell = line.split('|').nth(column).expect("the column");
    cell.trim().parse().unwrap_or_else(|_| panic!("{line}"))
}

/// Tables with errors that are errors, a page and a picture for every case.
#[test]
fn a_quick_run_writes_page_and_pictures() {
    let folder = std::env::temp_dir().join(format!("stiction-bench-test-{}", std::process::id()));
    let place = folder.to_str().expect("a path of text");
    let cases = ["andrews", "four-bar-2", "delta", "stick-slip"];
    let mut arguments = vec!["bench", "--quick", "--no-peers", "--output", place];
    arguments.extend(cases);
    let said = output(&arguments);
    let page = std::fs::read_to_string(folder.join("performance.md")).expect("the page");
    // An error of 1e-4 a step leaves this much of Andrews' mechanism at most, of 34 rad in all.
    assert!(number(&said, "| GSTIFF, SI2 | 1e-4", 3) < 0.5, "{said}");
    for case in cases {
        assert!(page.contains(&format!("(`{case}`)")), "{page}");
        let picture = format!("pictures/performance-{case}.svg");
        assert!(page.contains(&picture), "{page}");
        let picture = std::fs::read_to_string(folder.join(picture)).expect("a picture");
        assert!(picture.contains("GSTIFF, SI2") && picture.contains("processor time"));
    }
    std::fs::remove_dir_all(&folder).expect("the folder goes");
}

/// A row of the table of growth has all its numbers.
#[test]
fn a_chain_is_measured_by_itself() {
    let said = output(&["grow", "braced", "20"]);
    let row: serde_json::Value = serde_json::from_str(&said).expect("JSON");
    // Twenty rods and one strut.
    assert_eq!(row["bodies"], 21);
    assert!(row["matrices"].as_f64() > Some(0.0), "{row}");
    for part in ["assembly", "step", "share"] {
        assert!(row[part].is_number(), "{part}: {row}");
    }
}
