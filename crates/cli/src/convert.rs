//! `stiction convert`.

use dataset::Source;

use crate::arguments::ConvertArguments;
use crate::exit::{Exit, complain, say_bytes};
use crate::file::{Refusal, extension, read};
use crate::replace::replace;

/// Converts one model.
pub(crate) fn convert(arguments: &ConvertArguments) -> Exit {
    match converted(arguments) {
        Ok(()) => Exit::Success,
        Err(refusal) => {
            complain(&refusal.text);
            refusal.exit
        }
    }
}

fn converted(arguments: &ConvertArguments) -> Result<(), Refusal> {
    let to_json = match extension(&arguments.model).as_str() {
        "adm" => true,
        "json" => false,
        _ => {
            let name = arguments.model.display();
            return Err(Refusal::usage(&format!(
                "{name} is neither a dataset (.adm) nor a model in JSON (.json)"
            )));
        }
    };
    if let Some(output) = &arguments.output {
        let name = output.display();
        let wanted = if to_json { "json" } else { "adm" };
        if extension(output) != wanted {
            let text = format!("{name} does not end in .{wanted}, which is what is written");
            return Err(Refusal::usage(&text));
        }
        if output.exists() && !arguments.force {
            let text = format!("{name} is there already; --force replaces it");
            return Err(Refusal::usage(&text));
        }
    }
    let (_, source) = read(&arguments.model)?;
    let bytes = if to_json {
        dataset::to_json(&source).map(String::into_bytes)
    } else {
        dataset::from_json(&source).map(|text| Source::encode_new(&text))
    };
    let bytes = bytes.map_err(|errors| Refusal::input(&errors, &source))?;
    match &arguments.output {
        None => say_bytes(&bytes),
        Some(output) => replace(output, &bytes).map_err(|error| {
            Refusal::usage(&format!("{} cannot be written: {error}", output.display()))
        })?,
    }
    Ok(())
}
