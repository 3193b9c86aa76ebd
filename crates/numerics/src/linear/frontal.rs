//! Multifrontal LU of unsymmetric matrices with partial pivoting and delayed pivots.
//!
//! Groups of unknowns are eliminated one after the other, each in a dense front of its rows and
//! columns and of those that they are coupled with; what is left of these is added to the front that
//! eliminates the first of them (Duff and Reid, *The multifrontal solution of unsymmetric sets of linear
//! equations*, SIAM J. Sci. Stat. Comput. 5, 1984). The tree of fronts is found once for a pattern.
//!
//! Pivots are chosen anew at every factorisation among the entries that a front has complete. Where
//! none of a column is large enough beside the others of that column (a body without mass, equations of
//! a loop before the loop is closed), column and a row are left to the next front. Only the last front
//! of a tree has to find a pivot for all: where it cannot, the matrix is singular.

use super::fronts::Fronts;
use super::scaling::{row_scale, units};
use super::{Matrix, Singular};
use serde::{Deserialize, Serialize};

/// A pivot must reach this part of the largest entry of its column: small enough that mechanisms seldom
/// delay one, large enough that rounding grows little.
const THRESHOLD: f64 = 5e-3;
/// After scaling, entries below this are no pivots at all.
const SMALLEST_PIVOT: f64 = 1e-13;

/// A front as it was eliminated last.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Eliminated {
    /// Number of pivots found.
    pivots: usize,
    /// Number of rows that could have been pivot rows.
    complete: usize,
    /// Number of rows.
    size: usize,
    /// Where its rows and columns start in the lists of these.
    ids: usize,
}

/// What a front leaves to its parent.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Rest {
    front: usize,
    /// Where the values start in the stack.
    values: usize,
}

/// Factors of a [`Matrix`] whose pattern stays the same between factorisations.
///
/// ```
/// use numerics::linear::{FrontalLu, Matrix};
/// let mut a = Matrix::new(2);
/// a.start();
/// a.add(0, 1, 2.0);
/// a.add(1, 0, 4.0);
/// a.add(1, 1, 1.0);
/// a.compress();
/// let mut lu = FrontalLu::new(vec![Some(0), Some(0)]);
/// lu.factor(&a).unwrap();
/// let mut x = [2.0, 5.0];
/// lu.solve(&mut x);
/// assert_eq!(x, [1.0, 1.0]);
/// ```
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct FrontalLu {
    groups: Vec<Option<u32>>,
    /// None before the first factorisation.
    fronts: Option<Fronts>,
    eliminated: Vec<Eliminated>,
    /// Rows and columns of every front: pivots first, in their order, then what is left.
    rows: Vec<u32>,
    columns: Vec<u32>,
    /// By front and pivot: the multipliers below it. Read once, from the first front to the last.
    lower: Vec<f64>,
    /// By front: the columns of its pivots down to the inverse of each, then the parts of the border's
    /// columns in the pivot rows, last column first. Read once, from the end to the beginning.
    upper: Vec<f64>,
    row_scale: Vec<f64>,
    /// Units of the unknowns, from the first matrix on that had no pivot without them.
    column_scale: Option<Vec<f64>>,
    /// The front in work, column by column.
    dense: Vec<f64>,
    /// Scales of its rows.
    scales: Vec<f64>,
    places: Vec<usize>,
    rests: Vec<Rest>,
    rest_values: Vec<f64>,
    delayed: usize,
    /// Right-hand sides, side by side, in the order of the pivots.
    work: Vec<f64>,
}

impl FrontalLu {
    /// No factors yet. `groups` says for every unknown (and the equation of the same number) with which
    /// group it is eliminated; one without a group goes with the last of the groups that it is coupled
    /// with. A group should have a regular block of its own, or nearly so, on the diagonal.
    #[must_use]
    pub fn new(groups: Vec<Option<u32>>) -> Self {
        let n = groups.len();
        Self {
            groups,
            fronts: None,
            eliminated: Vec::new(),
            rows: Vec::new(),
            columns: Vec::new(),
            lower: Vec::new(),
            upper: Vec::new(),
            row_scale: vec![1.0; n],
            column_scale: None,
            dense: Vec::new(),
            scales: Vec::new(),
            places: Vec::new(),
            rests: Vec::new(),
            rest_values: Vec::new(),
            delayed: 0,
            work: Vec::new(),
        }
    }

