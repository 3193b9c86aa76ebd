//! Reads the files of a project: a dataset, or command files and the dataset that they name.

use std::path::{Path, PathBuf};

use dataset::{Code, Command, CommandKind, Dataset, Diagnostic, Severity, Source, Span};

use crate::files::Files;
use crate::levels::Levels;
use crate::lower::{Measures, Mode, lower};
use crate::message::{InputError, Message};
use crate::project::{Project, SourcedCommand};

/// Reads a dataset, or a command file with the dataset that it names.
pub(crate) fn load(from: &dyn Files, path: &Path, levels: Levels) -> Result<Project, InputError> {
    let mut loader = Loader {
        from,
        sources: Vec::new(),
        files: Vec::new(),
        messages: Vec::new(),
        commands: Vec::new(),
        dataset: None,
        prefix: None,
    };
    let extension = path.extension().unwrap_or_default().to_ascii_lowercase();
    let is_dataset = extension != "acf";
    if is_dataset {
        loader.read_dataset(path, None);
    } else {
        loader.read_commands(path);
    }
    loader.finish(is_dataset, levels)
}

/// Most files in one project: files that call others twice each soon are more than any memory.
const MOST_FILES: usize = 1000;

/// A command file that is being gone through.
struct OpenFile {
    path: PathBuf,
    source: usize,
    rest: std::vec::IntoIter<Command>,
}

/// Files while they are read.
struct Loader<'a> {
    from: &'a dyn Files,
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

impl Loader<'_> {
    /// Reads a source; an error is reported at the command that names it, if one does.
    fn read(&mut self, path: &Path, naming: Option<&Naming>) -> Option<usize> {
        let shown = path.display().to_string();
        let text = self.from.read(path).map_err(|error| error.to_string());
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
                let help = match naming {
                    Some(_) => "a file named by a command is looked for beside the command file",
                    None => "name a dataset (.adm) or a command file (.acf)",
                };
                self.report(Code::MissingFile, &shown, naming, message, Some(help));
                return None;
            }
        };
        self.files.push(path.to_owned());
        self.sources.push(source);
        Some(self.sources.len() - 1)
    }

    fn report(
        &mut self,
        code: Code,
        file: &str,
        naming: Option<&Naming>,
        message: String,
        help: Option<&str>,
    ) {
        let empty = Source::from_text(file, String::new());
        let source = naming.map_or(&empty, |naming| &self.sources[naming.source]);
        let span = naming.map_or_else(Span::default, |naming| naming.span);
        let mut diagnostic = Diagnostic::new(Severity::Error, code, source.name(), span, message);
        diagnostic.help = help.map(str::to_owned);
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
        let (dataset, diagnostics) = dataset::lint_dataset(source);
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
                    let found = resolve(self.from, &folder, path, "acf");
                    if open.iter().any(|file| file.path == found) {
                        let message = format!("{} calls itself", found.display());
                        let help = Some("this would never end");
                        self.report(Code::RepeatedFile, "", Some(&naming), message, help);
                    } else if self.sources.len() == MOST_FILES {
                        let message = format!("more than {MOST_FILES} files are called");
                        let help = Some("write the commands into fewer files");
                        self.report(Code::RepeatedFile, "", Some(&naming), message, help);
                        return;
                    } else {
                        open.extend(self.open(&found, Some(&naming)));
                    }
                    continue;
                }
                CommandKind::Stop => {}
                _ if self.prefix.is_none() => {
                    let message = "this command comes before any model".to_owned();
                    let help = Some("write FILE/MODEL=name before it");
                    self.report(Code::NoModel, "", Some(&naming), message, help);
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
            let help = Some("write FILE/MODEL=name before the first SIMULATE");
            let naming = Naming {
                source: 0,
                span: Span::default(),
            };
            self.report(Code::NoModel, "", Some(&naming), message, help);
        }
    }

    fn model(&mut self, folder: &Path, path: &str, prefix: Option<&str>, naming: &Naming) {
        if self.dataset.is_some() {
            let message = "a second model in one run is not supported".to_owned();
            let help = Some("use one command file for each model");
            self.report(Code::UnsupportedStatement, "", Some(naming), message, help);
            return;
        }
        self.prefix = prefix
            .map(|prefix| base_name(prefix).to_owned())
            .filter(|p| !p.is_empty());
        let found = resolve(self.from, folder, path, "adm");
        self.read_dataset(&found, Some(naming));
    }

    /// What the dataset asks for that is not simulated, so that it shows together with its errors.
    /// Other errors of lowering would only follow from those.
    fn unsupported(&self) -> Vec<Message> {
        let Some((dataset, model)) = &self.dataset else {
            return Vec::new();
        };
        let source = &self.sources[*model];
        let lowered = lower(
            dataset,
            source.name(),
            &mut Measures::default(),
            &Mode::Dynamic.into(),
        );
        let diagnostics = lowered.err().unwrap_or_default();
        let unsupported = diagnostics.into_iter().filter(|diagnostic| {
            matches!(
                diagnostic.code,
                Code::UnsupportedStatement | Code::UnsupportedArgument | Code::UnsupportedFunction
            )
        });
        unsupported.map(|d| Message::new(d, source)).collect()
    }

    fn finish(mut self, is_dataset: bool, levels: Levels) -> Result<Project, InputError> {
        self.messages = levels.judge_all(self.messages);
        if self.messages.iter().any(Message::is_error) {
            let unsupported = self.unsupported();
            self.messages.extend(unsupported);
            return Err(InputError {
                messages: self.messages,
            });
        }
        let Some((dataset, model)) = self.dataset else {
            return Err(InputError {
                messages: self.messages,
            });
        };
        Ok(Project {
            dataset,
            given_changes: Vec::new(),
            model,
            commands: self.commands,
            sources: self.sources,
            files: self.files,
            prefix: self.prefix.unwrap_or_else(|| "model".to_owned()),
            warnings: self.messages,
            levels,
            is_dataset,
        })
    }
}

