//! Every misuse of FRICTION, with its message and the text that the message marks.

use crate::shared::{Marked, marked};
use dataset::{Code, FrictionQuantity, JointKind, Severity, Source, read_dataset};

/// One misuse in a model that is right otherwise.
struct Misuse {
    /// The type of JOINT/1.
    joint: &'static str,
    /// The FRICTION statements.
    friction: &'static str,
    code: Code,
    severity: Severity,
    /// The text under the caret.
    marked: &'static str,
    /// A part of the message.
    says: &'static str,
}

const fn error(
    joint: &'static str,
    friction: &'static str,
    code: Code,
    marked: &'static str,
    says: &'static str,
) -> Misuse {
    Misuse {
        joint,
        friction,
        code,
        severity: Severity::Error,
        marked,
        says,
    }
}

const fn warning(
    joint: &'static str,
    friction: &'static str,
    code: Code,
    marked: &'static str,
    says: &'static str,
) -> Misuse {
    Misuse {
        severity: Severity::Warning,
        ..error(joint, friction, code, marked, says)
    }
}

/// What comes before the misuse in most rows.
macro_rules! friction {
    ($($rest:literal)*) => {
        concat!("FRICTION/3, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2", $($rest)*)
    };
}

use Code as C;

#[rustfmt::skip]
const MISUSES: &[Misuse] = &[
    // Missing.
    error("REVOLUTE", "FRICTION/3, MU_STATIC=0.3, MU_DYNAMIC=0.2", C::MissingArgument, "FRICTION/3", "needs JOINT"),
    error("REVOLUTE", "FRICTION/3, JOINT=1, MU_DYNAMIC=0.2", C::MissingArgument, "FRICTION/3", "needs MU_STATIC"),
    error("REVOLUTE", "FRICTION/3, JOINT=1, MU_STATIC=0.2", C::MissingArgument, "FRICTION/3", "needs MU_DYNAMIC"),
    error("REVOLUTE", "FRICTION/3, JOINT=1, FORMULATION=LUGRE, MU_STATIC=0.2", C::MissingArgument, "FRICTION/3", "needs MU_DYNAMIC"),
    error("REVOLUTE", "FRICTION/3, JOINT=7, MU_STATIC=0.3, MU_DYNAMIC=0.2", C::MissingElement, "7", "there is no JOINT/7"),
    error("REVOLUTE", friction!(", PIN_RADIUS"), C::InvalidValue, "PIN_RADIUS", "needs a value"),
    error("REVOLUTE", "FRICTION, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2", C::InvalidId, "FRICTION", "needs a number"),
    // Given twice, or together with what excludes it.
    error("REVOLUTE", friction!(", MU_STATIC=0.4"), C::DuplicateArgument, "MU_STATIC", "given twice"),
    error("REVOLUTE", friction!(", INACTIVE=STATIC, INACTIVE_DURING=STATIC"), C::ConflictingArguments, "INACTIVE_DURING", "both INACTIVE and INACTIVE_DURING"),
    error("REVOLUTE", friction!(", INPUTS=ALL:PRELOAD"), C::ConflictingArguments, "INPUTS", "stand alone"),
    error("REVOLUTE", friction!(", INPUTS=NONE, PRELOAD"), C::ConflictingArguments, "INPUTS", "stand alone"),
    // Out of range.
    error("REVOLUTE", "FRICTION/3, JOINT=1, MU_STATIC=0, MU_DYNAMIC=0.2", C::OutOfRange, "0", "MU_STATIC must be greater than 0"),
    error("REVOLUTE", "FRICTION/3, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=-1", C::OutOfRange, "-1", "MU_DYNAMIC must be greater than 0"),
    error("REVOLUTE", friction!(", PIN_RADIUS=1E999"), C::OutOfRange, "1E999", "too large for a number"),
    // Words that do not exist.
    error("REVOLUTE", friction!(", EFFECT=NONE"), C::InvalidValue, "NONE", "EFFECT cannot be NONE"),
    error("REVOLUTE", friction!(", INPUTS=FORCE"), C::InvalidValue, "FORCE", "INPUTS cannot be FORCE"),
    error("REVOLUTE", friction!(", FORMULATION=DAHL"), C::InvalidValue, "DAHL", "FORMULATION cannot be DAHL"),
    error("REVOLUTE", friction!(", INACTIVE=DYNAMIC"), C::InvalidValue, "DYNAMIC", "INACTIVE cannot be DYNAMIC"),
    error("CYLINDRICAL", friction!(", OVERLAP_DELTA=GROW"), C::InvalidValue, "GROW", "OVERLAP_DELTA cannot be GROW"),
    error("REVOLUTE", friction!(", DELTA_V=0.1"), C::UnknownArgument, "DELTA_V", "has no argument DELTA_V"),
    error("REVOLUTE", friction!(", LIST"), C::UnknownArgument, "LIST", "has no argument LIST"),
    // Joints without friction.
    error("FIXED", friction!(), C::FrictionJoint, "JOINT", "joint type FIXED has no friction"),
    error("PLANAR", friction!(), C::FrictionJoint, "JOINT", "joint type PLANAR has no friction"),
    error("CONVEL", friction!(), C::FrictionJoint, "JOINT", "joint type CONVEL has no friction"),
    error("SCREW, PITCH=1", friction!(), C::FrictionJoint, "JOINT", "joint type SCREW has no friction"),
    error("RACKPIN, PD=1", friction!(), C::FrictionJoint, "JOINT", "joint type RACKPIN has no friction"),
    // Yokes.
    error("HOOKE", friction!(), C::FrictionJoint, "FRICTION/3", "which axis of the HOOKE joint"),
    error("UNIVERSAL", friction!(), C::FrictionJoint, "FRICTION/3", "which axis of the UNIVERSAL joint"),
    error("HOOKE", friction!(", I_YOKE, J_YOKE"), C::ConflictingArguments, "J_YOKE", "both I_YOKE and J_YOKE"),
    error("REVOLUTE", friction!(", I_YOKE"), C::FrictionJoint, "I_YOKE", "a REVOLUTE joint has no yokes"),
    error("TRANSLATIONAL", friction!(", I_YOKE"), C::FrictionJoint, "I_YOKE", "a TRANSLATIONAL joint has no yokes"),
    error("CYLINDRICAL", friction!(", J_YOKE"), C::FrictionJoint, "J_YOKE", "a CYLINDRICAL joint has no yokes"),
    error("SPHERICAL", friction!(", J_YOKE"), C::FrictionJoint, "J_YOKE", "a SPHERICAL joint has no yokes"),
    error("HOOKE", friction!(", I_YOKE=1"), C::InvalidValue, "=", "I_YOKE takes no value"),
    // Two on one.
    error("REVOLUTE", friction!("\nFRICTION/4, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2"), C::FrictionJoint, "JOINT", "JOINT/1 has FRICTION/3 already"),
    error("UNIVERSAL", friction!(", J_YOKE\nFRICTION/4, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2, J_YOKE"), C::FrictionJoint, "J_YOKE", "J_YOKE of JOINT/1 has FRICTION/3 already"),
    error("HOOKE", friction!(", I_YOKE\nFRICTION/3, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2, J_YOKE"), C::DuplicateId, "FRICTION", "FRICTION/3 is there already"),
    // Inputs and other words that the joint does not have.
    warning("REVOLUTE", friction!(", INPUTS=TORSIONAL_MOMENT"), C::UnusedArgument, "INPUTS", "TORSIONAL_MOMENT of FRICTION/3 is not used by a REVOLUTE joint"),
    warning("CYLINDRICAL", friction!(", INPUTS=TORSIONAL_MOMENT"), C::UnusedArgument, "INPUTS", "not used by a CYLINDRICAL joint"),
    warning("HOOKE", friction!(", I_YOKE, INPUTS=TORSIONAL_MOMENT"), C::UnusedArgument, "INPUTS", "not used by a HOOKE joint"),
    warning("UNIVERSAL", friction!(", J_YOKE, INPUTS=TORSIONAL_MOMENT"), C::UnusedArgument, "INPUTS", "not used by a UNIVERSAL joint"),
    warning("SPHERICAL", friction!(", INPUTS=TORSIONAL_MOMENT"), C::UnusedArgument, "INPUTS", "not used by a SPHERICAL joint"),
    warning("SPHERICAL", friction!(", INPUTS=BENDING_MOMENT"), C::UnusedArgument, "INPUTS", "BENDING_MOMENT of FRICTION/3 is not used by a SPHERICAL joint"),
    warning("REVOLUTE", friction!(", OVERLAP_DELTA=CONSTANT"), C::UnusedArgument, "OVERLAP_DELTA", "not used by a REVOLUTE joint"),
    // Numbers that the other arguments leave without effect.
    warning("REVOLUTE", friction!(", FORMULATION=LUGRE, EFFECT=ALL"), C::UnusedArgument, "EFFECT", "not used by FORMULATION = LUGRE"),
    warning("REVOLUTE", friction!(", EFFECT=SLIDING, MAX_STICTION_DEFORMATION=0.1"), C::UnusedArgument, "MAX_STICTION_DEFORMATION", "not used by EFFECT = SLIDING"),
    warning("REVOLUTE", friction!(", EFFECT=STICTION, TRANSITION_VELOCITY_COEFFICIENT=2"), C::UnusedArgument, "TRANSITION_VELOCITY_COEFFICIENT", "not used by EFFECT = STICTION"),
    warning("REVOLUTE", friction!(", INPUTS=REACTION_FORCE, FRICTION_TORQUE_PRELOAD=1"), C::UnusedArgument, "FRICTION_TORQUE_PRELOAD", "INPUTS without PRELOAD"),
    warning("REVOLUTE", friction!(", INPUTS=PRELOAD, FRICTION_ARM=1"), C::UnusedArgument, "FRICTION_ARM", "INPUTS without REACTION_FORCE"),
    warning("REVOLUTE", friction!(", INPUTS=PRELOAD, BENDING_REACTION_ARM=1"), C::UnusedArgument, "BENDING_REACTION_ARM", "INPUTS without BENDING_MOMENT"),
    warning("TRANSLATIONAL", friction!(", INPUTS=PRELOAD, INITIAL_OVERLAP=1"), C::UnusedArgument, "INITIAL_OVERLAP", "INPUTS without BENDING_MOMENT"),
    warning("TRANSLATIONAL", friction!(", INPUTS=PRELOAD, OVERLAP_DELTA=INCREASE"), C::UnusedArgument, "OVERLAP_DELTA", "INPUTS without BENDING_MOMENT"),
    warning("TRANSLATIONAL", friction!(", INPUTS=NONE, REACTION_ARM=1"), C::UnusedArgument, "REACTION_ARM", "INPUTS without TORSIONAL_MOMENT"),
    // Weaker at rest than in motion.
    warning("REVOLUTE", "FRICTION/3, JOINT=1, MU_STATIC=0.1, MU_DYNAMIC=0.2", C::StaticBelowDynamic, "MU_STATIC", "MU_STATIC of FRICTION/3 is less than its MU_DYNAMIC"),
    warning("REVOLUTE", "FRICTION/3, JOINT=1, FORMULATION=LUGRE, MU_DYNAMIC=0.2, MU_STATIC=0.1", C::StaticBelowDynamic, "MU_STATIC", "is less than"),
];

