//! Balls (B08; holding).

use friction::parameters::JointType;
use mechanics::rotation::Quaternion;
use mechanics::{Formulation, Simulation};
use nalgebra::Vector3;
use verification::{Case, Rule, Section, check};

use super::{HALVINGS, UNLOADED, original};
use crate::oracle::{psi, root};
use crate::runs::{run, settings, turned};
use crate::shared::{number, numbers, reference};
use mechanisms::builder::v;
use mechanisms::law;
use mechanisms::turning::{Pendulum, ball_pendulum};

const SOURCE: &str = "closed form; Runge–Kutta 1e-13 for the spatial motion";
const BALL: &str =
    "1 kg with its centre 0.5 m below a ball of 0.02 m, inertia 0.02, 0.02, 0.005 kg m², μ 0.3";

/// B08a: spinning about the vertical until it stops.
#[test]
fn ball_that_spins() {
    let alpha = 0.3 * 0.02 * 9.80665 / 0.005;
    let angles = HALVINGS.map(|h| {
        let law = law(0.3, 0.3, 2e-3 * h, 2e-5 * h);
        let model = ball_pendulum(0.0, v(0.0, 0.0, 10.0), Some((law, 0.02)));
        let settings = settings(Formulation::Si2, 1e-10, 0.05);
        let end = run(model, &[1.5], &settings, |_| {});
        turned(&end.snapshot(), 0) + std::f64::consts::TAU
    });
    let covers = original(JointType::Spherical, &["BALL_RADIUS"]);
    let case = Case {
        section: Section::Joint,
        id: "B08a",
        model: &format!("{BALL}, spinning upright at 10 rad/s; Vs from 2 mm/s"),
        source: SOURCE,
        covers: &covers,
    };
    check(&[case.limit(
        "angle at rest [rad]",
        &angles,
        50.0 / alpha,
        Rule::Order(2.0),
        UNLOADED,
    )]);
}

/// B08b and c: spatial motion that slides throughout, so that Vs plays no part.
#[test]
fn ball_that_swings_in_space() {
    let Some(file) = reference("validation/data/B08_spherical.json") else {
        return;
    };
    let tilt = std::f64::consts::FRAC_PI_3;
    let start = v(0.5, 2.0, 8.0);
    let settings = settings(Formulation::Si2, 1e-10, 0.05);
    let claim = |end: &Simulation, id, name: &str, covers| {
        let exact = numbers(&file, &format!("/cases/{name}/cg"));
        let case = Case {
            section: Section::Joint,
            id,
            model: &format!("{BALL}, tilted by 60°, turning with (0.5, 2, 8) rad/s"),
            source: SOURCE,
            covers,
        };
        let ours: Vec<f64> = end.state().centre(0).iter().copied().collect();
        let why = "some thousand steps of an error of 1e-10; the reference is good to 1e-10";
        case.values("centre at 3 s [m]", &ours, &exact, 1e-7, why)
    };
    let ball = Some((law(0.3, 0.3, 2e-3, 2e-5), 0.02));
    let end = run(ball_pendulum(tilt, start, ball), &[3.0], &settings, |_| {});
    let covers = original(JointType::Spherical, &["BALL_RADIUS", "INPUTS"]);
    let mut claims = vec![claim(&end, "B08b", "b_spatial", &covers)];
    let torque = end.snapshot().friction(0).torque.norm();
    let case = Case {
        section: Section::Joint,
        id: "B08b",
        model: &claims[0].model.clone(),
        source: SOURCE,
        covers: &covers,
    };
    let exact = number(&file, "/cases/b_spatial/T");
    let why = "the error of the state times the torque";
    claims.push(case.values(
        "friction torque at 3 s [N m]",
        &[torque],
        &[exact],
        1e-8,
        why,
    ));
    let end = run(ball_pendulum(tilt, start, None), &[3.0], &settings, |_| {});
    claims.push(claim(&end, "B08c without friction", "c_frictionless", &[]));
    check(&claims);
}

/// B08e: in a plane a ball is a pin of its radius.
#[test]
fn ball_in_a_plane_is_a_pin() {
    let settings = settings(Formulation::Si2, 1e-11, 0.05);
    let (tilt, mu) = (std::f64::consts::FRAC_PI_3, law(0.3, 0.3, 2e-3, 2e-5));
    let pendulum = Pendulum {
        length: 0.5,
        pin_radius: 0.02,
        inertia: 0.02,
        gravity: 9.80665,
        angle: tilt,
        rate: 0.0,
        law: mu.into(),
    };
    let times = [1.0, 2.0, 3.0];
    let [mut pin, mut ball] = [const { Vec::new() }; 2];
    run(pendulum.model(), &times, &settings, |s| {
        pin.push(tilt + turned(s, 0));
    });
    let model = ball_pendulum(tilt, Vector3::zeros(), Some((mu, 0.02)));
    run(model, &times, &settings, |s| {
        let centre = s.state().centre(0);
        ball.push(centre.y.atan2(-centre.z));
    });
    let covers = [
        original(JointType::Spherical, &["BALL_RADIUS"]),
        original(JointType::Revolute, &["PIN_RADIUS"]),
    ]
    .concat();
    let case = Case {
        section: Section::Joint,
        id: "B08e",
        model: &format!("{BALL}, from 60° in a plane, against the same on a pin"),
        source: "the same motion on a revolute joint",
        covers: &covers,
    };
    let why = "two integrations with an error of 1e-11 a step";
    check(&[case.values("θ at 1, 2, 3 s [rad]", &ball, &pin, 1e-8, why)]);
}

/// A ball that holds a tilt: where `m g L sin θ = μ_s m g Rb ψ(d/Dm)` with the creep `d` that took
/// it there, at 100 and at 10⁴ s.
#[test]
fn ball_held_at_a_tilt() {
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
    let creep = root(0.0, max_deformation, |creep| {
        length * (start - creep / radius).sin() - mu * radius * psi(creep / max_deformation)
    });
    let tilt = start - creep / radius;
    let exact = length * around.matrix() * v(0.0, tilt.sin(), -tilt.cos());
    let mut errors = Vec::new();
    let settings = settings(Formulation::Si2, 1e-9, 100.0);
    run(model, &[100.0, 1e4], &settings, |s| {
        errors.push((s.state().centre(0) - exact).norm());
        errors.push((s.friction(0).creep.norm() - creep).abs());
    });
    let case = Case {
        section: Section::Joint,
        id: "hold, spherical",
        model: "the pendulum of B08 held at a tilt of 8 mrad by a ball of 0.02 m, μs 0.3, Dm 1 mm, Vs 1 mm/s",
        source: "equilibrium L sin θ = μs Rb ψ(d/Dm) by bisection",
        covers: &original(JointType::Spherical, &["BALL_RADIUS"]),
    };
    check(&[case.worst(
        "centre and creep at 100 s and 10000 s [m]",
        errors.into_iter().fold(0.0, f64::max),
        1e-9,
        "no drift is allowed; the approach is over by then",
    )]);
}
