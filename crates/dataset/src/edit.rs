//! Changes written into the text of a dataset, all else of which stays as it is.

use std::collections::HashMap;
use std::ops::Range;

use crate::amendment::{displaces, text};
use crate::arguments;
use crate::diagnostic::{Code, Diagnostic, Diagnostics};
use crate::document;
use crate::grammar::{Form, Grammar, grammar};
use crate::keywords::{Argument, Keyword, Kind};
use crate::reader::RawHead;
use crate::source::{Source, Span};
use crate::syntax::{Item, Language, SyntaxTree, TokenKind, items};

/// The arguments that a statement is given, by its name and identifier (0 without one).
#[derive(Default)]
struct Edits {
    targets: Vec<(&'static str, u32)>,
    arguments: HashMap<(&'static str, u32), Vec<(&'static str, String)>>,
}

impl Edits {
    /// Adds an argument, which takes the place of those before that it displaces.
    fn add(&mut self, target: (&'static str, u32), keyword: &'static str, text: String) {
        let arguments = self.arguments.entry(target).or_insert_with(|| {
            self.targets.push(target);
            Vec::new()
        });
        arguments.retain(|(other, _)| *other != keyword && !displaces(keyword, other));
        arguments.push((keyword, text));
    }
}

/// A piece of the text and what takes its place.
type Splice = (Range<usize>, String);

/// The text of a dataset with changes made to it, each as a command would make it
/// (`FRICTION/103, MU_STATIC=0.2`): the arguments are replaced where they stand, new ones follow the last
/// one of their statement. Comments, layout and all else stay.
///
/// A statement without identifier that the dataset does not have (`INTEGRATOR`, `ACCGRAV`, ...) is put
/// before END. Of changes of one argument the last one counts. The changes are taken to be right, as
/// [`Dataset::apply`](crate::Dataset::apply) finds them.
///
/// ```
/// use dataset::{Source, edit};
/// let text = "slider\nFRICTION/103, JOINT=1 ! the guide\n, MU_STATIC = 0.3 ! dry\n, MU_DYNAMIC = 0.2\nEND\n";
/// let source = Source::from_text("m.adm", text.to_owned());
/// let changes = ["FRICTION/103, MU_STATIC=0.25", "FRICTION/103, BALL_RADIUS=2"];
/// let expected = "slider\nFRICTION/103, JOINT=1 ! the guide\n, MU_STATIC = 0.25 ! dry\n, MU_DYNAMIC = 0.2\n\
///     , BALL_RADIUS=2\nEND\n";
/// assert_eq!(edit(&source, &changes.map(str::to_owned)).unwrap(), expected);
/// ```
///
/// # Errors
/// Changes that are not arguments of a statement of the dataset.
pub fn edit(source: &Source, changes: &[String]) -> Result<String, Vec<Diagnostic>> {
    let mut edits = Edits::default();
    for change in changes {
        take(change, &mut edits)?;
    }
    let tree = SyntaxTree::new(source, Language::Dataset);
    let mut splices = Vec::new();
    let mut buffer = Vec::new();
    for statement in &tree.statements {
        items(&tree.tokens, statement, &mut buffer);
        // What is wrong with the dataset has been told where it was read.
        let mut ignored = Diagnostics::new(source);
        let Some((grammar, head, id)) = head(&buffer, Language::Dataset, &mut ignored) else {
            continue;
        };
        let Form::Table(keywords) = grammar.form else {
            continue;
        };
        if let Some(given) = edits.arguments.remove(&(grammar.name, id)) {
            let known = arguments::read(&buffer[head.rest..], grammar.name, keywords, &mut ignored);
            let statement = Statement {
                source,
                items: &buffer,
                rest: head.rest,
                arguments: known,
                keywords,
            };
            statement.splice(&given, &mut splices);
        }
    }
    let end = tree.end.map(|end| tree.tokens[end].span().start);
    let newline = if source.text().contains("\r\n") {
        "\r\n"
    } else {
        "\n"
    };
    for target in &edits.targets {
        let Some(given) = edits.arguments.remove(target) else {
            continue;
        };
        let (name, id) = *target;
        if id != 0 {
            return Err(refused(source, &format!("there is no {name}/{id}")));
        }
        let texts: Vec<&str> = given.iter().map(|(_, text)| text.as_str()).collect();
        let at = end.unwrap_or(source.text().len());
        let alone = source.text()[..at].ends_with('\n');
        let before = if alone { "" } else { newline };
        let statement = format!("{before}{name}/{}{newline}", texts.join(", "));
        splices.push((at..at, statement));
    }
    let edited = Source::from_text(source.name(), spliced(source.text(), splices));
    let (_, errors) = document::read(&edited, Language::Dataset);
    if errors.is_empty() {
        Ok(edited.text().to_owned())
    } else {
        Err(errors)
    }
}

fn refused(source: &Source, message: &str) -> Vec<Diagnostic> {
    let mut diagnostics = Diagnostics::new(source);
    let span = Span::new(0, source.text().len());
    diagnostics.error(Code::InvalidChange, span, message.to_owned());
    diagnostics.finish()
}

/// What a statement is, its head and its identifier, 0 where it has none.
fn head(
    items: &[Item],
    language: Language,
    diagnostics: &mut Diagnostics<'_>,
) -> Option<(Grammar, RawHead, u32)> {
    let head = RawHead::read(items, diagnostics)?;
    let grammar = grammar(language, diagnostics.source.slice(head.name))?;
    let number = head
        .number
        .map(|item| diagnostics.source.slice(item.span()));
    let id = number.and_then(|number| number.parse().ok()).unwrap_or(0);
    Some((grammar, head, id))
}

/// Adds the arguments of a change.
fn take(change: &str, edits: &mut Edits) -> Result<(), Vec<Diagnostic>> {
    let source = Source::from_text("change", change.to_owned());
    let tree = SyntaxTree::new(&source, Language::Statements);
    let mut diagnostics = Diagnostics::new(&source);
    let mut buffer = Vec::new();
    let [statement] = tree.statements.as_slice() else {
        return Err(refused(&source, "expected one statement"));
    };
    items(&tree.tokens, statement, &mut buffer);
    let known = head(&buffer, Language::Statements, &mut diagnostics);
    // It has to be a statement of datasets as well, not a command alone.
    let known = known.and_then(|(command, head, id)| {
        let statement = grammar(Language::Dataset, command.name)?;
        match (statement.form, statement.name == command.name) {
            (Form::Table(keywords), true) => Some((statement.name, keywords, head, id)),
            _ => None,
        }
    });
    let Some((name, keywords, head, id)) = known else {
        return Err(refused(&source, "this cannot be written into a dataset"));
    };
    let rest = &buffer[head.rest..];
    for argument in arguments::read(rest, name, keywords, &mut diagnostics) {
        let items = &rest[argument.items.clone()];
        let text = text(&source, items, argument.keyword, keywords);
        edits.add((name, id), argument.keyword, text);
    }
    let wrong = diagnostics.finish();
    if wrong.is_empty() { Ok(()) } else { Err(wrong) }
}

/// A statement of the dataset with its arguments.
struct Statement<'a> {
    source: &'a Source,
    items: &'a [Item],
    /// Where its arguments begin among its items.
    rest: usize,
    arguments: Vec<Argument>,
    keywords: &'a [Keyword],
}

impl Statement<'_> {
    /// Adds what gives it other arguments.
    fn splice(&self, given: &[(&'static str, String)], splices: &mut Vec<Splice>) {
        let mut replaced = vec![false; given.len()];
        for (place, argument) in self.arguments.iter().enumerate() {
            let new = given
                .iter()
                .position(|(keyword, _)| *keyword == argument.keyword);
            match new {
                Some(new) if !replaced[new] => {
                    replaced[new] = true;
                    splices.push(self.replaced(argument, &given[new].1));
                }
                // The value of several rows is given at the first.
                Some(_) => splices.push(self.removed(place)),
                None if given
                    .iter()
                    .any(|(new, _)| displaces(new, argument.keyword)) =>
                {
                    splices.push(self.removed(place));
                }
                None => {}
            }
        }
        let news: String = given
            .iter()
            .zip(replaced)
            .filter(|(_, replaced)| !replaced)
            .map(|((_, text), _)| format!("{}{text}", self.separator()))
            .collect();
        if !news.is_empty() {
            let last = self.arguments.last();
            let at = last.map_or(self.rest - 1, |last| self.rest + last.items.end - 1);
            let at = self.items[self.end_with_mark(at)].span().end;
            splices.push((at..at, self.opened(news)));
        }
    }

    /// The place of an item, or of the mark of the end of an expression behind it.
    fn end_with_mark(&self, at: usize) -> usize {
        at + usize::from(self.marked(at + 1))
    }

    fn marked(&self, at: usize) -> bool {
        let item = self.items.get(at);
        item.is_some_and(|item| item.kind() == TokenKind::Backslash)
    }

    /// What separates the last argument from what is before it, without comments; else a comma.
    fn separator(&self) -> String {
        let Some(last) = self.arguments.last() else {
            let slash = self.items[self.rest - 1].kind() == TokenKind::Slash;
            return if slash { "" } else { ", " }.to_owned();
        };
        let start = self.rest + last.items.start;
        let mut before = start - 1;
        while before > 0
            && matches!(
                self.items[before].kind(),
                TokenKind::Comma | TokenKind::Backslash
            )
        {
            before -= 1;
        }
        let ends = [
            self.items[before].span().end,
            self.items[start].span().start,
        ];
        let between = &self.source.text()[ends[0]..ends[1]];
        let between = between.trim_start_matches('\\');
        match between.contains(',') && !between.contains(['!', '&', '\\']) {
            true => between.to_owned(),
            false if between.contains('\n') => "\n, ".to_owned(),
            false => ", ".to_owned(),
        }
    }

    /// New arguments behind the last one: an expression must be ended before them.
    fn opened(&self, news: String) -> String {
        let Some(last) = self.arguments.last() else {
            return news;
        };
        let end = self.rest + last.items.end - 1;
        let mut rules = self.keywords.iter();
        let rule = rules.find(|rule| rule.name.full == last.keyword);
        let is_expression = rule.is_some_and(|rule| matches!(rule.kind, Kind::Expression));
        let is_open = is_expression && !self.marked(end) && !self.marked(end + 1);
        if is_open { format!("\\{news}") } else { news }
    }

    fn replaced(&self, argument: &Argument, new: &str) -> Splice {
        let own = &self.items[self.rest + argument.items.start..self.rest + argument.items.end];
        let behind = self.rest + argument.items.end;
        // The mark of the end of an expression stays where there is one, and is needed before others.
        let new = match self.marked(behind) || behind == self.items.len() {
            true => new.strip_suffix('\\').unwrap_or(new),
            false => new,
        };
        let end = own[own.len() - 1].span().end;
        match (own, new.split_once('=')) {
            ([_, equals, first, ..], Some((_, value))) if equals.kind() == TokenKind::Equals => {
                (first.span().start..end, value.trim_start().to_owned())
            }
            _ => (own[0].span().start..end, new.to_owned()),
        }
    }

    /// Without an argument and what separates it from those before.
    fn removed(&self, place: usize) -> Splice {
        let argument = &self.arguments[place];
        let start = self.rest + argument.items.start;
        let mut before = start - 1;
        while before > 0 && self.items[before].kind() == TokenKind::Comma {
            before -= 1;
        }
        let last = self.end_with_mark(self.rest + argument.items.end - 1);
        let ends = [self.items[before].span().end, self.items[last].span().end];
        // A comment at the end of the line before stays.
        let between = &self.source.text()[ends[0]..self.items[start].span().start];
        let line = between.rfind('\n').map_or(0, |newline| {
            newline - usize::from(between[..newline].ends_with('\r'))
        });
        (ends[0] + line..ends[1], String::new())
    }
}

/// A text with pieces replaced, none of which overlap.
fn spliced(text: &str, mut splices: Vec<Splice>) -> String {
    splices.sort_by_key(|(piece, _)| (piece.start, piece.end));
    let mut new = String::with_capacity(text.len());
    let mut at = 0;
    for (piece, replacement) in splices {
        new.push_str(&text[at..piece.start]);
        new.push_str(&replacement);
        at = piece.end;
    }
    new.push_str(&text[at..]);
    new
}
