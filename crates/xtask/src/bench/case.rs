//! What is measured: a mechanism, an end time, the numbers that errors are errors of, and the peers.

use mechanics::{Ending, Observer, Simulation, Snapshot, Statistics, StepReport};

use super::clock::{Clock, Times};
use super::integrators::{FOR_REFERENCES, Integrator};

/// A mechanism to be run by all integrators.
pub(crate) struct Case {
    /// As it is called on the command line.
    pub(crate) name: &'static str,
    /// Title of its section.
    pub(crate) title: &'static str,
    /// What it is, in a sentence or two.
    pub(crate) description: &'static str,
    /// The mechanism, assembled.
    pub(crate) simulation: Simulation,
    /// End of the run.
    pub(crate) end: f64,
    /// The numbers at the end that are compared.
    pub(crate) read: fn(&Simulation) -> Vec<f64>,
    /// What the largest error of them is, with its unit.
    pub(crate) quantity: &'static str,
    /// Where the exact numbers are from.
    pub(crate) reference: Reference,
    /// Tightest ERROR, as a power of ten.
    pub(crate) tightest: i32,
    /// The programs that it is compared with.
    pub(crate) peers: Vec<PeerSetup>,
}

/// The exact numbers of a case.
pub(crate) enum Reference {
    /// From the reference data.
    Known {
        /// The numbers.
        values: Vec<f64>,
        /// Where they are from.
        source: &'static str,
    },
    /// Our own run with this ERROR.
    Own(f64),
}

/// How a peer is asked for a case.
pub(crate) struct PeerSetup {
    /// Name and method.
    pub(crate) name: &'static str,
    /// Script in the folder `peers`.
    pub(crate) script: &'static str,
    /// Its arguments.
    pub(crate) arguments: Vec<String>,
    /// Numbers of steps of the run.
    pub(crate) steps: &'static [u32],
}

/// A run that was timed.
pub(crate) struct Timed {
    /// What it took.
    pub(crate) times: Times,
    /// The numbers at its end.
    pub(crate) values: Vec<f64>,
    /// What the integrator did; unknown of peers.
    pub(crate) statistics: Option<Statistics>,
}

/// Steps after which a run is given up.
const MOST_STEPS: usize = 20_000;

/// Watches nothing but the number of steps.
struct Silent;

impl Observer for Silent {
    fn step(&mut self, report: &StepReport) -> bool {
        report.statistics.steps.steps < MOST_STEPS
    }

    fn output(&mut self, _: &Snapshot<'_>) -> bool {
        true
    }
}

impl Case {
    /// Runs it to its end, with one output there.
    pub(crate) fn run(&self, integrator: &Integrator, error: f64) -> Result<Timed, String> {
        let mut simulation = self.simulation.clone();
        let settings = integrator.settings(error, self.end);
        let clock = Clock::start();
        let ending = simulation.run(self.end, [self.end], &settings, &mut Silent);
        let times = clock.read();
        match ending {
            Err(failure) => Err(failure.to_string()),
            Ok(Ending::Stopped | Ending::Paused) => Err(format!("more than {MOST_STEPS} steps")),
            Ok(Ending::Completed) => Ok(Timed {
                times,
                values: (self.read)(&simulation),
                statistics: Some(simulation.statistics()),
            }),
        }
    }

    /// The exact numbers, and in words where they are from.
    pub(crate) fn reference(&self) -> Result<(Vec<f64>, String), String> {
        match &self.reference {
            Reference::Known { values, source } => Ok((values.clone(), (*source).to_owned())),
            Reference::Own(error) => {
                let run = self.run(&FOR_REFERENCES, *error)?;
                let name = FOR_REFERENCES.name;
                Ok((
                    run.values,
                    format!("our own run with {name}, ERROR = {error:e}"),
                ))
            }
        }
    }

    /// The values of ERROR that it is measured at.
    pub(crate) fn errors(&self, quick: bool) -> Vec<f64> {
        let tightest = if quick { -4 } else { self.tightest };
        (tightest..=-2)
            .rev()
            .map(|power| 10f64.powi(power))
            .collect()
    }
}
