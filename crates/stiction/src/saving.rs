//! SAVE and RELOAD carried out.
//!
//! A run that saves goes on from what it has saved, as one that reloads does, so that both give the
//! same bits.

use std::path::{Path, PathBuf};

use dataset::{Change, CommandKind, Reload, SavedIn, Severity, Source};
use results::Header;

use crate::channels::unit_names;
use crate::loader::base_name;
use crate::lower::{Measures, Setting, lower};
use crate::message::Message;
use crate::project::{Project, SourcedCommand};
use crate::recorder::ResultFiles;
use crate::runner::{Halt, Recorded, Runner, status};
use crate::saved_system::{SavedSystem, is_saved_system};
use crate::session::Outcome;
use crate::survey::{self, Moment};
use crate::whole_file::write_whole;

impl Runner<'_> {
    /// SAVE.
    pub(crate) fn save(&mut self, place: &SavedIn, step: &SourcedCommand) -> Result<(), Halt> {
        self.take_changes(self.lowered.mode)?;
        let saved = SavedSystem {
            version: env!("CARGO_PKG_VERSION").to_owned(),
            model: self.session.project.model_checksum(),
            changes: self.changes_made.clone(),
            setting: self.setting(self.lowered.mode),
            numbering: self.measures.numbering(),
            assembled: self.assembled,
            recorded: self.instant,
            account: self.recorder.account.clone(),
            simulation: self.simulation.save(),
        };
        let time = saved.simulation.time();
        let kept = match place {
            // It writes no files, and reads its own in the place of those that the first run writes.
            SavedIn::File(name) if self.recorder.role.is_second() => {
                self.files.insert(name.clone(), saved.clone());
                name.clone()
            }
            SavedIn::File(name) => {
                let path = self.folder.join(name);
                self.write_saved(&saved, &path, step)?;
                path.display().to_string()
            }
            SavedIn::Buffer(name) => format!("buffer {name}"),
        };
        self.go_on_from(&saved, step)?;
        if let SavedIn::Buffer(name) = place {
            self.buffers.insert(name.clone(), saved);
        }
        self.log.note(&format!("time {time} saved in {kept}"))?;
        Ok(())
    }

    /// Writes a file of its own, whole or not at all.
    fn write_saved(
        &self,
        saved: &SavedSystem,
        path: &Path,
        step: &SourcedCommand,
    ) -> Result<(), Halt> {
        let shown = path.display();
        let there = std::fs::read(path);
        if there.is_ok_and(|text| !is_saved_system(&text)) {
            let text = format!("{shown} exists and is no saved system: it is not overwritten");
            return Err(self.refuse(step, text, "give FILE another name"));
        }
        let text = saved.to_text();
        let written = text
            .map_err(std::io::Error::other)
            .and_then(|text| write_whole(path, |part| std::fs::write(part, text)));
        written.map_err(|error| {
            let text = format!("{shown} cannot be written: {error}");
            self.refuse(step, text, "name a file in a folder that exists")
        })
    }

    /// RELOAD.
    pub(crate) fn reload(
        &mut self,
        reload: &Reload,
        step: &SourcedCommand,
        rest: &[SourcedCommand],
    ) -> Result<(), Halt> {
        let (saved, place) = match &reload.from {
            SavedIn::File(name) => self.read_saved(name, step)?,
            SavedIn::Buffer(name) => {
                let saved = self.buffers.get(name).cloned();
                let saved = saved.ok_or_else(|| {
                    let text = format!("nothing has been saved in the buffer `{name}`");
                    self.refuse(
                        step,
                        text,
                        "write SAVE/STATES, BUFFER = the same name before it",
                    )
                })?;
                (saved, format!("buffer {name}"))
            }
        };
        let project = self.session.project;
        let (dataset, changes) = match reload.from {
            SavedIn::File(_) => (self.changed_dataset(&saved.changes), saved.changes.clone()),
            // The state alone: the model stays as it was changed since.
            SavedIn::Buffer(_) => (self.dataset.clone(), self.changes_made.clone()),
        };
        // The model and the commands that follow may read what this run has not met so far.
        self.measures = Measures::of_numbering(&saved.numbering);
        let source = project.model_source().name();
        // What is wrong with the model is told when it is simulated.
        let _ = lower(&dataset, source, &mut self.measures, &saved.setting);
        let moment = Moment {
            dataset: dataset.clone(),
            time: saved.simulation.time(),
        };
        let next = |step: &SourcedCommand| matches!(step.command.kind, CommandKind::Reload(_));
        let rest = rest.split(next).next().unwrap_or_default();
        let found = survey::of_commands(project, rest, moment, true, &mut self.measures);
        if let Some(error) = found.into_iter().find(Message::is_error) {
            return Err(Halt::Ended(refused(&error)));
        }
        self.go_on_from(&saved, step)?;
        let time = saved.simulation.time();
        self.log
            .note(&format!("back at time {time} from {place}"))?;
        if let Some(prefix) = &reload.output_prefix {
            let title = reload.title.as_ref().unwrap_or(&self.dataset.title);
            self.change_files(prefix, title.clone(), step)?;
        }
        if self.instant != Recorded::Nothing {
            let written = self.recorder.initial(&self.simulation.snapshot());
            written.map_err(|stop| Halt::of_row(Outcome::AssemblyFailed, stop))?;
        }
        self.changed = changes != saved.changes;
        (self.dataset, self.changes_made) = (dataset, changes);
        Ok(())
    }

    /// Reads a saved system, from the folder of the results or that of the command file.
    fn read_saved(&self, name: &str, step: &SourcedCommand) -> Result<(SavedSystem, String), Halt> {
        if let Some(saved) = self.files.get(name) {
            return Ok((saved.clone(), name.to_owned()));
        }
        let project = self.session.project;
        let places = [self.folder.clone(), project.folder_of(step)];
        let paths = places.map(|folder| folder.join(name));
        let path = paths.iter().find(|path| path.is_file());
        let Some(path) = path else {
            let text = format!("there is no {}", paths[0].display());
            let help =
                "RELOAD looks in the folder of the results, then in that of the command file";
            return Err(self.refuse(step, text, help));
        };
        let shown = path.display().to_string();
        let text = std::fs::read_to_string(path).map_err(|error| error.to_string());
        let saved = text.and_then(|text| SavedSystem::from_text(&text).map_err(|e| e.to_string()));
        let saved = saved.map_err(|error| {
            let text = format!("{shown} cannot be reloaded: {error}");
            self.refuse(step, text, "name a file that SAVE/SYSTEM has written")
        })?;
        if saved.model != project.model_checksum() {
            let text = format!("{shown} cannot be reloaded: it was saved of another model");
            let help = "reload it with the dataset, and the --set, that it was saved with";
            return Err(self.refuse(step, text, help));
        }
        Ok((saved, shown))
    }

    /// The dataset as given, with the changes of a command file that were made in it before.
    pub(crate) fn changed_dataset(&self, changes: &str) -> dataset::Dataset {
        let mut dataset = self.session.project.dataset().clone();
        let source = Source::from_text("changes", changes.to_owned());
        let (file, _) = dataset::read_commands(&source);
        for command in file.commands {
            if let CommandKind::Change(change) = command.kind {
                let change: Change = *change;
                // It was carried out before, so that nothing is wrong with it.
                let _ = dataset.apply(&change);
            }
        }
        dataset
    }

    /// Puts the simulation of the dataset where it was saved.
    fn go_on_from(&mut self, saved: &SavedSystem, step: &SourcedCommand) -> Result<(), Halt> {
        self.dataset = self.changed_dataset(&saved.changes);
        let source = self.session.project.model_source().name();
        // Options are those of this run.
        let setting = Setting {
            reactions: self.options.reactions,
            ..saved.setting.clone()
        };
        let lowered = lower(&self.dataset, source, &mut self.measures, &setting);
        let lowered = lowered.map_err(|diagnostics| {
            let text: Vec<String> = diagnostics.into_iter().map(|d| d.message).collect();
            self.refuse(step, text.join("; "), "change it in the dataset")
        })?;
        let restored = self
            .simulation
            .restore(lowered.model.clone(), &saved.simulation);
        restored.map_err(|error| {
            let help = "reload it with the dataset that it was saved with";
            self.refuse(step, error.to_string(), help)
        })?;
        self.recorder.outputs = lowered.outputs.clone();
        self.recorder.account.clone_from(&saved.account);
        self.lowered = lowered;
        self.kept.clone_from(&saved.setting.kept);
        self.changed = false;
        self.assembled = saved.assembled;
        self.instant = saved.recorded;
        self.length = self.simulation.system().length_scale();
        Ok(())
    }

    /// Ends the result files and begins others.
    fn change_files(
        &mut self,
        prefix: &str,
        title: String,
        step: &SourcedCommand,
    ) -> Result<(), Halt> {
        let prefix = base_name(prefix);
        let paths = ResultFiles::paths(&self.folder, prefix);
        if prefix.is_empty() || self.recorder.has_written(&paths[0]) {
            let text = format!("OUTPUT_PREFIX = {prefix} names no other files");
            return Err(self.refuse(step, text, "write a prefix that this run has not used"));
        }
        if self.recorder.files.is_none() {
            return Ok(());
        }
        let units = unit_names(&self.dataset);
        let header = Header {
            title,
            units,
            ..Header::default()
        };
        let opened = ResultFiles::create(paths, &header, &self.recorder.channels)?;
        let status = status(&self.outcome());
        self.recorder.change_files(opened, status)?;
        self.recorder.model_input()?;
        Ok(())
    }

    /// A command that is not carried out ends the run.
    pub(crate) fn refuse(&self, step: &SourcedCommand, text: String, help: &str) -> Halt {
        let project: &Project = self.session.project;
        let code = dataset::Code::SavedSystem;
        let message = project.about(step, Severity::Error, code, text, Some(help));
        Halt::Ended(refused(&message))
    }
}

fn refused(message: &Message) -> Outcome {
    Outcome::Refused(message.to_string().trim_end().to_owned())
}

impl Project {
    /// The folder of the file that a command stands in.
    fn folder_of(&self, step: &SourcedCommand) -> PathBuf {
        let path = Path::new(self.sources[step.source].name());
        path.parent().map(Path::to_owned).unwrap_or_default()
    }
}