fn model(unit: &str, joint: &str, friction: &str) -> String {
    let (kind, rest) = joint.split_once(',').unwrap_or((joint, ""));
    let comma = if rest.is_empty() { "" } else { "," };
    format!(
        "title\nUNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH={unit}, TIME=SECOND\nPART/1, GROUND\n\
         MARKER/1, PART=1\nPART/2\nMARKER/2, PART=2\nJOINT/1, {kind}, I=2, J=1{comma}{rest}\n\
         {friction}\n"
    )
}

fn messages(unit: &str, joint: &str, friction: &str) -> Vec<Marked> {
    let text = model(unit, joint, friction);
    let source = Source::from_text("model.adm", text);
    let diagnostics = read_dataset(&source).1;
    // Some joints without friction are not simulated either.
    let all = diagnostics.iter().map(|d| marked(d, &source));
    all.filter(|found| found.code != Code::UnsupportedArgument)
        .collect()
}

#[test]
fn every_misuse_has_its_message_at_its_place() {
    let mut wrong = String::new();
    for misuse in MISUSES {
        let found = messages("MILLIMETER", misuse.joint, misuse.friction);
        let right = match found.as_slice() {
            [one] => {
                (one.code, one.severity) == (misuse.code, misuse.severity)
                    && one.text == misuse.marked
                    && one.message.contains(misuse.says)
            }
            _ => false,
        };
        if !right {
            wrong += &format!("{} {}\n  {found:?}\n", misuse.joint, misuse.friction);
        }
    }
    println!("{} misuses", MISUSES.len());
    assert!(wrong.is_empty(), "{wrong}");
}

