//! What changes and is asked for while a run goes on: ACTIVATE and DEACTIVATE, LIST, `FRICTION` in
//! requests, and sensors.

use stiction::{Outcome, Session};

use crate::runs::{Run, run_commands, with_commands};

/// A block that is pulled along z over a rough guide and driven about nothing else.
const BLOCK: &str = "A block in a guide
UNITS/SYSTEM=MKS
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=20, IP=1, 1, 1
MARKER/20, PART=2
JOINT/1, TRANSLATIONAL, I=20, J=1
FRICTION/7, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2, INITIAL_OVERLAP=10
SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=10
SPRINGDAMPER/1, TRANSLATIONAL, I=20, J=1, K=0, C=0, LENGTH=0, FORCE=0
ACCGRAV/JGRAV=-10
INTEGRATOR/GSTIFF, SI2, ERROR=1E-8
";

/// The last value of a component in a block.
fn last(run: &Run, block: &str, name: &str) -> f64 {
    let column = run.results.column(name).unwrap();
    let block = run.results.block(block).unwrap();
    block.column(column).last().unwrap()
}

/// Acceleration of the block along an axis at the end of a block of results.
fn acceleration(run: &Run, block: usize, axis: &str) -> f64 {
    let name = format!("PART_2_XFORM.ACC{axis}");
    last(run, &format!("dynamic_00{block}"), &name)
}

#[test]
fn elements_act_while_they_are_active() {
    let commands = "
SIMULATE/DYNAMIC, DURATION=0.5, STEPS=5
DEACTIVATE/FRICTION, ID=7
SIMULATE/DYNAMIC, DURATION=0.5, STEPS=5
DEACTIVATE/SFORCE, RANGE=1,10
SIMULATE/DYNAMIC, DURATION=0.5, STEPS=5
ACTIVATE/SFORCE, ID=1
ACTIVATE/FRICTION, ID=7
SIMULATE/DYNAMIC, DURATION=0.5, STEPS=5
DEACTIVATE/JOINT, ID=1
SIMULATE/DYNAMIC, DURATION=0.5, STEPS=5
";
    let project = with_commands(BLOCK, commands).unwrap();
    let session = Session::new(&project).unwrap();
    let warnings: String = session.warnings().iter().map(|w| w.to_string()).collect();
    assert!(
        warnings.contains("run.acf:12:1: warning[deactivated]: FRICTION/7 rests with its JOINT/1"),
        "{warnings}"
    );
    let run = Run::of(&project);
    assert_eq!(run.report.outcome, Outcome::Completed, "{}", run.messages);
    // 10 N on 2 kg, with friction of 0.2 * 20 N where it acts; free fall without the joint. The
    // accelerations are those of an instant, exact but for rounding.
    let along = [3.0, 5.0, 0.0, 3.0, 5.0];
    let across = [0.0, 0.0, 0.0, 0.0, -10.0];
    for block in 0..5 {
        let [z, y] = ["Z", "Y"].map(|axis| acceleration(&run, block + 1, axis));
        println!("block {}: {z} along, {y} across", block + 1);
        assert!((z - along[block]).abs() < 1e-9, "{block}: {z}");
        assert!((y - across[block]).abs() < 1e-9, "{block}: {y}");
    }
    // What rests reports nothing.
    for (block, name) in [
        ("dynamic_002", "FRICTION_7.FZ"),
        ("dynamic_003", "SFORCE_1.FZ"),
        ("dynamic_005", "JOINT_1.FY"),
        ("dynamic_005", "FRICTION_7.FZ"),
    ] {
        assert_eq!(last(&run, block, name), 0.0, "{block} {name}");
    }
    // Velocities go on from one simulation to the next: (5 + 0 + 3 + 5) * 0.5. The tolerance is
    // 1e-8 a step, relative to the largest velocity.
    let speed = |block| last(&run, block, "PART_2_XFORM.VZ");
    let gained = speed("dynamic_005") - speed("dynamic_001");
    assert!((gained - 6.5).abs() < 1e-6, "{gained}");
}

