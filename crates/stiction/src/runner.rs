//! A run: commands carried out one by one, results written as they come.

use std::collections::{BTreeMap, HashMap};
use std::fs::File;
use std::path::{Path, PathBuf};
use std::time::Instant;

use dataset::{Change, Code, CommandKind, Dataset, Severity, Simulate, SimulationKind};
use mechanics::{Assembly, AssemblyError, Ending, Simulation};
use results::{DataKind, Header, MessageWriter};
use serde::{Deserialize, Serialize};

use crate::balance::EnergyAccount;
use crate::channels::{Channels, Row, unit_names};
use crate::checkpoint::{Checkpoint, Job, Keeper, ResumeError, RunProgress, UnderWay};
use crate::eigensolution::ModeReport;
use crate::failure;
use crate::journal::Journal;
use crate::listing;
use crate::lower::{Lowered, Measures, Mode, Setting, lower};
use crate::message::Message;
use crate::project::{Project, SourcedCommand, second};
use crate::recorder::{Observe, Recorder, ResultFiles, Stop, reopened};
use crate::report;
use crate::saved_system::SavedSystem;
use crate::second_run::Role;
use crate::sensors::{Effect, Keeping, Sensing, Sensors};
use crate::session::{
    FailedCommand, Outcome, OutputError, Progress, RunOptions, RunReport, Session, Watch,
};
use crate::settings;
use crate::sink::Sink;
use crate::time_span::{self, TimeSpan};

/// Rows of the integrator's table, about, for each simulation.
const TABLE_ROWS: f64 = 10.0;

/// A run while it goes on.
pub(crate) struct Runner<'a> {
    pub(crate) session: &'a Session<'a>,
    pub(crate) options: RunOptions,
    /// Where the results go.
    pub(crate) folder: PathBuf,
    pub(crate) dataset: Dataset,
    /// The commands that have changed the dataset, as a command file.
    pub(crate) changes_made: String,
    /// What SAVE/STATES keeps, by name.
    pub(crate) buffers: HashMap<String, SavedSystem>,
    /// What SAVE/SYSTEM of a second run keeps in the place of files, by their names.
    pub(crate) files: HashMap<String, SavedSystem>,
    pub(crate) measures: Measures,
    pub(crate) lowered: Lowered,
    /// What sensors have kept.
    pub(crate) kept: BTreeMap<u32, f64>,
    /// Whether the dataset has changed since it was lowered.
    pub(crate) changed: bool,
    pub(crate) simulation: Simulation,
    pub(crate) assembled: bool,
    pub(crate) instant: Recorded,
    /// Typical length of the assembled model.
    pub(crate) length: f64,
    pub(crate) simulations: usize,
    /// Place of the command that is carried out.
    pub(crate) command: usize,
    /// The simulation that goes on from a checkpoint.
    pub(crate) under_way: Option<UnderWay>,
    /// Times from which the run was resumed.
    pub(crate) resumed: Vec<f64>,
    pub(crate) keeper: Option<Keeper>,
    pub(crate) failures: Vec<FailedCommand>,
    pub(crate) modes: Vec<ModeReport>,
    pub(crate) started: Instant,
    pub(crate) last_end: f64,
    pub(crate) log: Journal<'a, File>,
    pub(crate) recorder: Recorder<'a, File>,
}

/// What the results hold of the present instant.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub(crate) enum Recorded {
    /// Nothing yet.
    Nothing,
    /// An equilibrium.
    Equilibrium,
    /// An instant of motion, at the start or the end of a simulation.
    Motion,
}

/// Reasons for the commands to end early.
pub(crate) enum Halt {
    /// The run ends here.
    Ended(Outcome),
    /// A simulation or LINEAR has failed; whether the run goes on is for PREFERENCES/SIMFAIL to say.
    Failed(Outcome, Option<Box<Message>>),
    /// A file cannot be written.
    Output(OutputError),
}

impl From<OutputError> for Halt {
    fn from(error: OutputError) -> Self {
        Self::Output(error)
    }
}

impl Halt {
    /// A command that is not carried out.
    fn refused(text: &str) -> Self {
        Self::Ended(Outcome::Refused(format!("error: {text}")))
    }

    /// A failure with its place.
    pub(crate) fn located(outcome: fn(String) -> Outcome, message: &Message) -> Self {
        let text = message.to_string().trim_end().to_owned();
        Self::Failed(outcome(text), Some(Box::new(message.clone())))
    }

