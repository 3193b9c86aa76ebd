//! Effective load of each joint type: what multiplies the coefficient of friction.
//!
//! All loads are sums of magnitudes of parts of the joint's reaction, each behind one of the
//! switches of `INPUTS`. The reaction is that of the **joint constraint alone** (friction
//! excluded): force and moment on the I part at the origin of the I marker, components along the
//! axes of the J marker, z being the axis of the joint.
//!
//! A hooke or universal joint has the load of a [revolute](RevoluteLoad) one on each of its two pins,
//! with the reaction along axes whose z is the pin.
//!
//! A magnitude is not differentiable where it vanishes; there its derivative is taken as zero.

mod cylindrical;
mod revolute;
mod spherical;
mod translational;

pub use cylindrical::CylindricalLoad;
pub use revolute::RevoluteLoad;
pub use spherical::SphericalLoad;
pub use translational::TranslationalLoad;

/// The switches of `INPUTS`: which loads cause friction.
///
/// A joint type uses the switches available to it: all four for translational joints, preload and
/// reaction force for spherical ones, all but the torsional moment for the others.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Inputs {
    /// `PRELOAD` (for the caller: it enters [`resultant`](crate::resultant()), not the load).
    pub preload: bool,
    /// `REACTION_FORCE`.
    pub reaction_force: bool,
    /// `BENDING_MOMENT`.
    pub bending_moment: bool,
    /// `TORSIONAL_MOMENT`.
    pub torsional_moment: bool,
}

impl Inputs {
    /// `INPUTS=ALL`, the default.
    pub const ALL: Self = Self {
        preload: true,
        reaction_force: true,
        bending_moment: true,
        torsional_moment: true,
    };
    /// `INPUTS=NONE`.
    pub const NONE: Self = Self {
        preload: false,
        reaction_force: false,
        bending_moment: false,
        torsional_moment: false,
    };

    /// The preload where `PRELOAD` is among the inputs, else zero.
    pub(crate) fn preloaded(self, preload: f64) -> f64 {
        if self.preload { preload } else { 0.0 }
    }
}

/// Effective load of a joint with its derivatives.
///
/// Unit: force for translational and cylindrical joints, torque for the others.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Load {
    /// The load, never negative: the sum of the three contributions below.
    pub value: f64,
    /// Derivative by the reaction force.
    pub by_force: [f64; 3],
    /// Derivative by the reaction moment.
    pub by_moment: [f64; 3],
    /// Derivative by the displacement since assembly (translational and cylindrical joints, else zero).
    pub by_displacement: f64,
    /// Contribution of the reaction force.
    pub from_reaction: f64,
    /// Contribution of the bending moment.
    pub from_bending: f64,
    /// Contribution of the torsional moment.
    pub from_torsion: f64,
    /// The overlap has shrunk to its lower limit and the load is no longer physical: worth one
    /// warning (translational and cylindrical joints, else false).
    pub overlap_exhausted: bool,
}

impl Load {
    /// No load.
    pub const NONE: Self = Self {
        value: 0.0,
        by_force: [0.0; 3],
        by_moment: [0.0; 3],
        by_displacement: 0.0,
        from_reaction: 0.0,
        from_bending: 0.0,
        from_torsion: 0.0,
        overlap_exhausted: false,
    };
}
