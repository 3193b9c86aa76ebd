//! Rotors on collars, unbalanced rotors and brakes (B05; 9.12, 9.18).

use friction::Inputs;
use friction::parameters::JointType;
use mechanics::Formulation;
use mechanics::model::{FrictionJoint, Level, MotionFreedom};
use nalgebra::Vector3;
use verification::{Case, Rule, Section, check};

use super::{HALVINGS, UNLOADED, original};
use crate::oracle::{psi, root, runge_kutta};
use crate::runs::{angular_velocity, assembled, every, run, settings, turned};
use mechanisms::builder::Builder;
use mechanisms::law;
use mechanisms::turning::{rotor, unbalanced_rotor};

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

/// B05b and c: unbalance loads the pin and, off the joint's plane, bends it.
#[test]
fn unbalanced_rotors() {
    let covers = original(
        JointType::Revolute,
        &[
            "FRICTION_ARM",
            "PIN_RADIUS",
            "BENDING_REACTION_ARM",
            "INPUTS",
        ],
    );
    let mut claims = Vec::new();
    for (id, height) in [("B05b", 0.0), ("B05c", 0.1)] {
        let (mass, arm, g) = (0.3, 0.05, 9.80665);
        // The reaction of the joint turns with the rotor: along and across the mass's radius.
        let rate = |s: &[f64; 2]| {
            let [_, omega] = *s;
            let square = omega * omega;
            let mut alpha = 0.0_f64;
            for _ in 0..50 {
                let radial = mass * arm * alpha.hypot(square);
                let bending = mass * arm * (height * square + g).hypot(height * alpha);
                let load = 0.01 * radial + 0.03 * (2.0 + mass) * g + 0.01 / 0.05 * bending;
                alpha = -0.2 * load / (0.01 + mass * arm * arm);
            }
            [omega, alpha]
        };
        let times = [0.5, 1.0, 1.5];
        let exact = times.map(|t| runge_kutta([0.0, 50.0], t, 3000, rate)[1]);
        let model = unbalanced_rotor(height, law(0.25, 0.2, 1e-4, 1e-6));
        let mut ours = Vec::new();
        let settings = settings(Formulation::Si2, 1e-11, 0.01);
        run(model, &times, &settings, |s| {
            ours.push(s.state().velocities()[5]);
        });
        let case = Case {
            section: Section::Joint,
            id,
            model: &format!(
                "rotor of 2 kg, 0.01 kg m², with 0.3 kg at 0.05 m and {height} m above its joint, collar 0.03 m, Rp 0.01, Rb 0.05 m, μd 0.2, from 50 rad/s"
            ),
            source: "one equation with the load of the same instant, Runge–Kutta",
            covers: &covers,
        };
        let why = "the error of a step is 1e-11 of rates of 50";
        claims.push(case.values("rate at 0.5, 1, 1.5 s [rad/s]", &ours, &exact, 5e-7, why));
    }
    check(&claims);
}

/// 9.18: a brake whose torque is a preload alone.
#[test]
fn preload_brakes() {
    let brake = |torque: f64| {
        let mut model = rotor(0.0, 50.0, 1.0, 1.0, 0.0, law(1.0, 1.0, 0.1, 0.01));
        let FrictionJoint::Revolute(load) = &mut model.frictions[0].load else {
            panic!("a rotor turns in a revolute joint")
        };
        load.inputs = Inputs {
            preload: true,
            ..Inputs::NONE
        };
        model.frictions[0].preload.torque = 135.0;
        let mut b = Builder { model };
        b.torque(0, Vector3::z(), torque);
        b
    };
    let mut sliding = Vec::new();
    for speed in [0.1, 0.15, 1.0, 20.0, -3.0] {
        let mut b = brake(0.0);
        b.drive(0, MotionFreedom::AboutZ, Level::Position, speed);
        b.start_turning(0, speed);
        sliding.push(assembled(b.model).snapshot().friction(0).torque.z.abs());
    }
    let mut creep = Vec::new();
    let exact =
        [50.0, 100.0, 130.0].map(|torque| root(0.0, 0.01, |d| torque / 135.0 - psi(d / 0.01)));
    for torque in [50.0, 100.0, 130.0] {
        let settings = settings(Formulation::Si2, 1e-10, 1.0);
        let end = run(brake(torque).model, &[60.0], &settings, |_| {});
        creep.push(end.snapshot().friction(0).creep.rotation.z);
    }
    let case = Case {
        section: Section::Joint,
        id: "9.18",
        model: "revolute brake, INPUTS=PRELOAD, preload 135 N m, μ 1, Vs 0.1, Dm 0.01, Rp 1",
        source: "|T| = 135 at every speed from Vs on; creep Dm ψ⁻¹(T/135) below",
        covers: &original(JointType::Revolute, &["FRICTION_TORQUE_PRELOAD", "INPUTS"]),
    };
    check(&[
        case.values(
            "torque at 0.1, 0.15, 1, 20, -3 m/s [N m]",
            &sliding,
            &[135.0; 5],
            1e-12,
            "rounding",
        ),
        case.values(
            "creep under 50, 100, 130 N m [m]",
            &creep,
            &exact,
            1e-9,
            "the rest of the approach after a minute",
        ),
    ]);
}
