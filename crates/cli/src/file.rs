//! Files that are read whole.

use std::path::Path;

use dataset::{Diagnostic, Source};

use crate::exit::Exit;

/// What to show where a file cannot be used, and how the program ends then.
pub(crate) struct Refusal {
    pub(crate) text: String,
    pub(crate) exit: Exit,
}

impl Refusal {
    /// Something is wrong with the use of a file, not with what is in it.
    pub(crate) fn usage(text: &str) -> Self {
        Self {
            text: format!("error: {text}\n"),
            exit: Exit::Usage,
        }
    }

    /// Something is wrong with what is in a file.
    pub(crate) fn input(errors: &[Diagnostic], source: &Source) -> Self {
        Self {
            text: errors.iter().map(|error| error.render(source)).collect(),
            exit: Exit::Input,
        }
    }
}

/// The extension of a path in small letters; empty without one.
pub(crate) fn extension(path: &Path) -> String {
    let extension = path.extension().unwrap_or_default();
    extension.to_string_lossy().to_ascii_lowercase()
}

/// Reads a file: its bytes and its text.
pub(crate) fn read(path: &Path) -> Result<(Vec<u8>, Source), Refusal> {
    let name = path.display().to_string();
    let bytes = std::fs::read(path).map_err(|error| Refusal {
        text: format!("error: {name} cannot be read: {error}\n"),
        exit: Exit::Input,
    })?;
    let source = Source::from_bytes(&name, &bytes)
        .map_err(|error| Refusal::input(&[*error], &Source::from_text(&name, String::new())))?;
    Ok((bytes, source))
}
