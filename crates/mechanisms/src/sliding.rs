//! A block on a guide down a slope, with friction in the translational joint.

use friction::{Inputs, TranslationalLoad};
use mechanics::Snapshot;
use mechanics::model::{ForceAndTorque, FrictionJoint, JointKind, Law, Model};
use nalgebra::Vector3;

use crate::builder::{Builder, v};

/// The block and its friction; it slides along x, downhill positive.
#[derive(Clone, Copy, Debug)]
pub struct Block {
    /// Its mass.
    pub mass: f64,
    /// Acceleration of gravity.
    pub gravity: f64,
    /// Slope, degrees.
    pub slope: f64,
    /// Velocity at the start.
    pub velocity: f64,
    /// The law of friction.
    pub law: Law,
    /// What loads the guide.
    pub load: TranslationalLoad,
    /// Friction without load.
    pub preload: f64,
    /// Limit of friction by load.
    pub maximum: f64,
    /// Torque that bends the guide.
    pub bending: f64,
    /// Torque about the guide.
    pub torsion: f64,
}

impl Block {
    /// 2 kg on 30°, g = 9.80665 m/s², at rest.
    pub fn new(law: impl Into<Law>) -> Self {
        Self {
            mass: 2.0,
            gravity: 9.80665,
            slope: 30.0,
            velocity: 0.0,
            law: law.into(),
            load: TranslationalLoad {
                inputs: Inputs::ALL,
                reaction_arm: 1.0,
                bending_factor: 1.0,
                initial_overlap: 1000.0,
                overlap_sign: 0.0,
            },
            preload: 0.0,
            maximum: 1e40,
            bending: 0.0,
            torsion: 0.0,
        }
    }

    /// The block on its slope, to add to.
    #[must_use]
    pub fn builder(&self) -> Builder {
        let (sine, cosine) = self.slope.to_radians().sin_cos();
        let mut b = Builder::new(self.gravity * v(sine, -cosine, 0.0));
        let block = b.body(self.mass, [0.02; 3], Vector3::zeros());
        let joint = b.joint(
            JointKind::Translational,
            Some(block),
            None,
            Vector3::zeros(),
            Vector3::x(),
        );
        if self.bending != 0.0 {
            b.torque(block, Vector3::z(), self.bending);
        }
        if self.torsion != 0.0 {
            b.torque(block, Vector3::x(), self.torsion);
        }
        b.model.bodies[block].velocity = v(self.velocity, 0.0, 0.0);
        b.model.bodies[block].given_velocity = [true; 6];
        b.friction(joint, self.law, FrictionJoint::Translational(self.load));
        b.model.frictions[0].preload = ForceAndTorque::both(self.preload);
        b.model.frictions[0].maximum = ForceAndTorque::both(self.maximum);
        b
    }

    /// The block on its slope.
    #[must_use]
    pub fn model(&self) -> Model {
        self.builder().model
    }
}

/// Place of the block along the guide.
#[must_use]
pub fn place(snapshot: &Snapshot<'_>) -> f64 {
    snapshot.state().centre(0).x
}

/// Its velocity.
#[must_use]
pub fn speed(snapshot: &Snapshot<'_>) -> f64 {
    snapshot.state().velocities()[0]
}
