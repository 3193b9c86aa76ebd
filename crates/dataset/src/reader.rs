//! From text to a [`Dataset`].

use crate::checks;
use crate::commands;
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::lints;
use crate::model::{Dataset, Texts};
use crate::names::{self, Match, Name};
use crate::reading::{Head, Reading};
use crate::source::{Source, Span};
use crate::statements::{Action, Builder, Rule, STATEMENTS, name_freedoms};
use crate::syntax::{Grouping, Item, Language, NAMES, StatementTokens, Token, TokenKind, items};

/// Reads a dataset (`.adm`).
///
/// All that is wrong is reported in one go, in the order of the file. The dataset can be used
/// only if none of the diagnostics is an error.
///
/// ```
/// use dataset::{read_dataset, Source};
/// let text = "A pendulum
/// UNITS/SYSTEM=MKS
/// PART/1, GROUND
/// MARKER/1, PART=1
/// PART/2, MASS=1, CM=20, IP=0.1, 0.1, 0.1
/// MARKER/20, PART=2, QP=0, 0, -1
/// MARKER/2, PART=2
/// JOINT/1, REVOLUTE, I=2, J=1
/// ACCGRAV/KGRAV=-9.81
/// END";
/// let source = Source::from_text("pendulum.adm", text.to_string());
/// let (dataset, diagnostics) = read_dataset(&source);
/// assert!(diagnostics.is_empty());
/// assert_eq!(dataset.joints[0].i, 2);
/// assert_eq!(dataset.markers.by_id(20).unwrap().qp, [0.0, 0.0, -1.0]);
/// ```
#[must_use]
pub fn read_dataset(source: &Source) -> (Dataset, Vec<Diagnostic>) {
    read(source, |_, _| {})
}

/// [`read_dataset`] with warnings and remarks on what is allowed and seldom meant.
///
/// ```
/// use dataset::{lint_dataset, Code, Source};
/// let text = "A model in metres
/// UNITS/SYSTEM=MKS
/// PART/1, GROUND
/// ACCGRAV/KGRAV=-9806.65
/// ";
/// let source = Source::from_text("m.adm", text.to_string());
/// let (_, diagnostics) = lint_dataset(&source);
/// assert_eq!(diagnostics[0].code, Code::GravityUnit);
/// ```
#[must_use]
pub fn lint_dataset(source: &Source) -> (Dataset, Vec<Diagnostic>) {
    read(source, lints::model)
}

/// Reads a dataset and looks through it after its rules are checked.
fn read(
    source: &Source,
    look_through: fn(&Builder, &mut Diagnostics),
) -> (Dataset, Vec<Diagnostic>) {
    let mut diagnostics = Diagnostics::new(source);
    let mut grouping = Grouping::new(source, Language::Dataset);
    let mut builder = Builder::default();
    builder.dataset.title = title(source, grouping.tokens(), &mut diagnostics);
    builder.dataset.texts = Texts::new(source);
    let mut buffer = Vec::new();
    let mut empty = true;
    while let Some(statement) = grouping.statement() {
        empty = false;
        let tokens = grouping.tokens();
        items(tokens, &statement, &mut buffer);
        read_statement(tokens, &statement, &buffer, &mut builder, &mut diagnostics);
        if diagnostics.ends_with(Code::WrongFileType) {
            return (builder.dataset, diagnostics.finish());
        }
        grouping.forget();
    }
    if empty {
        diagnostics
            .error(
                Code::Empty,
                Span::default(),
                "this dataset holds no statement",
            )
            .help("the first line is the title; statements follow it");
        return (builder.dataset, diagnostics.finish());
    }
    name_freedoms(&mut builder, &mut diagnostics);
    checks::model(&builder, &mut diagnostics);
    look_through(&builder, &mut diagnostics);
    (builder.dataset, diagnostics.finish())
}

