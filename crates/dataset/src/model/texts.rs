//! The texts of statements, for commands that change some of their arguments.

use crate::source::{Source, Span};
use std::collections::HashMap;
use std::fmt;
use std::sync::Arc;

/// The text that a dataset was read from, and statements that have been amended since. How a model
/// is written is no part of it: all texts are equal.
#[derive(Clone, Default)]
pub(crate) struct Texts {
    source: Arc<str>,
    amended: HashMap<(&'static str, u32), String>,
}

impl Texts {
    pub(crate) fn new(source: &Source) -> Self {
        Self {
            source: source.shared_text(),
            amended: HashMap::new(),
        }
    }

    /// The text of a statement that stands at `span`.
    pub(crate) fn of(&self, statement: &'static str, id: u32, span: Span) -> Option<String> {
        let amended = self.amended.get(&(statement, id));
        let written = || self.source.get(span.start..span.end).map(str::to_owned);
        amended.cloned().or_else(written)
    }

    /// Takes note of another text of a statement.
    pub(crate) fn amend(&mut self, statement: &'static str, id: u32, text: String) {
        self.amended.insert((statement, id), text);
    }
}

impl PartialEq for Texts {
    fn eq(&self, _: &Self) -> bool {
        true
    }
}

impl fmt::Debug for Texts {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.write_str("Texts")
    }
}
