//! Real files: which of them are read without error, and what the others need.

use dataset::{Code, Diagnostic, Severity, Source, read_commands, read_dataset};
use std::collections::BTreeMap;
use std::path::Path;

fn read(path: &Path) -> (Source, Vec<Diagnostic>) {
    let bytes = std::fs::read(path).expect("the file can be read");
    let name = path.file_name().unwrap_or_default().to_string_lossy();
    let source = Source::from_bytes(&name, &bytes).expect("the file is text");
    let diagnostics = match path.extension().and_then(|extension| extension.to_str()) {
        Some("acf") => read_commands(&source).1,
        _ => read_dataset(&source).1,
    };
    (source, diagnostics)
}

fn is_error(diagnostic: &Diagnostic) -> bool {
    diagnostic.severity == Severity::Error
}

#[test]
fn the_models_with_results_of_adams_read_without_error() {
    let Some(folder) = reference_data::path("adams-results") else {
        return;
    };
    let mut failed = Vec::new();
    for path in reference_data::models(&folder) {
        // The real run starts with an equilibrium, which is read like any other analysis.
        let (source, diagnostics) = read(&path);
        let errors = diagnostics.iter().filter(|diagnostic| is_error(diagnostic));
        failed.extend(errors.map(|diagnostic| diagnostic.render(&source)));
    }
    assert!(failed.is_empty(), "{}", failed.concat());
}

/// Names in the corpus that are no part of the language, and why.
const NOT_IN_THE_LANGUAGE: &[(&str, &str)] = &[
    // Samples that test how another reader copes with nonsense.
    ("no statement is called LEONARDO", "a2m sample: made up"),
    ("no statement is called LEOSILVA", "a2m sample: made up"),
    ("no statement is called PIRLA", "a2m sample: made up"),
    ("PART has no argument TUASORELLA", "a2m sample: made up"),
    (
        "PART has no argument X",
        "a2m sample: neither XG nor anything else",
    ),
    (
        "PART has no argument Z",
        "a2m sample: neither ZG nor anything else",
    ),
];

#[test]
fn the_corpus_is_read_and_what_is_missing_is_listed() {
    let Some(folder) = reference_data::path("corpus") else {
        return;
    };
    let mut without_error = 0;
    let mut missing: BTreeMap<String, (usize, usize)> = BTreeMap::new();
    let mut unknown = Vec::new();
    let files = reference_data::models(&folder);
    for path in &files {
        let (source, diagnostics) = read(path);
        let mut in_this_file: BTreeMap<String, usize> = BTreeMap::new();
        for diagnostic in diagnostics.iter().filter(|diagnostic| is_error(diagnostic)) {
            *in_this_file.entry(kind(diagnostic)).or_default() += 1;
            let is_unknown = matches!(
                diagnostic.code,
                Code::UnknownStatement | Code::UnknownArgument | Code::AmbiguousName
            );
            let message = &diagnostic.message;
            let expected = NOT_IN_THE_LANGUAGE
                .iter()
                .any(|(known, _)| known == message);
            if is_unknown && !expected {
                unknown.push(diagnostic.render(&source));
            }
        }
        without_error += usize::from(in_this_file.is_empty());
        for (kind, count) in in_this_file {
            let entry = missing.entry(kind).or_default();
            entry.0 += count;
            entry.1 += 1;
        }
    }
    println!(
        "{without_error} of {} files read without error; the others:",
        files.len()
    );
    for (kind, (count, files)) in missing {
        println!("{count:7} in {files:2} files: {kind}");
    }
    assert!(unknown.is_empty(), "{}", unknown.concat());
}

/// The message of a diagnostic without its numbers, so that the same gaps count together.
fn kind(diagnostic: &Diagnostic) -> String {
    let mut text = format!("[{}] ", diagnostic.code.as_str());
    for character in diagnostic.message.chars() {
        match character {
            '0'..='9' if text.ends_with('#') => {}
            '0'..='9' => text.push('#'),
            other => text.push(other),
        }
    }
    text
}
