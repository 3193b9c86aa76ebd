//! CONTACT.

use super::Header;

/// CONTACT: forces where the surfaces of two sets of GRAPHICS touch.
///
/// It is read, switched and written, but not simulated.
#[derive(Clone, Debug, PartialEq)]
pub struct Contact {
    /// Identifier, name and place.
    pub header: Header,
    /// TYPE, such as `SOLID_TO_SOLID`.
    pub kind: Option<String>,
    /// IGEOM: GRAPHICS of the one side.
    pub i_geometry: Vec<u32>,
    /// JGEOM: GRAPHICS of the other side.
    pub j_geometry: Vec<u32>,
    /// How the sides push one another apart.
    pub law: ContactLaw,
    /// `COULOMB_FRICTION`, where it is not OFF.
    pub friction: Option<ContactFriction>,
}

/// The normal force of a [`Contact`].
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum ContactLaw {
    /// IMPACT: a spring of the penetration and a damper that grows with it.
    Impact {
        /// STIFFNESS, force by length to the EXPONENT.
        stiffness: f64,
        /// DAMPING at full penetration, force · time/length.
        damping: f64,
        /// EXPONENT of the penetration.
        exponent: f64,
        /// DMAX: penetration of full damping, length.
        full_damping: f64,
    },
    /// POISSON: a coefficient of restitution.
    Poisson {
        /// PENALTY, force · time/length.
        penalty: f64,
        /// `RESTITUTION_COEFFICIENT`, 0 to 1.
        restitution: f64,
    },
}

/// Friction of a [`Contact`].
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct ContactFriction {
    /// Whether friction acts in dynamics only.
    pub dynamics_only: bool,
    /// `MU_STATIC`.
    pub mu_static: Option<f64>,
    /// `MU_DYNAMIC`.
    pub mu_dynamic: Option<f64>,
    /// `STICTION_TRANSITION_VELOCITY`, length/time.
    pub stiction_velocity: Option<f64>,
    /// `FRICTION_TRANSITION_VELOCITY`, length/time.
    pub friction_velocity: Option<f64>,
    /// STICTION=ON with its `MAX_STICTION_DEFORMATION`, length.
    pub max_deformation: Option<f64>,
}
