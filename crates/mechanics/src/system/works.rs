//! The rates at which friction, forces and motions do work.

use super::System;
use super::single_force::direction;
use crate::constraint::Owner;
use crate::equation::Pair;
use crate::model::{Element, Level};

impl System {
    /// Number of works that are integrated: one by friction, that of forces, that of motions.
    #[must_use]
    pub fn work_count(&self) -> usize {
        self.model.frictions.len() + 2
    }

    /// Powers at the instant that frictions were taken at: what each friction takes out, then what forces
    /// and what motions (and general constraints that move with time) put in. Weight has its energy
    /// instead.
    pub(crate) fn write_powers(&mut self, multipliers: &[f64], powers: &mut [f64]) {
        let frictions = self.model.frictions.len();
        for (power, end) in powers.iter_mut().zip(&self.friction_ends) {
            *power = end.power;
        }
        let mut forces = 0.0;
        for place in 0..self.model.forces.len() {
            if !self.model.is_active(Element::Force(place)) {
                continue;
            }
            let value = self.force_value(place);
            let frames = self.force_frames(&self.model.forces[place]);
            let direction = direction(self.model.forces[place].kind, &frames);
            let velocities = Pair::new(frames.i, frames.j).velocities();
            forces += value * direction.dot(&velocities);
        }
        powers[frictions] = forces;
        let mut motions = 0.0;
        // Joints come first, and do no work.
        let of_joint = |&place: &usize| matches!(self.constraints[place].owner, Owner::Joint(_));
        let joints = self.rows.partition_point(of_joint);
        for (row, &place) in self.rows.iter().enumerate().skip(joints) {
            let (constraint, evaluated) = (&self.constraints[place], &self.evaluated[place]);
            // A motion that prescribes an acceleration has the velocity that has come of it.
            let rate = match constraint.level {
                Level::Acceleration => self.rate_along(constraint, evaluated),
                Level::Position | Level::Velocity => evaluated.rate,
            };
            motions += multipliers[row] * rate;
        }
        powers[frictions + 1] = motions;
    }
}
