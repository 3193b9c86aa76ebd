//! Other programs, each in a Python process that answers to numbers of steps.
//!
//! A script of the folder `peers` reads a number of steps a line, runs its case with as many and
//! writes a line of JSON: `processor` and `wall` time of the solver alone in seconds and the
//! `values` at the end, or the `failure`.

use std::io::{BufRead, BufReader, Write};
use std::path::{Path, PathBuf};
use std::process::{Child, ChildStdin, ChildStdout, Command, Stdio};

use serde::Deserialize;

use super::case::{PeerSetup, Timed};
use super::clock::Times;

/// Variables that hold the libraries of the peers to one thread.
const ONE_THREAD: [&str; 3] = ["OMP_NUM_THREADS", "OPENBLAS_NUM_THREADS", "MKL_NUM_THREADS"];

/// A virtual environment with the peers.
pub(crate) struct Environment {
    folder: PathBuf,
    python: PathBuf,
    scripts: PathBuf,
    /// Names and versions of the peers.
    pub(crate) versions: String,
}

impl Environment {
    /// Makes it in `folder` unless it is there, and installs the peers.
    ///
    /// # Errors
    /// Why it cannot be had: no Python, no network.
    pub(crate) fn prepare(root: &Path, folder: &Path) -> Result<Self, String> {
        let scripts = root.join("crates/xtask/peers");
        let python = folder.join("bin/python");
        if !python.exists() {
            let make = Command::new("python3")
                .args(["-m", "venv"])
                .arg(folder)
                .output();
            said(make, "python3 -m venv")?;
        }
        let install = Command::new(&python)
            .args(["-m", "pip", "install", "--quiet", "--requirement"])
            .arg(scripts.join("requirements.txt"))
            .output();
        said(install, "pip install")?;
        let versions = Command::new(&python)
            .arg(scripts.join("versions.py"))
            .output();
        let versions = said(versions, "versions.py")?;
        Ok(Self {
            folder: folder.to_path_buf(),
            python,
            scripts,
            versions,
        })
    }

    /// Starts a peer's process for a case.
    ///
    /// # Errors
    /// When Python cannot be started.
    pub(crate) fn start(&self, setup: &PeerSetup) -> Result<Peer, String> {
        let mut child = Command::new(&self.python)
            .arg(self.scripts.join(setup.script))
            .args(&setup.arguments)
            .envs(ONE_THREAD.map(|name| (name, "1")))
            // Peers leave logs where they are started.
            .current_dir(&self.folder)
            .stdin(Stdio::piped())
            .stdout(Stdio::piped())
            .stderr(Stdio::null())
            .spawn()
            .map_err(|error| format!("{}: {error}", setup.script))?;
        let (Some(input), Some(output)) = (child.stdin.take(), child.stdout.take()) else {
            return Err(format!("{}: no pipes", setup.script));
        };
        Ok(Peer {
            child,
            input,
            output: BufReader::new(output),
        })
    }
}

/// What a program wrote, or why it failed.
fn said(output: std::io::Result<std::process::Output>, what: &str) -> Result<String, String> {
    let output = output.map_err(|error| format!("{what}: {error}"))?;
    if output.status.success() {
        return Ok(String::from_utf8_lossy(&output.stdout).trim().to_owned());
    }
    let error = String::from_utf8_lossy(&output.stderr);
    let last = error.lines().last().unwrap_or("failed").to_owned();
    Err(format!("{what}: {last}"))
}

/// A peer's process.
pub(crate) struct Peer {
    child: Child,
    input: ChildStdin,
    output: BufReader<ChildStdout>,
}

#[derive(Deserialize)]
#[serde(untagged)]
enum Answer {
    Done {
        processor: f64,
        wall: f64,
        values: Vec<f64>,
    },
    Failed {
        failure: String,
    },
}

impl Peer {
    /// Runs the case with so many steps.
    ///
    /// # Errors
    /// What the peer says of its failure.
    pub(crate) fn run(&mut self, steps: u32) -> Result<Timed, String> {
        let ask = |error: std::io::Error| format!("the peer ended: {error}");
        writeln!(self.input, "{steps}").map_err(ask)?;
        self.input.flush().map_err(ask)?;
        let mut line = String::new();
        self.output.read_line(&mut line).map_err(ask)?;
        let answer = serde_json::from_str(&line);
        match answer.map_err(|_| format!("the peer ended, saying {line:?}"))? {
            Answer::Failed { failure } => Err(failure),
            Answer::Done {
                processor,
                wall,
                values,
            } => Ok(Timed {
                times: Times { processor, wall },
                values,
                statistics: None,
            }),
        }
    }
}

impl Drop for Peer {
    fn drop(&mut self) {
        // It waits for a number of steps: there is nothing to lose, and no one to tell of a failure.
        let _ = self.child.kill();
        let _ = self.child.wait();
    }
}
