//! The examples that ship with the project do what their descriptions say.

use std::path::Path;

use results::ResFile;
use stiction::{Outcome, Project, RunOptions, RunReport};

use crate::shared::run;

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
