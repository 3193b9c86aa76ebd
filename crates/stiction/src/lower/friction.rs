//! FRICTION to the law and the load of the crate `friction`.

use dataset::{Code, Effect, Formulation, Friction, FrictionQuantity, JointKind, OverlapDelta};
use friction::{Inputs, Original, RevoluteLoad, SphericalLoad, TranslationalLoad};
use mechanics::model::{self, FrictionJoint};

use super::{Lowering, label};

impl Lowering<'_> {
    /// Frictions in the order of the dataset.
    pub(super) fn frictions(&mut self, model: &mut model::Model) {
        let dataset = self.dataset;
        for friction in &dataset.frictions {
            let (Some(law), Some(load)) = (self.law(friction), self.load(friction)) else {
                continue;
            };
            let Some(joint) = dataset.joints.position(friction.joint) else {
                continue;
            };
            let sliding = matches!(load, FrictionJoint::Translational(_));
            let (preload, maximum) = if sliding {
                (
                    FrictionQuantity::FrictionForcePreload,
                    FrictionQuantity::MaxFrictionForce,
                )
            } else {
                (
                    FrictionQuantity::FrictionTorquePreload,
                    FrictionQuantity::MaxFrictionTorque,
                )
            };
            model.frictions.push(model::Friction {
                label: label("FRICTION", &friction.header),
                joint,
                law,
                load,
                preload: if friction.inputs.preload {
                    friction.value(preload)
                } else {
                    0.0
                },
                maximum: friction.value(maximum),
            });
        }
    }

    /// The formulations: FORMULATION=LUGRE belongs here.
    fn law(&mut self, friction: &Friction) -> Option<Original> {
        match friction.formulation {
            Formulation::Original => Some(Original {
                mu_static: friction.mu_static,
                mu_dynamic: friction.mu_dynamic,
                transition_velocity: friction.value(FrictionQuantity::StictionTransitionVelocity),
                transition_coefficient: friction
                    .value(FrictionQuantity::TransitionVelocityCoefficient),
                max_deformation: friction.value(FrictionQuantity::MaxStictionDeformation),
                effect: match friction.effect {
                    Effect::All => friction::Effect::All,
                    Effect::Stiction => friction::Effect::Stiction,
                    Effect::Sliding => friction::Effect::Sliding,
                },
            }),
            Formulation::LuGre => {
                self.not_yet(friction, "FORMULATION=LUGRE is", "FORMULATION=ORIGINAL");
                None
            }
        }
    }

    /// The joints: friction in CYLINDRICAL, HOOKE and UNIVERSAL belongs here.
    fn load(&mut self, friction: &Friction) -> Option<FrictionJoint> {
        let inputs = Inputs {
            preload: friction.inputs.preload,
            reaction_force: friction.inputs.reaction_force,
            bending_moment: friction.inputs.bending_moment,
            torsional_moment: friction.inputs.torsional_moment,
        };
        let joint = self.dataset.joints.by_id(friction.joint)?;
        Some(match joint.kind {
            JointKind::Translational => FrictionJoint::Translational(TranslationalLoad {
                inputs,
                reaction_arm: friction.value(FrictionQuantity::ReactionArm),
                bending_factor: friction.value(FrictionQuantity::BendingFactor),
                initial_overlap: friction.value(FrictionQuantity::InitialOverlap),
                overlap_sign: match friction.overlap_delta {
                    OverlapDelta::Constant => 0.0,
                    OverlapDelta::Increase => 1.0,
                    OverlapDelta::Decrease => -1.0,
                },
            }),
            JointKind::Revolute => FrictionJoint::Revolute(RevoluteLoad {
                inputs,
                pin_radius: friction.value(FrictionQuantity::PinRadius),
                friction_arm: friction.value(FrictionQuantity::FrictionArm),
                bending_reaction_arm: friction.value(FrictionQuantity::BendingReactionArm),
            }),
            JointKind::Spherical => FrictionJoint::Spherical(SphericalLoad {
                inputs,
                ball_radius: friction.value(FrictionQuantity::BallRadius),
            }),
            other => {
                let what = format!("friction in {} joints is", other.keyword());
                let instead = "TRANSLATIONAL, REVOLUTE and SPHERICAL joints";
                self.not_yet(friction, &what, instead);
                return None;
            }
        })
    }

    fn not_yet(&mut self, friction: &Friction, what: &str, instead: &str) {
        self.error(
            Code::UnsupportedStatement,
            friction.header.span,
            format!("FRICTION/{}: {what} not simulated yet", friction.header.id),
            Some(&format!("friction is simulated with {instead}")),
        );
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
