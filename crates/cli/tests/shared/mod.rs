//! The program in a folder of its own, driven from outside.

use std::path::{Path, PathBuf};
use std::process::{Command, Output};

/// A fresh folder with these files.
pub(crate) fn folder<B: AsRef<[u8]>>(name: &str, files: &[(&str, B)]) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    let _ = std::fs::remove_dir_all(&folder);
    std::fs::create_dir_all(&folder).unwrap();
    for (file, bytes) in files {
        std::fs::write(folder.join(file), bytes).unwrap();
    }
    folder
}

/// Runs the program there.
pub(crate) fn stiction(folder: &Path, arguments: &[&str]) -> Output {
    Command::new(env!("CARGO_BIN_EXE_stiction"))
        .args(arguments)
        .current_dir(folder)
        .output()
        .unwrap()
}

/// Its exit code.
pub(crate) fn code(output: &Output) -> i32 {
    output.status.code().unwrap()
}

/// What it says on standard error.
pub(crate) fn errors(output: &Output) -> String {
    String::from_utf8_lossy(&output.stderr).into_owned()
}
