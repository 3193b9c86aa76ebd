//! Observed order of the formulas, in positions, velocities and reactions.
//!
//! The longest step `h` limits every step and the error per step, a tenth of ERROR, just permits it, so that
//! Newton's iteration stops with an error of the same order. The first steps are tiny and grow.

use mechanics::model::Model;
use mechanics::{Formulation, Owner, Simulation};
use nalgebra::Vector3;
use verification::{Case, Section, check};

use crate::runs::{assembled, go_on, settings};
use mechanisms::builder::v;
use mechanisms::pendulum;
use mechanisms::turning::ball_pendulum;

const END: f64 = 2.0;

/// Position, velocity and reaction at the end.
fn end_of(simulation: &Simulation) -> [Vector3<f64>; 3] {
    let velocity = Vector3::from_column_slice(&simulation.state().velocities()[..3]);
    let reaction = simulation.snapshot().reaction(Owner::Joint(0)).force;
    [simulation.state().centre(0), velocity, reaction]
}

fn fixed_steps(model: Model, formulation: Formulation, order: usize, h: f64) -> [Vector3<f64>; 3] {
    // Derivatives of the pendulum of 1 m grow by √g and its harmonics, about 6 per second.
    let error = 10.0 * (6.0 * h).powi(order as i32 + 1);
    let mut settings = settings(formulation, error, h);
    settings.highest_order = order;
    settings.first_step = Some(1e-3 * h);
    let mut simulation = assembled(model);
    go_on(&mut simulation, &[END], &settings, |_| {});
    let steps = simulation.statistics().steps;
    if formulation == Formulation::Si2 {
        assert!(
            (steps.steps as f64) < 1.3 * END / h,
            "steps of {h}: {steps:?}"
        );
    }
    end_of(&simulation)
}

#[test]
fn formulas_converge_with_their_order() {
    let mut exact = assembled(pendulum());
    go_on(
        &mut exact,
        &[END],
        &settings(Formulation::Si2, 1e-13, 0.01),
        |_| {},
    );
    let exact = end_of(&exact);
    let mut claims = Vec::new();
    for (formulation, id) in [(Formulation::Si2, "SI2"), (Formulation::I3, "I3")] {
        for order in 1..=5 {
            // Steps of the same accuracy, roughly.
            let coarse = [5e-4, 2e-3, 4e-3, 8e-3, 1.2e-2][order - 1];
            let runs = [1.0, 0.5, 0.25, 0.125]
                .map(|part| fixed_steps(pendulum(), formulation, order, part * coarse));
            // Order one of I3 does not converge in velocities (Brenan, Campbell & Petzold, 3.2).
            if formulation == Formulation::I3 && order == 1 {
                continue;
            }
            let case = Case {
                section: Section::Integration,
                id: &format!("{id}, order {order}"),
                model: "point pendulum of 1 m to 2 s, fixed steps halved three times",
                source: "order of the backward differentiation formula",
                covers: &[],
            };
            for (n, quantity) in ["position", "velocity", "reaction"].into_iter().enumerate() {
                let errors = runs.map(|run| (run[n] - exact[n]).norm());
                let expected = order as f64;
                let mean = (errors[0] / errors[3]).log2() / 3.0;
                let (ours, tolerance, why) = match (formulation, quantity) {
                    (Formulation::Si2, "position") => (
                        mean.min(expected),
                        0.2,
                        "from below: errors of positions have several parts, whose sum may vanish",
                    ),
                    (Formulation::Si2, _) => (
                        mean,
                        0.25,
                        "observed within 0.06, and 0.37 where rounding begins",
                    ),
                    (_, "position") => (
                        mean.min(expected),
                        1.5,
                        "from below: velocities may cost an order",
                    ),
                    (_, _) => (
                        mean.min(expected),
                        1.15,
                        "from below: velocities of I3 are differences of positions: what Newton's \
                         iteration leaves in those is divided by the step, which may cost an order",
                    ),
                };
                let quantity = format!("mean observed order of the {quantity}");
                claims.push(case.values(&quantity, &[ours], &[expected], tolerance, why));
            }
        }
    }
    check(&claims);
}

