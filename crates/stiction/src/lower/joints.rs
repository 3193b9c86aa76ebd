//! JOINT and JPRIM to joints.

use std::f64::consts::TAU;

use dataset::{Code, InitialCondition, JointKind, PrimitiveKind};
use mechanics::model::{self, Joint, JointStart};

use super::pose::Pose;
use super::{Lowering, label};

impl Lowering<'_> {
    /// Joints in the order of the dataset, then primitives.
    pub(super) fn joints(&mut self, model: &mut model::Model) {
        let dataset = self.dataset;
        for joint in &dataset.joints {
            let Some(kind) = self.joint_kind(model, joint) else {
                self.error(
                    Code::UnsupportedStatement,
                    joint.header.span,
                    format!(
                        "JOINT/{}: {} joints are not simulated yet",
                        joint.header.id,
                        joint.kind.keyword()
                    ),
                    None,
                );
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
    fn joint_kind(&self, model: &model::Model, joint: &dataset::Joint) -> Option<model::JointKind> {
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
            JointKind::ConstantVelocity | JointKind::RackPinion => return None,
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
