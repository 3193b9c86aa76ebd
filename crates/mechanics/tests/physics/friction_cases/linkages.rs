//! Friction in loops: slider-crank (C01a) and four-bar (C02a).

use mechanics::Formulation;
use mechanics::model::Model;
use serde_json::Value;

use super::{HALVINGS, Row, Rule};
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
    name: &str,
    case: &Value,
    end: f64,
    turns: usize,
    slow: [f64; 2],
    model: impl Fn(f64) -> Model,
) -> Vec<Row> {
    let start = number(case, "/params/theta0");
    let last = case["turning"].as_array().expect("a list").len() - 1;
    let exact = |n: usize, key: &str| number(case, &format!("/turning/{n}/{key}"));
    let after = exact(turns - 1, "t") + 0.05;
    let runs = HALVINGS.map(|h| crank(model(slow[0] * h), start, after).0);
    let rest = HALVINGS.map(|h| crank(model(slow[1] * h), start, end).1);
    let mut rows = Vec::new();
    for n in 0..turns {
        let angle = ["turn 1", "turn 2", "turn 3", "turn 4"][n];
        let time = [
            "time of turn 1",
            "time of turn 2",
            "time of turn 3",
            "time of turn 4",
        ][n];
        let of = |value: fn(&(f64, f64)) -> f64, key: &str| -> Vec<f64> {
            runs.iter()
                .map(|t| (value(&t[n]) - exact(n, key)).abs())
                .collect()
        };
        rows.push(Row::new(
            name,
            angle,
            of(|t| t.1, "theta"),
            Rule::AtLeastFirst,
        ));
        rows.push(Row::new(name, time, of(|t| t.0, "t"), Rule::AtLeastFirst));
    }
    let errors = rest
        .iter()
        .map(|angle| (angle - exact(last, "theta")).abs())
        .collect();
    rows.push(Row::new(name, "angle at rest", errors, Rule::AtLeastFirst));
    rows
}

pub(crate) fn rows() -> Vec<Row> {
    let Some(file) = reference("validation/data/C01_C02_mechanisms.json") else {
        return Vec::new();
    };
    let cases = &file["cases"];
    let law = |vs: f64| law(0.25, 0.2, vs, 1e-2 * vs);
    let case = &cases["C01a_slider_only"];
    let mut rows = study("C01a slider-crank", case, 2.2, 2, [8e-2, 4e-2], |vs| {
        slider_crank(Some(law(vs)))
    });
    let case = &cases["C02a_fourbar_pins"];
    let name = "C02a four-bar, four pins";
    rows.extend(study(name, case, 3.2, 4, [8e-3, 1e-3], |vs| {
        four_bar(Some(law(vs)))
    }));
    rows
}
