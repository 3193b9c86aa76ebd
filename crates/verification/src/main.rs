//! Writes `docs/verification.md` from the claims that the test suite makes.
//!
//! `cargo run --release -p verification` runs `cargo test --release --workspace --tests` with the
//! environment variable `STICTION_VERIFICATION` naming a fresh folder, reads the claims that the
//! tests recorded there and writes the page.

#![allow(clippy::print_stdout, reason = "a program says what it did")]

use std::path::Path;
use std::process::{Command, ExitCode};

use verification::{FOLDER, coverage, manual};

fn main() -> ExitCode {
    match generate() {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            println!("{message}");
            ExitCode::FAILURE
        }
    }
}

/// Runs the tests and writes the page.
fn generate() -> Result<(), String> {
    let root = Path::new(env!("CARGO_MANIFEST_DIR")).join("../..");
    if reference_data::path("validation/data").is_none() {
        return Err("without the reference data the manual stays as it is".into());
    }
    let folder = std::env::temp_dir().join(format!("stiction-verification-{}", std::process::id()));
    let message = |error: std::io::Error| format!("{}: {error}", folder.display());
    std::fs::create_dir_all(&folder).map_err(message)?;
    let cargo = std::env::var_os("CARGO").unwrap_or("cargo".into());
    let tests = Command::new(cargo)
        .args([
            "test",
            "--release",
            "--workspace",
            "--tests",
            "--no-fail-fast",
        ])
        .current_dir(&root)
        .env(FOLDER, &folder)
        .status()
        .map_err(|error| format!("cargo: {error}"))?;
    let claims = manual::read(&folder)?;
    std::fs::remove_dir_all(&folder).map_err(message)?;
    let path = root.join("docs/verification.md");
    std::fs::write(&path, manual::page(&claims))
        .map_err(|error| format!("{}: {error}", path.display()))?;
    println!("{} claims in docs/verification.md", claims.len());
    if !tests.success() {
        return Err("tests failed: the page is not complete".into());
    }
    let covered: Vec<_> = claims.into_iter().flat_map(|r| r.claim.covers).collect();
    let missing = coverage::missing(&covered);
    if missing.is_empty() {
        return Ok(());
    }
    Err(format!("no claim covers {missing:#?}"))
}