const JOINTS: [(&str, JointKind, &str); 6] = [
    ("TRANSLATIONAL", JointKind::Translational, ""),
    ("REVOLUTE", JointKind::Revolute, ""),
    ("CYLINDRICAL", JointKind::Cylindrical, ""),
    ("SPHERICAL", JointKind::Spherical, ""),
    ("HOOKE", JointKind::Hooke, ", I_YOKE"),
    ("UNIVERSAL", JointKind::Universal, ", J_YOKE"),
];

/// The table of arguments and joints, written down a second time: a letter for each joint that
/// uses the argument (t r c s h, where h stands for Hooke and universal), the formulation that
/// does (b for both), a value within its range, the least value that is not, and that range.
#[rustfmt::skip]
const TABLE: [(&str, &str, char, &str, &str, &str); 19] = [
    ("STICTION_TRANSITION_VELOCITY", "trcsh", 'o', "1E-9", "0", "greater than 0"),
    ("TRANSITION_VELOCITY_COEFFICIENT", "trcsh", 'o', "1.001", "1", "greater than 1"),
    ("MAX_STICTION_DEFORMATION", "trcsh", 'o', "1E-9", "0", "greater than 0"),
    ("FRICTION_FORCE_PRELOAD", "tc", 'b', "0", "-1E-9", "0 or greater"),
    ("FRICTION_TORQUE_PRELOAD", "rcsh", 'b', "0", "-1E-9", "0 or greater"),
    ("MAX_FRICTION_FORCE", "tc", 'b', "1E-9", "0", "greater than 0"),
    ("MAX_FRICTION_TORQUE", "rcsh", 'b', "1E-9", "0", "greater than 0"),
    ("REACTION_ARM", "t", 'b', "1E-9", "0", "greater than 0"),
    ("INITIAL_OVERLAP", "tc", 'b', "1E-9", "0", "greater than 0"),
    ("BENDING_FACTOR", "tc", 'b', "1E-9", "0", "greater than 0"),
    ("PIN_RADIUS", "rch", 'b', "1E-9", "0", "greater than 0"),
    ("FRICTION_ARM", "rh", 'b', "1E-9", "0", "greater than 0"),
    ("BENDING_REACTION_ARM", "rh", 'b', "1E-9", "0", "greater than 0"),
    ("BALL_RADIUS", "s", 'b', "1E-9", "0", "greater than 0"),
    ("BRISTLE_STIFFNESS_COEFFICIENT", "trcsh", 'l', "1E-9", "0", "greater than 0"),
    ("DAMPING_COEFFICIENT", "trcsh", 'l', "0", "-1E-9", "0 or greater"),
    ("VISCOUS_FRICTION_COEFFICIENT", "trcsh", 'l', "0", "-1E-9", "0 or greater"),
    ("VELOCITY_THRESHOLD_STRIBECK", "trcsh", 'l', "1E-9", "0", "greater than 0"),
    ("DECAY_EXPONENT_STRIBECK", "trcsh", 'l', "1E-9", "0", "greater than 0"),
];

