//! Command files: what their commands do to a run.

use std::path::{Path, PathBuf};

use stiction::{Outcome, Project, RunOptions};

use crate::shared::{run, run_with_log};

const SLIDER: &str = "A slider pushed by a variable
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=20, IP=1, 1, 1
MARKER/20, PART=2
JOINT/1, TRANSLATIONAL, I=20, J=1
VARIABLE/1, FUNCTION=6
SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=VARVAL(1)
INTEGRATOR/GSTIFF, SI2, ERROR=1E-8
END
";

/// The slider with a command file of that name.
fn with_commands(name: &str, commands: &str) -> PathBuf {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-input"));
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("slider.adm"), SLIDER).unwrap();
    let file = folder.join(format!("{name}.acf"));
    std::fs::write(&file, commands).unwrap();
    file
}

#[test]
fn changes_act_from_their_command_on() {
    let commands = "
FILE/MODEL=slider
SIMULATE/INITIAL_CONDITIONS
SIMULATE/DYNAMIC, END=1, STEPS=4
! A function that reads what the model did not read before.
VARIABLE/1, FUNCTION=-8*VZ(20)
SIMULATE/TRANSIENT, DURATION=1, DTOUT=0.25
SFORCE/1, FUNCTION=0
SIMULATE/DYNAMIC, END=3, STEPS=4
STOP
SIMULATE/DYNAMIC, END=99, STEPS=4
";
    let project = Project::load(&with_commands("changes", commands)).unwrap();
    let (report, results) = run(&project, RunOptions::default());
    assert_eq!(report.outcome, Outcome::Completed);
    assert_eq!(
        (report.simulations, report.outputs, report.time),
        (3, 12, 3.0)
    );
    let speed = |block: &str| {
        let column = results.column("PART_2_XFORM.VZ").unwrap();
        results.block(block).unwrap().column(column).last().unwrap()
    };
    // 3 m/s^2 for a second, then a decay at a rate of 4 1/s, then nothing.
    assert!((speed("dynamic_001") - 3.0).abs() < 1e-6);
    let decayed = 3.0 * (-4.0_f64).exp();
    assert!((speed("dynamic_002") - decayed).abs() < 1e-6);
    assert!((speed("dynamic_003") - decayed).abs() < 1e-6);
    assert_eq!(results.block("initialConditions_001").unwrap().times, [0.0]);
    assert_eq!(results.status.as_deref(), Some("Successful"));
}

#[test]
fn what_a_command_asks_for_wrongly_is_known_before_the_run() {
    let cases = [
        (
            "VARIABLE/1, FUNCTION=DELAY(TIME, 1, 0)",
            "before:3:1: error",
            "the past",
        ),
        ("VARIABLE/7, FUNCTION=1", "before:3:1: error", "VARIABLE/7"),
        (
            "SIMULATE/DYNAMIC, END=0.5, DTOUT=1E-12",
            "before:3:1",
            "too many",
        ),
    ];
    for (command, place, word) in cases {
        let commands =
            format!("\nFILE/MODEL=slider\n{command}\nSIMULATE/DYNAMIC, END=1, STEPS=4\n");
        let project = Project::load(&with_commands("before", &commands)).unwrap();
        let text = stiction::Session::new(&project).unwrap_err().to_string();
        let text = text.replace("before.acf", "before");
        assert!(
            text.contains(place) && text.contains(word),
            "{command}: {text}"
        );
    }
    let commands = "\nSIMULATE/DYNAMIC, END=1, STEPS=4\nFILE/MODEL=slider\n";
    let error = Project::load(&with_commands("early", commands))
        .unwrap_err()
        .to_string();
    assert!(
        error.contains("early.acf:2:1: error") && error.contains("before any model"),
        "{error}"
    );
}

#[test]
fn command_files_call_others_but_not_themselves() {
    let inner = with_commands("inner", "\nSIMULATE/DYNAMIC, END=1, STEPS=4\n");
    let folder = inner.parent().unwrap();
    let outer = folder.join("outer.acf");
    std::fs::write(&outer, "\nFILE/MODEL=slider\nFILE/COMMAND=inner\n").unwrap();
    let project = Project::load(&outer).unwrap();
    let (report, _) = run(&project, RunOptions::default());
    assert_eq!(
        (report.outcome, report.simulations),
        (Outcome::Completed, 1)
    );
    std::fs::write(&outer, "\nFILE/MODEL=slider\nFILE/COMMAND=outer\n").unwrap();
    let error = Project::load(&outer).unwrap_err().to_string();
    assert!(error.contains("outer.acf:3:1: error"), "{error}");
}

