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

mod history;
mod integrator;

pub use history::History;
pub use integrator::{Bdf, Error, Settings, Statistics};

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
    /// The part `ŷ` of the formula that the past determines.
    pub history: &'a [f64],
    /// Extrapolation of the past to the end of the step: the first guess.
    pub prediction: &'a [f64],
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
    fn norm(&self, difference: &[f64]) -> f64;

    /// Told once for every step that passed the error test.
    fn accepted(&mut self, step: &Step<'_>, y: &[f64]);
}
