//! The gain of friction: how much load a friction that a load causes brings about.
//!
//! With the friction `f_k = φ_k N_k` of each joint (`φ_k` its direction and coefficient in steady
//! motion) the reactions of the reduced system answer a unit load on friction `k` with
//!
//! ```text
//! A_lk = dN_l/dλ · dλ/df · φ_k       from  M δa − Gᵀ δλ = φ_k,  G δa = 0
//! ```
//!
//! and the loads are `N = (1 − A)⁻¹ N₀`. Where an eigenvalue of `A` reaches one, loads grow without
//! bound: the joint jams, or has no or several solutions (Painlevé 1895). Beyond it the equations
//! still have a solution, with which no machine moves; so it is reported, never integrated.

use nalgebra::DMatrix;
use numerics::linear::{FrontalLu, Matrix};
use serde::{Deserialize, Serialize};

use crate::instant::Failure;
use crate::joint_friction::{Memory, Share};
use crate::model::{Element, Label};
use crate::system::System;

/// A friction whose gain is one or more, or as near to one as makes equations unsolvable.
#[derive(Clone, Debug, PartialEq)]
pub struct Jam {
    /// The friction.
    pub friction: Label,
    /// The gain: the largest real eigenvalue of the loop.
    pub gain: f64,
}

/// Bound of the gains from which on every step is looked at.
const LOOK_ALWAYS: f64 = 0.5;
/// A gain from which on a failure to solve the equations is put down to it.
const NEAR_ONE: f64 = 0.9;
/// Powers of the gains that are tried for a smaller bound, while each makes it smaller by this part.
const POWERS: usize = 30;
const IMPROVED: f64 = 0.98;
/// A look solves the equations once for each friction. Where there are many, looks are so far apart that
/// this is as many times a step, so that steps of long chains cost no more a body than those of short
/// ones; a jam is then found that much later.
const SOLVES_A_STEP: usize = 16;
/// Steps between two looks at most.
const LONGEST_INTERVAL: f64 = 1000.0;

/// Finds gains, with storage of its own.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct GainWatch {
    matrix: Matrix,
    factors: FrontalLu,
    zero: Vec<f64>,
    right: Vec<f64>,
    gains: DMatrix<f64>,
    /// By friction: the rows that its load depends on, and how.
    load_slopes: Vec<Vec<(usize, f64)>>,
    /// By friction: the largest part of its coefficient against that in the gains.
    unused: Vec<f64>,
    /// Positive vectors of an iteration, by friction.
    weights: [Vec<f64>; 2],
    /// Steps until the next look.
    wait: usize,
}

impl GainWatch {
    pub(crate) fn new(system: &System) -> Self {
        let n = system.rate_count();
        let size = system.unknown_count();
        let frictions = system.model.frictions.len();
        Self {
            matrix: Matrix::new(size),
            factors: FrontalLu::new(system.elimination_groups()),
            zero: vec![0.0; n],
            right: vec![0.0; size],
            gains: DMatrix::zeros(frictions, frictions),
            load_slopes: vec![Vec::with_capacity(6); frictions],
            unused: vec![0.0; frictions],
            weights: [vec![0.0; frictions], vec![0.0; frictions]],
            wait: 0,
        }
    }

    /// Looks at the instant evaluated last, if it is time to: often where gains are large, seldom
    /// where geometry and coefficients leave them far from one. `before` is what the frictions
    /// remembered before the step that led there.
    pub(crate) fn look_seldom(
        &mut self,
        system: &mut System,
        multipliers: &[f64],
        before: &[Memory],
    ) -> Result<Option<Jam>, Failure> {
        if self.wait > 0 {
            self.wait -= 1;
            return Ok(None);
        }
        self.look_across(system, multipliers, Some(before))
    }

    /// Looks at the instant evaluated last.
    pub(crate) fn look(
        &mut self,
        system: &mut System,
        multipliers: &[f64],
    ) -> Result<Option<Jam>, Failure> {
        self.look_across(system, multipliers, None)
    }

    fn look_across(
        &mut self,
        system: &mut System,
        multipliers: &[f64],
        before: Option<&[Memory]>,
    ) -> Result<Option<Jam>, Failure> {
        if system.model.frictions.is_empty() {
            self.wait = usize::MAX;
            return Ok(None);
        }
        let bound = self.gains(system, multipliers, before)?;
        let interval = (LOOK_ALWAYS / bound).powi(2).clamp(1.0, LONGEST_INTERVAL);
        let spread = self.load_slopes.len() / SOLVES_A_STEP;
        self.wait = (interval as usize - 1).max(spread);
        if bound < 1.0 {
            return Ok(None);
        }
        Ok(self.largest(system).filter(|jam| jam.gain >= 1.0))
    }

    /// The largest gain at the instant evaluated last, where it is near enough to one to explain why
    /// no solution is found.
    pub(crate) fn explain(&mut self, system: &mut System, multipliers: &[f64]) -> Option<Jam> {
        if system.model.frictions.is_empty() {
            return None;
        }
        self.gains(system, multipliers, None).ok()?;
        self.largest(system).filter(|jam| jam.gain >= NEAR_ONE)
    }

