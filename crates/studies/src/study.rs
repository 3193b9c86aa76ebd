//! What a study is, and one case of it.

use std::path::Path;

use serde_json::{Map, Value as Json, json};
use sha2::{Digest, Sha256};
use stiction::sink::Sink;
use stiction::{
    ArgumentError, InputError, Outcome, OutputError, Project, RunOptions, RunReport, Session,
    Watch, hexadecimal,
};

use crate::design::Design;
use crate::parameter::{GivenParameter, Parameter, Value};
use crate::reduction::{Reducer, Reduction};

/// Columns of the table beside parameters and outputs.
pub(crate) const OWN_COLUMNS: [&str; 6] = ["case", "success", "message", "steps", "seed", "hash"];

/// Values of a parameter that are tried before the study: where the dataset language refuses all of
/// them the parameter is wrong, else a case.
const TRIED: usize = 16;

/// An output as it is given.
#[derive(Clone, Debug, PartialEq, Eq)]
pub enum GivenOutput {
    /// A reduction, such as `max_abs(guide.force)`.
    Reduction(String),
    /// A number that the caller makes of a run, with what tells it from others.
    Called(String),
}

/// How long each case runs and how exact.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Settings {
    /// End of the dynamic simulation of a dataset, in its unit of time; `None` for a command file.
    pub end: Option<f64>,
    /// Number of its output steps.
    pub steps: Option<u32>,
    /// Time between its outputs.
    pub dtout: Option<f64>,
    /// Error tolerance instead of that of the INTEGRATOR statement.
    pub error: Option<f64>,
}

/// A study as it is given.
#[derive(Clone, Debug, PartialEq)]
pub struct Definition {
    /// In the order of the columns.
    pub parameters: Vec<GivenParameter>,
    /// How their values are put together.
    pub design: Design,
    /// Number of cases, for designs that take one.
    pub cases: Option<usize>,
    /// Seed of the design and of the cases.
    pub seed: u64,
    /// Names of the outputs and what they are.
    pub outputs: Vec<(String, GivenOutput)>,
    /// The simulation.
    pub settings: Settings,
}

/// What a [`StudyError`] is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Subject {
    /// The parameter at this place.
    Parameter(usize),
    /// The output at this place.
    Output(usize),
    /// The design or the number of cases.
    Design,
    /// The settings: `end`, `steps`, `dtout` or `error`.
    Setting(&'static str),
    /// The model.
    Model,
}

/// A study that cannot be made.
#[derive(Clone, Debug)]
pub struct StudyError {
    /// What is wrong.
    pub subject: Subject,
    /// How.
    pub cause: Cause,
}

/// What is wrong with a study.
#[derive(Clone, Debug)]
pub enum Cause {
    /// A name or value.
    Argument(ArgumentError),
    /// What the dataset language refuses, with its place.
    Input(InputError),
}

impl std::fmt::Display for StudyError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        match &self.cause {
            Cause::Argument(error) => error.fmt(f),
            Cause::Input(error) => error.fmt(f),
        }
    }
}

impl std::error::Error for StudyError {}

fn about(subject: Subject) -> impl FnOnce(ArgumentError) -> StudyError {
    move |error| StudyError {
        subject,
        cause: Cause::Argument(error),
    }
}

fn refused<T>(subject: Subject, text: String) -> Result<T, StudyError> {
    Err(about(subject)(ArgumentError::Value(text)))
}

fn input(subject: Subject) -> impl FnOnce(InputError) -> StudyError {
    move |error| StudyError {
        subject,
        cause: Cause::Input(error),
    }
}

#[derive(Clone, Debug)]
enum Output {
    Reduction(Reduction),
    Called,
}

/// What a case gave.
#[derive(Clone, Debug, PartialEq)]
pub struct Row {
    /// Number of the case, from 0.
    pub case: usize,
    /// The outputs; `None` where there is none: all of them, where the case has failed.
    pub outputs: Vec<Option<f64>>,
    /// Whether it ran to its end and gave every output.
    pub success: bool,
    /// Why not; empty after success.
    pub message: String,
    /// Steps of the integrator.
    pub steps: i64,
}

