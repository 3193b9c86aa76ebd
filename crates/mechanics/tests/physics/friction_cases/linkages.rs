//! Friction in loops: slider-crank (C01a) and four-bar (C02a).

use friction::parameters::JointType;
use mechanics::Formulation;
use mechanics::model::Model;
use serde_json::Value;
use verification::{Case, Claim, Rule, Section, check};

use super::{HALVINGS, TURNS, original};
use crate::runs::{Sample, every, run, settings, turning_points};
use crate::shared::{number, reference};
use crate::systems::{four_bar, law, slider_crank};

/// Turning points of the crank (body 0) that starts at `start`, and its last angle.
fn crank(model: Model, start: f64, end: f64) -> (Vec<(f64, f64)>, f64) {
    let mut samples = Vec::new();
    let mut angle = start;
    let mut last = 0.0;
    let outputs = every(end, (end * 2000.0) as usize);
    run(
        model,
        &outputs,
        &settings(Formulation::Si2, 1e-10, 0.01),
        |s| {
            let m = s.rotation(0);
            let now: f64 = m[(1, 0)].atan2(m[(0, 0)]);
            let step = now - last;
            angle += step - std::f64::consts::TAU * (step / std::f64::consts::TAU).round();
            last = now;
            let rate = s.state().velocities()[5];
            samples.push(Sample {
                time: s.time(),
                value: angle,
                rate,
            });
        },
    );
    (turning_points(&samples), angle)
}

/// Turns and the angle at rest; `slow` is the largest Vs for each.
fn study(
    case: &Case<'_>,
    exact: &Value,
    end: f64,
    turns: usize,
    slow: [f64; 2],
    model: impl Fn(f64) -> Model,
) -> Vec<Claim> {
    let start = number(exact, "/params/theta0");
    let last = exact["turning"].as_array().expect("a list").len() - 1;
    let at = |n: usize, key: &str| number(exact, &format!("/turning/{n}/{key}"));
    let after = at(turns - 1, "t") + 0.05;
    let runs = HALVINGS.map(|h| crank(model(slow[0] * h), start, after).0);
    let rest = HALVINGS.map(|h| crank(model(slow[1] * h), start, end).1);
    let rule = Rule::AtLeastOrder(1.0);
    let mut claims = Vec::new();
    for n in 0..turns {
        let angles = runs.each_ref().map(|t| t[n].1);
        let times = runs.each_ref().map(|t| t[n].0);
        let quantity = format!("angle of turn {} [rad]", n + 1);
        claims.push(case.limit(&quantity, &angles, at(n, "theta"), rule, TURNS));
        let quantity = format!("time of turn {} [s]", n + 1);
        claims.push(case.limit(&quantity, &times, at(n, "t"), rule, TURNS));
    }
    let quantity = format!("angle at rest, Vs from {} mm/s [rad]", 1e3 * slow[1]);
    claims.push(case.limit(&quantity, &rest, at(last, "theta"), rule, TURNS));
    claims
}

const SOURCE: &str = "exact stick and slip with every event located, Runge–Kutta 1e-12";

#[test]
fn slider_crank_with_friction_in_its_guide() {
    let Some(file) = reference("validation/data/C01_C02_mechanisms.json") else {
        return;
    };
    let case = Case {
        section: Section::Mechanism,
        id: "C01a",
        model: "crank 0.1 m, rod 0.3 m, slider; 1, 1.5, 2 kg; μs 0.25, μd 0.2 in the guide, from 20 rad/s; Vs from 80 mm/s",
        source: SOURCE,
        covers: &original(JointType::Translational, &["INPUTS"]),
    };
    let exact = &file["cases"]["C01a_slider_only"];
    check(&study(&case, exact, 2.2, 2, [8e-2, 4e-2], |vs| {
        slider_crank(Some(law(0.25, 0.2, vs, 1e-2 * vs)))
    }));
}

#[test]
fn four_bar_with_friction_in_its_pins() {
    let Some(file) = reference("validation/data/C01_C02_mechanisms.json") else {
        return;
    };
    let case = Case {
        section: Section::Mechanism,
        id: "C02a",
        model: "four-bar 0.1, 0.35, 0.3, 0.4 m; 1, 3.5, 3 kg; four pins of 15 mm, μs 0.25, μd 0.2, from 20 rad/s; Vs from 8 mm/s",
        source: SOURCE,
        covers: &original(JointType::Revolute, &["PIN_RADIUS", "INPUTS"]),
    };
    let exact = &file["cases"]["C02a_fourbar_pins"];
    check(&study(&case, exact, 3.2, 4, [8e-3, 1e-3], |vs| {
        four_bar(Some(law(0.25, 0.2, vs, 1e-2 * vs)))
    }));
}
