//! The two formulations as one type, and the pair of numbers that preloads and limits are.

use crate::lugre::LuGre;
use crate::original::{Original, Regime};

/// A friction law (`FORMULATION`).
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Law {
    /// `ORIGINAL`: stick-slip.
    Original(Original),
    /// `LUGRE`: bristles.
    LuGre(LuGre),
}

impl Law {
    /// Regime at the speed of the surfaces (length/time).
    pub fn regime(&self, speed: f64) -> Regime {
        match self {
            Self::Original(law) => law.regime(speed),
            Self::LuGre(law) => law.regime(speed),
        }
    }

    /// The larger of its two coefficients.
    pub fn largest_coefficient(&self) -> f64 {
        match self {
            Self::Original(law) => law.mu_static.max(law.mu_dynamic),
            Self::LuGre(law) => law.mu_static.max(law.mu_dynamic),
        }
    }
}

impl From<Original> for Law {
    fn from(law: Original) -> Self {
        Self::Original(law)
    }
}

impl From<LuGre> for Law {
    fn from(law: LuGre) -> Self {
        Self::LuGre(law)
    }
}

/// A preload or a limit; a joint uses the ones that the statement has for it.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ForceAndTorque {
    /// `FRICTION_FORCE_PRELOAD` or `MAX_FRICTION_FORCE` (translational, cylindrical), force.
    pub force: f64,
    /// `FRICTION_TORQUE_PRELOAD` or `MAX_FRICTION_TORQUE` (all but translational), torque.
    pub torque: f64,
}

impl ForceAndTorque {
    /// The same number for both.
    #[must_use]
    pub const fn both(value: f64) -> Self {
        Self {
            force: value,
            torque: value,
        }
    }
}
