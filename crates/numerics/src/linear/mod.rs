//! Matrices assembled in a fixed order, and their factorisation.
//!
//! [`Matrix`] is sparse with a pattern found once; [`FrontalLu`] orders that pattern once and factors
//! many times, with pivots chosen anew each time. A dense LU is the oracle that the tests compare with.

#[cfg(test)]
mod dense;
mod frontal;
#[cfg(test)]
mod frontal_test;
mod fronts;
mod matrix;
mod ordering;
mod scaling;

pub use frontal::FrontalLu;
pub use matrix::Matrix;

/// A factorisation met no usable pivot.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Singular {
    /// A row of the caller's matrix that depends on the others.
    pub row: usize,
    /// A column of the caller's matrix that depends on the others.
    pub column: usize,
}

impl std::fmt::Display for Singular {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(
            f,
            "the matrix is singular at row {} and column {}",
            self.row, self.column
        )
    }
}

impl std::error::Error for Singular {}
