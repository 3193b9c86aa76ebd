//! Error estimates, and the step size and order that follow from them.

use super::adams::error_integral;
use super::{Bdf, Family, System};

/// Error that shows that the past does not go on as its polynomial does: the step was chosen for a part of
/// the tolerance.
const BENT: f64 = 10.0;
/// Power of the step that such an error is taken to fall with: that of velocities where forces kink is two,
/// and more where they bend smoothly.
const BEND_POWER: f64 = 3.0;
/// The least power that two errors are taken to show. What falls by less is not the error of a bend, and
/// steps by it would magnify rounding.
const LEAST_POWER: f64 = 2.0;
/// How much shorter a step becomes after it was rejected.
const SHORTER: [f64; 2] = [0.05, 0.9];

/// How step and order follow from the errors.
#[derive(Clone, Copy)]
struct Control {
    /// What an error is multiplied with before the step size is chosen by it.
    margin: f64,
    /// Growth of the step that is worth a change of the formula.
    worth: f64,
    /// Part of the past that is taken at one order and size before the step grows.
    settled: f64,
}

impl Family {
    const fn control(self) -> Control {
        match self {
            // With a step that often changes these formulas lose stability.
            Self::BackwardDifferences | Self::Newmark(_) => Control {
                margin: 2.0,
                worth: 1.3,
                settled: 1.0,
            },
            // The high differences of slopes change by more from step to step. CVODE has the same
            // margin (Cohen and Hindmarsh, *CVODE, a stiff/nonstiff ODE solver in C*, Computers in
            // Physics 10, 1996).
            Self::Adams => Control {
                margin: 6.0,
                worth: 1.2,
                settled: 0.5,
            },
        }
    }
}

/// An attempt at a step that the error test has rejected.
#[derive(Clone, Copy)]
pub(super) struct Rejected {
    pub(super) error: f64,
    pub(super) size: f64,
}

impl Rejected {
    /// Size of the next attempt, of the formula of order `k`.
    ///
    /// Where the solution bends within the step its error does not fall with the power `k + 1` of the
    /// step, and a step chosen by that is rejected again and again. From the second attempt on the power
    /// is that which the errors show (K. Gustafsson, *Control theoretic techniques for stepsize selection
    /// in explicit Runge-Kutta methods*, ACM Transactions on Mathematical Software 17, 1991).
    fn next_size(&self, before: Option<Self>, k: usize, margin: f64) -> f64 {
        let smooth = (k + 1) as f64;
        let power = match before {
            Some(before) => {
                let seen = (self.error / before.error).ln() / (self.size / before.size).ln();
                seen.clamp(LEAST_POWER, smooth)
            }
            None if self.error > BENT => smooth.min(BEND_POWER),
            None => smooth,
        };
        let [least, most] = SHORTER;
        // Of what is not a number nothing is known but that the step is too long.
        let shorter = (margin * self.error).powf(-1.0 / power).max(least);
        self.size * shorter.min(most)
    }
}

/// Error estimate at an order, and the step size that would just pass with a margin.
#[derive(Clone, Copy)]
pub(super) struct Estimate {
    pub(super) error: f64,
    pub(super) size: f64,
}

impl Bdf {
    /// Step and order for the attempt after one at the order `k`, where there was one `before`.
    pub(super) fn shorten(&mut self, rejected: Rejected, before: Option<Rejected>, k: usize) {
        self.starting = false;
        if before.is_some() {
            self.lower_order();
        }
        let margin = self.settings.family.control().margin;
        self.size = rejected.next_size(before, k, margin);
    }

    pub(super) fn lower_order(&mut self) {
        if self.order > 1 {
            self.order -= 1;
            self.steps_at_order = 0;
        }
    }

    /// Error that the formula of order `k` would have made.
    pub(super) fn estimate<S: System>(
        &mut self,
        system: &mut S,
        predictor: usize,
        k: usize,
        time: f64,
        size: f64,
    ) -> Estimate {
        let error = match self.settings.family {
            Family::BackwardDifferences => self.backward_error(system, predictor, k, time),
            Family::Adams => self.adams_error(system, predictor, k, time),
            Family::Newmark(_) => system.norm(&self.error),
        };
        // Never more than a factor of ten per step.
        let size = size
            * (self.settings.family.control().margin * error)
                .max(1e-12)
                .powf(-1.0 / (k + 1) as f64)
                .min(10.0);
        Estimate { error, size }
    }

