//! Sparse unsymmetric LU: the pivot order is found once, the numbers many times.
//!
//! Analysis is a right-looking elimination with Markowitz's count (least fill) under threshold
//! pivoting (Duff, Erisman, Reid, *Direct Methods for Sparse Matrices*, chapter 7). It records the
//! pivot order and the filled pattern. A later factorisation walks that pattern row by row without
//! searching or allocating, and watches the multipliers: where reused pivots have become too small
//! the analysis is repeated on the present values.

use super::{Matrix, Singular};

/// A candidate pivot must reach this part of the largest entry of its column.
const THRESHOLD: f64 = 0.1;
/// Reused pivots that let a multiplier grow beyond this are given up.
const LARGEST_MULTIPLIER: f64 = 1e4;
/// After row scaling, entries below this are no pivots at all.
const SMALLEST_PIVOT: f64 = 1e-13;
/// Columns of least count that are searched for a pivot before the best so far is taken.
const SEARCHED_COLUMNS: usize = 4;

/// Factors of a [`Matrix`] whose pattern stays the same between factorisations.
///
/// ```
/// use numerics::linear::{Matrix, SparseLu};
/// let mut a = Matrix::new(2);
/// a.start();
/// a.add(0, 1, 2.0);
/// a.add(1, 0, 4.0);
/// a.add(1, 1, 1.0);
/// a.compress();
/// let mut lu = SparseLu::new();
/// lu.factor(&a).unwrap();
/// let mut x = [2.0, 5.0];
/// lu.solve(&mut x);
/// assert_eq!(x, [1.0, 1.0]);
/// ```
#[derive(Clone, Debug, Default)]
pub struct SparseLu {
    /// Row of the matrix eliminated at each step.
    pivot_rows: Vec<u32>,
    /// Column of the matrix eliminated at each step.
    pivot_columns: Vec<u32>,
    /// Step at which each column of the matrix is eliminated.
    step_of_column: Vec<u32>,
    /// Lower factor by rows in step order: steps of the multipliers, ascending.
    lower_starts: Vec<usize>,
    lower_steps: Vec<u32>,
    lower: Vec<f64>,
    /// Upper factor by rows in step order, without the diagonal.
    upper_starts: Vec<usize>,
    upper_steps: Vec<u32>,
    upper: Vec<f64>,
    inverse_pivots: Vec<f64>,
    row_scale: Vec<f64>,
    work: Vec<f64>,
    analyses: usize,
}

impl SparseLu {
    /// No factors yet.
    #[must_use]
    pub fn new() -> Self {
        Self::default()
    }

    /// How often a pivot order was searched for.
    #[must_use]
    pub fn analyses(&self) -> usize {
        self.analyses
    }

    /// Entries in both factors.
    #[must_use]
    pub fn fill(&self) -> usize {
        self.lower.len() + self.upper.len() + self.inverse_pivots.len()
    }

    /// Factors `matrix`, reusing the pivot order of the last call while it is good enough.
    ///
    /// # Errors
    /// [`Singular`] with a dependent row and column, numbered as in `matrix`. The factors are then
    /// unusable, and the next call searches a new pivot order.
    pub fn factor(&mut self, matrix: &Matrix) -> Result<(), Singular> {
        if self.pivot_rows.len() == matrix.size() && self.analyses > 0 && self.refactor(matrix) {
            return Ok(());
        }
        self.pivot_rows.clear();
        self.analyse(matrix)?;
        if self.refactor(matrix) {
            return Ok(());
        }
        // Multipliers beyond the bound right after an analysis mean entries that are not numbers.
        self.pivot_rows.clear();
        Err(Singular { row: 0, column: 0 })
    }

    /// Replaces the right-hand side `b` by the solution.
    ///
    /// # Panics
    /// When `b` does not fit the factored matrix.
    pub fn solve(&mut self, b: &mut [f64]) {
        let n = self.pivot_rows.len();
        assert_eq!(
            b.len(),
            n,
            "the right-hand side must fit the factored matrix"
        );
        for k in 0..n {
            let row = self.pivot_rows[k] as usize;
            let mut sum = b[row] * self.row_scale[row];
            for p in self.lower_starts[k]..self.lower_starts[k + 1] {
                sum -= self.lower[p] * self.work[self.lower_steps[p] as usize];
            }
            self.work[k] = sum;
        }
        for k in (0..n).rev() {
            let mut sum = self.work[k];
            for p in self.upper_starts[k]..self.upper_starts[k + 1] {
                sum -= self.upper[p] * self.work[self.upper_steps[p] as usize];
            }
            self.work[k] = sum * self.inverse_pivots[k];
        }
        for k in 0..n {
            b[self.pivot_columns[k] as usize] = self.work[k];
        }
        self.work.fill(0.0);
    }

