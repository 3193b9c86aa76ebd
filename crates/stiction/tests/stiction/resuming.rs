//! Checkpoints: a run that was interrupted anywhere and resumed writes the same bytes.

use std::path::{Path, PathBuf};
use std::time::Duration;

use mechanics::model::Reactions;
use results::ResFile;
use stiction::{
    CheckpointError, Method, Outcome, Progress, Project, ResumeError, RunOptions, Session, Watch,
};

use crate::saving::MODEL;
use crate::shared::{GoOn, scratch_folder};

/// Stops a run after so many reports of progress.
pub(crate) struct StopAfter(pub(crate) usize);

impl Watch for StopAfter {
    fn progress(&mut self, _: &Progress) -> bool {
        self.0 = self.0.saturating_sub(1);
        self.0 > 0
    }
}

/// Checkpoints only where the run is interrupted, but for the first.
const SELDOM: RunOptions = RunOptions {
    error: None,
    method: None,
    reactions: Reactions::OfKept,
    checkpoint: Some(Duration::MAX),
    text_results: true,
    check_accuracy: false,
};
/// Checkpoints after every step.
const ALWAYS: RunOptions = RunOptions {
    error: None,
    method: None,
    reactions: Reactions::OfKept,
    checkpoint: Some(Duration::ZERO),
    text_results: true,
    check_accuracy: false,
};

/// A project of a dataset `model.adm` and commands.
pub(crate) fn project(dataset: &str, commands: &str) -> Project {
    let folder = scratch_folder();
    std::fs::write(folder.join("model.adm"), dataset).unwrap();
    let file = folder.join("run.acf");
    std::fs::write(&file, format!("\nFILE/MODEL=model\n{commands}")).unwrap();
    Project::load(&file).unwrap_or_else(|error| panic!("{error}"))
}

/// The bytes of all results, and the message file without what depends on the clock.
fn files(folder: &Path) -> Vec<(PathBuf, String)> {
    let entries = std::fs::read_dir(folder).unwrap();
    let mut files: Vec<(PathBuf, String)> = entries
        .map(|entry| {
            let path = entry.unwrap().path();
            let text = std::fs::read_to_string(&path).unwrap();
            let text = match path.extension().and_then(|e| e.to_str()) {
                Some("msg") => text.lines().map(untimed).collect(),
                _ => text,
            };
            (path.file_name().unwrap().into(), text)
        })
        .collect();
    files.sort();
    files
}

/// A line of the message file without times of the clock.
fn untimed(line: &str) -> String {
    let words: Vec<&str> = line.split_whitespace().collect();
    let is_row = words.len() == 6 && words.iter().all(|word| word.parse::<f64>().is_ok());
    let line = if is_row {
        words[..5].join(" ")
    } else if ["Elapsed", "Process", "saved in", "back at"]
        .iter()
        .any(|word| line.contains(word))
    {
        // A time, a number of the system, and the path of the folder.
        String::new()
    } else {
        line.to_owned()
    };
    line + "\n"
}

/// Runs a project at one go.
pub(crate) fn at_one_go(project: &Project, options: RunOptions) -> Vec<(PathBuf, String)> {
    let folder = scratch_folder();
    let session = Session::new(project).unwrap_or_else(|error| panic!("{error}"));
    let report = session.run(&folder, options, &mut GoOn).unwrap();
    assert_eq!(report.outcome, Outcome::Completed);
    files(&folder)
}

/// Runs a project, interrupted again and again after `steps` reports of progress each; returns its
/// files and how often it was resumed.
fn in_pieces(
    project: &Project,
    reactions: Reactions,
    steps: usize,
) -> (Vec<(PathBuf, String)>, usize) {
    let options = RunOptions {
        reactions,
        ..SELDOM
    };
    let folder = scratch_folder();
    let mut session = Session::new(project).unwrap();
    let mut report = session
        .run(&folder, options, &mut StopAfter(steps))
        .unwrap();
    let mut times = 0;
    while report.outcome == Outcome::Interrupted {
        // What is readable is what was written so far.
        for file in report
            .files
            .iter()
            .filter(|file| file.extension() == Some("res".as_ref()))
        {
            let part = ResFile::read(file).unwrap();
            assert!(part.status.is_some());
        }
        // Everything but the files is new.
        session = Session::new(project).unwrap();
        report = session
            .resume(&folder, options, &mut StopAfter(steps))
            .unwrap();
        times += 1;
    }
    assert_eq!(report.outcome, Outcome::Completed);
    assert_eq!(report.resumed.len(), times);
    (files(&folder), times)
}

