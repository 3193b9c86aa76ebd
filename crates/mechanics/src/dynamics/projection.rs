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
        self.factors
            .solve_two(&mut self.right, &mut self.position_right);
        self.state.displace(&self.position_right[..moving]);
        let mut largest = 0.0_f64;
        for k in 0..moving {
            self.state.velocities_mut()[k] += self.right[k];
            let unit = if k % 6 < 3 { self.scales.length } else { 1.0 };
            let moved = self.position_right[k].abs() / unit;
            largest = largest.max(moved.max(self.right[k].abs() / (unit * self.scales.rate)));
        }
        if largest > EVALUATED_ANEW * self.motion_error {
            self.system.evaluate(&self.state, false);
        }
    }
}
