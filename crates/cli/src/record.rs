//! `run.json`: what a run was.

use std::io::{self, Read};
use std::path::Path;
use std::time::{SystemTime, UNIX_EPOCH};

use serde_json::{Value, json};
use sha2::{Digest, Sha256};
use stiction::{
    EnergyBalance, EnergyTerm, FailedCommand, FrictionReport, Message, ModeReport, Outcome,
    Project, RunReport, Severity,
};

use crate::arguments::RunArguments;
use crate::diagnostics::messages_json;
use crate::exit::Exit;

/// What a run warns of, and what is denied of that; the error that ended it is not among them.
pub(crate) fn beside_the_outcome(report: &RunReport) -> impl Iterator<Item = &Message> {
    let (_, told) = words(&report.outcome);
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

/// One word for an outcome, and what went wrong.
pub(crate) fn words(outcome: &Outcome) -> (&'static str, Option<&str>) {
    match outcome {
        Outcome::Completed => ("completed", None),
        Outcome::Interrupted => ("interrupted", None),
        Outcome::Refused(text) => ("not simulated", Some(text)),
        Outcome::AssemblyFailed(text) => ("assembly failed", Some(text)),
        Outcome::IntegrationFailed(text) => ("integration failed", Some(text)),
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

/// Writes `run.json` into `folder`.
pub(crate) fn write(
    folder: &Path,
    inputs: &[Value],
    arguments: &RunArguments,
    warnings: &[Message],
    report: &RunReport,
) -> io::Result<()> {
    let (outcome, message) = words(&report.outcome);
    let now = SystemTime::now().duration_since(UNIX_EPOCH);
    let steps = &report.statistics.steps;
    let balance = report.balance.as_ref().map(balance_json);
    let value = json!({
        "program": "stiction",
        "version": env!("CARGO_PKG_VERSION"),
        "inputs": inputs,
        "options": {
            "end": arguments.end,
            "steps": arguments.steps,
            "dtout": arguments.dtout,
            "error": arguments.error,
            "set": arguments.changes,
        },
        "outcome": outcome,
        "message": message,
        "exit_code": exit_of(report).code(),
        "time": report.time,
        "resumed": report.resumed,
        "simulations": report.simulations,
        "failures": report.failures.iter().map(failure_json).collect::<Vec<_>>(),
        "outputs": report.outputs,
        "warnings": report.warnings,
        "diagnostics": messages_json(warnings.iter().chain(&report.messages)),
        "timing": {
            "finished_unix_seconds": now.map(|now| now.as_secs()).ok(),
            "elapsed_seconds": report.elapsed,
        },
        "integrator": {
            "steps": steps.steps,
            "rejections": steps.rejections,
            "failures": steps.failures,
            "starts": steps.starts,
            "residuals": report.statistics.work.residuals,
            "factorisations": report.statistics.work.factorisations,
        },
        "modes": report.modes.iter().map(modes_json).collect::<Vec<_>>(),
        "energy_balance": balance,
        "frictions": report.frictions.iter().map(friction_json).collect::<Vec<_>>(),
    });
    std::fs::write(folder.join("run.json"), format!("{value:#}\n"))
}

fn failure_json(failure: &FailedCommand) -> Value {
    let (outcome, message) = words(&failure.outcome);
    json!({
        "command": failure.command,
        "time": failure.time,
        "outcome": outcome,
        "message": message,
    })
}

fn balance_json(balance: &EnergyBalance) -> Value {
    let term =
        |term: &EnergyTerm| json!({ "start": term.start, "end": term.end, "change": term.change });
    json!({
        "unit": balance.unit,
        "kinetic": term(&balance.kinetic),
        "weight": term(&balance.weight),
        "stored": term(&balance.stored),
        "dissipated": balance.dissipated,
        "work_of_forces": balance.forces,
        "work_of_motions": balance.motions,
        "residual": balance.residual(),
        "residual_share": balance.residual_share(),
        "exchanged": balance.exchanged,
    })
}

/// Eigenvalues as pairs of real and imaginary part, cycles/second.
fn modes_json(report: &ModeReport) -> Value {
    let values: Vec<[f64; 2]> = report.modes.iter().map(|mode| mode.value).collect();
    json!({ "time": report.time, "eigenvalues": values })
}

fn friction_json(report: &FrictionReport) -> Value {
    let tally = &report.tally;
    json!({
        "friction": report.friction.to_string(),
        "joint": report.joint,
        "peak": { "value": report.peak, "unit": report.unit, "time": report.peak_time },
        "outputs": { "stuck": report.regimes[0], "transition": report.regimes[1],
            "sliding": report.regimes[2], "limited": report.clipped },
        "work": { "value": report.work, "unit": report.energy_unit },
        "dissipated": { "value": report.energy, "unit": report.energy_unit },
        "sticks": tally.sticks,
        "stuck_time": { "value": tally.stuck_time, "unit": report.time_unit },
        "largest_creep": { "value": tally.largest_creep, "unit": report.length_unit },
        "drift": report.is_lugre().then_some(tally.drift),
        "not_passive_from": tally.not_passive,
    })
}