/// All kinds of simulations, with changes, sensors and saved systems between them.
pub(crate) const COMMANDS: &str = "SIM/DYN, END=0.4, STEPS=40
LINEAR/EIGENSOL
FRICTION/1, MU_STATIC=0.6
SIM/DYN, END=0.7, STEPS=11
SAVE/STATES, BUFFER=here
FRICTION/2, MU_STATIC=0.5
SIM/DYN, DURATION=0.2, STEPS=7
RELOAD/STATES, BUFFER=here
SIM/DYN, END=1.2, STEPS=30
SAVE/SYSTEM, FILE=late.sav
RELOAD/SYSTEM, FILE=late.sav, OUTPUT_PREFIX=again
SIM/DYN, END=1.5, STEPS=20
";

/// A block on a spring, with equilibria one after another and a sensor that ends them.
pub(crate) const BLOCK: &str = "A block on a spring
PART/1, GROUND
MARKER/3, PART=1, REULER=90D, 90D, 0
PART/3, MASS=1, CM=30, IP=1, 1, 1
MARKER/30, PART=3, REULER=90D, 90D, 0
JOINT/2, TRANSLATIONAL, I=30, J=3
FRICTION/2, JOINT=2, MU_STATIC=0.4, MU_DYNAMIC=0.3, INPUTS=PRELOAD, FRICTION_FORCE_PRELOAD=1
, STICTION_TRANSITION_VELOCITY=0.05, MAX_STICTION_DEFORMATION=0.001
SFORCE/2, TRANSLATIONAL, I=30, J=3, ACTIONONLY, FUNCTION=5*SIN(4*TIME)-20*DZ(30,3,3)-VZ(30,3,3)
REQUEST/1, DISPLACEMENT, I=30, J=3
SENSOR/1, GE, VALUE=0.15, ERROR=1E-3, FUNCTION=TIME\\, RETURN
END
";
pub(crate) const EQUILIBRIA: &str = "SIM/STATIC
SIM/STATIC, END=0.3, STEPS=9
SIM/DYN, END=0.5, STEPS=12
SIM/STATIC, END=0.7, STEPS=4
SIM/STATIC
";

/// Tells the first line that differs; files of many lines are nothing to print.
pub(crate) fn same(pieces: &[(PathBuf, String)], whole: &[(PathBuf, String)], what: &str) {
    let names = |files: &[(PathBuf, String)]| -> Vec<PathBuf> {
        files.iter().map(|(name, _)| name.clone()).collect()
    };
    assert_eq!(names(pieces), names(whole), "{what}");
    for ((name, piece), (_, whole)) in pieces.iter().zip(whole) {
        for (place, (a, b)) in piece.lines().zip(whole.lines()).enumerate() {
            assert_eq!(a, b, "{what}: {} line {}", name.display(), place + 1);
        }
        assert_eq!(piece, whole, "{what}: {}", name.display());
    }
}

/// A run interrupted after all these numbers of steps, again and again; returns how often.
fn check(dataset: &str, commands: &str, steps: &[usize]) -> usize {
    check_with(Reactions::OfKept, dataset, commands, steps)
}

/// The same with a choice of reactions.
fn check_with(reactions: Reactions, dataset: &str, commands: &str, steps: &[usize]) -> usize {
    let project = project(dataset, commands);
    let with = |options| RunOptions {
        reactions,
        ..options
    };
    let whole = at_one_go(&project, with(RunOptions::default()));
    same(
        &at_one_go(&project, with(ALWAYS)),
        &whole,
        "checkpoints all along",
    );
    let mut resumed = 0;
    for &steps in steps {
        let (pieces, times) = in_pieces(&project, reactions, steps);
        same(&pieces, &whole, &format!("every {steps} steps"));
        resumed += times;
    }
    resumed
}

#[test]
fn a_run_in_pieces_writes_the_bytes_of_one_at_one_go() {
    let resumed = check(MODEL, COMMANDS, &[1, 61, 333]);
    assert!(resumed > 300, "{resumed}");
}

#[test]
fn every_family_of_formulas_goes_on_where_it_was() {
    let commands =
        "SIM/DYN, END=0.3, STEPS=30\nFRICTION/1, MU_STATIC=0.6\nSIM/DYN, END=0.4, STEPS=3\n";
    for integrator in ["HHT", "NEWMARK", "ABAM"] {
        let text = MODEL.replace(
            "GSTIFF, SI2, ERROR=1E-6",
            &format!("{integrator}, ERROR=1E-4"),
        );
        let resumed = check(&text, commands, &[7, 61]);
        assert!(resumed > 3, "{integrator} {resumed}");
    }
}

