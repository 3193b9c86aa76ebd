//! Runs of models into temporary folders.

use std::path::{Path, PathBuf};

use results::ResFile;
use stiction::{Outcome, Progress, Project, RunOptions, RunReport, Session, Watch};

/// Does not stop a run.
pub(crate) struct GoOn;

impl Watch for GoOn {
    fn progress(&mut self, _: &Progress) -> bool {
        true
    }
}

/// A fresh folder of its own for each call of each test process.
pub(crate) fn scratch_folder() -> PathBuf {
    use std::sync::atomic::{AtomicUsize, Ordering};
    static NEXT: AtomicUsize = AtomicUsize::new(0);
    let number = NEXT.fetch_add(1, Ordering::Relaxed);
    let name = format!("run-{}-{number}", std::process::id());
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(&folder).unwrap();
    folder
}

/// Runs a project into a throw-away folder; returns the report and the results.
pub(crate) fn run(project: &Project, options: RunOptions) -> (RunReport, ResFile) {
    let (report, results, _) = run_with_log(project, options);
    (report, results)
}

/// The same with the text of the message file.
pub(crate) fn run_with_log(project: &Project, options: RunOptions) -> (RunReport, ResFile, String) {
    let folder = scratch_folder();
    let session = Session::new(project).unwrap_or_else(|error| panic!("{error}"));
    let report = session.run(&folder, options, &mut GoOn).unwrap();
    let file = |extension| folder.join(format!("{}.{extension}", project.prefix()));
    let results = ResFile::read(file("res")).unwrap();
    let log = std::fs::read_to_string(file("msg")).unwrap();
    std::fs::remove_dir_all(folder).unwrap();
    (report, results, log)
}

/// Runs a project, which must go through.
pub(crate) fn complete(project: &Project, error: Option<f64>) -> ResFile {
    let (report, results) = run(
        project,
        RunOptions {
            error,
            ..RunOptions::default()
        },
    );
    assert_eq!(report.outcome, Outcome::Completed, "{}", project.prefix());
    results
}

/// Runs a dataset alone for `end` with `steps` outputs; it must go through.
pub(crate) fn run_dynamic(model: &Path, end: f64, steps: u32, error: Option<f64>) -> ResFile {
    let mut project = Project::load(model).unwrap_or_else(|error| panic!("{error}"));
    project.push_dynamic(end, Some(steps), None);
    complete(&project, error)
}

/// Runs a dataset given as text for `end` with `steps` outputs; it must go through.
pub(crate) fn run_text(text: &str, end: f64, steps: u32, error: Option<f64>) -> ResFile {
    let folder = scratch_folder();
    let file = folder.join("model.adm");
    std::fs::write(&file, text).unwrap();
    let results = run_dynamic(&file, end, steps, error);
    std::fs::remove_dir_all(folder).unwrap();
    results
}

/// What is said about a dataset that is not simulated.
pub(crate) fn refusal(text: &str) -> String {
    let folder = scratch_folder();
    let file = folder.join("model.adm");
    std::fs::write(&file, text).unwrap();
    let refused = match Project::load(&file) {
        Ok(project) => Session::new(&project).unwrap_err().to_string(),
        Err(error) => error.to_string(),
    };
    std::fs::remove_dir_all(folder).unwrap();
    refused
}

/// The ground with a marker at its origin.
pub(crate) const GROUND: &str = "PART/1, GROUND\nMARKER/1, PART=1\n";

/// A mass of 2 on a line along x, without weight, and what is added to it.
pub(crate) fn slider(elements: &str) -> String {
    format!(
        "slider
{GROUND}MARKER/2, PART=1, REULER=90D, 90D, 0
PART/2, MASS=2, CM=20, IP=1, 1, 1
MARKER/20, PART=2, REULER=90D, 90D, 0
MARKER/21, PART=2
JOINT/1, TRANSLATIONAL, I=20, J=2
{elements}
END
"
    )
}

/// The last value of a column.
pub(crate) fn last(results: &ResFile, name: &str) -> f64 {
    *results.get(name).unwrap().last().unwrap()
}