    /// Rows are scaled to a largest entry of one, so that pivots compare across units.
    fn scale_rows(&mut self, matrix: &Matrix) {
        self.row_scale.resize(matrix.size(), 1.0);
        for (row, scale) in self.row_scale.iter_mut().enumerate() {
            let entries = matrix.row_starts()[row]..matrix.row_starts()[row + 1];
            let largest = matrix.values()[entries]
                .iter()
                .fold(0.0_f64, |m, a| m.max(a.abs()));
            *scale = if largest > 0.0 { 1.0 / largest } else { 1.0 };
        }
    }

    /// Numeric factorisation along the recorded pattern; false where the pivots no longer serve.
    fn refactor(&mut self, matrix: &Matrix) -> bool {
        self.scale_rows(matrix);
        for k in 0..self.pivot_rows.len() {
            let row = self.pivot_rows[k] as usize;
            let scale = self.row_scale[row];
            for p in matrix.row_starts()[row]..matrix.row_starts()[row + 1] {
                let step = self.step_of_column[matrix.columns()[p] as usize];
                self.work[step as usize] = matrix.values()[p] * scale;
            }
            for p in self.lower_starts[k]..self.lower_starts[k + 1] {
                let j = self.lower_steps[p] as usize;
                let multiplier = self.work[j] * self.inverse_pivots[j];
                self.work[j] = 0.0;
                self.lower[p] = multiplier;
                if !(multiplier.abs() < LARGEST_MULTIPLIER) {
                    self.work.fill(0.0);
                    return false;
                }
                if multiplier != 0.0 {
                    for q in self.upper_starts[j]..self.upper_starts[j + 1] {
                        self.work[self.upper_steps[q] as usize] -= multiplier * self.upper[q];
                    }
                }
            }
            let pivot = self.work[k];
            self.work[k] = 0.0;
            for p in self.upper_starts[k]..self.upper_starts[k + 1] {
                let column = self.upper_steps[p] as usize;
                self.upper[p] = self.work[column];
                self.work[column] = 0.0;
            }
            if !(pivot.abs() > SMALLEST_PIVOT) {
                return false;
            }
            self.inverse_pivots[k] = 1.0 / pivot;
        }
        true
    }

    /// Finds the pivot order and the filled pattern for the present values.
    fn analyse(&mut self, matrix: &Matrix) -> Result<(), Singular> {
        let n = matrix.size();
        self.analyses += 1;
        self.scale_rows(matrix);
        let mut elimination = Elimination::new(matrix, &self.row_scale);
        let mut upper_rows: Vec<Vec<u32>> = Vec::with_capacity(n);
        let mut lower_rows: Vec<Vec<u32>> = vec![Vec::new(); n];
        let mut pivot_rows = Vec::with_capacity(n);
        let mut pivot_columns = Vec::with_capacity(n);
        for step in 0..n {
            let (row, column) = elimination.choose_pivot()?;
            for touched in elimination.eliminate(row, column) {
                lower_rows[touched as usize].push(step as u32);
            }
            let pivot_row = std::mem::take(&mut elimination.rows[row as usize]);
            upper_rows.push(
                pivot_row
                    .iter()
                    .map(|&(c, _)| c)
                    .filter(|&c| c != column)
                    .collect(),
            );
            pivot_rows.push(row);
            pivot_columns.push(column);
        }
        self.step_of_column = vec![0; n];
        for (step, &column) in pivot_columns.iter().enumerate() {
            self.step_of_column[column as usize] = step as u32;
        }
        self.lower_starts = vec![0];
        self.lower_steps.clear();
        self.upper_starts = vec![0];
        self.upper_steps.clear();
        for (step, &row) in pivot_rows.iter().enumerate() {
            self.lower_steps
                .extend_from_slice(&lower_rows[row as usize]);
            self.lower_starts.push(self.lower_steps.len());
            let begin = self.upper_steps.len();
            self.upper_steps.extend(
                upper_rows[step]
                    .iter()
                    .map(|&c| self.step_of_column[c as usize]),
            );
            self.upper_steps[begin..].sort_unstable();
            self.upper_starts.push(self.upper_steps.len());
        }
        self.lower = vec![0.0; self.lower_steps.len()];
        self.upper = vec![0.0; self.upper_steps.len()];
        self.inverse_pivots = vec![0.0; n];
        self.work = vec![0.0; n];
        self.pivot_rows = pivot_rows;
        self.pivot_columns = pivot_columns;
        Ok(())
    }
}

