//! All gains in a matrix, for mechanisms of few frictions: bounds that hold whatever way joints slide.

use nalgebra::DMatrix;
use serde::{Deserialize, Serialize};

use super::answers::Answers;
use super::{LONGEST_INTERVAL, LOOK_ALWAYS, Largest};

/// Powers of the gains that are tried for a smaller bound, while each makes it smaller by this part.
const POWERS: usize = 30;
const IMPROVED: f64 = 0.98;

/// The matrix of gains.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Full {
    gains: DMatrix<f64>,
    /// Positive vectors of an iteration, by friction.
    weights: [Vec<f64>; 2],
}

impl Full {
    pub(super) fn new(frictions: usize) -> Self {
        Self {
            gains: DMatrix::zeros(frictions, frictions),
            weights: [vec![0.0; frictions], vec![0.0; frictions]],
        }
    }

    /// Takes all gains; a bound of their eigenvalues, whatever way the joints slide and however little
    /// of their coefficient they use.
    pub(super) fn take(&mut self, answers: &mut Answers) -> f64 {
        for k in 0..answers.count() {
            let mut column = self.gains.column_mut(k);
            answers.multiply([(k, 1.0)].into_iter(), column.as_mut_slice());
        }
        self.largest_radius(answers)
    }

    /// The largest real eigenvalue, and the friction that takes the largest part in it.
    pub(super) fn largest(&self) -> Option<Largest> {
        if self.gains.iter().any(|gain| !gain.is_finite()) {
            return None;
        }
        let eigenvalues = self.gains.complex_eigenvalues();
        let real = eigenvalues.iter().filter(|value| value.im == 0.0);
        let gain = real.fold(f64::NEG_INFINITY, |m, value| m.max(value.re));
        let own = |k: usize| self.gains[(k, k)];
        let friction = (0..self.gains.nrows()).max_by(|&a, &b| own(a).total_cmp(&own(b)))?;
        Some(Largest { friction, gain })
    }

    /// A bound of the spectral radius of the gains when each column takes any part of its unused
    /// coefficient: for a matrix `B ≥ 0` and any `x > 0` it is at most the largest `(xB)_k / x_k`
    /// (Collatz 1942, Wielandt 1950). Powers of `1 + B` bring `x` near the vector that attains it.
    fn largest_radius(&mut self, answers: &Answers) -> f64 {
        let [weights, next] = &mut self.weights;
        weights.fill(1.0);
        let mut bound = f64::INFINITY;
        for _ in 0..POWERS {
            let mut ratio = 0.0_f64;
            for (k, next) in next.iter_mut().enumerate() {
                let column = self.gains.column(k);
                let gains = column.iter().zip(weights.iter());
                let product: f64 = gains.map(|(gain, weight)| gain.abs() * weight).sum();
                let product = answers.unused(k) * product;
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
