//! The one way to the reference material that is not part of the project.

use std::path::{Path, PathBuf};

/// The folder of reference material: the environment variable `STICTION_SHARED`, else `shared`
/// beside the checkout. Where it is absent, that is printed and the test should end.
pub(crate) fn shared(folder: &str) -> Option<PathBuf> {
    let root = match std::env::var_os("STICTION_SHARED") {
        Some(path) => PathBuf::from(path),
        None => Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared"),
    };
    let path = root.join(folder);
    if path.is_dir() {
        return Some(path);
    }
    println!("skipped: there is no folder shared/{folder} (set STICTION_SHARED)");
    None
}

/// The datasets and command files in a folder and below, in the order of their names.
pub(crate) fn models(folder: &Path) -> Vec<PathBuf> {
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
