//! From JSON to a dataset.

use super::unwritable::{Places, unwritable};
use super::value::{Json, Members, name_place, place};
use super::{FORMAT, VERSION};
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::document::{self, Body, Document, Number, Statement, Value};
use crate::format::format;
use crate::grammar::{self, Form, Grammar};
use crate::keywords::{Keyword, Kind};
use crate::names;
use crate::source::{Source, Span};
use crate::syntax::Language;
use serde_json::value::RawValue;
use std::collections::{HashMap, HashSet};

/// The text of a dataset in its JSON form, which [`to_json`](crate::to_json) describes.
///
/// ```
/// use dataset::{Source, from_json};
/// let json = r#"{"format": "stiction-model", "version": 1, "title": "t", "statements": [
///   {"statement": "PART", "id": 1, "GRUND": true}]}"#;
/// let source = Source::from_text("m.json", json.to_string());
/// let errors = from_json(&source).unwrap_err();
/// assert_eq!(errors[0].message, "PART has no argument GRUND");
/// assert_eq!(source.line_column(errors[0].span.start), (2, 34));
/// assert_eq!(errors[0].notes[0], "this is statements[0].GRUND");
/// ```
///
/// # Errors
/// Every place that is no JSON, has a name or value that no dataset has, or could not be read back
/// from a dataset. Nothing is said about the model as a whole.
pub fn from_json(source: &Source) -> Result<String, Vec<Diagnostic>> {
    let mut reader = Reader {
        source,
        diagnostics: Diagnostics::new(source),
        grammars: grammar::statements()
            .map(|grammar| (grammar.name, grammar))
            .collect(),
        document: Document::default(),
        places: Vec::new(),
    };
    reader.whole();
    let (document, places) = (reader.document, reader.places);
    let errors = reader.diagnostics.finish();
    if !errors.is_empty() {
        return Err(errors);
    }
    let written = Source::from_text(source.name(), document::write(&document));
    let (after, errors) = document::read(&written, Language::Dataset);
    if errors.is_empty() && after == document {
        return format(&written, Language::Dataset);
    }
    Err(unwritable(source, &document, &places))
}

struct Reader<'a> {
    source: &'a Source,
    diagnostics: Diagnostics<'a>,
    /// The statements by their full names.
    grammars: HashMap<&'static str, Grammar>,
    document: Document,
    places: Vec<Places>,
}

impl<'a> Reader<'a> {
    fn error(&mut self, code: Code, span: Span, path: &str, message: String) -> &mut Diagnostic {
        let error = self.diagnostics.error(code, span, message);
        if path.is_empty() {
            error
        } else {
            error.note(format!("this is {path}"))
        }
    }

    /// Reports that a value is not what it should be.
    fn expected(&mut self, raw: &RawValue, path: &str, what: &str, found: &str) {
        let span = place(self.source, raw);
        let message = format!("expected {what}, found {found}");
        self.error(Code::InvalidValue, span, path, message);
    }