/// The first line; a warning where it looks like a statement.
fn title(source: &Source, tokens: &[Token], diagnostics: &mut Diagnostics) -> String {
    let first = tokens.first();
    let Some(token) = first.filter(|token| token.kind == TokenKind::Line) else {
        return String::new();
    };
    let text = source.slice(token.span());
    let (before, _) = text.split_once('/').unwrap_or_default();
    let is_statement = STATEMENTS
        .iter()
        .any(|rule| rule.name.full.eq_ignore_ascii_case(before.trim()));
    if is_statement {
        diagnostics
            .warning(
                Code::TitleIsStatement,
                token.span(),
                "this line looks like a statement, but the first line is the title",
            )
            .help("put a title, which may be empty, before it")
            .replace(Span::default(), "\n");
    }
    text.trim_ascii_end().to_string()
}

pub(crate) fn read_statement(
    tokens: &[Token],
    statement: &StatementTokens,
    items: &[Item],
    builder: &mut Builder,
    diagnostics: &mut Diagnostics,
) {
    let Some(raw) = RawHead::read(items, diagnostics) else {
        return;
    };
    let names = STATEMENTS.iter().map(|rule| rule.name);
    let Some(index) = find(raw.name, names, unknown_statement, diagnostics) else {
        return;
    };
    let rule = &STATEMENTS[index];
    let name = rule.name.full;
    let (keywords, read) = match rule.action {
        Action::Read(keywords, read) => (keywords, read),
        Action::Ignored(reason) => {
            let message = format!("{name} has no effect: {reason}");
            diagnostics.note(Code::Ignored, raw.head, message);
            builder.mention(diagnostics.source, &items[raw.rest..]);
            return;
        }
        Action::Unsupported(instead) => {
            let message = format!("stiction does not simulate {name}");
            diagnostics
                .error(Code::UnsupportedStatement, raw.head, message)
                .help(instead);
            return;
        }
    };
    let id = raw.id(name, rule.identified, diagnostics);
    if !rule.identified {
        if builder.singles.contains(&name) {
            let message = format!("{name} is there already");
            diagnostics
                .error(Code::DuplicateStatement, raw.head, message)
                .help("keep one, with the arguments of both");
        }
        builder.singles.push(name);
    }
    let head = Head {
        name,
        span: statement.span(tokens),
        head: raw.head,
        id,
        view_name: view_name(tokens, statement, diagnostics.source),
    };
    let mut reading = Reading::new(head, &items[raw.rest..], keywords, diagnostics);
    for argument in reading.unread() {
        builder.mention(reading.diagnostics.source, argument);
    }
    read(&mut reading, builder);
}

/// The name in the last `adams_view_name='...'` comment before a statement.
pub(crate) fn view_name(
    tokens: &[Token],
    statement: &StatementTokens,
    source: &Source,
) -> Option<String> {
    let comment = source.slice(tokens[statement.name_comment?].span());
    let start = memchr::memmem::find(comment.as_bytes(), NAMES.as_bytes())?;
    let name = &comment[start + NAMES.len()..];
    let name = name.trim().strip_prefix('=')?.trim().strip_prefix('\'')?;
    Some(name[..name.rfind('\'')?].to_string())
}

/// The name and identifier at the start of a statement or command.
pub(crate) struct RawHead {
    /// The name.
    pub(crate) name: Span,
    /// The name and what belongs to it.
    pub(crate) head: Span,
    /// The item that should be the identifier.
    pub(crate) number: Option<Item>,
    /// Whether a `/` stands between the name and what follows.
    slash: bool,
    /// The position of the first item behind it.
    pub(crate) rest: usize,
}

impl RawHead {
    /// Reads the head; `None` after a report if there is none.
    pub(crate) fn read(items: &[Item], diagnostics: &mut Diagnostics) -> Option<Self> {
        let first = items.first()?;
        if first.kind() != TokenKind::Word {
            let found = diagnostics.source.excerpt(first.span());
            let message = format!("expected the name of a statement, found `{found}`");
            diagnostics.error(Code::Syntax, first.span(), message);
            return None;
        }
        if items
            .get(1)
            .is_some_and(|item| item.kind() == TokenKind::Equals)
        {
            continuation(first.span(), "it", diagnostics);
            return None;
        }
        let slash = items
            .get(1)
            .is_some_and(|item| item.kind() == TokenKind::Slash);
        let number = items.get(1 + usize::from(slash));
        let number = number.filter(|item| item.kind() == TokenKind::Number);
        let rest = 1 + usize::from(slash) + usize::from(number.is_some());
        Some(Self {
            name: first.span(),
            head: first.span().to(items[rest - 1].span()),
            number: number.copied(),
            slash,
            rest,
        })
    }

