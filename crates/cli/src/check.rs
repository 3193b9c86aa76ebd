//! `stiction check`.

use serde_json::{Value, json};
use stiction::{CheckReport, InputError, Message, Project};

use crate::arguments::{CheckArguments, Format};
use crate::exit::{Exit, complain, say};

/// Loads, assembles and reports.
pub(crate) fn check(arguments: &CheckArguments) -> Exit {
    let checked = Project::load(&arguments.model).and_then(|project| stiction::check(&project));
    match (checked, arguments.format) {
        (Ok(report), Format::Text) => {
            say(&report.to_string());
            exit_of(&report)
        }
        (Ok(report), Format::Json) => {
            say(&format!("{:#}\n", report_json(&report)));
            exit_of(&report)
        }
        (Err(error), Format::Text) => {
            complain(&error.to_string());
            Exit::Input
        }
        (Err(InputError { messages }), Format::Json) => {
            say(&format!(
                "{:#}\n",
                json!({ "messages": messages_json(&messages) })
            ));
            Exit::Input
        }
    }
}

fn exit_of(report: &CheckReport) -> Exit {
    if report.messages.iter().any(Message::is_error) {
        Exit::Input
    } else if report.assembly_error.is_some() {
        Exit::Assembly
    } else {
        Exit::Success
    }
}

fn report_json(report: &CheckReport) -> Value {
    let elements: serde_json::Map<String, Value> = report
        .elements
        .iter()
        .map(|(name, count)| ((*name).to_owned(), json!(count)))
        .collect();
    let redundancies = report.redundancies.iter().map(|dropped| {
        let owner = &dropped.owner;
        json!({
            "statement": owner.statement,
            "id": owner.id,
            "name": owner.name,
            "equation": dropped.equation,
        })
    });
    let moved = report.moved.iter().map(|moved| {
        json!({
            "part": moved.body.to_string(),
            "distance": moved.distance,
            "angle": moved.angle,
        })
    });
    let defaults = report.defaults.iter().map(|line| {
        let values: serde_json::Map<String, Value> = line
            .defaults
            .iter()
            .map(|default| (default.quantity.keyword().to_owned(), json!(default.value)))
            .collect();
        json!({ "id": line.id, "name": line.name, "defaults": values })
    });
    json!({
        "title": report.title,
        "elements": elements,
        "degrees_of_freedom": report.degrees_of_freedom,
        "redundant_equations": redundancies.collect::<Vec<_>>(),
        "frictions_not_unique": report.not_unique,
        "moved": moved.collect::<Vec<_>>(),
        "friction_defaults": defaults.collect::<Vec<_>>(),
        "assembly_error": report.assembly_error.as_ref().map(message_json),
        "messages": messages_json(&report.messages),
    })
}

fn messages_json(messages: &[Message]) -> Vec<Value> {
    messages.iter().map(message_json).collect()
}

fn message_json(message: &Message) -> Value {
    let diagnostic = &message.diagnostic;
    json!({
        "severity": diagnostic.severity.as_str(),
        "code": diagnostic.code.as_str(),
        "message": diagnostic.message,
        "file": diagnostic.source,
        "line": message.location.start.line,
        "column": message.location.start.column,
        "notes": diagnostic.notes,
        "help": diagnostic.help,
    })
}