    /// What an event does to the run after the simulation that it has ended.
    pub(crate) fn of_event(effect: Effect) -> Result<(), Self> {
        match effect {
            Effect::None | Effect::Return => Ok(()),
            Effect::Halt => Err(Self::Ended(Outcome::Completed)),
        }
    }

    /// A row that cannot be written.
    pub(crate) fn of_row(outcome: fn(String) -> Outcome, stop: Stop) -> Self {
        match stop {
            Stop::Output(error) => Self::Output(error),
            Stop::NotFinite(text) => Self::Failed(outcome(format!("error: {text}")), None),
        }
    }
}

impl<'a> Runner<'a> {
    /// A run from its beginning, or one that goes on from a checkpoint.
    pub(crate) fn new(
        session: &'a Session<'a>,
        folder: &Path,
        options: RunOptions,
        from: Option<Checkpoint<'static>>,
        mut sink: Option<&'a mut dyn Sink>,
        role: Role,
    ) -> Result<Self, ResumeError> {
        let project = session.project;
        let dataset = project.dataset().clone();
        let mut measures = session.measures.clone();
        let source = project.model_source().name();
        let setting = Setting {
            reactions: options.reactions,
            ..Mode::Dynamic.into()
        };
        let lowered = lower(&dataset, source, &mut measures, &setting);
        let lowered = lowered.map_err(|diagnostics| {
            // The survey has lowered the same dataset.
            OutputError::new(source, &format!("{} errors", diagnostics.len()))
        })?;
        let units = unit_names(&dataset);
        let channels =
            Channels::new(&dataset, &lowered, &units).map_err(|e| OutputError::new(source, &e))?;
        let log_path = folder.join(format!("{}.msg", project.prefix()));
        let shown = log_path.display().to_string();
        let (log, files) = match &from {
            None => {
                let log = match role.is_second() {
                    // What it says is for no one.
                    true => tempfile::tempfile(),
                    false => File::create(&log_path),
                };
                let log = log.map_err(|error| OutputError::new(&shown, &error))?;
                let version = env!("CARGO_PKG_VERSION");
                let log = MessageWriter::new(log, "stiction", version, None)
                    .map_err(|error| OutputError::new(&shown, &error))?;
                let header = Header {
                    title: dataset.title.clone(),
                    units: units.clone(),
                    ..Header::default()
                };
                if let Some(sink) = &mut sink {
                    sink.begin(&header, channels.layout())?;
                }
                let paths = ResultFiles::paths(folder, project.prefix());
                let files = options
                    .writes_results()
                    .then(|| ResultFiles::create(paths, &header, &channels));
                let files = files.transpose()?;
                (Journal::new(log, shown, project), files)
            }
            Some(checkpoint) => {
                let RunProgress { files, told, .. } = &checkpoint.progress;
                let log = MessageWriter::append(reopened(&log_path, files.lengths[2])?);
                let files = ResultFiles::resume(folder, files, &channels)?;
                let log = Journal::resume(log, shown, project, told.clone());
                (log, Some(files))
            }
        };
        let simulation = Simulation::new(lowered.model.clone(), second(&dataset));
        let frictions = report::reports(&simulation.snapshot(), &units);
        let keeper = options.checkpoint.map(|interval| {
            let path = Checkpoint::path(folder, project.prefix());
            Keeper::new(path, interval, Job::new(project, &options))
        });
        let mut runner = Self {
            session,
            options,
            folder: folder.to_owned(),
            dataset,
            // The first line of a command file may name a model.
            changes_made: "\n".to_owned(),
            buffers: HashMap::new(),
            files: HashMap::new(),
            measures,
            kept: BTreeMap::new(),
            changed: false,
            simulation,
            assembled: false,
            instant: Recorded::Nothing,
            length: 1.0,
            simulations: 0,
            command: 0,
            under_way: None,
            resumed: Vec::new(),
            keeper,
            failures: Vec::new(),
            modes: Vec::new(),
            started: Instant::now(),
            last_end: last_end(project),
            log,
            recorder: Recorder {
                files,
                sink,
                kind: DataKind::ModelInput,
                others: vec![log_path],
                channels,
                outputs: lowered.outputs.clone(),
                row: Row::default(),
                account: EnergyAccount::new(frictions.len(), &units),
                frictions,
                count: 0,
                role,
            },
            lowered,
        };
        if let Some(checkpoint) = from {
            runner.take_up(checkpoint)?;
        }
        Ok(runner)
    }