#[test]
fn split_runs_agree_with_one() {
    let whole = "\nFILE/MODEL=slider\nSIMULATE/DYNAMIC, END=1, STEPS=8\n";
    let split = "\nFILE/MODEL=slider\nSIMULATE/DYNAMIC, END=0.5, STEPS=4\n\
                 SIMULATE/DYNAMIC, END=1, STEPS=4\n";
    let last = |name: &str, commands: &str| {
        let project = Project::load(&with_commands(name, commands)).unwrap();
        let (_, results) = run(&project, RunOptions::default());
        *results.get("PART_2_XFORM.Z").unwrap().last().unwrap()
    };
    // Exactly 1.5 m; the tolerance is 1e-8 a step.
    assert!((last("whole", whole) - 1.5).abs() < 1e-7);
    assert!((last("split", split) - 1.5).abs() < 1e-7);
}

/// A pendulum hangs still: its frequency is in the report, on the terminal and in the message file.
#[test]
fn eigensolutions_are_reported_and_logged() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("modes-input");
    std::fs::create_dir_all(&folder).unwrap();
    let model = "A pendulum of a metre, in millimetres and milliseconds
UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=MILLISECOND
ACCGRAV/JGRAV=-9.80665E-3
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=20, IP=1E-9, 1E-9, 1E-9
MARKER/20, PART=2, QP=0, -1000, 0
MARKER/21, PART=2
JOINT/1, REVOLUTE, I=21, J=1
END
";
    std::fs::write(folder.join("pendulum.adm"), model).unwrap();
    let commands = "\nFILE/MODEL=pendulum\nSIMULATE/STATIC\nLINEAR/EIGENSOL, COORDS=1\n\
                    ACCGRAV/JGRAV=-39.2266E-3\nLIN/EIG, NOVECTOR, RM=1\n";
    let file = folder.join("modes.acf");
    std::fs::write(&file, commands).unwrap();
    let project = Project::load(&file).unwrap();
    let (report, _, log) = run_with_log(&project, RunOptions::default());
    assert_eq!(report.outcome, Outcome::Completed);
    let frequency = 9.80665_f64.sqrt() / std::f64::consts::TAU;
    for (modes, expected) in report.modes.iter().zip([frequency, 2.0 * frequency]) {
        assert_eq!(modes.modes.len(), 1);
        let mode = &modes.modes[0];
        assert!((mode.value[1] / expected - 1.0).abs() < 1e-9, "{mode:?}");
        assert_eq!((mode.value[0], mode.damping_ratio()), (0.0, 0.0));
    }
    let moves = report.modes[0].modes[0].moves.as_deref().unwrap();
    assert!(moves.starts_with("PART/2 "), "{moves}");
    assert_eq!(report.modes[1].modes[0].moves, None);
    assert!(log.contains("E I G E N V A L U E S  at time = 0.00000E+00"));
    assert!(log.contains("shape of mode 1"), "{log}");
}

/// A crank that turns by a function of time: nothing is left to integrate, and the positions at the
/// outputs are exact whatever the tolerance of the integrator.
const CRANK: &str = "A driven crank
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=20, IP=1, 1, 1
MARKER/20, PART=2, QP=0.5, 0, 0
MARKER/21, PART=2
JOINT/1, REVOLUTE, I=21, J=1
MOTION/1, JOINT=1, ROTATION, FUNCTION=3*TIME**2
INTEGRATOR/GSTIFF, ERROR=1E-2
END
";

