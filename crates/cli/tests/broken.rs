//! Models that are wrong, as people write them, and what `stiction check` says of each.
//!
//! Beside each file in `tests/broken` stands the text that a person sees, with the exit code. With
//! the environment variable `STICTION_UPDATE_BROKEN` set the texts are written anew; read the
//! difference before it is committed: does each message tell what to write instead?

use std::path::{Path, PathBuf};
use std::process::Command;

fn folder() -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR")).join("tests/broken")
}

/// What a person sees.
fn seen(file: &str) -> String {
    let output = Command::new(env!("CARGO_BIN_EXE_stiction"))
        .args(["check", file])
        .current_dir(folder())
        .output()
        .unwrap();
    let code = output.status.code().unwrap();
    let said =
        String::from_utf8(output.stdout).unwrap() + &String::from_utf8(output.stderr).unwrap();
    format!("$ stiction check {file}\n{said}[{code}]\n")
}

#[test]
fn every_broken_model_gets_its_text() {
    let update = std::env::var_os("STICTION_UPDATE_BROKEN").is_some();
    let mut files: Vec<String> = std::fs::read_dir(folder())
        .unwrap()
        .map(|entry| entry.unwrap().file_name().to_string_lossy().into_owned())
        .filter(|name| name.ends_with(".adm") || name.ends_with(".acf"))
        .collect();
    files.sort();
    assert!(files.len() >= 10, "models are lost: {files:?}");
    let mut wrong = String::new();
    for file in &files {
        let (found, path) = (seen(file), folder().join(format!("{file}.txt")));
        if update {
            std::fs::write(&path, &found).unwrap();
            continue;
        }
        let expected = std::fs::read_to_string(&path).unwrap_or_default();
        if found != expected {
            wrong += &format!("expected\n{expected}\nfound\n{found}\n");
        }
    }
    assert!(wrong.is_empty(), "{wrong}");
}
