//! Checkpoints: a run in its midst, to go on from bit for bit after it was killed.
//!
//! A checkpoint holds everything that the rest of the run depends on: the place among the commands and
//! within a SIMULATE, the simulation with its integrator ([`mechanics::Paused`]), what the report at the
//! end counts, and how long the result files were. It is written beside them, into another file first
//! that is then renamed, so that there is always a whole one. It serves the build of the program that
//! has written it, for the same files and options. docs/checkpoints.md describes it for users.

use std::collections::HashMap;
use std::io::{self, Write};
use std::path::{Path, PathBuf};
use std::sync::OnceLock;
use std::time::{Duration, Instant};

use mechanics::Paused;
use mechanics::model::Reactions;
use results::Blocks;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::balance::EnergyAccount;
use crate::eigensolution::ModeReport;
use crate::journal::Told;
use crate::lower::{Numbering, Setting};
use crate::project::{Project, hexadecimal};
use crate::reactions;
use crate::report::Counted;
use crate::runner::Recorded;
use crate::saved_system::SavedSystem;
use crate::sensors::Held;
use crate::session::{FailedCommand, OutputError, RunOptions};
use crate::whole_file::write_whole;

/// How files of this and all formats begin.
const FORMAT: &str = "stiction checkpoint, format 1";
const ANY_FORMAT: &str = "stiction checkpoint, format ";

/// A run in its midst.
#[derive(Serialize, Deserialize)]
pub(crate) struct Checkpoint<'a> {
    pub(crate) job: Job,
    /// Place of the next command, or of the one under way.
    pub(crate) command: usize,
    pub(crate) under_way: Option<UnderWay>,
    pub(crate) progress: RunProgress,
    pub(crate) simulation: Paused<'a>,
}

/// What a run is told to do.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Job {
    /// Names of the files read and checksums of their texts.
    files: Vec<(String, String)>,
    /// Changes before the run.
    changes: Vec<String>,
    commands: Vec<String>,
    error: Option<f64>,
    /// Name of the method of integration.
    integrator: Option<String>,
    reactions: Reactions,
}

/// A simulation that is not at its end.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct UnderWay {
    /// Time at which it began.
    pub(crate) start: f64,
    /// Whether a sequence of equilibria has one at that time.
    pub(crate) with_start: bool,
    /// Number of its outputs that are written.
    pub(crate) taken: usize,
    /// Time from which the next row of the integrator's table is due.
    pub(crate) next_row: f64,
    pub(crate) sensors: Vec<Held>,
}

/// What a run keeps beside its simulation.
#[derive(Serialize, Deserialize)]
pub(crate) struct RunProgress {
    /// The commands that have changed the model, as a command file.
    pub(crate) changes: String,
    pub(crate) setting: Setting,
    pub(crate) numbering: Numbering,
    pub(crate) buffers: HashMap<String, SavedSystem>,
    pub(crate) assembled: bool,
    pub(crate) recorded: Recorded,
    pub(crate) length: f64,
    pub(crate) simulations: usize,
    pub(crate) failures: Vec<FailedCommand>,
    pub(crate) modes: Vec<ModeReport>,
    pub(crate) resumed: Vec<f64>,
    pub(crate) elapsed: Duration,
    pub(crate) frictions: Vec<Counted>,
    pub(crate) account: EnergyAccount,
    pub(crate) count: usize,
    pub(crate) told: Told,
    pub(crate) files: Marks,
}

/// How far the files of a run are written.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Marks {
    /// Names of `.res` and `.req`.
    pub(crate) names: [String; 2],
    /// Their lengths, and that of the `.msg`, bytes.
    pub(crate) lengths: [u64; 3],
    pub(crate) blocks: Blocks,
    /// Names of the `.msg` and of results that are finished.
    pub(crate) others: Vec<String>,
}