#[test]
fn shared_reactions_go_on_where_they_were() {
    // A second hinge and a second guide, which friction depends on.
    let twice = "MARKER/4, PART=1, QP=0, 0, 1
MARKER/24, PART=2, QP=0, 0, 1
JOINT/3, REVOLUTE, I=24, J=4
MARKER/5, PART=1, QP=0, 0.2, 0.5, REULER=90D, 90D, 0
MARKER/35, PART=3, QP=0, 0.2, 0.5, REULER=90D, 90D, 0
JOINT/4, TRANSLATIONAL, I=35, J=5
FRICTION/1,";
    let text = MODEL.replace("FRICTION/1,", twice);
    let shared = Reactions::LeastSquares { length: Some(0.3) };
    let resumed = check_with(shared, &text, COMMANDS, &[61]);
    assert!(resumed > 3, "{resumed}");
}

#[test]
fn equilibria_go_on_where_they_were() {
    let resumed = check(BLOCK, EQUILIBRIA, &[1, 2, 3, 20]);
    assert!(resumed > 20, "{resumed}");
}

#[test]
fn a_checkpoint_of_another_run_is_refused_with_what_differs() {
    let interrupted = |project: &Project| {
        let folder = scratch_folder();
        let session = Session::new(project).unwrap();
        let report = session.run(&folder, SELDOM, &mut StopAfter(20)).unwrap();
        assert_eq!(report.outcome, Outcome::Interrupted);
        folder
    };
    let refusal = |project: &Project, folder: &Path, options: RunOptions| {
        let resumed = Session::new(project)
            .unwrap()
            .resume(folder, options, &mut GoOn);
        match resumed.unwrap_err() {
            ResumeError::Refused { cause, .. } => cause,
            ResumeError::Output(error) => panic!("{error}"),
        }
    };
    let commands = "SIM/DYN, END=0.4, STEPS=40\n";
    let first = project(BLOCK, commands);
    let folder = interrupted(&first);

    let another = |project: &Project, options| match refusal(project, &folder, options) {
        CheckpointError::AnotherRun(differences) => differences,
        other => panic!("{other}"),
    };
    let heavier = project(&BLOCK.replace("MASS=1", "MASS=2"), commands);
    assert_eq!(another(&heavier, SELDOM), ["model.adm has changed"]);
    let longer = project(BLOCK, "SIM/DYN, END=0.5, STEPS=40\n");
    assert_eq!(
        another(&longer, SELDOM),
        [
            "run.acf has changed",
            "the commands: `SIM/DYN, END=0.4, STEPS=40` then, `SIM/DYN, END=0.5, STEPS=40` now"
        ]
    );
    let mut changed = first.clone();
    changed.set("FRICTION/2, MU_STATIC=0.5").unwrap();
    assert_eq!(
        another(&changed, SELDOM),
        ["--set: nothing then, `FRICTION/2, MU_STATIC=0.5` now"]
    );
    let error = Some(1e-4);
    let finer = RunOptions { error, ..SELDOM };
    assert_eq!(
        another(&first, finer),
        ["--error: not given then, 1e-4 now"]
    );
    let method = Some(Method::Adams);
    let smooth = RunOptions { method, ..SELDOM };
    assert_eq!(
        another(&first, smooth),
        ["--integrator: not given then, adams now"]
    );
    let reactions = Reactions::LeastSquares { length: None };
    let shared = RunOptions {
        reactions,
        ..SELDOM
    };
    assert_eq!(
        another(&first, shared),
        ["--reactions: kept then, least-squares now"]
    );

    let path = folder.join("model.checkpoint");
    let good = std::fs::read(&path).unwrap();
    let of = |bytes: &[u8]| {
        std::fs::write(&path, bytes).unwrap();
        refusal(&first, &folder, SELDOM)
    };
    // Every byte counts: the head, the sums and the contents.
    for place in (0..good.len()).step_by(good.len() / 200) {
        let mut bad = good.clone();
        bad[place] ^= 0x10;
        let _: CheckpointError = of(&bad);
        let _: CheckpointError = of(&good[..place]);
    }
    let text = String::from_utf8_lossy(&good).into_owned();
    let head = text.lines().next().unwrap();
    assert_eq!(
        of(b"stiction checkpoint, format 0\n"),
        CheckpointError::AnotherFormat("0".to_owned())
    );
    assert_eq!(of(b"a text\n"), CheckpointError::NotACheckpoint);
    let at = head.len() + 1;
    let mut other = good.clone();
    other[at..at + 8].copy_from_slice(b"STICTION");
    assert!(matches!(of(&other), CheckpointError::AnotherProgram { .. }));
    let mut damaged = good.clone();
    *damaged.last_mut().unwrap() ^= 1;
    assert_eq!(of(&damaged), CheckpointError::Damaged);

    // Results that are shorter than they were are not gone on with.
    let results = folder.join("model.res");
    let written = std::fs::read(&results).unwrap();
    std::fs::write(&results, &written[..100]).unwrap();
    assert!(matches!(
        of(&good),
        CheckpointError::Results { found: 100, .. }
    ));
    std::fs::remove_file(&path).unwrap();
    assert_eq!(refusal(&first, &folder, SELDOM), CheckpointError::Missing);
}
