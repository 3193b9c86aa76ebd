//! The one way for tests and benchmarks to the reference data, which are not part of the project.

#![allow(clippy::print_stdout, reason = "a skipped test says why")]

use std::path::{Path, PathBuf};

/// Path of a file or folder of the reference folder, or `None` with a printed reason where it is
/// absent; the test should end then.
///
/// The reference folder is the one that the environment variable `STICTION_SHARED` names, else
/// `../shared` beside the checkout.
///
/// ```
/// let path = reference_data::path("adams-results/no-such-file");
/// assert_eq!(path, None);
/// ```
#[must_use]
pub fn path(relative: &str) -> Option<PathBuf> {
    let folder = std::env::var_os("STICTION_SHARED").map_or_else(
        || Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared"),
        PathBuf::from,
    );
    let path = folder.join(relative);
    if path.exists() {
        return Some(path);
    }
    println!("skipped: there is no reference data {relative} (set STICTION_SHARED)");
    None
}

/// The datasets and command files in a folder and below, in the order of their names.
///
/// # Panics
/// If the folder cannot be read.
#[must_use]
pub fn models(folder: &Path) -> Vec<PathBuf> {
    let mut folders = vec![folder.to_path_buf()];
    let mut files = Vec::new();
    while let Some(folder) = folders.pop() {
        for entry in std::fs::read_dir(&folder).expect("the folder can be read") {
            let path = entry.expect("the entry can be read").path();
            let extension = path.extension().and_then(|extension| extension.to_str());
            match extension {
                _ if path.is_dir() => folders.push(path),
                Some("adm" | "acf") => files.push(path),
                _ => {}
            }
        }
    }
    files.sort();
    files
}
