//! What depends on time and state alone: frames, measures, constraint equations.

use super::System;
use crate::constraint::{Constraint, Evaluated, Owner};
use crate::expression::Input;
use crate::measure::{self, Measure, Order, Quantity};
use crate::model::Level;
use crate::scalar::Jet;
use crate::state::{MarkerFrame, State};

impl System {
    /// Frames of the markers of a measure that the equations read.
    fn measure_frames(&self, measure: usize) -> [&MarkerFrame; 4] {
        let markers = self.model.measures[measure].markers();
        markers.map(|marker| self.frame(marker))
    }

    /// Value of a measure of displacement or velocity; rotations are continuous over many turns.
    pub(crate) fn measure_value(&self, place: usize) -> f64 {
        let Measure { quantity, .. } = self.model.measures[place];
        let value = if self.needed[place] {
            measure::value(quantity, self.measure_frames(place))
        } else {
            let markers = self.model.measures[place].markers();
            let frames = markers.map(|marker| self.marker(marker));
            measure::value(quantity, frames.each_ref())
        };
        match quantity {
            Quantity::Rotation(_) => nearest_turn(value, self.history.angles[place]),
            _ => value,
        }
    }

    /// Brings positions, constraints and measures up to date with `state`; with `derivatives` also
    /// what [`System::assemble`] needs.
    pub(crate) fn evaluate(&mut self, state: &State, derivatives: bool) {
        self.inputs.time = state.time;
        self.inputs.states.copy_from_slice(state.states());
        for (place, body) in self.bodies.iter_mut().enumerate() {
            body.update(state, place, &self.model.bodies[place]);
        }
        self.update_markers();
        for place in 0..self.model.measures.len() {
            let order = self.model.measures[place].quantity.order();
            if self.needed[place] && order != Order::Acceleration {
                self.inputs.measures[place] = self.measure_value(place);
            }
        }
        if derivatives || !self.functions.is_empty() {
            self.evaluate_slopes();
        }
        for group in 0..self.pairs.len() {
            self.evaluate_pairs(group);
        }
        for k in 0..self.functions.len() {
            self.evaluate_function(self.functions[k]);
        }
    }

    /// Writes, for every row, what the velocities lack of the rate that its constraint prescribes; zero
    /// where it prescribes accelerations only.
    pub(crate) fn velocity_lacks(&self, velocities: &[f64], lacks: &mut [f64]) {
        let rows = self.rows.iter().zip(&self.levels);
        for (lack, (&place, &level)) in lacks.iter_mut().zip(rows) {
            let (evaluated, constraint) = (&self.evaluated[place], &self.constraints[place]);
            *lack = if level == Level::Acceleration {
                0.0
            } else {
                evaluated.rate - evaluated.rate_of(constraint, velocities)
            };
        }
    }

    /// Slopes of the measures by the motions of the bodies, at the instant evaluated last.
    pub(crate) fn evaluate_slopes(&mut self) {
        for place in 0..self.model.measures.len() {
            let quantity = self.model.measures[place].quantity;
            if !self.needed[place] || quantity.order() == Order::Acceleration {
                continue;
            }
            let markers = self.model.measures[place].markers();
            let frames = markers.map(|marker| self.markers.get(marker));
            for (&body, slopes) in self.measure_bodies[place]
                .iter()
                .zip(&mut self.measure_slopes[place])
            {
                *slopes = measure::slopes(quantity, frames, body);
                if !self.model.bodies[body].rotates {
                    slopes[3..6].fill(0.0);
                    slopes[9..12].fill(0.0);
                }
            }
        }
    }

    /// A general constraint: value and gradient by measures, rates along the motion by jets.
    pub(crate) fn evaluate_function(&mut self, place: usize) {
        let Owner::General(general) = self.constraints[place].owner else {
            return;
        };
        let function = &self.model.constraints[general].function;
        let inputs = &self.inputs;
        let value = function.evaluate(&mut self.registers, |input| inputs.read(input));
        let evaluated = &mut self.evaluated[place];
        evaluated.error = value;
        for block in &mut evaluated.jacobian {
            block.fill(0.0);
        }
        let bodies = &self.constraints[place].bodies;
        function.gradient(&self.registers, &mut self.adjoints, |input, slope| {
            if let Input::Measure(measure) = input {
                let motions = self.measure_bodies[measure]
                    .iter()
                    .zip(&self.measure_slopes[measure]);
                for (body, slopes) in motions {
                    if let Ok(block) = bodies.binary_search(body) {
                        for k in 0..6 {
                            evaluated.jacobian[block][k] += slope * slopes[k];
                        }
                    }
                }
            }
        });
        let model = &self.model;
        let frames = &self.markers;
        let jet = function.run(&mut self.jets, |input| match input {
            Input::Measure(measure) => {
                let at = model.measures[measure].markers().map(|m| frames.get(m));
                let mut jet = measure::jet(model.measures[measure].quantity, at);
                jet.value = inputs.measures[measure];
                jet
            }
            Input::Time => Jet {
                value: inputs.time,
                rate: 1.0,
                acceleration: 0.0,
            },
            // Constraints read displacements and time only.
            Input::State(_) | Input::StateRate(_) | Input::Algebraic(_) | Input::Result(_) => Jet {
                value: f64::NAN,
                rate: 0.0,
                acceleration: 0.0,
            },
        });
        // G u + ∂g/∂t is the rate of the jet; what remains beside G u is prescribed.
        let along = self.rate_along(&self.constraints[place], &self.evaluated[place]);
        let evaluated = &mut self.evaluated[place];
        evaluated.rate = along - jet.rate;
        evaluated.unbiased_acceleration = -jet.acceleration;
    }

    /// `G u` with the velocities of the bodies as they were evaluated last.
    pub(crate) fn rate_along(&self, constraint: &Constraint, evaluated: &Evaluated) -> f64 {
        evaluated
            .blocks(constraint)
            .map(|(body, row)| {
                let frame = &self.bodies[body];
                (0..3)
                    .map(|k| row[k] * frame.velocity[k] + row[3 + k] * frame.omega[k])
                    .sum::<f64>()
            })
            .sum()
    }
}

/// `value` plus the whole turns that bring it closest to `reference`.
pub(super) fn nearest_turn(value: f64, reference: f64) -> f64 {
    let turn = std::f64::consts::TAU;
    value + turn * ((reference - value) / turn).round()
}
