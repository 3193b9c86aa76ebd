//! Messages about a source text, as data that every front end renders in its own way.

mod code;
mod list;
mod location;

pub use code::Code;
pub(crate) use list::Diagnostics;
pub use location::{Location, Place};
use serde::{Deserialize, Serialize};

use crate::source::Span;

/// How serious a [`Diagnostic`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Serialize, Deserialize)]
pub enum Severity {
    /// The model cannot be used.
    Error,
    /// The model can be used, but the reader should know.
    Warning,
    /// A remark.
    Note,
}

impl Severity {
    /// `error`, `warning` or `note`.
    #[must_use]
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Warning => "warning",
            Self::Note => "note",
        }
    }
}

/// New text for a place of the source, which a program can put there without asking.
#[derive(Clone, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Replacement {
    /// The place; empty where the text is put in between.
    pub span: Span,
    /// The new text.
    pub text: String,
}

/// One message about one place of a source text.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Diagnostic {
    /// What the message is about.
    pub code: Code,
    /// How serious it is.
    pub severity: Severity,
    /// The message, one line.
    pub message: String,
    /// The name of the file.
    pub source: String,
    /// The place in the file.
    pub span: Span,
    /// Further facts, one line each.
    pub notes: Vec<String>,
    /// How to put it right, one line.
    pub help: Option<String>,
    /// What puts it right, where that is clear.
    pub replacement: Option<Replacement>,
}

impl Diagnostic {
    /// A message about a place of the source of this name, without notes and help.
    #[must_use]
    pub fn new(
        severity: Severity,
        code: Code,
        source: &str,
        span: Span,
        message: impl Into<String>,
    ) -> Self {
        Self {
            code,
            severity,
            message: message.into(),
            source: source.to_owned(),
            span,
            notes: Vec::new(),
            help: None,
            replacement: None,
        }
    }

    /// Says how to put it right.
    pub fn help(&mut self, help: impl Into<String>) -> &mut Self {
        self.help = Some(help.into());
        self
    }

    /// Adds a fact.
    pub fn note(&mut self, note: impl Into<String>) -> &mut Self {
        self.notes.push(note.into());
        self
    }

    /// Adds that the same holds for other elements or places, by their names, of which so many as
    /// are read in a line are listed.
    ///
    /// ```
    /// use dataset::{Code, Diagnostic, Severity, Span};
    /// let (severity, code) = (Severity::Error, Code::UnsupportedStatement);
    /// let mut error = Diagnostic::new(severity, code, "m.adm", Span::default(), "no TIRE");
    /// error.holds_for(&["TIRE/2".to_string(), "TIRE/3".to_string()]);
    /// assert_eq!(error.notes, ["the same holds for 2 more: TIRE/2, TIRE/3"]);
    /// ```
    pub fn holds_for(&mut self, others: &[String]) -> &mut Self {
        if others.is_empty() {
            return self;
        }
        let count = others.len();
        self.note(format!("the same holds for {count} more: {}", few(others)))
    }

    /// Asks whether a name is meant, where one is near, in place of the text that is marked.
    pub(crate) fn meant(&mut self, near: Option<&str>) -> &mut Self {
        if let Some(near) = near {
            let span = self.span;
            self.help(format!("is {near} meant?")).replace(span, near);
        }
        self
    }

    /// Says what a program may put at `span` to put it right; beside the help for people.
    pub fn replace(&mut self, span: Span, text: impl Into<String>) -> &mut Self {
        let text = text.into();
        self.replacement = Some(Replacement { span, text });
        self
    }
}

/// Names in a row, cut where there are many.
pub(crate) fn few(names: &[String]) -> String {
    const MOST: usize = 12;
    match names.get(..MOST) {
        Some(first) if names.len() > MOST => first.join(", ") + ", ...",
        _ => names.join(", "),
    }
}
