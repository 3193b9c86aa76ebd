//! The energy balance of runs closes, and our channels of energy agree with it.

use std::path::{Path, PathBuf};

use stiction::{EnergyBalance, Outcome, Project, RunOptions};
use verification::{Case, Rule, Section, check};

use crate::runs::{run_commands, with_commands};
use crate::shared::run;

/// Two bars without friction that swing on one another.
const FRICTIONLESS: &str = "Two bars that swing on one another
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=METER, TIME=SECOND
ACCGRAV/KGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1, REULER=0, 90D, 0
PART/2, MASS=1, CM=20, IP=0.0001, 0.0834, 0.0834
MARKER/20, PART=2, QP=0.5, 0, 0
MARKER/21, PART=2, REULER=0, 90D, 0
MARKER/22, PART=2, QP=1, 0, 0, REULER=0, 90D, 0
PART/3, MASS=1, CM=30, IP=0.0001, 0.0834, 0.0834, QG=1, 0, 0
MARKER/30, PART=3, QP=0.5, 0, 0
MARKER/31, PART=3, REULER=0, 90D, 0
JOINT/1, REVOLUTE, I=21, J=1
JOINT/2, REVOLUTE, I=31, J=22
";

fn example(file: &str) -> PathBuf {
    Path::new(env!("CARGO_MANIFEST_DIR"))
        .join("../../examples")
        .join(file)
}

fn balance(project: &Project, error: f64) -> EnergyBalance {
    let (report, _) = run(
        project,
        RunOptions {
            error: Some(error),
            ..RunOptions::default()
        },
    );
    assert_eq!(report.outcome, Outcome::Completed);
    report.balance.unwrap()
}

/// Residuals as parts of the energy exchanged at the default error, a tenth and a hundredth of it.
fn closes(project: &Project, id: &str, model: &str, default: f64) {
    let balances = [1.0, 0.1, 0.01].map(|part| balance(project, part * default));
    let shares = balances.each_ref().map(EnergyBalance::residual_share);
    let case = Case {
        section: Section::Integration,
        id,
        model,
        source: "conservation of energy, with works that the integrator integrates",
        covers: &[],
    };
    let name = "residual of the energy balance over the energy exchanged, at the default error, a \
                tenth and a hundredth of it";
    check(&[
        case.vanishing(name, &shares, Rule::Below(1e-4), "bound asked for"),
        case.vanishing(
            "the same at a hundredth of the default error",
            &shares[2..],
            Rule::Below(5e-6),
            "the balance has no error but that of the steps, a few times 1e-6 of each",
        ),
    ]);
}

#[test]
fn the_balance_of_the_pendulum_closes() {
    let project = Project::load(&example("pendulum/pendulum.acf")).unwrap();
    closes(
        &project,
        "energy, pendulum",
        "the shipped pendulum with friction in its pin, 30 s",
        1e-6,
    );
}

#[test]
fn the_balance_of_the_shipped_delta_robot_closes() {
    let project = Project::load(&example("delta-robot/delta.acf")).unwrap();
    closes(
        &project,
        "energy, delta robot",
        "the shipped delta robot with friction in twelve ball joints, 1.2 s",
        1e-5,
    );
}

#[test]
fn the_balance_of_the_real_delta_robot_closes() {
    let folder = "adams-results/delta-robot-friction";
    let Some(commands) = reference_data::path(&format!("{folder}/delta_robot_replay.acf")) else {
        return;
    };
    let project = Project::load(&commands).unwrap();
    closes(
        &project,
        "energy, real delta robot",
        "a delta robot with 12 frictions in 200 simulations that follow one another",
        1e-4,
    );
}

#[test]
fn the_balance_of_a_frictionless_run_closes() {
    let commands = "\nSIMULATE/DYNAMIC, END=10, DTOUT=0.02\n";
    let project = with_commands(FRICTIONLESS, commands).unwrap();
    closes(
        &project,
        "energy, no friction",
        "a double pendulum of two bars, 10 s",
        1e-6,
    );
}