#[test]
fn every_argument_is_used_where_the_table_says_and_warned_of_elsewhere() {
    for (argument, joints, formulation, value, ..) in TABLE {
        for (joint, _, yoke) in JOINTS {
            for (law, letter) in [("ORIGINAL", 'o'), ("LUGRE", 'l')] {
                let text = format!(
                    "FRICTION/3, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2, FORMULATION={law}{yoke}\n\
                     , {argument}={value}"
                );
                let found = messages("MILLIMETER", joint, &text);
                let in_law = formulation == 'b' || formulation == letter;
                let letter = match joint {
                    "UNIVERSAL" => 'h',
                    _ => joint.as_bytes()[0].to_ascii_lowercase() as char,
                };
                if in_law && joints.contains(letter) {
                    assert!(found.is_empty(), "{joint} {text}: {found:?}");
                    continue;
                }
                let by = if in_law {
                    format!("a {joint} joint")
                } else {
                    format!("FORMULATION = {law}")
                };
                let expected = Marked {
                    code: Code::UnusedArgument,
                    severity: Severity::Warning,
                    text: argument.to_string(),
                    message: format!("{argument} of FRICTION/3 is not used by {by}"),
                };
                assert_eq!(found, [expected], "{joint} {text}");
            }
        }
    }
}

