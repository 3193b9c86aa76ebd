//! Rotors on collars (B05; 9.12).

use friction::parameters::JointType;
use mechanics::Formulation;
use verification::{Case, Rule, Section, check};

use super::{HALVINGS, UNLOADED, original};
use crate::runs::{angular_velocity, every, run, settings, turned};
use crate::systems::law;
use crate::systems::turning::rotor;

/// B05a: a rotor that carries its weight on a collar, until it stops.
#[test]
fn rotor_on_a_collar() {
    let alpha = 0.2 * 0.03 * 2.0 * 9.80665 / 0.01;
    let angles = HALVINGS.map(|h| {
        let law = law(0.25, 0.2, 2e-3 * h, 2e-5 * h);
        let (mut angle, mut last) = (0.0, 0.0);
        let rotor = rotor(2.0 * 9.80665, 0.01, 0.01, 0.03, 50.0, law);
        let settings = settings(Formulation::Si2, 1e-10, 0.05);
        run(rotor, &every(6.0, 600), &settings, |s| {
            let now = turned(s, 0);
            let step = now - last;
            angle += step - std::f64::consts::TAU * (step / std::f64::consts::TAU).round();
            last = now;
        });
        angle
    });
    let case = Case {
        section: Section::Joint,
        id: "B05a",
        model: "rotor of 2 kg, 0.01 kg m² on a vertical axis, collar 0.03 m, μd 0.2, from 50 rad/s; Vs from 2 mm/s",
        source: "closed form",
        covers: &original(JointType::Revolute, &["FRICTION_ARM"]),
    };
    let exact = 50.0 * 50.0 / (2.0 * alpha);
    check(&[case.limit(
        "angle at rest [rad]",
        &angles,
        exact,
        Rule::Order(2.0),
        UNLOADED,
    )]);
}

/// 9.12: until the transition begins.
#[test]
fn disc_on_a_collar() {
    let disc = rotor(100.0, 0.05, 0.05, 0.08, 10.0, law(0.2, 0.2, 0.1, 0.01));
    let settings = settings(Formulation::Si2, 1e-9, 0.05);
    let end = run(disc, &[0.21875], &settings, |_| {});
    let case = Case {
        section: Section::Joint,
        id: "9.12",
        model: "disc of 0.05 kg m², collar 0.08 m, 100 N along the axis, μd 0.2, from 10 rad/s",
        source: "closed form",
        covers: &original(JointType::Revolute, &["FRICTION_ARM", "PIN_RADIUS"]),
    };
    check(&[case.values(
        "angle and rate at 1.5 Vs [rad, rad/s]",
        &[turned(&end.snapshot(), 0), angular_velocity(&end, 0).z],
        &[1.421_875, 3.0],
        1e-8,
        "constant deceleration: the start of the integrator",
    )]);
}
