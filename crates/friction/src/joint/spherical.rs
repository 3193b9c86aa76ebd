//! Effective load of a spherical joint.
//!
//! # Law
//! ```text
//! Teff = SW2 Rb |F|
//! ```
//! | symbol | keyword | field | unit |
//! |---|---|---|---|
//! | `SW2` | `INPUTS` | [`SphericalLoad::inputs`] | |
//! | `Rb` | `BALL_RADIUS` | [`SphericalLoad::ball_radius`] | length |
//!
//! The surface velocity is the 3-vector `Rb (omega_I - omega_J)`, the creep `Rb` times the relative
//! rotation since the stick began, and the torque is the load times the vector coefficient. All
//! three are taken in axes that are **fixed to the J marker** while the joint sticks: those of the
//! J marker itself, or of the I marker as it stood, relative to J, where the stick began. The law
//! turns with its arguments, so both give the same torque; the axes of the I marker as it stands
//! *now* do not, by the angle of the creep. Results print the velocity, the coefficient and the
//! creep in the frozen I axes and the torque in J axes.
//!
//! # Limits
//! Neither moment is an input of this joint: its reaction is a pure force.
//!
//! # Source
//! `T = Rb |F| |mu|` holds over 2400 samples of Adams Solver C++ 2015.1 to 4e-15. As a vector in J
//! axes, computed from the motion of the parts, the torque agrees to 6e-10 (the marker angles of
//! that model have ten digits) also where it sticks; with the present I axes only to 6e-4.

use super::{Inputs, Load};
use crate::vector::length_and_direction;

/// Parameters of the load of a spherical joint. Symbols in the file's header.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct SphericalLoad {
    /// Loads that cause friction.
    pub inputs: Inputs,
    /// `BALL_RADIUS` `Rb > 0`, length.
    pub ball_radius: f64,
}

impl SphericalLoad {
    /// Load `Rb |F|` (torque) from the reaction force on I, in any axes.
    ///
    /// ```
    /// use friction::{Inputs, SphericalLoad};
    /// let ball = SphericalLoad { inputs: Inputs::ALL, ball_radius: 0.02 };
    /// assert_eq!(ball.evaluate([60.0, 0.0, -80.0]).value, 2.0);
    /// ```
    #[inline(always)]
    pub fn evaluate(&self, force: [f64; 3]) -> Load {
        let arm = if self.inputs.reaction_force {
            self.ball_radius
        } else {
            0.0
        };
        let (magnitude, unit) = length_and_direction(&force);
        Load {
            value: arm * magnitude,
            by_force: unit.map(|c| arm * c),
            by_moment: [0.0; 3],
            by_displacement: 0.0,
            from_reaction: arm * magnitude,
            from_bending: 0.0,
            from_torsion: 0.0,
            overlap_exhausted: false,
        }
    }
}