    fn largest(&self, system: &System) -> Option<Jam> {
        if self.gains.iter().any(|gain| !gain.is_finite()) {
            return None;
        }
        let eigenvalues = self.gains.complex_eigenvalues();
        let real = eigenvalues.iter().filter(|value| value.im == 0.0);
        let gain = real.fold(f64::NEG_INFINITY, |m, value| m.max(value.re));
        // The friction that takes the largest part in the loop.
        let worst = (0..self.gains.nrows())
            .max_by(|&a, &b| self.gains[(a, a)].total_cmp(&self.gains[(b, b)]))
            .unwrap_or(0);
        Some(Jam {
            friction: system.model.frictions[worst].label.clone(),
            gain,
        })
    }

    /// Fills the matrix of gains; returns a bound of its eigenvalues, whatever way the joints slide
    /// and however little of their coefficient they use.
    ///
    /// A joint that went from sliding to stuck in the step, or back, passed the speed at which its
    /// coefficient is the static one: it counts with that, in the direction it has now.
    fn gains(
        &mut self,
        system: &mut System,
        multipliers: &[f64],
        before: Option<&[Memory]>,
    ) -> Result<f64, Failure> {
        let n = system.rate_count();
        system.assemble_frictionless_instant(&self.zero, multipliers, &mut self.matrix);
        self.factors
            .factor(&self.matrix)
            .map_err(Failure::Singular)?;
        let frictions = system.model.frictions.len();
        self.gains.fill(0.0);
        for (place, slopes) in self.load_slopes.iter_mut().enumerate() {
            system.write_load_slopes(place, multipliers, slopes);
        }
        let mut bound = 0.0_f64;
        for k in 0..frictions {
            self.unused[k] = 0.0;
            if !system.model.is_active(Element::Friction(k)) {
                continue;
            }
            let (element, i, j) = system.friction(k, multipliers);
            self.right.fill(0.0);
            for (side, body) in [i.body, j.body].into_iter().enumerate() {
                if let Some(body) = body {
                    for r in 0..6 {
                        self.right[6 * body + r] += element.by_load[6 * side + r];
                    }
                }
            }
            self.factors.solve(&mut self.right);
            let unused =
                system.model.frictions[k].law.largest_coefficient() / element.steady_coefficient;
            let crossed = before.is_some_and(|before| {
                before[k].tally.sticking != system.history.frictions[k].tally.sticking
            });
            let scale = if crossed && unused.is_finite() {
                unused
            } else {
                1.0
            };
            for (l, slopes) in self.load_slopes.iter().enumerate() {
                let change = slopes
                    .iter()
                    .map(|(row, slope)| slope * self.right[n + row]);
                self.gains[(l, k)] = scale * change.sum::<f64>();
            }
            // What is left of the coefficient may come yet; without any, the way it would act is
            // unknown, and the next step is looked at.
            if element.steady_coefficient > 0.0 {
                self.unused[k] = unused / scale;
            } else if element.load_by_reaction.iter().any(|slope| *slope != 0.0) {
                bound = LOOK_ALWAYS;
            }
        }
        Ok(bound.max(self.largest_radius()))
    }

    /// A bound of the spectral radius of the gains when each column takes any part of its unused
    /// coefficient: for a matrix `B ≥ 0` and any `x > 0` it is at most the largest `(xB)_k / x_k`
    /// (Collatz 1942, Wielandt 1950). Powers of `1 + B` bring `x` near the vector that attains it.
    fn largest_radius(&mut self) -> f64 {
        let [weights, next] = &mut self.weights;
        weights.fill(1.0);
        let mut bound = f64::INFINITY;
        for _ in 0..POWERS {
            let mut ratio = 0.0_f64;
            for (k, next) in next.iter_mut().enumerate() {
                let column = self.gains.column(k);
                let gains = column.iter().zip(weights.iter());
                let product: f64 = gains.map(|(gain, weight)| gain.abs() * weight).sum();
                let product = self.unused[k] * product;
                ratio = if ratio >= product / weights[k] {
                    ratio
                } else {
                    product / weights[k]
                };
                *next = weights[k] + product;
            }
            let improved = ratio < IMPROVED * bound;
            bound = bound.min(ratio);
            let largest = next.iter().fold(0.0_f64, |m, x| m.max(*x));
            // So small a bound makes the interval the longest one.
            if !(improved && bound * bound > LOOK_ALWAYS.powi(2) / LONGEST_INTERVAL) {
                break;
            }
            next.iter_mut()
                .for_each(|x| *x = (*x / largest).max(f64::MIN_POSITIVE));
            std::mem::swap(weights, next);
        }
        bound
    }
}

impl System {
    /// The rows whose multipliers change the load of a friction, and by how much.
    fn write_load_slopes(&self, place: usize, multipliers: &[f64], slopes: &mut Vec<(usize, f64)>) {
        slopes.clear();
        if !self.model.is_active(Element::Friction(place)) {
            return;
        }
        let (element, _, j) = self.friction(place, multipliers);
        let by_reaction = element.load_by_reaction;
        for contribution in self.contributions(place) {
            let Some(row) = self.constraints[contribution.constraint].row else {
                continue;
            };
            let slope = match contribution.share {
                Share::Force(axis) => by_reaction[axis],
                Share::Moment => {
                    let axis = self.moment_axis(contribution.constraint, &j);
                    by_reaction[3] * axis.x + by_reaction[4] * axis.y + by_reaction[5] * axis.z
                }
            };
            slopes.push((row, slope));
        }
    }
}
