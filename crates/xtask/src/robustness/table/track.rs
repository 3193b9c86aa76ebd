//! Where the bodies of a run were at its outputs.

use mechanics::model::Model;
use mechanics::{
    Comparison, Ending, Moment, Observer, Settings, Simulation, Snapshot, StepError, StepReport,
};

/// Outputs of a run.
const OUTPUTS: usize = 10;

/// Why there is no track.
#[derive(Clone, Debug)]
pub(super) enum Missing {
    /// The run says why it does not go on.
    Refused(String),
    /// It took too many steps.
    GivenUp,
}

/// Places of all bodies at the outputs, and the steps it took.
#[derive(Clone, Debug)]
pub(super) struct Track {
    length: f64,
    outputs: Vec<Moment>,
    pub(super) steps: usize,
}

impl Track {
    /// Runs a model; gives up after `most` steps.
    pub(super) fn of(
        model: &Model,
        end: f64,
        settings: &Settings,
        most: usize,
    ) -> Result<Self, Missing> {
        let refused = |text: String| Missing::Refused(text);
        let mut simulation = Simulation::new(model.clone(), 1.0);
        simulation
            .assemble()
            .map_err(|error| refused(error.to_string()))?;
        simulation
            .solve_instant()
            .map_err(|error| refused(error.to_string()))?;
        let mut watch = Watch {
            most,
            track: Self {
                length: simulation.system().length_scale(),
                outputs: Vec::new(),
                steps: 0,
            },
        };
        let outputs = (1..=OUTPUTS).map(|k| end * k as f64 / OUTPUTS as f64);
        match simulation.run(end, outputs, settings, &mut watch) {
            Err(error) => Err(refused(error.to_string())),
            Ok(Ending::Completed) => Ok(watch.track),
            Ok(Ending::Stopped | Ending::Paused) => Err(Missing::GivenUp),
        }
    }

    /// The largest distance of a body from where `other` has it, as a part of the length of the
    /// mechanism, or its largest rotation from there in radians.
    pub(super) fn distance(&self, other: &Self) -> f64 {
        let error = StepError::new(1.0, self.length);
        let largest = self.compared(other, error).largest();
        largest.map_or(0.0, |largest| largest.errors())
    }

    /// Whether the check of accuracy finds a run with these settings inaccurate by a second run.
    pub(super) fn is_inaccurate(&self, second: &Self, settings: &Settings) -> bool {
        let error = StepError::of(settings, self.length);
        let largest = self.compared(second, error).largest();
        largest.is_some_and(|largest| largest.is_inaccurate())
    }

    fn compared(&self, other: &Self, error: StepError) -> Comparison {
        let mut comparison = Comparison::default();
        for (here, there) in self.outputs.iter().zip(&other.outputs) {
            comparison.add(here, there, error);
        }
        comparison
    }
}

struct Watch {
    most: usize,
    track: Track,
}

impl Observer for Watch {
    fn step(&mut self, report: &StepReport) -> bool {
        self.track.steps = report.statistics.steps.steps;
        let steps = report.statistics.steps;
        steps.attempts() < self.most
    }

    fn output(&mut self, snapshot: &Snapshot<'_>) -> bool {
        self.track.outputs.push(Moment::of(snapshot));
        true
    }
}
