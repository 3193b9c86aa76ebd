//! How to integrate, and what is told of it.

use numerics::bdf;
use serde::{Deserialize, Serialize};

use crate::dynamics::{Corrector, Formulation, Index, Work};
use crate::model::Label;
use crate::snapshot::Snapshot;

/// Part of [`Settings::error`] that a single step may make: those of steps add up over a run.
const STEP_PART: f64 = 0.1;

/// How to integrate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// How constraints enter.
    pub formulation: Formulation,
    /// Error tolerance: relative to the model's length for positions, radians for rotations, and
    /// relative to the largest velocities for velocities. A step may make a tenth of it
    /// (docs/decisions/0012), so that a run whose errors its mechanism does not magnify is off by
    /// some of it.
    pub error: f64,
    /// Highest order of the formulas: 1 to 5 for backward differentiation, to 12 for those of Adams.
    pub highest_order: usize,
    /// Longest step.
    pub longest_step: f64,
    /// Shortest step before the integration is given up; steps to outputs and jumps may be shorter.
    pub shortest_step: f64,
    /// Step to start with, where given.
    pub first_step: Option<f64>,
    /// How Newton's iteration on a step goes.
    pub corrector: Corrector,
    /// Whether outputs within a step are interpolated; where they are not, steps end at them.
    pub interpolates: bool,
}

impl Settings {
    /// Error that a step may make of motions.
    ///
    /// Towards what rounding leaves of a step the part rises to all of ERROR: velocities that follow from
    /// positions lose digits in short steps.
    pub(crate) fn motion_error(&self) -> f64 {
        let rounding: f64 = match self.formulation.index() {
            Index::One | Index::StabilisedTwo => 1e-11,
            Index::Three => 1e-8,
        };
        self.error * (rounding / self.error).sqrt().clamp(STEP_PART, 1.0)
    }
}

/// What the integrator did so far.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct Statistics {
    /// Steps, rejections and starts.
    pub steps: bdf::Statistics,
    /// Residuals and factorisations.
    pub work: Work,
    /// Outputs whose accelerations and reactions are those of the step around them, because bristles
    /// that are not passive left the instant without a solution.
    pub rough_outputs: usize,
    /// When the equations showed last to be too stiff for their formulation, so that SI2 has taken its
    /// place.
    pub stiff_from: Option<f64>,
}

/// An accepted step, for tables and progress.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepReport {
    /// Time at its end.
    pub time: f64,
    /// Its length.
    pub size: f64,
    /// Order of the next step.
    pub order: usize,
    /// Counts so far.
    pub statistics: Statistics,
}

/// Is told of steps and outputs while a simulation runs.
pub trait Observer {
    /// After every accepted step; false stops the run.
    fn step(&mut self, report: &StepReport) -> bool;
    /// At every output time, and at the last good state of a run that fails; false stops the run.
    fn output(&mut self, snapshot: &Snapshot<'_>) -> bool;
    /// Whether the run is to pause here, after a step and its outputs.
    fn pauses(&mut self) -> bool {
        false
    }
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// At the end time.
    Completed,
    /// The observer stopped it.
    Stopped,
    /// The observer has it pause: it can be written out, and it can go on.
    Paused,
}

/// A run failed; everything up to its time was reported to the observer.
#[derive(Clone, Debug, PartialEq)]
pub struct RunError {
    /// Time of the last good state.
    pub time: f64,
    /// What happened, in mechanical words.
    pub message: String,
    /// The element that it is about, where there is one.
    pub element: Option<Label>,
    /// Why it cannot go on.
    pub cause: Cause,
}

/// Why a run cannot go on.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cause {
    /// Friction jams: the friction that a load causes adds more to it than there was.
    Jam,
    /// The equations have no unique solution.
    Singular,
    /// Newton's iteration did not converge.
    NotConverged,
    /// A function or a reaction is not a finite number.
    NotANumber,
    /// The error tolerance cannot be met with the shortest step.
    Inaccurate,
    /// A function jumps, and with it the place of a body.
    JumpOfPlace,
    /// Friction and forces leave nothing that holds the model.
    NoEquilibrium,
    /// There is no linear model at this position.
    NotLinear,
}

impl std::fmt::Display for RunError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "at time {}: {}", self.time, self.message)
    }
}

impl std::error::Error for RunError {}
