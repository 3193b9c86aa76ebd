//! What must not change the results: where the world stands, units, the order of elements; and
//! friction takes energy away.

use friction::Regime;
use mechanics::Formulation;
use mechanics::model::{FrictionJoint, Law, Model};
use mechanics::rotation::Quaternion;
use nalgebra::Vector3;
use proptest::prelude::*;
use verification::{Case, Section, check};

use crate::runs::{assembled, energy, every, go_on, run, settings};
use mechanisms::builder::v;
use mechanisms::turning::ball_pendulum;
use mechanisms::{four_bar, law, slider_crank};

const END: f64 = 0.3;
const ERROR: f64 = 1e-8;

/// A ball with friction and a slider-crank with friction in its guide, whose friction changes.
fn models() -> [Model; 2] {
    let ball = Some((law(0.3, 0.25, 1e-2, 1e-4), 0.02));
    [
        ball_pendulum(1.0, v(0.5, 2.0, 8.0), ball),
        slider_crank(Some(law(0.25, 0.2, 1e-1, 1e-3))),
    ]
}

/// Centres of all bodies at the end.
fn centres(model: Model) -> Vec<Vector3<f64>> {
    let end = run(
        model,
        &[END],
        &settings(Formulation::Si2, ERROR, 0.01),
        |_| {},
    );
    (0..end.state().bodies())
        .map(|body| end.state().centre(body))
        .collect()
}

/// The model in a world turned and then shifted.
fn moved(mut model: Model, turn: &Quaternion, shift: Vector3<f64>) -> Model {
    let matrix = turn.matrix();
    for marker in model.markers.iter_mut().filter(|m| m.body.is_none()) {
        marker.offset = matrix * marker.offset + shift;
        marker.axes = matrix * marker.axes;
    }
    for body in &mut model.bodies {
        body.origin = matrix * body.origin + shift;
        body.orientation = turn.times(&body.orientation);
        body.velocity = matrix * body.velocity;
        body.angular_velocity = matrix * body.angular_velocity;
    }
    model.gravity = matrix * model.gravity;
    model
}

/// The model with lengths in millimetres; forces then are in millinewtons.
fn in_millimetres(mut model: Model) -> Model {
    for marker in &mut model.markers {
        marker.offset *= 1e3;
    }
    for body in &mut model.bodies {
        body.origin *= 1e3;
        body.centre *= 1e3;
        body.velocity *= 1e3;
        body.inertia *= 1e6;
    }
    for friction in &mut model.frictions {
        let Law::Original(law) = &mut friction.law else {
            panic!("the model has stick-slip friction only")
        };
        law.transition_velocity *= 1e3;
        law.max_deformation *= 1e3;
        match &mut friction.load {
            FrictionJoint::Translational(load) => {
                load.reaction_arm *= 1e3;
                load.initial_overlap *= 1e3;
            }
            FrictionJoint::Revolute(load) | FrictionJoint::Pin(_, load) => {
                load.pin_radius *= 1e3;
                load.friction_arm *= 1e3;
                load.bending_reaction_arm *= 1e3;
            }
            FrictionJoint::Cylindrical(load) => {
                load.pin_radius *= 1e3;
                load.initial_overlap *= 1e3;
            }
            FrictionJoint::Spherical(load) => load.ball_radius *= 1e3,
        }
    }
    model.gravity *= 1e3;
    model
}

/// The model with bodies, markers and joints in another order and under other ids; `order` ranks
/// them.
fn shuffled(model: &Model, order: impl Fn(usize) -> usize) -> (Model, Vec<usize>) {
    let ranked = |count: usize| {
        let mut places: Vec<usize> = (0..count).collect();
        places.sort_by_key(|&place| order(place));
        // New place of every old one.
        let mut new = vec![0; count];
        for (at, &place) in places.iter().enumerate() {
            new[place] = at;
        }
        (places, new)
    };
    let (bodies, new_body) = ranked(model.bodies.len());
    let (markers, new_marker) = ranked(model.markers.len());
    let (joints, new_joint) = ranked(model.joints.len());
    let mut out = model.clone();
    out.bodies = bodies.iter().map(|&k| model.bodies[k].clone()).collect();
    out.markers = markers.iter().map(|&k| model.markers[k].clone()).collect();
    out.joints = joints.iter().map(|&k| model.joints[k].clone()).collect();
    for (n, body) in out.bodies.iter_mut().enumerate() {
        body.label.id = 1000 - n as u32;
    }
    for marker in &mut out.markers {
        marker.body = marker.body.map(|body| new_body[body]);
    }
    for joint in &mut out.joints {
        (joint.i, joint.j) = (new_marker[joint.i], new_marker[joint.j]);
        joint.label.id += 77;
    }
    for friction in &mut out.frictions {
        friction.joint = new_joint[friction.joint];
    }
    (out, new_body)
}

fn largest(a: &[Vector3<f64>], b: impl Fn(usize) -> Vector3<f64>) -> f64 {
    let differences = a.iter().enumerate().map(|(k, a)| (a - b(k)).norm());
    differences.fold(0.0, f64::max)
}