#[test]
fn without_freedoms_a_simulation_is_kinematic() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("crank-input");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("crank.adm"), CRANK).unwrap();
    let commands = "\nFILE/MODEL=crank\nSIM/KIN, END=1, STEPS=5\nSIM/TRA, DUR=1, STEPS=5\n\
                    SIM/DYN, END=3, STEPS=2\nDEACTIVATE/MOTION, ID=1\n\
                    SIM/KIN, END=3.1, STEPS=2\n";
    let file = folder.join("kinematic.acf");
    std::fs::write(&file, commands).unwrap();
    let (report, results, log) =
        run_with_log(&Project::load(&file).unwrap(), RunOptions::default());
    assert_eq!(report.outcome, Outcome::Completed);
    for (block, times) in [
        ("kinematic_001", [0.2, 0.4, 1.0]),
        ("kinematic_002", [1.2, 1.4, 2.0]),
    ] {
        let block = results.block(block).unwrap();
        let angle = results.column("PART_2_XFORM.PSI").unwrap();
        let torque = results.column("MOTION_1.TZ").unwrap();
        for (row, time) in [0, 1, 4].into_iter().zip(times) {
            assert!((block.times[row] - time).abs() < 1e-12);
            let q: f64 = 3.0 * time * time;
            let turned = block.column(angle).nth(row).unwrap();
            let off = (turned - q).rem_euclid(std::f64::consts::TAU);
            // Projected onto the constraints: rounding of angles of several turns.
            assert!(off.min(std::f64::consts::TAU - off) < 1e-11, "{turned} {q}");
            // (I + m a^2) 6 + m g a cos q
            let expected = 1.5 * 6.0 + 2.0 * 9.81 * 0.5 * q.cos();
            let found = block.column(torque).nth(row).unwrap();
            assert!((found - expected).abs() < 1e-9, "{found} {expected}");
        }
    }
    assert!(results.block("dynamic_001").is_some() && results.block("dynamic_002").is_some());
    assert!(log.contains("Performing Kinematic Simulation"), "{log}");
    assert!(
        log.contains("with 1 degrees of freedom goes on as dynamic"),
        "{log}"
    );
    let told = report.messages.iter();
    let told = told.filter(|message| message.diagnostic.code == dataset::Code::NotKinematic);
    let lines: Vec<usize> = told.map(|message| message.location.start.line).collect();
    assert_eq!(lines, [5, 7]);
}

/// A model that cannot go on beyond one second, and commands behind the one that fails.
#[test]
fn a_failed_simulation_ends_the_run_only_where_it_shall() {
    let commands = "
FILE/MODEL=slider
SIMULATE/DYNAMIC, END=1, STEPS=4
VARIABLE/1, FUNCTION=SQRT(1.5-TIME)
SIMULATE/DYNAMIC, END=2, STEPS=4
VARIABLE/1, FUNCTION=0
SIMULATE/DYNAMIC, END=3, STEPS=4
";
    let project = Project::load(&with_commands("goeson", commands)).unwrap();
    let (report, results, log) = run_with_log(&project, RunOptions::default());
    assert!(matches!(report.outcome, Outcome::IntegrationFailed(_)));
    assert_eq!((report.simulations, report.time), (2, 3.0));
    let [failure] = report.failures.as_slice() else {
        panic!("{:?}", report.failures)
    };
    assert_eq!(failure.command, "SIMULATE/DYNAMIC, END=2, STEPS=4");
    assert_eq!(failure.outcome, report.outcome);
    assert!(
        failure.time > 1.25 && failure.time <= 1.5,
        "{}",
        failure.time
    );
    assert_eq!(log.matches("START: ERROR").count(), 1, "{log}");
    assert!(!log.contains("Finished -----"));
    // The output before, and the last good state.
    let times = &results.block("dynamic_002").unwrap().times;
    assert_eq!(*times, [1.25, failure.time]);
    assert_eq!(results.status.as_deref(), Some("Integration failed"));
    let stopping = commands.replacen("VARIABLE", "PREF/SIMFAIL=STOPCF\nVARIABLE", 1);
    let project = Project::load(&with_commands("stops", &stopping)).unwrap();
    let (report, results) = run(&project, RunOptions::default());
    assert!(matches!(report.outcome, Outcome::IntegrationFailed(_)));
    assert_eq!(report.simulations, 1);
    assert!(results.block("dynamic_003").is_none());
}

