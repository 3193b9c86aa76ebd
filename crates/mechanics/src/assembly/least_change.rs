//! The smallest change that meets linear equations.

use numerics::linear::{FrontalLu, Matrix, Singular};

use super::rows::{Block, Row, expand};

/// Diagonal of the multipliers that makes redundant equations harmless.
pub(super) const REGULARISATION: f64 = 1e-10;

/// The smallest weighted change that meets linear equations: `[W −Gᵀ; G ε] [x; μ] = [W x₀; b]`.
pub(super) struct Least {
    n: usize,
    rows: usize,
    matrix: Matrix,
    factors: FrontalLu,
}

impl Least {
    /// For the motions of `bodies` bodies and equations that are eliminated with the bodies given.
    pub(super) fn new(bodies: usize, with: &[Option<u32>]) -> Self {
        let (n, rows) = (6 * bodies, with.len());
        let mut groups: Vec<Option<u32>> = (0..n).map(|motion| Some(motion as u32 / 6)).collect();
        groups.extend_from_slice(with);
        Self {
            n,
            rows,
            matrix: Matrix::new(n + rows),
            factors: FrontalLu::new(groups),
        }
    }

    fn factor<'a>(
        &mut self,
        rows: impl Iterator<Item = &'a [Block]>,
        weights: &[f64],
        regularisation: f64,
    ) -> Result<(), Singular> {
        self.matrix.start();
        for (k, weight) in weights.iter().enumerate() {
            self.matrix.add(k, k, *weight);
        }
        for (place, row) in rows.enumerate() {
            let place = self.n + place;
            self.matrix.add(place, place, regularisation);
            for (body, block) in row {
                for (k, g) in block.iter().enumerate() {
                    self.matrix.add(place, 6 * body + k, *g);
                    self.matrix.add(6 * body + k, place, -g);
                }
            }
        }
        self.matrix.compress();
        self.factors.factor(&self.matrix)
    }

    /// The unknowns that are closest to `wanted` by `weights` and meet the rows with `right`.
    ///
    /// # Errors
    /// Where numbers are so large that nothing is left of others beside them: the diagonal is
    /// positive, so the matrix has an inverse whatever the rows are.
    pub(super) fn solve(
        &mut self,
        rows: &[Row],
        weights: &[f64],
        wanted: &[f64],
        right: &[f64],
        regularisation: f64,
    ) -> Result<Vec<f64>, Singular> {
        let blocks = rows.iter().map(|row| &row.blocks[..]);
        self.factor(blocks, weights, regularisation)?;
        let mut solution: Vec<f64> = wanted.iter().zip(weights).map(|(x, w)| x * w).collect();
        solution.extend_from_slice(right);
        self.factors.solve(&mut solution);
        solution.truncate(self.n);
        Ok(solution)
    }

    /// Coefficients with which `rows` combine to each of the `targets` as nearly as possible.
    pub(super) fn combinations(
        &mut self,
        rows: &[Vec<Block>],
        targets: &[Vec<Block>],
    ) -> Result<Vec<Vec<f64>>, Singular> {
        let rows = rows.iter().map(|row| &row[..]);
        self.factor(rows, &vec![1.0; self.n], REGULARISATION)?;
        let mut combination = |target: &Vec<Block>| {
            let mut solution = expand(target, self.n / 6);
            solution.resize(self.n + self.rows, 0.0);
            self.factors.solve(&mut solution);
            let coefficients = solution.split_off(self.n);
            coefficients.into_iter().map(|c| -c).collect()
        };
        Ok(targets.iter().map(&mut combination).collect())
    }
}
