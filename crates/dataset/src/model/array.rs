//! ARRAY, MATRIX and STRING: data that other statements name.

use super::Header;

/// ARRAY: numbers, or names for the inputs, states and outputs of a linear system.
#[derive(Clone, Debug, PartialEq)]
pub struct Array {
    /// Identifier, name and place.
    pub header: Header,
    /// What its elements are.
    pub kind: ArrayKind,
    /// SIZE, where it is given.
    pub size: Option<u32>,
}

/// What the elements of an ARRAY are.
#[derive(Clone, Debug, PartialEq)]
pub enum ArrayKind {
    /// X: the states of the LSE or TFSISO that names it.
    States,
    /// Y: the outputs of the LSE or TFSISO that names it.
    Outputs,
    /// U: VARIABLEs, by id.
    Inputs(Vec<u32>),
    /// IC: numbers.
    Numbers(Vec<f64>),
}

impl Array {
    /// Number of elements; `None` for states and outputs without SIZE.
    #[must_use]
    pub fn count(&self) -> Option<usize> {
        match &self.kind {
            ArrayKind::States | ArrayKind::Outputs => self.size.map(|size| size as usize),
            ArrayKind::Inputs(variables) => Some(variables.len()),
            ArrayKind::Numbers(numbers) => Some(numbers.len()),
        }
    }
}

/// MATRIX: numbers by row and column, each counted from 0; those not listed are zero.
#[derive(Clone, Debug, PartialEq)]
pub struct Matrix {
    /// Identifier, name and place.
    pub header: Header,
    /// Number of rows.
    pub rows: usize,
    /// Number of columns.
    pub columns: usize,
    /// Row, column and value, in the order of the statement.
    pub entries: Vec<(usize, usize, f64)>,
}

impl Matrix {
    /// The most rows and columns of a matrix that a system can have: sparse ones name them without
    /// giving them.
    pub const MOST: usize = 10_000;

    /// Its numbers row after row; `None` where not every one is given.
    #[must_use]
    pub fn by_rows(&self) -> Option<Vec<f64>> {
        let count = self.rows.checked_mul(self.columns)?;
        if self.entries.len() != count {
            return None;
        }
        let mut values = vec![None; count];
        for &(row, column, value) in &self.entries {
            *values.get_mut(row * self.columns + column)? = Some(value);
        }
        values.into_iter().collect()
    }
}

/// STRING: a text that subroutines read.
#[derive(Clone, Debug, PartialEq)]
pub struct Text {
    /// Identifier, name and place.
    pub header: Header,
    /// The text.
    pub text: String,
}
