//! Dense LU with partial pivoting, the oracle of the sparse one.

use super::Singular;

/// LU factors of a full square matrix, with row interchanges.
#[derive(Clone, Debug)]
pub(super) struct DenseLu {
    size: usize,
    /// Row-major: unit lower triangle below the diagonal, upper triangle on and above it.
    factors: Vec<f64>,
    /// Row of the caller's matrix that stands at each pivot position.
    rows: Vec<usize>,
    work: Vec<f64>,
}

impl DenseLu {
    /// Room for a matrix of `size` rows.
    #[must_use]
    pub(super) fn new(size: usize) -> Self {
        Self {
            size,
            factors: vec![0.0; size * size],
            rows: (0..size).collect(),
            work: vec![0.0; size],
        }
    }

    /// Factors the row-major `matrix`.
    ///
    /// # Errors
    /// [`Singular`] where no pivot exceeds `1e-14` of the largest entry of its original row.
    ///
    /// # Panics
    /// When `matrix` does not hold `size * size` values.
    pub(super) fn factor(&mut self, matrix: &[f64]) -> Result<(), Singular> {
        let n = self.size;
        assert_eq!(
            matrix.len(),
            n * n,
            "the matrix must hold size * size values"
        );
        self.factors.copy_from_slice(matrix);
        for (i, row) in self.rows.iter_mut().enumerate() {
            *row = i;
        }
        for i in 0..n {
            self.work[i] = matrix[i * n..(i + 1) * n]
                .iter()
                .fold(0.0_f64, |m, a| m.max(a.abs()));
        }
        for k in 0..n {
            let mut best = k;
            for i in k + 1..n {
                if self.factors[i * n + k].abs() > self.factors[best * n + k].abs() {
                    best = i;
                }
            }
            if best != k {
                for j in 0..n {
                    self.factors.swap(k * n + j, best * n + j);
                }
                self.rows.swap(k, best);
            }
            let pivot = self.factors[k * n + k];
            // The negated comparison also catches NaN.
            if !(pivot.abs() > 1e-14 * self.work[self.rows[k]]) {
                return Err(Singular {
                    row: self.rows[k],
                    column: k,
                });
            }
            let (upper, lower) = self.factors.split_at_mut((k + 1) * n);
            let pivot_row = &upper[k * n..];
            for row in lower.chunks_exact_mut(n) {
                if row[k] != 0.0 {
                    let factor = row[k] / pivot;
                    row[k] = factor;
                    for j in k + 1..n {
                        row[j] -= factor * pivot_row[j];
                    }
                }
            }
        }
        Ok(())
    }

    /// Replaces the right-hand side `b` by the solution.
    ///
    /// # Panics
    /// When `b` does not hold `size` values.
    pub(super) fn solve(&mut self, b: &mut [f64]) {
        let n = self.size;
        assert_eq!(b.len(), n, "the right-hand side must hold size values");
        for k in 0..n {
            let mut sum = b[self.rows[k]];
            for j in 0..k {
                sum -= self.factors[k * n + j] * self.work[j];
            }
            self.work[k] = sum;
        }
        for k in (0..n).rev() {
            let mut sum = self.work[k];
            for j in k + 1..n {
                sum -= self.factors[k * n + j] * self.work[j];
            }
            self.work[k] = sum / self.factors[k * n + k];
        }
        b.copy_from_slice(&self.work);
    }
}

mod tests {
    use super::*;

    #[test]
    fn a_small_system_is_solved() {
        let mut lu = DenseLu::new(2);
        lu.factor(&[0.0, 2.0, 4.0, 1.0]).unwrap();
        let mut x = [2.0, 5.0];
        lu.solve(&mut x);
        assert_eq!(x, [1.0, 1.0]);
    }

    #[test]
    fn a_dependent_row_is_reported() {
        let mut lu = DenseLu::new(3);
        let error = lu
            .factor(&[1.0, 2.0, 3.0, 2.0, 4.0, 6.0, 1.0, 0.0, 1.0])
            .unwrap_err();
        assert_eq!(error.column, 2);
    }

    #[test]
    fn not_a_number_is_singular_not_a_result() {
        assert!(DenseLu::new(1).factor(&[f64::NAN]).is_err());
    }
}