    /// Entries in the factors.
    #[must_use]
    pub fn fill(&self) -> usize {
        self.lower.len() + self.upper.len()
    }

    /// How often the last factorisation left a pivot to the next front.
    #[must_use]
    pub fn delayed(&self) -> usize {
        self.delayed
    }

    /// Factors `matrix`, which must have the pattern of the first one.
    ///
    /// # Errors
    /// [`Singular`] with a dependent row and column, numbered as in `matrix`. The factors are then
    /// unusable.
    ///
    /// # Panics
    /// When the matrix does not have as many rows as there are groups given.
    pub fn factor(&mut self, matrix: &Matrix) -> Result<(), Singular> {
        assert_eq!(
            matrix.size(),
            self.groups.len(),
            "every unknown must have a group"
        );
        match self.attempt(matrix) {
            Err(singular) => {
                // Its units may be all that is wrong.
                self.column_scale = Some(units(matrix));
                self.attempt(matrix).map_err(|_| singular)
            }
            done => done,
        }
    }

    fn attempt(&mut self, matrix: &Matrix) -> Result<(), Singular> {
        // Not yet known.
        self.row_scale.fill(0.0);
        let fronts = match self.fronts.take() {
            Some(fronts) => fronts,
            None => Fronts::new(matrix, &self.groups),
        };
        self.eliminated.clear();
        self.rows.clear();
        self.columns.clear();
        self.lower.clear();
        self.upper.clear();
        self.rests.clear();
        self.rest_values.clear();
        self.delayed = 0;
        let mut singular = None;
        for number in 0..fronts.fronts.len() {
            let gathered = match self.gather(&fronts, number, matrix) {
                Ok(gathered) => gathered,
                Err(not_finite) => {
                    singular = Some(not_finite);
                    break;
                }
            };
            let values = self.rest_values.len();
            let front = self.eliminate(gathered);
            self.eliminated.push(front);
            if front.complete < front.size {
                self.rests.push(Rest {
                    front: number,
                    values,
                });
            } else if front.pivots < front.size {
                // There is no parent that could find further pivots.
                singular = Some(Singular {
                    row: self.rows[front.ids + front.pivots] as usize,
                    column: self.columns[front.ids + front.pivots] as usize,
                });
                break;
            }
        }
        self.fronts = Some(fronts);
        singular.map_or(Ok(()), Err)
    }

