//! Pins (B04; 9.11).

use friction::parameters::JointType;
use mechanics::Formulation;
use verification::{Case, Rule, Section, check};

use super::{HALVINGS, TURNS, original};
use crate::oracle::{psi, root};
use crate::runs::{Sample, every, run, settings, turned, turning_points};
use crate::shared::{number, reference};
use mechanisms::law;
use mechanisms::turning::Pendulum;

/// Turning points and the last angle of a pendulum.
fn swings(pendulum: &Pendulum, end: f64) -> (Vec<(f64, f64)>, f64) {
    let mut samples = Vec::new();
    let outputs = every(end, (end * 2000.0) as usize);
    run(
        pendulum.model(),
        &outputs,
        &settings(Formulation::Si2, 1e-11, 0.02),
        |s| {
            samples.push(Sample {
                time: s.time(),
                value: pendulum.angle + turned(s, 0),
                rate: s.state().velocities()[5],
            });
        },
    );
    let last = samples.last().map_or(0.0, |s| s.value);
    (turning_points(&samples), last)
}

/// B04: point mass and rod, five turns and the angle where they stick.
#[test]
fn pendulums_on_pins() {
    let Some(file) = reference("validation/data/B04_pendulum.json") else {
        return;
    };
    let covers = original(JointType::Revolute, &["PIN_RADIUS", "INPUTS"]);
    let rule = Rule::AtLeastOrder(1.0);
    let mut claims = Vec::new();
    for (id, name, model, inertia, end) in [
        (
            "B04a",
            "a_point_mass",
            "1 kg, a point at 0.5 m, on a pin of 0.05 m, μs 0.4, μd 0.3, from 60°; Vs from 16 mm/s",
            0.0,
            11.0,
        ),
        (
            "B04b",
            "b_uniform_rod",
            "rod of 1 kg and 1 m on a pin of 0.05 m, μs 0.4, μd 0.3, from 60°; Vs from 16 mm/s",
            1.0 / 12.0,
            13.5,
        ),
    ] {
        let exact = &file["cases"][name];
        let case = Case {
            section: Section::Joint,
            id,
            model,
            source: "exact stick and slip, Runge–Kutta 1e-13; closed form for the point",
            covers: &covers,
        };
        let with = |transition_velocity: f64, end: f64| {
            let pendulum = Pendulum {
                length: 0.5,
                pin_radius: 0.05,
                inertia,
                gravity: 9.80665,
                angle: number(exact, "/params/theta0_rad"),
                rate: 0.0,
                law: law(0.4, 0.3, transition_velocity, 1e-2 * transition_velocity).into(),
            };
            swings(&pendulum, end)
        };
        let runs = HALVINGS.map(|h| with(1.6e-2 * h, 4.5).0);
        let turn = |n: usize, key: &str| number(exact, &format!("/turning_points/{n}/{key}"));
        for (n, angle, time) in [
            (0, "angle of turn 1 [rad]", "time of turn 1 [s]"),
            (4, "angle of turn 5 [rad]", "time of turn 5 [s]"),
        ] {
            let angles = runs.each_ref().map(|t| t[n].1);
            claims.push(case.limit(angle, &angles, turn(n, "theta"), rule, TURNS));
            let times = runs.each_ref().map(|t| t[n].0);
            claims.push(case.limit(time, &times, turn(n, "t"), rule, TURNS));
        }
        let last = exact["turning_points"].as_array().expect("a list").len() - 1;
        // The last swings are slow, so that Vs must be smaller against them.
        let rest = HALVINGS.map(|h| with(2e-3 * h, end).1);
        let quantity = "angle at rest, Vs from 2 mm/s [rad]";
        claims.push(case.limit(quantity, &rest, turn(last, "theta"), rule, TURNS));
    }
    check(&claims);
}

/// 9.11: one coefficient; turning angles from the closed form in `θ'²`.
#[test]
fn pendulum_and_its_closed_form() {
    let exact = [
        -56.994_341_76_f64,
        54.123_639_19,
        -51.373_681_62,
        48.732_184_28,
    ];
    let errors = HALVINGS.map(|h| {
        let pendulum = Pendulum {
            length: 1.0,
            pin_radius: 0.05,
            inertia: 0.0,
            gravity: 9.81,
            angle: std::f64::consts::FRAC_PI_3,
            rate: 0.0,
            law: law(0.3, 0.3, 1.6e-2 * h, 1.6e-4 * h).into(),
        };
        let (turns, _) = swings(&pendulum, 4.5);
        let errors = turns
            .iter()
            .zip(exact)
            .map(|(t, e)| (t.1 - e.to_radians()).abs());
        errors.fold(0.0, f64::max)
    });
    let case = Case {
        section: Section::Joint,
        id: "9.11",
        model: "a point of 1 kg at 1 m on a pin of 0.05 m, μs = μd = 0.3, from 60°; Vs from 16 mm/s",
        source: "closed form in θ'², specification 9.11",
        covers: &original(JointType::Revolute, &["PIN_RADIUS"]),
    };
    let quantity = "worst angle of four turns [rad]";
    check(&[case.vanishing(quantity, &errors, Rule::AtLeastOrder(1.0), TURNS)]);
}

/// A pin that holds a pendulum off the vertical: where `m g L sin θ = μ_s m g Rp ψ(d/Dm)` with the
/// creep `d` that took it there.
#[test]
fn pendulum_held_by_its_pin() {
    let (mu, radius, length, max_deformation) = (0.3, 0.05, 0.5, 1e-3);
    let start = 0.025_f64;
    let pendulum = Pendulum {
        length,
        pin_radius: radius,
        inertia: 1.0 / 12.0,
        gravity: 9.80665,
        angle: start,
        rate: 0.0,
        // Vs small enough to damp the swing on the creep.
        law: law(mu, mu, 1e-3, max_deformation).into(),
    };
    let creep = root(0.0, max_deformation, |creep| {
        length * (start - creep / radius).sin() - mu * radius * psi(creep / max_deformation)
    });
    let mut angles = Vec::new();
    let settings = settings(Formulation::Si2, 1e-9, 100.0);
    run(pendulum.model(), &[100.0, 1000.0, 1e4], &settings, |s| {
        angles.push(start + turned(s, 0));
    });
    let case = Case {
        section: Section::Joint,
        id: "hold, revolute",
        model: "rod of 1 kg and 1 m held at 25 mrad by a pin of 0.05 m, μs 0.3, Dm 1 mm, Vs 1 mm/s",
        source: "equilibrium L sin θ = μs Rp ψ(d/Dm) by bisection",
        covers: &original(JointType::Revolute, &["PIN_RADIUS"]),
    };
    let exact = [start - creep / radius; 3];
    let why = "no drift is allowed; the approach is over by 100 s";
    check(&[case.values("θ at 100, 1000, 10000 s [rad]", &angles, &exact, 1e-9, why)]);
}
