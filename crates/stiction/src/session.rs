//! A project run: its commands carried out one by one, results written as they come.

use std::fs::File;
use std::path::{Path, PathBuf};
use std::time::Instant;

use dataset::{CommandKind, Dataset, Simulate, SimulationKind};
use mechanics::{Ending, Simulation, Statistics};
use results::{DataKind, Header, MessageWriter, ReqWriter, ResWriter};

use crate::channels::{Channels, Row, unit_names};
use crate::failure;
use crate::journal::Journal;
use crate::lower::{Lowered, Measures, lower};
use crate::message::{InputError, Message};
use crate::project::{Project, SourcedCommand, second};
use crate::recorder::{Recorder, Stop};
use crate::report::{self, FrictionReport};
use crate::settings;

/// Rows of the integrator's table, about, for each simulation.
const TABLE_ROWS: f64 = 10.0;

/// What can be said about a run beyond its files.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct RunOptions {
    /// Error tolerance instead of that of the INTEGRATOR statement.
    pub error: Option<f64>,
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
#[derive(Clone, Debug, PartialEq)]
pub enum Outcome {
    /// All commands were carried out.
    Completed,
    /// [`Watch::progress`] stopped it.
    Interrupted,
    /// A command asks for what is not simulated.
    Refused(String),
    /// Initial positions, velocities, accelerations or reactions could not be found.
    AssemblyFailed(String),
    /// The integration could not go on.
    IntegrationFailed(String),
}

/// What a run did.
#[derive(Clone, Debug, PartialEq)]
pub struct RunReport {
    /// How it ended.
    pub outcome: Outcome,
    /// Time of the last output.
    pub time: f64,
    /// Number of simulations that ran to their end.
    pub simulations: usize,
    /// Number of outputs written.
    pub outputs: usize,
    /// Number of warnings in the message file.
    pub warnings: usize,
    /// What the integrator did.
    pub statistics: Statistics,
    /// What friction did, by FRICTION.
    pub frictions: Vec<FrictionReport>,
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
    project: &'a Project,
    measures: Measures,
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
        let mut runner = Runner::new(self, folder, options)?;
        let outcome = runner.commands(watch)?;
        runner.finish(outcome)
    }
}

/// A run while it goes on.
struct Runner<'a> {
    session: &'a Session<'a>,
    options: RunOptions,
    dataset: Dataset,
    measures: Measures,
    lowered: Lowered,
    /// Whether the dataset has changed since it was lowered.
    changed: bool,
    simulation: Simulation,
    assembled: bool,
    /// Typical length of the assembled model.
    length: f64,
    simulations: usize,
    started: Instant,
    last_end: f64,
    log: Journal<File>,
    recorder: Recorder<File>,
}

/// Reasons for the commands to end early.
enum Halt {
    Ended(Outcome),
    Output(OutputError),
}

impl From<OutputError> for Halt {
    fn from(error: OutputError) -> Self {
        Self::Output(error)
    }
}

impl<'a> Runner<'a> {
    fn new(
        session: &'a Session<'a>,
        folder: &Path,
        options: RunOptions,
    ) -> Result<Self, OutputError> {
        let project = session.project;
        let dataset = project.dataset().clone();
        let mut measures = session.measures.clone();
        let source = project.model_source().name();
        let lowered = lower(&dataset, source, &mut measures).map_err(|diagnostics| {
            // The survey has lowered the same dataset.
            OutputError::new(source, &format!("{} errors", diagnostics.len()))
        })?;
        let units = unit_names(&dataset);
        let channels =
            Channels::new(&dataset, &lowered, &units).map_err(|e| OutputError::new(source, &e))?;
        let create = |extension: &str| {
            let path = folder.join(format!("{}.{extension}", project.prefix()));
            let shown = path.display().to_string();
            let file = File::create(&path).map_err(|error| OutputError::new(&shown, &error))?;
            Ok::<_, OutputError>((file, path, shown))
        };
        let (log, log_path, shown) = create("msg")?;
        let version = env!("CARGO_PKG_VERSION");
        let log = MessageWriter::new(log, "stiction", version, None)
            .map_err(|error| OutputError::new(&shown, &error))?;
        let log = Journal::new(log, shown);
        let (res, res_path, shown) = create("res")?;
        let header = Header {
            title: dataset.title.clone(),
            units: units.clone(),
            ..Header::default()
        };
        let res = ResWriter::new(res, &header, channels.layout().clone())
            .map_err(|error| OutputError::new(&shown, &error))?;
        let (req, req_path, shown) = create("req")?;
        let req = ReqWriter::new(req, &dataset.title, None, &units, channels.requests())
            .map_err(|error| OutputError::new(&shown, &error))?;
        let simulation = Simulation::new(lowered.model.clone(), second(&dataset));
        let frictions = report::reports(&simulation.snapshot(), &units);
        Ok(Self {
            session,
            options,
            dataset,
            measures,
            changed: false,
            simulation,
            assembled: false,
            length: 1.0,
            simulations: 0,
            started: Instant::now(),
            last_end: last_end(project),
            log,
            recorder: Recorder {
                res,
                req,
                files: vec![res_path, req_path, log_path],
                channels,
                outputs: lowered.outputs.clone(),
                row: Row::default(),
                frictions,
                count: 0,
            },
            lowered,
        })
    }

