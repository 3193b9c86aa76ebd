//! CURVE and PTCV: a curve through points, and a point on a curve.

use super::Header;

/// CURVE: a curve through points, along the axes of the marker that it is used with. Its parameter
/// goes from -1 at the first point to 1 at the last one, in proportion to the length of the lines
/// between the points.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Identifier, name and place.
    pub header: Header,
    /// CLOSED: the last point is the first one, and the curve is smooth there.
    pub closed: bool,
    /// MATRIX: the points, three coordinates in a row; `None` where a subroutine gives them, which
    /// nothing that is simulated can use.
    pub matrix: Option<u32>,
    /// ORDER: 2 for straight lines, 4 for a cubic spline.
    pub order: u32,
}

/// PTCV: the origin of marker I stays on a curve.
#[derive(Clone, Debug, PartialEq)]
pub struct PointCurve {
    /// Identifier, name and place.
    pub header: Header,
    /// The I marker, on another part than RM.
    pub i: u32,
    /// JFLOAT: a floating marker on the part of RM, where the reaction on that part acts.
    pub j_float: u32,
    /// RM: the marker that the curve is fixed to; its coordinates are along the axes of RM.
    pub rm: u32,
    /// CURVE.
    pub curve: u32,
}
