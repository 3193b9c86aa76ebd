//! Runs of command files with all that they write.

use results::ResFile;
use stiction::{Outcome, Project, RunOptions, RunReport, Session};

use crate::shared::{GoOn, scratch_folder};

/// A run with its files.
pub(crate) struct Run {
    pub(crate) report: RunReport,
    /// `.res`
    pub(crate) results: ResFile,
    /// `.req`
    pub(crate) requests: String,
    /// `.msg`
    pub(crate) messages: String,
}

impl Run {
    /// Runs a project into a throw-away folder.
    pub(crate) fn of(project: &Project) -> Self {
        let folder = scratch_folder();
        let session = Session::new(project).unwrap_or_else(|error| panic!("{error}"));
        let options = RunOptions::default();
        let report = session.run(&folder, options, &mut GoOn).unwrap();
        let file = |extension| folder.join(format!("{}.{extension}", project.prefix()));
        let run = Self {
            report,
            results: ResFile::read(file("res")).unwrap(),
            requests: std::fs::read_to_string(file("req")).unwrap(),
            messages: std::fs::read_to_string(file("msg")).unwrap(),
        };
        std::fs::remove_dir_all(folder).unwrap();
        run
    }
}

/// The project of a dataset, as `model.adm`, and of the commands that follow FILE/MODEL, from the
/// third line of `run.acf` on.
pub(crate) fn with_commands(dataset: &str, commands: &str) -> Result<Project, String> {
    let folder = scratch_folder();
    std::fs::write(folder.join("model.adm"), dataset).unwrap();
    let file = folder.join("run.acf");
    std::fs::write(&file, format!("\nFILE/MODEL=model\n{commands}\n")).unwrap();
    let project = Project::load(&file).map_err(|error| error.to_string());
    std::fs::remove_dir_all(folder).unwrap();
    project
}

/// Runs commands on a dataset.
pub(crate) fn run_commands(dataset: &str, commands: &str) -> Run {
    Run::of(&with_commands(dataset, commands).unwrap_or_else(|error| panic!("{error}")))
}

/// Runs commands on a dataset; they must go through.
pub(crate) fn complete_commands(dataset: &str, commands: &str) -> ResFile {
    let run = run_commands(dataset, commands);
    assert_eq!(run.report.outcome, Outcome::Completed, "{commands}");
    run.results
}
