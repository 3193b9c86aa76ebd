//! The examples that ship with the project do what their descriptions say.

use std::path::Path;

use results::ResFile;
use stiction::{Outcome, Project, RunOptions, RunReport};

use verification::{Case, Section, check};

use crate::shared::run;
use crate::table::norm;

fn example(file: &str) -> (RunReport, ResFile) {
    let folder = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples");
    let project = Project::load(&folder.join(file)).unwrap_or_else(|error| panic!("{error}"));
    let (report, results) = run(&project, RunOptions::default());
    assert_eq!(report.outcome, Outcome::Completed);
    (report, results)
}

#[test]
fn the_incline_sticks_then_slips() {
    let (report, results) = example("incline/incline.acf");
    let get = |name: &str| results.get(name).unwrap();
    let (time, creep) = (get("time.TIME"), get("BLOCK_FRICTION.CREEP_Z"));
    let (force, mu1) = (get("BLOCK_FRICTION.FZ"), get("BLOCK_FRICTION.MU1"));
    let normal = 2.0 * 9.81 * 10.0_f64.to_radians().cos();
    let weight = 2.0 * 9.81 * 10.0_f64.to_radians().sin();
    for k in 1..time.len() {
        assert!(
            creep[k] <= 1e-4 * (1.0 + 1e-12),
            "limited to MAX_STICTION_DEFORMATION"
        );
        if (0.5..2.0).contains(&time[k]) {
            // At rest friction carries the weight; the coefficient of the creep is what it takes.
            assert!(
                (force[k] + weight).abs() < 1e-4 * weight,
                "{} {}",
                time[k],
                force[k]
            );
            assert!((mu1[k] - weight / normal).abs() < 1e-4);
        }
        if time[k] > 3.5 {
            assert!((force[k] + 0.2 * normal).abs() < 1e-6 * normal);
            assert_eq!((creep[k], mu1[k]), (0.0, 0.0));
        }
    }
    let peak = &report.frictions[0];
    assert!(
        (peak.peak - 0.3 * normal).abs() < 2e-3 * normal,
        "{}",
        peak.peak
    );
    assert!((3.0..3.3).contains(&peak.peak_time));
}

#[test]
fn the_pendulum_swings_less_each_time_and_sticks() {
    let (_, results) = example("pendulum/pendulum.acf");
    let angle = results.get("ANGLE.Q").unwrap();
    // The first step is the model as given, all zeros.
    let turns: Vec<f64> = (2..angle.len() - 1)
        .filter(|&k| (angle[k] - angle[k - 1]) * (angle[k + 1] - angle[k]) < 0.0)
        .map(|k| angle[k].abs())
        .filter(|peak| *peak > 2.0)
        .collect();
    assert!(turns.len() > 5);
    for pair in turns.windows(2) {
        // Coulomb friction in the pin takes nearly the same angle each half swing.
        let loss = pair[0] - pair[1];
        assert!((0.3..3.0).contains(&loss), "{pair:?}");
    }
    let speed = results.get("BAR_XFORM.WY").unwrap();
    assert!(speed.last().unwrap().abs() < 1e-4);
}

#[test]
fn the_delta_robot_has_friction_in_twelve_joints() {
    let (report, results) = example("delta-robot/delta.acf");
    assert_eq!(report.frictions.len(), 12);
    assert!(
        report
            .frictions
            .iter()
            .all(|friction| friction.energy > 0.0)
    );
    // The motors bring the platform there and back.
    let place = results.get("PLATFORM_PLACE.Z").unwrap();
    let lowest = place.iter().copied().fold(f64::INFINITY, f64::min);
    assert!(lowest < -0.35, "{lowest}");
    // Held by springs of 150 N m/rad, the arms give way by a few thousandths of a radian.
    assert!((place.last().unwrap() + 0.3).abs() < 0.02);
    // Rods in pairs keep the platform from turning.
    let tilt = results.get("PLATFORM_XFORM.THETA").unwrap();
    assert!(tilt.iter().all(|angle| angle.abs() < 1e-5));
}

