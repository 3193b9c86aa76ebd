//! Friction of a joint at an instant, as results read it.

use friction::{Load, Regime};
use nalgebra::Vector3;

/// A vector at the sliding surfaces: what belongs to sliding and what belongs to turning.
///
/// Along the axes of J; of a spherical joint along the axes of I as they stood, relative to J, where
/// the stick began, or as they stand while it slides.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurfaceVector {
    /// Of the sliding motion.
    pub translation: Vector3<f64>,
    /// Of the turning motion, times the arm.
    pub rotation: Vector3<f64>,
}

/// Friction of a joint at an instant, on I.
#[derive(Clone, Copy, Debug)]
pub struct Values {
    /// Friction force, along the axes of J.
    pub force: Vector3<f64>,
    /// Friction torque about the axis or the centre of the joint, along the axes of J.
    pub torque: Vector3<f64>,
    /// Vector coefficient of friction; for LuGre the surface force divided by the load.
    pub mu: SurfaceVector,
    /// Effective static coefficient; zero while sliding and for LuGre.
    pub mu1: f64,
    /// Velocity of the sliding surfaces, I against J (length/time).
    pub velocity: SurfaceVector,
    /// Creep (length); zero for LuGre.
    pub creep: SurfaceVector,
    /// Bristle deflection (length); zero for ORIGINAL.
    pub deflection: SurfaceVector,
    /// Blend between creep (0) and velocity (1); 1 for LuGre.
    pub beta: f64,
    /// Regime of the law.
    pub regime: Regime,
    /// Load on the sliding surfaces: a force for translational and cylindrical joints, else a torque.
    pub load: Load,
    /// What causes the friction before any limit, in the unit of the load: preload, reaction force,
    /// bending moment, torsional moment. The sum is the magnitude of the friction at the surfaces.
    pub causes: [f64; 4],
    /// Whether a limit of the friction force or torque was reached.
    pub clipped: bool,
    /// Rate at which the friction takes energy out of the motion, force · length/time.
    pub power: f64,
    /// Energy stored in creep or bristles, force · length.
    pub stored: f64,
}

impl Values {
    /// Friction that rests.
    pub(crate) const NONE: Self = Self {
        force: Vector3::new(0.0, 0.0, 0.0),
        torque: Vector3::new(0.0, 0.0, 0.0),
        mu: SurfaceVector::ZERO,
        mu1: 0.0,
        velocity: SurfaceVector::ZERO,
        creep: SurfaceVector::ZERO,
        deflection: SurfaceVector::ZERO,
        beta: 0.0,
        regime: Regime::Stuck,
        load: Load::NONE,
        causes: [0.0; 4],
        clipped: false,
        power: 0.0,
        stored: 0.0,
    };
}

impl SurfaceVector {
    pub(crate) const ZERO: Self = Self {
        translation: Vector3::new(0.0, 0.0, 0.0),
        rotation: Vector3::new(0.0, 0.0, 0.0),
    };

    /// Length of the vector over both motions.
    #[must_use]
    pub fn norm(&self) -> f64 {
        self.translation.norm().hypot(self.rotation.norm())
    }
}