    /// Adds up a front, from entries of the matrix and what its children left; returns its size.
    ///
    /// Rows are scaled in the front in which they are first, so that large matrices are fetched from memory
    /// once. They are mostly numbered from the ground outwards and eliminated inwards: from the last row to
    /// the first, as here, they are fetched ahead.
    fn gather(
        &mut self,
        fronts: &Fronts,
        number: usize,
        matrix: &Matrix,
    ) -> Result<Eliminated, Singular> {
        let front = &fronts.fronts[number];
        let (own, border) =
            fronts.unknowns[front.first..front.first + front.size].split_at(front.own);
        let ids = self.rows.len();
        self.rows.extend_from_slice(own);
        self.columns.extend_from_slice(own);
        let first_child = self.rests.len() - front.children;
        for rest in &self.rests[first_child..] {
            let child = &self.eliminated[rest.front];
            let left = child.ids + child.pivots..child.ids + child.complete;
            self.rows.extend_from_within(left.clone());
            self.columns.extend_from_within(left);
        }
        let complete = self.rows.len() - ids;
        let late = complete - front.own;
        self.delayed += late;
        self.rows.extend_from_slice(border);
        self.columns.extend_from_slice(border);
        let size = complete + border.len();
        // Delayed rows and columns stand between the own ones and the border.
        let shifted = |place: u32| {
            let place = place as usize;
            if place < front.own {
                place
            } else {
                place + late
            }
        };
        for &row in self.rows[ids..].iter().rev() {
            let row = row as usize;
            if self.row_scale[row] == 0.0 {
                self.row_scale[row] = row_scale(matrix, row, self.column_scale.as_deref())?;
            }
        }
        self.scales.clear();
        let rows = self.rows[ids..].iter();
        self.scales
            .extend(rows.map(|&row| self.row_scale[row as usize]));
        self.dense.clear();
        self.dense.resize(size * size, 0.0);
        let entries = &fronts.entries[front.entries.clone()];
        let values = matrix.values();
        if late == 0 {
            for entry in entries {
                self.dense[entry.place as usize] += values[entry.value as usize];
            }
        } else {
            for entry in entries {
                let (column, row) = (
                    entry.place / front.size as u32,
                    entry.place % front.size as u32,
                );
                let place = shifted(column) * size + shifted(row);
                self.dense[place] += values[entry.value as usize];
            }
        }
        let mut next = front.own;
        for rest in &self.rests[first_child..] {
            let (child, node) = (&self.eliminated[rest.front], &fronts.fronts[rest.front]);
            let left = child.complete - child.pivots;
            self.places.clear();
            self.places.extend(next..next + left);
            next += left;
            let border = &fronts.in_parent[node.first + node.own..node.first + node.size];
            self.places
                .extend(border.iter().map(|&place| shifted(place)));
            let count = self.places.len();
            let values = &self.rest_values[rest.values..rest.values + count * count];
            for (&column, values) in self.places.iter().zip(values.chunks_exact(count)) {
                let into = &mut self.dense[column * size..(column + 1) * size];
                for (&row, value) in self.places.iter().zip(values) {
                    into[row] += value;
                }
            }
        }
        if let Some(first) = self.rests.get(first_child) {
            self.rest_values.truncate(first.values);
            self.rests.truncate(first_child);
        }
        Ok(Eliminated {
            pivots: 0,
            complete,
            size,
            ids,
        })
    }

    /// Eliminates a front that was gathered as far as it has pivots, and keeps factors and rest.
    fn eliminate(&mut self, mut front: Eliminated) -> Eliminated {
        let n = front.size;
        while front.pivots < front.complete {
            let k = front.pivots;
            let Some((row, column)) = self.pivot(&front) else {
                break;
            };
            if row != k {
                self.dense.chunks_exact_mut(n).for_each(|c| c.swap(k, row));
                self.rows.swap(front.ids + k, front.ids + row);
                self.scales.swap(k, row);
            }
            if column != k {
                let (left, right) = self.dense.split_at_mut(column * n);
                left[k * n..(k + 1) * n].swap_with_slice(&mut right[..n]);
                self.columns.swap(front.ids + k, front.ids + column);
            }
            let (left, right) = self.dense.split_at_mut((k + 1) * n);
            let multipliers = &mut left[k * n + k..];
            let inverse = 1.0 / multipliers[0];
            multipliers[0] = inverse;
            let multipliers = &mut multipliers[1..];
            multipliers.iter_mut().for_each(|m| *m *= inverse);
            for column in right.chunks_exact_mut(n) {
                let (head, tail) = column.split_at_mut(k + 1);
                subtract(tail.as_chunks_mut::<1>().0, [head[k]], multipliers);
            }
            front.pivots += 1;
        }
        let (eliminated, left) = self.dense.split_at(front.pivots * n);
        for (k, column) in eliminated.chunks_exact(n).enumerate() {
            let (above, below) = column.split_at(k + 1);
            self.upper.extend_from_slice(above);
            self.lower.extend_from_slice(below);
        }
        for column in left.chunks_exact(n).rev() {
            self.upper.extend_from_slice(&column[..front.pivots]);
        }
        for column in left.chunks_exact(n) {
            self.rest_values.extend_from_slice(&column[front.pivots..]);
        }
        front
    }

