//! One part on one joint, its freedom driven, everything locked loaded: the dataset as text.

use std::collections::BTreeMap;
use std::fmt::Write;
use std::path::Path;
use std::sync::atomic::{AtomicUsize, Ordering};

use friction::parameters::JointType;
use verification::Formulation;

/// Which pin of a cross has the friction.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Yoke {
    I,
    J,
}

/// Arguments of the statement as they stand in the text; a flag has no value.
pub(crate) type Arguments = BTreeMap<&'static str, String>;

/// Weight of the part, ground axes, N.
pub(crate) const WEIGHT: [f64; 3] = [6.0, -18.0, 8.0];
/// Torque on the part, ground axes, N m.
pub(crate) const TORQUE: [f64; 3] = [1.5, -2.0, 0.8];
/// Acceleration of the driven freedoms: along, m/s², and about, rad/s².
pub(crate) const DRIVE: [f64; 2] = [0.6, 12.0];
/// Axis that the ball is driven about: z of a frame with these Euler angles.
pub(crate) const BALL_EULER: [f64; 2] = [30.0, 50.0];

/// Euler angles (degrees) of frames with z along the ground axes x, y, z.
const ALONG: [&str; 3] = ["90D, 90D, 0", "180D, 90D, 0", "0, 0, 0"];

/// The friction statement, in the order of the alphabet after the joint.
fn friction(arguments: &Arguments) -> String {
    let mut text = "FRICTION/1, JOINT=1".to_string();
    for (keyword, value) in arguments {
        text.push_str("\n, ");
        text.push_str(keyword);
        if !value.is_empty() {
            text.push_str(" = ");
            text.push_str(value);
        }
    }
    text
}

/// The dataset: the part is 2, the joint 1 and its markers 21 (I) and 11 (J).
pub(crate) fn text(joint: JointType, yoke: Yoke, arguments: &Arguments) -> String {
    let mut text = format!(
        "One part on one joint
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=METER, TIME=SECOND
PART/1, GROUND
PART/2, MASS=2, CM=20, IP=1, 1, 1
MARKER/20, PART=2
ACCGRAV/IGRAV={}, JGRAV={}, KGRAV={}
",
        WEIGHT[0] / 2.0,
        WEIGHT[1] / 2.0,
        WEIGHT[2] / 2.0
    );
    let mut line = |words: std::fmt::Arguments<'_>| {
        text.write_fmt(words).expect("writing to a string succeeds");
        text.push('\n');
    };
    for (k, torque) in TORQUE.iter().enumerate() {
        let marker = 31 + k;
        line(format_args!("MARKER/{marker}, PART=1, REULER={}", ALONG[k]));
        line(format_args!(
            "SFORCE/{}, ROTATIONAL, I=20, J={marker}, ACTIONONLY, FUNCTION={torque}",
            k + 1
        ));
    }
    // The joint's frames: z along z, or for a universal joint along its pins x and y.
    let (kind, i, j) = match joint {
        JointType::Translational => ("TRANSLATIONAL", 2, 2),
        JointType::Revolute => ("REVOLUTE", 2, 2),
        JointType::Cylindrical => ("CYLINDRICAL", 2, 2),
        JointType::Spherical => ("SPHERICAL", 2, 2),
        JointType::Hooke => ("HOOKE", 2, 2),
        JointType::Universal => ("UNIVERSAL", 0, 1),
    };
    line(format_args!("MARKER/21, PART=2, REULER={}", ALONG[i]));
    line(format_args!("MARKER/11, PART=1, REULER={}", ALONG[j]));
    line(format_args!("JOINT/1, {kind}, I=21, J=11"));
    let [along, about] = DRIVE;
    match joint {
        JointType::Translational | JointType::Revolute | JointType::Cylindrical => {
            if joint != JointType::Revolute {
                line(format_args!(
                    "MOTION/1, JOINT=1, TRANSLATIONAL, FUNCTION=0.5*{along}*TIME**2"
                ));
            }
            if joint != JointType::Translational {
                line(format_args!(
                    "MOTION/2, JOINT=1, ROTATIONAL, FUNCTION=0.5*{about}*TIME**2"
                ));
            }
        }
        JointType::Spherical => {
            // About an axis of its own, which stays parallel to itself.
            let [psi, theta] = BALL_EULER;
            line(format_args!(
                "MARKER/22, PART=2, REULER={psi}D, {theta}D, 0"
            ));
            line(format_args!(
                "MARKER/12, PART=1, REULER={psi}D, {theta}D, 0"
            ));
            line(format_args!("JPRIM/1, PARALLEL_AXES, I=22, J=12"));
            line(format_args!(
                "MOTION/2, I=22, J=12, B3, FUNCTION=0.5*{about}*TIME**2"
            ));
        }
        JointType::Hooke | JointType::Universal => {
            // About the pin with the friction; the other pin is held by a right angle: x of the part
            // to z of ground, or z of the part to y of ground.
            let (axis, [held, to]) = match yoke {
                Yoke::I => (0, [0, 2]),
                Yoke::J => (1, [2, 1]),
            };
            line(format_args!("MARKER/22, PART=2, REULER={}", ALONG[held]));
            line(format_args!("MARKER/12, PART=1, REULER={}", ALONG[to]));
            line(format_args!("JPRIM/1, PERPENDICULAR, I=22, J=12"));
            line(format_args!("MARKER/23, PART=2, REULER={}", ALONG[axis]));
            line(format_args!("MARKER/13, PART=1, REULER={}", ALONG[axis]));
            line(format_args!(
                "MOTION/2, I=23, J=13, B3, FUNCTION=0.5*{about}*TIME**2"
            ));
        }
    }
    text.push_str(&friction(arguments));
    text.push_str("\nEND\n");
    text
}

/// The mechanics of a dataset, read as a file.
pub(crate) fn simulation(text: &str) -> mechanics::Simulation {
    static NEXT: AtomicUsize = AtomicUsize::new(0);
    let number = NEXT.fetch_add(1, Ordering::Relaxed);
    let name = format!("arguments-{}-{number}.adm", std::process::id());
    let path = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::write(&path, text).expect("the folder for tests can be written");
    let project = stiction::Project::load(&path);
    std::fs::remove_file(&path).expect("the file was just written");
    let simulation = project.and_then(|project| project.simulation());
    let mut simulation = simulation.unwrap_or_else(|error| panic!("{error}\n{text}"));
    let assembly = simulation.assemble().expect("the part stands where it is");
    assert!(assembly.redundant.is_empty(), "{:?}", assembly.redundant);
    assert_eq!(simulation.system().degrees_of_freedom(), 0);
    simulation
        .solve_instant()
        .expect("the first instant is unique");
    simulation
}

/// Word of the formulation.
pub(crate) fn formulation(formulation: Formulation) -> String {
    formulation.word().to_string()
}
