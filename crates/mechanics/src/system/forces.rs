//! The right-hand side of the equations of motion: inertia and the sum of all forces.

use nalgebra::Vector3;

use super::System;
use super::single_force::{Frames, direction};
use crate::equation::Local;
use crate::model::{Element, Form, SingleForce};

impl System {
    /// `M w` in ground axes: mass and inertia times six numbers a body, then the differential states,
    /// whose mass is one, or zero where an implicit function determines the rate.
    pub(crate) fn mass_times(&self, w: &[f64], out: &mut [f64]) {
        for (place, frame) in self.bodies.iter().enumerate() {
            let w = &w[6 * place..6 * place + 6];
            let out = &mut out[6 * place..6 * place + 6];
            for k in 0..3 {
                out[k] = frame.mass * w[k];
            }
            let turn = frame.inertia * Vector3::new(w[3], w[4], w[5]);
            out[3..].copy_from_slice(turn.as_slice());
        }
        let first = self.velocity_count();
        for (place, state) in self.model.states.iter().enumerate() {
            out[first + place] = match state.form {
                Form::Explicit => w[first + place],
                Form::Implicit => 0.0,
            };
        }
    }

    /// Sum of all forces `Q + f + Gᵀλ` at the state evaluated last, then the functions of the
    /// differential states.
    pub(crate) fn forces(&mut self, multipliers: &[f64], out: &mut [f64]) {
        for (place, frame) in self.bodies.iter().enumerate() {
            let weight = frame.mass * self.model.gravity;
            let gyroscopic = -frame.omega.cross(&(frame.inertia * frame.omega));
            out[6 * place..6 * place + 3].copy_from_slice(weight.as_slice());
            out[6 * place + 3..6 * place + 6].copy_from_slice(gyroscopic.as_slice());
        }
        for (row, &place) in self.rows.iter().enumerate() {
            let evaluated = &self.evaluated[place];
            for (body, block) in evaluated.blocks(&self.constraints[place]) {
                for k in 0..6 {
                    out[6 * body + k] += multipliers[row] * block[k];
                }
            }
        }
        for place in 0..self.model.forces.len() {
            if !self.model.is_active(Element::Force(place)) {
                continue;
            }
            let value = self.force_value(place);
            let frames = self.force_frames(&self.model.forces[place]);
            let direction = direction(self.model.forces[place].kind, &frames);
            self.add_local(&frames.sides(), &(value * direction), out);
        }
        for place in 0..self.model.frictions.len() {
            if !self.friction_acts(place) {
                continue;
            }
            let sides = self.friction_frames(place).map(|frame| frame.body);
            let element = self.friction(place, multipliers);
            self.add_local(&sides, &element.force, out);
        }
        let first = self.velocity_count();
        self.state_functions(&mut out[first..]);
    }

    fn add_local(&self, sides: &[Option<usize>; 2], local: &Local, out: &mut [f64]) {
        for (side, body) in sides.iter().enumerate() {
            if let Some(body) = *body {
                let count = if self.model.bodies[body].rotates {
                    6
                } else {
                    3
                };
                for k in 0..count {
                    out[6 * body + k] += local[6 * side + k];
                }
            }
        }
    }

    pub(super) fn force_frames(&self, force: &SingleForce) -> Frames<'_> {
        Frames {
            i: self.frame(force.i),
            j: self.frame(force.j),
            frame: self.frame(force.frame()),
        }
    }

    /// Value of a single-component force at the state evaluated last.
    pub(crate) fn force_value(&mut self, place: usize) -> f64 {
        self.model.forces[place]
            .function
            .evaluate(&mut self.registers, |input| self.inputs.read(input))
    }

    /// Names the force whose function has a slope that is not finite.
    pub(crate) fn find_infinite_slope(&mut self) -> Option<crate::model::Label> {
        for place in 0..self.model.forces.len() {
            self.force_value(place);
            let force = &self.model.forces[place];
            let mut finite = true;
            let slopes = &mut self.adjoints;
            force
                .function
                .gradient(&self.registers, slopes, |_, slope| {
                    finite &= slope.is_finite();
                });
            if !finite {
                return Some(force.label.clone());
            }
        }
        None
    }

    /// Generalised force of a single-component force of one unit, for outputs.
    pub(crate) fn force_direction(&self, force: &SingleForce) -> Local {
        direction(force.kind, &self.force_frames(force))
    }
}