    /// The identifier; 0 where there is none, which is reported if there should be one.
    pub(crate) fn id(&self, name: &str, identified: bool, diagnostics: &mut Diagnostics) -> u32 {
        let Some(number) = self.number else {
            if identified {
                diagnostics
                    .error(Code::InvalidId, self.head, format!("{name} needs a number"))
                    .help(format!("write {name}/1"));
            }
            return 0;
        };
        if !identified {
            let message = format!("{name} has no number");
            diagnostics
                .error(Code::InvalidId, number.span(), message)
                .help(format!("write {name}/ and the arguments"));
            return 0;
        }
        let text = diagnostics.source.slice(number.span());
        if !self.slash {
            let between = Span::new(self.name.end, number.span().start);
            let message = format!("a `/` is missing between {name} and its number");
            let shown = diagnostics.source.excerpt(number.span());
            diagnostics
                .error(Code::InvalidId, self.head, message)
                .help(format!("write {name}/{shown}"))
                .replace(between, "/");
        }
        if let Some(id) = text.parse().ok().filter(|id| *id > 0) {
            return id;
        }
        let shown = diagnostics.source.excerpt(number.span());
        let message =
            format!("{name}/{shown}: numbers of elements are whole, from 1 to 4294967295");
        diagnostics
            .error(Code::InvalidId, number.span(), message)
            .help("give it a number up to 4294967295, here and where it is referred to");
        0
    }
}

/// Reports an argument at the start of a line that does not continue the statement before.
fn continuation(name: Span, owner: &str, diagnostics: &mut Diagnostics) {
    let argument = diagnostics.source.excerpt(name);
    let message = format!("{argument} is no statement but an argument");
    let start = Span::new(name.start, name.start);
    diagnostics
        .error(Code::Syntax, name, message)
        .help(format!(
            "if {owner} belongs to the statement before, start the line with a comma"
        ))
        .replace(start, ", ");
}

/// Reports a name that no statement has.
fn unknown_statement(name: Span, near: Option<&'static str>, diagnostics: &mut Diagnostics) {
    let word = diagnostics.source.slice(name);
    if let Some(command) = commands::grammar(word) {
        let message = format!("{} is a command, and this is a dataset", command.name);
        diagnostics
            .error(Code::WrongFileType, name, message)
            .help("a file of commands has the extension .acf");
        return;
    }
    if let Some(owner) = statement_with(word) {
        return continuation(name, &format!("this argument of {owner}"), diagnostics);
    }
    let message = format!(
        "no statement is called {}",
        diagnostics.source.excerpt(name)
    );
    diagnostics
        .error(Code::UnknownStatement, name, message)
        .meant(near);
}

/// The first statement with an argument of this full name.
fn statement_with(argument: &str) -> Option<&'static str> {
    let has = |rule: &&Rule| match rule.action {
        Action::Read(Some(keywords), _) => keywords
            .iter()
            .any(|keyword| keyword.name.full.eq_ignore_ascii_case(argument)),
        _ => false,
    };
    STATEMENTS.iter().find(has).map(|rule| rule.name.full)
}

/// The position of the name that `span` means; `None` after a report, by `unknown` with the name
/// that is near where it means none.
pub(crate) fn find(
    span: Span,
    names: impl Iterator<Item = Name> + Clone,
    unknown: fn(Span, Option<&'static str>, &mut Diagnostics),
    diagnostics: &mut Diagnostics,
) -> Option<usize> {
    let word = diagnostics.source.slice(span);
    match names::find(word, names.clone()) {
        Match::One(index) => return Some(index),
        Match::Several(fits) => {
            let message = format!("`{word}` can mean {}", fits.join(" or "));
            diagnostics
                .error(Code::AmbiguousName, span, message)
                .help("write more letters");
        }
        Match::None => {
            let near = (!diagnostics.is_full())
                .then(|| names::nearest(word, names.map(|name| name.full)))
                .flatten();
            unknown(span, near, diagnostics);
        }
    }
    None
}