    /// Error of backward differences, from the difference between the new value and the extrapolation
    /// through `k + 1` past nodes.
    ///
    /// The local error is `y − p_k` times `γ_k / (t − t_k)`: both are the same divided difference
    /// of order `k + 1`, multiplied by `Π_{i≤k}(t − t_i)` in one and by `γ_k Π_{i<k}(t − t_i)` in
    /// the other.
    fn backward_error<S: System>(
        &mut self,
        system: &mut S,
        predictor: usize,
        k: usize,
        time: f64,
    ) -> f64 {
        let constant = self.values.gamma(k, time) / (time - self.values.node(k));
        if k == predictor {
            return constant * system.norm(&self.error);
        }
        let (j, sign) = if k < predictor {
            (predictor, 1.0)
        } else {
            (k, -1.0)
        };
        let weight = sign * self.values.product(j, time);
        let difference = self.values.difference(j);
        for ((n, e), d) in self.neighbour.iter_mut().zip(&self.error).zip(difference) {
            *n = e + weight * d;
        }
        constant * system.norm(&self.neighbour)
    }

    /// Error of the formula of Adams and Moulton of order `k`: the divided difference of order `k` of
    /// the slopes times its `error_integral`.
    fn adams_error<S: System>(
        &mut self,
        system: &mut S,
        predictor: usize,
        k: usize,
        time: f64,
    ) -> f64 {
        let constant = error_integral(self.slopes.nodes(), k, time);
        let (scale, j, weight) = if k == predictor {
            (constant, 0, 0.0)
        } else if k < predictor {
            (constant * (time - self.slopes.node(k)), k, constant)
        } else {
            let span = time - self.slopes.node(predictor);
            (constant / span, predictor, -constant / span)
        };
        let difference = self.slopes.difference(j);
        for ((n, e), d) in self.neighbour.iter_mut().zip(&self.error).zip(difference) {
            *n = scale * e + weight * d;
        }
        system.norm(&self.neighbour)
    }

    /// Step and order for the next step, after an accepted one.
    pub(super) fn choose(
        &mut self,
        size: f64,
        predictor: usize,
        below: Option<Estimate>,
        here: Estimate,
        above: Option<Estimate>,
    ) {
        self.steps_at_order += 1;
        if self.starting {
            let falling = below.is_none_or(|below| here.error < below.error);
            let growth = here.size / size;
            if growth > 1.0 && falling {
                // The error of a start is that of its first formulas: grow while it allows.
                let largest = if self.known_orders() < 3 { 8.0 } else { 2.0 };
                self.size = size * growth.min(largest);
                if predictor == self.order
                    && self.order < self.highest_order()
                    && self.known_orders() > self.order
                {
                    self.order += 1;
                    self.steps_at_order = 0;
                }
                return;
            }
            self.starting = false;
        }
        self.size = size;
        let lower = below.filter(|below| below.error <= here.error || below.size > 1.2 * here.size);
        if let Some(below) = lower {
            self.lower_order();
            self.resize(below.size / size);
            return;
        }
        let settled = self.settings.family.control().settled * self.order as f64;
        if self.steps_at_order as f64 <= settled {
            // Raising waits until the past was taken at this order and size; shrinking does not.
            self.resize((here.size / size).min(1.0));
            return;
        }
        if let Some(above) = above.filter(|above| above.size > 1.2 * here.size) {
            self.order += 1;
            self.steps_at_order = 0;
            self.resize(above.size / size);
            return;
        }
        self.resize(here.size / size);
    }

    /// Changes the step only when it pays: a kept size keeps the factorisation.
    fn resize(&mut self, ratio: f64) {
        let ratio = if ratio >= self.settings.family.control().worth {
            self.steps_at_order = 0;
            ratio.min(2.0)
        } else if ratio < 0.95 {
            ratio.max(0.3)
        } else {
            1.0
        };
        self.size *= ratio;
    }
}
