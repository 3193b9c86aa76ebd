//! From a dataset to JSON.

use super::{FORMAT, VERSION};
use crate::diagnostic::Diagnostic;
use crate::document::{self, Body, Document, Number, Statement, Value};
use crate::source::Source;
use crate::syntax::Language;
use std::fmt::Write;

/// The JSON form of a dataset; [`from_json`](crate::from_json) leads back.
///
/// `title`, and `statements` in the order of the file. Each has its full name as `statement`, its
/// `id`, its `name` (of the `adams_view_name` line), its `comments`, and its arguments by their
/// full names:
///
/// | argument | JSON |
/// |---|---|
/// | without value | `true` |
/// | number | `0.5`, in degrees `{"degrees": 90}`: the number that is written, so that the same bits come back |
/// | list of numbers | `[0, 0, {"degrees": 90}]` |
/// | list that may be given several times | a list of lists |
/// | identifier, whole number, list of them | `1`, `[1, 2]` |
/// | name, list of names | `"REVOLUTE"`, `["T", "F"]` |
/// | text, list of texts | `"a text"`, `["a", "b"]` |
/// | expression | `"STEP(TIME, 0, 0, 1, 1)"` |
/// | one that is not read | `true` without value, else its text |
///
/// A statement whose arguments have no table has their `text` instead. `comments` and `after_end`
/// of the whole are what stands behind the last statement and behind END.
///
/// ```
/// use dataset::{Source, from_json, to_json};
/// let text = "title\nMARKER/1, P=1, REULER=90D,0,-0.1\n";
/// let json = to_json(&Source::from_text("m.adm", text.to_string())).unwrap();
/// assert!(json.contains(r#""REULER": [{"degrees": 90}, 0, -0.1]"#), "{json}");
/// let back = from_json(&Source::from_text("m.json", json)).unwrap();
/// assert_eq!(back, "title\n!\nMARKER/1\n, PART = 1\n, REULER = 90D, 0, -0.1\n!\nEND\n");
/// ```
///
/// # Errors
/// The errors that leave open what the text says, and one for a text that would not come back the
/// same.
pub fn to_json(source: &Source) -> Result<String, Vec<Diagnostic>> {
    let (document, errors) = document::read(source, Language::Dataset);
    if !errors.is_empty() {
        return Err(errors);
    }
    let written = Source::from_text(source.name(), document::write(&document));
    let (after, errors) = document::read(&written, Language::Dataset);
    if errors.is_empty() && document == after {
        return Ok(json(&document));
    }
    Err(vec![document::difference(source, &document, &after)])
}

fn json(document: &Document) -> String {
    let mut out = String::new();
    // Writing to a String cannot fail.
    let _ = write!(
        out,
        "{{\n  \"format\": \"{FORMAT}\",\n  \"version\": {VERSION},\n  \"title\": {},\n  \"statements\": [",
        string(&document.title)
    );
    for (index, statement) in document.statements.iter().enumerate() {
        out.push_str(if index > 0 { ",\n    {" } else { "\n    {" });
        self::statement(&mut out, statement);
        out.push_str("\n    }");
    }
    out.push_str("\n  ]");
    if !document.comments.is_empty() {
        let _ = write!(out, ",\n  \"comments\": {}", strings(&document.comments));
    }
    if !document.rest.is_empty() {
        let _ = write!(out, ",\n  \"after_end\": {}", string(&document.rest));
    }
    out.push_str("\n}\n");
    out
}

fn statement(out: &mut String, statement: &Statement) {
    let _ = write!(out, "\n      \"statement\": {}", string(&statement.name));
    let mut member = |name: &str, value: &str| {
        let _ = write!(out, ",\n      {}: {value}", string(name));
    };
    if let Some(id) = statement.id {
        member("id", &id.to_string());
    }
    if let Some(name) = &statement.view_name {
        member("name", &string(name));
    }
    if !statement.comments.is_empty() {
        member("comments", &strings(&statement.comments));
    }
    match &statement.body {
        Body::Text(text) => member("text", &string(text)),
        Body::Arguments(arguments) => {
            for (name, value) in arguments {
                member(name, &self::value(value));
            }
        }
    }
}

fn value(value: &Value) -> String {
    match value {
        Value::Flag => "true".to_string(),
        Value::Number(value) => number(value),
        Value::Numbers(numbers) => list(numbers, number),
        Value::Rows(rows) => list(rows, |row| list(row, number)),
        Value::Integer(value) => value.to_string(),
        Value::Integers(values) => list(values, ToString::to_string),
        Value::Words(words) | Value::Strings(words) => strings(words),
        Value::Word(text) | Value::Text(text) | Value::Expression(text) | Value::Raw(text) => {
            string(text)
        }
    }
}

fn number(number: &Number) -> String {
    let plain = Number {
        degrees: false,
        ..*number
    };
    if number.degrees {
        format!("{{\"degrees\": {plain}}}")
    } else {
        plain.to_string()
    }
}

fn strings(texts: &[String]) -> String {
    list(texts, |text| string(text))
}

fn string(text: &str) -> String {
    serde_json::Value::from(text).to_string()
}

fn list<T>(values: &[T], text: impl Fn(&T) -> String) -> String {
    let values: Vec<String> = values.iter().map(text).collect();
    format!("[{}]", values.join(", "))
}
