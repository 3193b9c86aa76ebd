//! What functions read, and the columns of the Newton matrix that it stands for.

use super::System;
use super::newton_matrix::Weights;
use crate::expression::Input;
use serde::{Deserialize, Serialize};

/// Values that functions read, as they were set last.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct Inputs {
    pub(super) time: f64,
    pub(super) measures: Vec<f64>,
    pub(super) states: Vec<f64>,
    /// Rates of velocities, then of states; kept only where system elements may read them.
    pub(super) rates: Vec<f64>,
    pub(super) algebraics: Vec<f64>,
}

impl Inputs {
    pub(super) fn read(&self, input: Input) -> f64 {
        match input {
            Input::Time => self.time,
            Input::Measure(measure) => self.measures[measure],
            Input::State(state) => self.states[state],
            Input::StateRate(state) => self.rates[self.rates.len() - self.states.len() + state],
            Input::Algebraic(variable) => self.algebraics[variable],
            // The value would not be known yet: only outputs read it.
            Input::Result(_) => f64::NAN,
        }
    }
}

impl System {
    /// Takes over rates (`scale` times `change`: accelerations, then rates of states) and algebraic
    /// variables (behind the multipliers), which functions read until they are set anew.
    pub(crate) fn set_solution(&mut self, change: &[f64], scale: f64, multipliers: &[f64]) {
        if !self.has_elements() {
            return;
        }
        for (rate, change) in self.inputs.rates.iter_mut().zip(change) {
            *rate = scale * change;
        }
        let algebraics = &multipliers[self.rows.len()..self.first_shared()];
        self.inputs.algebraics.copy_from_slice(algebraics);
    }

    /// Calls `add(column, slope)` for every column of the Newton matrix that an input stands for.
    pub(super) fn columns(
        &self,
        input: Input,
        slope: f64,
        weights: &Weights,
        mut add: impl FnMut(usize, f64),
    ) {
        match input {
            Input::Measure(measure) => {
                let motions = self.measure_bodies[measure]
                    .iter()
                    .zip(&self.measure_slopes[measure]);
                for (&body, slopes) in motions {
                    for k in 0..6 {
                        let change = slope
                            * (weights.position * slopes[k] + weights.velocity * slopes[6 + k]);
                        add(6 * body + k, change);
                    }
                }
            }
            Input::State(state) => add(self.velocity_count() + state, slope * weights.state),
            Input::StateRate(state) => add(self.velocity_count() + state, slope * weights.rate),
            Input::Algebraic(variable) => {
                add(self.rate_count() + self.row_count() + variable, slope);
            }
            Input::Time | Input::Result(_) => {}
        }
    }
}
