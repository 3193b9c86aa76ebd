//! A model and the commands to run on it, from files.

use std::collections::HashSet;
use std::path::{Path, PathBuf};

use dataset::{
    Change, Code, Command, CommandKind, Dataset, Diagnostic, Severity, Simulate, SimulationKind,
    Source, Span,
};

use crate::lower::{Measures, lower};
use crate::message::{InputError, Message};
use crate::settings;

/// A checked dataset with the commands of its command file.
///
/// ```no_run
/// let project = stiction::Project::load("delta.acf".as_ref())?;
/// println!("{} parts, {} commands", project.dataset().parts.len(), project.commands().len());
/// # Ok::<(), stiction::InputError>(())
/// ```
#[derive(Clone, Debug)]
pub struct Project {
    dataset: Dataset,
    /// Place of the dataset's source in `sources`.
    model: usize,
    commands: Vec<SourcedCommand>,
    sources: Vec<Source>,
    files: Vec<PathBuf>,
    prefix: String,
    warnings: Vec<Message>,
    is_dataset: bool,
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
        let mut loader = Loader::default();
        let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
        let is_dataset = extension != "acf";
        if is_dataset {
            loader.read_dataset(path, None);
        } else {
            loader.read_commands(path);
        }
        loader.finish(is_dataset)
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

    pub(crate) fn source(&self, place: usize) -> &Source {
        &self.sources[place]
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
        let failed = has_error(&diagnostics);
        let messages: Vec<Message> = diagnostics
            .into_iter()
            .map(|d| Message::new(d, &source))
            .collect();
        if failed {
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
        let source = self.model_source();
        let lowered = lower(&self.dataset, source.name(), &mut Measures::default());
        let lowered = lowered.map_err(|diagnostics| InputError {
            messages: diagnostics
                .into_iter()
                .map(|diagnostic| Message::new(diagnostic, source))
                .collect(),
        })?;
        Ok(mechanics::Simulation::new(
            lowered.model,
            second(&self.dataset),
        ))
    }

    /// Lowers the model as given and after each change of the command file, so that everything
    /// that is not simulated is known before the run; returns the measures of all of them.
    ///
    /// # Errors
    /// Everything that is not simulated, and simulations that cannot be.
    pub(crate) fn survey(&self) -> Result<(Measures, Vec<Message>), InputError> {
        let mut measures = Measures::default();
        let source = self.model_source();
        let lowered = lower(&self.dataset, source.name(), &mut measures);
        let given = lowered.is_ok();
        let mut messages: Vec<Message> = lowered
            .map_or_else(|diagnostics| diagnostics, |lowered| lowered.warnings)
            .into_iter()
            .map(|diagnostic| Message::new(diagnostic, source))
            .collect();
        let mut dataset = self.dataset.clone();
        let mut changed = None;
        let mut time = 0.0;
        for step in &self.commands {
            match &step.command.kind {
                CommandKind::Change(change) => {
                    messages.extend(self.change(&mut dataset, change, step.source));
                    changed = Some(step);
                }
                CommandKind::Simulate(simulate) => {
                    // A model that is refused as given would be refused again.
                    if let Some(changed) = changed.take().filter(|_| given) {
                        let lowered = lower(&dataset, source.name(), &mut measures);
                        messages.extend(self.at_command(lowered.err(), changed));
                    }
                    match settings::span(simulate, time) {
                        Ok(span) => time = span.map_or(time, |span| span.end),
                        Err(text) => messages.push(self.refuse(text, step)),
                    }
                }
                CommandKind::Stop => break,
                CommandKind::Model { .. } | CommandKind::CommandFile { .. } => {}
            }
        }
        if messages.iter().any(Message::is_error) {
            Err(InputError { messages })
        } else {
            Ok((measures, messages))
        }
    }

    /// An error about a command.
    pub(crate) fn refuse(&self, message: String, step: &SourcedCommand) -> Message {
        let source = &self.sources[step.source];
        let diagnostic = Diagnostic {
            code: Code::InvalidValue,
            severity: Severity::Error,
            message,
            source: source.name().to_owned(),
            span: step.command.span,
            notes: Vec::new(),
            help: None,
        };
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
                let span = command.command.span;
                Message::new(
                    Diagnostic {
                        source: source.name().to_owned(),
                        span,
                        ..d
                    },
                    source,
                )
            });
        moved.collect()
    }
}

