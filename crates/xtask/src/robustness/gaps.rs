//! How far joints are from what they mean, told from the places of their markers alone.

use mechanics::Snapshot;
use mechanics::model::JointKind;
use nalgebra::Vector3;

/// The largest gap of all joints: lengths as parts of `length`, directions in radians. Threads, racks,
/// even turns and curves have no gap that their markers alone show, and count by the rest.
pub(super) fn largest_gap(snapshot: &Snapshot<'_>, length: f64) -> f64 {
    let joints = snapshot.model().joints.iter();
    joints.fold(0.0, |most: f64, joint| {
        let gap = gap(snapshot, joint.kind, joint.i, joint.j, length);
        // `max` would pass over what is not a number.
        if gap <= most { most } else { gap }
    })
}

fn gap(snapshot: &Snapshot<'_>, kind: JointKind, i: usize, j: usize, length: f64) -> f64 {
    let (i, j) = (snapshot.marker(i), snapshot.marker(j));
    let apart = (i.origin - j.origin) / length;
    let [zi, zj] = [i.axis(2), j.axis(2)];
    let aside = apart - apart.dot(&zj) * zj;
    let not_parallel = zi.cross(&zj).norm();
    let turned = (0..3).map(|k| i.axis(k).cross(&j.axis(k)).norm());
    let turned = turned.fold(0.0, f64::max);
    let aslant = |a: Vector3<f64>, b: Vector3<f64>| a.dot(&b).abs();
    match kind {
        JointKind::Revolute => apart.norm().max(not_parallel),
        JointKind::Translational => aside.norm().max(turned),
        JointKind::Cylindrical | JointKind::Screw { .. } => aside.norm().max(not_parallel),
        JointKind::Spherical | JointKind::AtPoint | JointKind::ConstantVelocity { .. } => {
            apart.norm()
        }
        JointKind::Planar => aslant(apart, zj).max(not_parallel),
        JointKind::Fixed => apart.norm().max(turned),
        JointKind::Hooke => apart.norm().max(aslant(i.axis(0), j.axis(1))),
        JointKind::Universal => apart.norm().max(aslant(zi, zj)),
        JointKind::Inline => aside.norm(),
        JointKind::Inplane => aslant(apart, zj),
        JointKind::Orientation => turned,
        JointKind::ParallelAxes => not_parallel,
        JointKind::Perpendicular => aslant(zi, zj),
        JointKind::RackPinion { .. } | JointKind::PointOnCurve { .. } => 0.0,
    }
}
