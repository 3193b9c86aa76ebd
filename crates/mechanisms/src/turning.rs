//! Bodies that turn in a revolute or spherical joint with friction.

use friction::{Inputs, Original, RevoluteLoad, SphericalLoad};
use mechanics::model::{FrictionJoint, JointKind, Law, Model};
use mechanics::rotation::Quaternion;
use nalgebra::{Matrix3, Vector3};

use crate::builder::{Builder, v};

/// The load of a pin of the given radius by its reaction force alone.
#[must_use]
pub fn pin_load(pin_radius: f64, friction_arm: f64) -> FrictionJoint {
    FrictionJoint::Revolute(RevoluteLoad {
        inputs: Inputs {
            bending_moment: false,
            ..Inputs::ALL
        },
        pin_radius,
        friction_arm,
        bending_reaction_arm: 1.0,
    })
}

/// The load of a bearing: its reaction force, radial and axial, and its bending moment.
#[must_use]
pub fn bearing_load(
    pin_radius: f64,
    friction_arm: f64,
    bending_reaction_arm: f64,
) -> FrictionJoint {
    FrictionJoint::Revolute(RevoluteLoad {
        inputs: Inputs::ALL,
        pin_radius,
        friction_arm,
        bending_reaction_arm,
    })
}

/// 1 kg at `length` below a pin of radius `pin_radius`, swung out by `angle` about z and turning
/// at `rate`; `inertia` is that of the centre of mass about z. The angle of the body is its
/// rotation, so it starts at zero: the pendulum's angle is `angle` plus that.
#[derive(Clone, Copy, Debug)]
pub struct Pendulum {
    /// From the pin to the centre of mass.
    pub length: f64,
    /// Radius of the pin.
    pub pin_radius: f64,
    /// Inertia about the centre of mass.
    pub inertia: f64,
    /// Acceleration of gravity.
    pub gravity: f64,
    /// Angle from hanging down at the start.
    pub angle: f64,
    /// Angular velocity at the start.
    pub rate: f64,
    /// The law of friction.
    pub law: Law,
}

impl Pendulum {
    /// The pendulum with friction in its pin.
    #[must_use]
    pub fn model(&self) -> Model {
        let mut b = Builder::new(v(0.0, -self.gravity, 0.0));
        let centre = self.length * v(self.angle.sin(), -self.angle.cos(), 0.0);
        let body = b.body(1.0, [self.inertia; 3], centre);
        let joint = b.pin(Some(body), None, Vector3::zeros());
        b.spin(body, v(0.0, 0.0, self.rate), Vector3::zeros());
        b.friction(joint, self.law, pin_load(self.pin_radius, 1.0));
        b.model
    }
}

/// A rotor on a vertical axis that carries its weight on a collar of radius `friction_arm`.
#[must_use]
pub fn rotor(
    weight: f64,
    inertia: f64,
    pin_radius: f64,
    friction_arm: f64,
    rate: f64,
    law: Original,
) -> Model {
    let mut b = Builder::new(v(0.0, 0.0, -weight));
    let body = b.body(1.0, [inertia; 3], Vector3::zeros());
    let joint = b.pin(Some(body), None, Vector3::zeros());
    b.spin(body, v(0.0, 0.0, rate), Vector3::zeros());
    b.friction(joint, law, pin_load(pin_radius, friction_arm));
    b.model
}

/// B05: a rotor of 2 kg and 0.01 kg m² on a vertical axis, turning at 50 rad/s, that carries a mass
/// of 0.3 kg at 0.05 m from the axis and `height` above the joint.
#[must_use]
pub fn unbalanced_rotor(height: f64, law: Original) -> Model {
    let mut b = Builder::new(v(0.0, 0.0, -9.80665));
    let rotor = b.body(2.0, [0.01; 3], Vector3::zeros());
    let eccentric = b.body(0.3, [0.0; 3], v(0.05, 0.0, height));
    let joint = b.pin(Some(rotor), None, Vector3::zeros());
    let at = v(0.05, 0.0, height);
    b.joint(
        JointKind::Fixed,
        Some(eccentric),
        Some(rotor),
        at,
        Vector3::z(),
    );
    for body in [rotor, eccentric] {
        b.spin(body, v(0.0, 0.0, 50.0), Vector3::zeros());
    }
    b.friction(joint, law, bearing_load(0.01, 0.03, 0.05));
    b.model
}

/// 1 kg with its centre 0.5 m below a ball joint, inertia about the centre (0.02, 0.02, 0.005) in
/// part axes, tilted by `tilt` about x, turning with `rates` along part axes; g = 9.80665 m/s².
#[must_use]
pub fn ball_pendulum(tilt: f64, rates: Vector3<f64>, ball: Option<(Original, f64)>) -> Model {
    let mut b = Builder::new(v(0.0, 0.0, -9.80665));
    let orientation = Quaternion::exp(&v(tilt, 0.0, 0.0));
    let turn = orientation.matrix();
    let inertia = Matrix3::from_diagonal(&v(0.02, 0.02, 0.005));
    let body = b.turned_body(1.0, inertia, turn * v(0.0, 0.0, -0.5), orientation);
    let joint = b.joint(
        JointKind::Spherical,
        Some(body),
        None,
        Vector3::zeros(),
        Vector3::z(),
    );
    b.spin(body, turn * rates, Vector3::zeros());
    if let Some((law, ball_radius)) = ball {
        let load = SphericalLoad {
            inputs: Inputs::ALL,
            ball_radius,
        };
        b.friction(joint, law, FrictionJoint::Spherical(load));
    }
    b.model
}
