//! A model and the commands to run on it, from files.

use std::path::{Path, PathBuf};

use dataset::{
    Change, Code, Command, CommandKind, Dataset, Diagnostic, Severity, Simulate, SimulationKind,
    Source, Span,
};
use sha2::{Digest, Sha256};

use crate::channels::unit_names;
use crate::files::{Disk, Files};
use crate::levels::Levels;
use crate::loader;
use crate::lower::{Measures, Mode, lower};
use crate::message::{InputError, Message};
use crate::refusal;
use crate::survey;

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
    /// The changes made before the run.
    pub(crate) given_changes: Vec<String>,
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
        Self::load_from(&Disk, path, levels)
    }

    /// [`Project::load_with`] from other files than those of the disk.
    ///
    /// What a run reads itself (systems that RELOAD names) it reads from the disk still.
    ///
    /// # Errors
    /// Everything that is wrong with the files, and what is denied.
    pub fn load_from(files: &dyn Files, path: &Path, levels: Levels) -> Result<Self, InputError> {
        loader::load(files, path, levels)
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

    /// Names of the units of the model, as results have them.
    #[must_use]
    pub fn unit_names(&self) -> results::UnitNames {
        unit_names(&self.dataset)
    }

    /// A checksum of the model as given: the text of the dataset and the changes made before the run.
    #[must_use]
    pub fn model_checksum(&self) -> String {
        let mut hash = Sha256::new();
        hash.update(self.model_source().text());
        for change in &self.given_changes {
            hash.update([0]);
            hash.update(change);
        }
        hexadecimal(&hash.finalize())
    }

    /// The file of the dataset with the changes made before the run: arguments are replaced where they
    /// stand, and all else, comments and layout too, is as it was. Commands are not part of it.
    ///
    /// ```no_run
    /// let mut project = stiction::Project::load("pendulum.adm".as_ref())?;
    /// project.set("FRICTION/1, MU_STATIC=0.2")?;
    /// std::fs::write("rough.adm", project.to_dataset_file()?).expect("it can be written");
    /// # Ok::<(), stiction::InputError>(())
    /// ```
    ///
    /// # Errors
    /// Changes that a dataset cannot say, such as DEACTIVATE.
    pub fn to_dataset_file(&self) -> Result<Vec<u8>, InputError> {
        let source = self.model_source();
        let edited = dataset::edit(source, &self.given_changes);
        let text = edited.map_err(|diagnostics| self.refused(diagnostics))?;
        Ok(source.encode(&text))
    }

    pub(crate) fn steps(&self) -> &[SourcedCommand] {
        &self.commands
    }

    /// A command as it is written.
    pub(crate) fn text_of(&self, step: &SourcedCommand) -> &str {
        self.sources[step.source].slice(step.command.span)
    }

    pub(crate) fn model_source(&self) -> &Source {
        &self.sources[self.model]
    }

    /// Makes a change before the run, as a command would: `FRICTION/103, MU_STATIC=0.2`.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn set(&mut self, change: &str) -> Result<(), InputError> {
        self.set_as("--set", change)
    }

    /// [`Project::set`], with another name for the place that the change comes from in messages.
    ///
    /// # Errors
    /// What is wrong with it.
    pub fn set_as(&mut self, place: &str, change: &str) -> Result<(), InputError> {
        let source = Source::from_text(place, change.to_owned());
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
        self.given_changes.push(change.to_owned());
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
        let lowered = lower(&self.dataset, source, measures, &Mode::Dynamic.into());
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

    /// Looks through the model as given and after each change of the command file, so that everything
    /// that is not simulated is known before the run; returns the measures of all of them.
    ///
    /// # Errors
    /// Everything that is not simulated, and simulations that cannot be.
    pub(crate) fn survey(&self) -> Result<(Measures, Vec<Message>), InputError> {
        let (measures, messages) = survey::of_project(self);
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
}

fn has_error(diagnostics: &[Diagnostic]) -> bool {
    diagnostics.iter().any(|d| d.severity == Severity::Error)
}

/// Bytes as text, two digits each, as checksums are written.
///
/// ```
/// assert_eq!(stiction::hexadecimal(&[0, 175]), "00af");
/// ```
#[must_use]
pub fn hexadecimal(bytes: &[u8]) -> String {
    bytes.iter().map(|byte| format!("{byte:02x}")).collect()
}

/// One second in the unit of time of a dataset.
pub(crate) fn second(dataset: &Dataset) -> f64 {
    let time = dataset.units.as_ref().and_then(|units| units.time);
    time.map_or(1.0, |unit| 1.0 / unit.si())
}
