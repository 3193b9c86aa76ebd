//! `run.json`: what a run was.

use std::io::{self, Read};
use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use stiction::{Message, Outcome, Project, RunReport, Severity};

use crate::arguments::RunArguments;
use crate::exit::Exit;

/// What a run warns of, and what is denied of that; the error that ended it is not among them.
pub(crate) fn beside_the_outcome(report: &RunReport) -> impl Iterator<Item = &Message> {
    let (_, told) = report.outcome.words();
    let messages = report.messages.iter();
    messages.filter(move |message| match message.diagnostic.severity {
        Severity::Error => told != Some(message.to_string().trim_end()),
        Severity::Warning => true,
        Severity::Note => false,
    })
}

/// The exit status of a run.
pub(crate) fn exit_of(report: &RunReport) -> Exit {
    match report.outcome {
        // Nothing but a warning that is denied can be wrong with it.
        Outcome::Completed if report.messages.iter().any(Message::is_error) => Exit::Input,
        Outcome::Completed => Exit::Success,
        Outcome::Interrupted => Exit::Interrupted,
        Outcome::Refused(_) => Exit::Input,
        Outcome::AssemblyFailed(_) => Exit::Assembly,
        Outcome::IntegrationFailed(_) => Exit::Integration,
    }
}

/// The hashes of the files that a project was read from.
pub(crate) fn inputs(project: &Project) -> Vec<Value> {
    let files = project.files().iter();
    let input = |path: &std::path::PathBuf| {
        // A file that has gone since it was read has no hash any more.
        json!({ "file": path.display().to_string(), "sha256": sha256(path).ok() })
    };
    files.map(input).collect()
}

fn sha256(path: &Path) -> io::Result<String> {
    let mut file = std::fs::File::open(path)?;
    let mut hash = Sha256::new();
    let mut buffer = vec![0; 1 << 16];
    loop {
        let count = file.read(&mut buffer)?;
        if count == 0 {
            break;
        }
        hash.update(&buffer[..count]);
    }
    Ok(hash
        .finalize()
        .iter()
        .map(|byte| format!("{byte:02x}"))
        .collect())
}

/// What the run was asked for.
fn options(arguments: &RunArguments) -> Value {
    json!({
        "end": arguments.end,
        "steps": arguments.steps,
        "dtout": arguments.dtout,
        "error": arguments.error,
        "reactions": arguments.reactions.name(),
        "reaction_length": arguments.reaction_length,
        "integrator": arguments.integrator.map(stiction::Method::name),
        "check_accuracy": arguments.check_accuracy(),
        "set": arguments.changes,
    })
}

/// What tables tell of a run in their metadata.
pub(crate) fn facts(
    project: &Project,
    arguments: &RunArguments,
    report: &RunReport,
) -> Vec<(&'static str, String)> {
    vec![
        ("version", env!("CARGO_PKG_VERSION").to_owned()),
        ("model", project.model_checksum()),
        ("options", options(arguments).to_string()),
        ("outcome", report.outcome.words().0.to_owned()),
    ]
}

/// Writes `run.json` into `folder`.
pub(crate) fn write(
    folder: &Path,
    inputs: &[Value],
    arguments: &RunArguments,
    warnings: &[Message],
    report: &RunReport,
) -> io::Result<()> {
    let now = SystemTime::now().duration_since(UNIX_EPOCH);
    let messages = warnings.iter().chain(&report.messages);
    let mut value = report.to_json();
    let more = [
        ("program", json!("stiction")),
        ("version", json!(env!("CARGO_PKG_VERSION"))),
        ("inputs", json!(inputs)),
        ("options", options(arguments)),
        ("exit_code", json!(exit_of(report).code())),
        (
            "diagnostics",
            messages.map(Message::to_json).collect::<Value>(),
        ),
        (
            "timing",
            json!({
                "finished_unix_seconds": now.map(|now| now.as_secs()).ok(),
                "elapsed_seconds": report.elapsed,
            }),
        ),
    ];
    for (name, part) in more {
        value[name] = part;
    }
    // Half a record would be none, but the folder is not to look as if there were one.
    let text = format!("{value:#}\n");
    stiction::write_whole(&folder.join("run.json"), |part| std::fs::write(part, text))
}
