//! SAVE and RELOAD: a run that goes on from what was saved gives the same bits.

use std::path::{Path, PathBuf};

use results::ResFile;
use stiction::{Outcome, Project, RunOptions, RunReport, Session};

use crate::shared::{GoOn, scratch_folder};

/// A wheel of many turns whose brake slips and sticks, a block on bristles, and a state that follows;
/// what drives them reads angles, states and reactions.
pub(crate) const MODEL: &str = "A brake, a block and a filter
ACCGRAV/JGRAV=-9.81
PART/1, GROUND
MARKER/1, PART=1
MARKER/3, PART=1, REULER=90D, 90D, 0
PART/2, MASS=2, CM=20, IP=0.5, 0.5, 0.5
MARKER/20, PART=2
PART/3, MASS=1, CM=30, IP=1, 1, 1
MARKER/30, PART=3, REULER=90D, 90D, 0
JOINT/1, REVOLUTE, I=20, J=1
JOINT/2, TRANSLATIONAL, I=30, J=3
FRICTION/1, JOINT=1, MU_STATIC=0.5, MU_DYNAMIC=0.4, INPUTS=PRELOAD, FRICTION_TORQUE_PRELOAD=1
, STICTION_TRANSITION_VELOCITY=0.05, MAX_STICTION_DEFORMATION=0.001
FRICTION/2, JOINT=2, FORMULATION=LUGRE, MU_STATIC=0.4, MU_DYNAMIC=0.3
, BRISTLE_STIFFNESS_COEFFICIENT=2000, DAMPING_COEFFICIENT=30
, VELOCITY_THRESHOLD_STRIBECK=0.05
VARIABLE/1, FUNCTION=8
VARIABLE/2, FUNCTION=1-0.1*VARVAL(2)**3-0.02*FY(30,3)
SFORCE/1, ROTATIONAL, I=20, J=1, FUNCTION=VARVAL(1)*SIN(5*TIME)+0.02*AZ(20,1)
SFORCE/2, TRANSLATIONAL, I=30, J=3, ACTIONONLY, FUNCTION=5*SIN(4*TIME)+DIF(1)+VARVAL(2)+0.1*SENVAL(2)
DIFF/1, IC=0.1, FUNCTION=-3*DIF(1)+DZ(30,3)
SENSOR/2, GE, VALUE=0.3, ERROR=1E-3, FUNCTION=TIME\\, EVALUATE=WZ(20)
SENSOR/1, GE, VALUE=1, ERROR=1E-3, FUNCTION=TIME\\, PRINT
INTEGRATOR/GSTIFF, SI2, ERROR=1E-6
END
";

/// A folder with the model and a command file.
fn with_commands(commands: &str) -> PathBuf {
    let folder = scratch_folder();
    std::fs::write(folder.join("brake.adm"), MODEL).unwrap();
    let file = folder.join("case.acf");
    std::fs::write(&file, format!("\nFILE/MODEL=brake\n{commands}")).unwrap();
    file
}

/// Carries out a command file; its results go where it is.
fn carry_out(file: &Path) -> RunReport {
    let project = Project::load(file).unwrap_or_else(|error| panic!("{error}"));
    let session = Session::new(&project).unwrap_or_else(|error| panic!("{error}"));
    let folder = file.parent().unwrap();
    session
        .run(folder, RunOptions::default(), &mut GoOn)
        .unwrap()
}

/// Times and rows of a block, as bits.
fn rows(file: &Path, block: &str) -> Vec<Vec<u64>> {
    let results = ResFile::read(file).unwrap();
    let block = results.block(block).unwrap_or_else(|| panic!("{block}"));
    let row = |k: usize| {
        let all = [block.times[k]].into_iter();
        let all = all.chain(block.row(k).iter().copied());
        all.map(f64::to_bits).collect()
    };
    (0..block.times.len()).map(row).collect()
}

const FIRST: &str = "SIM/DYN, END=0.7, STEPS=14\nVARIABLE/1, FUNCTION=12 &\n +\
                     STEP(TIME,0.7,0,1,2) ! more\nDEACTIVATE/SENSOR, ID=1\n";
const SECOND: &str = "SIM/DYN, END=1.3, STEPS=12\nVARIABLE/1, FUNCTION=3*WZ(20)\n\
                      SIM/DYN, DURATION=0.5, STEPS=5\n";