#[test]
fn arguments_of_a_friction_act_from_their_command_on() {
    let commands = "
SIMULATE/DYNAMIC, DURATION=0.5, STEPS=5
FRICTION/7, MU_DYNAMIC=0.1
SIMULATE/DYNAMIC, DURATION=0.5, STEPS=5
FRICTION/7, MAX_FRICTION_FORCE=1
SIMULATE/DYNAMIC, DURATION=0.5, STEPS=5
FRICTION/7, FRICTION_FORCE_PRELOAD=3
SIMULATE/DYNAMIC, DURATION=0.5, STEPS=5
FRICTION/7, INPUTS=NONE
SIMULATE/DYNAMIC, DURATION=0.5, STEPS=5
";
    let lugre = BLOCK.replace(
        "INITIAL_OVERLAP=10",
        "FORMULATION=LUGRE, DAMPING_COEFFICIENT=1, INITIAL_OVERLAP=10",
    );
    for (dataset, tolerance) in [
        (BLOCK, 1e-9),
        // The bristles settle over a length of Fd/s0 = 4e-4 m, far less than the block slides; a
        // billionth of a friction remains where there is no load.
        (lugre.as_str(), 1e-8),
    ] {
        let run = run_commands(dataset, commands);
        assert_eq!(run.report.outcome, Outcome::Completed, "{}", run.messages);
        // 10 N less the friction on 2 kg: 0.2 and 0.1 of 20 N, the limit of 1 N, this and the
        // preload of 3 N, and nothing.
        for (place, friction) in [4.0, 2.0, 1.0, 4.0, 0.0].into_iter().enumerate() {
            let found = acceleration(&run, place + 1, "Z");
            println!("friction {friction} N: acceleration {found}");
            assert!((found - 0.5 * (10.0 - friction)).abs() < tolerance);
        }
    }
}

#[test]
fn a_joint_can_rest_from_the_start() {
    let run = run_commands(
        BLOCK,
        "DEACTIVATE/JOINT, ID=1\nSIMULATE/DYNAMIC, END=0.5, STEPS=5",
    );
    assert_eq!(run.report.outcome, Outcome::Completed, "{}", run.messages);
    assert!(run.messages.contains("6 degrees of freedom"));
    assert!((acceleration(&run, 1, "Y") + 10.0).abs() < 1e-9);
}

#[test]
fn an_overlap_that_is_used_up_is_told_once() {
    let dataset = BLOCK.replace(
        "INITIAL_OVERLAP=10",
        "INITIAL_OVERLAP=0.1, OVERLAP_DELTA=DECREASE",
    );
    let run = run_commands(&dataset, "SIMULATE/DYNAMIC, END=1, STEPS=100");
    assert_eq!(run.report.outcome, Outcome::Completed, "{}", run.messages);
    let told: Vec<&str> = run.messages.matches("is used up at time").collect();
    assert_eq!(told.len(), 1, "{}", run.messages);
    assert!(
        run.messages
            .contains("FRICTION/7: the overlap of its joint")
    );
    // z passes 0.1 at about sqrt(2 * 0.1 / 3) = 0.26, a little later as it starts in stiction.
    let (_, time) = run.messages.split_once("is used up at time ").unwrap();
    let time: f64 = time.split(';').next().unwrap().parse().unwrap();
    assert!((0.25..0.32).contains(&time), "{time}");
}

#[test]
fn motions_and_constraints_are_let_go() {
    let dataset = "A block that is driven
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=20, IP=1, 1, 1
MARKER/20, PART=2
JPRIM/1, ORIENTATION, I=20, J=1
JPRIM/2, INLINE, I=20, J=1
MOTION/1, I=20, J=1, Z, DISPLACEMENT, FUNCTION=TIME
MOTION/2, I=20, J=1, B1, DISPLACEMENT, FUNCTION=0
GCON/1, I=20, FUNCTION=DX(20)
ACCGRAV/JGRAV=-10, KGRAV=4
INTEGRATOR/GSTIFF, SI2, ERROR=1E-8
";
    let commands = "
SIMULATE/DYNAMIC, DURATION=0.5, STEPS=5
DEACTIVATE/MOTION, ID=1, 2
SIMULATE/DYNAMIC, DURATION=0.5, STEPS=5
DEACTIVATE/JPRIM, ID=2
DEACTIVATE/GCON, ID=1
SIMULATE/DYNAMIC, DURATION=0.5, STEPS=5
";
    let run = run_commands(dataset, commands);
    assert_eq!(run.report.outcome, Outcome::Completed, "{}", run.messages);
    for (block, along, across) in [(1, 0.0, 0.0), (2, 4.0, 0.0), (3, 4.0, -10.0)] {
        assert!((acceleration(&run, block, "Z") - along).abs() < 1e-9);
        assert!((acceleration(&run, block, "Y") - across).abs() < 1e-9);
    }
    // It keeps the speed of 1 with which the motion let it go: 1 + 4 * 0.5.
    let speed = last(&run, "dynamic_002", "PART_2_XFORM.VZ");
    assert!((speed - 3.0).abs() < 1e-6, "{speed}");
}

