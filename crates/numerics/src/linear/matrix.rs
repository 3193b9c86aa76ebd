//! A square sparse matrix that is assembled again and again in the same order.

use serde::{Deserialize, Serialize};

/// Marks the first call to an entry in an assembly: what is there before is of another one.
const FIRST: u32 = 1 << 31;

/// Adds to the value in a slot, or begins it.
fn add_to(values: &mut [f64], slot: u32, value: f64) {
    let sum = &mut values[(slot & !FIRST) as usize];
    let before = if slot & FIRST == 0 { *sum } else { 0.0 };
    *sum = before + value;
}

/// Sparse square matrix, compressed by rows.
///
/// Elements add their entries with [`Matrix::add`]. The first assembly records which entry each
/// call touches; [`Matrix::compress`] then fixes the pattern, and every later assembly must make
/// the same calls in the same order (values may differ, zeros included), so that an addition costs
/// one indexed store.
///
/// ```
/// let mut a = numerics::linear::Matrix::new(2);
/// for _ in 0..2 {
///     a.start();
///     a.add(0, 0, 1.0);
///     a.add(1, 1, 2.0);
///     a.add(0, 0, 3.0);
///     a.compress();
/// }
/// assert_eq!(a.values(), &[4.0, 2.0]);
/// ```
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Matrix {
    size: usize,
    /// Row and column of each call, in order; kept to check the order in debug builds.
    calls: Vec<(u32, u32)>,
    /// Place in `values` that each call adds to, with [`FIRST`] where it is the first to do so.
    slots: Vec<u32>,
    next: usize,
    compressed: bool,
    row_starts: Vec<usize>,
    columns: Vec<u32>,
    values: Vec<f64>,
    /// Values in call order, before the pattern is known.
    recorded: Vec<f64>,
}

impl Matrix {
    /// An empty matrix of `size` rows, ready to record its first assembly.
    #[must_use]
    pub fn new(size: usize) -> Self {
        Self {
            size,
            calls: Vec::new(),
            slots: Vec::new(),
            next: 0,
            compressed: false,
            row_starts: vec![0; size + 1],
            columns: Vec::new(),
            values: Vec::new(),
            recorded: Vec::new(),
        }
    }

    /// Number of rows and columns.
    #[must_use]
    pub fn size(&self) -> usize {
        self.size
    }

    /// Whether an assembly has fixed the pattern.
    #[must_use]
    pub fn has_pattern(&self) -> bool {
        self.compressed
    }

    /// Begins an assembly.
    pub fn start(&mut self) {
        self.next = 0;
        if !self.compressed {
            self.calls.clear();
            self.recorded.clear();
        }
    }

    /// Adds `value` to the entry at `row`, `column`.
    #[inline]
    pub fn add(&mut self, row: usize, column: usize, value: f64) {
        if self.compressed {
            debug_assert_eq!(
                self.calls[self.next],
                (row as u32, column as u32),
                "an assembly must repeat the calls of the first one"
            );
            add_to(&mut self.values, self.slots[self.next], value);
        } else {
            self.calls.push((row as u32, column as u32));
            self.recorded.push(value);
        }
        self.next += 1;
    }

    /// Adds a block of values whose first is at `row`, `column`: as [`Matrix::add`] row by row.
    #[inline]
    pub fn add_block<const R: usize, const C: usize>(
        &mut self,
        row: usize,
        column: usize,
        block: &[[f64; C]; R],
    ) {
        if !self.compressed || cfg!(debug_assertions) {
            for (r, values) in block.iter().enumerate() {
                for (c, value) in values.iter().enumerate() {
                    self.add(row + r, column + c, *value);
                }
            }
            return;
        }
        let slots = &self.slots[self.next..self.next + R * C];
        for (&slot, value) in slots.iter().zip(block.as_flattened()) {
            add_to(&mut self.values, slot, *value);
        }
        self.next += R * C;
    }

    /// Ends an assembly; the first time it fixes the pattern.
    pub fn compress(&mut self) {
        if self.compressed {
            debug_assert_eq!(self.next, self.calls.len());
            return;
        }
        let mut order: Vec<usize> = (0..self.calls.len()).collect();
        order.sort_by_key(|&k| self.calls[k]);
        self.slots = vec![0; self.calls.len()];
        self.row_starts.fill(0);
        let mut last = None;
        for k in order {
            let (row, column) = self.calls[k];
            let first = last != Some((row, column));
            if first {
                last = Some((row, column));
                self.columns.push(column);
                self.row_starts[row as usize + 1] += 1;
            }
            let mark = if first { FIRST } else { 0 };
            self.slots[k] = (self.columns.len() - 1) as u32 | mark;
        }
        for row in 0..self.size {
            self.row_starts[row + 1] += self.row_starts[row];
        }
        self.values = vec![0.0; self.columns.len()];
        for (k, &slot) in self.slots.iter().enumerate() {
            add_to(&mut self.values, slot, self.recorded[k]);
        }
        self.recorded = Vec::new();
        if !cfg!(debug_assertions) {
            self.calls = Vec::new();
        }
        self.compressed = true;
    }

    /// First entry of each row in [`Matrix::columns`], and one past the last.
    #[must_use]
    pub fn row_starts(&self) -> &[usize] {
        &self.row_starts
    }

    /// Column of every entry, row by row, ascending in a row.
    #[must_use]
    pub fn columns(&self) -> &[u32] {
        &self.columns
    }

    /// Value of every entry, in the order of [`Matrix::columns`].
    #[must_use]
    pub fn values(&self) -> &[f64] {
        &self.values
    }

    /// `y = A x`.
    ///
    /// # Panics
    /// When a slice is shorter than the matrix.
    pub fn multiply(&self, x: &[f64], y: &mut [f64]) {
        for row in 0..self.size {
            y[row] = (self.row_starts[row]..self.row_starts[row + 1])
                .map(|k| self.values[k] * x[self.columns[k] as usize])
                .sum();
        }
    }

    /// The matrix as full row-major storage, for tests and reports.
    #[must_use]
    pub fn to_dense(&self) -> Vec<f64> {
        let mut full = vec![0.0; self.size * self.size];
        for row in 0..self.size {
            for k in self.row_starts[row]..self.row_starts[row + 1] {
                full[row * self.size + self.columns[k] as usize] = self.values[k];
            }
        }
        full
    }
}