#[test]
fn both_pins_of_the_hooke_joint_rub_and_turn_back_twice_a_turn() {
    let (report, results) = example("hooke/hooke.acf");
    let get = |name: &str| results.get(name).unwrap();
    let time = get("time.TIME");
    // A turn from 1.5 s on, after the shaft has its speed.
    let turn: Vec<usize> = (0..time.len())
        .filter(|&k| (1.5..2.5 - 1e-9).contains(&time[k]))
        .collect();
    for (place, (pin, reversals)) in [
        ("I_PIN_FRICTION", [1.5, 2.0, 2.5]),
        ("J_PIN_FRICTION", [1.75, 2.25, 2.75]),
    ]
    .into_iter()
    .enumerate()
    {
        let (torque, velocity) = (["TX", "TY", "TZ"], ["WX", "WY", "WZ"]);
        let vectors = |components: [&str; 3]| components.map(|c| get(&format!("{pin}.{c}")));
        let (torque, velocity) = (vectors(torque), vectors(velocity));
        let (load, regime) = (
            get(&format!("{pin}_DETAIL.LOAD")),
            get(&format!("{pin}_DETAIL.REGIME")),
        );
        let mut sliding = 0;
        for &k in turn.iter().filter(|&&k| regime[k] == 2.0) {
            sliding += 1;
            let row = |v: &[Vec<f64>; 3]| norm([v[0][k], v[1][k], v[2][k]]);
            let along: f64 = (0..3).map(|axis| torque[axis][k] * velocity[axis][k]).sum();
            // A sliding pin has the dynamic coefficient of its load, against its velocity; the
            // coefficient is within rounding of that from 1.5 Vs on.
            assert!((row(&torque) - 0.024 * load[k]).abs() < 1e-9 * load[k]);
            assert!((along + row(&torque) * row(&velocity)).abs() < 1e-9 * along.abs());
        }
        assert!(sliding > 380, "{pin}: {sliding} outputs of 400 slide");
        // Where one pin is in the plane of the shafts the other's angle is largest: a quarter of a
        // turn apart, and the pins turn back there. By symmetry within the time that one sticks.
        let history = history(&results, place);
        let starts: Vec<f64> = history.iter().map(|stick| stick.0).collect();
        for reversal in reversals {
            assert!(
                history
                    .iter()
                    .any(|&(start, end)| start < reversal && reversal < end),
                "{pin} at {reversal}: {starts:?}"
            );
        }
        assert!(report.frictions[place].energy > 10.0);
    }
    // The second shaft turns as a hooke joint of 20 degrees makes it: cos a/(1 - sin² a cos² t)
    // times the first, the angle of whose pin from the plane of the shafts is t.
    let (first, second) = (
        get("FIRST_SHAFT_XFORM.WX"),
        ["WX", "WY"].map(|c| get(&format!("SECOND_SHAFT_XFORM.{c}"))),
    );
    let (sin, cos) = 20.0_f64.to_radians().sin_cos();
    // The steady motion begins at 0.5 s, after a quarter of a turn.
    for &k in &turn {
        let angle = std::f64::consts::TAU * (time[k] - 0.25);
        let along = cos * second[0][k] + sin * second[1][k];
        let expected = first[k] * cos / (1.0 - (sin * angle.cos()).powi(2));
        // The integration of the motion leaves the angle open by its tolerance, 1e-6 a step.
        assert!(
            (along - expected).abs() < 1e-4,
            "{} {along} {expected}",
            time[k]
        );
    }
}

/// Start and end of the sticks of a friction, from our own channels.
fn history(results: &ResFile, place: usize) -> Vec<(f64, f64)> {
    let name = ["I_PIN_FRICTION_DETAIL", "J_PIN_FRICTION_DETAIL"][place];
    let get = |component: &str| results.get(&format!("{name}.{component}")).unwrap();
    let (start, end) = (get("STICK_START"), get("STICK_END"));
    let mut sticks: Vec<(f64, f64)> = start.into_iter().zip(end).filter(|(s, e)| e > s).collect();
    sticks.dedup();
    sticks
}

