//! What loads the friction of a joint of any kind.

use friction::{CylindricalLoad, Inputs, RevoluteLoad, SphericalLoad, TranslationalLoad};
use mechanics::model::{FrictionJoint, JointKind, Pin};

/// The load of a joint on guides and bearings of the size `length`, with pins or balls of the given
/// radius; of joints with two pins that on the part of I. None where the kind has no friction.
#[must_use]
pub fn joint_load(
    kind: JointKind,
    inputs: Inputs,
    length: f64,
    radius: f64,
    friction_arm: f64,
) -> Option<FrictionJoint> {
    let pin = RevoluteLoad {
        inputs,
        pin_radius: radius,
        friction_arm,
        bending_reaction_arm: length,
    };
    Some(match kind {
        JointKind::Revolute => FrictionJoint::Revolute(pin),
        JointKind::Translational => FrictionJoint::Translational(TranslationalLoad {
            inputs,
            reaction_arm: length,
            bending_factor: 0.5,
            initial_overlap: length,
            overlap_sign: 0.0,
        }),
        JointKind::Cylindrical => FrictionJoint::Cylindrical(CylindricalLoad {
            inputs,
            pin_radius: radius,
            bending_factor: 0.5,
            initial_overlap: length,
            overlap_sign: 0.0,
        }),
        JointKind::Spherical => FrictionJoint::Spherical(SphericalLoad {
            inputs,
            ball_radius: radius,
        }),
        JointKind::Hooke => FrictionJoint::Pin(Pin::HookeI, pin),
        JointKind::Universal => FrictionJoint::Pin(Pin::UniversalI, pin),
        _ => return None,
    })
}
