//! Reference data beside the checkout, and runs of models into temporary folders.
#![allow(clippy::print_stdout, reason = "a skipped test says why")]

use std::path::{Path, PathBuf};

use results::ResFile;
use stiction::{Outcome, Progress, Project, RunOptions, RunReport, Session, Watch};

/// Path of a file of the reference folder (`STICTION_SHARED`, else `../shared` beside the
/// checkout), or `None` with a printed reason.
pub(crate) fn reference(path: &str) -> Option<PathBuf> {
    let folder = std::env::var_os("STICTION_SHARED").map_or_else(
        || PathBuf::from(concat!(env!("CARGO_MANIFEST_DIR"), "/../../../shared")),
        PathBuf::from,
    );
    let file = folder.join(path);
    if file.is_file() {
        Some(file)
    } else {
        println!("skipped: there is no reference file {path}");
        None
    }
}

struct GoOn;

impl Watch for GoOn {
    fn progress(&mut self, _: &Progress) -> bool {
        true
    }
}

/// Runs a project into a fresh folder called `name`; returns the report and the results.
pub(crate) fn run(project: &Project, name: &str, options: RunOptions) -> (RunReport, ResFile) {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(&folder).unwrap();
    let session = Session::new(project).unwrap_or_else(|error| panic!("{error}"));
    let report = session.run(&folder, options, &mut GoOn).unwrap();
    let results = ResFile::read(folder.join(format!("{}.res", project.prefix()))).unwrap();
    (report, results)
}

/// Runs a dataset given as text for `end` with `steps` outputs; it must go through.
pub(crate) fn run_text(text: &str, name: &str, end: f64, steps: u32) -> ResFile {
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(format!("{name}-input"));
    std::fs::create_dir_all(&folder).unwrap();
    let file = folder.join(format!("{name}.adm"));
    std::fs::write(&file, text).unwrap();
    let mut project = Project::load(&file).unwrap_or_else(|error| panic!("{error}"));
    project.push_dynamic(end, Some(steps), None);
    let (report, results) = run(&project, name, RunOptions::default());
    assert_eq!(report.outcome, Outcome::Completed);
    results
}