impl Row {
    /// A case that has failed.
    #[must_use]
    pub fn failed(case: usize, outputs: usize, message: String, steps: i64) -> Self {
        Self {
            case,
            outputs: vec![None; outputs],
            success: false,
            message,
            steps,
        }
    }
}

/// A run of a case, for outputs that the caller makes.
pub struct CaseRun {
    /// The model of the case.
    pub project: Project,
    /// What the run tells of itself.
    pub report: RunReport,
    /// Warnings about the model.
    pub warnings: Vec<stiction::Message>,
}

/// A study: cases by number, each of which can be run by itself.
#[derive(Clone, Debug)]
pub struct Study {
    project: Project,
    definition: Definition,
    parameters: Vec<Parameter>,
    outputs: Vec<Output>,
    values: Vec<Vec<Value>>,
    /// Checksums of the model and of all changes of it.
    model: String,
    changes: String,
    /// Of what all cases have in common, which their hashes begin with.
    common: Sha256,
}

impl Study {
    /// Puts a study together and looks whether it makes sense.
    ///
    /// # Errors
    /// The first name or value that cannot be used.
    pub fn new(mut project: Project, definition: Definition) -> Result<Self, StudyError> {
        check_settings(&project, &definition.settings)?;
        check_names(&definition)?;
        let model = project.model_checksum();
        let Settings {
            end, steps, dtout, ..
        } = definition.settings;
        if let Some(end) = end {
            project.push_dynamic(end, steps, dtout);
        }
        let mut parameters: Vec<Parameter> = Vec::new();
        for (place, given) in definition.parameters.iter().enumerate() {
            let subject = Subject::Parameter(place);
            let argument = project.argument(&given.name).map_err(about(subject))?;
            if parameters.iter().any(|other| other.argument == argument) {
                return refused(subject, format!("{} is given twice", given.name));
            }
            parameters.push(Parameter::new(given, argument).map_err(about(subject))?);
        }
        let Definition {
            design,
            cases,
            seed,
            ..
        } = definition;
        let values = design.values(&parameters, cases, seed);
        let values = values.map_err(about(Subject::Design))?;
        let session = Session::new(&project).map_err(input(Subject::Model))?;
        let layout = session.layout();
        let mut outputs = Vec::new();
        for (place, (_, given)) in definition.outputs.iter().enumerate() {
            outputs.push(match given {
                GivenOutput::Called(_) => Output::Called,
                GivenOutput::Reduction(text) => {
                    let reduction = Reduction::new(text, &project, &layout);
                    Output::Reduction(reduction.map_err(about(Subject::Output(place)))?)
                }
            });
        }
        let mut study = Self {
            project,
            definition,
            parameters,
            outputs,
            values,
            model,
            changes: String::new(),
            common: Sha256::new(),
        };
        study.try_parameters()?;
        study.common.update(study.identity().to_string());
        let mut all = Sha256::new();
        for change in (0..study.cases()).flat_map(|case| study.changes(case)) {
            all.update(change);
            all.update([0]);
        }
        study.changes = hexadecimal(&all.finalize());
        Ok(study)
    }

    /// A parameter whose every value is refused is wrong as such.
    fn try_parameters(&self) -> Result<(), StudyError> {
        for place in 0..self.parameters.len() {
            let mut first = None;
            let taken = self.values.iter().take(TRIED).any(|values| {
                let tried = self
                    .project
                    .clone()
                    .set_as("change", &self.change(place, values));
                let taken = tried.is_ok();
                first = first.take().or(tried.err());
                taken
            });
            if let Some(error) = first.filter(|_| !taken) {
                return Err(input(Subject::Parameter(place))(error));
            }
        }
        Ok(())
    }

    fn change(&self, place: usize, values: &[Value]) -> String {
        format!(
            "{}={}",
            self.parameters[place].argument.change, values[place]
        )
    }

    /// Number of cases.
    #[must_use]
    pub fn cases(&self) -> usize {
        self.values.len()
    }

    /// The parameters in their order.
    #[must_use]
    pub fn parameters(&self) -> &[Parameter] {
        &self.parameters
    }

    /// The model that the cases change, with its commands.
    #[must_use]
    pub fn project(&self) -> &Project {
        &self.project
    }

