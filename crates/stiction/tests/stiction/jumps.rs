//! Functions that jump: the integration goes through them.

use stiction::{Outcome, Project, RunOptions};

use crate::shared::{run_text, run_with_log, scratch_folder};

/// A double pendulum whose first joint is at rest and then, at once, turns at 30 degrees a second.
fn dataset(integrator: &str) -> String {
    format!(
        "A motion that starts at once
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=METER, TIME=SECOND
ACCGRAV/JGRAV=-9.80665
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=21, IP=0.1, 0.1, 0.1
MARKER/20, PART=2
MARKER/21, PART=2, QP=0.3, 0, 0
JOINT/1, REVOLUTE, I=20, J=1
MOTION/1, JOINT=1, ROTATIONAL, FUNCTION=IF(TIME-0.45: 0, 0, 30D*(TIME-0.45))
PART/3, MASS=1, CM=31, IP=0.1, 0.1, 0.1, QG=0.3, 0, 0
MARKER/30, PART=3
MARKER/31, PART=3, QP=0.1, 0, 0
MARKER/22, PART=2, QP=0.3, 0, 0
JOINT/2, REVOLUTE, I=30, J=22
REQUEST/1, F2=AZ(20, 1)\\F3=WZ(20, 1)\\F4=AZ(30, 22)
{integrator}
END
"
    )
}

#[test]
fn a_jump_of_velocity_is_passed_by_both_formulations() {
    let runs = [
        "INTEGRATOR/GSTIFF, I3, ERROR=1e-6",
        "INTEGRATOR/GSTIFF, SI2, ERROR=1e-6, HMAX=0.05",
    ]
    .map(|integrator| {
        // Outputs closer than the steps, so that many are interpolated.
        let results = run_text(&dataset(integrator), 1.0, 2000, None);
        ["F2", "F3", "F4"].map(|column| results.get(&format!("REQUEST_1.{column}")).unwrap())
    });
    let rad = std::f64::consts::PI / 6.0;
    for [angle, rate, _] in &runs {
        // Prescribed: met to the accuracy of the constraints.
        let last = angle.len() - 1;
        assert!((angle[last] - 0.55 * rad).abs() < 1e-9 && (rate[last] - rad).abs() < 1e-9);
    }
    let [[_, _, swing], [_, _, other]] = &runs;
    let pairs = swing.iter().zip(other);
    let worst = pairs.fold(0.0_f64, |m, (a, b)| m.max((a - b).abs()));
    println!("jump of velocity: the free pendulum differs by {worst:.1e} rad between I3 and SI2");
    // It gets the same push in both, but for the error of the steps.
    assert!(worst < 1e-4);
}

#[test]
fn a_jump_of_place_is_refused_by_name() {
    let jump = dataset("INTEGRATOR/GSTIFF, SI2").replace("30D*(TIME-0.45)", "30D");
    let folder = scratch_folder();
    let file = folder.join("model.adm");
    std::fs::write(&file, jump).unwrap();
    let mut project = Project::load(&file).unwrap_or_else(|error| panic!("{error}"));
    project.push_dynamic(1.0, Some(10), None);
    let (report, _, log) = run_with_log(&project, RunOptions::default());
    std::fs::remove_dir_all(folder).unwrap();
    assert!(matches!(report.outcome, Outcome::IntegrationFailed(_)));
    assert!(
        log.contains("at time 0.45") && log.contains("the function of MOTION/1 jumps"),
        "{log}"
    );
}