fn has_error(diagnostics: &[Diagnostic]) -> bool {
    diagnostics.iter().any(|d| d.severity == Severity::Error)
}

/// A command file that is being gone through.
struct OpenFile {
    path: PathBuf,
    source: usize,
    rest: std::vec::IntoIter<Command>,
}

/// Files while they are read.
#[derive(Default)]
struct Loader {
    sources: Vec<Source>,
    files: Vec<PathBuf>,
    messages: Vec<Message>,
    commands: Vec<SourcedCommand>,
    dataset: Option<(Dataset, usize)>,
    prefix: Option<String>,
}

/// The place of a command that names a file.
struct Naming {
    source: usize,
    span: Span,
}

impl Loader {
    /// Reads a source; an error is reported at the command that names it, if one does.
    fn read(&mut self, path: &Path, naming: Option<&Naming>) -> Option<usize> {
        let shown = path.display().to_string();
        let text = std::fs::read(path).map_err(|error| error.to_string());
        let source = match text {
            Ok(bytes) => match Source::from_bytes(&shown, &bytes) {
                Ok(source) => source,
                Err(diagnostic) => {
                    let empty = Source::from_text(&shown, String::new());
                    self.messages.push(Message::new(*diagnostic, &empty));
                    return None;
                }
            },
            Err(error) => {
                let message = format!("cannot read {shown}: {error}");
                self.report(&shown, naming, message, None);
                return None;
            }
        };
        self.files.push(path.to_owned());
        self.sources.push(source);
        Some(self.sources.len() - 1)
    }

    fn report(
        &mut self,
        file: &str,
        naming: Option<&Naming>,
        message: String,
        help: Option<String>,
    ) {
        let empty = Source::from_text(file, String::new());
        let source = naming.map_or(&empty, |naming| &self.sources[naming.source]);
        let diagnostic = Diagnostic {
            code: Code::MissingElement,
            severity: Severity::Error,
            message,
            source: source.name().to_owned(),
            span: naming.map_or_else(Span::default, |naming| naming.span),
            notes: Vec::new(),
            help,
        };
        self.messages.push(Message::new(diagnostic, source));
    }

    fn read_dataset(&mut self, path: &Path, naming: Option<&Naming>) {
        let base = path.file_stem().unwrap_or_default();
        let base = || base.to_string_lossy().into_owned();
        self.prefix = Some(self.prefix.take().unwrap_or_else(base));
        let Some(place) = self.read(path, naming) else {
            return;
        };
        let source = &self.sources[place];
        let (dataset, diagnostics) = dataset::read_dataset(source);
        self.messages
            .extend(diagnostics.into_iter().map(|d| Message::new(d, source)));
        self.dataset = Some((dataset, place));
    }

    fn open(&mut self, path: &Path, naming: Option<&Naming>) -> Option<OpenFile> {
        let source = self.read(path, naming)?;
        let (file, diagnostics) = dataset::read_commands(&self.sources[source]);
        let located = diagnostics
            .into_iter()
            .map(|d| Message::new(d, &self.sources[source]));
        self.messages.extend(located);
        Some(OpenFile {
            path: path.to_owned(),
            source,
            rest: file.commands.into_iter(),
        })
    }