#[test]
fn channels_and_balance_tell_the_same_energies() {
    let project = Project::load(&example("delta-robot/delta.acf")).unwrap();
    let (report, results) = run(&project, RunOptions::default());
    let balance = report.balance.unwrap();
    let details = results
        .entities
        .iter()
        .filter(|e| e.kind == results::FRICTION_DETAIL);
    let names: Vec<&str> = details.map(|entity| entity.name.as_str()).collect();
    assert_eq!(names.len(), 12);
    let time = results.get("time.TIME").unwrap();
    let (mut dissipated, mut stored) = (0.0, 0.0);
    for (name, report) in names.iter().zip(&report.frictions) {
        let get = |component: &str| results.get(&format!("{name}.{component}")).unwrap();
        let last = |component: &str| *get(component).last().unwrap();
        assert_eq!(last("DISSIPATED"), report.energy);
        assert_eq!(last("WORK"), report.work);
        dissipated += last("DISSIPATED");
        stored += last("STORED");
        // Work less what is stored is what is dissipated; it started without either.
        let difference = last("WORK") - last("STORED") - last("DISSIPATED");
        assert!(difference.abs() < 1e-15, "{name}: {difference:e}");
        // The work is the integral of the power: the trapezoidal rule over outputs of 5 ms, within
        // which a ball changes from sticking to sliding, is good to a few per cent.
        let power = get("POWER");
        let integral: f64 = (1..time.len())
            .map(|k| 0.5 * (power[k] + power[k - 1]) * (time[k] - time[k - 1]))
            .sum();
        assert!(
            (integral - report.work).abs() < 0.03 * report.work,
            "{name}: {integral} {}",
            report.work
        );
        // Loads and friction are the sums of their parts.
        let sum = |components: [&str; 3]| -> Vec<f64> {
            let parts = components.map(get);
            (0..time.len())
                .map(|k| parts.iter().map(|part| part[k]).sum())
                .collect()
        };
        let (load, parts) = (
            get("LOAD"),
            sum(["LOAD_REACTION", "LOAD_BENDING", "LOAD_TORSION"]),
        );
        let made = sum(["BY_REACTION", "BY_BENDING", "BY_TORSION"]);
        let friction = name.trim_end_matches("_DETAIL");
        let torque = ["TX", "TY", "TZ"].map(|c| results.get(&format!("{friction}.{c}")).unwrap());
        for k in 0..time.len() {
            assert!((load[k] - parts[k]).abs() <= 1e-15 * load[k]);
            let torque = crate::table::norm(torque.each_ref().map(|series| series[k]));
            assert!(
                (made[k] - torque).abs() <= 1e-12 * torque.max(1e-9),
                "{name} {k}"
            );
        }
        assert!(get("LIMITED").iter().all(|limited| *limited == 0.0));
    }
    assert!((dissipated - balance.dissipated).abs() < 1e-15);
    assert!((stored - balance.stored.end).abs() < 1e-15);
    // The springs of the motors hold the arms: all work is that of forces.
    assert_eq!(balance.motions, 0.0);
}

#[test]
fn what_equilibria_change_is_not_in_the_balance() {
    // A hanging mass: an equilibrium lets it down on its spring, then the spring is let go.
    let model = "A mass on a spring
UNITS/SYSTEM=MKS
ACCGRAV/KGRAV=-10
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=20, IP=1, 1, 1
MARKER/20, PART=2
JOINT/1, TRANSLATIONAL, I=20, J=1
SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=-100*DZ(20, 1)
SFORCE/2, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=5
";
    let commands = "
SIMULATE/STATIC
DEACTIVATE/SFORCE, ID=2
SIMULATE/DYNAMIC, DURATION=0.5, STEPS=50
ACTIVATE/SFORCE, ID=2
SIMULATE/STATIC
SIMULATE/DYNAMIC, DURATION=0.5, STEPS=50
";
    let project = with_commands(model, commands).unwrap();
    let balance = balance(&project, 1e-9);
    // 0.15 m down at rest; then it swings about 0.2 m down until it is let down to 0.15 m again.
    assert!((balance.weight.start + 3.0).abs() < 1e-6, "{balance}");
    assert!((balance.weight.end + 3.0).abs() < 1e-6, "{balance}");
    let place = -0.2 + 0.05 * (50.0_f64.sqrt() * 0.5).cos();
    assert!(
        (balance.weight.change - 20.0 * (place + 0.15)).abs() < 1e-6,
        "{balance}"
    );
    assert!(balance.residual_share() < 1e-6, "{balance}");
}

/// A mass of 2 kg that slides along z.
const GUIDED_MASS: &str = "A mass in a guide
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=20, IP=1, 1, 1
MARKER/20, PART=2
JOINT/1, TRANSLATIONAL, I=20, J=1
";

/// Where no velocity can be told from the tolerance, nothing is missing.
#[test]
fn energies_of_the_size_of_the_error_are_none() {
    let model = format!(
        "{GUIDED_MASS}SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, \
         FUNCTION=SIGN(1, SIN(2*PI*200*TIME))\n"
    );
    // At every output it is at rest.
    let commands = "\nINTEGRATOR/GSTIFF, SI2, ERROR=1E-3\nSIMULATE/DYNAMIC, END=1, STEPS=10\n";
    let run = run_commands(&model, commands);
    assert!(run.report.balance.unwrap().residual_share() > 1e-3);
    assert_eq!(run.report.warnings, 0, "{}", run.messages);
}

