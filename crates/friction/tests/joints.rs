//! Load formulas, limits and the table of arguments.

mod shared;

use friction::parameters::{DefaultValue, JointType, PARAMETERS, Range, inputs_of};
use friction::{Effect, Inputs, RevoluteLoad, SphericalLoad, TranslationalLoad, resultant};
use shared::{law, norm};
use verification::{Case, Coverage, Formulation, Section, check};

const PIN: RevoluteLoad = RevoluteLoad {
    inputs: Inputs::ALL,
    pin_radius: 0.05,
    friction_arm: 0.08,
    bending_reaction_arm: 0.1,
};

const GUIDE: TranslationalLoad = TranslationalLoad {
    inputs: Inputs::ALL,
    reaction_arm: 0.1,
    bending_factor: 1.5,
    initial_overlap: 0.25,
    overlap_sign: 0.0,
};

/// The loads of 9.3, by hand.
#[test]
fn loads_by_hand() {
    let case = |id, model, joint, arguments| {
        let covers = [Coverage {
            joint,
            formulation: Formulation::Original,
            arguments,
        }];
        (id, model, covers)
    };
    let claim = |(id, model, covers): (&str, &str, [Coverage<'_>; 1]), quantity, ours, exact| {
        let case = Case {
            section: Section::Law,
            id,
            model,
            source: "by hand",
            covers: &covers,
        };
        case.values(quantity, &[ours], &[exact], 1e-14, "rounding")
    };
    let pin = PIN
        .evaluate([300.0, 400.0, -200.0], [30.0, 40.0, 1e9])
        .value;
    let guide = GUIDE
        .evaluate([30.0, 40.0, 1e9], [6.0, 8.0, -3.0], 0.1)
        .value;
    let ball = SphericalLoad {
        inputs: Inputs::ALL,
        ball_radius: 0.02,
    };
    let ball = ball.evaluate([36.0, 48.0, -80.0]).value;
    check(&[
        claim(
            case(
                "9.3 revolute",
                "Rp 0.05, Rn 0.08, Rb 0.1; F = (300, 400, -200), M = (30, 40, any); μ 0.3",
                JointType::Revolute,
                &["PIN_RADIUS", "FRICTION_ARM", "BENDING_REACTION_ARM"],
            ),
            "friction torque",
            0.3 * pin,
            19.8,
        ),
        claim(
            case(
                "9.3 translational",
                "Xs 0.25, BF 1.5, Rn 0.1; F = (30, 40, any), M = (6, 8, -3); μ 0.2",
                JointType::Translational,
                &["REACTION_ARM", "INITIAL_OVERLAP", "BENDING_FACTOR"],
            ),
            "friction force",
            0.2 * guide,
            28.0,
        ),
        claim(
            case(
                "9.3 spherical",
                "Rb 0.02; F = (36, 48, -80); μ 0.1",
                JointType::Spherical,
                &["BALL_RADIUS"],
            ),
            "friction torque",
            0.1 * ball,
            0.2,
        ),
    ]);
}

#[test]
fn revolute() {
    let load = PIN.evaluate([300.0, 400.0, -200.0], [30.0, 40.0, 1e9]);
    assert!((load.from_reaction - 41.0).abs() < 1e-13 && (load.from_bending - 25.0).abs() < 1e-13);
    let off = RevoluteLoad {
        inputs: Inputs {
            reaction_force: false,
            ..Inputs::ALL
        },
        ..PIN
    };
    assert!(
        (off.evaluate([300.0, 400.0, -200.0], [30.0, 40.0, 0.0])
            .value
            - 25.0)
            .abs()
            < 1e-13
    );
    let none = RevoluteLoad {
        inputs: Inputs::NONE,
        ..PIN
    };
    assert_eq!(
        none.evaluate([300.0, 400.0, -200.0], [30.0, 40.0, 0.0])
            .value,
        0.0
    );
}

#[test]
fn translational() {
    let load = GUIDE.evaluate([30.0, 40.0, 1e9], [6.0, 8.0, -3.0], 0.1);
    assert_eq!(load.by_displacement, 0.0);
    // Overlap 0.25 +- 0.15: bending 1.5 * 10/0.4 and 1.5 * 10/0.1.
    for (sign, bending) in [(1.0, 37.5), (-1.0, 150.0)] {
        let guide = TranslationalLoad {
            overlap_sign: sign,
            ..GUIDE
        };
        let load = guide.evaluate([0.0; 3], [6.0, 8.0, 0.0], 0.15);
        assert!((load.from_bending - bending).abs() < 1e-12 && !load.overlap_exhausted);
    }
}

#[test]
fn overlap_never_vanishes() {
    let guide = TranslationalLoad {
        overlap_sign: -1.0,
        ..GUIDE
    };
    for displacement in [0.2499, 0.25, 7.0] {
        let load = guide.evaluate([0.0; 3], [6.0, 8.0, 0.0], displacement);
        // 1.5 * 10/(0.25/1000)
        assert!(
            load.overlap_exhausted && (load.value - 6e4).abs() < 1e-9,
            "{load:?}"
        );
    }
}

#[test]
fn limit_is_preload_plus_maximum() {
    for v in [[0.3, 0.4, 0.0], [0.0, 0.02, 0.01]] {
        let c = law(Effect::All).evaluate(&v, &[0.004, -0.001, 0.0]);
        let free = resultant(&c, 100.0, 0.0, 1e40);
        assert!(!free.clipped);
        assert!((norm(&free.force) - 100.0 * norm(&c.mu)).abs() < 1e-13);
        let clipped = resultant(&c, 100.0, 5.0, 2.0);
        assert!(clipped.clipped && clipped.by_load == [0.0; 3]);
        assert!(norm(&clipped.force) <= 7.0 + 1e-14);
        let preload = resultant(&c, 0.0, 5.0, 2.0);
        assert!((norm(&preload.force) - 5.0 * norm(&c.direction)).abs() < 1e-14);
        assert!(!preload.clipped);
    }
    // Sliding: 2 + 5 exactly along the velocity.
    let c = law(Effect::All).evaluate(&[0.5], &[0.0]);
    assert_eq!(resultant(&c, 100.0, 5.0, 2.0).force, [-7.0]);
}

#[test]
fn arguments() {
    let number_of = |joint: JointType| {
        PARAMETERS
            .iter()
            .filter(|p| p.joints.contains(&joint))
            .count()
    };
    // Fifteen that every joint uses (five of them for LUGRE), and each joint's own.
    assert_eq!(number_of(JointType::Translational), 15 + 6);
    assert_eq!(number_of(JointType::Revolute), 15 + 5);
    assert_eq!(number_of(JointType::Cylindrical), 15 + 8);
    assert_eq!(number_of(JointType::Spherical), 15 + 3);
    assert_eq!(number_of(JointType::Hooke), 15 + 7);
    for (k, p) in PARAMETERS.iter().enumerate() {
        assert!(
            PARAMETERS[..k]
                .iter()
                .all(|other| other.keyword != p.keyword),
            "{}",
            p.keyword
        );
        match (p.default, p.range) {
            (DefaultValue::Number(value), range) => assert!(range.contains(value), "{}", p.keyword),
            (DefaultValue::Word(word), Range::OneOf(words)) => assert!(words.contains(&word)),
            (DefaultValue::Word(word), Range::ListOf(_)) => assert_eq!(word, "ALL"),
            (DefaultValue::Required | DefaultValue::Absent, _) => {}
            (DefaultValue::Word(_), _) => panic!("{} has a word for a number", p.keyword),
        }
    }
    let range = |keyword: &str| {
        PARAMETERS
            .iter()
            .find(|p| p.keyword == keyword)
            .unwrap()
            .range
    };
    assert!(!range("TRANSITION_VELOCITY_COEFFICIENT").contains(1.0));
    assert!(range("FRICTION_TORQUE_PRELOAD").contains(0.0));
    assert!(!range("MU_STATIC").contains(0.0) && !range("MU_STATIC").contains(f64::NAN));
    assert!(!range("EFFECT").contains(1.0));
    assert_eq!(inputs_of(JointType::Hooke).len(), 3);
    assert_eq!(inputs_of(JointType::Translational).len(), 4);
}
