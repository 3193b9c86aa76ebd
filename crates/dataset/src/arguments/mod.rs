//! Reads the arguments of a statement: by its table of keywords, or freely where it has none.

mod free;
mod values;

pub(crate) use free::{FreeArgument, free};

use crate::diagnostic::{Code, Diagnostics};
use crate::keywords::{Argument, Keyword, Kind, Value};
use crate::names::{self, Match};
use crate::source::{Source, Span};
use crate::syntax::{Item, TokenKind};

/// Reads the arguments in `items`. One that is wrong is reported and has no value, as one without
/// effect has none.
pub(crate) fn read(
    items: &[Item],
    statement: &'static str,
    keywords: &[Keyword],
    diagnostics: &mut Diagnostics,
) -> Vec<Argument> {
    let mut parser = Parser {
        source: diagnostics.source,
        items,
        at: 0,
        statement,
        keywords,
        diagnostics,
        // Most are a comma, a name, `=` and a value.
        arguments: Vec::with_capacity((items.len() / 4 + 1).min(16)),
    };
    parser.arguments();
    parser.arguments
}

struct Parser<'a, 's> {
    source: &'s Source,
    items: &'a [Item],
    at: usize,
    statement: &'static str,
    keywords: &'a [Keyword],
    diagnostics: &'a mut Diagnostics<'s>,
    arguments: Vec<Argument>,
}

/// The value is wrong and has been reported.
struct Refused;

impl Parser<'_, '_> {
    fn kind(&self, at: usize) -> Option<TokenKind> {
        self.items.get(at).map(|item| item.kind())
    }

    fn slice(&self, at: usize) -> &str {
        self.items
            .get(at)
            .map_or("", |item| self.source.slice(item.span()))
    }

    fn span(&self, at: usize) -> Span {
        let last = self.items.len().saturating_sub(1);
        self.items
            .get(at.min(last))
            .map_or(Span::default(), |item| item.span())
    }

    fn find(&self, word: &str) -> Match {
        names::find(word, self.keywords.iter().map(|keyword| keyword.name))
    }

    /// The only argument that an abbreviation can mean before `=`, or where no `=` follows.
    fn fitting(&self, word: &str) -> Option<Keyword> {
        let has_value = self.kind(self.at) == Some(TokenKind::Equals);
        let fits = |keyword: &&Keyword| has_value != matches!(keyword.kind, Kind::Flag);
        let candidates = || self.keywords.iter().filter(fits);
        match names::find(word, candidates().map(|keyword| keyword.name)) {
            Match::One(place) => candidates().nth(place).copied(),
            _ => None,
        }
    }

    fn arguments(&mut self) {
        let mut separated = true;
        while self.at < self.items.len() {
            match self.kind(self.at) {
                Some(TokenKind::Comma) => {
                    let follows = self.kind(self.at + 1);
                    if matches!(follows, None | Some(TokenKind::Comma)) {
                        let span = self.span(self.at);
                        self.diagnostics.error(
                            Code::Syntax,
                            span,
                            "an argument is missing after this comma",
                        );
                    }
                    separated = true;
                    self.at += 1;
                }
                Some(TokenKind::Backslash) => {
                    separated = true;
                    self.at += 1;
                }
                Some(TokenKind::Word) if separated => {
                    separated = false;
                    self.argument();
                }
                Some(TokenKind::Word) if self.argument_at(self.at) => {
                    let span = self.span(self.at);
                    let message = format!("a comma is missing before {}", self.slice(self.at));
                    let before = Span::new(span.start, span.start);
                    self.diagnostics
                        .error(Code::Syntax, span, message)
                        .help("arguments are separated by commas")
                        .replace(before, ", ");
                    self.argument();
                }
                _ => {
                    let span = self.span(self.at);
                    let found = self.source.excerpt(span);
                    let (expected, help) = if separated {
                        ("the name of an argument", None)
                    } else {
                        ("`,`", Some("arguments are separated by commas"))
                    };
                    let error = self.diagnostics.error(
                        Code::Syntax,
                        span,
                        format!("expected {expected}, found `{found}`"),
                    );
                    error.help = help.map(str::to_string);
                    separated = false;
                    self.skip_value();
                }
            }
        }
    }

