//! How time and memory grow with the number of bodies.
//!
//! Every row is a process of its own, so that its largest memory is that of one mechanism.

use std::fmt::Write;
use std::process::Command;

use mechanics::{Ending, Observer, Simulation, Snapshot, Statistics, StepReport};
use mechanisms::chains;
use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use super::clock::Clock;
use super::integrators::FOR_REFERENCES;

/// A step of ten times as many bodies is to take at most so many times as long.
const MOST_TIMES: f64 = 12.0;
/// Steps before the measured ones: in them the order of the pivots is searched.
const FIRST_STEPS: usize = 4;
/// Steps times bodies that are measured, within `FEWEST` and `MOST`.
const BODY_STEPS: usize = 2_000_000;
const FEWEST: usize = 40;
const MOST: usize = 1_000;

/// The mechanisms that grow.
#[derive(Clone, Copy, Debug, PartialEq, Eq, clap::ValueEnum)]
pub(crate) enum Kind {
    /// Rods on hinges in a row.
    Chain,
    /// The same with ORIGINAL friction in every hinge and a strut over every ten rods.
    Braced,
}

/// One mechanism of one size, for the process that measures it.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    kind: Kind,
    bodies: usize,
}

/// What a process found.
#[derive(Serialize, Deserialize)]
pub(crate) struct Row {
    bodies: usize,
    /// Processor seconds of assembly.
    assembly: f64,
    /// Processor seconds of a step, the mean.
    step: f64,
    /// Matrices built and factored in a step, the mean.
    matrices: f64,
    /// Part of the time that goes into building and factoring matrices.
    share: f64,
    /// Largest resident memory, bytes, where the system tells.
    memory: Option<f64>,
}

/// Work and time of every step.
struct Watch {
    left: usize,
    before: Statistics,
    clock: Clock,
    /// Residuals, matrices and seconds of each step.
    steps: Vec<(f64, f64, f64)>,
}

impl Observer for Watch {
    fn step(&mut self, report: &StepReport) -> bool {
        let work = |statistics: &Statistics| {
            let work = statistics.work;
            (work.residuals as f64, work.factorisations as f64)
        };
        let (before, after) = (work(&self.before), work(&report.statistics));
        let time = self.clock.read().processor;
        self.steps
            .push((after.0 - before.0, after.1 - before.1, time));
        self.before = report.statistics;
        self.clock = Clock::start();
        self.left -= 1;
        self.left > 0
    }

    fn output(&mut self, _: &Snapshot<'_>) -> bool {
        true
    }
}

/// Measures one row and prints it as JSON.
pub(crate) fn measure(arguments: &Arguments) -> Result<(), String> {
    let mut chain = chains::chain(arguments.bodies);
    if arguments.kind == Kind::Braced {
        chains::hinge_friction(&mut chain, |_| {
            mechanisms::law(0.1, 0.05, 0.05, 0.01).into()
        });
        chains::brace(&mut chain);
    }
    let bodies = chain.model.bodies.len();
    let clock = Clock::start();
    let mut simulation = Simulation::new(chain.model, 1.0);
    simulation.assemble().map_err(|error| error.to_string())?;
    let assembly = clock.read().processor;
    let settings = FOR_REFERENCES.settings(1e-4, 1.0);
    let mut run = |left: usize| {
        let mut watch = Watch {
            left,
            before: simulation.statistics(),
            clock: Clock::start(),
            steps: Vec::new(),
        };
        match simulation.run(1e3, [0.0; 0], &settings, &mut watch) {
            Ok(Ending::Stopped) => Ok(watch.steps),
            Ok(_) => Err("it ended before its steps were done".to_owned()),
            Err(failure) => Err(failure.to_string()),
        }
    };
    run(FIRST_STEPS)?;
    let steps = run((BODY_STEPS / bodies).clamp(FEWEST, MOST))?;
    let total = |part: fn(&(f64, f64, f64)) -> f64| steps.iter().map(part).sum::<f64>();
    let (matrices, time) = (total(|step| step.1), total(|step| step.2));
    let row = Row {
        bodies,
        assembly,
        step: time / steps.len() as f64,
        matrices: matrices / steps.len() as f64,
        share: matrices * time_of_a_matrix(&steps) / time,
        memory: peak_memory(),
    };
    println!(
        "{}",
        serde_json::to_string(&row).map_err(|error| error.to_string())?
    );
    Ok(())
}

