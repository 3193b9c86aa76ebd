//! `stiction sweep`.

use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::sync::Arc;
use std::sync::atomic::AtomicBool;
use std::time::Instant;

use clap::ValueEnum;
use studies::{Record, StudyFile, Until};

use crate::arguments::SweepArguments;
use crate::exit::{Exit, complain, say};
use crate::progress::Monitor;

/// Runs a study here or on a cluster.
pub(crate) fn sweep(arguments: &SweepArguments) -> Exit {
    let folder = folder(arguments);
    match &arguments.cluster {
        Some(address) => on_cluster(arguments, &folder, address),
        None => here(arguments, &folder),
    }
}

fn usage(text: &str) -> Exit {
    complain(&format!("error: {text}\n"));
    Exit::Usage
}

fn folder(arguments: &SweepArguments) -> PathBuf {
    let stem = arguments.study.file_stem().unwrap_or_default();
    let default = || PathBuf::from(format!("{}-study", stem.to_string_lossy()));
    arguments.output.clone().unwrap_or_else(default)
}

fn here(arguments: &SweepArguments, folder: &Path) -> Exit {
    let started = Instant::now();
    let file = match StudyFile::read(&arguments.study) {
        Ok(file) => file,
        Err(error) => {
            complain(&error.to_string());
            return Exit::Input;
        }
    };
    file.warnings
        .iter()
        .for_each(|warning| complain(&warning.to_string()));
    let study = Arc::new(file.study);
    let mut record = match Record::open(Arc::clone(&study), folder, arguments.resume) {
        Ok(record) => record,
        Err(error) => return usage(&error.to_string()),
    };
    let mut monitor = Monitor::new(arguments.progress);
    let cores = || std::thread::available_parallelism().map_or(1, usize::from);
    let workers = arguments
        .workers
        .map_or_else(cores, |workers| workers as usize);
    let evaluate = |case: usize, scratch: &Path, stopped: &AtomicBool| {
        let ran = study.run(case, scratch, &mut Until(stopped), None)?;
        Ok(ran.map(|(row, _)| row))
    };
    let mut told = |record: &Record| {
        let (done, failed) = record.counts();
        monitor.cases(done, failed, study.cases())
    };
    let ran = studies::run(&mut record, workers, &evaluate, &mut told);
    told(&record);
    monitor.finish();
    match ran {
        Err(error) => usage(&format!("{error}; --resume goes on from here")),
        Ok(whole) => {
            say(&record.summary(folder, started.elapsed().as_secs_f64()));
            if whole {
                Exit::Success
            } else {
                Exit::Interrupted
            }
        }
    }
}

/// The package of Python knows how to talk with Dask.
fn on_cluster(arguments: &SweepArguments, folder: &Path, address: &str) -> Exit {
    let python = || Command::new("python3");
    let known = python()
        .args(["-c", "import stiction.cluster"])
        .stderr(Stdio::null())
        .status();
    match known {
        Ok(status) if status.success() => {}
        Ok(_) => {
            return usage(
                "--cluster needs the Python package with its extra for Dask, which python3 does not \
                 find; install it with pip install 'stiction[dask]'",
            );
        }
        Err(error) => {
            return usage(&format!(
                "--cluster needs python3, which does not start: {error}"
            ));
        }
    }
    let mut command = python();
    command
        .args(["-m", "stiction", "sweep"])
        .arg(&arguments.study)
        .arg("-o")
        .arg(folder);
    command.args(["--cluster", address]);
    if arguments.resume {
        command.arg("--resume");
    }
    if let Some(kind) = arguments.progress.to_possible_value() {
        command.args(["--progress", kind.get_name()]);
    }
    // Ctrl-C reaches Python as well, which ends the study; this program waits for that.
    let waits = ctrlc::set_handler(|| {});
    if let Err(error) = waits {
        complain(&format!(
            "warning: Ctrl-C will not be waited for: {error}\n"
        ));
    }
    match command.status() {
        Ok(status) => Exit::of_code(status.code().unwrap_or(1)),
        Err(error) => usage(&format!("python3 does not start: {error}")),
    }
}
