//! `stiction check`.

use serde_json::{Value, json};
use stiction::{CheckReport, Code, InputError, Message, Project};

use crate::arguments::{CheckArguments, Format};
use crate::diagnostics::{VERSION, counts};
use crate::exit::{Exit, complain, say};

/// Loads, assembles and reports.
pub(crate) fn check(arguments: &CheckArguments) -> Exit {
    let levels = match arguments.levels.levels() {
        Ok(levels) => levels,
        Err(error) => {
            complain(&format!("error: {error}\n"));
            return Exit::Usage;
        }
    };
    let loaded = Project::load_with(&arguments.model, levels);
    let checked = loaded.and_then(|project| stiction::check(&project));
    match (checked, arguments.format) {
        (Ok(report), Format::Text) => {
            say(&format!("{report}{}\n", counts(&report.messages)));
            exit_of(&report.messages)
        }
        (Err(InputError { messages }), Format::Text) => {
            for message in &messages {
                complain(&message.to_string());
            }
            complain(&format!("{}\n", counts(&messages)));
            Exit::Input
        }
        (Ok(report), Format::Json) => {
            say_json(&report.messages, Some(model_json(&report)));
            exit_of(&report.messages)
        }
        (Err(InputError { messages }), Format::Json) => {
            say_json(&messages, None);
            Exit::Input
        }
    }
}

/// Errors of the input come before those of assembly.
fn exit_of(messages: &[Message]) -> Exit {
    let errors = messages.iter().filter(|message| message.is_error());
    let of_assembly = |message: &Message| message.diagnostic.code == Code::Assembly;
    let (assembly, input): (Vec<_>, Vec<_>) = errors.partition(|m| of_assembly(m));
    match (input.is_empty(), assembly.is_empty()) {
        (false, _) => Exit::Input,
        (true, false) => Exit::Assembly,
        (true, true) => Exit::Success,
    }
}

fn say_json(messages: &[Message], model: Option<Value>) {
    let value = json!({
        "version": VERSION,
        "diagnostics": messages.iter().map(Message::to_json).collect::<Vec<_>>(),
        "model": model,
    });
    say(&format!("{value:#}\n"));
}

fn model_json(report: &CheckReport) -> Value {
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
        "moved": moved.collect::<Vec<_>>(),
        "friction_defaults": defaults.collect::<Vec<_>>(),
    })
}
