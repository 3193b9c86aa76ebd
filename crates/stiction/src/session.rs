//! A project that can be run: what it is told and what it tells.

use serde::{Deserialize, Serialize};
use std::path::{Path, PathBuf};
use std::time::Duration;

use mechanics::Statistics;
use mechanics::model::Reactions;

use crate::accuracy::AccuracyReport;
use crate::balance::EnergyBalance;
use crate::channels::Channels;
use crate::checkpoint::{Checkpoint, CheckpointError, Job, ResumeError};
use crate::eigensolution::ModeReport;
use crate::lower::{Measures, Mode, lower};
use crate::message::{InputError, Message};
use crate::method::Method;
use crate::project::Project;
use crate::report::FrictionReport;
use crate::runner::Runner;
use crate::second_run::{self, Role};
use crate::sink::{Layout, Sink};

/// What can be said about a run beyond its files.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct RunOptions {
    /// Error tolerance instead of that of the INTEGRATOR statement.
    pub error: Option<f64>,
    /// Method of integration instead of that of the INTEGRATOR statement and of commands; its other
    /// arguments, and the error without one, stay.
    pub method: Option<Method>,
    /// Which reactions redundant constraints have. A length is in the unit of the model.
    pub reactions: Reactions,
    /// Wall time between two checkpoints, zero for one after every step: `PREFIX.checkpoint` in the
    /// folder of the results, from which [`Session::resume`] goes on. One is written at the start,
    /// one where the run is interrupted, and none is left behind by a run that has ended. None: no
    /// checkpoints.
    pub checkpoint: Option<Duration>,
    /// Whether `.res` and `.req` are written, as they are by default; a run with checkpoints always
    /// writes them, and every run its `.msg`.
    pub text_results: bool,
    /// Whether a second run with a tenth of ERROR goes beside it, in a thread of its own, that tells how
    /// accurate the run is: [`RunReport::accuracy`]. The run waits for it at the outputs; its results are
    /// those without it. A run that is resumed has none.
    pub check_accuracy: bool,
}

impl Default for RunOptions {
    fn default() -> Self {
        Self {
            error: None,
            method: None,
            reactions: Reactions::OfKept,
            checkpoint: None,
            text_results: true,
            check_accuracy: false,
        }
    }
}

impl RunOptions {
    pub(crate) fn writes_results(&self) -> bool {
        self.text_results || self.checkpoint.is_some()
    }
}

/// How far a run is.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Progress {
    /// Simulation time.
    pub time: f64,
    /// Time at which the last simulation of the run ends.
    pub end: f64,
    /// What the integrator did so far.
    pub statistics: Statistics,
}

/// Is told how far a run is, after every step.
pub trait Watch {
    /// Returns whether to go on; a run that is stopped keeps its results.
    fn progress(&mut self, progress: &Progress) -> bool;
}

/// How a run ended. Whatever it is, the results up to then are in the files.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub enum Outcome {
    /// All commands were carried out.
    Completed,
    /// [`Watch::progress`] stopped it.
    Interrupted,
    /// A command asks for what cannot be simulated.
    Refused(String),
    /// Initial positions, velocities, accelerations or reactions could not be found.
    AssemblyFailed(String),
    /// The integration could not go on.
    IntegrationFailed(String),
}

/// A simulation or LINEAR that has failed.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct FailedCommand {
    /// The command on one line, as the message file echoes it.
    pub command: String,
    /// Time of the model when it failed.
    pub time: f64,
    /// How.
    pub outcome: Outcome,
}

/// What a run did.
#[derive(Clone, Debug, PartialEq)]
pub struct RunReport {
    /// How it ended: the first failure, though the run may have gone on after it.
    pub outcome: Outcome,
    /// Time of the last output.
    pub time: f64,
    /// Number of simulations that ran to their end.
    pub simulations: usize,
    /// Times of the model from which the run was resumed.
    pub resumed: Vec<f64>,
    /// The commands that failed, in their order.
    pub failures: Vec<FailedCommand>,
    /// Number of outputs written.
    pub outputs: usize,
    /// Number of warnings in the message file.
    pub warnings: usize,
    /// What the run itself gave reason to say, and the error that ended it; what is to be said of
    /// its files is in [`Session::warnings`].
    pub messages: Vec<Message>,
    /// What the integrator did.
    pub statistics: Statistics,
    /// What friction did, by FRICTION.
    pub frictions: Vec<FrictionReport>,
    /// What each LINEAR/EIGENSOL found.
    pub modes: Vec<ModeReport>,
    /// Energy balance of its dynamic simulations; `None` where there was none.
    pub balance: Option<EnergyBalance>,
    /// How accurate it is, where that was asked for.
    pub accuracy: Option<AccuracyReport>,
    /// The files written.
    pub files: Vec<PathBuf>,
    /// Wall time, seconds.
    pub elapsed: f64,
}

/// A run that could not be written.
#[derive(Debug, thiserror::Error)]
#[error("cannot write {path}: {cause}")]
pub struct OutputError {
    /// The file.
    pub path: String,
    /// Why.
    pub cause: String,
}