#[test]
fn methods_of_second_order_and_formulas_of_adams_converge_with_their_order() {
    let mut exact = assembled(pendulum());
    let tight = settings(Formulation::Si2, 1e-13, 0.01);
    go_on(&mut exact, &[END], &tight, |_| {});
    let exact = end_of(&exact);
    let hht = Formulation::Hht { alpha: -0.3 };
    let newmark = Formulation::Newmark {
        beta: 0.36,
        gamma: 0.7,
    };
    // Newmark's damping, γ above ½, costs an order.
    let mut cases = vec![(hht, 2, 2, 4e-3), (newmark, 2, 1, 4e-3)];
    // Between these orders the first steps, of lower order, leave errors as large as the others.
    for (order, h) in [(2, 4e-3), (8, 3e-2)] {
        cases.push((Formulation::Adams, order, order, h));
    }
    let mut claims = Vec::new();
    for (formulation, highest, order, coarse) in cases {
        let runs = [1.0, 0.5, 0.25].map(|part| {
            let mut settings = settings(formulation, 1e-2, part * coarse);
            // Just permits the step, so that Newton's iteration leaves as much less.
            settings.error = 10.0 * (12.0 * part * coarse).powi(highest as i32 + 1);
            settings.highest_order = highest;
            settings.first_step = Some(1e-3 * part * coarse);
            let mut simulation = assembled(pendulum());
            go_on(&mut simulation, &[END], &settings, |_| {});
            end_of(&simulation)
        });
        for (n, quantity) in ["position", "velocity", "reaction"].into_iter().enumerate() {
            let errors = runs.map(|run| (run[n] - exact[n]).norm());
            let mean = (errors[0] / errors[2]).log2() / 2.0;
            let case = Case {
                section: Section::Integration,
                id: &format!("{formulation:?}, order {highest}"),
                model: "point pendulum of 1 m to 2 s, steps halved twice",
                source: "order of the method",
                covers: &[],
            };
            let quantity = format!("mean observed order of the {quantity}");
            let why = "from below: the first steps are small, and errors have several parts";
            let ours = mean.min(order as f64);
            claims.push(case.values(&quantity, &[ours], &[order as f64], 0.35, why));
        }
    }
    check(&claims);
}

#[test]
fn hht_is_of_second_order_for_bodies_that_turn_in_space() {
    // The inertia of a tilted body along ground axes changes as it turns.
    let model = ball_pendulum(std::f64::consts::FRAC_PI_3, v(0.5, 2.0, 8.0), None);
    let place = |formulation, error, longest_step| {
        let mut simulation = assembled(model.clone());
        let settings = settings(formulation, error, longest_step);
        go_on(&mut simulation, &[1.0], &settings, |_| {});
        simulation.state().centre(0)
    };
    let exact = place(Formulation::Si2, 1e-11, 0.01);
    let hht = Formulation::Hht { alpha: -0.3 };
    // An error that just does not limit the step, so that Newton's iteration leaves less.
    let errors = [2e-3, 1e-3].map(|h| (place(hht, 25.0 * h * h, h) - exact).norm());
    let order = (errors[0] / errors[1]).log2();
    println!("HHT in space: errors {errors:?}, order {order:.3}");
    assert!((order - 2.0).abs() < 0.2, "{order}");
}

#[test]
fn hht_is_of_second_order_for_bristles() {
    // Its bristles relax in g/(s0 v) = 40 ms or more, so that the steps resolve them.
    let sleeve = mechanisms::Sleeve {
        weight: 2.0 * 9.80665,
        inertia: 0.0016,
        pin_radius: 0.04,
        start: [0.1, 2.0],
    };
    let model = sleeve.model(friction::LuGre {
        bristle_stiffness: 1e3,
        damping: 1.0,
        stribeck_velocity: 0.1,
        ..mechanisms::bristles(0.25, 0.2)
    });
    let place = |formulation, error, longest_step| {
        let mut simulation = assembled(model.clone());
        let settings = settings(formulation, error, longest_step);
        go_on(&mut simulation, &[0.2], &settings, |_| {});
        simulation.state().centre(0)
    };
    let exact = place(Formulation::Si2, 1e-11, 0.01);
    let hht = Formulation::Hht { alpha: -0.3 };
    // An error that just does not limit the step, so that Newton's iteration leaves less.
    let errors = [1e-3, 5e-4].map(|h| (place(hht, 300.0 * h * h, h) - exact).norm());
    let order = (errors[0] / errors[1]).log2();
    println!("HHT with bristles: errors {errors:?}, order {order:.3}");
    assert!((order - 2.0).abs() < 0.25, "{order}");
}
