//! A block on a guide down a slope, with friction in the translational joint.

use friction::{Inputs, TranslationalLoad};
use mechanics::Snapshot;
use mechanics::model::{ForceAndTorque, FrictionJoint, JointKind, Law, Model};
use nalgebra::Vector3;

use crate::builder::{Builder, v};

/// The block and its friction; it slides along x, downhill positive.
#[derive(Clone, Copy)]
pub(crate) struct Block {
    pub(crate) mass: f64,
    pub(crate) gravity: f64,
    /// Slope, degrees.
    pub(crate) slope: f64,
    /// Velocity at the start.
    pub(crate) velocity: f64,
    pub(crate) law: Law,
    pub(crate) load: TranslationalLoad,
    pub(crate) preload: f64,
    pub(crate) maximum: f64,
    /// Torque that bends the guide, and torque about it.
    pub(crate) bending: f64,
    pub(crate) torsion: f64,
}

impl Block {
    /// 2 kg on 30°, g = 9.80665 m/s², at rest.
    pub(crate) fn new(law: impl Into<Law>) -> Self {
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

    pub(crate) fn builder(&self) -> Builder {
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

    pub(crate) fn model(&self) -> Model {
        self.builder().model
    }
}

/// Place of the block along the guide.
pub(crate) fn place(snapshot: &Snapshot<'_>) -> f64 {
    snapshot.state().centre(0).x
}

/// Its velocity.
pub(crate) fn speed(snapshot: &Snapshot<'_>) -> f64 {
    snapshot.state().velocities()[0]
}
