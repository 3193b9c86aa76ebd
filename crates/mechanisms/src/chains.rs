//! Rods on hinges in rows and trees, with loops and friction, of any size.
//!
//! Every rod is 1 m long, of 1 kg and 1/12 kg m², with 0.001 kg m² about its axis, and hangs on the
//! end of the one before by a hinge about z or y by turns; g = 9.81 m/s² along (0, −1, −1)/√2.

use mechanics::model::{JointKind, Law};
use nalgebra::{Rotation3, Vector3};

use crate::builder::{Builder, v};
use crate::turning::bearing_load;

/// Rods between the beginnings of two struts.
const BRACED: usize = 10;

/// Inertia of a rod about its axis.
const AXIAL: f64 = 0.001;

/// Angle between the two rods at a fork.
const FORK: f64 = 0.3;

fn empty() -> Builder {
    Builder::new(-9.81 * v(0.0, 1.0, 1.0).normalize())
}

/// The axis of the hinges at a depth.
fn hinge(depth: usize) -> Vector3<f64> {
    if depth.is_multiple_of(2) {
        Vector3::z()
    } else {
        Vector3::y()
    }
}

/// `count` rods in a row from the origin along x. Body and joint `k` are the rod from `x = k` and the
/// hinge there.
#[must_use]
pub fn chain(count: usize) -> Builder {
    let mut b = empty();
    for k in 0..count {
        let near = v(k as f64, 0.0, 0.0);
        let rod = b.rod_with_axial_inertia(1.0, AXIAL, near, near + Vector3::x());
        b.joint(
            JointKind::Revolute,
            Some(rod),
            k.checked_sub(1),
            near,
            hinge(k),
        );
    }
    b
}

/// `count` rods in a tree: rod `k` hangs on rod `(k − 1)/2`, the first from the origin along x; of the
/// two rods at an end one goes straight on, the other turns aside.
#[must_use]
pub fn tree(count: usize) -> Builder {
    let mut b = empty();
    let aside = Rotation3::from_axis_angle(&Vector3::z_axis(), FORK);
    // End and direction of every rod.
    let mut ends = Vec::with_capacity(count);
    for k in 0..count {
        let parent = k.checked_sub(1).map(|before| before / 2);
        let depth = (k + 1).ilog2() as usize;
        let (near, before) = parent.map_or((Vector3::zeros(), Vector3::x()), |parent| ends[parent]);
        let along = if k > 0 && k.is_multiple_of(2) {
            aside * before
        } else {
            before
        };
        let rod = b.rod_with_axial_inertia(1.0, AXIAL, near, near + along);
        b.joint(JointKind::Revolute, Some(rod), parent, near, hinge(depth));
        ends.push((near + along, along));
    }
    b
}

/// Closes a loop over every ten rods of a chain by a strut beside it, on a ball and a cross.
pub fn brace(chain: &mut Builder) {
    let count = chain.model.bodies.len();
    for first in (0..count.saturating_sub(BRACED)).step_by(BRACED) {
        let from = v(first as f64 + 1.5, 0.5, 0.5);
        let to = v((first + BRACED) as f64 - 0.5, 0.5, 0.5);
        let strut = chain.rod_with_axial_inertia(1.0, AXIAL, from, to);
        let (near, far) = (Some(first + 1), Some(first + BRACED - 1));
        let across = Vector3::z();
        chain.joint(JointKind::Spherical, Some(strut), near, from, across);
        chain.joint(JointKind::Hooke, Some(strut), far, to, across);
    }
}

/// Friction in every hinge, loaded by force and bending moment; `law` is asked for each joint.
pub fn hinge_friction(chain: &mut Builder, law: impl Fn(usize) -> Law) {
    for joint in 0..chain.model.joints.len() {
        if chain.model.joints[joint].kind == JointKind::Revolute {
            chain.friction(joint, law(joint), bearing_load(0.02, 0.02, 0.1));
        }
    }
}
