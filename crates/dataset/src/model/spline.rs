//! SPLINE: data points that functions interpolate.

use super::Header;

/// SPLINE: `y` over rising `x`, for one curve or for several at rising `z`. AKISPL and CUBSPL say
/// how it is interpolated in `x`; between curves it is linear in `z`.
#[derive(Clone, Debug, PartialEq)]
pub struct Spline {
    /// Identifier, name and place.
    pub header: Header,
    /// X: at least four numbers, each greater than the one before.
    pub x: Vec<f64>,
    /// Y (and Z): the curves by rising `z`.
    pub curves: Vec<SplineCurve>,
    /// `LINEAR_EXTRAPOLATE`: outside the points by the line through the outer two; otherwise by
    /// the parabola through the outer three.
    pub linear_extrapolate: bool,
}

impl Spline {
    /// The fewest points that a curve is drawn through.
    pub const FEWEST: usize = 4;
}

/// One curve of a [`Spline`].
#[derive(Clone, Debug, PartialEq)]
pub struct SplineCurve {
    /// Its `z`; 0 for a curve alone.
    pub z: f64,
    /// One number for each `x`.
    pub y: Vec<f64>,
}
