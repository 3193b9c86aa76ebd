//! Step and order control.

use serde::{Deserialize, Serialize};
use std::ops::Range;

use super::adams::{error_integral, integrals};
use super::history::MOST_NODES;
use super::{Family, History, Step, System, Verdict};

/// Nodes of values kept: order + 2, so that the error of the next higher order can be estimated.
const VALUE_NODES: usize = Family::BackwardDifferences.highest_order() + 2;
/// Nodes of slopes kept for the formulas of Adams: order + 1 for the same reason.
const SLOPE_NODES: usize = Family::Adams.highest_order() + 1;

/// Limits that the caller sets.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub struct Settings {
    /// The formulas.
    pub family: Family,
    /// Highest order to use, from one to that of the family.
    pub highest_order: usize,
    /// Longest step.
    pub longest_step: f64,
    /// Shortest step before the integrator gives up (the last step to a stop time may be shorter).
    pub shortest_step: f64,
}

/// What happened since the integrator was made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Statistics {
    /// Accepted steps.
    pub steps: usize,
    /// Steps that failed the error test.
    pub rejections: usize,
    /// Steps whose equations could not be solved.
    pub failures: usize,
    /// Starts from a value and a slope.
    pub starts: usize,
}

/// The integrator gave up; the values at the last accepted step are intact.
#[derive(Clone, Debug, PartialEq)]
pub enum Error<F> {
    /// The equations could not be solved even with the shortest step.
    Failed {
        /// Time of the last accepted step.
        time: f64,
        /// What the system said last.
        cause: F,
    },
    /// The error test did not pass even with the shortest step.
    Inaccurate {
        /// Time of the last accepted step.
        time: f64,
        /// Step that was tried last.
        size: f64,
    },
}

/// The integrator: a past, an order and a step size.
///
/// ```
/// use numerics::bdf::{Bdf, Family, Settings, Step, System};
/// struct Decay;
/// impl System for Decay {
///     type Failure = ();
///     fn solve(&mut self, step: &Step<'_>, y: &mut [f64]) -> Result<(), ()> {
///         // y' = -y with y' = (y - history)/gamma
///         y[0] = step.history[0] / (1.0 + step.gamma);
///         Ok(())
///     }
///     fn norm(&self, difference: &[f64]) -> f64 {
///         difference[0].abs() / 1e-8
///     }
///     fn accepted(&mut self, _: &Step<'_>, _: &[f64]) {}
/// }
/// let settings = Settings {
///     family: Family::BackwardDifferences,
///     highest_order: 5,
///     longest_step: 1.0,
///     shortest_step: 1e-12,
/// };
/// let mut bdf = Bdf::new(1, settings);
/// bdf.start(&Decay, 0.0, &[1.0], &[-1.0], 1e-4);
/// while bdf.time() < 1.0 {
///     bdf.advance(&mut Decay, 1.0).unwrap();
/// }
/// assert!((bdf.value()[0] - (-1.0_f64).exp()).abs() < 1e-6);
/// ```
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Bdf {
    settings: Settings,
    values: History,
    /// Slopes of the past, empty where the family needs none.
    slopes: History,
    order: usize,
    size: f64,
    /// Order, step by step, has only risen since the last start.
    starting: bool,
    steps_at_order: usize,
    last_size: f64,
    last_gamma: f64,
    statistics: Statistics,
    formula: Vec<f64>,
    prediction: Vec<f64>,
    value: Vec<f64>,
    /// Slope of the new value.
    slope: Vec<f64>,
    /// Second derivatives of the newest value, for the formulas of Newmark.
    curvature: Vec<f64>,
    /// What the error estimates come from: the new value less the prediction, of which the formulas of
    /// Newmark take their parts; with those of Adams, the divided difference of slopes whose order is
    /// that of the prediction.
    error: Vec<f64>,
    neighbour: Vec<f64>,
}

/// The formula of a step: `ẏ = (y − ŷ)/γ`.
#[derive(Clone, Copy)]
struct Formula {
    gamma: f64,
    position_gamma: f64,
    /// Order of the prediction, that of the formula where the past allows it.
    predictor: usize,
}

/// Error estimate at an order, and the step size that would just pass with a margin.
#[derive(Clone, Copy)]
struct Estimate {
    error: f64,
    size: f64,
}

