//! A run that pauses, as data: everything that its next step depends on.

use std::borrow::Cow;

use serde::{Deserialize, Serialize};

use super::Simulation;
use crate::model::Model;

/// A simulation to be written out, between two runs or where one pauses; the model itself is not in it.
///
/// Unlike [`SavedState`](super::SavedState) it holds the integrator with its past, its storage and its
/// matrices, so that what goes on from it gives the same bits as what went on without it. It is for
/// the same build of the program, with the same model.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Paused<'a>(Cow<'a, Simulation>);

impl Simulation {
    /// The simulation as it is, for writing.
    #[must_use]
    pub fn paused(&self) -> Paused<'_> {
        Paused(Cow::Borrowed(self))
    }
}

impl Paused<'_> {
    /// The simulation that was written, with its model.
    #[must_use]
    pub fn of_model(self, model: Model) -> Simulation {
        let mut simulation = self.0.into_owned();
        if let Some(engine) = &mut simulation.engine {
            engine.dynamics.take_model(model.clone());
        }
        simulation.system.take_model(model);
        simulation
    }
}
