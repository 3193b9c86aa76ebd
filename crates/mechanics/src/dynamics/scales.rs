//! What counts as one in the error test, whatever the units.

use serde::{Deserialize, Serialize};

use crate::state::State;
use crate::system::{System, Units};

/// Magnitude below which a differential state counts as small, in its own unit, unless its function
/// shows that it stays smaller,
pub(super) const SMALLEST_STATE: f64 = 1e-6;
/// then this part of what it may become.
const SMALL: f64 = 1e-3;
/// Times at which the function of a state is looked at.
const SAMPLES: usize = 16;

/// Scales that make the error test independent of the choice of units.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Scales {
    /// Typical length.
    pub(crate) length: f64,
    /// Largest rate so far, at least one per second: velocities count relative to it.
    pub(crate) rate: f64,
}

impl Scales {
    /// Raises the rate to that of the velocities.
    pub(crate) fn observe(&mut self, velocities: &[f64]) {
        self.rate = self.rate.max(self.largest(velocities));
    }

    /// The largest of the motions of bodies, six numbers each, in units of the typical length and of
    /// radians.
    pub(super) fn largest(&self, motions: &[f64]) -> f64 {
        let [mut moved, mut turned] = [[0.0_f64; 3]; 2];
        for motion in motions.as_chunks::<6>().0 {
            for k in 0..3 {
                moved[k] = larger(moved[k], motion[k].abs());
                turned[k] = larger(turned[k], motion[3 + k].abs());
            }
        }
        let largest = |of: [f64; 3]| larger(larger(of[0], of[1]), of[2]);
        larger(largest(moved) / self.length, largest(turned))
    }

    /// Magnitudes below which the differential states of `state` count as small until `end`.
    pub(super) fn small_states(&self, system: &mut System, state: &State, end: f64) -> Vec<f64> {
        let values: Vec<f64> = state.states().iter().map(|y| y.abs()).collect();
        let units = Units {
            length: self.length,
            rate: self.rate,
            states: &values,
        };
        let span = end - state.time;
        let mut rates = system.state_units(&units);
        let mut functions = vec![0.0; rates.len()];
        for sample in 0..=SAMPLES {
            system.set_time(state.time + span * sample as f64 / SAMPLES as f64);
            system.state_functions(&mut functions);
            raise(&mut rates, &functions);
        }
        system.set_time(state.time);
        let small = |(rate, value): (f64, &f64)| {
            let reach = SMALL * (value + rate * span);
            if reach > 0.0 {
                reach.min(SMALLEST_STATE)
            } else {
                SMALLEST_STATE
            }
        };
        rates.into_iter().zip(&values).map(small).collect()
    }
}

/// The larger of two numbers, by one instruction.
fn larger(most: f64, value: f64) -> f64 {
    if value > most { value } else { most }
}

/// Raises scales to the magnitudes of values.
pub(super) fn raise(scales: &mut [f64], values: &[f64]) {
    for (scale, value) in scales.iter_mut().zip(values) {
        *scale = scale.max(value.abs());
    }
}
