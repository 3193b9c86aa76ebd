//! Models that cannot be simulated to the end: every failure names the time, the element with its place
//! and a cure, and keeps the results up to its last good state.

use stiction::{Outcome, Project, RunOptions, RunReport};

use crate::shared::{run, scratch_folder};

/// A body of 1 kg that moves along z, and what acts on it.
const SLIDER: &str = "UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=1, CM=20, IP=1, 1, 1
MARKER/20, PART=2
JOINT/1, TRANSLATIONAL, I=20, J=1
";

/// A crank of 1 m with a rod of 0.7 m towards a slider on the x axis, turned at 1 rad/s: at the angle
/// asin 0.7 the rod is upright and the crank cannot turn on.
const CRANK: &str = "UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
MARKER/3, PART=1, QP=1.7, 0, 0, REULER=90D, 90D, 0
PART/2, MASS=1, CM=20, IP=1, 1, 1
MARKER/20, PART=2
MARKER/21, PART=2, QP=1, 0, 0
PART/3, MASS=1, CM=30, IP=1, 1, 1, QG=1, 0, 0
MARKER/30, PART=3
MARKER/31, PART=3, QP=0.7, 0, 0
PART/4, MASS=1, CM=40, IP=1, 1, 1, QG=1.7, 0, 0
MARKER/40, PART=4
MARKER/41, PART=4, REULER=90D, 90D, 0
JOINT/1, REVOLUTE, I=20, J=1
JOINT/2, REVOLUTE, I=30, J=21
JOINT/3, REVOLUTE, I=31, J=40
JOINT/4, TRANSLATIONAL, I=41, J=3
MOTION/1, JOINT=1, ROTATION, FUNCTION=TIME
";

/// A model that fails.
struct Failing {
    name: &'static str,
    model: &'static str,
    elements: &'static str,
    /// When it fails, to a millisecond.
    time: f64,
    /// Words of the message: what, where, and the cure.
    words: &'static [&'static str],
    /// Whether the last row of the results is the last good state.
    shown: bool,
}

const ALL: [Failing; 5] = [
    Failing {
        name: "root",
        model: SLIDER,
        elements: "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=SQRT(1-TIME)\n",
        time: 1.0,
        words: &[
            "root.adm:8:1",
            "SFORCE/1 gives a value or slope that is not a finite number",
            "keep the arguments of SQRT",
        ],
        shown: true,
    },
    Failing {
        name: "growing",
        model: SLIDER,
        // The velocity is tan t.
        elements: "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=1+VZ(20,1)**2\n",
        time: std::f64::consts::FRAC_PI_2,
        words: &[
            "growing.adm:5:1",
            "the error is largest in PART/2",
            "give a smaller HMIN or a larger ERROR",
        ],
        shown: true,
    },
    Failing {
        name: "hmin",
        model: SLIDER,
        elements: "SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=1000-1E6*DZ(20,1)\n\
                   INTEGRATOR/GSTIFF, SI2, ERROR=1E-6, HMIN=0.01\n",
        time: 0.0,
        words: &["hmin.adm:5:1", "the last try was 1.000e-2", "PART/2, "],
        shown: false,
    },
    Failing {
        name: "bristles",
        model: SLIDER,
        elements: "FRICTION/7, JOINT=1, FORMULATION=LUGRE, FRICTION_FORCE_PRELOAD=10, \
                   MU_STATIC=0.3, MU_DYNAMIC=0.2\n\
                   SFORCE/1, TRANSLATIONAL, ACTIONONLY, I=20, J=1, FUNCTION=LOG(0.5-TIME)\n",
        time: 0.5,
        words: &["bristles.adm:9:1", "SFORCE/1 gives a value", "LOG"],
        shown: true,
    },
    Failing {
        name: "crank",
        model: CRANK,
        elements: "",
        time: 0.775_397_496_610_753,
        words: &["crank.adm:9:1", "PART/3", "where the mechanism locks"],
        shown: true,
    },
];

fn failed(failing: &Failing) -> (RunReport, Vec<f64>) {
    let folder = scratch_folder();
    let path = folder.join(format!("{}.adm", failing.name));
    let (model, elements) = (failing.model, failing.elements);
    std::fs::write(
        &path,
        format!("A failing model\n{model}{elements}RESULTS/XRF\nEND\n"),
    )
    .unwrap();
    let mut project = Project::load(&path).unwrap();
    project.push_dynamic(3.0, Some(30), None);
    let (report, results) = run(&project, RunOptions::default());
    let block = results.block("dynamic_001");
    let times = block.map_or(Vec::new(), |block| block.times.clone());
    std::fs::remove_dir_all(folder).unwrap();
    (report, times)
}

#[test]
fn failures_say_when_where_and_why_and_keep_the_results() {
    for failing in &ALL {
        let name = failing.name;
        let (report, times) = failed(failing);
        assert!(
            matches!(report.outcome, Outcome::IntegrationFailed(_)),
            "{name}: {:?}",
            report.outcome
        );
        let time = report.failures[0].time;
        assert!((time - failing.time).abs() < 1e-3, "{name}: {time}");
        let said: String = report.messages.iter().map(ToString::to_string).collect();
        for word in failing.words {
            assert!(said.contains(word), "{name}: no {word} in\n{said}");
        }
        // All outputs before the failure, and the last good state where there is one.
        let outputs = (time / 0.1).floor() as usize;
        assert_eq!(
            times.len(),
            outputs + usize::from(failing.shown),
            "{name}: {times:?}"
        );
        let last = times.last().copied().unwrap_or(f64::NAN);
        assert_eq!(
            last == time && time > 0.0,
            failing.shown,
            "{name}: {last} {time}"
        );
    }
}