/// Seconds of a matrix where a step takes one time of its own, one for each residual and one for each
/// matrix: the fit with the least sum of squares over all steps.
fn time_of_a_matrix(steps: &[(f64, f64, f64)]) -> f64 {
    let (mut normal, mut right) = (Matrix3::zeros(), Vector3::zeros());
    for &(residuals, matrices, time) in steps {
        let row = Vector3::new(1.0, residuals, matrices);
        normal += row * row.transpose();
        right += row * time;
    }
    normal.lu().solve(&right).map_or(f64::NAN, |fit| fit.z)
}

/// Largest resident memory of this process so far, bytes.
fn peak_memory() -> Option<f64> {
    let status = std::fs::read_to_string("/proc/self/status").ok()?;
    let line = status.lines().find(|line| line.starts_with("VmHWM"))?;
    let kilobytes: f64 = line.split_whitespace().nth(1)?.parse().ok()?;
    Some(1024.0 * kilobytes)
}

/// The section of the page; `quick` stays with small mechanisms.
///
/// # Errors
/// When a process fails, with what it said.
pub(crate) fn section(quick: bool) -> Result<String, String> {
    let mut text = "## Growth with size\n\nSI2 at ERROR = 1e-4 from rest. A rod is a body and a hinge; the braced \
                    chain has ORIGINAL friction in every hinge and a strut on a ball and a cross over every ten \
                    rods. Processor time. The share of the matrices (built and factored) is from a fit of the \
                    steps' times to their counts of residuals and matrices. Memory is the largest of the whole \
                    process.\n\n"
        .to_owned();
    let most = if quick { 100 } else { 100_000 };
    for (kind, name, title) in [
        (Kind::Chain, "chain", "Chain in space"),
        (Kind::Braced, "braced", "Braced chain with friction"),
    ] {
        let _ = writeln!(
            text,
            "| {title}: bodies | assembly, s | step, ms | µs a body | matrices a step | their share | \
             memory, MB | kB a body |\n|---|---|---|---|---|---|---|---|"
        );
        let mut rows: Vec<Row> = Vec::new();
        let sizes = [10, 100, 1_000, 10_000, 100_000];
        for count in sizes.into_iter().filter(|count| *count <= most) {
            rows.push(
                in_a_process(name, count)
                    .map_err(|error| format!("{kind:?} of {count}: {error}"))?,
            );
        }
        for row in &rows {
            text += &line(row);
        }
        if let (Some(smaller), Some(larger)) = (rows.get(2), rows.get(3)) {
            let times = larger.step / smaller.step;
            let verdict = if times <= MOST_TIMES {
                "met"
            } else {
                "**short**"
            };
            let _ = writeln!(
                text,
                "\nA step of {} bodies takes {times:.1} times one of {}; at most {MOST_TIMES} is aimed at: \
                 {verdict}.",
                larger.bodies, smaller.bodies
            );
        }
        text += "\n";
    }
    Ok(text)
}

fn in_a_process(kind: &str, count: usize) -> Result<Row, String> {
    let program = std::env::current_exe().map_err(|error| error.to_string())?;
    let output = Command::new(program)
        .args(["grow", kind, &count.to_string()])
        .output()
        .map_err(|error| error.to_string())?;
    let said = String::from_utf8_lossy(&output.stdout);
    if !output.status.success() {
        return Err(said.trim().to_owned());
    }
    serde_json::from_str(&said).map_err(|error| error.to_string())
}

fn line(row: &Row) -> String {
    let bodies = row.bodies as f64;
    let memory = |part: f64| {
        row.memory
            .map_or(String::new(), |bytes| format!("{:.1}", bytes * part))
    };
    format!(
        "| {} | {:.4} | {:.3} | {:.2} | {:.2} | {:.0} % | {} | {} |\n",
        row.bodies,
        row.assembly,
        1e3 * row.step,
        1e6 * row.step / bodies,
        row.matrices,
        100.0 * row.share,
        memory(1e-6),
        memory(1e-3 / bodies)
    )
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Steps of 2 µs, 3 µs a residual and 7 µs a matrix.
    #[test]
    fn the_time_of_a_matrix_is_found() {
        let steps =
            [(3.0, 1.0), (4.0, 0.0), (2.0, 1.0), (9.0, 4.0)].map(|(residuals, matrices)| {
                (
                    residuals,
                    matrices,
                    2e-6 + 3e-6 * residuals + 7e-6 * matrices,
                )
            });
        assert!((time_of_a_matrix(&steps) - 7e-6).abs() < 1e-15);
    }
}