/// The part of the matrix that is still to be eliminated, during the analysis.
struct Elimination {
    /// Entries by row: column and value, ascending by column.
    rows: Vec<Vec<(u32, f64)>>,
    /// Rows that hold an entry of the column.
    columns: Vec<Vec<u32>>,
    column_done: Vec<bool>,
}

impl Elimination {
    fn new(matrix: &Matrix, scale: &[f64]) -> Self {
        let n = matrix.size();
        let mut rows = Vec::with_capacity(n);
        let mut columns = vec![Vec::new(); n];
        for row in 0..n {
            let entries: Vec<(u32, f64)> = (matrix.row_starts()[row]..matrix.row_starts()[row + 1])
                .map(|p| (matrix.columns()[p], matrix.values()[p] * scale[row]))
                .collect();
            for &(column, _) in &entries {
                columns[column as usize].push(row as u32);
            }
            rows.push(entries);
        }
        Self {
            rows,
            columns,
            column_done: vec![false; n],
        }
    }

    fn value(&self, row: u32, column: u32) -> f64 {
        let entries = &self.rows[row as usize];
        entries
            .binary_search_by_key(&column, |&(c, _)| c)
            .map_or(0.0, |place| entries[place].1)
    }

    /// The entry of least Markowitz count among large enough ones of the shortest columns.
    fn choose_pivot(&self) -> Result<(u32, u32), Singular> {
        let mut order: Vec<u32> = Vec::with_capacity(SEARCHED_COLUMNS + 1);
        let mut best: Option<(usize, f64, u32, u32)> = None;
        let mut remaining_column = 0;
        let mut tried = vec![];
        // Take the shortest columns; widen the search only while none of them has a pivot.
        for width in [SEARCHED_COLUMNS, self.columns.len()] {
            order.clear();
            for column in 0..self.columns.len() as u32 {
                if self.column_done[column as usize] {
                    continue;
                }
                remaining_column = column;
                let count = self.columns[column as usize].len();
                if order.len() < width
                    || count < self.columns[order[order.len() - 1] as usize].len()
                {
                    let place = order.partition_point(|&c| self.columns[c as usize].len() <= count);
                    order.insert(place, column);
                    order.truncate(width);
                }
            }
            for &column in &order {
                let rows = &self.columns[column as usize];
                tried.clear();
                tried.extend(rows.iter().map(|&row| self.value(row, column).abs()));
                let largest = tried.iter().fold(0.0_f64, |m, a| m.max(*a));
                if !(largest > SMALLEST_PIVOT) {
                    continue;
                }
                for (&row, &size) in rows.iter().zip(&tried) {
                    if size < THRESHOLD * largest {
                        continue;
                    }
                    let count = (rows.len() - 1) * (self.rows[row as usize].len() - 1);
                    let better = best.is_none_or(|(least, value, _, _)| {
                        count < least || (count == least && size > value)
                    });
                    if better {
                        best = Some((count, size, row, column));
                    }
                }
            }
            if let Some((_, _, row, column)) = best {
                return Ok((row, column));
            }
        }
        let row = self.rows.iter().position(|r| !r.is_empty()).unwrap_or(0);
        Err(Singular {
            row,
            column: remaining_column as usize,
        })
    }

    /// Eliminates `column` with pivot row `row`; returns the rows that got a multiplier.
    fn eliminate(&mut self, row: u32, column: u32) -> Vec<u32> {
        let pivot_row = std::mem::take(&mut self.rows[row as usize]);
        for &(c, _) in &pivot_row {
            self.columns[c as usize].retain(|&r| r != row);
        }
        self.column_done[column as usize] = true;
        let pivot = pivot_row
            .iter()
            .find(|&&(c, _)| c == column)
            .map_or(1.0, |&(_, v)| v);
        let touched = std::mem::take(&mut self.columns[column as usize]);
        for &other in &touched {
            let old = std::mem::take(&mut self.rows[other as usize]);
            let multiplier = old
                .iter()
                .find(|&&(c, _)| c == column)
                .map_or(0.0, |&(_, v)| v)
                / pivot;
            let mut merged = Vec::with_capacity(old.len() + pivot_row.len());
            let (mut a, mut b) = (0, 0);
            while a < old.len() || b < pivot_row.len() {
                let from_old = old.get(a).map_or(u32::MAX, |e| e.0);
                let from_pivot = pivot_row.get(b).map_or(u32::MAX, |e| e.0);
                let c = from_old.min(from_pivot);
                let mut value = 0.0;
                if from_old == c {
                    value = old[a].1;
                    a += 1;
                }
                if from_pivot == c {
                    if from_old != c && c != column {
                        self.columns[c as usize].push(other);
                    }
                    value -= multiplier * pivot_row[b].1;
                    b += 1;
                }
                if c != column {
                    merged.push((c, value));
                }
            }
            self.rows[other as usize] = merged;
        }
        self.rows[row as usize] = pivot_row;
        touched
    }
}

