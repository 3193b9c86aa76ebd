//! FRICTION to the law and the load of the crate `friction`.

use dataset::{
    Effect, Formulation, Friction, FrictionQuantity as Quantity, JointKind, OverlapDelta, Yoke,
};
use friction::{
    CylindricalLoad, Inputs, LuGre, Original, RevoluteLoad, SphericalLoad, TranslationalLoad,
};
use mechanics::model::{self, ForceAndTorque, FrictionJoint, Law, Pin};

use super::{Lowering, label};

impl Lowering<'_> {
    /// Frictions in the order of the dataset.
    pub(super) fn frictions(&mut self, model: &mut model::Model) {
        for friction in &self.dataset.frictions {
            // What has no friction was refused when the dataset was read.
            let Some(load) = self.load(friction) else {
                continue;
            };
            let Some(joint) = self.dataset.joints.position(friction.joint) else {
                continue;
            };
            let preload = |quantity| {
                if friction.inputs.preload {
                    friction.value(quantity)
                } else {
                    0.0
                }
            };
            model.frictions.push(model::Friction {
                label: label("FRICTION", &friction.header),
                joint,
                law: law(friction),
                load,
                preload: ForceAndTorque {
                    force: preload(Quantity::FrictionForcePreload),
                    torque: preload(Quantity::FrictionTorquePreload),
                },
                maximum: ForceAndTorque {
                    force: friction.value(Quantity::MaxFrictionForce),
                    torque: friction.value(Quantity::MaxFrictionTorque),
                },
                inactive_static: friction.inactive_static,
            });
        }
    }

    /// The load of the friction's joint.
    fn load(&self, friction: &Friction) -> Option<FrictionJoint> {
        let inputs = Inputs {
            preload: friction.inputs.preload,
            reaction_force: friction.inputs.reaction_force,
            bending_moment: friction.inputs.bending_moment,
            torsional_moment: friction.inputs.torsional_moment,
        };
        let overlap_sign = match friction.overlap_delta {
            OverlapDelta::Constant => 0.0,
            OverlapDelta::Increase => 1.0,
            OverlapDelta::Decrease => -1.0,
        };
        let pin = RevoluteLoad {
            inputs,
            pin_radius: friction.value(Quantity::PinRadius),
            friction_arm: friction.value(Quantity::FrictionArm),
            bending_reaction_arm: friction.value(Quantity::BendingReactionArm),
        };
        let joint = self.dataset.joints.by_id(friction.joint)?;
        Some(match (joint.kind, friction.yoke) {
            (JointKind::Translational, _) => FrictionJoint::Translational(TranslationalLoad {
                inputs,
                reaction_arm: friction.value(Quantity::ReactionArm),
                bending_factor: friction.value(Quantity::BendingFactor),
                initial_overlap: friction.value(Quantity::InitialOverlap),
                overlap_sign,
            }),
            (JointKind::Cylindrical, _) => FrictionJoint::Cylindrical(CylindricalLoad {
                inputs,
                pin_radius: friction.value(Quantity::PinRadius),
                bending_factor: friction.value(Quantity::BendingFactor),
                initial_overlap: friction.value(Quantity::InitialOverlap),
                overlap_sign,
            }),
            (JointKind::Revolute, _) => FrictionJoint::Revolute(pin),
            (JointKind::Spherical, _) => FrictionJoint::Spherical(SphericalLoad {
                inputs,
                ball_radius: friction.value(Quantity::BallRadius),
            }),
            (JointKind::Hooke, Some(Yoke::I)) => FrictionJoint::Pin(Pin::HookeI, pin),
            (JointKind::Hooke, Some(Yoke::J)) => FrictionJoint::Pin(Pin::HookeJ, pin),
            (JointKind::Universal, Some(Yoke::I)) => FrictionJoint::Pin(Pin::UniversalI, pin),
            (JointKind::Universal, Some(Yoke::J)) => FrictionJoint::Pin(Pin::UniversalJ, pin),
            _ => return None,
        })
    }
}

