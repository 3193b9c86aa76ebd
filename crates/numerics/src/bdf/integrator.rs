//! Step and order control.

use std::ops::Range;

use super::history::HIGHEST_ORDER;
use super::{History, Step, System, Verdict};

/// Limits that the caller sets.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// Highest order to use, 1 to 5.
    pub highest_order: usize,
    /// Longest step.
    pub longest_step: f64,
    /// Shortest step before the integrator gives up (the last step to a stop time may be shorter).
    pub shortest_step: f64,
}

/// What happened since the integrator was made.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
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
/// use numerics::bdf::{Bdf, Settings, Step, System};
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
/// let settings = Settings { highest_order: 5, longest_step: 1.0, shortest_step: 1e-12 };
/// let mut bdf = Bdf::new(1, settings);
/// bdf.start(0.0, &[1.0], &[-1.0], 1e-4);
/// while bdf.time() < 1.0 {
///     bdf.advance(&mut Decay, 1.0).unwrap();
/// }
/// assert!((bdf.value()[0] - (-1.0_f64).exp()).abs() < 1e-6);
/// ```
#[derive(Clone, Debug)]
pub struct Bdf {
    settings: Settings,
    history: History,
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
    error: Vec<f64>,
    neighbour: Vec<f64>,
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
        Self {
            settings,
            history: History::new(size),
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
            error: vec![0.0; size],
            neighbour: vec![0.0; size],
        }
    }

    /// Replaces the limits; they hold from the next step on.
    pub fn set_settings(&mut self, settings: Settings) {
        self.settings = settings;
    }

    /// Forgets the past and starts from a value, its slope and a first step size to try.
    pub fn start(&mut self, time: f64, value: &[f64], slope: &[f64], size: f64) {
        self.history.start(time, value, slope);
        self.value.copy_from_slice(value);
        self.order = self.settings.highest_order.clamp(1, 2);
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
        self.history.time()
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
        let degree = self.order.min(self.history.count() - 1);
        self.history.evaluate(degree, time, value);
    }

    /// Slope of that interpolation, of the values in `range`.
    pub fn interpolate_slope(&self, time: f64, range: Range<usize>, slope: &mut [f64]) {
        let degree = self.order.min(self.history.count() - 1);
        self.history.slope(degree, time, range, slope);
    }

    /// Factor `γ` of the formula in the last accepted step; zero before the first.
    #[must_use]
    pub fn last_gamma(&self) -> f64 {
        self.last_gamma
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
            let gamma = self.history.gamma(order, time);
            let predictor = order.min(self.history.count() - 1);
            self.history.formula(order, time, gamma, &mut self.formula);
            self.history.evaluate(predictor, time, &mut self.prediction);
            self.value.copy_from_slice(&self.prediction);
            let step = Step {
                time,
                size,
                order,
                gamma,
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
                    self.history.evaluate(0, start, &mut self.value);
                    return Err(Error::Failed { time: start, cause });
                }
                continue;
            }
            for ((e, v), p) in self.error.iter_mut().zip(&self.value).zip(&self.prediction) {
                *e = v - p;
            }
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
                    self.history.evaluate(0, start, &mut self.value);
                    return Err(Error::Inaccurate { time: start, size });
                }
                continue;
            }
            let below = (predictor > 1)
                .then(|| self.estimate(system, predictor, predictor - 1, time, size));
            let above = (predictor == order
                && order < self.highest_order()
                && self.history.count() > order + 1)
                .then(|| self.estimate(system, predictor, order + 1, time, size));
            let step = Step {
                time,
                size,
                order,
                gamma,
                history: &self.formula,
                prediction: &self.prediction,
            };
            let history = &self.history;
            let span = history.product(predictor + 1, time);
            let mut within = |t: f64, out: &mut [f64]| {
                history.evaluate(predictor, t, out);
                let share = history.product(predictor + 1, t) / span;
                for (out, error) in out.iter_mut().zip(&self.error) {
                    *out += share * error;
                }
            };
            match system.judge(&step, &self.value, &mut within) {
                Verdict::Accept => {}
                Verdict::EndAt(time) => {
                    end = Some(time);
                    continue;
                }
                Verdict::Abandon => {
                    self.history.evaluate(0, start, &mut self.value);
                    return Ok(());
                }
            }
            system.accepted(&step, &self.value);
            self.history.push(time, &self.value);
            self.statistics.steps += 1;
            self.last_size = size;
            self.last_gamma = gamma;
            self.choose(size, predictor, below, here, above);
            return Ok(());
        }
    }

    fn highest_order(&self) -> usize {
        self.settings.highest_order.clamp(1, HIGHEST_ORDER)
    }

    fn lower_order(&mut self) {
        if self.order > 1 {
            self.order -= 1;
            self.steps_at_order = 0;
        }
    }

    /// Error that the formula of order `k` would have made, from the difference between the new
    /// value and the extrapolation through `k + 1` past nodes.
    ///
    /// The local error is `y − p_k` times `γ_k / (t − t_k)`: both are the same divided difference
    /// of order `k + 1`, multiplied by `Π_{i≤k}(t − t_i)` in one and by `γ_k Π_{i<k}(t − t_i)` in
    /// the other.
    fn estimate<S: System>(
        &mut self,
        system: &S,
        predictor: usize,
        k: usize,
        time: f64,
        size: f64,
    ) -> Estimate {
        let constant = self.history.gamma(k, time) / (time - self.history.node(k));
        let norm = if k == predictor {
            system.norm(&self.error)
        } else {
            let (j, sign) = if k < predictor {
                (predictor, 1.0)
            } else {
                (k, -1.0)
            };
            let weight = sign * self.history.product(j, time);
            let difference = self.history.difference(j);
            for ((n, e), d) in self.neighbour.iter_mut().zip(&self.error).zip(difference) {
                *n = e + weight * d;
            }
            system.norm(&self.neighbour)
        };
        let error = constant * norm;
        // A margin of two in the error; never more than a factor of ten per step.
        let size = size
            * (2.0 * error)
                .max(1e-12)
                .powf(-1.0 / (k + 1) as f64)
                .min(10.0);
        Estimate { error, size }
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
                let largest = if self.history.count() < 4 { 8.0 } else { 2.0 };
                self.size = size * growth.min(largest);
                if predictor == self.order
                    && self.order < self.highest_order()
                    && self.history.count() >= self.order + 2
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
