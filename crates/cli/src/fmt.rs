//! `stiction fmt`.

use std::path::Path;

use dataset::Language;

use crate::arguments::FmtArguments;
use crate::exit::{Exit, complain, say_bytes};
use crate::file::{Refusal, extension, read};
use crate::replace::replace;

/// Lays out every file; the gravest of what happened is the answer.
pub(crate) fn fmt(arguments: &FmtArguments) -> Exit {
    let mut exit = Exit::Success;
    for path in &arguments.files {
        let file = match file(path) {
            Ok(file) => file,
            Err(refusal) => {
                complain(&refusal.text);
                exit = exit.max(refusal.exit);
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

/// Reads a file and lays it out.
fn file(path: &Path) -> Result<File, Refusal> {
    let language = match extension(path).as_str() {
        "adm" => Language::Dataset,
        "acf" => Language::Commands,
        _ => {
            let name = path.display();
            return Err(Refusal::usage(&format!(
                "{name} is neither a dataset (.adm) nor a command file (.acf)"
            )));
        }
    };
    let (before, source) = read(path)?;
    let text =
        dataset::format(&source, language).map_err(|errors| Refusal::input(&errors, &source))?;
    let after = source.encode(&text);
    Ok(File { before, after })
}