/// Why a run cannot be resumed.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub enum CheckpointError {
    /// There is none.
    #[error(
        "there is no checkpoint; --checkpoint writes them, and a run that has ended leaves none"
    )]
    Missing,
    /// How accurate a run is cannot be told from its midst on.
    #[error(
        "a second run, which tells how accurate a run is, is in no checkpoint; resume without \
         the check of accuracy, or run from the beginning"
    )]
    CheckedAccuracy,
    /// It cannot be read.
    #[error("it cannot be read: {0}")]
    Unreadable(String),
    /// It is something else.
    #[error("it is not a checkpoint")]
    NotACheckpoint,
    /// Another format.
    #[error("its format, `{0}`, is that of another version of stiction")]
    AnotherFormat(String),
    /// The checksum is not that of the contents.
    #[error("its checksum is wrong: it is damaged")]
    Damaged,
    /// Another version or build.
    #[error(
        "it was written by {written}, this is {present}: bits are the same only with the same build"
    )]
    AnotherProgram {
        /// The program that has written it.
        written: String,
        /// This one.
        present: String,
    },
    /// Other files or options.
    #[error("it is of another run: {}", .0.join("; "))]
    AnotherRun(Vec<String>),
    /// A file of results that is not as it was.
    #[error("{file} is {found} bytes long, {expected} were written before the checkpoint")]
    Results {
        /// The file.
        file: String,
        /// Its length now.
        found: u64,
        /// Its length at the checkpoint.
        expected: u64,
    },
}

/// A run that could not be resumed.
#[derive(Debug, thiserror::Error)]
pub enum ResumeError {
    /// The checkpoint does not serve.
    #[error("cannot resume from {path}: {cause}")]
    Refused {
        /// The checkpoint.
        path: String,
        /// Why.
        cause: CheckpointError,
    },
    /// A file cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
}

impl Job {
    pub(crate) fn new(project: &Project, options: &RunOptions) -> Self {
        let sources = project.sources.iter();
        Self {
            files: sources
                .map(|source| {
                    let name = Path::new(source.name()).file_name();
                    let name = name.unwrap_or_default().to_string_lossy().into_owned();
                    (name, checksum(source.text().as_bytes()))
                })
                .collect(),
            changes: project.given_changes.clone(),
            commands: project
                .steps()
                .iter()
                .map(|step| step.command.echo.clone())
                .collect(),
            error: options.error,
            integrator: options.method.map(|method| method.name().to_owned()),
            reactions: options.reactions,
        }
    }

    /// What differs from the job of a checkpoint, in words.
    fn differences(&self, before: &Self) -> Vec<String> {
        let mut found = Vec::new();
        let known = |name: &str| before.files.iter().find(|(file, _)| file == name);
        for (name, sum) in &self.files {
            match known(name) {
                None => found.push(format!("{name} was not part of it")),
                Some((_, other)) if other != sum => found.push(format!("{name} has changed")),
                Some(_) => {}
            }
        }
        for (name, _) in &before.files {
            if !self.files.iter().any(|(file, _)| file == name) {
                found.push(format!("{name} was part of it"));
            }
        }
        let lists = [
            ("--set", &self.changes, &before.changes),
            ("the commands", &self.commands, &before.commands),
        ];
        for (what, now, then) in lists {
            let pairs = now.iter().zip(then.iter());
            let same = pairs.take_while(|(now, then)| now == then).count();
            let at = |list: &[String]| {
                let text = list.get(same);
                text.map_or_else(|| "nothing".to_owned(), |text| format!("`{text}`"))
            };
            if now != then {
                found.push(format!("{what}: {} then, {} now", at(then), at(now)));
            }
        }
        let options = [
            (
                "--error",
                self.error.map(|error| format!("{error:e}")),
                before.error.map(|error| format!("{error:e}")),
            ),
            (
                "--integrator",
                self.integrator.clone(),
                before.integrator.clone(),
            ),
            (
                "--reactions",
                Some(reactions::in_words(self.reactions)),
                Some(reactions::in_words(before.reactions)),
            ),
        ];
        for (option, now, then) in options {
            if now != then {
                let told = |value: Option<String>| value.unwrap_or_else(|| "not given".to_owned());
                found.push(format!("{option}: {} then, {} now", told(then), told(now)));
            }
        }
        found
    }
}

