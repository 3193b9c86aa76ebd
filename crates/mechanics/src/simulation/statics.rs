//! Equilibria of a model that is run through time.

use super::{RunError, Simulation};
use crate::equilibrium::{EquilibriumReport, EquilibriumSettings, Statics};
use crate::instant::{Failure, Instant};

impl Simulation {
    /// Moves the model to an equilibrium at `time`, not before that of the state; forces and motions
    /// are taken at that time. The velocities are then zero, creep is carried on.
    ///
    /// # Errors
    /// [`RunError`] where none is found, naming the frictions that hold no more; the model is then
    /// as it was.
    pub fn find_equilibrium(
        &mut self,
        time: f64,
        settings: &EquilibriumSettings,
    ) -> Result<EquilibriumReport, RunError> {
        let (kept, history) = (self.state.clone(), self.system.history.clone());
        let reactions = self.multipliers.clone();
        self.state.time = time;
        self.state.velocities_mut().fill(0.0);
        self.freeze_bristles();
        self.system.evaluate(&self.state, false);
        self.system.stick_all();
        // Reactions to start from: without them no joint has a load, and no friction holds. Where
        // they cannot be found they stay what they were.
        let guess = Instant::new(&self.system).accelerations(
            &mut self.system,
            &self.state,
            &mut self.accelerations,
            &mut self.multipliers,
        );
        if guess.is_err() {
            self.multipliers.clone_from(&reactions);
        }
        self.system.set_statics(true);
        let solved = Statics::new(&self.system).solve(
            &mut self.system,
            &mut self.state,
            &mut self.multipliers,
            settings,
            self.scales.length,
        );
        match solved {
            Ok(report) => {
                self.system.take_frictions(&self.multipliers);
                self.system.accept_frictions();
                self.system.remember_angles();
                self.accelerations.fill(0.0);
                Ok(report)
            }
            Err(failure) => {
                let mut error = self.error(&failure);
                if matches!(failure, Failure::NoEquilibrium { .. }) {
                    let causes = self.system.explain_no_equilibrium(&self.multipliers);
                    error.message = format!("{}; {causes}", error.message);
                }
                self.state = kept;
                self.system.history = history;
                self.multipliers = reactions;
                self.system.set_statics(false);
                self.system.evaluate(&self.state, false);
                Err(error)
            }
        }
    }
}