    /// Carries out the commands and ends the files.
    pub(crate) fn carry_out(mut self, watch: &mut dyn Watch) -> Result<RunReport, OutputError> {
        let outcome = self.commands(watch)?;
        if outcome == Outcome::Completed {
            let progress = Progress {
                time: self.simulation.state().time,
                end: self.last_end,
                statistics: self.simulation.statistics(),
            };
            let role = &mut self.recorder.role;
            let attempts = progress.statistics.steps.attempts();
            role.completed(attempts, || watch.progress(&progress));
        }
        self.finish(outcome)
    }

    fn commands(&mut self, watch: &mut dyn Watch) -> Result<Outcome, OutputError> {
        let project = self.session.project;
        let resumed = !self.resumed.is_empty();
        if !resumed {
            self.recorder.model_input()?;
            if project.is_dataset_alone() {
                self.log_model()?;
            }
        }
        let first = self.command;
        for (place, step) in project.steps().iter().enumerate().skip(first) {
            self.command = place;
            self.recorder.role.command(place);
            if self.under_way.is_none() {
                // What a command has changed is known to the model only once it is simulated.
                if !self.changed && self.keeper.as_ref().is_some_and(Keeper::is_due) {
                    self.checkpoint(None)?;
                }
                self.log.command(&step.command.echo)?;
            }
            let done = match &step.command.kind {
                CommandKind::Model { .. } => self.log_model().map_err(Halt::from),
                CommandKind::Change(change) => self.change(change, step),
                CommandKind::Simulate(simulate) => self.simulate(simulate, step, watch),
                CommandKind::Eigensolution(asked) => self.eigensolution(asked),
                CommandKind::Info(request) => self.info(request, step),
                CommandKind::Time => self.time(),
                CommandKind::Save(place) => self.save(place, step),
                CommandKind::Reload(reload) => {
                    self.reload(reload, step, &project.steps()[place + 1..])
                }
                // The commands of the file follow.
                CommandKind::CommandFile { .. } => Ok(()),
                CommandKind::Stop => break,
            };
            match done {
                Ok(()) => {}
                Err(Halt::Ended(Outcome::Completed)) => break,
                Err(Halt::Ended(outcome)) => {
                    let time = self.simulation.state().time;
                    self.recorder.role.failed(time, &outcome, None);
                    self.log.failed(&outcome, None)?;
                    return Ok(outcome);
                }
                Err(Halt::Failed(outcome, message)) => {
                    let time = self.simulation.state().time;
                    let text = message.as_ref().map(|m| &*m.diagnostic.message);
                    self.recorder.role.failed(time, &outcome, text);
                    self.failures.push(FailedCommand {
                        command: step.command.echo.clone(),
                        time,
                        outcome: outcome.clone(),
                    });
                    self.log.failed(&outcome, message.map(|message| *message))?;
                    if self.stops_on_failure() {
                        break;
                    }
                    self.log
                        .note("the run goes on with the next command (PREFERENCES/SIMFAIL)")?;
                }
                Err(Halt::Output(error)) => return Err(error),
            }
        }
        Ok(self.outcome())
    }

    /// How the run has gone so far: the first failure is how it ends.
    pub(crate) fn outcome(&self) -> Outcome {
        let first = self.failures.first();
        first.map_or(Outcome::Completed, |failure| failure.outcome.clone())
    }

    /// PREFERENCES/SIMFAIL: whether a simulation that fails ends the run. As in Adams it does not by
    /// default.
    fn stops_on_failure(&self) -> bool {
        let preferences = self.dataset.preferences.as_ref();
        preferences
            .and_then(|preferences| preferences.stop_on_failure)
            .unwrap_or(false)
    }

    /// Title, size of the model, defaults in use and warnings.
    fn log_model(&mut self) -> Result<(), OutputError> {
        self.log.model(&self.dataset, &self.lowered.model)?;
        for message in self.session.warnings() {
            self.log.message(message)?;
        }
        Ok(())
    }