#[cfg(test)]
mod tests {
    use super::super::dense::DenseLu;
    use super::*;

    /// A small deterministic generator; the numbers only have to differ.
    struct Numbers(u64);
    impl Numbers {
        fn next(&mut self) -> f64 {
            self.0 = self
                .0
                .wrapping_mul(6364136223846793005)
                .wrapping_add(1442695040888963407);
            (self.0 >> 11) as f64 / (1u64 << 53) as f64 - 0.5
        }
    }

    fn saddle(n: usize, m: usize, numbers: &mut Numbers, matrix: &mut Matrix) {
        matrix.start();
        for i in 0..n {
            matrix.add(i, i, 2.0 + numbers.next());
        }
        for j in 0..m {
            for k in 0..3 {
                let column = (j * 2 + k * 5) % n;
                let value = numbers.next() + if k == 0 { 2.0 } else { 0.0 };
                matrix.add(n + j, column, value);
                matrix.add(column, n + j, value * (1.0 + 0.1 * numbers.next()));
            }
        }
        matrix.compress();
    }

    #[test]
    fn agrees_with_dense_over_many_values_of_one_pattern() {
        let mut numbers = Numbers(1);
        let (n, m) = (30, 12);
        let mut matrix = Matrix::new(n + m);
        let mut lu = SparseLu::new();
        for _ in 0..50 {
            saddle(n, m, &mut numbers, &mut matrix);
            let b: Vec<f64> = (0..n + m).map(|_| numbers.next()).collect();
            lu.factor(&matrix).unwrap();
            let mut x = b.clone();
            lu.solve(&mut x);
            let mut dense = DenseLu::new(n + m);
            dense.factor(&matrix.to_dense()).unwrap();
            let mut y = b.clone();
            dense.solve(&mut y);
            let error = x
                .iter()
                .zip(&y)
                .fold(0.0_f64, |e, (a, b)| e.max((a - b).abs()));
            // Both are backward stable; the matrices' condition numbers stay below 1e4.
            assert!(error < 1e-11, "{error}");
        }
        assert!(
            lu.analyses() < 10,
            "the pivot order must be reused: {}",
            lu.analyses()
        );
    }

    #[test]
    fn pivots_that_vanish_are_replaced() {
        let mut matrix = Matrix::new(2);
        let mut lu = SparseLu::new();
        for diagonal in [1.0, 0.0] {
            matrix.start();
            matrix.add(0, 0, diagonal);
            matrix.add(0, 1, 1.0);
            matrix.add(1, 0, 1.0);
            matrix.add(1, 1, diagonal * 3.0);
            matrix.compress();
            lu.factor(&matrix).unwrap();
            let mut x = [1.0 + diagonal, 1.0 + 3.0 * diagonal];
            lu.solve(&mut x);
            assert!(
                (x[0] - 1.0).abs() < 1e-14 && (x[1] - 1.0).abs() < 1e-14,
                "{x:?}"
            );
        }
    }

    #[test]
    fn a_dependent_row_is_singular() {
        let mut matrix = Matrix::new(3);
        matrix.start();
        for (i, row) in [[1.0, 2.0, 3.0], [2.0, 4.0, 6.0], [1.0, 0.0, 1.0]]
            .iter()
            .enumerate()
        {
            for (j, &value) in row.iter().enumerate() {
                matrix.add(i, j, value);
            }
        }
        matrix.compress();
        assert!(SparseLu::new().factor(&matrix).is_err());
    }

    #[test]
    fn not_a_number_is_singular_not_a_result() {
        let mut matrix = Matrix::new(1);
        matrix.start();
        matrix.add(0, 0, f64::NAN);
        matrix.compress();
        assert!(SparseLu::new().factor(&matrix).is_err());
    }
}
