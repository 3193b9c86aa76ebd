//! COUPLER and GEAR: coordinates of joints that move in proportion.

use super::Header;

/// One coordinate of a [`Coupler`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CoupledFreedom {
    /// The joint: revolute, translational or cylindrical.
    pub joint: u32,
    /// TYPE: whether it is the rotation of the joint (radians) or its displacement (length); without
    /// it the only coordinate that the joint has, see
    /// [`JointKind::coordinate`](crate::JointKind::coordinate).
    pub rotation: Option<bool>,
    /// SCALES: its factor in the sum.
    pub scale: f64,
}

/// COUPLER: the sum of the coordinates of two or three joints, each times its scale, stays as the
/// dataset places the parts. A coordinate is that of I relative to J, about or along `z_J`.
#[derive(Clone, Debug, PartialEq)]
pub struct Coupler {
    /// Identifier, name and place.
    pub header: Header,
    /// Two or three coordinates.
    pub freedoms: Vec<CoupledFreedom>,
}

/// GEAR: the parts that two joints move on a common carrier have the same velocity along `z_CV` at
/// the origin of CV, where their teeth touch.
#[derive(Clone, Debug, PartialEq)]
pub struct Gear {
    /// Identifier, name and place.
    pub header: Header,
    /// JOINTS: two revolute, translational or cylindrical joints with a marker on the carrier.
    pub joints: Vec<u32>,
    /// CV: a marker on the carrier, z along the velocity of the teeth.
    pub cv: u32,
}
