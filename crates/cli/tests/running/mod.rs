//! The program while it runs.
#![cfg(unix)]

use std::io::{BufRead, BufReader, Read};
use std::path::Path;
use std::process::{Child, ChildStderr, Command, Output, Stdio};

/// The program on its way.
pub(crate) struct Running {
    pub(crate) child: Child,
    /// Its first line of progress.
    pub(crate) line: String,
    progress: BufReader<ChildStderr>,
}

impl Running {
    /// Starts it there and waits for the first line of progress, behind the warnings about the model.
    pub(crate) fn start(folder: &Path, arguments: &[&str]) -> Self {
        let mut child = Command::new(env!("CARGO_BIN_EXE_stiction"))
            .args(arguments)
            .args(["--progress", "json"])
            .current_dir(folder)
            .stdout(Stdio::piped())
            .stderr(Stdio::piped())
            .spawn()
            .unwrap();
        let mut progress = BufReader::new(child.stderr.take().unwrap());
        let mut line = String::new();
        while !line.starts_with('{') {
            line.clear();
            assert!(progress.read_line(&mut line).unwrap() > 0, "no progress");
        }
        Self {
            child,
            line,
            progress,
        }
    }

    /// Sends it Ctrl-C and waits for its end.
    pub(crate) fn interrupt(mut self) -> Output {
        let sent = Command::new("kill")
            .args(["-INT", &self.child.id().to_string()])
            .status()
            .unwrap();
        assert!(sent.success());
        // Keep reading, so that the program is not held up by a full pipe.
        self.progress.read_to_string(&mut self.line).unwrap();
        self.child.wait_with_output().unwrap()
    }
}
