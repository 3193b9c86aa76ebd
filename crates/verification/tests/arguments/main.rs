//! Every argument of the `FRICTION` statement, in every joint and both formulations, from the text of
//! a dataset to the friction.
//!
//! A part is driven along and about the freedoms of its joint, faster and faster from rest, through
//! stick, transition and sliding, while weight and torques load what the joint locks. For each
//! argument the statement is changed in that argument alone: the friction must be that of the
//! formulas, and differ from what it was before.

mod dataset;
mod oracle;

use friction::parameters::{JointType, PARAMETERS, inputs_of};
use mechanics::{
    Corrector, EquilibriumSettings, Observer, Settings, Simulation, Snapshot, StepReport,
};
use verification::coverage::{self, JOINTS};
use verification::{Case, Claim, Coverage, Formulation, Section, check};

use dataset::{Arguments, Yoke};
use oracle::Oracle;

/// Output times: stuck, in transition, sliding.
const TIMES: [f64; 10] = [0.02, 0.05, 0.1, 0.15, 0.2, 0.25, 0.3, 0.35, 0.4, 0.5];
/// Time up to which it is driven before an equilibrium is looked for: stuck.
const HELD: f64 = 0.1;

fn settings() -> Settings {
    Settings {
        formulation: mechanics::Formulation::Si2,
        error: 1e-9,
        highest_order: 5,
        // Nothing is free to move, so that only this limits the error of the bristles.
        longest_step: 2.5e-4,
        shortest_step: 1e-12,
        first_step: Some(1e-7),
        corrector: Corrector::default(),
        interpolates: true,
    }
}

/// Friction of a snapshot, ground axes.
fn wrench(s: &Snapshot<'_>) -> [f64; 6] {
    let j = s.model().joints[0].j;
    let values = s.friction(0);
    let axes = s.marker(j).axes;
    let (force, torque) = (axes * values.force, axes * values.torque);
    [force.x, force.y, force.z, torque.x, torque.y, torque.z]
}

/// Collects the friction at the outputs.
struct Frictions(Vec<[f64; 6]>);

impl Observer for Frictions {
    fn step(&mut self, _: &StepReport) -> bool {
        true
    }

    fn output(&mut self, snapshot: &Snapshot<'_>) -> bool {
        self.0.push(wrench(snapshot));
        true
    }
}

fn run(simulation: &mut Simulation, times: &[f64]) -> Vec<[f64; 6]> {
    let mut frictions = Frictions(Vec::new());
    let end = times[times.len() - 1];
    let run = simulation.run(end, times, &settings(), &mut frictions);
    run.unwrap_or_else(|error| panic!("{error}"));
    frictions.0
}

/// The friction of an equilibrium where the motion ends.
fn held(simulation: &mut Simulation) -> [f64; 6] {
    run(simulation, &[HELD]);
    let settings = EquilibriumSettings {
        error: 1e-9,
        imbalance: 1e-9,
        stability: 1e-5,
        iterations: 50,
        angle_limit: 0.2,
        translation_limit: 1.0,
    };
    let found = simulation.find_equilibrium(HELD, &settings);
    found.unwrap_or_else(|error| panic!("{error}"));
    wrench(&simulation.snapshot())
}

/// Largest difference, as a part of the largest size.
fn difference(ours: &[[f64; 6]], exact: &[[f64; 6]]) -> f64 {
    let scale = |group: std::ops::Range<usize>| {
        let sizes = exact.iter().flat_map(|row| row[group.clone()].to_vec());
        sizes.fold(1e-3, |m: f64, x| m.max(x.abs()))
    };
    let (force, torque) = (scale(0..3), scale(3..6));
    let mut worst = 0.0_f64;
    for (ours, exact) in ours.iter().zip(exact) {
        for k in 0..6 {
            let error = (ours[k] - exact[k]).abs() / if k < 3 { force } else { torque };
            worst = if error <= worst { worst } else { error };
        }
    }
    worst
}