#[test]
fn a_file_may_be_called_again_but_not_by_itself() {
    let commands = "\nFILE/MODEL=slider\nFILE/COMMAND=push\nFILE/COMMAND=push\nSTOP\n";
    let file = with_commands("again", commands);
    let push = file.with_file_name("push.acf");
    std::fs::write(
        &push,
        "! one second\nSIMULATE/DYNAMIC, DURATION=1, STEPS=2\n",
    )
    .unwrap();
    let project = Project::load(&file).unwrap_or_else(|error| panic!("{error}"));
    let (report, _) = run(&project, RunOptions::default());
    assert_eq!((report.simulations, report.time), (2, 2.0));

    std::fs::write(&push, "\nFILE/COMMAND=again\n").unwrap();
    let error = Project::load(&file).unwrap_err().to_string();
    assert!(
        error.contains("push.acf:2:1: error[repeated-file]"),
        "{error}"
    );
    assert!(error.contains("again.acf calls itself"), "{error}");
}

#[test]
fn a_spline_with_errors_is_reported_where_it_stands() {
    for spline in [
        "X=0,1, Y=0,1",
        "X=0,2,1,3, Y=0,1,2,3",
        "X=0,1,2,3, Y=0,1,2",
        "X=0,1,2,3, Y=0,0,1,2,3, Y=0,0,1,2,3",
        "X=0,1,2,1E400, Y=0,1,2,3",
    ] {
        let text = SLIDER.replace("FUNCTION=6", "FUNCTION=AKISPL(TIME,0,1)");
        let text = text.replace("END\n", &format!("SPLINE/1, {spline}\nEND\n"));
        let message = crate::shared::refusal(&text);
        assert!(message.contains("model.adm:10:"), "{spline}: {message}");
    }
}

/// A contact is refused where a simulation would meet it, and nowhere else.
#[test]
fn contacts_are_refused_unless_they_are_deactivated() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("contact-input");
    std::fs::create_dir_all(&folder).unwrap();
    let contact = "CONTACT/7, IGEOM=1, JGEOM=2, IMPACT, STIFFNESS=1E5, DAMPING=10, DMAX=0.1\n\
                   , EXPONENT=2.2, COULOMB_FRICTION=ON, MU_STATIC=0.3, MU_DYNAMIC=0.1\n\
                   , STICTION_TRANSITION_VELOCITY=0.1, FRICTION_TRANSITION_VELOCITY=0.2\nEND";
    let model = SLIDER.replace("END", contact);
    std::fs::write(folder.join("slider.adm"), model).unwrap();
    let told = |name: &str, commands: &str| {
        let file = folder.join(name);
        std::fs::write(&file, commands).unwrap();
        let project = Project::load(&file).unwrap_or_else(|error| panic!("{error}"));
        stiction::Session::new(&project).map_or_else(|error| error.to_string(), |_| String::new())
    };
    let run = "SIMULATE/DYNAMIC, END=1, STEPS=4\n";
    let text = told("acting.acf", &format!("\nFILE/MODEL=slider\n{run}"));
    assert!(text.contains("slider.adm:10:1: error"), "{text}");
    assert!(text.contains("DEACTIVATE/CONTACT, ID = 7"), "{text}");
    let off = format!("\nFILE/MODEL=slider\nDEACTIVATE/CONTACT, ID=7\n{run}");
    assert_eq!(told("off.acf", &off), "");
    let again = format!("{off}ACTIVATE/CONTACT, RANGE=1, 9\nSIMULATE/DYNAMIC, END=2, STEPS=4\n");
    let text = told("again.acf", &again);
    assert!(
        text.contains("again.acf:5:1: error") && text.contains("CONTACT/7 acts here"),
        "{text}"
    );
    let alone = Project::load(&folder.join("slider.adm")).unwrap();
    let error = stiction::check(&alone).unwrap_err().to_string();
    assert!(error.contains("CONTACT/7 acts here"), "{error}");
    assert!(alone.simulation().is_err());
}

