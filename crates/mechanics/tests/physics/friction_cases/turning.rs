//! Pins and balls (B04, B05a, B08; 9.11, 9.12).

use mechanics::rotation::Quaternion;
use mechanics::{Formulation, Simulation, Snapshot};
use nalgebra::Vector3;

use super::{HALVINGS, Row, Rule};
use crate::builder::v;
use crate::runs::{Sample, angular_velocity, every, run, settings, turning_points};
use crate::shared::{number, numbers, reference};
use crate::systems::law;
use crate::systems::turning::{Pendulum, ball_pendulum, rotor};

/// Angle about z that a body has turned from its start, within half a turn.
fn turned(snapshot: &Snapshot<'_>, body: usize) -> f64 {
    let m = snapshot.rotation(body);
    m[(1, 0)].atan2(m[(0, 0)])
}

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
fn pendulum_rows() -> Vec<Row> {
    let Some(file) = reference("validation/data/B04_pendulum.json") else {
        return Vec::new();
    };
    let mut rows = Vec::new();
    for (name, inertia, end) in [
        ("a_point_mass", 0.0, 11.0),
        ("b_uniform_rod", 1.0 / 12.0, 13.5),
    ] {
        let case = &file["cases"][name];
        let with = |transition_velocity: f64, end: f64| {
            let pendulum = Pendulum {
                length: 0.5,
                pin_radius: 0.05,
                inertia,
                gravity: 9.80665,
                angle: number(case, "/params/theta0_rad"),
                rate: 0.0,
                law: law(0.4, 0.3, transition_velocity, 1e-2 * transition_velocity),
            };
            swings(&pendulum, end)
        };
        let runs = HALVINGS.map(|h| with(1.6e-2 * h, 4.5));
        let turn = |n: usize, key: &str| number(case, &format!("/turning_points/{n}/{key}"));
        for (n, angle, time) in [
            (0, "turn 1", "time of turn 1"),
            (4, "turn 5", "time of turn 5"),
        ] {
            let errors = runs
                .iter()
                .map(|(t, _)| (t[n].1 - turn(n, "theta")).abs())
                .collect();
            rows.push(Row::new(
                format!("B04 {name}"),
                angle,
                errors,
                Rule::AtLeastFirst,
            ));
            let errors = runs
                .iter()
                .map(|(t, _)| (t[n].0 - turn(n, "t")).abs())
                .collect();
            rows.push(Row::new(
                format!("B04 {name}"),
                time,
                errors,
                Rule::AtLeastFirst,
            ));
        }
        let last = case["turning_points"].as_array().expect("a list").len() - 1;
        // The last swings are slow, so that Vs must be smaller against them.
        let rest = HALVINGS.map(|h| with(2e-3 * h, end).1);
        let errors = rest
            .iter()
            .map(|angle| (angle - turn(last, "theta")).abs())
            .collect();
        rows.push(Row::new(
            format!("B04 {name}"),
            "angle at rest",
            errors,
            Rule::AtLeastFirst,
        ));
    }
    rows
}

/// 9.11: one coefficient; turning angles from the closed form in `θ'²`.
fn closed_form_row() -> Row {
    let exact = [
        -56.994_341_76_f64,
        54.123_639_19,
        -51.373_681_62,
        48.732_184_28,
    ];
    let errors = HALVINGS
        .iter()
        .map(|h| {
            let pendulum = Pendulum {
                length: 1.0,
                pin_radius: 0.05,
                inertia: 0.0,
                gravity: 9.81,
                angle: std::f64::consts::FRAC_PI_3,
                rate: 0.0,
                law: law(0.3, 0.3, 1.6e-2 * h, 1.6e-4 * h),
            };
            let (turns, _) = swings(&pendulum, 4.5);
            let errors = turns
                .iter()
                .zip(exact)
                .map(|(t, e)| (t.1 - e.to_radians()).abs());
            errors.fold(0.0, f64::max)
        })
        .collect();
    Row::new(
        "9.11 pendulum, closed form",
        "worst of four turns",
        errors,
        Rule::AtLeastFirst,
    )
}

/// B05a, 9.12: rotors on a collar.
fn rotor_rows() -> Vec<Row> {
    let mut rows = Vec::new();
    let alpha = 0.2 * 0.03 * 2.0 * 9.80665 / 0.01;
    let exact = 50.0 * 50.0 / (2.0 * alpha);
    let errors = HALVINGS
        .iter()
        .map(|h| {
            let law = law(0.25, 0.2, 2e-3 * h, 2e-5 * h);
            let mut angle = 0.0;
            let mut last = 0.0;
            let rotor = rotor(2.0 * 9.80665, 0.01, 0.01, 0.03, 50.0, law);
            run(
                rotor,
                &every(6.0, 600),
                &settings(Formulation::Si2, 1e-10, 0.05),
                |s| {
                    let now = turned(s, 0);
                    let step = now - last;
                    angle += step - std::f64::consts::TAU * (step / std::f64::consts::TAU).round();
                    last = now;
                },
            );
            (angle - exact).abs()
        })
        .collect();
    rows.push(Row::new(
        "B05a rotor on a collar",
        "angle at rest",
        errors,
        Rule::Order(2.0),
    ));
    let disc = rotor(100.0, 0.05, 0.05, 0.08, 10.0, law(0.2, 0.2, 0.1, 0.01));
    let end = run(
        disc,
        &[0.21875],
        &settings(Formulation::Si2, 1e-9, 0.05),
        |_| {},
    );
    let off = [
        turned(&end.snapshot(), 0) - 1.421_875,
        angular_velocity(&end, 0).z - 3.0,
    ];
    let off = off.iter().map(|e| e.abs()).collect();
    rows.push(Row::new(
        "9.12 disc",
        "angle, rate at 1.5 Vs",
        off,
        Rule::Below(1e-8),
    ));
    rows
}

