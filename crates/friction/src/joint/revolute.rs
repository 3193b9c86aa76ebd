//! Effective load of a revolute joint.
//!
//! # Law
//! ```text
//! Teff = SW2 (Rp Fr + Rn Fa) + SW3 (Rp/Rb) Tr
//! Fr = sqrt(Fx^2 + Fy^2),  Fa = |Fz|,  Tr = sqrt(Mx^2 + My^2)
//! ```
//! | symbol | keyword | field | unit |
//! |---|---|---|---|
//! | `SW2`, `SW3` | `INPUTS` | [`RevoluteLoad::inputs`] | |
//! | `Rp` | `PIN_RADIUS` | [`RevoluteLoad::pin_radius`] | length |
//! | `Rn` | `FRICTION_ARM` | [`RevoluteLoad::friction_arm`] | length |
//! | `Rb` | `BENDING_REACTION_ARM` | [`RevoluteLoad::bending_reaction_arm`] | length |
//!
//! The surface velocity of the joint is `Rp` times the angular rate about `z_J`, the creep `Rp`
//! times the angle since the stick began.
//!
//! # Limits
//! The torsional moment is no input of this joint: it is free in that direction.
//!
//! # Source
//! That the magnitudes add is proven on published Adams results of a spatial four-bar at three load
//! levels; the arm on the axial force is documented, the other two arms follow sister codes.

use super::{Inputs, Load};
use crate::vector::length_and_direction;

/// Parameters of the load of a revolute joint. Symbols in the file's header.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RevoluteLoad {
    /// Loads that cause friction.
    pub inputs: Inputs,
    /// `PIN_RADIUS` `Rp > 0`, length.
    pub pin_radius: f64,
    /// `FRICTION_ARM` `Rn > 0`, length.
    pub friction_arm: f64,
    /// `BENDING_REACTION_ARM` `Rb > 0`, length.
    pub bending_reaction_arm: f64,
}

impl RevoluteLoad {
    /// Load `Teff` (torque) from the reaction force and moment on I at I in J axes.
    ///
    /// ```
    /// use friction::{Inputs, RevoluteLoad};
    /// let pin = RevoluteLoad {
    ///     inputs: Inputs::ALL, pin_radius: 0.05, friction_arm: 0.08, bending_reaction_arm: 0.1,
    /// };
    /// let load = pin.evaluate([300.0, 400.0, -200.0], [30.0, 40.0, 7.0]);
    /// assert!((load.value - 66.0).abs() < 1e-13); // 25 + 16 + 25
    /// ```
    #[inline(always)]
    pub fn evaluate(&self, force: [f64; 3], moment: [f64; 3]) -> Load {
        let on = |switch: bool| if switch { 1.0 } else { 0.0 };
        let (radial, radial_unit) = length_and_direction(&[force[0], force[1]]);
        let (axial, axial_unit) = length_and_direction(&[force[2]]);
        let (bending, bending_unit) = length_and_direction(&[moment[0], moment[1]]);
        let radial_arm = on(self.inputs.reaction_force) * self.pin_radius;
        let axial_arm = on(self.inputs.reaction_force) * self.friction_arm;
        let bending_ratio =
            on(self.inputs.bending_moment) * self.pin_radius / self.bending_reaction_arm;

        let from_reaction = radial_arm * radial + axial_arm * axial;
        let from_bending = bending_ratio * bending;
        Load {
            value: from_reaction + from_bending,
            by_force: [
                radial_arm * radial_unit[0],
                radial_arm * radial_unit[1],
                axial_arm * axial_unit[0],
            ],
            by_moment: [
                bending_ratio * bending_unit[0],
                bending_ratio * bending_unit[1],
                0.0,
            ],
            by_displacement: 0.0,
            from_reaction,
            from_bending,
            from_torsion: 0.0,
            overlap_exhausted: false,
        }
    }
}
