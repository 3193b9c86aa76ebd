//! Variable-order, variable-step backward differentiation for implicit systems.
//!
//! The method of order `k` replaces `ẏ(t)` at the new time by the slope of the polynomial through
//! the new value and the `k` values before it. With variable coefficients (Brayton, Gustavson,
//! Hachtel 1972; Brenan, Campbell, Petzold, *Numerical Solution of Initial-Value Problems in
//! DAEs*, section 5.2) that slope is `(y − ŷ)/γ` with
//!
//! ```text
//! 1/γ = Σ_{i=1..k} 1/(t − t_{n−i}),     ŷ = w(t) − γ ẇ(t),
//! ```
//!
//! where `w` is the polynomial through the `k` past values alone. The caller solves its own
//! equations for `y` ([`System::solve`]); this module keeps the past ([`History`]), predicts,
//! estimates the error and chooses step and order ([`Bdf`]).

use serde::{Deserialize, Serialize};
use std::ops::Range;

mod adams;
mod control;
mod formulas;
mod history;
mod integrator;
#[cfg(test)]
mod integrator_test;

pub use history::History;
pub use integrator::{Bdf, Error, Settings, Statistics};

/// A family of formulas.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Family {
    /// Backward differentiation, orders 1 to 5, for stiff equations; beyond 5 they are hardly
    /// stable.
    BackwardDifferences,
    /// Adams and Moulton, orders 1 to 12, for smooth equations that are not stiff.
    Adams,
    /// Newmark, of second order.
    Newmark(Newmark),
}

/// Coefficients of Newmark's formulas.
///
/// ```text
/// x = x₀ + h u₀ + h² ((½ − β) a₀ + β a),     u = u₀ + h ((1 − γ) a₀ + γ a)
/// ```
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Newmark {
    /// β.
    pub beta: f64,
    /// γ.
    pub gamma: f64,
    /// Local error of the positions as a part of what they differ from their prediction with
    /// `a = a₀`.
    pub error: f64,
    /// Local error of all other values as such a part.
    pub slope_error: f64,
}

impl Family {
    /// The highest order of the formulas.
    #[must_use]
    pub const fn highest_order(self) -> usize {
        match self {
            Self::BackwardDifferences => 5,
            Self::Adams => 12,
            Self::Newmark(_) => 2,
        }
    }
}

/// One attempted step, as the system sees it.
#[derive(Clone, Copy, Debug)]
pub struct Step<'a> {
    /// Time at the end of the step.
    pub time: f64,
    /// Length of the step.
    pub size: f64,
    /// Order of the formula.
    pub order: usize,
    /// `ẏ = (y − history)/gamma` at the end of the step.
    pub gamma: f64,
    /// The same factor for the values in [`System::positions`]; another one with the formulas of
    /// Newmark only.
    pub position_gamma: f64,
    /// The part `ŷ` of the formula that the past determines.
    pub history: &'a [f64],
    /// Extrapolation of the past to the end of the step: the first guess.
    pub prediction: &'a [f64],
}

impl Step<'_> {
    /// Writes the slope `(y − history)/gamma` that the formula gives at the end of the step.
    pub fn write_slope(&self, y: &[f64], slope: &mut [f64]) {
        for ((slope, y), past) in slope.iter_mut().zip(y).zip(self.history) {
            *slope = (y - past) / self.gamma;
        }
    }
}

/// Values at a time within a step, written to a slice of their number.
pub type Within<'a> = &'a mut dyn FnMut(f64, &mut [f64]);

/// What becomes of a step that passed the error test.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Verdict {
    /// It is accepted.
    Accept,
    /// It is solved again to end at this time, which is within it or its end.
    EndAt(f64),
    /// It is not taken: the system starts anew from where the step began.
    Abandon,
}

/// Equations that the integrator steps through time.
pub trait System {
    /// Why a step could not be solved.
    type Failure;

    /// Finds `y` at the end of `step`; on entry `y` is the prediction.
    ///
    /// # Errors
    /// When the equations could not be solved; the integrator then tries a smaller step.
    fn solve(&mut self, step: &Step<'_>, y: &mut [f64]) -> Result<(), Self::Failure>;

    /// Size of `difference` (between two values of `y`) in units of the error tolerance: at most
    /// one is acceptable. Components that must not take part in the error test count nothing.
    fn norm(&mut self, difference: &[f64]) -> f64;

    /// Writes the slope `ẏ` at the solved end `y` of `step`, for formulas that go on from slopes.
    fn slope(&self, step: &Step<'_>, y: &[f64], slope: &mut [f64]) {
        step.write_slope(y, slope);
    }

    /// Places of values whose slopes have slopes of their own, which the formulas of Newmark use.
    fn positions(&self) -> Range<usize> {
        0..0
    }

    /// Writes the second derivatives of those values to their places.
    fn curvature(&self, _: &[f64], _slope: &[f64], _curvature: &mut [f64]) {}

    /// Looks at a step that passed the error test, before it is accepted. `within(t, out)` gives the
    /// values at a time within the step, to its order.
    ///
    /// Functions that jump are smooth within a step that keeps to one side of the jump; where the
    /// step has gone over it, it must end there (Hairer, Nørsett, Wanner, *Solving Ordinary
    /// Differential Equations I*, section II.6).
    fn judge(&mut self, _: &Step<'_>, _: &[f64], _within: Within<'_>) -> Verdict {
        Verdict::Accept
    }

    /// Told once for every step that passed the error test.
    fn accepted(&mut self, step: &Step<'_>, y: &[f64]);
}