#[test]
fn a_run_goes_on_from_a_saved_system_bit_for_bit() {
    let save = "SAVE/SYSTEM, FILE=half way.sav\n";
    let whole = with_commands(&format!("{FIRST}{save}{SECOND}"));
    let report = carry_out(&whole);
    assert_eq!(report.outcome, Outcome::Completed, "{:?}", report.failures);
    let folder = whole.parent().unwrap();
    let expected = [2, 3].map(|k| rows(&folder.join("brake.res"), &format!("dynamic_00{k}")));
    assert_eq!([expected[0].len(), expected[1].len()], [12, 5]);
    // Both frictions slip and stick meanwhile, and the wheel has turned further than once.
    for friction in &report.frictions {
        assert!(friction.tally.sticks > 1, "{friction:?}");
        assert!(friction.regimes[0] > 0 && friction.regimes[2] > 0);
    }

    // A later run, with a command that the first did not have and outputs of its own.
    let later = with_commands(&format!(
        "RELOAD/SYSTEM, FILE=half way.sav\n{SECOND}VARIABLE/1, FUNCTION=FX(20,1)\n\
         SIM/DYN, DURATION=0.1, STEPS=1\n"
    ));
    let saved = folder.join("half way.sav");
    std::fs::copy(&saved, later.with_file_name("half way.sav")).unwrap();
    let report = carry_out(&later);
    assert_eq!(report.outcome, Outcome::Completed, "{:?}", report.failures);
    let results = later.with_file_name("brake.res");
    let initial = ResFile::read(&results).unwrap();
    assert_eq!(initial.block("initialConditions_001").unwrap().times, [0.7]);
    for (k, expected) in expected.iter().enumerate() {
        let found = rows(&results, &format!("dynamic_00{}", k + 1));
        assert!(&found == expected, "simulation {}", k + 2);
    }

    // The same run, into files of their own; twice from the same state.
    let again = with_commands(&format!(
        "{FIRST}{save}{SECOND}RELOAD/SYS, FIL=half way.sav, OUT=second\n{SECOND}\
         SAVE/STATES, BUFFER=end\nRELOAD/SYSTEM, FILE=half way.sav\n{SECOND}"
    ));
    let report = carry_out(&again);
    assert_eq!(report.outcome, Outcome::Completed, "{:?}", report.failures);
    assert_eq!((report.simulations, report.files.len()), (7, 5));
    for (file, first) in [("brake.res", 2), ("second.res", 1), ("second.res", 3)] {
        for (k, expected) in expected.iter().enumerate() {
            let block = format!("dynamic_00{}", first + k);
            let found = rows(&again.with_file_name(file), &block);
            assert!(&found == expected, "{file} {block}");
        }
    }
    for file in [whole, later, again] {
        std::fs::remove_dir_all(file.parent().unwrap()).unwrap();
    }
}

/// STATES keeps the state and leaves the model as it has been changed since; an equilibrium is gone on
/// from, and elements may have been switched.
#[test]
fn states_are_reloaded_into_the_model_as_it_is() {
    let file = with_commands(
        "SIM/DYN, END=0.2, STEPS=2\nSAVE/STATES, BUFFER=a\nSIM/DYN, END=0.4, STEPS=2\n\
         VARIABLE/1, FUNCTION=0\nDEACTIVATE/FRICTION, ID=1\nSIM/DYN, END=0.5, STEPS=1\n\
         RELOAD/STATES, BUFFER=a\nSIM/DYN, END=0.3, STEPS=1\nDEACTIVATE/JOINT, ID=2\n\
         RELOAD/STATES, BUFFER=a\nSIM/DYN, END=0.3, STEPS=1\n",
    );
    let report = carry_out(&file);
    assert_eq!(report.outcome, Outcome::Completed, "{:?}", report.failures);
    assert_eq!((report.simulations, report.time), (5, 0.3));
    let results = ResFile::read(file.with_file_name("brake.res")).unwrap();
    let speed = results.column("PART_2_XFORM.WZ").unwrap();
    let last = |block: &str| {
        let block = results.block(block).unwrap();
        block.column(speed).last().unwrap()
    };
    // Without torque and brake the wheel all but keeps the speed that was saved.
    let (saved, kept) = (last("dynamic_001"), last("dynamic_004"));
    assert!(saved.abs() > 0.1, "{saved}");
    assert!((kept / saved - 1.0).abs() < 0.02, "{saved} {kept}");
    // The free block falls: half g t² in 0.1 s from where it stood at 0.2.
    let height = results.column("PART_3_XFORM.Y").unwrap();
    let fallen = results.block("dynamic_005").unwrap().column(height).last();
    assert!((fallen.unwrap() + 0.5 * 9.81 * 0.01).abs() < 1e-4);
    std::fs::remove_dir_all(file.parent().unwrap()).unwrap();
}

