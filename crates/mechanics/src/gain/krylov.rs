//! The largest gains of mechanisms of many frictions, without the matrix of gains: Arnoldi's method
//! (Saad, *Numerical methods for large eigenvalue problems*, 2nd ed. 2011, section 6.2), whose values
//! at the edge of the spectrum are found first and from within.

use nalgebra::{DMatrix, DVector};
use serde::{Deserialize, Serialize};

use super::Largest;
use super::answers::Answers;

/// Products with the gains.
pub(super) const PRODUCTS: usize = 32;
/// A vector that loses all but this part to the ones before adds nothing but rounding.
const NOTHING_NEW: f64 = 1e-12;

/// An orthonormal basis and the gains on it.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Krylov {
    /// One vector more than products, by friction.
    basis: DMatrix<f64>,
    /// Upper Hessenberg, with one row more than columns.
    hessenberg: DMatrix<f64>,
    /// Products of the last look.
    size: usize,
}

impl Krylov {
    pub(super) fn new(frictions: usize) -> Self {
        Self {
            basis: DMatrix::zeros(frictions, PRODUCTS + 1),
            hessenberg: DMatrix::zeros(PRODUCTS + 1, PRODUCTS),
            size: 0,
        }
    }

    /// Builds the basis; the largest magnitude of an eigenvalue on it, with the largest part of their
    /// coefficients that joints may come to use.
    pub(super) fn take(&mut self, answers: &mut Answers) -> f64 {
        let frictions = answers.count();
        self.hessenberg.fill(0.0);
        // A start that is even in all frictions but has no symmetry of the mechanism's.
        let golden = 0.5 * (5f64.sqrt() - 1.0);
        for (k, x) in self.basis.column_mut(0).iter_mut().enumerate() {
            *x = 0.5 + (golden * k as f64).fract();
        }
        self.basis.column_mut(0).normalize_mut();
        self.size = 0;
        while self.size < PRODUCTS {
            let k = self.size;
            let (known, mut rest) = self.basis.columns_range_pair_mut(..k + 1, k + 1..);
            let mut next = rest.column_mut(0);
            let last = known.column(k);
            let x = last.iter().copied().enumerate();
            answers.multiply(x, next.as_mut_slice());
            let before = next.norm();
            // Twice is enough for vectors that are orthogonal to rounding (Kahan and Parlett).
            for _ in 0..2 {
                for (row, column) in known.column_iter().enumerate() {
                    let part = column.dot(&next);
                    next.axpy(-part, &column, 1.0);
                    self.hessenberg[(row, k)] += part;
                }
            }
            let left = next.norm();
            self.size += 1;
            if !(left > NOTHING_NEW * before) {
                break;
            }
            self.hessenberg[(k + 1, k)] = left;
            next /= left;
        }
        let unused = (0..frictions).fold(0.0_f64, |m, k| m.max(answers.unused(k)));
        match self.square() {
            // The next step is looked at.
            None => f64::INFINITY,
            Some(matrix) => {
                let values = matrix.complex_eigenvalues();
                unused * values.iter().fold(0.0_f64, |m, value| m.max(value.norm()))
            }
        }
    }

    /// The gains on the basis, where all are finite.
    fn square(&self) -> Option<DMatrix<f64>> {
        let matrix = self.hessenberg.view((0, 0), (self.size, self.size));
        let finite = matrix.iter().all(|value| value.is_finite());
        finite.then(|| matrix.into_owned())
    }

    /// The largest real eigenvalue, and the friction that takes the largest part in it.
    pub(super) fn largest(&self) -> Option<Largest> {
        let matrix = self.square()?;
        let values = matrix.complex_eigenvalues();
        let real = values.iter().filter(|value| value.im == 0.0);
        let gain = real.fold(f64::NEG_INFINITY, |m, value| m.max(value.re));
        // One step of inverse iteration beside the eigenvalue gives its vector.
        let beside = gain + 1e-8 * gain.abs();
        let shifted = &matrix - DMatrix::identity(self.size, self.size) * beside;
        let start = DVector::from_element(self.size, 1.0);
        let vector = shifted.lu().solve(&start)?;
        let vector = self.basis.columns(0, self.size) * vector;
        Some(Largest {
            friction: vector.icamax(),
            gain,
        })
    }
}
