//! Messages with their place, ready to be shown.

use dataset::{Diagnostic, Location, Severity, Source};
use serde::{Deserialize, Serialize};

/// A diagnostic with its place. As text it is `file:line:column: severity[code]: message`, the line
/// of the source and help; it ends with a newline.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Message {
    /// What it says, with its code and severity.
    pub diagnostic: Diagnostic,
    /// Where that is.
    pub location: Location,
}

impl Message {
    /// The message of a diagnostic about `source`.
    #[must_use]
    pub fn new(diagnostic: Diagnostic, source: &Source) -> Self {
        let location = diagnostic.locate(source);
        Self {
            diagnostic,
            location,
        }
    }

    /// Whether it is an error.
    #[must_use]
    pub fn is_error(&self) -> bool {
        self.diagnostic.severity == Severity::Error
    }
}

impl std::fmt::Display for Message {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        f.write_str(&self.diagnostic.render_at(&self.location))
    }
}

/// The input cannot be simulated: every error of it, and the warnings found on the way.
#[derive(Clone, Debug, PartialEq)]
pub struct InputError {
    /// In the order of the files.
    pub messages: Vec<Message>,
}

impl std::fmt::Display for InputError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        self.messages
            .iter()
            .try_for_each(|message| write!(f, "{message}"))
    }
}

impl std::error::Error for InputError {}
