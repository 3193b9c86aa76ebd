//! The original law itself in motions with one freedom (A12; 9.4, 9.6, 9.15).

use friction::parameters::JointType;
use mechanics::Formulation;
use mechanics::model::{Level, MotionFreedom};
use verification::{Case, Section, check};

use super::original;
use crate::runs::{Sample, every, run, settings, turning_points};
use crate::shared::{number, numbers, reference};
use mechanisms::builder::v;
use mechanisms::law;
use mechanisms::sliding::{Block, place, speed};

fn error(tolerance: f64) -> mechanics::Settings {
    settings(Formulation::Si2, tolerance, 0.05)
}

const SMOOTH: &str = "the law itself, integrated to 1e-9";

/// A12a: launched up the slope; the smooth law's own end.
#[test]
fn launch_with_the_law_itself() {
    let Some(file) = reference("validation/data/A12_original_law.json") else {
        return;
    };
    let table = "/cases/a_incline_launch/table_vs_dmax_xend_err_vend";
    let at = |level: usize, column: usize| number(&file, &format!("{table}/{level}/{column}"));
    let (mut ours, mut exact) = (Vec::new(), Vec::new());
    for level in 0..5 {
        let mut block = Block::new(law(0.6, 0.5, at(level, 0), at(level, 1)));
        block.velocity = -3.0;
        let end = run(block.model(), &[2.0], &error(1e-10), |_| {});
        ours.push(place(&end.snapshot()));
        exact.push(at(level, 2));
    }
    let case = Case {
        section: Section::Law,
        id: "A12a",
        model: "2 kg launched up 30° at 3 m/s, μs 0.6, μd 0.5; Vs from 20 mm/s, halved four times",
        source: SMOOTH,
        covers: &original(
            JointType::Translational,
            &["TRANSITION_VELOCITY_COEFFICIENT", "EFFECT"],
        ),
    };
    let why =
        "how the displacement within the step that enters the stick regime counts as creep is ours";
    check(&[case.values("x(2) [m]", &ours, &exact, 1e-6, why)]);
}

/// A12b: from rest with the default Vs and Dm: the creep reaches its limit and drags.
#[test]
fn creep_that_reaches_its_limit() {
    let Some(file) = reference("validation/data/A12_original_law.json") else {
        return;
    };
    let block = Block::new(law(0.6, 0.5, 0.1, 0.01));
    let mut highest = 0.0_f64;
    let end = run(block.model(), &every(5.0, 50), &error(1e-9), |s| {
        highest = highest.max(place(s));
    });
    let exact = |key: &str| number(&file, &format!("/cases/b_incline_rest_clamp/{key}"));
    let block = Block::new(law(0.6, 0.5, 0.1, 0.001));
    let long = run(block.model(), &[60.0], &error(1e-10), |_| {});
    let creep = long.snapshot().friction(0).creep.translation.z / 0.001;
    let ratio = number(&file, "/cases/a_incline_launch/equilibrium_creep_over_dmax");
    let case = Case {
        section: Section::Law,
        id: "A12b",
        model: "2 kg from rest on 30°, μs 0.6, μd 0.5, Vs 0.1, Dm 0.01 (0.001 for the equilibrium)",
        source: SMOOTH,
        covers: &original(JointType::Translational, &["EFFECT"]),
    };
    let dragged = "the creep is limited after each step, by up to a step's displacement";
    check(&[
        case.values(
            "x(5) and largest x [m]",
            &[place(&end.snapshot()), highest],
            &[exact("x_end"), exact("max_x")],
            1e-5,
            dragged,
        ),
        case.values(
            "creep at rest, of Dm",
            &[creep],
            &[ratio],
            1e-7,
            "the error of the integrator, 1e-10 m of 1e-3 m",
        ),
    ]);
}

/// 10°, `μ_s` 0.3, default Vs and Dm, g = 9.81 m/s².
fn gentle_slope() -> Block {
    let mut block = Block::new(law(0.3, 0.2, 0.1, 0.01));
    (block.gravity, block.slope) = (9.81, 10.0);
    block
}

