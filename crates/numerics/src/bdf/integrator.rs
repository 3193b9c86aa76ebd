//! Step and order control.

use serde::{Deserialize, Serialize};
use std::ops::Range;

use super::adams::integrals;
use super::control::Rejected;
use super::history::MOST_NODES;
use super::{Family, History, Step, System, Verdict};

/// Nodes of values kept: order + 2, so that the error of the next higher order can be estimated.
const VALUE_NODES: usize = Family::BackwardDifferences.highest_order() + 2;
/// Nodes of values kept by formulas that go on from slopes: the double one of a start.
const START_NODES: usize = 2;
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
    /// Shortest step, with which the integrator gives up (steps that end at a stop time, or where the
    /// system wants them to, may be shorter).
    pub shortest_step: f64,
    /// Whether errors choose the order alone: no step fails for its error. With the shortest step as
    /// long as the longest all steps have this length.
    pub untested: bool,
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

impl Statistics {
    /// Attempts at steps, accepted or not.
    #[must_use]
    pub fn attempts(&self) -> usize {
        self.steps + self.rejections + self.failures
    }
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
///     fn norm(&mut self, difference: &[f64]) -> f64 {
///         difference[0].abs() / 1e-8
///     }
///     fn accepted(&mut self, _: &Step<'_>, _: &[f64]) {}
/// }
/// let settings = Settings {
///     family: Family::BackwardDifferences,
///     highest_order: 5,
///     longest_step: 1.0,
///     shortest_step: 1e-12,
///     untested: false,
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
    pub(super) settings: Settings,
    pub(super) values: History,
    /// Slopes of the past, empty where the family needs none.
    pub(super) slopes: History,
    pub(super) order: usize,
    pub(super) size: f64,
    /// Order, step by step, has only risen since the last start.
    pub(super) starting: bool,
    pub(super) steps_at_order: usize,
    pub(super) last_size: f64,
    pub(super) last_gamma: f64,
    pub(super) statistics: Statistics,
    pub(super) formula: Vec<f64>,
    pub(super) prediction: Vec<f64>,
    pub(super) value: Vec<f64>,
    /// Slope of the new value.
    pub(super) slope: Vec<f64>,
    /// Second derivatives of the newest value, for the formulas of Newmark.
    pub(super) curvature: Vec<f64>,
    /// What the error estimates come from: the new value less the prediction, of which the formulas of
    /// Newmark take their parts; with those of Adams, the divided difference of slopes whose order is
    /// that of the prediction.
    pub(super) error: Vec<f64>,
    pub(super) neighbour: Vec<f64>,
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

    /// The limits.
    #[must_use]
    pub fn settings(&self) -> &Settings {
        &self.settings
    }

    /// Replaces the limits, which hold from the next step on, and the family of formulas; another
    /// family needs a start.
    pub fn set_settings(&mut self, settings: Settings) {
        self.settings = settings;
        let size = self.values.size();
        let [values, slopes] = match settings.family {
            Family::BackwardDifferences => [(size, VALUE_NODES), (0, 0)],
            Family::Adams => [(size, START_NODES), (size, SLOPE_NODES)],
            Family::Newmark(_) => [(size, VALUE_NODES), (size, 1)],
        };
        for (history, wanted) in [(&mut self.values, values), (&mut self.slopes, slopes)] {
            if (history.size(), history.capacity()) != wanted {
                *history = History::new(wanted.0, wanted.1);
            }
        }
        let curvatures = match settings.family {
            Family::BackwardDifferences | Family::Adams => 0,
            Family::Newmark(_) => size,
        };
        self.curvature.resize(curvatures, 0.0);
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

    /// Estimate of the error of the last step tried, value by value.
    #[must_use]
    pub fn error(&self) -> &[f64] {
        &self.error
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
    pub(super) fn degree(&self) -> usize {
        let (wanted, history) = match self.settings.family {
            Family::BackwardDifferences => (self.order, &self.values),
            // One above the order: a free gift, and smoother.
            Family::Newmark(_) => (self.order + 1, &self.values),
            Family::Adams => (self.order, &self.slopes),
        };
        let known = history.count().checked_sub(1);
        wanted.min(known.expect("another family has been started"))
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
        let mut rejected = None;
        // Where the system wants the step to end.
        let mut end = None;
        loop {
            let shortest = self.settings.shortest_step;
            // A step that lands on the stop may be longer by rounding.
            let gives_up = |size: f64| size <= shortest * (1.0 + 1e-6);
            let wanted = self.size.max(shortest).min(self.settings.longest_step);
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
                if gives_up(size) {
                    self.values.evaluate(0, start, &mut self.value);
                    return Err(Error::Failed { time: start, cause });
                }
                continue;
            }
            self.take_error(system, formula, time);
            let here = self.estimate(system, predictor, predictor, time, size);
            if !(here.error <= 1.0 || self.settings.untested) {
                self.statistics.rejections += 1;
                let attempt = Rejected {
                    error: here.error,
                    size,
                };
                self.shorten(attempt, rejected.replace(attempt), predictor);
                if gives_up(size) {
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

    pub(super) fn highest_order(&self) -> usize {
        let most = self.settings.family.highest_order();
        self.settings.highest_order.clamp(1, most)
    }

    /// Orders whose error the past allows to estimate.
    pub(super) fn known_orders(&self) -> usize {
        match self.settings.family {
            Family::BackwardDifferences | Family::Newmark(_) => self.values.count() - 1,
            Family::Adams => self.slopes.count(),
        }
    }
}
