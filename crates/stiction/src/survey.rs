//! What the commands of a run will ask for, looked through before they are carried out.

use std::collections::HashMap;

use dataset::{
    Change, ChangeKind, Code, CommandKind, Dataset, Diagnostic, Reload, SavedIn, Severity, Simulate,
};

use crate::lower::{Measures, Mode, lower};
use crate::message::Message;
use crate::project::{Project, SourcedCommand};
use crate::refusal;
use crate::time_span::{self, SpanError};

/// Looks through the model as given and all commands; returns the measures of every model on the way
/// and what is to be said.
pub(crate) fn of_project(project: &Project) -> (Measures, Vec<Message>) {
    let mut measures = Measures::default();
    let (dataset, source) = (project.dataset(), project.model_source());
    let lowered = lower(dataset, source.name(), &mut measures, &Mode::Dynamic.into());
    // A model that is refused as given would be refused again.
    let given = lowered.is_ok();
    let mut messages: Vec<Message> = lowered
        .map_or_else(|diagnostics| diagnostics, |lowered| lowered.warnings)
        .into_iter()
        .map(|diagnostic| Message::new(diagnostic, source))
        .collect();
    let start = Moment {
        dataset: dataset.clone(),
        time: 0.0,
    };
    messages.extend(of_commands(
        project,
        project.steps(),
        start,
        given,
        &mut measures,
    ));
    if project.steps().is_empty() {
        let acting = refusal::acting(dataset, source.name());
        messages.extend(acting.map(|error| Message::new(error, source)));
    }
    (measures, messages)
}

/// The model, and the time that it stands at.
#[derive(Clone, Debug)]
pub(crate) struct Moment {
    pub(crate) dataset: Dataset,
    pub(crate) time: f64,
}

/// Looks through commands that begin at a moment. `lowers` says whether changed models are lowered;
/// `measures` takes on theirs.
pub(crate) fn of_commands(
    project: &Project,
    steps: &[SourcedCommand],
    start: Moment,
    lowers: bool,
    measures: &mut Measures,
) -> Vec<Message> {
    let mut survey = Survey {
        project,
        lowers,
        measures,
        now: start,
        changed: None,
        back: None,
        told: false,
        saved: HashMap::new(),
        messages: Vec::new(),
    };
    for step in steps {
        if !survey.command(step) {
            break;
        }
    }
    survey.messages
}

struct Survey<'a> {
    project: &'a Project,
    lowers: bool,
    measures: &'a mut Measures,
    now: Moment,
    /// The last command that has changed the model since it was lowered.
    changed: Option<&'a SourcedCommand>,
    /// The command that has brought back what is not simulated.
    back: Option<&'a SourcedCommand>,
    /// What is not simulated is told once.
    told: bool,
    /// What the commands so far have saved.
    saved: HashMap<&'a SavedIn, Moment>,
    messages: Vec<Message>,
}

impl<'a> Survey<'a> {
    /// Looks at a command; returns whether what follows can be looked at now.
    fn command(&mut self, step: &'a SourcedCommand) -> bool {
        match &step.command.kind {
            CommandKind::Change(change) => self.change(change, step),
            CommandKind::Simulate(simulate) => {
                self.analysis();
                self.simulate(simulate, step);
            }
            CommandKind::Eigensolution(asked) => {
                self.analysis();
                if let Some((id, _)) = asked.reference {
                    self.marker(id, step);
                }
            }
            CommandKind::Info(request) => {
                self.analysis();
                let markers = [request.i, request.j, request.rm].into_iter().flatten();
                for id in markers {
                    self.marker(id, step);
                }
            }
            CommandKind::Save(place) => {
                self.saved.insert(place, self.now.clone());
            }
            CommandKind::Reload(reload) => return self.reload(reload, step),
            CommandKind::Stop => return false,
            CommandKind::Model { .. } | CommandKind::CommandFile { .. } | CommandKind::Time => {}
        }
        true
    }

