//! Effective load of a translational joint.
//!
//! # Law
//! ```text
//! N  = SW2 Fr + SW3 BF Tm/Xs + SW4 |Tn|/Rn
//! Fr = sqrt(Fx^2 + Fy^2),  Tm = sqrt(Mx^2 + My^2),  Tn = Mz
//! Xs = max(Xs0 + sgn (DZ - DZ0), Xs0/1000)
//! ```
//! | symbol | keyword | field | unit |
//! |---|---|---|---|
//! | `SW2..SW4` | `INPUTS` | [`TranslationalLoad::inputs`] | |
//! | `Rn` | `REACTION_ARM` | [`TranslationalLoad::reaction_arm`] | length |
//! | `BF` | `BENDING_FACTOR` | [`TranslationalLoad::bending_factor`] | 1 |
//! | `Xs0` | `INITIAL_OVERLAP` | [`TranslationalLoad::initial_overlap`] | length |
//! | `sgn` | `OVERLAP_DELTA` | [`TranslationalLoad::overlap_sign`] | |
//! | `DZ - DZ0` | | displacement of I along `z_J` since assembly | length |
//!
//! # Limits
//! The lower limit on the overlap is our choice: no source says what happens when the slider has
//! left its guide.
//!
//! # Source
//! Help page of the `FRICTION` statement and of its translational joint, which names every
//! ingredient; that the magnitudes add is inferred from the revolute joint, where it is proven.

use super::{Inputs, Load};
use crate::vector::length_and_direction;

/// Smallest overlap kept, as a share of the initial one.
const SMALLEST_OVERLAP: f64 = 1e-3;

/// Parameters of the load of a translational joint. Symbols in the file's header.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct TranslationalLoad {
    /// Loads that cause friction.
    pub inputs: Inputs,
    /// `REACTION_ARM` `Rn > 0`, length.
    pub reaction_arm: f64,
    /// `BENDING_FACTOR` `BF > 0`.
    pub bending_factor: f64,
    /// `INITIAL_OVERLAP` `Xs0 > 0`, length.
    pub initial_overlap: f64,
    /// `OVERLAP_DELTA`: +1 INCREASE, -1 DECREASE, 0 CONSTANT.
    pub overlap_sign: f64,
}

impl TranslationalLoad {
    /// Load `N` (force) from the reaction force and moment on I at I in J axes, and the
    /// displacement of I along `z_J` since assembly (length).
    ///
    /// ```
    /// use friction::{Inputs, TranslationalLoad};
    /// let guide = TranslationalLoad {
    ///     inputs: Inputs::ALL, reaction_arm: 0.1, bending_factor: 1.5,
    ///     initial_overlap: 0.25, overlap_sign: 0.0,
    /// };
    /// let load = guide.evaluate([30.0, 40.0, 0.0], [6.0, 8.0, -3.0], 0.0);
    /// assert!((load.value - 140.0).abs() < 1e-13); // 50 + 1.5*10/0.25 + 3/0.1
    /// ```
    #[inline(always)]
    pub fn evaluate(&self, force: [f64; 3], moment: [f64; 3], displacement: f64) -> Load {
        let on = |switch: bool| if switch { 1.0 } else { 0.0 };
        let least = SMALLEST_OVERLAP * self.initial_overlap;
        let free_overlap = self.initial_overlap + self.overlap_sign * displacement;
        let overlap_exhausted = free_overlap < least;
        let overlap = if overlap_exhausted {
            least
        } else {
            free_overlap
        };

        let (lateral, lateral_unit) = length_and_direction(&[force[0], force[1]]);
        let (bending, bending_unit) = length_and_direction(&[moment[0], moment[1]]);
        let (torsion, torsion_unit) = length_and_direction(&[moment[2]]);
        let reaction_factor = on(self.inputs.reaction_force);
        let bending_factor = on(self.inputs.bending_moment) * self.bending_factor / overlap;
        let torsion_factor = on(self.inputs.torsional_moment) / self.reaction_arm;

        let from_reaction = reaction_factor * lateral;
        let from_bending = bending_factor * bending;
        let from_torsion = torsion_factor * torsion;
        Load {
            value: from_reaction + from_bending + from_torsion,
            by_force: [
                reaction_factor * lateral_unit[0],
                reaction_factor * lateral_unit[1],
                0.0,
            ],
            by_moment: [
                bending_factor * bending_unit[0],
                bending_factor * bending_unit[1],
                torsion_factor * torsion_unit[0],
            ],
            by_displacement: if overlap_exhausted {
                0.0
            } else {
                -from_bending / overlap * self.overlap_sign
            },
            from_reaction,
            from_bending,
            from_torsion,
            overlap_exhausted,
        }
    }
}