#[test]
fn every_argument_has_its_range() {
    for (argument, joints, formulation, value, outside, range) in TABLE {
        let (joint, _, yoke) = JOINTS
            .into_iter()
            .find(|(joint, ..)| joint.to_ascii_lowercase().starts_with(&joints[..1]))
            .expect("one of the joints");
        let law = if formulation == 'l' {
            "LUGRE"
        } else {
            "ORIGINAL"
        };
        let with = |value: &str| {
            let text = format!(
                "FRICTION/3, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2, FORMULATION={law}{yoke}\n\
                 , {argument} = {value}"
            );
            messages("MILLIMETER", joint, &text)
        };
        assert_eq!(with(value), [], "{argument}");
        let expected = Marked {
            code: Code::OutOfRange,
            severity: Severity::Error,
            text: outside.to_string(),
            message: format!("{argument} must be {range}"),
        };
        assert_eq!(with(outside), [expected]);
    }
}

/// Every length, velocity, stiffness and damping that a joint uses and a dataset in metres leaves
/// out is named.
#[test]
fn defaults_that_depend_on_the_length_unit_are_named() {
    for (joint, kind, yoke) in JOINTS {
        for (law, formulation) in [
            ("ORIGINAL", dataset::Formulation::Original),
            ("LUGRE", dataset::Formulation::LuGre),
        ] {
            let text = format!(
                "FRICTION/3, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2, FORMULATION={law}{yoke}"
            );
            assert_eq!(messages("MILLIMETER", joint, &text), [], "{joint}");
            let found = messages("METER", joint, &text);
            let [one] = found.as_slice() else {
                panic!("{joint} {law}: {found:?}")
            };
            assert_eq!(
                (one.code, one.severity, one.text.as_str()),
                (Code::DimensionalDefault, Severity::Warning, "FRICTION/3")
            );
            // Coefficients without a unit, zeros and the unlimited 1e40 mean the same everywhere.
            let same = [
                FrictionQuantity::TransitionVelocityCoefficient,
                FrictionQuantity::FrictionForcePreload,
                FrictionQuantity::FrictionTorquePreload,
                FrictionQuantity::MaxFrictionForce,
                FrictionQuantity::MaxFrictionTorque,
                FrictionQuantity::BendingFactor,
                FrictionQuantity::ViscousFrictionCoefficient,
                FrictionQuantity::DecayExponentStribeck,
            ];
            for quantity in FrictionQuantity::ALL {
                let named = one.message.contains(&format!(" {} = ", quantity.keyword()));
                let used = quantity.used_by(kind) && quantity.used_in(formulation);
                let expected = used && !same.contains(&quantity);
                assert_eq!(named, expected, "{joint} {law} {}", quantity.keyword());
            }
        }
    }
    let given = "FRICTION/3, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2, BALL_RADIUS=0.02\n\
                 , STICTION_TRANSITION_VELOCITY=1E-4, MAX_STICTION_DEFORMATION=1E-5";
    assert_eq!(messages("METER", "SPHERICAL", given), []);
}

#[test]
fn both_yokes_of_a_joint_have_their_frictions() {
    let two = "FRICTION/3, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2, I_YOKE\n\
               FRICTION/4, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2, J_YOKE";
    for joint in ["HOOKE", "UNIVERSAL"] {
        assert_eq!(messages("MILLIMETER", joint, two), []);
    }
}