/// The same slider by an integration of its own: position, velocity and bristles of the block by the
/// classical formula of fourth order in steps of 20 microseconds, positions at the times given.
fn lugre_slider(times: &[f64]) -> Vec<f64> {
    const STEP: f64 = 2e-5;
    let load = 9.81;
    let rate = |time: f64, [x, v, z]: [f64; 3]| {
        let level = load * (0.25 + 0.05 * (-(v / 1e-3).powi(2)).exp());
        let bend = v - 1e4 * v.abs() / level * z;
        [v, 2.0 * (0.1 * time - x) - (1e4 * z + 1e3 * bend), bend]
    };
    let ahead = |y: [f64; 3], slope: [f64; 3], h: f64| std::array::from_fn(|k| y[k] + h * slope[k]);
    let (mut time, mut state, mut places) = (0.0, [0.0; 3], Vec::new());
    for &output in times {
        let steps = ((output - time) / STEP).ceil().max(1.0);
        let h = (output - time) / steps;
        for _ in 0..steps as usize {
            let a = rate(time, state);
            let b = rate(time + 0.5 * h, ahead(state, a, 0.5 * h));
            let c = rate(time + 0.5 * h, ahead(state, b, 0.5 * h));
            let d = rate(time + h, ahead(state, c, h));
            let sum = std::array::from_fn(|k| a[k] + 2.0 * (b[k] + c[k]) + d[k]);
            state = ahead(state, sum, h / 6.0);
            time += h;
        }
        places.push(state[0]);
    }
    places
}

#[test]
fn the_slider_sticks_and_slips_as_its_equations_say() {
    let (report, results) = example("lugre-slider/lugre_slider.acf");
    let expected = lugre_slider(&results.block("dynamic_001").unwrap().times);
    let difference = |results: &ResFile| {
        let block = results.block("dynamic_001").unwrap();
        let places = block.column(results.column("BLOCK_XFORM.Z").unwrap());
        let pairs = places.zip(&expected);
        pairs.fold(0.0_f64, |worst, (ours, exact)| {
            worst.max((ours - exact).abs())
        })
    };
    let file = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../examples/lugre-slider");
    let project = Project::load(&file.join("lugre_slider.acf")).unwrap();
    let (_, finer) = run(
        &project,
        RunOptions {
            error: Some(1e-8),
            ..RunOptions::default()
        },
    );
    let case = Case {
        section: Section::Joint,
        id: "LuGre slider",
        model: "the shipped block of 1 kg, pulled by 2 N/m at 0.1 m/s over seven sticks to 50 s, \
                3.7 m",
        source: "the block's own three equations by the classical formula of fourth order, steps of \
                 20 microseconds",
        covers: &[],
    };
    // Where the bristles let go the block moves slowly away from an instant of rest, which makes
    // errors grow; each of seven slips takes over those of the one before.
    check(&[
        case.worst(
            "place at an error of 1e-6 [m]",
            difference(&results),
            5e-3,
            "a thousandth of the way: each break-away makes errors grow",
        ),
        case.worst(
            "place at an error of 1e-8 [m]",
            difference(&finer),
            2e-4,
            "falls with the error, by about its power of 3/4",
        ),
    ]);
    let friction = &report.frictions[0];
    assert_eq!(friction.tally.sticks, 7);
    // Stick and slip, 5.86 s, are the same each time; the first stick starts without tension.
    let starts: Vec<f64> = {
        let mut starts = results.get("BLOCK_FRICTION_DETAIL.STICK_START").unwrap();
        starts.dedup();
        starts.into_iter().filter(|start| *start > 0.0).collect()
    };
    for pair in starts.windows(2) {
        assert!((pair[1] - pair[0] - 5.8618).abs() < 1e-2, "{pair:?}");
    }
    // What LUGRE does beyond holding is told.
    let remarks = friction.remarks();
    let [(_, _, drift), (_, _, energy)] = remarks.as_slice() else {
        panic!("{remarks:?}");
    };
    assert!(drift.contains("LUGRE has drifted by"), "{drift}");
    assert!(
        energy.contains("DAMPING_COEFFICIENT is above 4 G/v"),
        "{energy}"
    );
}
