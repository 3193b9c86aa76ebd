//! A body on a horizontal axis along which it slides and about which it turns.

use friction::{CylindricalLoad, Inputs};
use mechanics::model::{FrictionJoint, JointKind, Law, Model};
use nalgebra::Vector3;

use crate::builder::{Builder, v};

/// 2 kg with the given inertia on an axis of radius `pin_radius` along x; `weight` presses it down.
#[derive(Clone, Copy, Debug)]
pub struct Sleeve {
    /// Weight, across the axis.
    pub weight: f64,
    /// Inertia about every axis through the centre.
    pub inertia: f64,
    /// Radius of the axis.
    pub pin_radius: f64,
    /// Velocity along and about the axis at the start.
    pub start: [f64; 2],
}

impl Sleeve {
    /// The sleeve with friction by `law` in its cylindrical joint.
    pub fn model(&self, law: impl Into<Law>) -> Model {
        let mass = 2.0;
        let mut b = Builder::new(v(0.0, -self.weight / mass, 0.0));
        let body = b.body(mass, [self.inertia; 3], Vector3::zeros());
        let x = Vector3::x();
        let joint = b.joint(
            JointKind::Cylindrical,
            Some(body),
            None,
            Vector3::zeros(),
            x,
        );
        b.spin(body, self.start[1] * x, Vector3::zeros());
        b.model.bodies[body].velocity = self.start[0] * x;
        let load = CylindricalLoad {
            inputs: Inputs::ALL,
            pin_radius: self.pin_radius,
            bending_factor: 1.0,
            initial_overlap: 1000.0,
            overlap_sign: 0.0,
        };
        b.friction(joint, law, FrictionJoint::Cylindrical(load));
        b.model
    }
}
