//! The last good state of a run that cannot go on.

use super::Simulation;
use super::report::{Observer, RunError};
use crate::state::State;
use crate::system::History;

/// Where a run could not go on in the way it was asked to, and why. Steps may go on in another way from
/// there; when these fail too, what they reached is not good.
pub(super) struct Blocked {
    error: RunError,
    /// None where the instant itself has no solution.
    solved: Option<Solved>,
}

/// A solved instant.
struct Solved {
    state: State,
    accelerations: Vec<f64>,
    multipliers: Vec<f64>,
    history: History,
}

impl Blocked {
    /// Keeps the present instant of `simulation`, where it is solved.
    pub(super) fn new(error: RunError, simulation: &Simulation, solved: bool) -> Self {
        Self {
            error,
            solved: solved.then(|| Solved {
                state: simulation.state.clone(),
                accelerations: simulation.accelerations.clone(),
                multipliers: simulation.multipliers.clone(),
                history: simulation.system.history.clone(),
            }),
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
        if let Some(solved) = blocked.solved.filter(|solved| solved.state.time > shown) {
            self.state = solved.state;
            self.accelerations = solved.accelerations;
            self.multipliers = solved.multipliers;
            self.system.history = solved.history;
            observer.output(&self.snapshot());
        }
        blocked.error
    }
}