proptest! {
    #![proptest_config(ProptestConfig { cases: 12, failure_persistence: None, ..ProptestConfig::default() })]

    #[test]
    fn a_turned_and_shifted_world_moves_alike(
        turn in [-3.0..3.0, -3.0..3.0, -3.0..3.0_f64],
        shift in [-5.0..5.0, -5.0..5.0, -5.0..5.0_f64],
    ) {
        let (turn, shift) = (Quaternion::exp(&Vector3::from(turn)), Vector3::from(shift));
        for model in models() {
            let plain = centres(model.clone());
            let there = centres(moved(model, &turn, shift));
            let difference = largest(&there, |k| turn.matrix() * plain[k] + shift);
            // The error test takes the largest component along ground axes, so steps differ a
            // little and with them the global errors: about a hundred steps of ERROR at most.
            prop_assert!(difference < 100.0 * ERROR, "{difference:e}");
        }
    }

    #[test]
    fn the_order_of_elements_and_their_ids_play_no_part(seed in 1_usize..1000) {
        for model in models() {
            let plain = centres(model.clone());
            let (other, new_body) = shuffled(&model, |k| (k + 1) * seed * 7919 % 1009);
            let there = centres(other);
            let difference = largest(&plain, |k| there[new_body[k]]);
            // Same equations and error test; another order of elimination and other redundant
            // equations dropped: rounding, which decisions on steps may amplify.
            prop_assert!(difference < 10.0 * ERROR, "{difference:e}");
        }
    }
}

fn case(id: &'static str) -> Case<'static> {
    Case {
        section: Section::Integration,
        id,
        model: "a ball and a slider-crank with friction, 0.3 s, error tolerance 1e-8",
        source: "the same model, stated otherwise",
        covers: &[],
    }
}

#[test]
fn millimetres_and_metres_move_alike() {
    let mut worst = 0.0_f64;
    for model in models() {
        let plain = centres(model.clone());
        let there = centres(in_millimetres(model));
        worst = worst.max(largest(&there, |k| 1e3 * plain[k]) * 1e-3);
    }
    let why = "the error test is relative to the model's length: the same steps, other rounding";
    check(&[case("millimetres").worst("centres in mm and in m [m]", worst, ERROR, why)]);
}

#[test]
fn stops_on_the_way_change_little() {
    let mut worst = 0.0_f64;
    for model in models() {
        let plain = centres(model.clone());
        let settings = settings(Formulation::Si2, ERROR, 0.01);
        let mut simulation = assembled(model);
        for end in every(END, 10) {
            go_on(&mut simulation, &[end], &settings, |_| {});
        }
        worst = worst.max(largest(&plain, |k| simulation.state().centre(k)));
    }
    let why = "creep and state go on exactly; the steps after each start are others";
    check(&[case("restarts").worst("centres with ten starts [m]", worst, 100.0 * ERROR, why)]);
}

/// Models that lose energy to friction, and their duration.
fn dissipative() -> [(&'static str, Model, f64); 3] {
    let ball = Some((law(0.3, 0.25, 1e-2, 1e-4), 0.02));
    [
        ("ball", ball_pendulum(1.0, v(0.5, 2.0, 8.0), ball), 4.0),
        (
            "slider-crank",
            slider_crank(Some(law(0.25, 0.2, 1e-1, 1e-3))),
            2.5,
        ),
        ("four-bar", four_bar(Some(law(0.25, 0.2, 1e-2, 1e-4))), 3.5),
    ]
}

/// What bodies lose, friction takes: the work of friction is integrated beside the motion.
#[test]
fn energy_balances() {
    let mut claims = Vec::new();
    for (name, model, end) in dissipative() {
        let frictions = model.frictions.len();
        let case = Case {
            id: &format!("energy, {name}"),
            model: "the mechanism with friction in its joints until most of its energy is gone",
            source: "balance of kinetic energy, weight and the work of friction",
            ..case("")
        };
        for (quantity, error, bound) in [
            ("residual by energy taken, error tolerance 1e-4", 1e-4, 1e-2),
            (
                "residual by energy taken, error tolerance 1e-6",
                1e-6,
                2.2e-4,
            ),
            (
                "residual by energy taken, error tolerance 1e-8",
                1e-8,
                4.7e-6,
            ),
        ] {
            let mut simulation = assembled(model.clone());
            let before = energy(&simulation.snapshot());
            let settings = settings(Formulation::Si2, error, 0.01);
            go_on(&mut simulation, &[end], &settings, |_| {});
            let taken: f64 = simulation.state().works()[..frictions].iter().sum();
            let residual = (before - energy(&simulation.snapshot()) - taken).abs() / taken;
            let why = "a hundred times the tolerance 1e-4 for hundreds of steps; it falls as tolerance^(5/6)";
            claims.push(case.worst(quantity, residual, bound, why));
        }
    }
    check(&claims);
}

#[test]
fn friction_takes_energy() {
    for (name, model, end) in dissipative() {
        let (mut last, mut start, mut rise) = (f64::INFINITY, None, 0.0_f64);
        // What stuck surfaces may give back: at most their load times μ_s times Dm · 0.6875, the
        // integral of the quintic step, for each joint.
        let mut elastic = 0.0_f64;
        let settings = settings(Formulation::Si2, ERROR, 0.01);
        run(
            model.clone(),
            &every(end, (end * 1000.0) as usize),
            &settings,
            |s| {
                let now = energy(s);
                start.get_or_insert(now);
                rise = rise.max(now - last);
                last = now;
                let stored = model.frictions.iter().enumerate().map(|(k, friction)| {
                    let values = s.friction(k);
                    let stuck = values.regime == Regime::Stuck;
                    let load = friction.surface_load(&values.load);
                    match friction.law {
                        Law::Original(law) if stuck => {
                            0.6875 * law.mu_static * load * law.max_deformation
                        }
                        _ => 0.0,
                    }
                });
                elastic = elastic.max(stored.sum());
            },
        );
        let lost = start.unwrap_or(last) - last;
        println!(
            "{name}: lost {lost:.3} J, largest rise in 1 ms {rise:.1e} J, elastic {elastic:.1e} J"
        );
        // The integrator's own drift of energy is below 1e-6 of it at this error.
        assert!(rise <= elastic + 1e-6 * lost, "{name} {rise:e} {elastic:e}");
        assert!(lost > 0.1);
    }
}