/// The level of a motion changes between two simulations, as the command files of turbines do it, and
/// the model is assembled again where the new function says.
#[test]
fn a_motion_changes_its_level_and_statements_are_listed() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("level-input");
    std::fs::create_dir_all(&folder).unwrap();
    std::fs::write(folder.join("crank.adm"), CRANK).unwrap();
    let commands = "\nFILE/MODEL=crank\nMOTION/1, VELOCITY, FUNCTION=2, ICDISP=0.5\n\
                    SIM/TRA, END=1, STEPS=5\nMOTION/1, DISPLACEMENT, FUNCTION=3*TIME, LIST\n\
                    MARKER/20, LIST\nSIM/TRA, END=2, STEPS=5\n";
    let file = folder.join("level.acf");
    std::fs::write(&file, commands).unwrap();
    let project = Project::load(&file).unwrap_or_else(|error| panic!("{error}"));
    let (report, results, log) = run_with_log(&project, RunOptions::default());
    assert_eq!(report.outcome, Outcome::Completed);
    let angle = results.column("PART_2_XFORM.PSI").unwrap();
    // The first is integrated, with the ERROR of 1e-2 of its INTEGRATOR; the second follows from
    // the constraint.
    for (block, expected, tolerance) in [
        ("kinematic_001", 2.5_f64, 1e-3),
        ("kinematic_002", 6.0, 1e-11),
    ] {
        let found = results.block(block).unwrap().column(angle).last().unwrap();
        let off = (found - expected).rem_euclid(std::f64::consts::TAU);
        assert!(
            off.min(std::f64::consts::TAU - off) < tolerance,
            "{block}: {found}"
        );
    }
    assert!(log.contains("  MOTION/1\n  , JOINT=1\n"), "{log}");
    assert!(log.contains("  MARKER/20, PART=2, QP=0.5, 0, 0\n"), "{log}");
}

/// An end that is over when its turn comes is a failure of that command alone; before the run it is
/// told of where nothing is expected to shorten a simulation.
#[test]
fn an_end_is_judged_when_its_turn_comes() {
    let commands = "
FILE/MODEL=slider
SIMULATE/DYNAMIC, END=1, STEPS=4
SIMULATE/STATIC, END=1, STEPS=4
SIMULATE/DYNAMIC, END=2, STEPS=4
";
    let file = with_commands("over", commands);
    let project = Project::load(&file).unwrap();
    let session = stiction::Session::new(&project).unwrap();
    let told: Vec<String> = session.warnings().iter().map(ToString::to_string).collect();
    let [told] = told.as_slice() else {
        panic!("{told:?}")
    };
    assert!(
        told.contains("over.acf:4:1: warning[out-of-range]: END = 1 is not after"),
        "{told}"
    );
    let (report, results, log) = run_with_log(&project, RunOptions::default());
    let Outcome::Refused(text) = &report.outcome else {
        panic!("{:?}", report.outcome)
    };
    assert!(
        text.contains("over.acf:4:1: error[out-of-range]: END = 1 is not after the time"),
        "{text}"
    );
    assert_eq!((report.simulations, report.time), (2, 2.0));
    assert_eq!(log.matches("START: ERROR").count(), 1, "{log}");
    assert!(results.block("dynamic_002").is_some());
    let stopping = commands.replacen("SIM", "PREFERENCES/SIMFAIL=STOPCF\nSIM", 1);
    let project = Project::load(&with_commands("over", &stopping)).unwrap();
    let (report, _) = run(&project, RunOptions::default());
    assert_eq!((report.simulations, report.time), (1, 1.0));

    // One that fails is run again from where it has stopped.
    let commands = "
FILE/MODEL=slider
VARIABLE/1, FUNCTION=SQRT(0.5-TIME)
SIMULATE/DYNAMIC, END=2, STEPS=4
VARIABLE/1, FUNCTION=0
SIMULATE/DYNAMIC, END=2, STEPS=4
";
    let project = Project::load(&with_commands("again2", commands)).unwrap();
    let (report, _) = run(&project, RunOptions::default());
    assert!(matches!(report.outcome, Outcome::IntegrationFailed(_)));
    assert_eq!((report.failures.len(), report.time), (1, 2.0));
}

