//! From a [`Document`] to text.

use super::{Body, Document, Statement, Value};
use std::fmt::Write;

/// The text of a dataset, one argument a line, as Adams View writes it. It is for the layout to
/// break the long lines.
///
/// A text that holds what no dataset can (a quote in a quoted text, a line end) reads differently
/// then; the caller finds out by reading it.
pub(crate) fn write(document: &Document) -> String {
    let mut out = String::new();
    out.push_str(&document.title);
    out.push('\n');
    for statement in &document.statements {
        out.push_str("!\n");
        comments(&mut out, &statement.comments);
        if let Some(name) = &statement.view_name {
            // Writing to a String cannot fail.
            let _ = writeln!(out, "!                            adams_view_name='{name}'");
        }
        self::statement(&mut out, statement);
        out.push('\n');
    }
    out.push_str("!\n");
    comments(&mut out, &document.comments);
    out.push_str("END");
    if !document.rest.is_empty() {
        if !document.rest.starts_with([' ', '\t', '\r', '\n']) {
            out.push('\n');
        }
        out.push_str(&document.rest);
    }
    out.push('\n');
    out
}

fn comments(out: &mut String, comments: &[String]) {
    for comment in comments {
        let _ = writeln!(out, "!{comment}");
    }
}

fn statement(out: &mut String, statement: &Statement) {
    let _ = write!(out, "{}/", statement.name);
    if let Some(id) = statement.id {
        let _ = write!(out, "{id}");
    }
    match &statement.body {
        Body::Text(text) => {
            if text.starts_with(',') || (statement.id.is_some() && !text.is_empty()) {
                out.push('\n');
            }
            out.push_str(text);
        }
        Body::Arguments(arguments) => {
            for (index, (name, value)) in arguments.iter().enumerate() {
                let last = index + 1 == arguments.len();
                let rows = match value {
                    Value::Rows(rows) => rows.iter().map(|row| list(row)).collect(),
                    _ => vec![text(value)],
                };
                for row in rows {
                    let _ = write!(out, "\n, {name}");
                    if !row.is_empty() || !matches!(value, Value::Flag) {
                        let _ = write!(out, " = {row}");
                    }
                }
                if matches!(value, Value::Expression(_)) && !last {
                    out.push('\\');
                }
            }
        }
    }
}

fn text(value: &Value) -> String {
    match value {
        Value::Flag | Value::Rows(_) => String::new(),
        Value::Number(number) => number.to_string(),
        Value::Numbers(numbers) => list(numbers),
        Value::Integer(integer) => integer.to_string(),
        Value::Integers(integers) => list(integers),
        Value::Words(words) => words.join(":"),
        Value::Text(text) => quoted_where_needed(text),
        Value::Strings(texts) => {
            let quoted: Vec<String> = texts.iter().map(|text| format!("\"{text}\"")).collect();
            quoted.join(", ")
        }
        Value::Word(text) | Value::Expression(text) | Value::Raw(text) => text.clone(),
    }
}

fn list(values: &[impl ToString]) -> String {
    let values: Vec<String> = values.iter().map(ToString::to_string).collect();
    values.join(", ")
}

/// A text, in quotes where it would read differently without.
fn quoted_where_needed(text: &str) -> String {
    let plain = text.trim_ascii() == text
        && !text.contains(['!', ';', '&', '"', '\\', '=', ','])
        && !text.is_empty();
    if plain || text.contains('"') {
        text.to_string()
    } else {
        format!("\"{text}\"")
    }
}