impl Bdf {
    /// An integrator for `size` values.
    #[must_use]
    pub fn new(size: usize, settings: Settings) -> Self {
        let mut new = Self {
            settings,
            values: History::new(size, VALUE_NODES),
            slopes: History::new(0, 0),
            order: 1,
            size: 0.0,
            starting: true,
            steps_at_order: 0,
            last_size: 0.0,
            last_gamma: 0.0,
            statistics: Statistics::default(),
            formula: vec![0.0; size],
            prediction: vec![0.0; size],
            value: vec![0.0; size],
            slope: vec![0.0; size],
            curvature: Vec::new(),
            error: vec![0.0; size],
            neighbour: vec![0.0; size],
        };
        new.set_settings(settings);
        new
    }

    /// Replaces the limits, which hold from the next step on, and the family of formulas; another
    /// family needs a start.
    pub fn set_settings(&mut self, settings: Settings) {
        self.settings = settings;
        let size = self.values.size();
        let (slopes, nodes, curvatures) = match settings.family {
            Family::BackwardDifferences => (0, 0, 0),
            Family::Adams => (size, SLOPE_NODES, 0),
            Family::Newmark(_) => (size, 1, size),
        };
        if (self.slopes.size(), self.curvature.len()) != (slopes, curvatures) {
            self.slopes = History::new(slopes, nodes);
            self.curvature = vec![0.0; curvatures];
        }
    }

    /// Forgets the past and starts from a value, its slope and a first step size to try.
    pub fn start<S: System>(
        &mut self,
        system: &S,
        time: f64,
        value: &[f64],
        slope: &[f64],
        size: f64,
    ) {
        self.values.start(time, value, slope);
        if self.slopes.size() > 0 {
            self.slopes.start_without_slope(time, slope);
        }
        self.value.copy_from_slice(value);
        self.slope.copy_from_slice(slope);
        if !self.curvature.is_empty() {
            system.curvature(value, slope, &mut self.curvature);
        }
        self.order = self.highest_order().min(2);
        self.size = size;
        self.starting = true;
        self.steps_at_order = 0;
        self.last_size = 0.0;
        self.last_gamma = 0.0;
        self.statistics.starts += 1;
    }