    /// Reports a marker that does not exist.
    fn marker(&mut self, id: u32, step: &SourcedCommand) {
        if self.now.dataset.markers.by_id(id).is_none() {
            let (code, text) = (Code::MissingElement, format!("there is no MARKER/{id}"));
            let message = self.project.about(step, Severity::Error, code, text, None);
            self.messages.push(message);
        }
    }

    fn acting(&self) -> Option<Diagnostic> {
        let source = self.project.model_source().name();
        refusal::acting(&self.now.dataset, source)
    }

    /// Before the model is simulated.
    fn analysis(&mut self) {
        let source = self.project.model_source();
        if let Some(changed) = self.changed.take().filter(|_| self.lowers) {
            let dataset = &self.now.dataset;
            let lowered = lower(dataset, source.name(), self.measures, &Mode::Dynamic.into());
            let errors = lowered.err().unwrap_or_default();
            self.at_command(errors, changed);
        }
        if self.told {
            return;
        }
        let Some(mut found) = self.acting() else {
            return;
        };
        self.told = true;
        if let Some(step) = self.back {
            found.help("leave it out of this command, or take it out of the model");
            self.at_command(vec![found], step);
        } else {
            self.messages.push(Message::new(found, source));
        }
    }

    fn change(&mut self, change: &Change, step: &'a SourcedCommand) {
        let switches = matches!(change.kind, ChangeKind::Activity(_));
        let rested = switches && self.acting().is_none();
        let found = self
            .project
            .change(&mut self.now.dataset, change, step.source);
        self.messages.extend(found);
        if rested && self.acting().is_some() {
            self.back = Some(step);
        }
        self.changed = Some(step);
    }

    fn simulate(&mut self, simulate: &Simulate, step: &SourcedCommand) {
        let time = self.now.time;
        match time_span::span(simulate, time) {
            Ok(span) => self.now.time = span.map_or(time, |span| span.end),
            Err(error) => {
                let message = self.foreseen(error, step);
                self.messages.extend(message);
            }
        }
    }

    /// Back to what the commands so far have saved. What a file of another run holds is known only
    /// when its turn comes, and with it what follows.
    fn reload(&mut self, reload: &Reload, step: &'a SourcedCommand) -> bool {
        match (self.saved.get(&reload.from), &reload.from) {
            (Some(saved), SavedIn::File(_)) => self.now = saved.clone(),
            (Some(saved), SavedIn::Buffer(_)) => self.now.time = saved.time,
            (None, SavedIn::File(_)) => return false,
            (None, SavedIn::Buffer(name)) => {
                let text = format!("nothing has been saved in the buffer `{name}`");
                let help = Some("write SAVE/STATES, BUFFER = the same name before it");
                let (code, error) = (Code::SavedSystem, Severity::Error);
                let message = self.project.about(step, error, code, text, help);
                self.messages.push(message);
            }
        }
        self.changed = Some(step);
        true
    }

    /// What a SIMULATE is told before the run that cannot be carried out if those before it run to
    /// their ends. A failure or a sensor may end one of them earlier, so that an end that is over
    /// is judged when its turn comes; a sensor is expected to.
    fn foreseen(&self, error: SpanError, step: &SourcedCommand) -> Option<Message> {
        let severity = match error {
            SpanError::Past { .. } if self.now.dataset.sensors.iter().any(|s| s.returns) => {
                return None;
            }
            SpanError::Past { .. } => Severity::Warning,
            SpanError::Outputs(_) => Severity::Error,
        };
        let text = error.to_string();
        Some(
            self.project
                .about(step, severity, error.code(), text, Some(error.help())),
        )
    }

    /// Messages about a changed model, at the command that changed it.
    fn at_command(&mut self, diagnostics: Vec<Diagnostic>, command: &SourcedCommand) {
        let source = &self.project.sources[command.source];
        let diagnostics = diagnostics.into_iter();
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
        self.messages.extend(moved);
    }
}