/// The law of the friction's FORMULATION.
fn law(friction: &Friction) -> Law {
    match friction.formulation {
        Formulation::Original => Law::Original(Original {
            mu_static: friction.mu_static,
            mu_dynamic: friction.mu_dynamic,
            transition_velocity: friction.value(Quantity::StictionTransitionVelocity),
            transition_coefficient: friction.value(Quantity::TransitionVelocityCoefficient),
            max_deformation: friction.value(Quantity::MaxStictionDeformation),
            effect: match friction.effect {
                Effect::All => friction::Effect::All,
                Effect::Stiction => friction::Effect::Stiction,
                Effect::Sliding => friction::Effect::Sliding,
            },
        }),
        Formulation::LuGre => Law::LuGre(LuGre {
            mu_static: friction.mu_static,
            mu_dynamic: friction.mu_dynamic,
            bristle_stiffness: friction.value(Quantity::BristleStiffnessCoefficient),
            damping: friction.value(Quantity::DampingCoefficient),
            viscous: friction.value(Quantity::ViscousFrictionCoefficient),
            stribeck_velocity: friction.value(Quantity::VelocityThresholdStribeck),
            stribeck_exponent: friction.value(Quantity::DecayExponentStribeck),
        }),
    }
}

#[cfg(test)]
mod tests {
    use dataset::FrictionQuantity;
    use friction::parameters::{DefaultValue, JointType, PARAMETERS, Range};

    use super::JointKind;

    #[test]
    fn the_reader_and_the_law_have_the_same_table_of_arguments() {
        let joints = [
            (JointType::Translational, JointKind::Translational),
            (JointType::Revolute, JointKind::Revolute),
            (JointType::Cylindrical, JointKind::Cylindrical),
            (JointType::Spherical, JointKind::Spherical),
            (JointType::Hooke, JointKind::Hooke),
            (JointType::Universal, JointKind::Universal),
        ];
        let mut compared = 0;
        for parameter in &PARAMETERS {
            let DefaultValue::Number(default) = parameter.default else {
                continue;
            };
            let quantity = FrictionQuantity::ALL
                .into_iter()
                .find(|quantity| quantity.keyword() == parameter.keyword)
                .unwrap_or_else(|| panic!("the reader has no {}", parameter.keyword));
            assert_eq!(quantity.default_value(), default, "{}", parameter.keyword);
            for (one, other) in joints {
                let uses = parameter.joints.contains(&one);
                assert_eq!(
                    quantity.used_by(other),
                    uses,
                    "{} {one:?}",
                    parameter.keyword
                );
            }
            for (name, formulation) in [
                ("ORIGINAL", super::Formulation::Original),
                ("LUGRE", super::Formulation::LuGre),
            ] {
                let uses = parameter.formulation.is_none_or(|only| only == name);
                assert_eq!(
                    quantity.used_in(formulation),
                    uses,
                    "{} {name}",
                    parameter.keyword
                );
            }
            // Ranges, through the reader: the bound itself and a number below it.
            let (bound, allowed) = match parameter.range {
                Range::Above(bound) => (bound, false),
                Range::AtLeast(bound) => (bound, true),
                ref other => panic!("{} has the range {other:?}", parameter.keyword),
            };
            assert_eq!(
                accepted(parameter.keyword, bound),
                allowed,
                "{}",
                parameter.keyword
            );
            assert!(
                !accepted(parameter.keyword, bound - 0.5),
                "{}",
                parameter.keyword
            );
            assert!(
                accepted(parameter.keyword, bound + 0.5),
                "{}",
                parameter.keyword
            );
            compared += 1;
        }
        assert_eq!(compared, FrictionQuantity::ALL.len());
    }

    /// Whether a FRICTION command with this argument is read without an error.
    fn accepted(keyword: &str, value: f64) -> bool {
        let text = format!("FRICTION/1, {keyword} = {value}");
        let (_, diagnostics) = dataset::parse_change(&dataset::Source::from_text("test", text));
        !diagnostics
            .iter()
            .any(|d| d.severity == dataset::Severity::Error)
    }
}
