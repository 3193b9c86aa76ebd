//! MOTION: a freedom prescribed as a function.

use super::Header;
use crate::expression::Expression;

/// The freedom of a motion between two markers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MotionDirection {
    /// Displacement of I along the x axis of J.
    X,
    /// Displacement of I along the y axis of J.
    Y,
    /// Displacement of I along the z axis of J.
    Z,
    /// First body-fixed 1-2-3 angle of I relative to J.
    B1,
    /// Second body-fixed 1-2-3 angle of I relative to J.
    B2,
    /// Third body-fixed 1-2-3 angle of I relative to J.
    B3,
}

/// What a motion moves.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MotionTarget {
    /// The angle of the joint with this id.
    JointRotation(u32),
    /// The displacement of the joint with this id.
    JointTranslation(u32),
    /// One freedom of marker `i` relative to marker `j`.
    Markers {
        /// The I marker.
        i: u32,
        /// The J marker.
        j: u32,
        /// Which freedom.
        direction: MotionDirection,
    },
}

impl MotionTarget {
    /// The id of the joint that it moves, where it moves one.
    #[must_use]
    pub const fn joint(self) -> Option<u32> {
        match self {
            Self::JointRotation(id) | Self::JointTranslation(id) => Some(id),
            Self::Markers { .. } => None,
        }
    }
}

/// What the function of a motion prescribes.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub enum MotionLevel {
    /// The coordinate itself.
    #[default]
    Displacement,
    /// Its first derivative.
    Velocity,
    /// Its second derivative.
    Acceleration,
}

/// MOTION.
#[derive(Clone, Debug, PartialEq)]
pub struct Motion {
    /// Identifier, name and place.
    pub header: Header,
    /// The freedom.
    pub target: MotionTarget,
    /// The level of `function`.
    pub level: MotionLevel,
    /// Length or radians (per time, per time squared).
    pub function: Expression,
    /// ICDISP: initial displacement, for the levels velocity and acceleration.
    pub ic_displacement: Option<f64>,
    /// ICVEL: initial velocity, for the level acceleration.
    pub ic_velocity: Option<f64>,
}
