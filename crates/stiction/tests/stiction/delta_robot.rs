//! A delta robot with twelve frictions, against a real Adams run and our own converged reference.
//!
//! What to expect is established independently of this project: an exact solution of the plain
//! replay differs from the real results by up to 3.6 mm, because Adams took one step per interval
//! and kept its history across the jumps of the inputs. So the replay is compared with the
//! converged reference, and the run with ramped inputs with the real results.

use crate::shared::complete;
use crate::table::{Table, distance, median, norm};

const FOLDER: &str = "adams-results/delta-robot-friction";
const POSITION: [&str; 3] = ["X", "Y", "Z"];
const VELOCITY: [&str; 3] = ["VX", "VY", "VZ"];

/// Largest differences of the positions of the parts' frames, and of their velocities relative to
/// the peak velocity; `shift` rows of the reference come before the first of ours.
fn differences(
    ours: &Table,
    theirs: &Table,
    name: impl Fn(u32) -> String,
    shift: usize,
) -> [f64; 2] {
    assert_eq!(ours.rows.len() + shift, theirs.rows.len());
    let (mut position, mut velocity, mut peak) = (0.0_f64, 0.0_f64, 0.0_f64);
    for part in 2..=11 {
        for row in 0..ours.rows.len() {
            let (our, their) = (format!("Part/{part}."), name(part));
            let pair = |endings| {
                (
                    ours.vector(row, &our, endings),
                    theirs.vector(row + shift, &their, endings),
                )
            };
            let (a, b) = pair(POSITION);
            position = position.max(distance(a, b));
            let (a, b) = pair(VELOCITY);
            velocity = velocity.max(distance(a, b));
            peak = peak.max(norm(b));
        }
    }
    [position, velocity / peak]
}

#[test]
fn replay_converges_to_the_reference() {
    let Some(table) = reference_data::path(&format!("{FOLDER}/delta_robot_reference.csv")) else {
        return;
    };
    let table = Table::from_csv(&std::fs::read_to_string(table).unwrap());
    let Some(commands) = reference_data::path(&format!("{FOLDER}/delta_robot_replay.acf")) else {
        return;
    };
    let project = stiction::Project::load(&commands).unwrap();
    let mut last = f64::INFINITY;
    for error in [1e-4, 1e-6, 1e-9] {
        let ours = Table::from_results(&complete(&project, Some(error)));
        let [position, velocity] = differences(&ours, &table, |part| format!("P{part}_"), 1);
        println!(
            "replay, error {error:e}: positions {position:.2e} m, velocities {velocity:.2e} of peak"
        );
        assert!(position < last);
        last = position;
        if error == 1e-6 {
            assert!(position < 1e-5 && velocity < 1e-4);
        }
    }
    // The reference agrees with a run of its own at another tolerance to 7e-11 m.
    assert!(last < 1e-7);
}

#[test]
fn ramped_inputs_give_the_real_results() {
    let Some(commands) = reference_data::path(&format!("{FOLDER}/delta_robot_ramp.acf")) else {
        return;
    };
    let Some(real) = reference_data::path(&format!("{FOLDER}/delta_robot.res")) else {
        return;
    };
    let project = stiction::Project::load(&commands).unwrap();
    let real = Table::from_results(&results::ResFile::read(real).unwrap());
    let ours = Table::from_results(&complete(&project, Some(1e-7)));
    let [position, velocity] = differences(&ours, &real, |part| format!("Part/{part}."), 0);
    // Adams' own discretisation error in the ramped run is up to 2.4e-4 m and 0.6 % of the peak.
    println!("ramp against real results: {position:.2e} m, {velocity:.2e} of peak velocity");
    assert!(position < 3e-4 && velocity < 1e-2);
    let mut worst = 0.0_f64;
    for friction in 1..=12 {
        let name = format!("Friction/{friction}.");
        let differences = (0..ours.rows.len()).map(|row| {
            let endings = ["MURX", "MURY", "MURZ"];
            let (a, b) = (
                ours.vector(row, &name, endings),
                real.vector(row, &name, endings),
            );
            distance(a, b) / norm(b)
        });
        worst = worst.max(median(differences.collect()));
    }
    println!("friction vectors: median difference of the worst joint {worst:.2e}");
    assert!(worst < 2e-3);
}
