//! `stiction fmt`.

use std::path::Path;

use dataset::{Language, Source};

use crate::arguments::FmtArguments;
use crate::exit::{Exit, complain, say_bytes};
use crate::replace::replace;

/// Lays out every file; the gravest of what happened is the answer.
pub(crate) fn fmt(arguments: &FmtArguments) -> Exit {
    let mut exit = Exit::Success;
    for path in &arguments.files {
        let file = match file(path) {
            Ok(file) => file,
            Err((text, found)) => {
                complain(&text);
                exit = exit.max(found);
                continue;
            }
        };
        if arguments.stdout {
            say_bytes(&file.after);
        } else if file.after == file.before {
            continue;
        } else if arguments.check {
            complain(&format!("{}: the layout would change\n", path.display()));
            exit = exit.max(Exit::Different);
        } else if let Err(error) = replace(path, &file.after) {
            complain(&format!(
                "error: {} cannot be written: {error}\n",
                path.display()
            ));
            exit = exit.max(Exit::Usage);
        }
    }
    exit
}

/// The bytes of a file, as they are and laid out.
struct File {
    before: Vec<u8>,
    after: Vec<u8>,
}

/// Reads a file and lays it out; the text to show where that cannot be done.
fn file(path: &Path) -> Result<File, (String, Exit)> {
    let name = path.display().to_string();
    let extension = path
        .extension()
        .map(|extension| extension.to_ascii_lowercase());
    let language = match extension.as_ref().and_then(|extension| extension.to_str()) {
        Some("adm") => Language::Dataset,
        Some("acf") => Language::Commands,
        _ => {
            let text =
                format!("error: {name} is neither a dataset (.adm) nor a command file (.acf)\n");
            return Err((text, Exit::Usage));
        }
    };
    let before = std::fs::read(path).map_err(|error| {
        (
            format!("error: {name} cannot be read: {error}\n"),
            Exit::Usage,
        )
    })?;
    let unplaced = Source::from_text(&name, String::new());
    let source = Source::from_bytes(&name, &before)
        .map_err(|error| (error.render(&unplaced), Exit::Input))?;
    let text = dataset::format(&source, language).map_err(|errors| {
        let errors: String = errors.iter().map(|error| error.render(&source)).collect();
        (errors, Exit::Input)
    })?;
    let after = source.encode(&text);
    Ok(File { before, after })
}
