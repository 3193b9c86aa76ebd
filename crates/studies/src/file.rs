//! Study files, `study.toml`; docs/studies.md says what they hold.

use std::path::{Path, PathBuf};

use dataset::{Code, Diagnostic, Severity, Source, Span};
use stiction::{ArgumentError, InputError, Message, Project};
use toml::Spanned;
use toml::de::{DeTable, DeValue};

use crate::design::Design;
use crate::parameter::{GivenParameter, Levels, Range, Value};
use crate::study::{Cause, Definition, GivenOutput, Settings, Study, StudyError, Subject};

/// Keys of the file.
const KEYS: [&str; 10] = [
    "model",
    "end",
    "steps",
    "dtout",
    "error",
    "design",
    "cases",
    "seed",
    "parameters",
    "outputs",
];

/// Keys of the values of a parameter.
const LEVEL_KEYS: [&str; 6] = ["values", "from", "to", "points", "spacing", "unit"];

/// A study that was read from a file.
#[derive(Clone, Debug)]
pub struct StudyFile {
    /// The study.
    pub study: Study,
    /// The file of its model.
    pub model: PathBuf,
    /// What is to be said of it and its model, without errors.
    pub warnings: Vec<Message>,
}

/// Something wrong at a place of the file.
struct Wrong {
    span: Span,
    message: String,
    help: Option<String>,
}

type Entry<'a> = Spanned<DeValue<'a>>;

fn span_of(range: std::ops::Range<usize>) -> Span {
    Span {
        start: range.start,
        end: range.end,
    }
}

fn wrong<T>(
    span: std::ops::Range<usize>,
    message: impl Into<String>,
    help: &str,
) -> Result<T, Wrong> {
    Err(Wrong {
        span: span_of(span),
        message: message.into(),
        help: Some(help.to_owned()),
    })
}

/// What a name error says, its help apart.
fn of_argument(span: std::ops::Range<usize>, error: &ArgumentError) -> Wrong {
    let text = error.to_string();
    let (message, help) = match text.split_once("; ") {
        Some((message, help)) => (message.to_owned(), Some(help.to_owned())),
        None => (text, None),
    };
    Wrong {
        span: span_of(span),
        message,
        help,
    }
}