    /// What the study was given.
    #[must_use]
    pub fn definition(&self) -> &Definition {
        &self.definition
    }

    /// Names of the outputs and their units, `None` where it is not known.
    pub fn outputs(&self) -> impl Iterator<Item = (&str, Option<&str>)> {
        let names = self.definition.outputs.iter().map(|(name, _)| &**name);
        names.zip(self.outputs.iter().map(|output| match output {
            Output::Reduction(reduction) => Some(&*reduction.unit),
            Output::Called => None,
        }))
    }

    /// The values of the parameters of a case, in the units of the model.
    #[must_use]
    pub fn values(&self, case: usize) -> &[Value] {
        &self.values[case]
    }

    /// The changes that make the model of a case.
    #[must_use]
    pub fn changes(&self, case: usize) -> Vec<String> {
        let values = &self.values[case];
        (0..values.len())
            .map(|place| self.change(place, values))
            .collect()
    }

    /// The seed of a case, for whatever is random in its outputs: 63 bits of the SHA-256 of
    /// `stiction case`, the seed of the study and the number of the case.
    #[must_use]
    pub fn seed(&self, case: usize) -> i64 {
        let text = format!("stiction case {} {case}", self.definition.seed);
        let hash = Sha256::digest(text);
        let first = hash
            .iter()
            .take(8)
            .fold(0_u64, |all, byte| (all << 8) | u64::from(*byte));
        (first >> 1).cast_signed()
    }

    /// What makes a case: a SHA-256 of version, model, commands, settings and values.
    #[must_use]
    pub fn hash(&self, case: usize) -> String {
        let mut hash = self.common.clone();
        for change in self.changes(case) {
            hash.update([0]);
            hash.update(change);
        }
        hexadecimal(&hash.finalize())
    }

    /// What all cases have in common.
    fn identity(&self) -> Json {
        let Settings { error, .. } = self.definition.settings;
        let commands = self.project.commands();
        json!({
            "version": env!("CARGO_PKG_VERSION"),
            "model": self.model,
            "commands": commands.iter().map(|command| &command.echo).collect::<Vec<_>>(),
            "error": error,
        })
    }

    /// What the study is, as JSON: `study.json` in its folder.
    #[must_use]
    pub fn manifest(&self) -> Json {
        let outputs = self.definition.outputs.iter().map(|(name, output)| {
            let (GivenOutput::Reduction(text) | GivenOutput::Called(text)) = output;
            json!([name, text])
        });
        let mut manifest = self.identity();
        manifest["title"] = json!(self.project.dataset().title);
        manifest["design"] = json!(self.definition.design.name());
        manifest["seed"] = json!(self.definition.seed);
        manifest["cases"] = json!(self.cases());
        manifest["parameters"] = self.parameters.iter().map(|p| json!(p.name)).collect();
        manifest["values"] = json!(self.changes);
        manifest["outputs"] = outputs.collect();
        manifest
    }

    /// Units of the columns of the table, as far as they are known.
    #[must_use]
    pub fn units(&self) -> Map<String, Json> {
        let parameters = self.parameters.iter();
        let parameters = parameters.map(|p| (&*p.name, p.argument.unit.as_deref()));
        let known = parameters.chain(self.outputs());
        known
            .filter_map(|(name, unit)| Some((name.to_owned(), json!(unit?))))
            .collect()
    }