    /// One level of a value; `None` after a report.
    fn read(&mut self, raw: &'a RawValue, path: &str) -> Option<Json<'a>> {
        match Json::new(raw) {
            Ok(value) => Some(value),
            Err(error) => {
                let span = place(self.source, raw);
                let message = format!("this is no JSON: {}", without_place(&error));
                self.error(Code::Syntax, span, path, message);
                None
            }
        }
    }

    fn members(&mut self, raw: &'a RawValue, path: &str) -> Option<Members<'a>> {
        match self.read(raw, path)? {
            Json::Object(members) => {
                self.once(&members, path);
                Some(members)
            }
            other => {
                self.expected(raw, path, "an object", &other.what());
                None
            }
        }
    }

    /// Reports the names that occur twice.
    fn once(&mut self, members: &Members, path: &str) {
        let mut seen = HashSet::new();
        for (name, value) in &members.0 {
            if !seen.insert(name.as_str()) {
                let span = name_place(self.source, name, value);
                let message = format!("{name:?} is given twice");
                self.error(Code::DuplicateArgument, span, path, message);
            }
        }
    }

    fn array(&mut self, raw: &'a RawValue, path: &str) -> Option<Vec<&'a RawValue>> {
        match self.read(raw, path)? {
            Json::Array(values) => Some(values),
            other => {
                self.expected(raw, path, "a list", &other.what());
                None
            }
        }
    }

    fn string(&mut self, raw: &'a RawValue, path: &str) -> Option<String> {
        match self.read(raw, path)? {
            Json::String(text) => Some(text),
            other => {
                self.expected(raw, path, "a string", &other.what());
                None
            }
        }
    }

    /// A string on one line.
    fn line(&mut self, raw: &'a RawValue, path: &str) -> Option<String> {
        let text = self.string(raw, path)?;
        if text.contains('\n') {
            let found = "one with a line end";
            self.expected(raw, path, "a string of one line", found);
            return None;
        }
        Some(text.trim_ascii_end().to_string())
    }

    fn lines(&mut self, raw: &'a RawValue, path: &str) -> Vec<String> {
        let lines = self.array(raw, path).unwrap_or_default();
        let lines = lines.into_iter().enumerate();
        let lines: Vec<String> = lines
            .filter_map(|(index, line)| self.line(line, &format!("{path}[{index}]")))
            .collect();
        lines.into_iter().filter(|line| !line.is_empty()).collect()
    }

    fn whole(&mut self) {
        let members: Members = match serde_json::from_str(self.source.text()) {
            Ok(members) => members,
            Err(error) => {
                let at = self.source.offset(error.line(), error.column());
                let message = format!("this is no model in JSON: {}", without_place(&error));
                self.error(Code::Syntax, Span::new(at, at), "", message);
                return;
            }
        };
        self.once(&members, "the model");
        let mut format = None;
        let mut statements = None;
        for (name, raw) in members.0 {
            match name.as_str() {
                "format" => format = self.string(raw, "format"),
                "version" => self.version(raw),
                "title" => self.document.title = self.line(raw, "title").unwrap_or_default(),
                "statements" => statements = self.array(raw, "statements"),
                "comments" => self.document.comments = self.lines(raw, "comments"),
                "after_end" => {
                    let text = self.string(raw, "after_end").unwrap_or_default();
                    self.document.rest = text.trim_ascii().to_string();
                }
                _ => {
                    let span = name_place(self.source, &name, raw);
                    let message = format!("a model has no {name:?}");
                    let known = [
                        "format",
                        "version",
                        "title",
                        "statements",
                        "comments",
                        "after_end",
                    ];
                    self.error(Code::UnknownArgument, span, &name, message)
                        .help(format!("it has {}", known.join(", ")));
                }
            }
        }
        if format.as_deref() != Some(FORMAT) {
            let message = "this is no model in the JSON form of stiction".to_string();
            self.error(Code::MissingArgument, Span::default(), "", message)
                .help(format!(
                    "write \"format\": \"{FORMAT}\", \"version\": {VERSION}"
                ));
        }
        let Some(statements) = statements else {
            let message = "the model has no list of statements".to_string();
            self.error(Code::MissingArgument, Span::default(), "", message)
                .help("write \"statements\": [...]");
            return;
        };
        for (index, raw) in statements.into_iter().enumerate() {
            self.statement(raw, format!("statements[{index}]"));
        }
    }

    fn version(&mut self, raw: &'a RawValue) {
        if raw.get() != VERSION.to_string() {
            let span = place(self.source, raw);
            let message = format!("this version is not read, but {VERSION}");
            self.error(Code::InvalidValue, span, "version", message);
        }
    }

    fn statement(&mut self, raw: &'a RawValue, path: String) {
        let Some(members) = self.members(raw, &path) else {
            return;
        };
        let mut name = None;
        let mut id = None;
        let mut text = None;
        let mut statement = Statement {
            name: String::new(),
            id: None,
            view_name: None,
            comments: Vec::new(),
            body: Body::Arguments(Vec::new()),
        };
        let mut others = Vec::new();
        for (key, value) in members.0 {
            let path = format!("{path}.{key}");
            match key.as_str() {
                "statement" => name = self.string(value, &path).map(|name| (name, value)),
                "id" => id = Some((self.integer(value, 1, &path), value)),
                "name" => statement.view_name = self.line(value, &path),
                "comments" => statement.comments = self.lines(value, &path),
                "text" => text = self.string(value, &path),
                _ => others.push((key, value, path)),
            }
        }
        let Some((name, name_value)) = name else {
            let span = place(self.source, raw);
            let message = "a statement has no name".to_string();
            self.error(Code::MissingArgument, span, &path, message)
                .help("write \"statement\": \"PART\" or another");
            return;
        };
        let known = self.grammars.get(name.as_str()).copied();
        if known.is_none() && text.is_none() {
            let near = names::nearest(&name, self.grammars.keys().copied());
            let span = place(self.source, name_value);
            let message = format!("no statement is called {name:?}");
            let error = self.error(Code::UnknownStatement, span, &path, message);
            error.help = near.map(|near| format!("is {near:?} meant? names are written in full"));
            return;
        }
        if let Some(identified) = known.and_then(|grammar| grammar.identified)
            && identified != id.is_some()
        {
            let span = place(self.source, raw);
            let message = match id {
                None => format!("{name} needs an id"),
                Some(_) => format!("{name} has no id"),
            };
            self.error(Code::InvalidId, span, &path, message);
        }
        statement.id = id.and_then(|(id, _)| id);
        let mut arguments = Vec::new();
        let mut argument_places = Vec::new();
        for (key, value, path) in others {
            argument_places.push(place(self.source, value));
            let form = match (known, &text) {
                (Some(grammar), None) => grammar.form,
                _ => Form::Unknown,
            };
            arguments.extend(self.argument(&name, form, key, value, &path));
        }
        statement.body = match text {
            Some(text) => Body::Text(document::text_of_lines(&text)),
            None => Body::Arguments(arguments),
        };
        statement.name = name;
        self.document.statements.push(statement);
        self.places.push(Places {
            statement: place(self.source, raw),
            path,
            arguments: argument_places,
        });
    }

    fn argument(
        &mut self,
        statement: &str,
        form: Form,
        key: String,
        raw: &'a RawValue,
        path: &str,
    ) -> Option<(String, Value)> {
        let keywords = match form {
            Form::Table(keywords) => keywords,
            Form::Free => {
                let value = self.free(raw, path)?;
                return Some((key.to_ascii_uppercase(), value));
            }
            Form::Unknown => {
                let span = name_place(self.source, &key, raw);
                let message = format!("the arguments of {statement} are given as \"text\"");
                self.error(Code::UnknownArgument, span, path, message);
                return None;
            }
        };
        let mut known = keywords.iter();
        let Some(keyword) = known.find(|keyword| keyword.name.full == key) else {
            let near = names::nearest(&key, keywords.iter().map(|keyword| keyword.name.full));
            let span = name_place(self.source, &key, raw);
            let message = format!("{statement} has no argument {key}");
            let error = self.error(Code::UnknownArgument, span, path, message);
            error.help = near.map(|near| format!("is {near:?} meant? names are written in full"));
            return None;
        };
        Some((key, self.value(keyword, raw, path)?))
    }

    /// An argument that is not read: true, or its text.
    fn free(&mut self, raw: &'a RawValue, path: &str) -> Option<Value> {
        match self.read(raw, path)? {
            Json::Bool(true) => Some(Value::Flag),
            Json::String(text) => Some(Value::Raw(text)),
            other => {
                self.expected(raw, path, "true or a string", &other.what());
                None
            }
        }
    }

    fn value(&mut self, keyword: &Keyword, raw: &'a RawValue, path: &str) -> Option<Value> {
        Some(match keyword.kind {
            Kind::Flag => match self.read(raw, path)? {
                Json::Bool(true) => Value::Flag,
                other => {
                    let what = "true (leave it out for false)";
                    self.expected(raw, path, what, &other.what());
                    return None;
                }
            },
            Kind::Real => Value::Number(self.number(raw, path)?),
            Kind::Reals(least, most) => {
                let numbers = self.numbers(raw, path)?;
                if !(least..=most).contains(&numbers.len()) {
                    let count = match most {
                        _ if least == most => most.to_string(),
                        usize::MAX => format!("{least} or more"),
                        _ => format!("{least} to {most}"),
                    };
                    let found = numbers.len().to_string();
                    self.expected(raw, path, &format!("{count} numbers"), &found);
                    return None;
                }
                Value::Numbers(numbers)
            }
            Kind::RealsEach => Value::Rows(self.each(raw, path, Self::numbers)?),
            Kind::Integer => Value::Integer(self.integer(raw, 0, path)?),
            Kind::Id => Value::Integer(self.integer(raw, 1, path)?),
            Kind::Ids => Value::Integers(
                self.each(raw, path, |reader, raw, path| reader.integer(raw, 1, path))?,
            ),
            Kind::IdsOrAll => match self.read(raw, path)? {
                Json::String(all) if all == "ALL" => Value::Word(all),
                Json::String(_) => {
                    self.expected(
                        raw,
                        path,
                        "\"ALL\" or numbers of elements",
                        "another string",
                    );
                    return None;
                }
                _ => {
                    let kind = Kind::Ids;
                    self.value(&Keyword { kind, ..*keyword }, raw, path)?
                }
            },
            Kind::Word => Value::Word(self.string(raw, path)?),
            Kind::Words => Value::Words(self.each(raw, path, Self::string)?),
            Kind::Text => Value::Text(self.string(raw, path)?),
            Kind::Strings => Value::Strings(self.each(raw, path, Self::string)?),
            Kind::Expression => Value::Expression(self.string(raw, path)?),
            Kind::Ignored(_) | Kind::Unsupported(_) => self.free(raw, path)?,
        })
    }

    /// A list, which must not be empty, of values read by `read`.
    fn each<T>(
        &mut self,
        raw: &'a RawValue,
        path: &str,
        read: impl Fn(&mut Self, &'a RawValue, &str) -> Option<T>,
    ) -> Option<Vec<T>> {
        let values = self.array(raw, path)?;
        if values.is_empty() {
            self.expected(raw, path, "a list", "an empty one");
            return None;
        }
        let values = values.into_iter().enumerate();
        let values: Vec<Option<T>> = values
            .map(|(index, value)| read(self, value, &format!("{path}[{index}]")))
            .collect();
        values.into_iter().collect()
    }

    fn numbers(&mut self, raw: &'a RawValue, path: &str) -> Option<Vec<Number>> {
        self.each(raw, path, Self::number)
    }

    fn number(&mut self, raw: &'a RawValue, path: &str) -> Option<Number> {
        let (digits, degrees) = match self.read(raw, path)? {
            Json::Number(digits) => (digits, false),
            Json::Object(Members(members)) => match members.as_slice() {
                [(name, value)] if name == "degrees" => (value.get(), true),
                _ => {
                    self.expected(raw, path, "{\"degrees\": ...}", "another object");
                    return None;
                }
            },
            other => {
                let what = "a number, or {\"degrees\": ...}";
                self.expected(raw, path, what, &other.what());
                return None;
            }
        };
        match digits.parse::<f64>() {
            Ok(written) if written.is_finite() => Some(Number { written, degrees }),
            Ok(_) => {
                let span = place(self.source, raw);
                let message = "this is too large for a number".to_string();
                self.error(Code::OutOfRange, span, path, message);
                None
            }
            Err(_) => {
                self.expected(raw, path, "a number of degrees", "something else");
                None
            }
        }
    }

    fn integer(&mut self, raw: &'a RawValue, least: u32, path: &str) -> Option<u32> {
        let value = self.read(raw, path)?;
        if let Json::Number(digits) = value
            && let Ok(value) = digits.parse::<f64>()
            && value.fract() == 0.0
            && (f64::from(least)..=f64::from(u32::MAX)).contains(&value)
        {
            return Some(value as u32);
        }
        let what = format!("a whole number, {least} or greater");
        self.expected(raw, path, &what, &value.what());
        None
    }
}

/// What is wrong; the place is told in other ways.
fn without_place(error: &serde_json::Error) -> String {
    let text = error.to_string();
    let message = text
        .rsplit_once(" at line ")
        .map(|(message, _)| message.to_string());
    message.unwrap_or(text)
}
