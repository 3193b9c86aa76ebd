//! What friction costs: models with and without their FRICTION statements, by turns in one run.

use std::fmt::Write;
use std::path::Path;

use mechanics::{Ending, Observer, Simulation, Snapshot, Statistics, StepReport};
use stiction::Project;

use super::clock::{Clock, Times, median};
use super::integrators::FOR_REFERENCES;

/// Runs whose median is taken.
const RUNS: usize = 15;
/// Friction may cost this many times the step without it.
const MOST: f64 = 1.3;

/// Watches nothing.
struct Silent;

impl Observer for Silent {
    fn step(&mut self, _: &StepReport) -> bool {
        true
    }

    fn output(&mut self, _: &Snapshot<'_>) -> bool {
        true
    }
}

/// The section of the page.
///
/// # Errors
/// When a model cannot be read or run.
pub(crate) fn section(root: &Path, quick: bool) -> Result<String, String> {
    let mut text = "## What friction costs\n\nModels of the examples as they are and without their FRICTION \
                    statements, SI2 at ERROR = 1e-6, processor time; a factor of 1.3 a step is aimed at.\n\n\
                    | model | steps with | without | µs a step with | without | factor | |\n\
                    |---|---|---|---|---|---|---|\n"
        .to_owned();
    for (file, end) in [
        ("delta-robot/delta.adm", 1.2),
        ("pendulum/pendulum.adm", 20.0),
    ] {
        let project = Project::load(&root.join("examples").join(file));
        let with = project
            .and_then(|project| project.simulation())
            .map_err(|error| error.to_string())?;
        let mut bare = with.model().clone();
        bare.frictions.clear();
        // The examples are in seconds.
        let without = Simulation::new(bare, 1.0);
        let mut models = [with, without];
        for model in &mut models {
            model
                .assemble()
                .map_err(|error| format!("{file}: {error}"))?;
        }
        let mut times: [Vec<Times>; 2] = Default::default();
        let mut statistics = [Statistics::default(); 2];
        // One after the other, so that both see the same machine.
        for _ in 0..if quick { 1 } else { RUNS } {
            for (k, model) in models.iter().enumerate() {
                let (time, work) = run(model, end).map_err(|error| format!("{file}: {error}"))?;
                times[k].push(time);
                statistics[k] = work;
            }
        }
        let steps = statistics.map(|statistics| statistics.steps.steps);
        let per_step = [0, 1].map(|k| {
            median(&times[k]).map_or(f64::NAN, |times| 1e6 * times.processor / steps[k] as f64)
        });
        let factor = per_step[0] / per_step[1];
        let verdict = if factor <= MOST { "met" } else { "**short**" };
        let _ = writeln!(
            text,
            "| `{file}` | {} | {} | {:.1} | {:.1} | {factor:.2} | {verdict} |",
            steps[0], steps[1], per_step[0], per_step[1]
        );
    }
    Ok(text + "\n")
}

fn run(model: &Simulation, end: f64) -> Result<(Times, Statistics), String> {
    let mut simulation = model.clone();
    let settings = FOR_REFERENCES.settings(1e-6, end);
    let clock = Clock::start();
    let ending = simulation.run(end, [end], &settings, &mut Silent);
    let times = clock.read();
    match ending {
        Ok(Ending::Completed) => Ok((times, simulation.statistics())),
        Ok(_) => Err("it ended early".into()),
        Err(failure) => Err(failure.to_string()),
    }
}
