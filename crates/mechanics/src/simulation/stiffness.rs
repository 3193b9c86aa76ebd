//! Whether steps show that the equations are too stiff for the way in which they are stepped.

use numerics::bdf::{Bdf, Family};
use serde::{Deserialize, Serialize};

/// Order up to which the formulas of Adams are stable enough for stiff equations: the trapezoidal rule is
/// for all, the formula of order three for `h λ` down to −6 (Hairer and Wanner, *Solving Ordinary
/// Differential Equations II*, section V.1).
const LOW_ORDER: usize = 3;
/// Part of the longest step below which a step is short.
const SHORT: f64 = 0.1;
/// By how many short steps of low order outnumber others where they tell. Smooth motion has left low
/// orders by then, and what starts anew again and again gains nothing from formulas of high order.
const MANY: usize = 100;
/// Steps for each of which one attempt without a solution is forgotten, and how many tell.
const STEPS_PER_FAILURE: usize = 10;
const MANY_FAILURES: usize = 100;

/// What the steps of late have shown.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(super) struct Stiffness {
    /// By how many short steps of low order have outnumbered others.
    short: usize,
    /// By how much attempts without a solution, times the steps for each, have outnumbered steps.
    unsolved: usize,
    /// Attempts without a solution until the last step.
    failures: usize,
}

impl Stiffness {
    /// Before the first step of a run.
    pub(super) fn new(bdf: &Bdf) -> Self {
        Self {
            failures: bdf.statistics().failures,
            ..Self::default()
        }
    }

    /// Counts the last step; true where the equations have shown to be stiff for what steps them.
    ///
    /// Stiff forces (bristles, stick, contacts) let the formulas of Adams take short steps of low order
    /// only, at which backward differentiation is stable whatever the step. Bristles that are not passive
    /// need not have a solution for a short step where they have one for a longer one: what shortens its
    /// steps to follow jitter, as constraints by positions alone do, then finds none again and again.
    pub(super) fn shows(&mut self, bdf: &Bdf) -> bool {
        let limits = bdf.settings();
        let is_short = bdf.last_size() < SHORT * limits.longest_step;
        if limits.family == Family::Adams && is_short && bdf.order() <= LOW_ORDER {
            self.short += 1;
        } else {
            self.short = self.short.saturating_sub(1);
        }
        let failures = bdf.statistics().failures;
        self.unsolved += STEPS_PER_FAILURE * (failures - self.failures);
        self.unsolved = self.unsolved.saturating_sub(1);
        self.failures = failures;
        self.short >= MANY || self.unsolved >= STEPS_PER_FAILURE * MANY_FAILURES
    }
}