/// A mass that slides against friction, gravity and a push has its energies at every output.
#[test]
fn energies_over_time_are_those_of_a_sliding_mass() {
    // 2 kg at 4 m/s; gravity 10 m/s2 across, 1 m/s2 against the motion; friction 0.2 of 20 N; a push of
    // 1 N: it slows down by 0.2 * 10 + 1 - 0.5 = 2.5 m/s2.
    let model = GUIDED_MASS.replace("IP=1, 1, 1", "IP=1, 1, 1, VZ=4")
        + "ACCGRAV/IGRAV=-10, KGRAV=-1
FRICTION/1, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2, INPUTS=REACTION_FORCE
, STICTION_TRANSITION_VELOCITY=0.001
SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=1
";
    let commands = "\nINTEGRATOR/GSTIFF, SI2, ERROR=1E-8\nSIMULATE/DYNAMIC, END=1, STEPS=10\n";
    let results = run_commands(&model, commands).results;
    let get = |component: &str| results.get(&format!("ENERGY_BALANCE.{component}")).unwrap();
    let time = results.get("time.TIME").unwrap();
    let way: Vec<f64> = time.iter().map(|t| 4.0 * t - 1.25 * t * t).collect();
    let of = |energy: fn(f64, f64) -> f64| -> Vec<f64> {
        let outputs = time.iter().zip(&way);
        outputs.map(|(t, s)| energy(4.0 - 2.5 * t, *s)).collect()
    };
    let expected = [
        ("KINETIC", of(|v, _| v * v)),
        ("WEIGHT", of(|_, s| 2.0 * s)),
        ("STORED", of(|_, _| 0.0)),
        ("WORK_OF_FORCES", of(|_, s| s)),
        ("WORK_OF_MOTIONS", of(|_, _| 0.0)),
        ("DISSIPATED", of(|_, s| 4.0 * s)),
        ("RESIDUAL", of(|_, _| 0.0)),
    ];
    assert_eq!(
        expected.each_ref().map(|(name, _)| *name),
        results::ENERGY_COMPONENTS
    );
    for (name, expected) in expected {
        let found = get(name);
        // The first block is the model as given, which is all zeros.
        for k in 1..time.len() {
            let difference = (found[k] - expected[k]).abs();
            // Of 16 J; what steps of an error of 1e-8 in length and velocity add up to.
            assert!(difference < 1e-6, "{name} at {}: {difference:e}", time[k]);
        }
    }
    // Friction and velocity of the surfaces about the one axis, with their signs.
    let friction = results.get("FRICTION_1_DETAIL.FRICTION").unwrap();
    let velocity = results.get("FRICTION_1_DETAIL.VELOCITY").unwrap();
    let last = time.len() - 1;
    assert!((friction[last] + 4.0).abs() < 1e-9 && (velocity[last] - 1.5).abs() < 1e-7);
}

/// A motion works on what it moves, at whichever level it is prescribed.
#[test]
fn motions_of_every_level_do_work() {
    for (level, function) in [
        ("DISPLACEMENT", "2*TIME**2"),
        ("VELOCITY", "4*TIME"),
        ("ACCELERATION", "4"),
    ] {
        let model =
            format!("{GUIDED_MASS}MOTION/1, JOINT=1, TRANSLATION, {level}, FUNCTION={function}\n");
        let commands = "\nSIMULATE/DYNAMIC, END=1, STEPS=10\n";
        let balance = balance(&with_commands(&model, commands).unwrap(), 1e-8);
        // At the end 2 kg at 4 m/s.
        assert!((balance.motions - 16.0).abs() < 1e-5, "{level}: {balance}");
        assert!(balance.residual_share() < 1e-5, "{level}: {balance}");
    }
}

#[test]
fn a_run_without_dynamics_has_no_balance() {
    let commands = "\nSIMULATE/STATIC\n";
    let model = "A mass on a spring
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=20, IP=1, 1, 1
MARKER/20, PART=2
JOINT/1, TRANSLATIONAL, I=20, J=1
SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=-100*DZ(20, 1)
";
    let (report, results) = run(
        &with_commands(model, commands).unwrap(),
        RunOptions::default(),
    );
    assert_eq!(report.balance, None);
    // Without a FRICTION there is nothing of ours in the results.
    assert!(
        results
            .entities
            .iter()
            .all(|e| e.kind != results::FRICTION_DETAIL)
    );
}

#[test]
fn a_balance_that_does_not_close_is_a_warning() {
    let coarse = "\nINTEGRATOR/GSTIFF, I3, ERROR=1E-1\nSIMULATE/DYNAMIC, END=10, DTOUT=0.1\n";
    let run = run_commands(FRICTIONLESS, coarse);
    assert!(run.report.balance.unwrap().residual_share() > 1e-3);
    assert_eq!(run.report.warnings, 1, "{}", run.messages);
    let messages = run.messages;
    assert!(
        messages.contains("the energy balance of the run does not close"),
        "{messages}"
    );
    let fine = "\nSIMULATE/DYNAMIC, END=10, DTOUT=0.1\n";
    assert_eq!(run_commands(FRICTIONLESS, fine).report.warnings, 0);
}
