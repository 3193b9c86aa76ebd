//! A model and the commands to run on it, from files.

use std::path::{Path, PathBuf};

use dataset::{
    Change, ChangeKind, Code, Command, CommandKind, Dataset, Diagnostic, Severity, Simulate,
    SimulationKind, Source, Span,
};

use crate::levels::Levels;
use crate::loader;
use crate::lower::{Measures, Mode, lower};
use crate::message::{InputError, Message};
use crate::refusal;
use crate::settings::{self, SpanError};

/// A checked dataset with the commands of its command file.
///
/// ```no_run
/// let project = stiction::Project::load("delta.acf".as_ref())?;
/// println!("{} parts, {} commands", project.dataset().parts.len(), project.commands().len());
/// # Ok::<(), stiction::InputError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Project {
    pub(crate) dataset: Dataset,
    /// Place of the dataset's source in `sources`.
    pub(crate) model: usize,
    pub(crate) commands: Vec<SourcedCommand>,
    pub(crate) sources: Vec<Source>,
    pub(crate) files: Vec<PathBuf>,
    pub(crate) prefix: String,
    pub(crate) warnings: Vec<Message>,
    pub(crate) levels: Levels,
    pub(crate) is_dataset: bool,
}

/// A command and the source that it comes from.
#[derive(Clone, Debug)]
pub(crate) struct SourcedCommand {
    pub(crate) command: Command,
    pub(crate) source: usize,
}

impl Project {
    /// Reads a dataset (`.adm`) or a command file (`.acf`) with the dataset that it names.
    ///
    /// A model that is named with the path of another machine (`C:\models\arm`) is looked for by
    /// its base name beside the command file.
    ///
    /// # Errors
    /// Everything that is wrong with the files, each with its place.
    pub fn load(path: &Path) -> Result<Self, InputError> {
        Self::load_with(path, Levels::default())
    }

    /// [`Project::load`], telling of messages as `levels` say, here and in what is done with the
    /// project.
    ///
    /// # Errors
    /// Everything that is wrong with the files, and what is denied.
    pub fn load_with(path: &Path, levels: Levels) -> Result<Self, InputError> {
        loader::load(path, levels)
    }

    /// The dataset, with the changes made so far.
    #[must_use]
    pub fn dataset(&self) -> &Dataset {
        &self.dataset
    }

    /// The commands in order; none for a dataset alone.
    #[must_use]
    pub fn commands(&self) -> Vec<&Command> {
        self.commands
            .iter()
            .map(|sourced| &sourced.command)
            .collect()
    }

    /// Whether it was loaded from a dataset alone, without commands.
    #[must_use]
    pub fn is_dataset_alone(&self) -> bool {
        self.is_dataset
    }

    /// Prefix of the output files: `OUTPUT_PREFIX`, else the base name of the dataset.
    #[must_use]
    pub fn prefix(&self) -> &str {
        &self.prefix
    }

    /// The files that were read.
    #[must_use]
    pub fn files(&self) -> &[PathBuf] {
        &self.files
    }

    /// The warnings so far.
    #[must_use]
    pub fn warnings(&self) -> &[Message] {
        &self.warnings
    }

    pub(crate) fn steps(&self) -> &[SourcedCommand] {
        &self.commands
    }

    pub(crate) fn model_source(&self) -> &Source {
        &self.sources[self.model]
    }