    fn argument(&mut self) {
        let name_at = self.at;
        let span = self.span(name_at);
        self.at += 1;
        let word = self.source.slice(span);
        let keyword = match self.find(word) {
            Match::One(index) => self.keywords[index],
            Match::Several(fits) => {
                let Some(keyword) = self.fitting(word) else {
                    let message = format!("`{word}` can mean {}", fits.join(" or "));
                    self.diagnostics
                        .error(Code::AmbiguousName, span, message)
                        .help("write more letters");
                    return self.skip_value();
                };
                keyword
            }
            Match::None => {
                let names = self.keywords.iter().map(|keyword| keyword.name.full);
                let near = (!self.diagnostics.is_full())
                    .then(|| names::nearest(word, names))
                    .flatten();
                let found = self.source.excerpt(span);
                let message = format!("{} has no argument {found}", self.statement);
                let error = self.diagnostics.error(Code::UnknownArgument, span, message);
                error.meant(near);
                if self.items[name_at].starts_line {
                    error.note("the comma at the end of the line before continues the statement");
                }
                self.skip_value();
                // The one that is meant is not missing.
                if let Some(near) = near {
                    self.add(near, name_at, None);
                }
                return;
            }
        };
        let value = self.read_value(keyword, span);
        self.add(keyword.name.full, name_at, value);
    }

    /// Adds the argument from the item `name_at` to the present one.
    fn add(&mut self, keyword: &'static str, name_at: usize, value: Option<Value>) {
        let span = self.span(name_at);
        let end = self.at;
        let value_span = match value {
            Some(Value::Flag) | None => span,
            Some(_) => self.span(name_at + 2).to(self.span(end - 1)),
        };
        self.arguments.push(Argument {
            keyword,
            span,
            value_span,
            items: name_at..end,
            value,
        });
    }

    /// The value of an argument; `None` after a report. Moves behind it in any case.
    fn read_value(&mut self, keyword: Keyword, span: Span) -> Option<Value> {
        let full = keyword.name.full;
        match keyword.kind {
            Kind::Ignored(reason) => {
                let message = format!("{} of {} has no effect: {reason}", full, self.statement);
                self.diagnostics.note(Code::Ignored, span, message);
                self.skip_value();
                return None;
            }
            Kind::Unsupported(reason) => {
                let message = format!("{full} of {} is not simulated: {reason}", self.statement);
                self.diagnostics
                    .error(Code::UnsupportedArgument, span, message);
                self.skip_value();
                return None;
            }
            _ => {}
        }
        let once = !matches!(keyword.kind, Kind::RealsEach);
        let mut before = self.arguments.iter();
        if once && before.any(|argument| argument.keyword == full && argument.value.is_some()) {
            let message = format!("{full} is given twice");
            self.diagnostics
                .error(Code::DuplicateArgument, span, message)
                .help("keep one of the two");
        }
        match self.value(full, keyword.kind, span) {
            Ok(value) => Some(value),
            Err(Refused) => {
                self.skip_refused();
                None
            }
        }
    }

    /// Moves behind a value that is not read: to `\`, to a comma outside brackets with a name
    /// behind it, or to the start of a continued line with `NAME =`.
    fn skip_value(&mut self) {
        let mut brackets = 0_usize;
        while let Some(kind) = self.kind(self.at) {
            match kind {
                TokenKind::Backslash if self.value_ends_at(self.at) => break,
                TokenKind::LeftParenthesis => brackets += 1,
                TokenKind::RightParenthesis => brackets = brackets.saturating_sub(1),
                TokenKind::Comma if self.kind(self.at + 1) == Some(TokenKind::Word) => {
                    let named = self.kind(self.at + 2) == Some(TokenKind::Equals);
                    if brackets == 0 || (named && self.items[self.at].continues) {
                        break;
                    }
                }
                _ => {}
            }
            self.at += 1;
        }
    }

    /// Whether the `\\` ends a value, and is not one inside the path of a file.
    fn value_ends_at(&self, backslash: usize) -> bool {
        let next = backslash + 1;
        let in_path = self.span(backslash).end == self.span(next).start
            && self.kind(next) != Some(TokenKind::Comma)
            && self.kind(next + 1) != Some(TokenKind::Equals)
            && !self.argument_at(next);
        !in_path
    }

    /// Moves behind a value that is wrong, to `\\` or a comma before the name of an argument.
    fn skip_refused(&mut self) {
        loop {
            self.skip_value();
            let named = self.kind(self.at + 2) == Some(TokenKind::Equals);
            let comma = self.kind(self.at) == Some(TokenKind::Comma);
            if !comma || named || self.argument_at(self.at + 1) {
                break;
            }
            self.at += 1;
        }
    }

    /// Whether the item is the name of an argument of this statement.
    fn argument_at(&self, at: usize) -> bool {
        self.kind(at) == Some(TokenKind::Word) && matches!(self.find(self.slice(at)), Match::One(_))
    }

    fn refuse(&mut self, at: usize, message: String) -> Refused {
        let span = self.span(at);
        self.diagnostics.error(Code::InvalidValue, span, message);
        Refused
    }
}
