//! Runs of the whole program into a throw-away folder.

use std::path::{Path, PathBuf};

use results::ResFile;

/// A file of the reference data, or `None` with a printed reason where it is absent.
pub(crate) fn shared(file: &str) -> Option<PathBuf> {
    let folder = match std::env::var_os("STICTION_SHARED") {
        Some(folder) => PathBuf::from(folder),
        None => Path::new(env!("CARGO_MANIFEST_DIR")).join("../../../shared"),
    };
    let path = folder.join(file);
    if path.exists() {
        Some(path)
    } else {
        println!(
            "skipped: the reference data {} are not here",
            path.display()
        );
        None
    }
}

/// Steps are not watched.
struct Unwatched;
impl stiction::Watch for Unwatched {
    fn progress(&mut self, _: &stiction::Progress) -> bool {
        true
    }
}

/// Runs a model, with an error tolerance and changes of its statements, and reads its `.res`.
pub(crate) fn run(model: &Path, error: Option<f64>, changes: &[&str]) -> ResFile {
    let mut project = stiction::Project::load(model).expect("the model is read");
    for change in changes {
        project.set(change).expect("the change is accepted");
    }
    run_project(&project, error)
}

/// Runs a dataset alone with one dynamic simulation.
pub(crate) fn run_dynamic(model: &Path, end: f64, steps: u32, error: Option<f64>) -> ResFile {
    let mut project = stiction::Project::load(model).expect("the model is read");
    project.push_dynamic(end, Some(steps), None);
    run_project(&project, error)
}

fn run_project(project: &stiction::Project, error: Option<f64>) -> ResFile {
    let folder = scratch_folder();
    let session = stiction::Session::new(project).expect("the model can be simulated");
    let options = stiction::RunOptions { error };
    let report = session
        .run(&folder, options, &mut Unwatched)
        .expect("results are written");
    assert_eq!(report.outcome, stiction::Outcome::Completed);
    let file = folder.join(format!("{}.res", project.prefix()));
    let results = ResFile::read(file).expect("the results are read");
    std::fs::remove_dir_all(folder).expect("the folder is removed");
    results
}

/// A folder of its own for each run of each test process.
pub(crate) fn scratch_folder() -> PathBuf {
    use std::sync::atomic::{AtomicUsize, Ordering};
    static NEXT: AtomicUsize = AtomicUsize::new(0);
    let number = NEXT.fetch_add(1, Ordering::Relaxed);
    let name = format!("run-{}-{number}", std::process::id());
    let folder = Path::new(env!("CARGO_TARGET_TMPDIR")).join(name);
    std::fs::create_dir_all(&folder).expect("a folder for the results");
    folder
}