    /// Makes a change of the model; prints what it asks for.
    fn change(&mut self, change: &Change, step: &SourcedCommand) -> Result<(), Halt> {
        let project = self.session.project;
        // The survey has found nothing wrong with it, and its warnings have been told.
        let _ = project.change(&mut self.dataset, change, step.source);
        self.changes_made += project.text_of(step);
        self.changes_made.push('\n');
        if change.kind.is_of_model() {
            self.changed = true;
            if self.instant == Recorded::Equilibrium {
                // Another model has another equilibrium.
                self.instant = Recorded::Nothing;
            }
        }
        if !change.kind.lists() {
            return Ok(());
        }
        let text = match change.target() {
            ("FRICTION", id) => listing::friction(&self.dataset, id),
            (statement, id) => self.dataset.text_of(statement, id),
        };
        if let Some(text) = text {
            self.log.note(&text)?;
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
        let under_way = self.under_way.take();
        let present = self.simulation.state().time;
        let start = under_way
            .as_ref()
            .map_or(present, |under_way| under_way.start);
        let span = time_span::span(simulate, start).map_err(|error| {
            let (code, text) = (error.code(), error.to_string());
            let project = self.session.project;
            let message = project.about(step, Severity::Error, code, text, Some(error.help()));
            Halt::located(Outcome::Refused, &message)
        })?;
        let mode = match (simulate.kind, span) {
            (K::Static | K::QuasiStatic, None) => Mode::Static,
            (K::Static | K::QuasiStatic, Some(_)) => Mode::QuasiStatic,
            (K::InitialConditions, _) => Mode::InitialConditions,
            (K::Kinematic | K::Transient, _) => Mode::Kinematic,
            (K::Dynamic, _) => Mode::Dynamic,
        };
        if under_way.is_none() {
            self.prepare(mode)?;
        }
        if matches!(mode, Mode::Static | Mode::QuasiStatic) {
            return self.equilibria(span, under_way, watch);
        }
        let freedoms = self.simulation.system().degrees_of_freedom();
        let missing = || Halt::refused("SIMULATE needs END or DURATION");
        if under_way.is_some() {
            let kind = match simulate.kind {
                K::Kinematic | K::Transient if freedoms == 0 => DataKind::Kinematic,
                _ => DataKind::Dynamic,
            };
            return self.motion(kind, span.ok_or_else(missing)?, under_way, watch);
        }
        if mode == Mode::Kinematic && freedoms > 0 {
            self.prepare(Mode::Dynamic)?;
        }
        self.record_start()?;
        let kind = match (simulate.kind, freedoms) {
            (K::InitialConditions, _) => return Ok(()),
            (K::Kinematic | K::Transient, 0) => DataKind::Kinematic,
            (K::Kinematic, _) => {
                let text = format!(
                    "SIMULATE/KINEMATIC with {freedoms} degrees of freedom goes on as dynamic"
                );
                self.warn(step, Code::NotKinematic, text)?;
                DataKind::Dynamic
            }
            (K::Dynamic, 0) if !self.session.project.is_dataset_alone() => {
                let text = "SIMULATE/DYNAMIC of a model without degrees of freedom is integrated; \
                            KINEMATIC or TRANSIENT is faster";
                self.warn(step, Code::NotKinematic, text.to_owned())?;
                DataKind::Dynamic
            }
            _ => DataKind::Dynamic,
        };
        self.motion(kind, span.ok_or_else(missing)?, None, watch)
    }

    /// A warning about a command.
    fn warn(&mut self, step: &SourcedCommand, code: Code, text: String) -> Result<(), OutputError> {
        let project = self.session.project;
        let message = project.about(step, Severity::Warning, code, text, None);
        self.log.judged(message)
    }

    /// Takes over changes of the model and assembles it where it is not.
    pub(crate) fn prepare(&mut self, mode: Mode) -> Result<(), Halt> {
        self.take_changes(mode)?;
        if self.assembled {
            return Ok(());
        }
        self.assemble()
    }

    /// Lowers the dataset again where commands have changed it, or where a function that reads MODE
    /// is about to be read in another analysis.
    pub(crate) fn take_changes(&mut self, mode: Mode) -> Result<(), Halt> {
        let another = self.lowered.reads_mode && self.lowered.mode != mode;
        if !std::mem::take(&mut self.changed) && !another {
            return Ok(());
        }
        let source = self.session.project.model_source().name();
        let setting = self.setting(mode);
        let lowered = lower(&self.dataset, source, &mut self.measures, &setting);
        let lowered = lowered.map_err(|diagnostics| {
            let text: Vec<String> = diagnostics.into_iter().map(|d| d.message).collect();
            Halt::refused(&text.join("; "))
        })?;
        let model = lowered.model.clone();
        self.recorder.outputs = lowered.outputs.clone();
        self.lowered = lowered;
        if !self.assembled {
            self.simulation = Simulation::new(model, second(&self.dataset));
            return Ok(());
        }
        let assembled = self.simulation.replace_model(model);
        let assembled = assembled.map_err(|error| self.not_assembled(&error))?;
        let Some(assembly) = assembled else {
            return Ok(());
        };
        // Reactions of the other constraints, which friction at the start of what follows reads.
        // Where there are none the simulation that follows says so.
        let _ = self.simulation.solve_instant();
        self.log_assembly(&assembly)
    }

    /// What functions of an analysis read beside the motion.
    pub(crate) fn setting(&self, mode: Mode) -> Setting {
        Setting {
            mode,
            kept: self.kept.clone(),
            reactions: self.options.reactions,
        }
    }

    fn assemble(&mut self) -> Result<(), Halt> {
        let assembly = self.simulation.assemble();
        let assembly = assembly.map_err(|error| self.not_assembled(&error))?;
        self.length = self.simulation.system().length_scale();
        self.assembled = true;
        self.log_assembly(&assembly)
    }

    fn not_assembled(&self, error: &AssemblyError) -> Halt {
        let source = self.session.project.model_source();
        let message = failure::of_assembly(&self.dataset, source, error);
        Halt::located(Outcome::AssemblyFailed, &message)
    }

    fn log_assembly(&mut self, assembly: &Assembly) -> Result<(), Halt> {
        self.log.assembly(assembly, self.simulation.system())?;
        Ok(())
    }

    /// Solves and records the instant from which a motion starts, where it is not recorded as the
    /// end of another one.
    pub(crate) fn record_start(&mut self) -> Result<(), Halt> {
        if self.instant == Recorded::Motion {
            return Ok(());
        }
        let source = self.session.project.model_source();
        self.simulation.solve_instant().map_err(|error| {
            let message = failure::of_start(&self.dataset, source, &error);
            Halt::located(Outcome::AssemblyFailed, &message)
        })?;
        let snapshot = self.simulation.snapshot();
        let written = match self.instant {
            // As in Adams the requests hold this time once.
            Recorded::Equilibrium => self.recorder.initial_without_requests(&snapshot),
            Recorded::Nothing | Recorded::Motion => self.recorder.initial(&snapshot),
        };
        written.map_err(|stop| Halt::of_row(Outcome::AssemblyFailed, stop))?;
        self.instant = Recorded::Motion;
        Ok(())
    }

    /// A dynamic or kinematic simulation. Without freedoms positions, velocities, accelerations and
    /// reactions at the outputs follow from the constraints there; what has a past (motions that
    /// prescribe velocities, creep, differential states) is integrated alike.
    fn motion(
        &mut self,
        kind: DataKind,
        span: TimeSpan,
        under_way: Option<UnderWay>,
        watch: &mut dyn Watch,
    ) -> Result<(), Halt> {
        let integrator = self.dataset.integrator.as_ref();
        let kinematics = match kind {
            DataKind::Kinematic => self.dataset.kinematics.as_ref(),
            _ => None,
        };
        let choice = settings::choose(
            integrator,
            kinematics,
            span.step,
            &self.options,
            second(&self.dataset),
        );
        let role = &mut self.recorder.role;
        let settings = role.integration(choice.settings, self.length);
        let mut sensors = Sensors::new(&self.dataset, &self.lowered.outputs);
        let mut paused = under_way.is_some();
        let (start, mut taken, mut next_row) = if let Some(under_way) = under_way {
            sensors.hold(&under_way.sensors);
            (under_way.start, under_way.taken, under_way.next_row)
        } else {
            let start = self.simulation.state().time;
            let notes: Vec<String> = choice.notes.into_iter().chain(span.note()).collect();
            self.log.begin(kind, &settings, &notes, start)?;
            let velocity = settings.error * self.length / second(&self.dataset);
            self.recorder
                .begin_motion(kind, &self.simulation.snapshot(), velocity)?;
            (start, 0, start)
        };
        let effect = loop {
            let rows = Observe {
                recorder: &mut self.recorder,
                log: &mut self.log,
                watch,
                started: self.started,
                end: self.last_end,
                next_row,
                row_interval: (span.end - start) / TABLE_ROWS,
                length: self.length,
                stop: None,
                interrupted: false,
                taken,
                keeper: self.keeper.as_ref(),
                statistics: self.simulation.statistics(),
            };
            let mut observer = Sensing {
                rows,
                sensors: &mut sensors,
                effect: Effect::None,
                keeping: Keeping::new(&self.lowered, &mut self.kept),
            };
            let times = span.outputs(start, taken);
            let ran = if paused {
                self.simulation
                    .go_on(span.end, times, &settings, &mut observer)
            } else {
                self.simulation
                    .run(span.end, times, &settings, &mut observer)
            };
            let Sensing {
                rows,
                effect,
                keeping,
                ..
            } = observer;
            self.changed |= keeping.changes_functions;
            (next_row, taken) = (rows.next_row, rows.taken);
            let (stop, interrupted) = (rows.stop, rows.interrupted);
            self.log.slidings(self.simulation.slidings())?;
            if let Some(stop) = stop {
                return Err(Halt::of_row(Outcome::IntegrationFailed, stop));
            }
            paused = ran == Ok(Ending::Paused);
            match ran {
                Ok(Ending::Paused) => {
                    if self.keeper.is_some() {
                        let under_way = UnderWay {
                            start,
                            with_start: false,
                            taken,
                            next_row,
                            sensors: sensors.held(),
                        };
                        self.checkpoint(Some(under_way))?;
                    }
                    if interrupted {
                        return Err(Halt::Ended(Outcome::Interrupted));
                    }
                    continue;
                }
                Ok(Ending::Completed | Ending::Stopped) => {}
                Err(error) => {
                    let source = self.session.project.model_source();
                    let message = failure::of_run(&self.dataset, source, &error);
                    return Err(Halt::located(Outcome::IntegrationFailed, &message));
                }
            }
            // Functions that read what a sensor has just kept are other ones from here on.
            if effect != Effect::None || span.outputs(start, taken).next().is_none() {
                break effect;
            }
            self.take_changes(self.lowered.mode)?;
            sensors.renew(&self.lowered.outputs);
        };
        self.simulations += 1;
        self.log.end(&self.simulation.statistics())?;
        Halt::of_event(effect)
    }

    fn finish(mut self, outcome: Outcome) -> Result<RunReport, OutputError> {
        let elapsed = self.started.elapsed().as_secs_f64();
        let status = status(&outcome);
        // What has failed has been told.
        let interrupted = outcome == Outcome::Interrupted;
        if let Some(keeper) = self.keeper.as_ref().filter(|_| !interrupted) {
            keeper.remove();
        }
        let text = interrupted.then_some("interrupted; results so far are kept");
        self.log.frictions(&self.recorder.frictions)?;
        if let Some(balance) = self.recorder.account.balance() {
            self.log.balance(balance)?;
        }
        let units = unit_names(&self.dataset);
        let accuracy = self.recorder.role.report(&self.lowered.model, &units);
        if let Some(accuracy) = &accuracy {
            self.log.accuracy(accuracy)?;
        }
        let completed = outcome == Outcome::Completed;
        self.log.finish(completed, text, elapsed)?;
        let Recorder {
            files,
            mut others,
            frictions,
            account,
            count,
            ..
        } = self.recorder;
        if let Some(files) = files {
            others.splice(0..0, files.finish(status)?);
        }
        let warnings = self.log.warnings();
        Ok(RunReport {
            outcome,
            time: self.simulation.state().time,
            simulations: self.simulations,
            resumed: self.resumed,
            failures: self.failures,
            outputs: count,
            warnings,
            messages: self.log.into_messages(),
            statistics: self.simulation.statistics(),
            frictions,
            modes: self.modes,
            balance: account.balance().cloned(),
            accuracy,
            files: others,
            elapsed,
        })
    }
}

/// What the results say of how a run ended.
pub(crate) const fn status(outcome: &Outcome) -> &'static str {
    match outcome {
        Outcome::Completed => "Successful",
        Outcome::Interrupted => "Interrupted",
        Outcome::Refused(_) => "Not simulated",
        Outcome::AssemblyFailed(_) => "Assembly failed",
        Outcome::IntegrationFailed(_) => "Integration failed",
    }
}

/// Time at which the last simulation of a project ends.
fn last_end(project: &Project) -> f64 {
    project.steps().iter().fold(0.0, |time, step| {
        let CommandKind::Simulate(simulate) = &step.command.kind else {
            return time;
        };
        let span = time_span::span(simulate, time).ok().flatten();
        span.map_or(time, |span| span.end)
    })
}
