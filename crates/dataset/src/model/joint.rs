//! JOINT, JPRIM and GCON: constraints between markers.
//!
//! In every constraint the origin `o` and the axes `x y z` of marker I are compared with those of
//! marker J.

use super::Header;
use crate::expression::Expression;

/// The type of a [`Joint`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum JointKind {
    /// `o_I = o_J`, `z_I` along `z_J`; free: the angle about `z_J`.
    Revolute,
    /// Same axes, `o_I` on the `z_J` axis; free: the displacement along `z_J`.
    Translational,
    /// `z` axes coincide; free: displacement along and angle about `z_J`.
    Cylindrical,
    /// `o_I = o_J`.
    Spherical,
    /// `z_I` along `z_J`, `o_I` in the xy plane of J.
    Planar,
    /// Origins and axes coincide.
    Fixed,
    /// `o_I = o_J`, `x_I` perpendicular to `y_J`.
    Hooke,
    /// `o_I = o_J`, `z_I` perpendicular to `z_J`.
    Universal,
    /// `o_I = o_J`; shafts along `z_I` and `z_J` turn evenly however they are bent.
    ///
    /// The documentation has `z_I` and `z_J` point along the shafts away from the common origin,
    /// turning by opposite angles: `x_I y_J + y_I x_J = 0`. The difference, which is zero for the
    /// markers that it shows, holds always where such shafts are in line, so that it cannot be the
    /// equation. For markers whose z axes point the same way the difference does what is meant.
    ConstantVelocity,
    /// As cylindrical, with `z_I` displaced by PITCH along `z_J` for every turn about it.
    Screw,
    /// A pinion, which turns about `z_I`, rolls along a rack, whose pitch line is along `z_J`.
    ///
    /// The documentation of Adams View says that `x_I` stands parallel to `z_J` and that the
    /// pinion's axis is PD/2 off the rack's axis, which other joints have to keep. So the rack
    /// moves with the velocity of the pinion where it touches the rack's axis: which way follows
    /// from the side of the rack on which the pinion stands. That I is the pinion and J the rack is
    /// how Project Chrono reads this joint.
    RackPinion,
}

impl JointKind {
    /// The name in the dataset language.
    #[must_use]
    pub const fn keyword(self) -> &'static str {
        match self {
            Self::Revolute => "REVOLUTE",
            Self::Translational => "TRANSLATIONAL",
            Self::Cylindrical => "CYLINDRICAL",
            Self::Spherical => "SPHERICAL",
            Self::Planar => "PLANAR",
            Self::Fixed => "FIXED",
            Self::Hooke => "HOOKE",
            Self::Universal => "UNIVERSAL",
            Self::ConstantVelocity => "CONVEL",
            Self::Screw => "SCREW",
            Self::RackPinion => "RACKPIN",
        }
    }

    /// Whether the joint leaves rotation about `z_J` free as its coordinate.
    #[must_use]
    pub const fn rotates(self) -> bool {
        matches!(self, Self::Revolute | Self::Cylindrical)
    }

    /// The coordinate that is meant: true for the rotation, false for the displacement. Without
    /// `rotation` it is the only one that there is; `None` where there is none such.
    #[must_use]
    pub fn coordinate(self, rotation: Option<bool>) -> Option<bool> {
        let has = |rotation| {
            if rotation {
                self.rotates()
            } else {
                self.translates()
            }
        };
        match rotation {
            Some(rotation) => Some(rotation).filter(|rotation| has(*rotation)),
            None => (has(true) != has(false)).then(|| has(true)),
        }
    }

    /// Whether the joint leaves displacement along `z_J` free as its coordinate.
    #[must_use]
    pub const fn translates(self) -> bool {
        matches!(self, Self::Translational | Self::Cylindrical)
    }
}

/// Initial displacement and velocity of a joint, of marker I relative to J, along or about `z_J`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct InitialCondition {
    /// Length or radians.
    pub displacement: Option<f64>,
    /// Length or radians per time.
    pub velocity: Option<f64>,
}

/// JOINT.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// Identifier, name and place.
    pub header: Header,
    /// Type.
    pub kind: JointKind,
    /// The I marker.
    pub i: u32,
    /// The J marker, on another part.
    pub j: u32,
    /// PITCH of a screw joint: length a turn, not zero, positive for a right-hand thread.
    pub pitch: Option<f64>,
    /// PD of a rack and pinion: pitch diameter, not zero; a negative one turns the direction round.
    pub pitch_diameter: Option<f64>,
    /// IC of a translational joint, ICTRAN of a cylindrical one.
    pub ic_translation: Option<InitialCondition>,
    /// IC of a revolute joint, ICROT of a cylindrical one.
    pub ic_rotation: Option<InitialCondition>,
}

/// The type of a [`JointPrimitive`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum PrimitiveKind {
    /// `o_I = o_J`: three equations.
    AtPoint,
    /// `o_I` on the `z_J` axis: two.
    Inline,
    /// `o_I` in the xy plane of J: one.
    Inplane,
    /// Same axes: three.
    Orientation,
    /// `z_I` along `z_J`: two.
    ParallelAxes,
    /// `z_I` perpendicular to `z_J`: one.
    Perpendicular,
}

impl PrimitiveKind {
    /// The name in the dataset language.
    #[must_use]
    pub const fn keyword(self) -> &'static str {
        match self {
            Self::AtPoint => "ATPOINT",
            Self::Inline => "INLINE",
            Self::Inplane => "INPLANE",
            Self::Orientation => "ORIENTATION",
            Self::ParallelAxes => "PARALLEL_AXES",
            Self::Perpendicular => "PERPENDICULAR",
        }
    }
}

/// JPRIM.
#[derive(Clone, Debug, PartialEq)]
pub struct JointPrimitive {
    /// Identifier, name and place.
    pub header: Header,
    /// Type.
    pub kind: PrimitiveKind,
    /// The I marker.
    pub i: u32,
    /// The J marker.
    pub j: u32,
}

/// GCON: the constraint `function = 0` on positions.
#[derive(Clone, Debug, PartialEq)]
pub struct GeneralConstraint {
    /// Identifier, name and place.
    pub header: Header,
    /// The marker at which the reaction is reported.
    pub i: Option<u32>,
    /// The expression that is kept at zero.
    pub function: Expression,
}
