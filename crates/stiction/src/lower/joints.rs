//! JOINT and JPRIM to joints.

use std::f64::consts::{PI, TAU};

use dataset::{Code, InitialCondition, JointKind, PrimitiveKind};
use mechanics::model::{self, Joint, JointStart};

use super::pose::Pose;
use super::{Lowering, label};

/// Distance of a pinion from its rack, as a part of PD, below which they count as standing on one
/// line.
const PARALLEL: f64 = 1e-6;

/// Difference of that distance from PD/2, as a part of it, that is not worth a warning.
const TOUCHING: f64 = 0.01;

impl Lowering<'_> {
    /// Joints in the order of the dataset, then primitives.
    pub(super) fn joints(&mut self, model: &mut model::Model) {
        let dataset = self.dataset;
        for joint in &dataset.joints {
            let Some(kind) = self.joint_kind(model, joint) else {
                continue;
            };
            model.joints.push(Joint {
                label: label("JOINT", &joint.header),
                kind,
                i: self.marker_place(joint.i),
                j: self.marker_place(joint.j),
                translation_start: start(joint.ic_translation),
                rotation_start: start(joint.ic_rotation),
            });
        }
        for primitive in &dataset.primitives {
            model.joints.push(Joint {
                label: label("JPRIM", &primitive.header),
                kind: primitive_kind(primitive.kind),
                i: self.marker_place(primitive.i),
                j: self.marker_place(primitive.j),
                translation_start: JointStart::default(),
                rotation_start: JointStart::default(),
            });
        }
    }
}

impl Lowering<'_> {
    /// `None` where the joint is refused, which has been reported.
    fn joint_kind(
        &mut self,
        model: &model::Model,
        joint: &dataset::Joint,
    ) -> Option<model::JointKind> {
        Some(match joint.kind {
            JointKind::Revolute => model::JointKind::Revolute,
            JointKind::Translational => model::JointKind::Translational,
            JointKind::Cylindrical => model::JointKind::Cylindrical,
            JointKind::Spherical => model::JointKind::Spherical,
            JointKind::Planar => model::JointKind::Planar,
            JointKind::Fixed => model::JointKind::Fixed,
            JointKind::Hooke => model::JointKind::Hooke,
            JointKind::Universal => model::JointKind::Universal,
            JointKind::Screw => {
                let pitch = joint.pitch?;
                let [i, j] = [joint.i, joint.j].map(|id| Pose::of(model, self.marker_place(id)));
                let turns = i.angle_about_z(&j) / TAU;
                model::JointKind::Screw {
                    pitch,
                    start: i.distance_along_z(&j) - pitch * turns,
                }
            }
            JointKind::ConstantVelocity => {
                let [i, j] = [joint.i, joint.j].map(|id| Pose::of(model, self.marker_place(id)));
                let away = i.axes.column(2).dot(&j.axes.column(2)) < 0.0;
                model::JointKind::ConstantVelocity { away }
            }
            JointKind::RackPinion => self.rack_and_pinion(model, joint)?,
        })
    }

    /// The pinion rolls without slip where it touches the axis of the rack: with `r` from there to
    /// its centre, `(v_I − v_J) z_J = ω (z_I × r) z_J`, of which the sign counts and the magnitude
    /// is PD/2.
    fn rack_and_pinion(
        &mut self,
        model: &model::Model,
        joint: &dataset::Joint,
    ) -> Option<model::JointKind> {
        let diameter = joint.pitch_diameter?;
        let [i, j] = [joint.i, joint.j].map(|id| Pose::of(model, self.marker_place(id)));
        let along = j.axes.column(2);
        let centre = i.origin - j.origin;
        let off = centre - centre.dot(&along) * along;
        let lever = i.axes.column(2).cross(&off).dot(&along);
        let (span, id) = (joint.header.span, joint.header.id);
        if !(lever.abs() > PARALLEL * diameter.abs()) {
            let message = format!(
                "JOINT/{id}: the way that the rack moves is not known, as the origin of I stands \
                 on z of J, or z of I is along it"
            );
            let help =
                "put z of J along the pitch line of the rack, half of PD off the origin of I";
            self.error(Code::InvalidConnection, span, message, Some(help));
            return None;
        }
        let radius = 0.5 * diameter.abs();
        if (lever.abs() - radius).abs() > TOUCHING * radius {
            let message = format!(
                "JOINT/{id}: the origin of I is {} off z of J, but the radius PD/2 is {radius}",
                lever.abs()
            );
            self.warn(Code::InvalidConnection, span, message);
        }
        let pitch = lever.signum() * PI * diameter;
        let x = i.axes.column(0).dot(&along);
        let angle = (-i.axes.column(1).dot(&along)).atan2(x);
        Some(model::JointKind::RackPinion {
            pitch,
            start: i.distance_along_z(&j) - pitch / TAU * angle,
        })
    }
}

fn primitive_kind(kind: PrimitiveKind) -> model::JointKind {
    match kind {
        PrimitiveKind::AtPoint => model::JointKind::AtPoint,
        PrimitiveKind::Inline => model::JointKind::Inline,
        PrimitiveKind::Inplane => model::JointKind::Inplane,
        PrimitiveKind::Orientation => model::JointKind::Orientation,
        PrimitiveKind::ParallelAxes => model::JointKind::ParallelAxes,
        PrimitiveKind::Perpendicular => model::JointKind::Perpendicular,
    }
}

fn start(condition: Option<InitialCondition>) -> JointStart {
    let condition = condition.unwrap_or_default();
    JointStart {
        displacement: condition.displacement,
        velocity: condition.velocity,
    }
}
