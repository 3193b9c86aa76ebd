//! Whether steps are kept short by the stability of formulas and not by the motion.

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

/// By how many short steps of low order have outnumbered others of late.
#[derive(Clone, Copy, Debug, Default, Serialize, Deserialize)]
pub(super) struct Stiffness(usize);

impl Stiffness {
    /// Counts the last step; true where the formulas are those of Adams and the equations have shown to
    /// be stiff.
    ///
    /// Stiff forces (bristles that slide, stick, contacts) let formulas that are not stable for them take
    /// short steps of low order only, at which backward differentiation is stable whatever the step.
    pub(super) fn shows(&mut self, bdf: &Bdf) -> bool {
        let limits = bdf.settings();
        let short = bdf.last_size() < SHORT * limits.longest_step;
        if limits.family == Family::Adams && short && bdf.order() <= LOW_ORDER {
            self.0 += 1;
        } else {
            self.0 = self.0.saturating_sub(1);
        }
        self.0 >= MANY
    }
}
