//! What a step discretises, and by which formulas.

use numerics::bdf::{Family, Newmark};
use serde::{Deserialize, Serialize};

/// How the equations are stepped through time: the formulas, and how the constraints enter.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub enum Formulation {
    /// Backward differentiation with position constraints only (index 3); velocities and reactions
    /// follow by differentiation.
    I3,
    /// Backward differentiation of stabilised index 2: position and velocity constraints.
    Si2,
    /// Formulas of Adams up to order 12 for the accelerations (index 1), and every step brought back
    /// onto the position and velocity constraints. For smooth motion; stiff equations cost short
    /// steps.
    Adams,
    /// The method of Hilber, Hughes and Taylor with position constraints: second order, with numerical
    /// damping that grows with `-alpha`, from −1/3 (most) to 0 (none).
    ///
    /// `β = (1 − α)²/4`, `γ = ½ − α`, and forces `(1 + α) F − α F₀` (Negrut, Rampalli, Ottarsson,
    /// Sajdak 2007).
    Hht {
        /// α.
        alpha: f64,
    },
    /// Newmark's method with position constraints: of second order for `γ = ½` only.
    Newmark {
        /// β.
        beta: f64,
        /// γ.
        gamma: f64,
    },
}

/// How constraints enter a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Index {
    /// Accelerations meet the constraints; positions and velocities are brought back after.
    One,
    /// Velocities and positions meet them.
    StabilisedTwo,
    /// Positions meet them.
    Three,
}

impl Formulation {
    /// The formulas.
    pub(crate) fn family(self) -> Family {
        match self {
            Self::I3 | Self::Si2 => Family::BackwardDifferences,
            Self::Adams => Family::Adams,
            Self::Hht { alpha } => {
                let beta = (1.0 - alpha).powi(2) / 4.0;
                Family::Newmark(newmark(beta, 0.5 - alpha, alpha, 0.0))
            }
            Self::Newmark { beta, gamma } => {
                Family::Newmark(newmark(beta, gamma, 0.0, gamma - 0.5))
            }
        }
    }

    /// How the constraints enter.
    pub(crate) fn index(self) -> Index {
        match self {
            Self::Adams => Index::One,
            Self::Si2 => Index::StabilisedTwo,
            Self::I3 | Self::Hht { .. } | Self::Newmark { .. } => Index::Three,
        }
    }

    /// Whether the error test looks at velocities where only positions meet the constraints.
    ///
    /// Positions of a step see none of what its velocities lose, and with `γ` other than ½ Newmark's
    /// velocities lose most: a part `(γ − ½) h²` of the rate of the accelerations, step by step.
    pub(crate) fn tests_velocities(self) -> bool {
        matches!(self, Self::Newmark { gamma, .. } if gamma != 0.5)
    }

    /// α of the forces; zero for all but HHT.
    pub(crate) fn alpha(self) -> f64 {
        match self {
            Self::Hht { alpha } => alpha,
            _ => 0.0,
        }
    }
}

/// The local error of the positions is `(β − 1/(6 (1 + α))) h² (a − a₀)` (Negrut et al. 2007, section
/// 3.2), where they differ from their prediction by `β h² (a − a₀)`. That of the velocities is
/// `excess · h (a − a₀)` with `excess = γ + α − ½`, where they differ by `γ h (a − a₀)`; without excess an
/// error of higher order is left, for which that of the positions stands.
fn newmark(beta: f64, gamma: f64, alpha: f64, excess: f64) -> Newmark {
    let error = (1.0 - 1.0 / (6.0 * (1.0 + alpha) * beta)).abs();
    Newmark {
        beta,
        gamma,
        error,
        slope_error: if excess == 0.0 {
            error
        } else {
            (excess / gamma).abs()
        },
    }
}
