//! Messages with their place, ready to be shown.

use dataset::{Diagnostic, Severity, Source};

/// A diagnostic with its line and column and the text that shows it.
#[derive(Clone, Debug, PartialEq)]
pub struct Message {
    /// What it says, with its code and severity.
    pub diagnostic: Diagnostic,
    /// Line, counted from 1.
    pub line: usize,
    /// Column, counted from 1.
    pub column: usize,
    /// `file:line:column: severity[code]: message`, the line of the source and help; it ends with
    /// a newline.
    pub text: String,
}

impl Message {
    /// The message of a diagnostic about `source`.
    #[must_use]
    pub fn new(diagnostic: Diagnostic, source: &Source) -> Self {
        let (line, column) = source.line_column(diagnostic.span.start);
        let text = diagnostic.render(source);
        Self {
            diagnostic,
            line,
            column,
            text,
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
        f.write_str(&self.text)
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