    fn commands(&mut self, watch: &mut dyn Watch) -> Result<Outcome, OutputError> {
        let project = self.session.project;
        self.recorder.model_input()?;
        if project.is_dataset_alone() {
            self.log_model()?;
        }
        for step in project.steps() {
            self.log.command(&step.command.echo)?;
            let done = match &step.command.kind {
                CommandKind::Model { .. } => self.log_model().map_err(Halt::from),
                CommandKind::Change(change) => {
                    // The survey has found nothing wrong with it.
                    let _ = project.change(&mut self.dataset, change, step.source);
                    self.changed = true;
                    Ok(())
                }
                CommandKind::Simulate(simulate) => self.simulate(simulate, step, watch),
                // The commands of the file follow.
                CommandKind::CommandFile { .. } => Ok(()),
                CommandKind::Stop => break,
            };
            match done {
                Ok(()) => {}
                Err(Halt::Ended(outcome)) => return Ok(outcome),
                Err(Halt::Output(error)) => return Err(error),
            }
        }
        Ok(Outcome::Completed)
    }

    /// Title, size of the model, defaults in use and warnings.
    fn log_model(&mut self) -> Result<(), OutputError> {
        self.log.model(&self.dataset, &self.lowered.model)?;
        for message in self.session.warnings() {
            self.log.message(message)?;
        }
        Ok(())
    }

    fn simulate(
        &mut self,
        simulate: &Simulate,
        step: &SourcedCommand,
        watch: &mut dyn Watch,
    ) -> Result<(), Halt> {
        use SimulationKind as K;
        let keyword = simulate.kind.keyword();
        if matches!(simulate.kind, K::Static | K::QuasiStatic | K::Settle) {
            let source = self.session.project.source(step.source);
            let (line, column) = source.line_column(step.command.span.start);
            let message = format!(
                "{}:{line}:{column}: SIMULATE/{keyword} is not simulated yet; the run ends here",
                source.name()
            );
            return Err(Halt::Ended(Outcome::Refused(format!("error: {message}"))));
        }
        self.take_changes()?;
        if !self.assembled {
            self.assemble()?;
        }
        if simulate.kind == K::InitialConditions {
            return Ok(());
        }
        let freedoms = self.simulation.system().degrees_of_freedom();
        match (simulate.kind, freedoms) {
            (K::Kinematic, 0) | (K::Transient, 0) => {
                self.log.note("there are no degrees of freedom: the motion follows from the joints and motions; it is run as a dynamic simulation")?;
            }
            (K::Kinematic, _) => self.log.warning(&format!(
                "SIMULATE/KINEMATIC with {freedoms} degrees of freedom goes on as dynamic"
            ))?,
            _ => {}
        }
        self.dynamic(simulate, watch)
    }

    /// Lowers the dataset again where commands have changed it.
    fn take_changes(&mut self) -> Result<(), Halt> {
        if !std::mem::take(&mut self.changed) {
            return Ok(());
        }
        let source = self.session.project.model_source().name();
        match lower(&self.dataset, source, &mut self.measures) {
            Ok(lowered) => {
                self.simulation.replace_model(lowered.model.clone());
                self.recorder.outputs = lowered.outputs.clone();
                self.lowered = lowered;
                Ok(())
            }
            Err(diagnostics) => {
                let text: Vec<String> = diagnostics.into_iter().map(|d| d.message).collect();
                Err(Halt::Ended(Outcome::Refused(format!(
                    "error: {}",
                    text.join("; ")
                ))))
            }
        }
    }