/// The statement that the others differ from in one argument.
fn baseline(joint: JointType, formulation: Formulation, yoke: Yoke) -> Arguments {
    let numbers = [
        ("MU_STATIC", 0.3),
        ("MU_DYNAMIC", 0.2),
        ("STICTION_TRANSITION_VELOCITY", 0.1),
        ("TRANSITION_VELOCITY_COEFFICIENT", 1.8),
        ("MAX_STICTION_DEFORMATION", 0.006),
        ("BRISTLE_STIFFNESS_COEFFICIENT", 5e3),
        ("DAMPING_COEFFICIENT", 20.0),
        ("VISCOUS_FRICTION_COEFFICIENT", 5.0),
        ("VELOCITY_THRESHOLD_STRIBECK", 0.05),
        ("DECAY_EXPONENT_STRIBECK", 1.5),
        ("FRICTION_FORCE_PRELOAD", 3.0),
        ("FRICTION_TORQUE_PRELOAD", 0.4),
        ("REACTION_ARM", 0.05),
        ("INITIAL_OVERLAP", 0.4),
        ("BENDING_FACTOR", 1.5),
        ("PIN_RADIUS", 0.05),
        ("FRICTION_ARM", 0.03),
        ("BENDING_REACTION_ARM", 0.1),
        ("BALL_RADIUS", 0.04),
    ];
    let mut arguments = Arguments::new();
    arguments.insert("FORMULATION", dataset::formulation(formulation));
    let used = |keyword: &str| {
        let parameter = PARAMETERS.iter().find(|p| p.keyword == keyword);
        let parameter = parameter.expect("a keyword of the table");
        let this = parameter
            .formulation
            .is_none_or(|word| word == formulation.word());
        this && parameter.joints.contains(&joint)
    };
    for (keyword, value) in numbers.into_iter().filter(|(keyword, _)| used(keyword)) {
        arguments.insert(keyword, value.to_string());
    }
    if used("I_YOKE") {
        let keyword = if yoke == Yoke::I { "I_YOKE" } else { "J_YOKE" };
        arguments.insert(keyword, String::new());
    }
    arguments
}

/// Values that an argument is changed to, each in a statement of its own; none where the baseline
/// itself is the check.
fn changes(keyword: &str, joint: JointType, baseline: &Arguments) -> Vec<String> {
    let one = |text: &str| vec![text.to_string()];
    match keyword {
        "JOINT" | "I_YOKE" | "J_YOKE" | "FORMULATION" => Vec::new(),
        // One input left out at a time.
        "INPUTS" => {
            let words = inputs_of(joint);
            let without = |left: &&str| {
                let rest = words.iter().filter(|word| *word != left).copied();
                rest.collect::<Vec<_>>().join(", ")
            };
            words
                .iter()
                .map(|word| format!("({})", without(word)))
                .collect()
        }
        "EFFECT" => vec!["STICTION".into(), "SLIDING".into()],
        "OVERLAP_DELTA" => vec!["INCREASE".into(), "DECREASE".into()],
        "INACTIVE" => one("STATIC"),
        "MAX_FRICTION_FORCE" => one("2.5"),
        "MAX_FRICTION_TORQUE" => one("0.15"),
        _ => {
            let value: f64 = baseline[keyword].parse().expect("a number");
            vec![format!("{:.4}", 1.3 * value)]
        }
    }
}

