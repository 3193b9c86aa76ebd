//! The law itself in motions with one freedom (A12, 9.4, 9.6, 9.15).

use mechanics::Formulation;
use mechanics::model::{Level, MotionFreedom};

use super::{Row, Rule};
use crate::builder::v;
use crate::runs::{every, run, settings};
use crate::shared::{number, numbers, reference};
use crate::systems::law;
use crate::systems::sliding::{Block, place, speed};

fn error(tolerance: f64) -> mechanics::Settings {
    settings(Formulation::Si2, tolerance, 0.05)
}

fn reference_rows() -> Vec<Row> {
    let Some(file) = reference("validation/data/A12_original_law.json") else {
        return Vec::new();
    };
    let mut rows = Vec::new();
    // A12a: launched up the slope; the smooth law's own end, converged to 1e-9.
    let mut worst = 0.0_f64;
    for level in 0..5 {
        let at = |column: usize| {
            let table = "/cases/a_incline_launch/table_vs_dmax_xend_err_vend";
            number(&file, &format!("{table}/{level}/{column}"))
        };
        let mut block = Block::new(law(0.6, 0.5, at(0), at(1)));
        block.velocity = -3.0;
        let end = run(block.model(), &[2.0], &error(1e-10), |_| {});
        worst = worst.max((place(&end.snapshot()) - at(2)).abs());
    }
    // How the displacement within the step that enters the stick regime counts as creep is ours.
    rows.push(Row::new(
        "A12a launch, five Vs and Dm",
        "x(2)",
        vec![worst],
        Rule::Below(1e-6),
    ));
    // A12b: from rest with the default Vs and Dm: the creep reaches its limit and drags.
    let block = Block::new(law(0.6, 0.5, 0.1, 0.01));
    let mut highest = 0.0_f64;
    let end = run(block.model(), &every(5.0, 50), &error(1e-9), |s| {
        highest = highest.max(place(s));
    });
    let case = "/cases/b_incline_rest_clamp";
    let off = (place(&end.snapshot()) - number(&file, &format!("{case}/x_end"))).abs();
    rows.push(Row::new(
        "A12b from rest, creep limited",
        "x(5)",
        vec![off],
        Rule::Below(1e-5),
    ));
    let off = (highest - number(&file, &format!("{case}/max_x"))).abs();
    rows.push(Row::new(
        "A12b from rest, creep limited",
        "largest x",
        vec![off],
        Rule::Below(1e-5),
    ));
    // Equilibrium creep, long after.
    let block = Block::new(law(0.6, 0.5, 0.1, 0.001));
    let end = run(block.model(), &[60.0], &error(1e-10), |_| {});
    let ratio = number(&file, "/cases/a_incline_launch/equilibrium_creep_over_dmax");
    let off = (end.snapshot().friction(0).creep[0] / 0.001 - ratio).abs();
    rows.push(Row::new(
        "A12b equilibrium",
        "creep / Dm",
        vec![off],
        Rule::Below(1e-7),
    ));
    // A12b2, 9.4: 10 degrees.
    let times = numbers(&file, "/cases/b2_incline10deg/t");
    let exact = numbers(&file, "/cases/b2_incline10deg/x");
    let mut worst = 0.0_f64;
    let mut next = exact.iter();
    run(gentle_slope().model(), &times, &error(1e-10), |s| {
        worst = worst.max((place(s) - next.next().expect("as many as times")).abs());
    });
    rows.push(Row::new(
        "A12b 10 deg",
        "x(0.1 .. 3)",
        vec![worst],
        Rule::Below(2e-9),
    ));
    rows
}

/// 10°, `μ_s` 0.3, default Vs and Dm, g = 9.81 m/s².
fn gentle_slope() -> Block {
    let mut block = Block::new(law(0.3, 0.2, 0.1, 0.01));
    (block.gravity, block.slope) = (9.81, 10.0);
    block
}

/// 9.4: held for 10⁴ s. The approach is `exp(−t Vs/Dm · …)`, over long before 100 s.
fn hold_row() -> Row {
    let mut at = Vec::new();
    let long = settings(Formulation::Si2, 1e-9, 100.0);
    run(
        gentle_slope().model(),
        &[100.0, 1000.0, 10_000.0],
        &long,
        |s| at.push(place(s)),
    );
    let drift = at.iter().map(|x| (x - 3.384_218_7e-3).abs()).collect();
    Row::new(
        "9.4 hold at 100, 1000, 10000 s",
        "x",
        drift,
        Rule::Below(1e-9),
    )
}

/// 9.6: a slider that stops and swings back on its creep.
fn stopping_rows() -> Vec<Row> {
    let mut block = Block::new(law(0.3, 0.2, 0.1, 0.01));
    (block.gravity, block.slope, block.velocity, block.mass) = (9.81, 0.0, 2.0, 1.0);
    let entry = 0.963_780_557;
    let times = [0.942_915_392, entry, entry + 0.1, entry + 0.5];
    let mut seen = Vec::new();
    run(block.model(), &times, &error(1e-10), |s| {
        seen.push((place(s), speed(s), s.friction(0).creep[0]));
    });
    let rows = [
        (
            "x, v at 1.5 Vs",
            vec![seen[0].0 - 1.013_634_047, seen[0].1 - 0.15],
            1e-8,
        ),
        (
            "x, v at Vs",
            vec![seen[1].0 - 1.016_287_394, seen[1].1 - 0.1],
            1e-8,
        ),
        (
            "creep 0.1, 0.5 s on",
            vec![seen[2].2 - 1.425_18e-3, seen[3].2 - 1.376_4e-5],
            1e-8,
        ),
    ];
    rows.into_iter()
        .map(|(quantity, errors, bound)| {
            let errors = errors.into_iter().map(f64::abs).collect();
            Row::new("9.6 stopping slider", quantity, errors, Rule::Below(bound))
        })
        .collect()
}

/// 9.15: driven at 0.2 Vs under a load of 100 N; no freedom is left.
fn slow_drive_row() -> Row {
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
    let times: Vec<f64> = table.iter().map(|(x, _)| x / 0.02).collect();
    let mut errors = Vec::new();
    run(b.model, &times, &error(1e-8), |s| {
        let exact = table[errors.len()].1;
        errors.push((s.friction(0).force[0] + exact).abs());
    });
    // Four decimals are given.
    Row::new("9.15 slow drive", "friction", errors, Rule::Below(1e-4))
}

pub(crate) fn rows() -> Vec<Row> {
    let mut rows = reference_rows();
    rows.push(hold_row());
    rows.extend(stopping_rows());
    rows.push(slow_drive_row());
    rows
}
