//! `stiction run`.

use std::path::{Path, PathBuf};
use std::time::Duration;

use columnar::Tables;
use stiction::{
    Claim, Outcome, Project, ResumeError, RunOptions, RunReport, Session, friction_table,
};

use crate::arguments::{ResultFormat, RunArguments};
use crate::exit::{Exit, complain, say};
use crate::progress::Monitor;
use crate::record;

/// Loads, runs and reports.
pub(crate) fn run(arguments: &RunArguments) -> Exit {
    match attempt(arguments) {
        Ok(exit) => exit,
        Err(Failure(exit, text)) => {
            complain(&text);
            exit
        }
    }
}

/// An exit status and what to say.
struct Failure(Exit, String);

fn usage(text: &str) -> Failure {
    Failure(Exit::Usage, format!("error: {text}\n"))
}

fn attempt(arguments: &RunArguments) -> Result<Exit, Failure> {
    check_numbers(arguments)?;
    let input = |error: stiction::InputError| Failure(Exit::Input, error.to_string());
    let levels = arguments.levels.levels();
    let levels = levels.map_err(|error| usage(&error.to_string()))?;
    let mut project = Project::load_with(&arguments.model, levels).map_err(input)?;
    for change in &arguments.changes {
        let statement = statement(change).ok_or_else(|| {
            usage(&format!(
                "--set {change}: write it as FRICTION/103.MU_STATIC=0.2"
            ))
        })?;
        project.set(&statement).map_err(input)?;
    }
    match (arguments.end, project.is_dataset_alone()) {
        (Some(end), true) => project.push_dynamic(end, arguments.steps, arguments.dtout),
        (None, true) => return Err(usage("a dataset (.adm) alone needs --end")),
        (Some(_), false) => return Err(usage("--end is for a dataset (.adm) alone")),
        (None, false) => {}
    }
    let session = Session::new(&project).map_err(input)?;
    let folder = folder(arguments, &project)?;
    // What is resumed may not be there, which resuming tells.
    let claim = folder.is_dir().then(|| Claim::of(&folder)).transpose();
    let _claim = claim.map_err(|error| usage(&error.to_string()))?;
    let inputs = record::inputs(&project);
    let mut monitor = Monitor::new(arguments.progress);
    let reactions = stiction::reactions(arguments.reactions.name(), arguments.reaction_length);
    let options = RunOptions {
        error: arguments.error,
        reactions: reactions.map_err(|error| usage(&error.to_string()))?,
        method: arguments.integrator,
        checkpoint: arguments.checkpoint.map(Duration::from_secs_f64),
        text_results: arguments.formats.contains(&ResultFormat::Res),
        check_accuracy: arguments.check_accuracy(),
    };
    let formats = arguments.formats.iter();
    let formats: Vec<_> = formats.filter_map(|format| format.of_tables()).collect();
    if !arguments.resume {
        let cleared = columnar::clear(&folder, project.prefix(), options.text_results);
        cleared.map_err(|error| usage(&error.to_string()))?;
    }
    let mut tables = Tables::new(&folder, formats);
    let ran = if arguments.resume {
        session.resume(&folder, options, &mut monitor)
    } else if tables.is_empty() {
        let ran = session.run(&folder, options, &mut monitor);
        ran.map_err(ResumeError::from)
    } else {
        let ran = session.run_into(&folder, options, &mut monitor, &mut tables);
        ran.map_err(ResumeError::from)
    };
    monitor.finish();
    let mut report = ran.map_err(|error| usage(&error.to_string()))?;
    let facts = record::facts(&project, arguments, &report);
    let tables = tables.finish(&facts);
    report
        .files
        .extend(tables.map_err(|error| usage(&error.to_string()))?);
    let warnings = session.warnings();
    record::write(&folder, &inputs, arguments, warnings, &report).map_err(|error| {
        usage(&format!(
            "cannot write {}: {error}",
            folder.join("run.json").display()
        ))
    })?;
    tell(&folder, &report, arguments);
    Ok(record::exit_of(&report))
}