/// The claims of one argument.
fn claims_of(
    keyword: &'static str,
    joint: JointType,
    formulation: Formulation,
    name: &str,
) -> Vec<Claim> {
    let yoke = match keyword {
        "J_YOKE" | "INACTIVE" => Yoke::J,
        _ => Yoke::I,
    };
    let before = baseline(joint, formulation, yoke);
    let coverage = [Coverage {
        joint,
        formulation,
        arguments: &[keyword],
    }];
    let case = Case {
        section: Section::Argument,
        id: name,
        model: "a part driven along and about the freedoms of its joint, from rest to 0.3 m/s, loaded where it is locked; the FRICTION statement with one argument changed",
        source: "formulas of the specification (sections 1 to 5), written down apart",
        covers: &coverage,
    };
    let friction = |arguments: &Arguments| {
        let mut simulation = dataset::simulation(&dataset::text(joint, yoke, arguments));
        if keyword == "INACTIVE" {
            vec![held(&mut simulation)]
        } else {
            run(&mut simulation, &TIMES)
        }
    };
    let exact = |arguments: &Arguments| -> Vec<[f64; 6]> {
        let oracle = Oracle {
            joint,
            yoke,
            arguments,
        };
        let sizes = if keyword == "INACTIVE" {
            vec![oracle.at_rest(HELD)]
        } else {
            oracle.friction(&TIMES)
        };
        sizes.iter().map(|sizes| oracle.wrench(sizes)).collect()
    };
    let (tolerance, why) = match formulation {
        Formulation::Original => (1e-9, "rounding of the drive's place and speed"),
        Formulation::LuGre => (
            2e-5,
            "steps of 0.25 ms, which nothing but their limit makes short: no freedom is left",
        ),
    };
    let base = friction(&before);
    let claim = |quantity: &str, ours: &[[f64; 6]], exact: &[[f64; 6]]| {
        let quantity = format!("friction with {quantity}, relative");
        case.worst(&quantity, difference(ours, exact), tolerance, why)
    };
    let mut claims = Vec::new();
    let changes = changes(keyword, joint, &before);
    if changes.is_empty() || keyword == "INACTIVE" {
        claims.push(claim(
            &format!("{keyword} as in all"),
            &base,
            &exact(&before),
        ));
    }
    for value in changes {
        let mut after = before.clone();
        after.insert(keyword, value.clone());
        let ours = friction(&after);
        let acts = difference(&ours, &base);
        assert!(
            acts > 1e-3,
            "{name}: {keyword}={value} changes nothing ({acts:e})"
        );
        claims.push(claim(
            &format!("{keyword} = {value}"),
            &ours,
            &exact(&after),
        ));
    }
    claims
}

/// All arguments of a joint with a formulation.
fn arguments_of(joint: JointType, formulation: Formulation) {
    let (_, word) = JOINTS
        .into_iter()
        .find(|(kind, _)| *kind == joint)
        .expect("a joint");
    let name = format!("{} {}", word.to_lowercase(), formulation.word());
    let mut claims = Vec::new();
    for cell in coverage::all() {
        if cell.joint == word && cell.formulation == formulation.word() {
            let keyword = PARAMETERS.iter().find(|p| p.keyword == cell.argument);
            let keyword = keyword.expect("a keyword of the table").keyword;
            claims.extend(claims_of(keyword, joint, formulation, &name));
        }
    }
    check(&claims);
}

#[test]
fn translational_original() {
    arguments_of(JointType::Translational, Formulation::Original);
}

#[test]
fn translational_lugre() {
    arguments_of(JointType::Translational, Formulation::LuGre);
}

#[test]
fn revolute_original() {
    arguments_of(JointType::Revolute, Formulation::Original);
}

#[test]
fn revolute_lugre() {
    arguments_of(JointType::Revolute, Formulation::LuGre);
}

#[test]
fn cylindrical_original() {
    arguments_of(JointType::Cylindrical, Formulation::Original);
}

#[test]
fn cylindrical_lugre() {
    arguments_of(JointType::Cylindrical, Formulation::LuGre);
}

#[test]
fn spherical_original() {
    arguments_of(JointType::Spherical, Formulation::Original);
}

#[test]
fn spherical_lugre() {
    arguments_of(JointType::Spherical, Formulation::LuGre);
}

#[test]
fn hooke_original() {
    arguments_of(JointType::Hooke, Formulation::Original);
}

#[test]
fn hooke_lugre() {
    arguments_of(JointType::Hooke, Formulation::LuGre);
}

#[test]
fn universal_original() {
    arguments_of(JointType::Universal, Formulation::Original);
}

#[test]
fn universal_lugre() {
    arguments_of(JointType::Universal, Formulation::LuGre);
}
