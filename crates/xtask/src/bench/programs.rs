//! Whole runs of the program, as its users start them.

use std::fmt::Write;
use std::path::{Path, PathBuf};
use std::process::{Command, Stdio};
use std::time::Instant;

/// Runs whose median is taken.
const RUNS: usize = 15;

/// A run of the program and what it may take.
struct Run {
    what: &'static str,
    model: PathBuf,
    arguments: &'static [&'static str],
    /// Milliseconds that are aimed at, if any are.
    most: Option<f64>,
}

/// The runs; the replay of a real robot only where its data are.
fn runs(root: &Path) -> Vec<Run> {
    let pendulum = root.join("examples/pendulum/pendulum.adm");
    let mut runs = vec![
        Run {
            what: "start: the pendulum of the examples, one step of 1e-6 s",
            model: pendulum.clone(),
            arguments: &["--end", "1e-6", "--steps", "1"],
            most: Some(10.0),
        },
        Run {
            what: "small model: the same, 2 s with 100 rows of results",
            model: pendulum,
            arguments: &["--end", "2", "--steps", "100"],
            most: Some(50.0),
        },
    ];
    let replay = "adams-results/delta-robot-friction/delta_robot_replay.acf";
    if let Some(model) = reference_data::path(replay) {
        runs.push(Run {
            what: "replay of a real delta robot: twelve frictions, 1 s, 200 restarts, ERROR = 1e-4, unchecked",
            model: model.clone(),
            arguments: &["--error", "1e-4", "--unchecked"],
            most: Some(150.0),
        });
        runs.push(Run {
            what: "the same with the second run that tells how accurate it is",
            model,
            arguments: &["--error", "1e-4"],
            most: None,
        });
    }
    runs
}

/// The section of the page.
///
/// # Errors
/// When the program cannot be built or a run fails.
pub(crate) fn section(root: &Path, quick: bool) -> Result<String, String> {
    let program = build(root)?;
    let mut text =
        "## Whole runs of the program\n\nWall time from start to exit, all results written, with the second run \
         (docs/accuracy.md) in a thread of its own where it is not said to be unchecked.\n\n\
                    | run | median, ms | least, ms | aimed at | |\n|---|---|---|---|---|\n"
            .to_owned();
    for run in runs(root) {
        let times = wall_times(&program, &run, if quick { 1 } else { RUNS })?;
        let (median, least) = (1e3 * times[times.len() / 2], 1e3 * times[0]);
        let (aim, verdict) = match run.most {
            Some(most) if median <= most => (most.to_string(), "met"),
            Some(most) => (most.to_string(), "**short**"),
            None => ("".to_owned(), ""),
        };
        let what = run.what;
        let _ = writeln!(
            text,
            "| {what} | {median:.1} | {least:.1} | {aim} | {verdict} |"
        );
    }
    Ok(text + "\n")
}

/// Builds the program as it is released; returns where it is.
fn build(root: &Path) -> Result<PathBuf, String> {
    let cargo = std::env::var_os("CARGO").unwrap_or_else(|| "cargo".into());
    let mut command = Command::new(cargo);
    command.current_dir(root);
    command.args(["build", "--release", "--quiet", "--package", "stiction-cli"]);
    let status = command.status().map_err(|error| error.to_string())?;
    if !status.success() {
        return Err("the program could not be built".into());
    }
    Ok(super::target_folder()?.join("release/stiction"))
}

/// Seconds of some runs, the least first.
fn wall_times(program: &Path, run: &Run, runs: usize) -> Result<Vec<f64>, String> {
    let folder = std::env::temp_dir().join(format!("stiction-bench-{}", std::process::id()));
    let mut times = Vec::with_capacity(runs);
    for _ in 0..runs {
        let mut command = Command::new(program);
        command.arg("run").arg(&run.model).args(run.arguments);
        command
            .args(["--progress", "none", "--force", "-o"])
            .arg(&folder);
        command.stdout(Stdio::null());
        let start = Instant::now();
        let output = command.output().map_err(|error| error.to_string())?;
        let wall = start.elapsed().as_secs_f64();
        if !output.status.success() {
            let said = String::from_utf8_lossy(&output.stderr);
            return Err(format!("{}: {said}", run.what));
        }
        times.push(wall);
    }
    // What is left behind does no harm.
    let _ = std::fs::remove_dir_all(&folder);
    times.sort_by(f64::total_cmp);
    Ok(times)
}