/// The checkpoint file of a run, and when to write it.
pub(crate) struct Keeper {
    path: PathBuf,
    interval: Duration,
    last: Option<Instant>,
    pub(crate) job: Job,
}

impl Keeper {
    pub(crate) fn new(path: PathBuf, interval: Duration, job: Job) -> Self {
        Self {
            path,
            interval,
            last: None,
            job,
        }
    }

    /// Whether it is time to write one.
    pub(crate) fn is_due(&self) -> bool {
        self.last.is_none_or(|last| last.elapsed() >= self.interval)
    }

    /// Writes one, whole or not at all.
    pub(crate) fn write(&mut self, checkpoint: &Checkpoint<'_>) -> Result<(), OutputError> {
        let text = postcard::to_stdvec(checkpoint).map_err(io::Error::other);
        let written = text.and_then(|body| self.replace(&body));
        written.map_err(|error| OutputError::at(&self.path, &error))?;
        self.last = Some(Instant::now());
        Ok(())
    }

    fn replace(&self, body: &[u8]) -> io::Result<()> {
        write_whole(&self.path, |part| {
            let mut file = std::fs::File::create(part)?;
            let head = format!("{FORMAT}\n{}\nsha256 {}\n", program(), checksum(body));
            file.write_all(head.as_bytes())?;
            file.write_all(body)?;
            file.sync_data()
        })
    }

    /// Removes the file: the run has ended.
    pub(crate) fn remove(&self) {
        let _ = std::fs::remove_file(&self.path);
    }
}

impl Checkpoint<'_> {
    /// The file of a run with this prefix.
    pub(crate) fn path(folder: &Path, prefix: &str) -> PathBuf {
        folder.join(format!("{prefix}.checkpoint"))
    }

    /// Reads a file, which must be one of `job`.
    pub(crate) fn read(path: &Path, job: &Job) -> Result<Checkpoint<'static>, CheckpointError> {
        use CheckpointError as E;
        let bytes = std::fs::read(path).map_err(|error| match error.kind() {
            io::ErrorKind::NotFound => E::Missing,
            _ => E::Unreadable(error.to_string()),
        })?;
        let (format, rest) = line(&bytes).ok_or(E::NotACheckpoint)?;
        if format != FORMAT {
            let other = format.strip_prefix(ANY_FORMAT).ok_or(E::NotACheckpoint)?;
            return Err(E::AnotherFormat(other.to_owned()));
        }
        let (written, rest) = line(rest).ok_or(E::Damaged)?;
        let (sum, body) = line(rest).ok_or(E::Damaged)?;
        if sum.strip_prefix("sha256 ") != Some(&checksum(body)) {
            return Err(E::Damaged);
        }
        if written != program() {
            return Err(E::AnotherProgram {
                written: written.to_owned(),
                present: program().to_owned(),
            });
        }
        let checkpoint: Checkpoint<'static> = postcard::from_bytes(body).map_err(|_| E::Damaged)?;
        let differences = job.differences(&checkpoint.job);
        if differences.is_empty() {
            Ok(checkpoint)
        } else {
            Err(E::AnotherRun(differences))
        }
    }
}

/// The first line, without its end, and the rest.
fn line(bytes: &[u8]) -> Option<(&str, &[u8])> {
    let end = bytes.iter().take(1000).position(|byte| *byte == b'\n')?;
    let text = std::str::from_utf8(&bytes[..end]).ok()?;
    Some((text, &bytes[end + 1..]))
}

/// Version and build of the program, of which the same bits can be expected.
fn program() -> &'static str {
    static PROGRAM: OnceLock<String> = OnceLock::new();
    PROGRAM.get_or_init(|| {
        let build = std::env::current_exe().and_then(std::fs::read);
        let build = build.map_or_else(|_| "unknown".to_owned(), |file| checksum(&file));
        format!("stiction {} build {build}", env!("CARGO_PKG_VERSION"))
    })
}

fn checksum(bytes: &[u8]) -> String {
    hexadecimal(&Sha256::digest(bytes))
}