impl OutputError {
    /// Of a file and why it cannot be written.
    #[must_use]
    pub fn at(path: &Path, cause: &impl ToString) -> Self {
        Self::new(path.display().to_string(), cause)
    }

    pub(crate) fn new(path: impl Into<String>, cause: &impl ToString) -> Self {
        Self {
            path: path.into(),
            cause: cause.to_string(),
        }
    }
}

/// A project that can be simulated, ready to run.
#[derive(Clone, Debug)]
pub struct Session<'a> {
    pub(crate) project: &'a Project,
    pub(crate) measures: Measures,
    warnings: Vec<Message>,
}

impl<'a> Session<'a> {
    /// Looks through the model and all changes of its command file.
    ///
    /// # Errors
    /// Everything that is not simulated, each with its place.
    pub fn new(project: &'a Project) -> Result<Self, InputError> {
        let (measures, mut warnings) = project.survey()?;
        warnings.splice(0..0, project.warnings().iter().cloned());
        Ok(Self {
            project,
            measures,
            warnings,
        })
    }

    /// Warnings of the files and of what is not simulated as written.
    #[must_use]
    pub fn warnings(&self) -> &[Message] {
        &self.warnings
    }

    /// What the rows of the results of a run will hold.
    #[must_use]
    pub fn layout(&self) -> Layout {
        let project = self.project;
        let mut measures = self.measures.clone();
        let source = project.model_source().name();
        let lowered = lower(
            project.dataset(),
            source,
            &mut measures,
            &Mode::Dynamic.into(),
        );
        let units = project.unit_names();
        // The survey has lowered the same dataset and found its channels.
        let channels = lowered
            .ok()
            .and_then(|lowered| Channels::new(project.dataset(), &lowered, &units).ok());
        channels.map_or_else(Layout::new, |channels| channels.layout().clone())
    }

    /// Carries out the commands; writes `PREFIX.res`, `PREFIX.req` and `PREFIX.msg` into `folder`,
    /// which must exist.
    ///
    /// # Errors
    /// Files that cannot be written. How the run itself ended is in the report.
    pub fn run(
        &self,
        folder: &Path,
        options: RunOptions,
        watch: &mut dyn Watch,
    ) -> Result<RunReport, OutputError> {
        self.carry_out(folder, options, None, watch)
    }

    /// [`Session::run`] that gives the rows of its results to `sink`, too.
    ///
    /// # Errors
    /// Files that cannot be written, and what the sink refuses.
    pub fn run_into(
        &self,
        folder: &Path,
        options: RunOptions,
        watch: &mut dyn Watch,
        sink: &mut dyn Sink,
    ) -> Result<RunReport, OutputError> {
        self.carry_out(folder, options, Some(sink), watch)
    }

    fn carry_out<'s>(
        &'s self,
        folder: &Path,
        options: RunOptions,
        sink: Option<&'s mut dyn Sink>,
        watch: &mut dyn Watch,
    ) -> Result<RunReport, OutputError> {
        let run = |role| self.begin(folder, options, sink, role)?.carry_out(watch);
        if options.check_accuracy {
            second_run::beside(self, folder, options, run)
        } else {
            run(Role::Alone)
        }
    }

    /// A run from its beginning, alone or as one of two.
    pub(crate) fn begin<'s>(
        &'s self,
        folder: &Path,
        options: RunOptions,
        sink: Option<&'s mut dyn Sink>,
        role: Role,
    ) -> Result<Runner<'s>, OutputError> {
        Runner::new(self, folder, options, None, sink, role).map_err(|error| match error {
            ResumeError::Output(error) => error,
            // Nothing is resumed.
            ResumeError::Refused { path, cause } => OutputError::new(path, &cause),
        })
    }

    /// Goes on with a run from the checkpoint in the folder of its results. These are cut back to what
    /// was written before it, and then continued: on the same machine they are, byte for byte, those
    /// of a run that was never interrupted, but for the times that the message file tells.
    ///
    /// # Errors
    /// Without a checkpoint of the same files and options by the same build of the program; with
    /// [`RunOptions::check_accuracy`], whose second run is in no checkpoint; and files that cannot be
    /// written.
    pub fn resume(
        &self,
        folder: &Path,
        options: RunOptions,
        watch: &mut dyn Watch,
    ) -> Result<RunReport, ResumeError> {
        let path = Checkpoint::path(folder, self.project.prefix());
        if options.check_accuracy {
            return Err(ResumeError::Refused {
                path: path.display().to_string(),
                cause: CheckpointError::CheckedAccuracy,
            });
        }
        let job = Job::new(self.project, &options);
        let checkpoint = Checkpoint::read(&path, &job).map_err(|cause| ResumeError::Refused {
            path: path.display().to_string(),
            cause,
        })?;
        let runner = Runner::new(self, folder, options, Some(checkpoint), None, Role::Alone)?;
        Ok(runner.carry_out(watch)?)
    }
}