#[test]
fn a_friction_on_a_deactivated_joint_is_not_activated() {
    let commands = "DEACTIVATE/JOINT, ID=1\nACTIVATE/FRICTION, ID=7\nDEACTIVATE/JOINT, ID=4";
    let project = with_commands(BLOCK, commands).unwrap();
    let text = Session::new(&project).unwrap_err().to_string();
    for expected in [
        "run.acf:4:1: error[deactivated]: FRICTION/7 cannot be activated: its JOINT/1 is deactivated",
        "run.acf:5:22: error[missing-element]: there is no JOINT/4",
    ] {
        assert!(text.contains(expected), "{text}");
    }
}

#[test]
fn list_writes_the_values_in_force_with_their_units() {
    let commands = "
FRICTION/7, LIST
FRICTION/7, MU_STATIC=0.5, REACTION_ARM=0.02, INPUTS=REACTION_FORCE:TORSIONAL_MOMENT, LIST
DEACTIVATE/FRICTION, ID=7
FRICTION/7, LIST
";
    let run = run_commands(BLOCK, commands);
    let messages = &run.messages;
    let listings: Vec<&str> = messages.split("command: FRICTION/7").skip(1).collect();
    let row = |listing: usize, start: &str| {
        let words = |line: &str| line.split_whitespace().collect::<Vec<_>>().join(" ");
        let rows = listings[listing].lines().map(words);
        rows.into_iter()
            .find(|row| row.starts_with(start))
            .unwrap_or_else(|| panic!("{start}: {}", listings[listing]))
    };
    println!("{}", listings[1]);
    for (listing, expected) in [
        (
            0,
            "FRICTION/7 (FRICTION_7) in the TRANSLATIONAL JOINT/1 (JOINT_1)",
        ),
        (0, "FORMULATION ORIGINAL"),
        (0, "MU_STATIC 0.3"),
        (0, "INPUTS ALL"),
        (0, "STICTION_TRANSITION_VELOCITY 0.1 meter/sec default"),
        (0, "INITIAL_OVERLAP 10 meter"),
        (0, "MAX_FRICTION_FORCE 1e40 newton default"),
        (0, "PIN_RADIUS 1 meter not used by a TRANSLATIONAL joint"),
        (
            0,
            "BRISTLE_STIFFNESS_COEFFICIENT 10000 newton/meter not used by FORMULATION = ORIGINAL",
        ),
        (1, "MU_STATIC 0.5"),
        (1, "MU_DYNAMIC 0.2"),
        (1, "INPUTS REACTION_FORCE:TORSIONAL_MOMENT"),
        (1, "REACTION_ARM 0.02 meter"),
        (
            1,
            "INITIAL_OVERLAP 10 meter not used by INPUTS without BENDING_MOMENT",
        ),
        (
            2,
            "FRICTION/7 (FRICTION_7) in the TRANSLATIONAL JOINT/1 (JOINT_1), deactivated",
        ),
    ] {
        let found = row(listing, expected.split(' ').next().unwrap());
        assert_eq!(found, expected);
    }
    // Every argument with a default is there.
    for quantity in dataset::FrictionQuantity::ALL {
        row(0, quantity.keyword());
    }
}

