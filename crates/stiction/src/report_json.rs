//! What a run did and its messages as JSON: the shape of `run.json` and of the Python package.

use serde_json::{Value, json};

use crate::accuracy::{AccuracyReport, BodyDeviation, ElementDeviation};
use crate::balance::{EnergyBalance, EnergyTerm};
use crate::eigensolution::ModeReport;
use crate::message::Message;
use crate::report::FrictionReport;
use crate::session::{FailedCommand, Outcome, RunReport};

impl Outcome {
    /// One word for it, and what went wrong.
    #[must_use]
    pub fn words(&self) -> (&'static str, Option<&str>) {
        match self {
            Self::Completed => ("completed", None),
            Self::Interrupted => ("interrupted", None),
            Self::Refused(text) => ("not simulated", Some(text)),
            Self::AssemblyFailed(text) => ("assembly failed", Some(text)),
            Self::IntegrationFailed(text) => ("integration failed", Some(text)),
        }
    }
}

impl Message {
    /// The message as JSON; docs/diagnostics.md explains its shape.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let (diagnostic, location) = (&self.diagnostic, &self.location);
        let replacement = diagnostic.replacement.as_ref().zip(location.replacement);
        json!({
            "code": diagnostic.code.as_str(),
            "severity": diagnostic.severity.as_str(),
            "message": diagnostic.message,
            "file": diagnostic.source,
            "span": span_json(diagnostic.span, [location.start, location.end]),
            "notes": diagnostic.notes,
            "help": diagnostic.help,
            "replacement": replacement.map(|(new, ends)| json!({
                "span": span_json(new.span, ends),
                "text": new.text,
            })),
        })
    }
}

fn span_json(span: dataset::Span, ends: [dataset::Place; 2]) -> Value {
    let end = |offset: usize, place: dataset::Place| json!({ "offset": offset, "line": place.line, "column": place.column });
    json!({ "start": end(span.start, ends[0]), "end": end(span.end, ends[1]) })
}

impl RunReport {
    /// The report as JSON, without its messages and files.
    #[must_use]
    pub fn to_json(&self) -> Value {
        let (outcome, message) = self.outcome.words();
        let steps = &self.statistics.steps;
        json!({
            "outcome": outcome,
            "message": message,
            "time": self.time,
            "resumed": self.resumed,
            "simulations": self.simulations,
            "failures": self.failures.iter().map(failure_json).collect::<Vec<_>>(),
            "outputs": self.outputs,
            "warnings": self.warnings,
            "integrator": {
                "steps": steps.steps,
                "rejections": steps.rejections,
                "failures": steps.failures,
                "starts": steps.starts,
                "residuals": self.statistics.work.residuals,
                "factorisations": self.statistics.work.factorisations,
            },
            "modes": self.modes.iter().map(modes_json).collect::<Vec<_>>(),
            "energy_balance": self.balance.as_ref().map(balance_json),
            "accuracy": self.accuracy.as_ref().map(accuracy_json),
            "frictions": self.frictions.iter().map(friction_json).collect::<Vec<_>>(),
        })
    }
}

fn failure_json(failure: &FailedCommand) -> Value {
    let (outcome, message) = failure.outcome.words();
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

/// What is no number is null.
fn accuracy_json(report: &AccuracyReport) -> Value {
    json!({
        "accurate": report.is_accurate(),
        "outputs": report.outputs,
        "unmatched": report.unmatched,
        "distance": report.distance.as_ref().map(deviation_json),
        "rotation": report.rotation.as_ref().map(deviation_json),
        "inaccurate_from": report.inaccurate.as_ref().map(deviation_json),
        "suggested_error": report.remedy,
        "elements": report.elements.iter().map(element_json).collect::<Vec<_>>(),
        "second_failure": report.second_failure.as_ref().map(|failure| json!({
            "time": failure.time,
            "message": failure.cause,
        })),
    })
}

fn deviation_json(deviation: &BodyDeviation) -> Value {
    json!({
        "body": deviation.body.to_string(),
        "difference": deviation.difference,
        "estimate": deviation.estimate,
        "unit": deviation.unit,
        "errors": deviation.errors(),
        "time": deviation.time,
    })
}

fn element_json(deviation: &ElementDeviation) -> Value {
    json!({
        "element": deviation.element.to_string(),
        "quantity": deviation.quantity,
        "difference": deviation.difference,
        "part": deviation.part(),
        "unit": deviation.unit,
        "time": deviation.time,
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