/// Each analysis has its number.
#[test]
fn functions_are_told_the_analysis() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("mode-input");
    std::fs::create_dir_all(&folder).unwrap();
    let model = CRANK.replace("END\n", "REQUEST/1, F2=MODE\nEND\n");
    std::fs::write(folder.join("crank.adm"), model).unwrap();
    let commands = "\nFILE/MODEL=crank\nSIM/INITIAL\nSIM/KIN, END=1, STEPS=1\n\
                    SIM/TRA, END=2, STEPS=1\nSIM/DYN, END=3, STEPS=1\nSIM/STAT\n\
                    SIM/STAT, END=4, STEPS=1\nDEACTIVATE/MOTION, ID=1\n\
                    SIM/KIN, END=5, STEPS=1\n";
    let file = folder.join("mode.acf");
    std::fs::write(&file, commands).unwrap();
    let (report, results) = run(&Project::load(&file).unwrap(), RunOptions::default());
    assert_eq!(report.outcome, Outcome::Completed);
    let column = results.column("REQUEST_1.F2").unwrap();
    for (block, mode) in [
        ("initialConditions_001", 3.0),
        ("kinematic_001", 1.0),
        ("kinematic_002", 1.0),
        ("dynamic_001", 4.0),
        ("static_001", 5.0),
        ("quasiStatic_001", 6.0),
        ("dynamic_002", 4.0),
    ] {
        let found = results.block(block).unwrap().column(column).last();
        assert_eq!(found, Some(mode), "{block}");
    }
}

/// INFO tells what a REQUEST would report, without leaving a trace in the run; TIME tells the time.
#[test]
fn information_is_written_when_it_is_asked_for() {
    let commands = |asks: &str| {
        format!("\nFILE/MODEL=slider\nSIM/DYN, END=1, STEPS=4\n{asks}SIM/DYN, END=2, STEPS=4\n")
    };
    let asks = "INFO/VELOCITY, I=20, RM=1\nINF/FORCE, I=20\nTIME\n";
    let project = Project::load(&with_commands("info", &commands(asks))).unwrap();
    let (report, results, log) = run_with_log(&project, RunOptions::default());
    assert_eq!(report.outcome, Outcome::Completed, "{log}");
    let line = |component: &str| {
        let line = log.lines().find(|line| line.contains(component));
        line.unwrap_or_else(|| panic!("{component}: {log}"))
            .to_owned()
    };
    // 6 N on 2 kg for a second.
    assert!(line(" VZ ").contains("3.000000e0"), "{log}");
    assert!(line(" WX ").contains(" 0.000000e0"), "{log}");
    assert!(line(" FZ ").contains("6.000000e0"), "{log}");
    assert!(log.contains("time 1, "), "{log}");
    let project = Project::load(&with_commands("info", &commands(""))).unwrap();
    let (_, without) = run(&project, RunOptions::default());
    assert_eq!(results.data, without.data);
    let missing = commands("INFO/DISPLACEMENT, I=77\n");
    let project = Project::load(&with_commands("info", &missing)).unwrap();
    let error = stiction::Session::new(&project).unwrap_err().to_string();
    assert!(
        error.contains("info.acf:4:1: error[missing-element]"),
        "{error}"
    );
}

/// A force moves to other markers between two simulations.
#[test]
fn a_command_moves_a_force_to_other_markers() {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join("move-input");
    std::fs::create_dir_all(&folder).unwrap();
    let model = "Two sliders and a push
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=20, IP=1, 1, 1
MARKER/20, PART=2
PART/3, MASS=4, CM=30, IP=1, 1, 1
MARKER/30, PART=3
JOINT/1, TRANSLATIONAL, I=20, J=1
JOINT/2, TRANSLATIONAL, I=30, J=1
SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=8-0.0*VZ(20,30)
INTEGRATOR/GSTIFF, SI2, ERROR=1E-8
END
";
    std::fs::write(folder.join("two.adm"), model).unwrap();
    let file = folder.join("two.acf");
    let commands = "\nFILE/MODEL=two\nSIM/DYN, END=1, STEPS=2\nSFORCE/1, I=30, J=1\n\
                    SIM/DYN, END=2, STEPS=2\n";
    std::fs::write(&file, commands).unwrap();
    let (report, results) = run(&Project::load(&file).unwrap(), RunOptions::default());
    assert_eq!(report.outcome, Outcome::Completed);
    for (part, speeds) in [(2, [4.0, 4.0]), (3, [0.0, 2.0])] {
        let column = results.column(&format!("PART_{part}_XFORM.VZ")).unwrap();
        for (block, speed) in ["dynamic_001", "dynamic_002"].into_iter().zip(speeds) {
            let found = results.block(block).unwrap().column(column).last().unwrap();
            assert!((found - speed).abs() < 1e-7, "{part} {block}: {found}");
        }
    }
}