    fn assemble(&mut self) -> Result<(), Halt> {
        let failed = |text: String| Halt::Ended(Outcome::AssemblyFailed(text));
        let source = self.session.project.model_source();
        let located = |message: Message| failed(message.text.trim_end().to_owned());
        let assembly = self
            .simulation
            .assemble()
            .map_err(|error| located(failure::of_assembly(&self.dataset, source, &error)))?;
        self.length = self.simulation.system().length_scale();
        let system = self.simulation.system();
        self.log
            .assembly(&assembly, system.degrees_of_freedom(), system.model())?;
        self.simulation
            .solve_instant()
            .map_err(|error| located(failure::of_start(&self.dataset, source, &error)))?;
        self.assembled = true;
        let snapshot = self.simulation.snapshot();
        match self.recorder.initial(&snapshot) {
            Ok(()) => Ok(()),
            Err(Stop::Output(error)) => Err(Halt::Output(error)),
            Err(Stop::NotFinite(text)) => Err(failed(format!("error: {text}"))),
        }
    }

    fn dynamic(&mut self, simulate: &Simulate, watch: &mut dyn Watch) -> Result<(), Halt> {
        let start = self.simulation.state().time;
        let refused = |text: String| Halt::Ended(Outcome::Refused(format!("error: {text}")));
        let span = settings::span(simulate, start).map_err(refused)?;
        let span = span.ok_or_else(|| refused("SIMULATE needs END or DURATION".to_owned()))?;
        let integrator = self.dataset.integrator.as_ref();
        let choice = settings::choose(
            integrator,
            span.step,
            self.options.error,
            second(&self.dataset),
        );
        let notes: Vec<String> = choice.notes.into_iter().chain(span.note()).collect();
        self.log.begin(&choice.settings, &notes, start)?;
        self.recorder.begin(DataKind::Dynamic)?;
        let (end, times) = (span.end, span.outputs(start));
        let mut observer = crate::recorder::Observe {
            recorder: &mut self.recorder,
            log: &mut self.log,
            watch,
            started: self.started,
            end: self.last_end,
            next_row: start,
            row_interval: (end - start) / TABLE_ROWS,
            length: self.length,
            stop: None,
            interrupted: false,
        };
        let ran = self
            .simulation
            .run(end, &times, &choice.settings, &mut observer);
        let (stop, interrupted) = (observer.stop.take(), observer.interrupted);
        match stop {
            Some(Stop::Output(error)) => return Err(Halt::Output(error)),
            Some(Stop::NotFinite(text)) => {
                let text = format!("error: {text}");
                return Err(Halt::Ended(Outcome::IntegrationFailed(text)));
            }
            None => {}
        }
        match ran {
            Ok(Ending::Completed) => {}
            Ok(Ending::Stopped) if interrupted => return Err(Halt::Ended(Outcome::Interrupted)),
            Ok(Ending::Stopped) => {}
            Err(error) => {
                let source = self.session.project.model_source();
                let message = failure::of_run(&self.dataset, source, &error);
                let text = message.text.trim_end().to_owned();
                return Err(Halt::Ended(Outcome::IntegrationFailed(text)));
            }
        }
        self.simulations += 1;
        self.log.end(&self.simulation.statistics())?;
        Ok(())
    }

    fn finish(mut self, outcome: Outcome) -> Result<RunReport, OutputError> {
        let elapsed = self.started.elapsed().as_secs_f64();
        let (status, text) = match &outcome {
            Outcome::Completed => ("Successful", None),
            Outcome::Interrupted => ("Interrupted", Some("interrupted; results so far are kept")),
            Outcome::Refused(text) => ("Not simulated", Some(text.as_str())),
            Outcome::AssemblyFailed(text) => ("Assembly failed", Some(text.as_str())),
            Outcome::IntegrationFailed(text) => ("Integration failed", Some(text.as_str())),
        };
        let table = report::friction_table(&self.recorder.frictions);
        self.log.finish(text, &table, elapsed)?;
        let Recorder {
            res,
            frictions,
            count,
            files,
            ..
        } = self.recorder;
        let path = files
            .first()
            .map(|path| path.display().to_string())
            .unwrap_or_default();
        res.finish(status)
            .map_err(|error| OutputError::new(path, &error))?;
        Ok(RunReport {
            outcome,
            time: self.simulation.state().time,
            simulations: self.simulations,
            outputs: count,
            warnings: self.log.warnings(),
            statistics: self.simulation.statistics(),
            frictions,
            files,
            elapsed,
        })
    }
}

/// Time at which the last simulation of a project ends.
fn last_end(project: &Project) -> f64 {
    project.steps().iter().fold(0.0, |time, step| {
        let CommandKind::Simulate(simulate) = &step.command.kind else {
            return time;
        };
        let span = settings::span(simulate, time).ok().flatten();
        span.map_or(time, |span| span.end)
    })
}
