//! Two shafts at an angle, coupled by a cross.

use friction::{Inputs, Original, RevoluteLoad};
use mechanics::model::{FrictionJoint, JointKind, Level, Model, MotionFreedom, Pin};
use nalgebra::{Matrix3, Vector3};

use crate::builder::{Builder, v};

/// How a cross is described: HOOKE or UNIVERSAL.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Cross {
    /// As a HOOKE joint.
    Hooke,
    /// As a UNIVERSAL joint.
    Universal,
}

impl Cross {
    /// Its pins, on I and on J.
    #[must_use]
    pub const fn pins(self) -> [Pin; 2] {
        match self {
            Self::Hooke => [Pin::HookeI, Pin::HookeJ],
            Self::Universal => [Pin::UniversalI, Pin::UniversalJ],
        }
    }
}

/// B09: shafts at 30°, without mass to speak of, so that the reactions are those of statics. The
/// input turns about z at 10 rad/s, driven by motion 0 in joint 0, its pin along x at first; the
/// output is loaded with a torque of 5 against it. Joint 1 is the cross. Friction acts in the pins
/// whose law is given.
#[must_use]
pub fn shafts(cross: Cross, laws: [Option<Original>; 2]) -> Model {
    let (sine, cosine) = std::f64::consts::FRAC_PI_6.sin_cos();
    let output_axis = v(sine, 0.0, cosine);
    let mut b = Builder::new(Vector3::zeros());
    let input = b.body(1e-9, [1e-12; 3], Vector3::zeros());
    let output = b.body(1e-9, [1e-12; 3], Vector3::zeros());
    let (x, y, z) = (Vector3::x(), Vector3::y(), Vector3::z());
    let bearing = b.pin(Some(input), None, Vector3::zeros());
    // Pins along x (input) and y (output): x of I and y of J, or z of I and z of J.
    let (i_axes, j_axes) = match cross {
        Cross::Hooke => (
            Matrix3::from_columns(&[x, y, z]),
            Matrix3::from_columns(&[y.cross(&output_axis), y, output_axis]),
        ),
        Cross::Universal => (
            Matrix3::from_columns(&[y, z, x]),
            Matrix3::from_columns(&[output_axis, y.cross(&output_axis), y]),
        ),
    };
    let i = b.marker(Some(input), Vector3::zeros(), i_axes);
    let j = b.marker(Some(output), Vector3::zeros(), j_axes);
    let kind = match cross {
        Cross::Hooke => JointKind::Hooke,
        Cross::Universal => JointKind::Universal,
    };
    let joint = b.joint_of_markers(kind, i, j);
    // Bearings of the output that leave its place to the cross: no reaction is redundant.
    let parallel = JointKind::ParallelAxes;
    b.joint(parallel, Some(output), None, Vector3::zeros(), output_axis);
    b.drive(bearing, MotionFreedom::AboutZ, Level::Position, 10.0);
    b.start_turning(bearing, 10.0);
    b.spin(output, 10.0 / cosine * output_axis, Vector3::zeros());
    b.torque(output, output_axis, -5.0);
    for (pin, law) in cross.pins().into_iter().zip(laws) {
        if let Some(law) = law {
            b.friction(joint, law, FrictionJoint::Pin(pin, CROSS_PIN));
        }
    }
    b.model
}

/// Pins of B09.
const CROSS_PIN: RevoluteLoad = RevoluteLoad {
    inputs: Inputs::ALL,
    pin_radius: 0.01,
    friction_arm: 1.0,
    bending_reaction_arm: 0.04,
};