    /// Runs a case. Files of the run go into `scratch` and are replaced by those of the next; `more`
    /// is given its rows, too. Returns `None` where `watch` has stopped it; outputs that the caller
    /// makes are `None` in the row.
    ///
    /// # Errors
    /// Files that cannot be written, which is not the fault of the case.
    pub fn run(
        &self,
        case: usize,
        scratch: &Path,
        watch: &mut dyn Watch,
        more: Option<&mut dyn Sink>,
    ) -> Result<Option<(Row, Option<CaseRun>)>, OutputError> {
        let failed = |message: String, steps| {
            Row::failed(
                case,
                self.outputs.len(),
                message.trim_end().to_owned(),
                steps,
            )
        };
        let mut project = self.project.clone();
        for change in self.changes(case) {
            if let Err(error) = project.set_as("change", &change) {
                return Ok(Some((failed(error.to_string(), 0), None)));
            }
        }
        let reductions = self.outputs.iter().filter_map(|output| match output {
            Output::Reduction(reduction) => Some(reduction),
            Output::Called => None,
        });
        let mut reducer = Reducer::new(reductions.collect());
        let session = match Session::new(&project) {
            Ok(session) => session,
            Err(error) => return Ok(Some((failed(error.to_string(), 0), None))),
        };
        let options = RunOptions {
            error: self.definition.settings.error,
            text_results: false,
            ..RunOptions::default()
        };
        let mut sinks: Vec<&mut dyn Sink> = vec![&mut reducer];
        if let Some(more) = more {
            sinks.push(more);
        }
        let report = session.run_into(scratch, options, watch, &mut sinks)?;
        let warnings = session.warnings().to_vec();
        let steps = i64::try_from(report.statistics.steps.steps).unwrap_or(i64::MAX);
        let row = match &report.outcome {
            Outcome::Interrupted => return Ok(None),
            Outcome::Completed => {
                let values = reducer.values(&report);
                if values.contains(&None) {
                    return Ok(Some((
                        failed("the run has no outputs".to_owned(), steps),
                        None,
                    )));
                }
                let mut values = values.into_iter();
                let outputs = self.outputs.iter().map(|output| match output {
                    Output::Reduction(_) => values.next().flatten(),
                    Output::Called => None,
                });
                Row {
                    case,
                    outputs: outputs.collect(),
                    success: true,
                    message: String::new(),
                    steps,
                }
            }
            other => {
                let (outcome, told) = other.words();
                failed(told.unwrap_or(outcome).to_owned(), steps)
            }
        };
        let run = CaseRun {
            project,
            report,
            warnings,
        };
        Ok(Some((row, Some(run))))
    }
}

fn check_settings(project: &Project, settings: &Settings) -> Result<(), StudyError> {
    let numbers = [
        ("end", settings.end),
        ("dtout", settings.dtout),
        ("error", settings.error),
    ];
    for (name, number) in numbers {
        if let Some(number) = number.filter(|number| !(*number > 0.0 && number.is_finite())) {
            let text = format!("{name} must be a positive number, it is {number}");
            return refused(Subject::Setting(name), text);
        }
    }
    let refused = |name, text: &str| refused(Subject::Setting(name), text.to_owned());
    if settings.steps == Some(0) {
        return refused(
            "steps",
            "steps must be a positive number of outputs, it is 0",
        );
    }
    if settings.steps.is_some() && settings.dtout.is_some() {
        return refused("steps", "steps and dtout say the same; give one of them");
    }
    let alone = project.is_dataset_alone();
    let given = [
        settings.end.is_some(),
        settings.steps.is_some(),
        settings.dtout.is_some(),
    ];
    match (alone, settings.end) {
        (true, None) => refused(
            "end",
            "a dataset alone has no commands; give the end of the simulation",
        ),
        (false, _) if given.contains(&true) => refused(
            "end",
            "the command file says what to simulate; take the dataset (.adm) to give an end",
        ),
        _ => Ok(()),
    }
}

/// Names of columns, each of which is there once.
fn check_names(definition: &Definition) -> Result<(), StudyError> {
    if definition.outputs.is_empty() {
        let text = "the study has no outputs; give one, such as peak = \"max_abs(guide.force)\"";
        return refused(Subject::Model, text.to_owned());
    }
    let parameters = definition.parameters.iter().enumerate();
    let parameters = parameters.map(|(place, p)| (Subject::Parameter(place), &p.name));
    let outputs = definition.outputs.iter().enumerate();
    let outputs = outputs.map(|(place, (name, _))| (Subject::Output(place), name));
    let mut known: Vec<String> = OWN_COLUMNS.map(str::to_owned).into();
    for (subject, name) in parameters.chain(outputs) {
        // As databases compare the names of columns.
        let lower = name.to_lowercase();
        if name.trim().is_empty() {
            return refused(subject, "a column needs a name".to_owned());
        }
        if known.contains(&lower) {
            let text = format!("the table has a column {name} already; take another name");
            return refused(subject, text);
        }
        known.push(lower);
    }
    Ok(())
}