    /// Reads a command file and the ones it calls, in the order of the commands.
    fn read_commands(&mut self, path: &Path) {
        let mut called = HashSet::from([path.to_owned()]);
        let mut open: Vec<OpenFile> = self.open(path, None).into_iter().collect();
        let named = !open.is_empty();
        while let Some(file) = open.last_mut() {
            let Some(command) = file.rest.next() else {
                open.pop();
                continue;
            };
            let naming = Naming {
                source: file.source,
                span: command.span,
            };
            let folder = file.path.parent().map(Path::to_owned).unwrap_or_default();
            match &command.kind {
                CommandKind::Model {
                    path,
                    output_prefix,
                } => {
                    self.model(&folder, path, output_prefix.as_deref(), &naming);
                }
                CommandKind::CommandFile { path } => {
                    let found = resolve(&folder, path, "acf");
                    // A file that is called twice may call itself.
                    if called.insert(found.clone()) {
                        open.extend(self.open(&found, Some(&naming)));
                    } else {
                        let message = format!("{} is called twice", found.display());
                        self.report("", Some(&naming), message, None);
                    }
                    continue;
                }
                CommandKind::Simulate(_) | CommandKind::Change(_) if self.prefix.is_none() => {
                    let message = "this command comes before any model".to_owned();
                    let help = Some("write FILE/MODEL=name before it".to_owned());
                    self.report("", Some(&naming), message, help);
                    continue;
                }
                _ => {}
            }
            self.commands.push(SourcedCommand {
                command,
                source: naming.source,
            });
        }
        if named && self.dataset.is_none() && !self.messages.iter().any(Message::is_error) {
            let message = "this command file names no model".to_owned();
            let help = Some("write FILE/MODEL=name before the first SIMULATE".to_owned());
            let naming = Naming {
                source: 0,
                span: Span::default(),
            };
            self.report("", Some(&naming), message, help);
        }
    }

    fn model(&mut self, folder: &Path, path: &str, prefix: Option<&str>, naming: &Naming) {
        if self.dataset.is_some() {
            let message = "a second model in one run is not supported yet".to_owned();
            let help = Some("use one command file for each model".to_owned());
            self.report("", Some(naming), message, help);
            return;
        }
        self.prefix = prefix
            .map(|prefix| base_name(prefix).to_owned())
            .filter(|p| !p.is_empty());
        let found = resolve(folder, path, "adm");
        self.read_dataset(&found, Some(naming));
    }

    fn finish(self, is_dataset: bool) -> Result<Project, InputError> {
        let failed = self.messages.iter().any(Message::is_error);
        let Some((dataset, model)) = self.dataset.filter(|_| !failed) else {
            return Err(InputError {
                messages: self.messages,
            });
        };
        Ok(Project {
            dataset,
            model,
            commands: self.commands,
            sources: self.sources,
            files: self.files,
            prefix: self.prefix.unwrap_or_else(|| "model".to_owned()),
            warnings: self.messages,
            is_dataset,
        })
    }
}

/// The part of a path behind its last separator, of this or another system.
fn base_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}

/// The file that a command means: the path as written from the folder of the command file, else
/// its base name there; with the extension added where it is missing.
fn resolve(folder: &Path, written: &str, extension: &str) -> PathBuf {
    let with_extension = |name: &str| {
        let has = Path::new(name)
            .extension()
            .is_some_and(|e| e.eq_ignore_ascii_case(extension));
        if has {
            folder.join(name)
        } else {
            folder.join(format!("{name}.{extension}"))
        }
    };
    let written = written.trim();
    let direct = with_extension(written);
    if direct.is_file() {
        direct
    } else {
        with_extension(base_name(written))
    }
}

/// One second in the unit of time of a dataset.
pub(crate) fn second(dataset: &Dataset) -> f64 {
    let time = dataset.units.as_ref().and_then(|units| units.time);
    time.map_or(1.0, |unit| 1.0 / unit.si())
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn paths_of_other_systems_fall_back_to_the_base_name() {
        let found = resolve(Path::new("here"), r"C:\Users\someone\models\arm", "adm");
        assert_eq!(found, Path::new("here").join("arm.adm"));
        let found = resolve(Path::new("here"), "arm.v2", "adm");
        assert_eq!(found, Path::new("here").join("arm.v2.adm"));
        assert_eq!(base_name("plain"), "plain");
    }
}
