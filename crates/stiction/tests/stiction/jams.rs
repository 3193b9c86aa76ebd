//! A joint that jams on its way to the stick is seen at any error, also where a step passes over it.

use stiction::{Outcome, Project, RunOptions};

use crate::shared::{run, scratch_folder};

/// A block that slides to rest with its centre of mass beside the guide: while it brakes its own
/// inertia presses it into the guide, with a gain of `mu h/Xs`: 0.8 while it slides, 1.2 at `mu_s`.
const BLOCK: &str = "A block with its mass beside the guide
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=3, CM=22, IP=0.02, 0.02, 0.02, VZ=1.5
MARKER/20, PART=2
MARKER/22, PART=2, QP=0, 0.8, 0
JOINT/1, TRANSLATIONAL, I=20, J=1
FRICTION/5, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2, INITIAL_OVERLAP=0.2
ACCGRAV/JGRAV=-9.81
RESULTS/XRF
END
";

#[test]
fn a_jam_on_the_way_to_the_stick_is_never_passed_over() {
    let folder = scratch_folder();
    let path = folder.join("model.adm");
    std::fs::write(&path, BLOCK).unwrap();
    for error in [1e-3, 1e-5, 1e-7] {
        let mut project = Project::load(&path).unwrap();
        project.push_dynamic(1.0, Some(10), None);
        let (report, _) = run(
            &project,
            RunOptions {
                error: Some(error),
                ..RunOptions::default()
            },
        );
        let Outcome::IntegrationFailed(text) = &report.outcome else {
            panic!("{:?} at {error:e}", report.outcome)
        };
        assert!(text.contains("FRICTION/5 jams"), "{text}");
    }
    std::fs::remove_dir_all(folder).unwrap();
}
