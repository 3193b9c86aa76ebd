//! Reference data beside the checkout.
#![allow(clippy::print_stdout, reason = "a skipped test says why")]

use std::path::PathBuf;

/// Path of a file of the reference folder (`STICTION_SHARED`, else `../shared` beside the
/// checkout), or `None` with a printed reason.
pub(crate) fn reference(path: &str) -> Option<PathBuf> {
    let folder = std::env::var_os("STICTION_SHARED").map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared")),
        PathBuf::from,
    );
    let file = folder.join(path);
    if file.is_file() {
        Some(file)
    } else {
        println!("skipped: there is no reference file {path}");
        None
    }
}