    /// Makes a change before the run, as a command would: `FRICTION/103, MU_STATIC=0.2`.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn set(&mut self, change: &str) -> Result<(), InputError> {
        let source = Source::from_text("--set", change.to_owned());
        let (parsed, mut diagnostics) = dataset::parse_change(&source);
        if let Some(parsed) = parsed.filter(|_| !has_error(&diagnostics)) {
            diagnostics.extend(self.dataset.apply(&parsed));
        }
        let messages = diagnostics.into_iter().map(|d| Message::new(d, &source));
        let messages = self.levels.judge_all(messages.collect());
        if messages.iter().any(Message::is_error) {
            return Err(InputError { messages });
        }
        self.warnings.extend(messages);
        Ok(())
    }

    /// Appends a dynamic simulation, for a dataset alone.
    pub fn push_dynamic(&mut self, end: f64, steps: Option<u32>, dtout: Option<f64>) {
        let mut echo = format!("SIMULATE/DYNAMIC, END={end}");
        if let Some(steps) = steps {
            echo += &format!(", STEPS={steps}");
        }
        if let Some(dtout) = dtout {
            echo += &format!(", DTOUT={dtout}");
        }
        let simulate = Simulate {
            kind: SimulationKind::Dynamic,
            end: Some(end),
            duration: None,
            steps,
            dtout,
        };
        self.commands.push(SourcedCommand {
            command: Command {
                kind: CommandKind::Simulate(simulate),
                echo,
                span: Span::default(),
            },
            source: self.model,
        });
    }

    /// The model as mechanics simulates it, with the changes made so far; not assembled yet.
    ///
    /// For uses beyond a run: states of one's own, single instants, other integrations.
    ///
    /// # Errors
    /// Everything that is not simulated, each with its place.
    ///
    /// ```no_run
    /// let project = stiction::Project::load("pendulum.adm".as_ref())?;
    /// let mut simulation = project.simulation()?;
    /// let assembly = simulation.assemble().expect("the joints fit together");
    /// println!("{} redundant equations", assembly.redundant.len());
    /// # Ok::<(), stiction::InputError>(())
    /// ```
    pub fn simulation(&self) -> Result<mechanics::Simulation, InputError> {
        let acting = refusal::acting(&self.dataset, self.model_source().name());
        match acting {
            None => self.as_given(),
            Some(error) => Err(self.refused(vec![error])),
        }
    }

    /// The same without what is read but not simulated.
    pub(crate) fn as_given(&self) -> Result<mechanics::Simulation, InputError> {
        let source = self.model_source().name();
        let measures = &mut Measures::default();
        let lowered = lower(&self.dataset, source, measures, Mode::Dynamic);
        let lowered = lowered.map_err(|diagnostics| self.refused(diagnostics))?;
        Ok(mechanics::Simulation::new(
            lowered.model,
            second(&self.dataset),
        ))
    }

    fn refused(&self, diagnostics: Vec<Diagnostic>) -> InputError {
        let source = self.model_source();
        let messages = diagnostics.into_iter().map(|d| Message::new(d, source));
        InputError {
            messages: messages.collect(),
        }
    }

    /// Lowers the model as given and after each change of the command file, so that everything
    /// that is not simulated is known before the run; returns the measures of all of them.
    ///
    /// # Errors
    /// Everything that is not simulated, and simulations that cannot be.
    pub(crate) fn survey(&self) -> Result<(Measures, Vec<Message>), InputError> {
        let mut measures = Measures::default();
        let source = self.model_source();
        let lowered = lower(&self.dataset, source.name(), &mut measures, Mode::Dynamic);
        let given = lowered.is_ok();
        let mut messages: Vec<Message> = lowered
            .map_or_else(|diagnostics| diagnostics, |lowered| lowered.warnings)
            .into_iter()
            .map(|diagnostic| Message::new(diagnostic, source))
            .collect();
        let mut dataset = self.dataset.clone();
        let mut changed = None;
        let mut time = 0.0;
        let acting = |dataset: &Dataset| refusal::acting(dataset, source.name());
        // The command that has brought such an element back.
        let mut back = None;
        // What is not simulated is told once.
        let mut told = false;
        for step in &self.commands {
            let kind = &step.command.kind;
            if matches!(
                kind,
                CommandKind::Simulate(_) | CommandKind::Eigensolution(_)
            ) {
                // A model that is refused as given would be refused again.
                if let Some(changed) = changed.take().filter(|_| given) {
                    let lowered = lower(&dataset, source.name(), &mut measures, Mode::Dynamic);
                    messages.extend(self.at_command(lowered.err(), changed));
                }
                if !told {
                    let mut found = acting(&dataset);
                    told = found.is_some();
                    if let Some(step) = back {
                        if let Some(error) = &mut found {
                            error.help("leave it out of this command, or take it out of the model");
                        }
                        messages.extend(self.at_command(found.map(|error| vec![error]), step));
                    } else {
                        messages.extend(found.map(|error| Message::new(error, source)));
                    }
                }
            }
            match kind {
                CommandKind::Change(change) => {
                    let switches = matches!(change.kind, ChangeKind::Activity(_));
                    let rested = switches && acting(&dataset).is_none();
                    messages.extend(self.change(&mut dataset, change, step.source));
                    if rested && acting(&dataset).is_some() {
                        back = Some(step);
                    }
                    changed = Some(step);
                }
                CommandKind::Simulate(simulate) => match settings::span(simulate, time) {
                    Ok(span) => time = span.map_or(time, |span| span.end),
                    Err(error) => messages.extend(self.foreseen(error, step)),
                },
                CommandKind::Eigensolution(asked) => {
                    if let Some((id, _)) = asked.reference
                        && dataset.markers.by_id(id).is_none()
                    {
                        let text = format!("there is no MARKER/{id}");
                        let missing = Code::MissingElement;
                        messages.push(self.about(step, Severity::Error, missing, text, None));
                    }
                }
                CommandKind::Stop => break,
                CommandKind::Model { .. } | CommandKind::CommandFile { .. } => {}
            }
        }
        if self.commands.is_empty() {
            messages.extend(acting(&dataset).map(|error| Message::new(error, source)));
        }
        let messages = self.levels.judge_all(messages);
        if messages.iter().any(Message::is_error) {
            Err(InputError { messages })
        } else {
            Ok((measures, messages))
        }
    }

    /// A message about a command.
    pub(crate) fn about(
        &self,
        step: &SourcedCommand,
        severity: Severity,
        code: Code,
        text: String,
        help: Option<&str>,
    ) -> Message {
        let source = &self.sources[step.source];
        let span = step.command.span;
        let mut diagnostic = Diagnostic::new(severity, code, source.name(), span, text);
        diagnostic.help = help.map(str::to_owned);
        Message::new(diagnostic, source)
    }

    /// What a SIMULATE is told before the run that cannot be carried out if those before it run to
    /// their ends. A failure or a sensor may end one of them earlier, so that an end that is over
    /// is judged when its turn comes; a sensor is expected to.
    fn foreseen(&self, error: SpanError, step: &SourcedCommand) -> Option<Message> {
        let severity = match error {
            SpanError::Past { .. } if self.dataset.sensors.iter().any(|s| s.returns) => {
                return None;
            }
            SpanError::Past { .. } => Severity::Warning,
            SpanError::Outputs(_) => Severity::Error,
        };
        let text = error.to_string();
        Some(self.about(step, severity, error.code(), text, Some(error.help())))
    }

    /// Makes a change of a command; returns what is to be said about it.
    pub(crate) fn change(
        &self,
        dataset: &mut Dataset,
        change: &Change,
        source: usize,
    ) -> Vec<Message> {
        let source = &self.sources[source];
        let diagnostics = dataset.apply(change).into_iter();
        diagnostics
            .map(|diagnostic| Message::new(diagnostic, source))
            .collect()
    }

    /// Messages about a changed model, at the command that changed it.
    fn at_command(
        &self,
        diagnostics: Option<Vec<Diagnostic>>,
        command: &SourcedCommand,
    ) -> Vec<Message> {
        let source = &self.sources[command.source];
        let diagnostics = diagnostics.into_iter().flatten();
        let moved = diagnostics
            .filter(|d| d.severity == Severity::Error)
            .map(|d| {
                let moved = Diagnostic {
                    source: source.name().to_owned(),
                    span: command.command.span,
                    replacement: None,
                    ..d
                };
                Message::new(moved, source)
            });
        moved.collect()
    }
}

fn has_error(diagnostics: &[Diagnostic]) -> bool {
    diagnostics.iter().any(|d| d.severity == Severity::Error)
}

/// One second in the unit of time of a dataset.
pub(crate) fn second(dataset: &Dataset) -> f64 {
    let time = dataset.units.as_ref().and_then(|units| units.time);
    time.map_or(1.0, |unit| 1.0 / unit.si())
}