    /// The next pivot of a front: of the first column that has one, the largest.
    fn pivot(&self, front: &Eliminated) -> Option<(usize, usize)> {
        let (k, n) = (front.pivots, front.size);
        let (own_scales, border_scales) = self.scales.split_at(front.complete);
        (k..front.complete).find_map(|column| {
            let (own, border) = self.dense[column * n..(column + 1) * n].split_at(front.complete);
            let (mut best, mut largest) = (k, 0.0_f64);
            for (row, (value, scale)) in own.iter().zip(own_scales).enumerate().skip(k) {
                let size = value.abs() * scale;
                if size > largest {
                    (best, largest) = (row, size);
                }
            }
            let least = THRESHOLD.recip() * largest;
            let mut sizes = border
                .iter()
                .zip(border_scales)
                .map(|(v, scale)| v.abs() * scale);
            let unit = self.column_scale.as_ref().map_or(1.0, |units| {
                units[self.columns[front.ids + column] as usize]
            });
            let usable = largest * unit > SMALLEST_PIVOT && sizes.all(|size| size <= least);
            usable.then_some((best, column))
        })
    }

    /// Replaces the right-hand side `b` by the solution.
    ///
    /// # Panics
    /// When `b` does not fit the factored matrix.
    pub fn solve(&mut self, b: &mut [f64]) {
        self.solve_together([b]);
    }

    /// Replaces two right-hand sides by their solutions, in one pass over the factors.
    ///
    /// # Panics
    /// When they do not fit the factored matrix.
    pub fn solve_two(&mut self, a: &mut [f64], b: &mut [f64]) {
        self.solve_together([a, b]);
    }

    fn solve_together<const N: usize>(&mut self, b: [&mut [f64]; N]) {
        let n = self.row_scale.len();
        assert!(
            b.iter().all(|b| b.len() == n),
            "the right-hand side must fit the factored matrix"
        );
        self.work.clear();
        let mut lower = self.lower.as_slice();
        for front in &self.eliminated {
            let rows = &self.rows[front.ids..front.ids + front.size];
            let start = self.work.len();
            let values = rows
                .iter()
                .map(|&row| std::array::from_fn(|side| b[side][row as usize]));
            values.for_each(|values: [f64; N]| self.work.extend_from_slice(&values));
            let local = self.work[start..].as_chunks_mut::<N>().0;
            for k in 0..front.pivots {
                let (column, others) = lower.split_at(front.size - 1 - k);
                let (head, tail) = local.split_at_mut(k + 1);
                subtract(tail, head[k], column);
                lower = others;
            }
            for (&row, values) in rows.iter().zip(local).skip(front.pivots) {
                for (side, value) in values.iter().enumerate() {
                    b[side][row as usize] = *value;
                }
            }
            self.work.truncate(start + N * front.pivots);
        }
        let mut upper = self.upper.as_slice();
        let mut work = self.work.as_chunks_mut::<N>().0;
        for front in self.eliminated.iter().rev() {
            let columns = &self.columns[front.ids..front.ids + front.size];
            let (own, border) = columns.split_at(front.pivots);
            let (others, local) = work.split_at_mut(work.len() - front.pivots);
            work = others;
            for &column in border {
                let (others, above) = upper.split_at(upper.len() - front.pivots);
                let known = std::array::from_fn(|side| b[side][column as usize]);
                subtract(local, known, above);
                upper = others;
            }
            for k in (0..front.pivots).rev() {
                let (others, above) = upper.split_at(upper.len() - 1 - k);
                let (head, tail) = local.split_at_mut(k);
                tail[0] = tail[0].map(|value| value * above[k]);
                subtract(head, tail[0], &above[..k]);
                upper = others;
            }
            for (&column, values) in own.iter().zip(local) {
                for (side, value) in values.iter().enumerate() {
                    b[side][column as usize] = *value;
                }
            }
        }
    }
}

/// Takes multiples of `b` off every side of `a`.
fn subtract<const N: usize>(a: &mut [[f64; N]], factors: [f64; N], b: &[f64]) {
    if factors != [0.0; N] {
        for (a, b) in a.iter_mut().zip(b) {
            for (a, factor) in a.iter_mut().zip(factors) {
                *a -= factor * b;
            }
        }
    }
}
