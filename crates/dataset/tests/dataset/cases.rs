//! Malformed files and the exact messages they get, as documents in `tests/cases`.
//!
//! A case is a heading, a block `adm`, `acf` or `change` with the text, and a block `diagnostics`
//! with what is rendered. With the environment variable `STICTION_UPDATE_CASES` set the second
//! blocks are rewritten; read the difference before it is committed.

use dataset::{Source, parse_change, read_commands, read_dataset};
use std::path::{Path, PathBuf};

fn files() -> Vec<PathBuf> {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/cases");
    let entries = std::fs::read_dir(folder).expect("the folder of cases can be read");
    let mut files: Vec<PathBuf> = entries
        .map(|entry| entry.expect("the entry can be read").path())
        .collect();
    files.sort();
    files
}

/// What is rendered for a text in a language.
fn rendered(language: &str, text: &str) -> String {
    let source = Source::from_text(&format!("case.{language}"), text.to_string());
    let diagnostics = match language {
        "acf" => read_commands(&source).1,
        "change" => parse_change(&source).1,
        _ => read_dataset(&source).1,
    };
    let rendered = diagnostics
        .iter()
        .map(|diagnostic| diagnostic.render(&source));
    rendered.collect()
}

#[test]
fn every_malformed_file_gets_its_messages() {
    let update = std::env::var_os("STICTION_UPDATE_CASES").is_some();
    let mut cases = 0;
    let mut wrong = String::new();
    for path in files() {
        let document = std::fs::read_to_string(&path).expect("the file can be read");
        let mut out = String::new();
        let mut heading = "";
        let mut expected: Option<String> = None;
        let mut lines = document.lines();
        while let Some(line) = lines.next() {
            out.push_str(line);
            out.push('\n');
            heading = line.strip_prefix("## ").unwrap_or(heading);
            let Some(language) = line.strip_prefix("```") else {
                continue;
            };
            let block: Vec<&str> = lines.by_ref().take_while(|line| *line != "```").collect();
            let text = block.join("\n") + "\n";
            if language == "diagnostics" {
                let found = expected
                    .take()
                    .expect("a text comes before its diagnostics");
                assert!(!found.is_empty(), "{heading}: no diagnostics");
                if found != text {
                    wrong += &format!("## {heading}\nexpected\n{text}found\n{found}\n");
                }
                out += &found;
                cases += 1;
            } else {
                expected = Some(rendered(language, &text));
                out += &text;
            }
            out.push_str("```\n");
        }
        assert!(expected.is_none(), "{heading}: the diagnostics are missing");
        if update {
            std::fs::write(&path, out).expect("the file can be written");
        }
    }
    println!("{cases} cases");
    assert!(update || wrong.is_empty(), "{wrong}");
    assert!(cases >= 45, "cases are lost: only {cases} were found");
}

#[test]
fn a_binary_file_is_refused() {
    let bytes: Vec<u8> = (0..=255).cycle().take(4096).collect();
    let diagnostic = Source::from_bytes("model.adm", &bytes).expect_err("not text");
    assert_eq!(diagnostic.code.as_str(), "not-text");
}