/// What is saved before the model is assembled is the model itself.
#[test]
fn the_model_as_it_is_given_can_be_saved() {
    let file = with_commands(
        "SAVE/STATES, BUFFER=a\nSIM/DYN, END=0.2, STEPS=2\nRELOAD/STATES, BUFFER=a\n\
         SIM/DYN, END=0.2, STEPS=2\n",
    );
    let report = carry_out(&file);
    assert_eq!(report.outcome, Outcome::Completed, "{:?}", report.failures);
    let results = file.with_file_name("brake.res");
    let expected = rows(&results, "dynamic_001");
    assert_eq!(expected.len(), 2);
    assert_eq!(rows(&results, "dynamic_002"), expected);
    std::fs::remove_dir_all(file.parent().unwrap()).unwrap();
}

#[test]
fn what_cannot_be_reloaded_is_refused_with_a_sentence() {
    let save = with_commands("SIM/DYN, END=0.1, STEPS=1\nSAVE/SYSTEM, FILE=a.sav\n");
    assert_eq!(carry_out(&save).outcome, Outcome::Completed);
    let folder = save.parent().unwrap().to_owned();
    let text = std::fs::read_to_string(folder.join("a.sav")).unwrap();
    std::fs::write(
        folder.join("edited.sav"),
        text.replacen("\"time\": 0.1", "\"time\": 0.2", 1),
    )
    .unwrap();
    std::fs::write(
        folder.join("later.sav"),
        text.replacen("format 1", "format 2", 1),
    )
    .unwrap();
    std::fs::write(folder.join("cut.sav"), &text[..text.len() / 2]).unwrap();
    std::fs::write(folder.join("empty.sav"), "").unwrap();
    std::fs::write(folder.join("brake.txt"), "notes").unwrap();
    let told = |commands: &str| {
        std::fs::write(&save, format!("\nFILE/MODEL=brake\n{commands}\n")).unwrap();
        let project = Project::load(&save).unwrap_or_else(|error| panic!("{error}"));
        match Session::new(&project) {
            Err(error) => error.to_string(),
            Ok(session) => {
                let report = session
                    .run(&folder, RunOptions::default(), &mut GoOn)
                    .unwrap();
                match report.outcome {
                    Outcome::Refused(text) => text,
                    other => panic!("{commands}: {other:?}"),
                }
            }
        }
    };
    for (commands, words) in [
        ("RELOAD/SYSTEM, FILE=edited.sav", "damaged or was edited"),
        ("RELOAD/SYSTEM, FILE=cut.sav", "damaged or was edited"),
        ("RELOAD/SYSTEM, FILE=later.sav", "another version"),
        ("RELOAD/SYSTEM, FILE=empty.sav", "SAVE has written"),
        ("RELOAD/SYSTEM, FILE=brake.adm", "SAVE has written"),
        ("RELOAD/SYSTEM, FILE=none.sav", "there is no "),
        ("RELOAD/STATES, BUFFER=none", "nothing has been saved"),
        ("SAVE/SYSTEM, FILE=brake.txt", "is not overwritten"),
        ("SAVE/SYSTEM, FILE=nowhere/a.sav", "cannot be written"),
        (
            "RELOAD/SYSTEM, FILE=a.sav, OUTPUT_PREFIX=brake",
            "names no other files",
        ),
        (
            "RELOAD/SYSTEM, FILE=a.sav\nSIM/DYN, END=0.05, STEPS=1",
            "not after the time",
        ),
    ] {
        let text = told(commands);
        let line = if commands.contains('\n') { 4 } else { 3 };
        let place = format!("case.acf:{line}:1: error[");
        assert!(text.contains(&place) && text.contains(words), "{text}");
    }
    assert_eq!(
        std::fs::read_to_string(folder.join("brake.txt")).unwrap(),
        "notes"
    );
    // Another model, and the same with another value.
    std::fs::write(folder.join("brake.adm"), MODEL.replace("=8\n", "=9\n")).unwrap();
    assert!(told("RELOAD/SYSTEM, FILE=a.sav").contains("of another model"));
    std::fs::remove_dir_all(folder).unwrap();
}