/// The part of a path behind its last separator, of this or another system.
pub(crate) fn base_name(path: &str) -> &str {
    path.rsplit(['/', '\\']).next().unwrap_or(path)
}

/// The file that a command means: the path as written from the folder of the command file, else
/// its base name there, in the end without regard to case (names written on Windows); with the
/// extension added where it is missing.
fn resolve(from: &dyn Files, folder: &Path, written: &str, extension: &str) -> PathBuf {
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
    if from.is_file(&direct) {
        return direct;
    }
    let beside = with_extension(base_name(written));
    if from.is_file(&beside) {
        return beside;
    }
    in_any_case(from, &beside).unwrap_or(beside)
}

/// The file of a folder whose name differs in case only; the first one by name.
fn in_any_case(from: &dyn Files, path: &Path) -> Option<PathBuf> {
    let (folder, name) = (path.parent()?, path.file_name()?);
    let same = from.in_folder(folder).into_iter().filter(|path| {
        path.file_name()
            .is_some_and(|n| n.eq_ignore_ascii_case(name))
    });
    same.min()
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::files::Disk;

    #[test]
    fn paths_of_other_systems_fall_back_to_the_base_name() {
        let found = resolve(
            &Disk,
            Path::new("here"),
            r"C:\Users\someone\models\arm",
            "adm",
        );
        assert_eq!(found, Path::new("here").join("arm.adm"));
        let found = resolve(&Disk, Path::new("here"), "arm.v2", "adm");
        assert_eq!(found, Path::new("here").join("arm.v2.adm"));
        assert_eq!(base_name("plain"), "plain");
    }

    #[test]
    fn names_in_another_case_are_found() {
        let folder = Path::new(env!("CARGO_MANIFEST_DIR"));
        assert_eq!(
            resolve(&Disk, folder, "cargo.TOML", "toml"),
            folder.join("Cargo.toml")
        );
    }
}