/// What the file says, with places.
struct Said {
    model: (PathBuf, std::ops::Range<usize>),
    definition: Definition,
    parameters: Vec<std::ops::Range<usize>>,
    outputs: Vec<std::ops::Range<usize>>,
    design: std::ops::Range<usize>,
    settings: Vec<(&'static str, std::ops::Range<usize>)>,
}

impl StudyFile {
    /// Reads a study file and the model that it names, beside it where the path is relative.
    ///
    /// # Errors
    /// What is wrong with the file or the model, with its place.
    pub fn read(path: &Path) -> Result<Self, InputError> {
        let name = path.display().to_string();
        let bytes = std::fs::read(path).map_err(|error| {
            let empty = Source::from_text(&name, String::new());
            let text = format!("{name} cannot be read: {error}");
            let code = Code::MissingFile;
            let diagnostic = Diagnostic::new(Severity::Error, code, &name, Span::default(), text);
            InputError {
                messages: vec![Message::new(diagnostic, &empty)],
            }
        })?;
        let source = match Source::from_bytes(&name, &bytes) {
            Ok(source) => source,
            Err(error) => {
                let empty = Source::from_text(&name, String::new());
                return Err(InputError {
                    messages: vec![Message::new(*error, &empty)],
                });
            }
        };
        let told = |wrong: Wrong| {
            let Wrong {
                span,
                message,
                help,
            } = wrong;
            let code = Code::StudyFile;
            let mut diagnostic = Diagnostic::new(Severity::Error, code, &name, span, message);
            diagnostic.help = help;
            InputError {
                messages: vec![Message::new(diagnostic, &source)],
            }
        };
        let said = said(source.text()).map_err(told)?;
        let (model, model_place) = &said.model;
        let model = path.parent().unwrap_or(Path::new("")).join(model);
        let project = Project::load(&model)?;
        let warnings = project.warnings().to_vec();
        let study = Study::new(project, said.definition.clone());
        let study = study.map_err(|StudyError { subject, cause }| {
            let place = match subject {
                Subject::Parameter(place) => said.parameters[place].clone(),
                Subject::Output(place) => said.outputs[place].clone(),
                Subject::Design => said.design.clone(),
                Subject::Model => model_place.clone(),
                Subject::Setting(name) => {
                    let known = said.settings.iter().find(|(known, _)| *known == name);
                    known.map_or(model_place.clone(), |(_, place)| place.clone())
                }
            };
            match cause {
                Cause::Argument(error) => told(of_argument(place, &error)),
                // It has a place of its own, in the model.
                Cause::Input(error) if subject == Subject::Model => error,
                Cause::Input(error) => {
                    let first = error.messages.iter().find(|message| message.is_error());
                    let diagnostic = first.map(|message| &message.diagnostic);
                    let text = diagnostic.map(|diagnostic| diagnostic.message.clone());
                    told(Wrong {
                        span: span_of(place),
                        message: text.unwrap_or_default(),
                        help: diagnostic.and_then(|diagnostic| diagnostic.help.clone()),
                    })
                }
            }
        })?;
        Ok(Self {
            study,
            model,
            warnings,
        })
    }
}

fn said(text: &str) -> Result<Said, Wrong> {
    let table = DeTable::parse(text).map_err(|error| Wrong {
        span: error.span().map(span_of).unwrap_or_default(),
        message: error.message().replace('\n', ", "),
        help: None,
    })?;
    let table = table.get_ref();
    for key in table.keys() {
        if !KEYS.contains(&&**key.get_ref()) {
            let error = ArgumentError::Unknown {
                what: "key",
                name: key.get_ref().to_string(),
                known: KEYS.map(str::to_owned).into(),
            };
            return Err(of_argument(key.span(), &error));
        }
    }
    let get = |name: &str| table.get(name);
    let Some(model) = get("model") else {
        return wrong(
            0..text.find('\n').unwrap_or(text.len()),
            "the study names no model",
            "write model = \"arm.adm\", a dataset (.adm) or a command file (.acf)",
        );
    };
    let optional = |name: &'static str| get(name).map(|entry| number(entry, name)).transpose();
    let whole = |name: &'static str| get(name).map(|entry| count(entry, name)).transpose();
    let steps = whole("steps")?;
    let settings = Settings {
        end: optional("end")?,
        steps: steps.map(|steps| u32::try_from(steps).unwrap_or(u32::MAX)),
        dtout: optional("dtout")?,
        error: optional("error")?,
    };
    let settings_given = ["end", "steps", "dtout", "error"].into_iter();
    let settings_given = settings_given.filter_map(|name| Some((name, get(name)?.span())));
    let settings_given = settings_given.collect();
    let design = get("design").map(|entry| {
        let design = Design::named(words(entry, "design = \"factorial\"")?);
        design.map_err(|error| of_argument(entry.span(), &error))
    });
    let design = design.transpose()?.unwrap_or(Design::Factorial);
    let parameters_example = "[parameters] with lines such as guide.mu_static = [0.2, 0.3]";
    let outputs_example = "[outputs] with lines such as peak = \"max_abs(guide.force)\"";
    let mut parameters = Vec::new();
    if let Some(entry) = get("parameters") {
        let mut names = Vec::new();
        collect(
            inner(entry, parameters_example)?,
            &mut names,
            &mut parameters,
        )?;
    }
    let mut outputs = Vec::new();
    if let Some(entry) = get("outputs") {
        for (key, entry) in inner(entry, outputs_example)? {
            let text = words(entry, "it as peak = \"max_abs(guide.force)\"")?.to_owned();
            let output = GivenOutput::Reduction(text);
            outputs.push(((key.get_ref().to_string(), output), entry.span()));
        }
    }
    let place = ["cases", "design", "parameters"].into_iter().find_map(get);
    let (parameters, parameter_places) = parameters.into_iter().unzip();
    let (outputs, output_places) = outputs.into_iter().unzip();
    Ok(Said {
        model: (words(model, "model = \"arm.adm\"")?.into(), model.span()),
        design: place.map_or(model.span(), Spanned::span),
        definition: Definition {
            parameters,
            design,
            cases: whole("cases")?.map(|cases| usize::try_from(cases).unwrap_or(usize::MAX)),
            seed: whole("seed")?.unwrap_or(0),
            outputs,
            settings,
        },
        parameters: parameter_places,
        outputs: output_places,
        settings: settings_given,
    })
}

/// Parameters of a table; `guide.mu_static` without quotes is a table in a table.
fn collect(
    table: &DeTable<'_>,
    names: &mut Vec<String>,
    parameters: &mut Vec<(GivenParameter, std::ops::Range<usize>)>,
) -> Result<(), Wrong> {
    const DEEPEST: usize = 16;
    for (key, entry) in table {
        names.push(key.get_ref().to_string());
        let levels = match entry.get_ref() {
            DeValue::Table(inner) if !LEVEL_KEYS.iter().any(|known| inner.contains_key(*known)) => {
                if names.len() > DEEPEST {
                    return wrong(
                        key.span(),
                        "this name has too many parts",
                        "write guide.mu_static",
                    );
                }
                collect(inner, names, parameters)?;
                names.pop();
                continue;
            }
            DeValue::Table(inner) => table_levels(inner, entry)?,
            DeValue::Array(values) => {
                let values: Result<_, _> = values.iter().map(value).collect();
                (Levels::Values(values?), None)
            }
            _ => (Levels::Values(vec![value(entry)?]), None),
        };
        let (levels, unit) = levels;
        let count = match &levels {
            Levels::Values(values) => values.len(),
            Levels::Range(_) => 1,
        };
        let given = GivenParameter {
            name: names.join("."),
            levels,
            units: vec![unit; count],
        };
        parameters.push((given, entry.span()));
        names.pop();
    }
    Ok(())
}

/// `{ values = [...] }` or `{ from = 0.1, to = 0.5 }`, with `points`, `spacing` and `unit`.
fn table_levels(table: &DeTable<'_>, entry: &Entry<'_>) -> Result<(Levels, Option<String>), Wrong> {
    for key in table.keys() {
        if !LEVEL_KEYS.contains(&&**key.get_ref()) {
            let error = ArgumentError::Unknown {
                what: "key of a parameter",
                name: key.get_ref().to_string(),
                known: LEVEL_KEYS.map(str::to_owned).into(),
            };
            return Err(of_argument(key.span(), &error));
        }
    }
    let unit = table
        .get("unit")
        .map(|unit| words(unit, "unit = \"mm/s\""))
        .transpose()?;
    let unit = unit.map(str::to_owned);
    if let Some(values) = table.get("values") {
        if let Some(other) = table
            .keys()
            .find(|key| !["values", "unit"].contains(&&**key.get_ref()))
        {
            return wrong(
                other.span(),
                "values and a range exclude each other",
                "give one of them",
            );
        }
        let Some(list) = values.get_ref().as_array() else {
            return wrong(
                values.span(),
                "values are not a list",
                "write values = [1, 2]",
            );
        };
        let values: Result<_, _> = list.iter().map(value).collect();
        return Ok((Levels::Values(values?), unit));
    }
    let (Some(from), Some(to)) = (table.get("from"), table.get("to")) else {
        return wrong(
            entry.span(),
            "a range has two ends",
            "write { from = 0.1, to = 0.5 }",
        );
    };
    let logarithmic = match table.get("spacing") {
        None => false,
        Some(spacing) => match words(spacing, "spacing = \"linear\" or \"log\"")? {
            "linear" => false,
            "log" => true,
            _ => {
                return wrong(
                    spacing.span(),
                    "no such spacing",
                    "write \"linear\" or \"log\"",
                );
            }
        },
    };
    let range = Range {
        low: number(from, "from")?,
        high: number(to, "to")?,
        logarithmic,
    };
    let Some(points) = table.get("points") else {
        return Ok((Levels::Range(range), unit));
    };
    let number = count(points, "points")?;
    if !(2..=1_000_000).contains(&number) {
        return wrong(
            points.span(),
            "a range has at least two points",
            "write points = 9",
        );
    }
    let last = number - 1;
    let at = |point: u64| match point {
        point if point == last => Value::Number(range.high),
        point => Value::Number(range.at(point as f64 / last as f64)),
    };
    Ok((Levels::Values((0..number).map(at).collect()), unit))
}

fn inner<'a, 'b>(entry: &'a Entry<'b>, example: &str) -> Result<&'a DeTable<'b>, Wrong> {
    match entry.get_ref().as_table() {
        Some(table) => Ok(table),
        None => wrong(
            entry.span(),
            "this is not a table",
            &format!("write {example}"),
        ),
    }
}

fn words<'a>(entry: &'a Entry<'_>, example: &str) -> Result<&'a str, Wrong> {
    match entry.get_ref().as_str() {
        Some(text) => Ok(text),
        None => wrong(
            entry.span(),
            "this is not a text",
            &format!("write {example}"),
        ),
    }
}

/// A number, whole or not.
fn float(value: &DeValue<'_>) -> Option<f64> {
    match value {
        DeValue::Float(float) => float.as_str().parse().ok(),
        DeValue::Integer(integer) => match i64::from_str_radix(integer.as_str(), integer.radix()) {
            Ok(whole) => Some(whole as f64),
            Err(_) => integer.as_str().parse().ok(),
        },
        _ => None,
    }
}

fn number(entry: &Entry<'_>, name: &str) -> Result<f64, Wrong> {
    match float(entry.get_ref()) {
        Some(number) => Ok(number),
        None => wrong(
            entry.span(),
            format!("{name} is not a number"),
            "write it as 0.1",
        ),
    }
}

fn count(entry: &Entry<'_>, name: &str) -> Result<u64, Wrong> {
    let whole = entry.get_ref().as_integer();
    let whole = whole.and_then(|i| u64::from_str_radix(i.as_str(), i.radix()).ok());
    match whole {
        Some(count) => Ok(count),
        None => wrong(
            entry.span(),
            format!("{name} is not a whole number from 0 on"),
            "write it as 64",
        ),
    }
}

/// A value of a parameter: a number, a text, or several numbers.
fn value(entry: &Entry<'_>) -> Result<Value, Wrong> {
    match entry.get_ref() {
        DeValue::String(text) => Ok(Value::Text(text.to_string())),
        DeValue::Array(several) => {
            let each: Result<Vec<String>, Wrong> = several
                .iter()
                .map(|one| Ok(format!("{:?}", number(one, "a value")?)))
                .collect();
            Ok(Value::Text(each?.join(", ")))
        }
        other => match float(other) {
            Some(number) => Ok(Value::Number(number)),
            None => wrong(entry.span(), "this is no value", "write a number or a text"),
        },
    }
}
