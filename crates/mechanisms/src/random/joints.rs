//! Random joints.

use mechanics::curve::{Curve, Drawing};
use mechanics::model::JointKind;
use nalgebra::{Matrix3, Vector3};

use super::Draft;
use crate::builder::{On, axes_with_z};

/// Joints that bodies hang on, with weights. The numbers of a screw and of a curve are drawn later.
pub(super) const OF_TREES: [(f64, JointKind); 18] = [
    (6.0, JointKind::Revolute),
    (3.0, JointKind::Translational),
    (3.0, JointKind::Cylindrical),
    (4.0, JointKind::Spherical),
    (2.0, JointKind::Hooke),
    (2.0, JointKind::Universal),
    (1.0, JointKind::ConstantVelocity { away: false }),
    (1.5, JointKind::Fixed),
    (1.0, JointKind::Planar),
    (1.0, SCREW),
    (1.0, CURVE),
    (0.5, JointKind::AtPoint),
    (0.5, JointKind::Inline),
    (0.5, JointKind::Inplane),
    (0.5, JointKind::Orientation),
    (0.5, JointKind::ParallelAxes),
    (0.5, JointKind::Perpendicular),
    (0.5, JointKind::ConstantVelocity { away: true }),
];

/// Joints that close loops; most of them lock little.
pub(super) const OF_LOOPS: [(f64, JointKind); 12] = [
    (4.0, JointKind::Inplane),
    (2.0, JointKind::Inline),
    (2.0, JointKind::Perpendicular),
    (3.0, JointKind::Spherical),
    (1.0, JointKind::Hooke),
    (1.0, JointKind::Universal),
    (1.0, JointKind::Cylindrical),
    (1.0, JointKind::ParallelAxes),
    (1.0, JointKind::Planar),
    (1.0, CURVE),
    (0.5, JointKind::Orientation),
    (0.5, JointKind::Revolute),
];

const SCREW: JointKind = JointKind::Screw {
    pitch: 0.0,
    start: 0.0,
};

const CURVE: JointKind = JointKind::PointOnCurve { curve: 0 };

/// Points of a closed curve.
const POINTS: usize = 12;

impl Draft {
    /// A joint of this kind at `at`, along a random axis; the bodies stand as it wants them.
    pub(super) fn add_joint(&mut self, kind: JointKind, i: usize, j: On, at: Vector3<f64>) {
        let axis = self.numbers.direction();
        let axes = axes_with_z(axis);
        let [x, y, z] = [0, 1, 2].map(|k| axes.column(k).into_owned());
        let (kind, of_i) = match kind {
            JointKind::Screw { .. } => {
                let pitch = self.units.length * self.numbers.decades(-2.0, 0.0);
                (JointKind::Screw { pitch, start: 0.0 }, axes)
            }
            // z of I and z of J perpendicular.
            JointKind::Universal | JointKind::Perpendicular => {
                (kind, Matrix3::from_columns(&[y, z, x]))
            }
            JointKind::ConstantVelocity { away: true } => {
                (kind, Matrix3::from_columns(&[x, -y, -z]))
            }
            JointKind::PointOnCurve { .. } => (self.curve_through_origin(), axes),
            kind => (kind, axes),
        };
        let i = self.b.marker(Some(i), at, of_i);
        let j = self.b.marker(j, at, axes);
        self.b.joint_of_markers(kind, i, j);
    }

    /// A wavy ring through the origin of its marker.
    fn curve_through_origin(&mut self) -> JointKind {
        let radius = self.units.length * self.numbers.decades(-0.5, 0.5);
        let (wave, turns) = (0.2 * radius, (1 + self.numbers.below(2)) as f64);
        let point = |k: usize| {
            let angle = std::f64::consts::TAU * (k % POINTS) as f64 / POINTS as f64;
            let (sine, cosine) = angle.sin_cos();
            let height = wave * (turns * angle).sin();
            Vector3::new(radius * (cosine - 1.0), radius * sine, height)
        };
        let points: Vec<Vector3<f64>> = (0..=POINTS).map(point).collect();
        let curve = Curve::through(&points, true, Drawing::Spline);
        self.b
            .model
            .curves
            .push(curve.expect("the points of a ring are apart"));
        JointKind::PointOnCurve {
            curve: self.b.model.curves.len() - 1,
        }
    }
}
