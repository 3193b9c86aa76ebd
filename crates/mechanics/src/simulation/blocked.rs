//! The last good state of a run that cannot go on.

use super::Simulation;
use super::report::{Observer, RunError};
use crate::state::State;
use crate::system::History;

/// Where a run could not go on in the way it was asked to, and why. Steps may go on in another way from
/// there; when these fail too, what they reached is not good.
pub(super) struct Blocked {
    why: RunError,
    state: State,
    accelerations: Vec<f64>,
    multipliers: Vec<f64>,
    history: History,
}

impl Blocked {
    /// Keeps the present instant of `simulation`, which is solved.
    pub(super) fn new(why: RunError, simulation: &Simulation) -> Self {
        Self {
            why,
            state: simulation.state.clone(),
            accelerations: simulation.accelerations.clone(),
            multipliers: simulation.multipliers.clone(),
            history: simulation.system.history.clone(),
        }
    }
}

impl Simulation {
    /// Goes back to where the run was blocked, unless outputs were `shown` up to later, and shows the
    /// state there; returns why.
    pub(super) fn go_back(
        &mut self,
        blocked: Blocked,
        shown: f64,
        observer: &mut impl Observer,
    ) -> RunError {
        if blocked.state.time > shown {
            self.state = blocked.state;
            self.accelerations = blocked.accelerations;
            self.multipliers = blocked.multipliers;
            self.system.history = blocked.history;
            observer.output(&self.snapshot());
        }
        blocked.why
    }
}
