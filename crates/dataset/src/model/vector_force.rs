//! VFORCE, VTORQUE and GFORCE: forces and torques given by components.

use super::Header;
use crate::expression::Expression;

/// VFORCE, VTORQUE or GFORCE: components along the axes of RM, acting on I at its origin; the
/// opposite acts on the part of JFLOAT at the same point.
#[derive(Clone, Debug, PartialEq)]
pub struct VectorForce {
    /// Identifier, name and place.
    pub header: Header,
    /// The I marker, on which the force acts.
    pub i: u32,
    /// JFLOAT: a floating marker on the part on which the opposite acts.
    pub j_float: u32,
    /// RM: the marker along whose axes the components are, on any part.
    pub rm: u32,
    /// FX, FY, FZ, TX, TY and TZ: functions; `None` is zero. VFORCE has no torques and VTORQUE no
    /// forces.
    pub components: [Option<Expression>; 6],
    /// FXYZ and TXYZ: three components at once, which are then absent above.
    pub vectors: [Option<Expression>; 2],
}
