//! What the tables say about the statement or command that a word names.

use crate::commands;
use crate::keywords::Keyword;
use crate::names::{self, Match};
use crate::statements::{Action, STATEMENTS};
use crate::syntax::Language;

/// How the arguments of a statement are written.
#[derive(Clone, Copy)]
pub(crate) enum Form {
    /// By this table.
    Table(&'static [Keyword]),
    /// Any names and values.
    Free,
    /// No table of them is known.
    Unknown,
}

/// A statement or command.
#[derive(Clone, Copy)]
pub(crate) struct Grammar {
    /// Its full name.
    pub(crate) name: &'static str,
    /// Whether it has an identifier, where that is known.
    pub(crate) identified: Option<bool>,
    /// How its arguments are written.
    pub(crate) form: Form,
}

/// The statement or command that `word`, perhaps an abbreviation, names; `None` where it names
/// none or several.
pub(crate) fn grammar(language: Language, word: &str) -> Option<Grammar> {
    if language != Language::Dataset
        && let Some(found) = commands::grammar(word)
    {
        return Some(found);
    }
    let Match::One(index) = names::find(word, STATEMENTS.iter().map(|rule| rule.name)) else {
        return None;
    };
    Some(statement(index))
}

fn statement(index: usize) -> Grammar {
    let rule = &STATEMENTS[index];
    let (identified, form) = match rule.action {
        Action::Read(Some(keywords), _) => (Some(rule.identified), Form::Table(keywords)),
        Action::Read(None, _) => (Some(rule.identified), Form::Free),
        Action::Ignored(_) | Action::Unsupported(_) => (None, Form::Unknown),
    };
    Grammar {
        name: rule.name.full,
        identified,
        form,
    }
}

/// Every statement of a dataset.
pub(crate) fn statements() -> impl Iterator<Item = Grammar> {
    (0..STATEMENTS.len()).map(statement)
}
