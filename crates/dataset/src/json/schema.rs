//! The JSON Schema of models, made from the tables of statements and keywords.

use super::{FORMAT, VERSION};
use crate::grammar::{self, Form, Grammar};
use crate::keywords::{Keyword, Kind};
use serde_json::{Map, Value, json};

/// The JSON Schema (draft 2020-12) of what [`to_json`](crate::to_json) writes and
/// [`from_json`](crate::from_json) reads.
///
/// ```
/// assert!(dataset::json_schema().contains("https://json-schema.org/draft/2020-12/schema"));
/// ```
#[must_use]
pub fn json_schema() -> String {
    let mut definitions = definitions();
    let mut cases = Vec::new();
    let mut names = Vec::new();
    for grammar in grammar::statements() {
        let name = grammar.name;
        names.push(name);
        definitions.insert(name.to_string(), statement(grammar));
        cases.push(json!({
            "if": { "properties": { "statement": { "const": name } } },
            "then": reference(name),
        }));
    }
    cases.push(json!({
        "if": { "properties": { "statement": { "not": { "enum": names } } } },
        "then": reference("unknown"),
    }));
    definitions.insert(
        "unknown".to_string(),
        text_only("A statement that stiction does not know"),
    );
    definitions.insert(
        "statement".to_string(),
        json!({
            "type": "object",
            "required": ["statement"],
            "properties": { "statement": { "type": "string" } },
            "allOf": cases,
        }),
    );
    let schema = json!({
        "$schema": "https://json-schema.org/draft/2020-12/schema",
        "title": "A model of stiction",
        "description": "The statements of an Adams Solver dataset with full names and typed values",
        "type": "object",
        "required": ["format", "version", "statements"],
        "additionalProperties": false,
        "properties": {
            "format": { "const": FORMAT },
            "version": { "const": VERSION },
            "title": described("The first line of the dataset", reference("line")),
            "statements": { "type": "array", "items": reference("statement") },
            "comments": described("Comments behind the last statement", reference("lines")),
            "after_end": { "type": "string", "description": "What stands behind END" },
        },
        "$defs": definitions,
    });
    format!("{schema:#}\n")
}

/// The values that arguments have in common.
fn definitions() -> Map<String, Value> {
    let number = json!({
        "description": "A number, or an angle in degrees",
        "oneOf": [
            { "type": "number" },
            {
                "type": "object",
                "required": ["degrees"],
                "properties": { "degrees": { "type": "number" } },
                "additionalProperties": false,
            },
        ],
    });
    let id = json!({ "type": "integer", "minimum": 1, "maximum": u32::MAX });
    let line = json!({ "type": "string", "pattern": "^[^\\n]*$" });
    let lines = json!({ "type": "array", "items": reference("line") });
    let raw = json!({
        "description": "An argument that is not read: true without value, else its text",
        "oneOf": [{ "const": true }, { "type": "string" }],
    });
    let expression = json!({
        "type": "string",
        "description": "An expression of run-time functions on one line",
    });
    let list = [
        ("number", number),
        ("id", id),
        ("line", line),
        ("lines", lines),
        ("raw", raw),
        ("expression", expression),
    ];
    list.into_iter()
        .map(|(name, schema)| (name.to_string(), schema))
        .collect()
}

fn reference(name: &str) -> Value {
    json!({ "$ref": format!("#/$defs/{name}") })
}

fn described(description: &str, mut schema: Value) -> Value {
    schema["description"] = json!(description);
    schema
}

/// A list of at least one item.
fn list(items: &Value) -> Value {
    json!({ "type": "array", "items": items, "minItems": 1 })
}

/// What every statement may have beside its arguments.
fn common(identified: bool) -> Map<String, Value> {
    let mut properties = Map::new();
    properties.insert("statement".to_string(), json!({ "type": "string" }));
    if identified {
        properties.insert("id".to_string(), reference("id"));
    }
    let name = described("The name in the adams_view_name line", reference("line"));
    properties.insert("name".to_string(), name);
    properties.insert("comments".to_string(), reference("lines"));
    let text = "The arguments as text, in place of all others";
    properties.insert(
        "text".to_string(),
        json!({ "type": "string", "description": text }),
    );
    properties
}

fn text_only(description: &str) -> Value {
    json!({
        "type": "object",
        "description": description,
        "required": ["statement", "text"],
        "properties": common(true),
        "additionalProperties": false,
    })
}

fn statement(grammar: Grammar) -> Value {
    let identified = grammar.identified.unwrap_or(true);
    let keywords = match grammar.form {
        Form::Table(keywords) => keywords,
        Form::Free => {
            return json!({
                "type": "object",
                "required": required(identified),
                "properties": common(identified),
                "additionalProperties": reference("raw"),
            });
        }
        Form::Unknown => return text_only("Its arguments are kept as text"),
    };
    let mut properties = common(identified);
    for keyword in keywords {
        properties.insert(keyword.name.full.to_string(), value(keyword));
    }
    json!({
        "type": "object",
        "required": required(identified),
        "properties": properties,
        "additionalProperties": false,
    })
}

fn required(identified: bool) -> Value {
    if identified {
        json!(["statement", "id"])
    } else {
        json!(["statement"])
    }
}

fn value(keyword: &Keyword) -> Value {
    match keyword.kind {
        Kind::Flag => json!({ "const": true }),
        Kind::Real => reference("number"),
        Kind::Reals(least, most) => {
            let mut numbers = list(&reference("number"));
            numbers["minItems"] = json!(least);
            if most < usize::MAX {
                numbers["maxItems"] = json!(most);
            }
            numbers
        }
        Kind::RealsEach => list(&list(&reference("number"))),
        Kind::Integer => json!({ "type": "integer", "minimum": 0, "maximum": u32::MAX }),
        Kind::Id => reference("id"),
        Kind::Ids => list(&reference("id")),
        Kind::IdsOrAll => json!({
            "oneOf": [list(&reference("id")), { "const": "ALL" }],
        }),
        Kind::Word | Kind::Text => json!({ "type": "string" }),
        Kind::Words | Kind::Strings => list(&json!({ "type": "string" })),
        Kind::Expression => reference("expression"),
        Kind::Ignored(reason) => described(&format!("Without effect: {reason}"), reference("raw")),
        Kind::Unsupported(reason) => {
            described(&format!("Not simulated: {reason}"), reference("raw"))
        }
    }
}