#[test]
fn requests_read_every_component_of_a_friction() {
    let mut dataset = BLOCK.to_owned();
    for first in (1..=26).step_by(8) {
        dataset += &format!("REQUEST/{first}");
        for index in first..(first + 8).min(27) {
            dataset += &format!(", F{}=FRICTION(7, {index})\\", index - first + 1);
        }
        dataset.push('\n');
    }
    let run = run_commands(&dataset, "SIMULATE/DYNAMIC, END=0.2, STEPS=20");
    let friction = run
        .results
        .entities
        .iter()
        .position(|entity| entity.kind == "Friction")
        .unwrap();
    let block = run.results.block("dynamic_001").unwrap();
    let mut told = 0;
    for index in 1..=26 {
        let own: Vec<f64> = block
            .column(run.results.column_of(friction, index - 1))
            .collect();
        let first = (index - 1) / 8 * 8 + 1;
        let name = format!("REQUEST_{first}.F{}", index - first + 1);
        let column = run.results.column(&name).unwrap();
        let requested: Vec<f64> = block.column(column).collect();
        assert_eq!(requested, own, "FRICTION(7, {index})");
        told += usize::from(own.iter().any(|value| *value != 0.0));
    }
    // FZ, MUZ, MU1, VZ, CREEP_Z and BETA of a translational joint.
    assert_eq!(told, 6);
}

#[test]
fn sensors_end_simulations_and_runs() {
    // 3 m/s^2 but for a short start: the block passes 1 m/s at about 0.33 s.
    let sensor = |rest: &str| format!("{BLOCK}SENSOR/4, {rest}\n");
    let commands = "SIMULATE/DYNAMIC, END=1, STEPS=100\nDEACTIVATE/SENSOR, ID=4\n\
                    SIMULATE/DYNAMIC, DURATION=0.1, STEPS=10";
    let returned = run_commands(
        &sensor("GE, VALUE=1, ERROR=1E-6, RETURN, FUNCTION=VZ(20)"),
        commands,
    );
    assert_eq!(returned.report.outcome, Outcome::Completed);
    assert_eq!(returned.report.simulations, 2);
    let first = returned.results.block("dynamic_001").unwrap();
    let column = returned.results.column("PART_2_XFORM.VZ").unwrap();
    let speeds: Vec<f64> = first.column(column).collect();
    let (end, before) = (speeds[speeds.len() - 1], speeds[speeds.len() - 2]);
    assert!(before < 1.0 && end >= 1.0 - 1e-6, "{before} {end}");
    let ended = *first.times.last().unwrap();
    let second = returned.results.block("dynamic_002").unwrap();
    // The next command goes on from there.
    assert!((second.times[0] - ended - 0.01).abs() < 1e-12);
    assert_eq!(second.times.len(), 10);
    let event = format!("SENSOR/4 at time {ended}");
    assert!(returned.messages.contains(&event), "{}", returned.messages);

    // What is not a number is neither above nor below.
    let unknown = run_commands(
        &sensor("GE, VALUE=1, ERROR=1E-6, RETURN, FUNCTION=SQRT(0.5-TIME)"),
        commands,
    );
    assert!(matches!(
        unknown.report.outcome,
        Outcome::IntegrationFailed(_)
    ));
    let said = "SENSOR/4 at time 0.51: its function is not a number";
    assert!(unknown.messages.contains(said), "{}", unknown.messages);

    // The first simulation may be taken up again to its own end.
    let again = run_commands(
        &sensor("GE, VALUE=1, ERROR=1E-6, RETURN, FUNCTION=VZ(20)"),
        "SIMULATE/DYNAMIC, END=1, STEPS=100\nDEACTIVATE/SENSOR, ID=4\n\
         SIMULATE/DYNAMIC, END=1, STEPS=10",
    );
    assert_eq!(again.report.outcome, Outcome::Completed);
    assert_eq!((again.report.simulations, again.report.time), (2, 1.0));

    // EQ takes a passage between two outputs; FRICTION(7, 26) is BETA, 1 once the block slides.
    for rest in [
        "EQ, VALUE=1, ERROR=1E-9, HALT, FUNCTION=VZ(20)",
        "EQ, VALUE=1, ERROR=1E-9, HALT, FUNCTION=FRICTION(7, 26)",
        "LE, VALUE=-1, ERROR=1E-9, HALT, FUNCTION=-VZ(20)",
    ] {
        let halted = run_commands(&sensor(rest), commands);
        assert_eq!(halted.report.outcome, Outcome::Completed, "{rest}");
        assert_eq!(halted.report.simulations, 1, "{rest}");
        assert!(halted.report.time < 0.5, "{rest}");
    }

    // PRINT tells once, when the event begins.
    let printed = run_commands(
        &sensor("GE, VALUE=1, PRINT, FUNCTION=VZ(20)"),
        "SIMULATE/DYNAMIC, END=1, STEPS=100",
    );
    assert_eq!(printed.report.time, 1.0);
    assert_eq!(printed.messages.matches("SENSOR/4 at time").count(), 1);
}