fn check_numbers(arguments: &RunArguments) -> Result<(), Failure> {
    let numbers = [
        ("--end", arguments.end),
        ("--dtout", arguments.dtout),
        ("--error", arguments.error),
    ];
    for (name, value) in numbers {
        if value.is_some_and(|value| !(value > 0.0 && value.is_finite())) {
            return Err(usage(&format!("{name} must be a positive number")));
        }
    }
    let tables = arguments.formats.iter().any(|f| f.of_tables().is_some());
    if tables && (arguments.resume || arguments.checkpoint.is_some()) {
        return Err(usage(
            "parquet and csv cannot be resumed; leave out --checkpoint and --resume, or write res",
        ));
    }
    let seconds = arguments.checkpoint;
    if seconds.is_some_and(|seconds| Duration::try_from_secs_f64(seconds).is_err()) {
        return Err(usage("--checkpoint must be a number of seconds"));
    }
    Ok(())
}

/// `FRICTION/103.MU_STATIC=0.2` as a statement: `FRICTION/103, MU_STATIC=0.2`.
fn statement(change: &str) -> Option<String> {
    let (place, value) = change.split_once('=')?;
    let (element, argument) = place.split_once('.')?;
    // Statements without a number take their arguments right behind the slash.
    Some(match element.contains('/') {
        true => format!("{element}, {argument}={value}"),
        false => format!("{element}/{argument}={value}"),
    })
}

/// Makes the folder of the results.
fn folder(arguments: &RunArguments, project: &Project) -> Result<PathBuf, Failure> {
    let folder = arguments
        .output
        .clone()
        .unwrap_or_else(|| PathBuf::from(format!("{}-run", project.prefix())));
    if arguments.resume {
        return Ok(folder);
    }
    if folder.exists() && !arguments.force {
        let shown = folder.display();
        return Err(usage(&format!(
            "{shown} exists already; choose another folder with -o, or write into it with --force"
        )));
    }
    std::fs::create_dir_all(&folder)
        .map_err(|error| usage(&format!("cannot make {}: {error}", folder.display())))?;
    Ok(folder)
}

/// When a run ended, or what failed first, when, and how far the run got after it.
fn when(report: &RunReport) -> String {
    let first = report.failures.first();
    let Some(first) = first.filter(|first| first.outcome == report.outcome) else {
        return format!("at time {}", report.time);
    };
    let mut text = format!("at time {} ({})", first.time, first.command);
    let others = report.failures.len() - 1;
    if others > 0 {
        let plural = if others == 1 { "" } else { "s" };
        text += &format!(", {others} command{plural} after it failed, too");
    }
    if report.time > first.time {
        text += &format!("; the run went on to time {}", report.time);
    }
    text
}

/// Where the results are, and what friction did.
fn tell(folder: &Path, report: &RunReport, arguments: &RunArguments) {
    let (outcome, message) = report.outcome.words();
    if let Some(message) = message {
        complain(&format!("{message}\n"));
    }
    let steps = &report.statistics.steps;
    let mut text = format!(
        "{outcome} {}: {} outputs, {} steps, {:.2} s",
        when(report),
        report.outputs,
        steps.steps,
        report.elapsed
    );
    if report.warnings > 0 {
        let plural = if report.warnings == 1 { "" } else { "s" };
        text += &format!(", {} warning{plural} (see the .msg)", report.warnings);
    }
    text += &format!("\nresults in {}:", folder.display());
    for file in &report.files {
        let name = file.file_name().unwrap_or_default().to_string_lossy();
        text += &format!(" {name}");
    }
    text += " run.json\n";
    if report.outcome == Outcome::Interrupted && arguments.checkpoint.is_some() {
        text += "the same command with --resume goes on from here\n";
    }
    for warning in record::beside_the_outcome(report) {
        text += &warning.to_string();
    }
    if let Some(accuracy) = &report.accuracy {
        text += &format!("{}\n", accuracy.summary());
    } else if arguments.resume && !arguments.unchecked {
        text += "how accurate a resumed run is has not been checked\n";
    }
    for modes in &report.modes {
        text += &format!("\n{modes}");
    }
    let table = friction_table(&report.frictions);
    if !table.is_empty() {
        text += &format!("\n{table}");
        let folder = folder.display();
        text += &format!("stiction explain {folder} tells where the friction came from\n");
    }
    say(&text);
}

#[cfg(test)]
mod tests {
    use super::statement;

    #[test]
    fn changes_become_statements() {
        let change = statement("FRICTION/103.MU_STATIC=0.2");
        assert_eq!(change.as_deref(), Some("FRICTION/103, MU_STATIC=0.2"));
        let change = statement("ACCGRAV.KGRAV=-1.6");
        assert_eq!(change.as_deref(), Some("ACCGRAV/KGRAV=-1.6"));
        assert_eq!(statement("FRICTION/103"), None);
    }
}