/// B08: a ball joint; the law slides throughout in b.
fn ball_rows() -> Vec<Row> {
    let mut rows = Vec::new();
    let alpha = 0.3 * 0.02 * 9.80665 / 0.005;
    let errors = HALVINGS
        .iter()
        .map(|h| {
            let law = law(0.3, 0.3, 2e-3 * h, 2e-5 * h);
            let model = ball_pendulum(0.0, v(0.0, 0.0, 10.0), Some((law, 0.02)));
            let end = run(
                model,
                &[1.5],
                &settings(Formulation::Si2, 1e-10, 0.05),
                |_| {},
            );
            let exact = 50.0 / alpha - std::f64::consts::TAU;
            (turned(&end.snapshot(), 0) - exact).abs()
        })
        .collect();
    rows.push(Row::new(
        "B08a ball, vertical spin",
        "angle at rest",
        errors,
        Rule::Order(2.0),
    ));
    let Some(file) = reference("validation/data/B08_spherical.json") else {
        return rows;
    };
    let tilt = std::f64::consts::FRAC_PI_3;
    let start = v(0.5, 2.0, 8.0);
    let settings = settings(Formulation::Si2, 1e-10, 0.05);
    let off = |end: &Simulation, case: &str| {
        let exact = numbers(&file, &format!("/cases/{case}/cg"));
        (end.state().centre(0) - Vector3::from_column_slice(&exact)).norm()
    };
    // It slides throughout, so that Vs plays no part.
    let ball = Some((law(0.3, 0.3, 2e-3, 2e-5), 0.02));
    let end = run(ball_pendulum(tilt, start, ball), &[3.0], &settings, |_| {});
    let torque = Vector3::from(end.snapshot().friction(0).force).norm();
    let torque = (torque - number(&file, "/cases/b_spatial/T")).abs();
    let errors = vec![off(&end, "b_spatial"), torque];
    rows.push(Row::new(
        "B08b ball, spatial",
        "centre, torque at 3 s",
        errors,
        Rule::Below(1e-7),
    ));
    let end = run(ball_pendulum(tilt, start, None), &[3.0], &settings, |_| {});
    let place = off(&end, "c_frictionless");
    rows.push(Row::new(
        "B08c ball without friction",
        "centre at 3 s",
        vec![place],
        Rule::Below(1e-7),
    ));
    rows
}

/// A ball that holds a tilt: where `m g L sin θ = μ_s m g Rb ψ(d/Dm)` with the creep `d` that took
/// it there, at 100 and at 10⁴ s.
fn hold_row() -> Row {
    let (mu, radius, length, max_deformation) = (0.3, 0.02, 0.5, 1e-3);
    let start = 8e-3_f64;
    // Vs small enough to damp the swing on the creep.
    let law = law(mu, mu, 1e-3, max_deformation);
    // The axis of the tilt turned about the vertical, so that the creep is a vector.
    let around = Quaternion::exp(&v(0.0, 0.0, 0.7));
    let mut model = ball_pendulum(start, Vector3::zeros(), Some((law, radius)));
    let body = &mut model.bodies[0];
    body.origin = around.matrix() * body.origin;
    body.orientation = around.times(&body.orientation);
    let excess = |creep: f64| {
        let s = creep / max_deformation;
        let psi = (15.0 * s - 10.0 * s.powi(3) + 3.0 * s.powi(5)) / 8.0;
        length * (start - creep / radius).sin() - mu * radius * psi
    };
    let (mut low, mut high) = (0.0, max_deformation);
    for _ in 0..60 {
        let middle = 0.5 * (low + high);
        if excess(middle) > 0.0 {
            low = middle;
        } else {
            high = middle;
        }
    }
    let tilt = start - low / radius;
    let exact = length * around.matrix() * v(0.0, tilt.sin(), -tilt.cos());
    let mut errors = Vec::new();
    let settings = settings(Formulation::Si2, 1e-9, 100.0);
    run(model, &[100.0, 1e4], &settings, |s| {
        errors.push((s.state().centre(0) - exact).norm());
        errors.push((Vector3::from(s.friction(0).creep).norm() - low).abs());
    });
    Row::new(
        "ball held at a tilt, 100 and 10000 s",
        "centre, creep",
        errors,
        Rule::Below(1e-9),
    )
}

pub(crate) fn rows() -> Vec<Row> {
    let mut rows = pendulum_rows();
    rows.push(closed_form_row());
    rows.extend(rotor_rows());
    rows.extend(ball_rows());
    rows.push(hold_row());
    rows
}
