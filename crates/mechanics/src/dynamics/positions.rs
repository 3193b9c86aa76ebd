//! Positions and velocities of a step from one another, by the integrator's formula.

use nalgebra::Vector3;
use numerics::bdf;

use super::Dynamics;
use crate::instant::Failure;
use crate::model::Level;
use crate::rotation::Quaternion;
use crate::state::{POSITIONS, VELOCITIES};

impl Dynamics {
    /// Positions from velocities: `x = x̂ + γ u + ν`.
    pub(super) fn positions_from_velocities(
        &mut self,
        step: &bdf::Step<'_>,
    ) -> Result<(), Failure> {
        let bodies = self.system.model.bodies.len();
        for body in 0..bodies {
            let place = POSITIONS * body;
            let first = VELOCITIES * body;
            for k in 0..3 {
                self.state.values[place + k] = step.history[place + k]
                    + step.position_gamma * self.state.velocities()[first + k]
                    + self.shift[first + k];
            }
            let past = Quaternion::from_slice(&step.history[place + 3..place + POSITIONS]);
            let omega = Vector3::from_column_slice(&self.state.velocities()[first + 3..first + 6]);
            let half = 0.5 * step.position_gamma * omega;
            let norm = past.norm_squared();
            let scalar = norm - half.norm_squared();
            if !(scalar > 0.25 * norm) {
                return Err(Failure::TurnsTooFar { body });
            }
            let turned = Quaternion {
                w: scalar.sqrt(),
                v: half,
            }
            .times(&past);
            let shift = Vector3::from_column_slice(&self.shift[first + 3..first + 6]);
            let q = Quaternion::exp(&shift).times(&turned).normalized();
            q.write(&mut self.state.values[place + 3..place + POSITIONS]);
        }
        Ok(())
    }

    /// Velocities from positions: the formula itself.
    pub(super) fn velocities_from_positions(&mut self, step: &bdf::Step<'_>) {
        let bodies = self.system.model.bodies.len();
        for body in 0..bodies {
            let place = POSITIONS * body;
            let q = self.state.orientation(body);
            let past = Quaternion::from_slice(&step.history[place + 3..place + POSITIONS]);
            let back = Quaternion { w: q.w, v: -q.v };
            let omega = (-2.0 / step.position_gamma) * past.times(&back).v;
            let velocity = (self.state.centre(body)
                - Vector3::from_column_slice(&step.history[place..place + 3]))
                / step.position_gamma;
            let u = &mut self.state.velocities_mut()[VELOCITIES * body..VELOCITIES * (body + 1)];
            u[..3].copy_from_slice(velocity.as_slice());
            u[3..].copy_from_slice(omega.as_slice());
        }
    }

    /// Corrects the positions where the velocities' correction leaves `g(x) ≠ 0`.
    pub(super) fn correct_positions(&mut self, gamma: f64) {
        let n = self.system.rate_count();
        self.position_right.fill(0.0);
        for (row, &place) in self.system.rows.iter().enumerate() {
            let evaluated = &self.system.evaluated[place];
            let constraint = &self.system.constraints[place];
            let moved = gamma * evaluated.rate_of(constraint, &self.right[..n]);
            self.position_right[n + row] = if self.system.levels[row] == Level::Position {
                -evaluated.error - moved
            } else {
                0.0
            };
        }
        self.kept_axes.bring_back(&mut self.position_right[n..]);
        self.factors.solve(&mut self.position_right);
    }
}