/// A12b2 and 9.4: a block put down on a slope; held for 10⁴ s.
#[test]
fn block_held_on_a_slope() {
    let covers = original(JointType::Translational, &["EFFECT"]);
    let case = Case {
        section: Section::Law,
        id: "9.4",
        model: "a block from rest on 10°, μs 0.3, Vs 0.1, Dm 0.01",
        source: "the law itself, and its equilibrium μs ψ(d/Dm) = tan α",
        covers: &covers,
    };
    let long = settings(Formulation::Si2, 1e-9, 100.0);
    let mut held = Vec::new();
    run(
        gentle_slope().model(),
        &[100.0, 1000.0, 10_000.0],
        &long,
        |s| held.push(place(s)),
    );
    let mut claims = vec![case.values(
        "x(100), x(1000), x(10000) [m]",
        &held,
        &[3.384_218_7e-3; 3],
        1e-9,
        "held without drift; the approach is over by 100 s",
    )];
    let mut creep = Vec::new();
    let exact = [
        1.581_527_9e-3,
        3.384_218_7e-3,
        6.119_933_7e-3,
        8.203_029_8e-3,
    ];
    for slope in [5.0, 10.0, 15.0, 16.5] {
        let mut block = gentle_slope();
        block.slope = slope;
        let end = run(block.model(), &[100.0], &long, |_| {});
        creep.push(end.snapshot().friction(0).creep.translation.z);
    }
    claims.push(case.values(
        "creep at 5, 10, 15, 16.5° [m]",
        &creep,
        &exact,
        1e-9,
        "eight digits are given",
    ));
    if let Some(file) = reference("validation/data/A12_original_law.json") {
        let times = numbers(&file, "/cases/b2_incline10deg/t");
        let exact = numbers(&file, "/cases/b2_incline10deg/x");
        let mut ours = Vec::new();
        run(gentle_slope().model(), &times, &error(1e-10), |s| {
            ours.push(place(s));
        });
        claims.push(case.values("x(0.1 .. 3) [m]", &ours, &exact, 2e-9, SMOOTH));
    }
    check(&claims);
}

/// 9.6: a slider that stops and swings back on its creep.
#[test]
fn slider_that_stops() {
    let mut block = Block::new(law(0.3, 0.2, 0.1, 0.01));
    (block.gravity, block.slope, block.velocity, block.mass) = (9.81, 0.0, 2.0, 1.0);
    let entry = 0.963_780_557;
    let mut times = vec![0.942_915_392, entry];
    times.extend((1..=1000).map(|k| entry + 5e-4 * f64::from(k)));
    let mut seen = Vec::new();
    run(block.model(), &times, &error(1e-10), |s| {
        seen.push((place(s), speed(s), s.friction(0).creep.translation.z));
    });
    let creep: Vec<f64> = seen[2..].iter().map(|s| s.2).collect();
    let samples: Vec<Sample> = seen[2..]
        .iter()
        .zip(&times[2..])
        .map(|(&(_, rate, value), &time)| Sample { time, value, rate })
        .collect();
    let case = Case {
        section: Section::Law,
        id: "9.6",
        model: "a slider at 2 m/s, μs 0.3, μd 0.2, Vs 0.1, Dm 0.01: stops and swings back on its creep",
        source: "specification 9.6, the law itself",
        covers: &original(
            JointType::Translational,
            &["TRANSITION_VELOCITY_COEFFICIENT", "EFFECT"],
        ),
    };
    let digits = "nine digits are given";
    check(&[
        case.values(
            "x, v at 1.5 Vs [m, m/s]",
            &[seen[0].0, seen[0].1],
            &[1.013_634_047, 0.15],
            1e-8,
            digits,
        ),
        case.values(
            "x, v at Vs [m, m/s]",
            &[seen[1].0, seen[1].1],
            &[1.016_287_394, 0.1],
            1e-8,
            digits,
        ),
        case.values(
            "creep 0.1 s and 0.5 s later [m]",
            &[creep[199], creep[999]],
            &[1.425_18e-3, 1.376_4e-5],
            1e-8,
            "six digits are given",
        ),
        case.values(
            "largest creep [m]",
            &[turning_points(&samples)[0].1],
            &[1.950_86e-3],
            1e-8,
            "six digits are given",
        ),
    ]);
}

/// 9.15: driven at 0.2 Vs under a load of 100 N; no freedom is left.
#[test]
fn slow_drive() {
    let mut block = Block::new(law(0.3, 0.2, 0.1, 0.01));
    (block.gravity, block.slope, block.mass) = (10.0, 0.0, 10.0);
    let mut b = block.builder();
    b.model.bodies[0].velocity = v(0.02, 0.0, 0.0);
    b.drive(0, MotionFreedom::Along(2), Level::Position, 0.02);
    let table = [
        (0.002_5, 19.516_575),
        (0.005, 26.056_8),
        (0.010_1, 30.0),
        (0.02, 30.0),
    ];
    let mut ours = vec![
        -crate::runs::assembled(b.model.clone())
            .snapshot()
            .friction(0)
            .force
            .z,
    ];
    run(b.model, &table.map(|(x, _)| x / 0.02), &error(1e-8), |s| {
        ours.push(-s.friction(0).force.z);
    });
    let mut exact = vec![10.953_6];
    exact.extend(table.map(|(_, friction)| friction));
    let case = Case {
        section: Section::Law,
        id: "9.15",
        model: "driven at 0.02 m/s under 100 N, μs 0.3, Vs 0.1, Dm 0.01; at 0, 2.5, 5, 10.1, 20 mm",
        source: "specification 9.15, closed form",
        covers: &original(JointType::Translational, &["EFFECT"]),
    };
    check(&[case.values(
        "friction [N]",
        &ours,
        &exact,
        1e-4,
        "four decimals are given",
    )]);
}
