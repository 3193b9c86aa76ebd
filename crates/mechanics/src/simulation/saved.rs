//! The state of a simulation as plain data, and a simulation that goes on from it.

use serde::{Deserialize, Serialize};

use super::Simulation;
use crate::dynamics::Scales;
use crate::model::Model;
use crate::state::State;
use crate::system::{History, System};

/// All that a simulation needs to go on: the state, the last solution, what friction and angles
/// remember, and which constraint equations are in force. The model itself is not in it.
///
/// What an integrator keeps between two runs, storage and the order of elimination, is not in it
/// either: a simulation goes on bit for bit the same from what was saved only where both do it
/// through [`Simulation::restore`].
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct SavedState {
    state: State,
    accelerations: Vec<f64>,
    multipliers: Vec<f64>,
    /// Unknowns of reactions that are shared.
    #[serde(default)]
    shared: Vec<f64>,
    scales: Scales,
    bristle_past: Vec<f64>,
    bristle_gamma: f64,
    history: History,
    /// Whether each constraint equation is in force.
    in_force: Vec<bool>,
    statics: bool,
}

impl SavedState {
    /// Time of the state.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// Whether it has the sizes of a system with these equations in force. That may have more
    /// measures and algebraic variables.
    fn fits(&self, system: &System) -> bool {
        let given = system.given_state(0.0);
        let rows = self.in_force.iter().filter(|active| **active).count();
        let most = system.first_shared();
        self.state.has_layout_of(&given)
            && rows == system.row_count()
            && self.accelerations.len() == system.rate_count()
            && (rows..=most).contains(&self.multipliers.len())
            && self.bristle_past.len() == system.bristle_count()
            // None before the model is assembled.
            && [0, system.model().frictions.len()].contains(&self.history.frictions.len())
            && self.history.angles.len() <= system.model().measures.len()
    }
}

/// A saved state whose sizes are not those of the model.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ForeignState;

impl std::fmt::Display for ForeignState {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str("the saved state is one of another model")
    }
}

impl std::error::Error for ForeignState {}

impl Simulation {
    /// The present state, to go on from later.
    #[must_use]
    pub fn save(&self) -> SavedState {
        let constraints = self.system.constraints.iter();
        SavedState {
            state: self.state.clone(),
            accelerations: self.accelerations.clone(),
            multipliers: self.multipliers[..self.system.first_shared()].to_vec(),
            shared: self.multipliers[self.system.first_shared()..].to_vec(),
            scales: self.scales,
            bristle_past: self.bristle_past.clone(),
            bristle_gamma: self.bristle_gamma,
            history: self.system.history.clone(),
            in_force: constraints.map(|c| c.row.is_some()).collect(),
            statics: self.system.is_static(),
        }
    }

    /// Goes on from what was saved of an assembled simulation of this model. The model may have
    /// further measures and algebraic variables: angles then count from their principal values,
    /// variables start as the model says. The counts of work go on.
    ///
    /// # Errors
    /// [`ForeignState`] where the sizes are those of another model; nothing has changed then.
    pub fn restore(&mut self, model: Model, saved: &SavedState) -> Result<(), ForeignState> {
        let mut system = System::new(model);
        if saved.in_force.len() != system.constraints.len() {
            return Err(ForeignState);
        }
        system.set_active(&saved.in_force);
        if !saved.fits(&system) {
            return Err(ForeignState);
        }
        system.history.clone_from(&saved.history);
        system
            .history
            .angles
            .resize(system.model().measures.len(), 0.0);
        system.set_statics(saved.statics);
        system.set_bristles(&saved.bristle_past, saved.bristle_gamma);
        let mut multipliers = saved.multipliers.clone();
        let known = multipliers.len() - system.row_count();
        let others = &system.model().algebraics[known..];
        multipliers.extend(others.iter().map(|variable| variable.start));
        system.set_solution(&saved.accelerations, 1.0, &multipliers);
        system.evaluate(&saved.state, false);
        system.share_reactions();
        multipliers.extend_from_slice(&saved.shared);
        multipliers.resize(system.multiplier_count(), 0.0);
        system.remember_angles_from(saved.history.angles.len());
        *self = Self {
            system,
            state: saved.state.clone(),
            accelerations: saved.accelerations.clone(),
            multipliers,
            scales: saved.scales,
            statistics: self.statistics,
            bristle_past: saved.bristle_past.clone(),
            bristle_gamma: saved.bristle_gamma,
            slidings: std::mem::take(&mut self.slidings),
            engine: None,
        };
        Ok(())
    }
}