    /// Time of the last accepted step.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.values.time()
    }

    /// Values at the last accepted step.
    #[must_use]
    pub fn value(&self) -> &[f64] {
        &self.value
    }

    /// Length of the last accepted step.
    #[must_use]
    pub fn last_size(&self) -> f64 {
        self.last_size
    }

    /// Order of the next step.
    #[must_use]
    pub fn order(&self) -> usize {
        self.order
    }

    /// Counts since the integrator was made.
    #[must_use]
    pub fn statistics(&self) -> Statistics {
        self.statistics
    }

    /// Values at `time` within the last accepted step, to the order of the method.
    pub fn interpolate(&self, time: f64, value: &mut [f64]) {
        match self.settings.family {
            Family::BackwardDifferences | Family::Newmark(_) => {
                self.values.evaluate(self.degree(), time, value);
            }
            Family::Adams => {
                let mut weights = [0.0; MOST_NODES];
                let weights = &mut weights[..=self.degree()];
                integrals(self.slopes.nodes(), [self.time(), time], weights);
                value.copy_from_slice(&self.value);
                self.slopes.add_integral(weights, value);
            }
        }
    }

    /// Slope of that interpolation, of the values in `range`.
    pub fn interpolate_slope(&self, time: f64, range: Range<usize>, slope: &mut [f64]) {
        match self.settings.family {
            Family::BackwardDifferences | Family::Newmark(_) => {
                self.values.slope(self.degree(), time, range, slope);
            }
            Family::Adams => self
                .slopes
                .evaluate_range(self.degree(), time, range, slope),
        }
    }

    /// Degree of the polynomial through the last values, or through the last slopes.
    fn degree(&self) -> usize {
        let (wanted, history) = match self.settings.family {
            Family::BackwardDifferences => (self.order, &self.values),
            // One above the order: a free gift, and smoother.
            Family::Newmark(_) => (self.order + 1, &self.values),
            Family::Adams => (self.order, &self.slopes),
        };
        wanted.min(history.count() - 1)
    }

    /// Factor `γ` of the formula in the last accepted step; zero before the first.
    #[must_use]
    pub fn last_gamma(&self) -> f64 {
        self.last_gamma
    }

    /// Writes formula and prediction of a step to `time` at the present order.
    fn formulate<S: System>(&mut self, system: &S, time: f64) -> Formula {
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
    fn take_error<S: System>(&mut self, system: &S, formula: Formula, time: f64) {
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

    /// Takes one step, not beyond `stop`; none where the system abandons it.
    ///
    /// # Errors
    /// [`Error`] when the step size fell below the shortest allowed; the last accepted values stay.
    pub fn advance<S: System>(
        &mut self,
        system: &mut S,
        stop: f64,
    ) -> Result<(), Error<S::Failure>> {
        let start = self.time();
        let remaining = stop - start;
        let mut failures = 0;
        let mut rejections = 0;
        // Where the system wants the step to end.
        let mut end = None;
        loop {
            let wanted = self.size.min(self.settings.longest_step);
            // Landing on the stop must not leave a sliver of a step for the next one.
            let (size, time) = if let Some(end) = end.take() {
                (end - start, end)
            } else if wanted >= remaining * (1.0 - 1e-9) {
                (remaining, stop)
            } else if 2.0 * wanted > remaining {
                (0.5 * remaining, start + 0.5 * remaining)
            } else {
                (wanted, start + wanted)
            };
            let order = self.order;
            let formula = self.formulate(system, time);
            let (gamma, predictor) = (formula.gamma, formula.predictor);
            self.value.copy_from_slice(&self.prediction);
            let step = Step {
                time,
                size,
                order,
                gamma,
                position_gamma: formula.position_gamma,
                history: &self.formula,
                prediction: &self.prediction,
            };
            if let Err(cause) = system.solve(&step, &mut self.value) {
                failures += 1;
                self.statistics.failures += 1;
                self.starting = false;
                self.size = 0.25 * size;
                if failures > 2 {
                    self.lower_order();
                }
                if self.size < self.settings.shortest_step {
                    self.values.evaluate(0, start, &mut self.value);
                    return Err(Error::Failed { time: start, cause });
                }
                continue;
            }
            self.take_error(system, formula, time);
            let here = self.estimate(system, predictor, predictor, time, size);
            if !(here.error <= 1.0) {
                rejections += 1;
                self.statistics.rejections += 1;
                self.starting = false;
                if rejections > 1 {
                    self.lower_order();
                }
                let shrink = if here.error.is_finite() {
                    here.size / size
                } else {
                    0.1
                };
                self.size = size * shrink.clamp(0.1, 0.9);
                if self.size < self.settings.shortest_step {
                    self.values.evaluate(0, start, &mut self.value);
                    return Err(Error::Inaccurate { time: start, size });
                }
                continue;
            }
            let below = (predictor > 1)
                .then(|| self.estimate(system, predictor, predictor - 1, time, size));
            let above =
                (predictor == order && order < self.highest_order() && self.known_orders() > order)
                    .then(|| self.estimate(system, predictor, order + 1, time, size));
            let step = Step {
                time,
                size,
                order,
                gamma,
                position_gamma: formula.position_gamma,
                history: &self.formula,
                prediction: &self.prediction,
            };
            let mut within = |t: f64, out: &mut [f64]| self.within(predictor, time, t, out);
            match system.judge(&step, &self.value, &mut within) {
                Verdict::Accept => {}
                Verdict::EndAt(time) => {
                    end = Some(time);
                    continue;
                }
                Verdict::Abandon => {
                    self.values.evaluate(0, start, &mut self.value);
                    return Ok(());
                }
            }
            system.accepted(&step, &self.value);
            self.values.push(time, &self.value);
            if self.slopes.size() > 0 {
                self.slopes.push(time, &self.slope);
            }
            if !self.curvature.is_empty() {
                system.curvature(&self.value, &self.slope, &mut self.curvature);
            }
            self.statistics.steps += 1;
            self.last_size = size;
            self.last_gamma = gamma;
            self.choose(size, predictor, below, here, above);
            return Ok(());
        }
    }

    fn highest_order(&self) -> usize {
        let most = self.settings.family.highest_order();
        self.settings.highest_order.clamp(1, most)
    }

    /// Orders whose error the past allows to estimate.
    fn known_orders(&self) -> usize {
        match self.settings.family {
            Family::BackwardDifferences | Family::Newmark(_) => self.values.count() - 1,
            Family::Adams => self.slopes.count(),
        }
    }

    /// Values at `t` within a step to `time` that has been solved but not yet accepted.
    fn within(&self, predictor: usize, time: f64, t: f64, out: &mut [f64]) {
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

    fn lower_order(&mut self) {
        if self.order > 1 {
            self.order -= 1;
            self.steps_at_order = 0;
        }
    }

    /// Error that the formula of order `k` would have made.
    fn estimate<S: System>(
        &mut self,
        system: &S,
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
        // A margin of two in the error; never more than a factor of ten per step.
        let size = size
            * (2.0 * error)
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
        system: &S,
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
    fn adams_error<S: System>(&mut self, system: &S, predictor: usize, k: usize, time: f64) -> f64 {
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
    fn choose(
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
                let largest = if self.values.count() < 4 { 8.0 } else { 2.0 };
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
        if self.steps_at_order <= self.order {
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
        let ratio = if ratio >= 1.3 {
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
