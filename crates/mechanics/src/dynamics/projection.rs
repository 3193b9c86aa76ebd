//! The return of a step of index one to the constraints.

use super::Dynamics;

/// Corrections above this part of the tolerance need the system evaluated anew.
const EVALUATED_ANEW: f64 = 0.1;

impl Dynamics {
    /// Brings positions and velocities, at which the system is evaluated, back onto the constraints by
    /// the least change in the metric of the mass matrix (Eich 1993), to first order: what is left is
    /// of the square of the error of a step, and the next step takes it away.
    pub(super) fn return_to_constraints(&mut self) {
        let n = self.system.rate_count();
        let moving = self.system.velocity_count();
        self.position_right.fill(0.0);
        self.right.fill(0.0);
        for (row, &place) in self.system.rows.iter().enumerate() {
            self.position_right[n + row] = -self.system.evaluated[place].error;
        }
        self.system
            .velocity_lacks(self.state.velocities(), &mut self.right[n..]);
        self.kept_axes.follow(&self.system);
        for right in [&mut self.right, &mut self.position_right] {
            self.kept_axes.bring_back(&mut right[n..]);
        }
        self.factors
            .solve_two(&mut self.right, &mut self.position_right);
        self.state.displace(&self.position_right[..moving]);
        let corrections = self.state.velocities_mut().iter_mut().zip(&self.right);
        corrections.for_each(|(u, correction)| *u += correction);
        let moved = self.scales.largest(&self.position_right[..moving]);
        let changed = self.scales.largest(&self.right[..moving]) / self.scales.rate;
        let largest = moved.max(changed);
        if largest > EVALUATED_ANEW * self.motion_error {
            self.system.evaluate(&self.state, false);
        }
    }
}
