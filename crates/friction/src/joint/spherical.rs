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
//! The surface velocity is the 3-vector `Rb R_I^T (omega_I - omega_J)` in the axes of the I marker,
//! the creep `Rb` times the relative rotation vector since the stick began, in the same axes. The
//! torque is the load times the vector coefficient, in those axes too.
//!
//! # Limits
//! Neither moment is an input of this joint: its reaction is a pure force.
//!
//! # Source
//! `T = Rb |F| |mu|` holds over 2400 samples of Adams Solver C++ 2015.1 to printing accuracy.

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
