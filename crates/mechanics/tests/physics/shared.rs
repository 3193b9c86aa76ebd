//! Numbers of the reference data.

use std::path::PathBuf;

use serde_json::Value;

/// A JSON file of the reference data, or `None` with a printed reason.
pub(crate) fn reference(path: &str) -> Option<Value> {
    let file = reference_data::path(path)?;
    let text = std::fs::read_to_string(file).expect("reference files are text");
    Some(serde_json::from_str(&text).expect("reference files are JSON"))
}

/// A number of a reference file, given by its JSON pointer.
pub(crate) fn number(value: &Value, pointer: &str) -> f64 {
    let found = value
        .pointer(pointer)
        .unwrap_or_else(|| panic!("no {pointer} in the file"));
    // Some inputs of the reference files are written as text.
    let text = || found.as_str().and_then(|text| text.parse().ok());
    found
        .as_f64()
        .or_else(text)
        .unwrap_or_else(|| panic!("{pointer} is no number"))
}

/// A list of numbers of a reference file.
pub(crate) fn numbers(value: &Value, pointer: &str) -> Vec<f64> {
    let list = value.pointer(pointer).and_then(Value::as_array);
    let list = list.unwrap_or_else(|| panic!("no list {pointer} in the file"));
    list.iter()
        .map(|entry| entry.as_f64().expect("a number"))
        .collect()
}

/// Rows of numbers of a comma-separated file, without its heading.
pub(crate) fn table(path: PathBuf) -> Vec<Vec<f64>> {
    let text = std::fs::read_to_string(path).expect("reference files are text");
    let row = |line: &str| {
        line.split(',')
            .map(|x| x.parse().expect("a number"))
            .collect()
    };
    text.lines().skip(1).map(row).collect()
}
