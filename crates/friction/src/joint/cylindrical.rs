//! Effective load of a cylindrical joint.
//!
//! # Law
//! ```text
//! N  = SW2 Fr + SW3 BF Tm/Xs
//! Fr = sqrt(Fx^2 + Fy^2),  Tm = sqrt(Mx^2 + My^2)
//! Xs = max(Xs0 + sgn (DZ - DZ0), Xs0/1000)
//! ```
//! with the symbols of the [translational](super::TranslationalLoad) joint. The surface velocity is
//! the vector `(DZ', Rp theta')`, the creep likewise: one law for both, so that a pin that spins
//! gives way along its axis. With its coefficient `(mu_z, mu_theta)` the joint has the force
//! `N mu_z` along and the torque `Rp N mu_theta` about `z_J`, each with its own preload and limit.
//!
//! | symbol | keyword | field | unit |
//! |---|---|---|---|
//! | `Rp` | `PIN_RADIUS` | [`CylindricalLoad::pin_radius`] | length |
//!
//! # Limits
//! There is no axial load and no torsional moment: the joint is free in both.
//!
//! # Source
//! Arguments and inputs are those of the help page, whose block diagram is lost; that force and
//! torque share one law follows from the results, which have one `BETA` and one `MU1` for both.

use super::{Inputs, Load, TranslationalLoad};

/// Parameters of the load of a cylindrical joint. Symbols in the file's header.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CylindricalLoad {
    /// Loads that cause friction.
    pub inputs: Inputs,
    /// `PIN_RADIUS` `Rp > 0`, length.
    pub pin_radius: f64,
    /// `BENDING_FACTOR` `BF > 0`.
    pub bending_factor: f64,
    /// `INITIAL_OVERLAP` `Xs0 > 0`, length.
    pub initial_overlap: f64,
    /// `OVERLAP_DELTA`: +1 INCREASE, -1 DECREASE, 0 CONSTANT.
    pub overlap_sign: f64,
}

impl CylindricalLoad {
    /// Load `N` (force) from the reaction force and moment on I at I in J axes, and the
    /// displacement of I along `z_J` since assembly (length).
    ///
    /// ```
    /// use friction::{CylindricalLoad, Inputs};
    /// let sleeve = CylindricalLoad {
    ///     inputs: Inputs::ALL, pin_radius: 0.02, bending_factor: 1.0,
    ///     initial_overlap: 0.5, overlap_sign: -1.0,
    /// };
    /// let load = sleeve.evaluate([30.0, 40.0, 9.0], [6.0, 8.0, 7.0], 0.1);
    /// assert!((load.value - 75.0).abs() < 1e-13); // 50 + 10/0.4
    /// ```
    #[inline(always)]
    pub fn evaluate(&self, force: [f64; 3], moment: [f64; 3], displacement: f64) -> Load {
        let guide = TranslationalLoad {
            inputs: Inputs {
                torsional_moment: false,
                ..self.inputs
            },
            reaction_arm: 1.0,
            bending_factor: self.bending_factor,
            initial_overlap: self.initial_overlap,
            overlap_sign: self.overlap_sign,
        };
        guide.evaluate(force, moment, displacement)
    }
}
