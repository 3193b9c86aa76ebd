//! LuGre in a whole mechanism: loads that vanish and change sign, bristles from soft to very stiff.

use results::ResFile;
use stiction::{Outcome, Project, RunOptions};

use crate::shared::{run, run_text, scratch_folder};

/// A slider-crank with bristles in all four joints; the wall presses now from above, now from below.
fn slider_crank(stiffness: f64) -> String {
    let pin = format!(
        "MU_STATIC=0.3, MU_DYNAMIC=0.2, FORMULATION=LUGRE, DAMPING_COEFFICIENT=1\n\
         , BRISTLE_STIFFNESS_COEFFICIENT={stiffness:e}, VELOCITY_THRESHOLD_STRIBECK=1E-3"
    );
    let arms = "PIN_RADIUS=0.01, FRICTION_ARM=0.01, BENDING_REACTION_ARM=0.05";
    format!(
        "A slider-crank on bristles
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
MARKER/2, PART=1, QP=0.4, 0, 0, REULER=90D, 90D, 0D
PART/2, MASS=1, CM=20, IP=0.001, 0.001, 0.001, QG=0.05, 0, 0
MARKER/20, PART=2
MARKER/21, PART=2, QP=-0.05, 0, 0
MARKER/22, PART=2, QP=0.05, 0, 0
PART/3, MASS=1, CM=30, IP=0.0001, 0.01, 0.01, QG=0.25, 0, 0
MARKER/30, PART=3
MARKER/31, PART=3, QP=-0.15, 0, 0
MARKER/32, PART=3, QP=0.15, 0, 0
PART/4, MASS=1, CM=40, IP=0.001, 0.001, 0.001, QG=0.4, 0, 0
MARKER/40, PART=4
MARKER/43, PART=4, REULER=90D, 90D, 0D
JOINT/1, REVOLUTE, I=21, J=1
JOINT/2, REVOLUTE, I=31, J=22
JOINT/3, REVOLUTE, I=40, J=32
JOINT/4, TRANSLATIONAL, I=43, J=2
FRICTION/1, JOINT=1, {arms}, {pin}
FRICTION/2, JOINT=2, {arms}, {pin}
FRICTION/3, JOINT=3, {arms}, {pin}
FRICTION/4, JOINT=4, REACTION_ARM=0.02, INITIAL_OVERLAP=0.05, {pin}
ACCGRAV/JGRAV=-9.81
SFORCE/1, ROTATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=3*SIN(3*TIME)
INTEGRATOR/GSTIFF, SI2, ERROR=1E-6
RESULTS/XRF
END
"
    )
}

fn column(results: &ResFile, name: &str) -> Vec<f64> {
    results.get(name).unwrap().to_vec()
}

#[test]
fn bristles_of_any_stiffness_carry_loads_that_change_sign() {
    let folder = scratch_folder();
    let mut ends = Vec::new();
    for stiffness in [1e2, 1e4, 1e6, 1e9] {
        let path = folder.join("model.adm");
        std::fs::write(&path, slider_crank(stiffness)).unwrap();
        let mut project = Project::load(&path).unwrap();
        project.push_dynamic(3.0, Some(300), None);
        let (report, results) = run(&project, RunOptions::default());
        assert_eq!(report.outcome, Outcome::Completed);
        let wall = column(&results, "JOINT_4.FY");
        let changes = wall.windows(2).filter(|pair| pair[0] * pair[1] < 0.0);
        let changes = changes.count();
        let residual = report.balance.unwrap().residual_share();
        let steps = report.statistics.steps.steps;
        println!(
            "s0 {stiffness:e}: {steps} steps, {changes} changes of sign, residual {residual:.1e}"
        );
        // Twice a turn of the crank at least.
        assert!(changes > 20, "{changes}");
        // 1e-6 a step over 3000 steps, with soft bristles that swing.
        assert!(residual < 2e-3, "{residual}");
        // The stiffest takes as many steps as the softest: nothing resolves their stiffness.
        assert!(steps < 8000, "{steps}");
        ends.push(*column(&results, "PART_4_XFORM.X").last().unwrap());
    }
    // Stiffer bristles approach a limit: bristles of 1e6 N/m bend by micrometres.
    std::fs::remove_dir_all(folder).unwrap();
    let (soft, stiff) = ((ends[1] - ends[3]).abs(), (ends[2] - ends[3]).abs());
    assert!(stiff < soft && stiff < 0.02, "{ends:?}");
}

/// Nothing but the bristles themselves resolves a reversal that a motion prescribes.
#[test]
fn bristles_follow_a_prescribed_reversal_at_the_default_error() {
    let dataset = "A block that is driven to and fro
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=20, IP=1, 1, 1
MARKER/20, PART=2
JOINT/1, TRANSLATIONAL, I=20, J=1
FRICTION/1, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2, FORMULATION=LUGRE, DAMPING_COEFFICIENT=1
MOTION/1, JOINT=1, TRANSLATIONAL, FUNCTION=0.2*SIN(5*TIME)
ACCGRAV/JGRAV=-9.81
RESULTS/XRF
END
";
    let results = run_text(dataset, 1.0, 20, None);
    let friction = column(&results, "FRICTION_1.FZ");
    let peak = friction.iter().fold(0.0_f64, |m, f| m.max(f.abs()));
    // It slides at every output: 0.2 of the weight. A step may make an error of a hundredth.
    let exact = 0.2 * 2.0 * 9.81;
    println!("driven bristles: {peak} N of {exact}");
    assert!((peak - exact).abs() < 0.02 * exact, "{peak}");
}
