//! The parts of a statement: its head, and where each of its arguments stands and what it says.

use crate::arguments::{self, FreeArgument};
use crate::diagnostic::{Code, Diagnostic, Diagnostics, Severity};
use crate::grammar::{Form, Grammar, grammar};
use crate::keywords::{Argument, Keyword, Kind, Value};
use crate::reader::RawHead;
use crate::source::Source;
use crate::syntax::{Item, Language, TokenKind, join};
use std::borrow::Cow;
use std::collections::HashSet;
use std::ops::Range;

/// A statement or command in parts.
pub(crate) struct Parts {
    /// What it is; `None` where no statement has its name.
    pub(crate) grammar: Option<Grammar>,
    /// Its name and identifier.
    pub(crate) head: RawHead,
    /// Its arguments; `None` where they can only be kept as text.
    pub(crate) arguments: Option<Vec<Part>>,
}

/// An argument of a statement.
pub(crate) struct Part {
    /// Its full name.
    pub(crate) name: Cow<'static, str>,
    /// What its value looks like; `None` where it is not read.
    pub(crate) kind: Option<Kind>,
    /// The value, where it is read.
    pub(crate) value: Option<Value>,
    /// The positions of name and value among the items of the statement.
    pub(crate) items: Range<usize>,
}

impl Parts {
    /// Takes a statement apart; `None` after a report if it has no name.
    pub(crate) fn new(
        items: &[Item],
        language: Language,
        diagnostics: &mut Diagnostics,
    ) -> Option<Self> {
        let head = RawHead::read(items, diagnostics)?;
        let grammar = grammar(language, diagnostics.source.slice(head.name));
        let behind = &items[head.rest..];
        let found: Option<Vec<Part>> = match grammar.map(|grammar| (grammar.form, grammar.name)) {
            Some((Form::Table(keywords), name)) => {
                let arguments = arguments::read(behind, name, keywords, diagnostics);
                let part = |argument| Part::of_table(argument, keywords);
                Some(arguments.into_iter().map(part).collect())
            }
            Some((Form::Free, _)) => {
                let arguments = arguments::free(diagnostics.source, behind);
                Some(arguments.into_iter().map(Part::from).collect())
            }
            Some((Form::Unknown, _)) | None => None,
        };
        let arguments = found.and_then(|mut parts| {
            for part in &mut parts {
                part.items.start += head.rest;
                part.items.end += head.rest;
            }
            is_plain(items, head.rest, &parts).then_some(parts)
        });
        Some(Self {
            grammar,
            head,
            arguments,
        })
    }
}

/// Whether the arguments say all: nothing is outside them but what separates them, what is not read
/// is at least a name with or without `= value`, and only rows of numbers are given several times.
fn is_plain(items: &[Item], start: usize, parts: &[Part]) -> bool {
    let is_separator = |item: &Item| matches!(item.kind(), TokenKind::Comma | TokenKind::Backslash);
    let mut at = start;
    let mut names = HashSet::new();
    for part in parts {
        let is_row = matches!(part.kind, Some(Kind::RealsEach));
        let behind = items[part.items.clone()].get(1);
        let has_form =
            part.value.is_some() || behind.is_none_or(|item| item.kind() == TokenKind::Equals);
        // With the comma that starts the next line it would be one mark.
        let last = items[part.items.end - 1].kind();
        let open = matches!(last, TokenKind::Comma | TokenKind::Equals);
        let separated = items[at..part.items.start].iter().all(is_separator);
        if open || !separated || !has_form || !(names.insert(part.name.as_ref()) || is_row) {
            return false;
        }
        at = part.items.end;
    }
    items[at..].iter().all(is_separator)
}

impl Part {
    /// The text behind the `=` of an argument whose value is not read; `None` without `=`.
    pub(crate) fn text(&self, source: &Source, items: &[Item]) -> Option<String> {
        let value = items.get(self.items.start + 2..self.items.end)?;
        Some(join(source, value))
    }
}

impl Part {
    /// The argument of a statement with this table.
    fn of_table(argument: Argument, keywords: &[Keyword]) -> Self {
        let mut known = keywords.iter();
        let keyword = known.find(|keyword| keyword.name.full == argument.keyword);
        Self {
            name: Cow::Borrowed(argument.keyword),
            kind: keyword
                .map(|keyword| keyword.kind)
                .filter(|_| argument.value.is_some()),
            value: argument.value,
            items: argument.items,
        }
    }
}

impl From<FreeArgument> for Part {
    fn from(argument: FreeArgument) -> Self {
        Self {
            name: Cow::Owned(argument.name),
            kind: None,
            value: None,
            items: argument.items,
        }
    }
}

/// Of these messages the errors that leave open what the text says. What is understood but not
/// simulated leaves nothing open.
pub(crate) fn errors_of_the_text(diagnostics: Diagnostics) -> Vec<Diagnostic> {
    let mut errors = diagnostics.finish();
    errors.retain(|diagnostic| {
        diagnostic.severity == Severity::Error && diagnostic.code != Code::UnsupportedArgument
    });
    errors
}
