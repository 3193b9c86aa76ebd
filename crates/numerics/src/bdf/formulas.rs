//! The formulas of the families: prediction, what the error estimates come from, values within a step.

use super::adams::integrals;
use super::history::MOST_NODES;
use super::{Bdf, Family, Step, System};

/// The formula of a step: `ẏ = (y − ŷ)/γ`.
#[derive(Clone, Copy)]
pub(super) struct Formula {
    pub(super) gamma: f64,
    pub(super) position_gamma: f64,
    /// Order of the prediction, that of the formula where the past allows it.
    pub(super) predictor: usize,
}

impl Bdf {
    /// Writes formula and prediction of a step to `time` at the present order.
    pub(super) fn formulate<S: System>(&mut self, system: &S, time: f64) -> Formula {
        let order = self.order;
        match self.settings.family {
            Family::BackwardDifferences => {
                let gamma = self.values.gamma(order, time);
                let predictor = order.min(self.values.count() - 1);
                self.values.formula(order, time, gamma, &mut self.formula);
                self.values.evaluate(predictor, time, &mut self.prediction);
                Formula {
                    gamma,
                    position_gamma: gamma,
                    predictor,
                }
            }
            Family::Adams => {
                let predictor = order.min(self.slopes.count());
                let mut weights = [0.0; MOST_NODES];
                let nodes = self.slopes.nodes();
                integrals(
                    nodes,
                    [self.time(), time],
                    &mut weights[..=predictor.max(order - 1)],
                );
                self.values.evaluate(0, time, &mut self.prediction);
                self.formula.copy_from_slice(&self.prediction);
                let predicting = &weights[..predictor];
                self.slopes.add_integral(predicting, &mut self.prediction);
                let gamma = weights[order - 1] / self.slopes.product(order - 1, time);
                for (j, weight) in weights[..order - 1].iter_mut().enumerate() {
                    *weight -= gamma * self.slopes.product(j, time);
                }
                self.slopes
                    .add_integral(&weights[..order - 1], &mut self.formula);
                Formula {
                    gamma,
                    position_gamma: gamma,
                    predictor,
                }
            }
            Family::Newmark(newmark) => {
                let size = time - self.time();
                let (beta, gamma) = (newmark.beta, newmark.gamma);
                let positions = system.positions();
                let last = self.values.difference(0);
                let slopes = self.slopes.difference(0);
                for (k, (y, slope)) in last.iter().zip(slopes).enumerate() {
                    self.prediction[k] = y + size * slope;
                    self.formula[k] = y + size * (1.0 - gamma) * slope;
                    if positions.contains(&k) {
                        let bend = size * size * self.curvature[k];
                        self.prediction[k] += 0.5 * bend;
                        self.formula[k] =
                            y + size * (1.0 - beta / gamma) * slope + (0.5 - beta / gamma) * bend;
                    }
                }
                Formula {
                    gamma: gamma * size,
                    position_gamma: beta / gamma * size,
                    predictor: order,
                }
            }
        }
    }

    /// Takes what the error estimates come from at the value that the step was solved for.
    pub(super) fn take_error<S: System>(&mut self, system: &S, formula: Formula, time: f64) {
        let step = Step {
            time,
            size: time - self.time(),
            order: self.order,
            gamma: formula.gamma,
            position_gamma: formula.position_gamma,
            history: &self.formula,
            prediction: &self.prediction,
        };
        let pairs = self.value.iter().zip(&self.prediction);
        match self.settings.family {
            Family::BackwardDifferences => {
                for (e, (v, p)) in self.error.iter_mut().zip(pairs) {
                    *e = v - p;
                }
            }
            Family::Newmark(newmark) => {
                let positions = system.positions();
                for (k, (e, (v, p))) in self.error.iter_mut().zip(pairs).enumerate() {
                    let part = if positions.contains(&k) {
                        newmark.error
                    } else {
                        newmark.slope_error
                    };
                    *e = part * (v - p);
                }
                system.slope(&step, &self.value, &mut self.slope);
            }
            Family::Adams => {
                system.slope(&step, &self.value, &mut self.slope);
                let degree = formula.predictor - 1;
                self.slopes.evaluate(degree, time, &mut self.error);
                let product = self.slopes.product(formula.predictor, time);
                for (e, slope) in self.error.iter_mut().zip(&self.slope) {
                    *e = (slope - *e) / product;
                }
            }
        }
    }

    /// Values at `t` within a step to `time` that has been solved but not yet accepted.
    pub(super) fn within(&self, predictor: usize, time: f64, t: f64, out: &mut [f64]) {
        match self.settings.family {
            Family::BackwardDifferences => {
                self.values.evaluate(predictor, t, out);
                let count = predictor + 1;
                let share = self.values.product(count, t) / self.values.product(count, time);
                for (out, error) in out.iter_mut().zip(&self.error) {
                    *out += share * error;
                }
            }
            Family::Adams => {
                let (mut weights, mut ends) = ([0.0; MOST_NODES], [0.0; MOST_NODES]);
                let nodes = self.slopes.nodes();
                integrals(nodes, [self.time(), t], &mut weights[..=predictor]);
                integrals(nodes, [self.time(), time], &mut ends[..=predictor]);
                // The polynomial through the slopes, and what is left at the end.
                let share = (t - self.time()) / (time - self.time());
                for (weight, end) in weights.iter_mut().zip(ends) {
                    *weight -= share * end;
                }
                for ((out, new), old) in out
                    .iter_mut()
                    .zip(&self.value)
                    .zip(self.values.difference(0))
                {
                    *out = old + share * (new - old);
                }
                self.slopes.add_integral(&weights[..predictor], out);
                for (out, difference) in out.iter_mut().zip(&self.error) {
                    *out += weights[predictor] * difference;
                }
            }
            Family::Newmark(_) => {
                // Hermite's cubic through both ends.
                let size = time - self.time();
                let s = (t - self.time()) / size;
                let old = self.values.difference(0);
                let slopes = self.slopes.difference(0).iter().zip(&self.slope);
                let ends = old.iter().zip(&self.value);
                for (out, ((a, b), (da, db))) in out.iter_mut().zip(ends.zip(slopes)) {
                    let bend = size * ((1.0 - s) * da - s * db) + (2.0 * s - 1.0) * (b - a);
                    *out = a + s * (b - a) + s * (1.0 - s) * bend;
                }
            }
        }
    }
}