/// A sensor keeps its EVALUATE from the event on, for forces and outputs, into later simulations.
#[test]
fn functions_read_what_a_sensor_has_kept() {
    let model = "A block that is pushed less once it is fast
PART/1, GROUND
MARKER/1, PART=1
PART/2, MASS=2, CM=20, IP=1, 1, 1
MARKER/20, PART=2
JOINT/1, TRANSLATIONAL, I=20, J=1
SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=4-4*SENVAL(1)
SENSOR/1, GE, VALUE=1, ERROR=1E-6, FUNCTION=VZ(20)\\, EVALUATE=TIME*SENVAL(2)
SENSOR/2, GE, VALUE=0.1, ERROR=1E-6, FUNCTION=TIME\\, EVALUATE=1
SENSOR/3, GE, VALUE=9, RETURN, FUNCTION=VZ(20)
REQUEST/1, F2=SENVAL(1)\\F3=SENVAL(3)
INTEGRATOR/GSTIFF, SI2, ERROR=1E-8
";
    let run = run_commands(
        model,
        "SIMULATE/DYNAMIC, END=0.8, STEPS=80\nDEACTIVATE/SENSOR, ID=1\n\
         SIMULATE/DYNAMIC, END=1, STEPS=20",
    );
    assert_eq!(run.report.outcome, Outcome::Completed, "{}", run.messages);
    assert_eq!(run.report.simulations, 2);
    let first = run.results.block("dynamic_001").unwrap();
    assert_eq!(first.times.len(), 80);
    let kept: Vec<f64> = first
        .column(run.results.column("REQUEST_1.F2").unwrap())
        .collect();
    // 2 m/s^2 reach 1 m/s at 0.5 s, whose row was written before the event.
    assert!(kept[..50].iter().all(|value| *value == 0.0));
    assert!(kept[50..].iter().all(|value| (value - 0.5).abs() < 1e-12));
    assert_eq!(last(&run, "dynamic_001", "REQUEST_1.F3"), 0.0);
    // 1 m/s^2 from there on.
    for (block, speed) in [("dynamic_001", 1.3), ("dynamic_002", 1.5)] {
        let found = last(&run, block, "PART_2_XFORM.VZ");
        assert!((found - speed).abs() < 1e-7, "{block}: {found}");
    }
    let told = run.messages.matches("SENVAL(1) is 0.5").count();
    assert_eq!(told, 1, "{}", run.messages);
}

#[test]
fn a_function_without_a_finite_value_is_named_and_not_the_mechanism() {
    let slider = "A slider\nPART/1, GROUND\nMARKER/1, PART=1\nPART/2, MASS=2, CM=20, IP=1, 1, 1
MARKER/20, PART=2\nJOINT/1, TRANSLATIONAL, I=20, J=1
SFORCE/1, TRANSLATIONAL, I=20, J=1, ACTIONONLY, FUNCTION=";
    let folder = crate::shared::scratch_folder();
    let file = folder.join("model.adm");
    std::fs::write(&file, format!("{slider}1/(TIME-0.5)\nEND\n")).unwrap();
    let mut project = stiction::Project::load(&file).unwrap();
    project.push_dynamic(1.0, Some(10), None);
    let (report, _, log) = crate::shared::run_with_log(&project, stiction::RunOptions::default());
    assert_ne!(report.outcome, stiction::Outcome::Completed);
    assert!(
        log.contains("SFORCE/1 gives a value or slope that is not"),
        "{log}"
    );

    // A root at zero has no slope there; 2 z'' = 10 - |z|^0.5 starts with 5.
    let results = crate::shared::run_text(
        &format!("{slider}10-ABS(DZ(20,1))**0.5\nEND\n"),
        0.1,
        2,
        Some(1e-8),
    );
    // z = 2.5 t² - ∫∫ √(2.5) t / 2 = 0.025 - 0.2635e-3 / 2 at 0.1, the next term 1e-6 at most.
    let z = *results.get("PART_2_XFORM.Z").unwrap().last().unwrap();
    assert!(
        (z - (0.025 - 2.5_f64.sqrt() * 1e-3 / 12.0)).abs() < 2e-6,
        "{z}"
    );
}
