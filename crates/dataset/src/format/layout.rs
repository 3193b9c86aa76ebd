//! The lines of a text, laid out anew.

use super::line::{Breaks, Piece, WIDTH, fill};
use crate::diagnostic::Diagnostics;
use crate::keywords::Kind;
use crate::parts::{Part, Parts};
use crate::source::{Source, Span};
use crate::syntax::{Item, Language, StatementTokens, SyntaxTree, TokenKind, items};
use std::ops::Range;

/// The text of a tree that reads without error.
pub(super) fn text(source: &Source, tree: &SyntaxTree, language: Language) -> String {
    let ends = tree
        .tokens
        .iter()
        .find(|token| token.kind == TokenKind::Newline);
    let carriage = ends.is_some_and(|token| source.slice(token.span()).len() > 1);
    let mut layout = Layout {
        source,
        tree,
        language,
        line_end: if carriage { "\r\n" } else { "\n" },
        out: String::with_capacity(source.text().len() + 100),
        started: false,
        blank: false,
    };
    layout.whole();
    layout.out
}

struct Layout<'a> {
    source: &'a Source,
    tree: &'a SyntaxTree,
    language: Language,
    line_end: &'static str,
    out: String,
    /// Whether there is a line already.
    started: bool,
    /// Whether a blank line comes before the next statement.
    blank: bool,
}

/// The head or one argument of a statement, or all of one that is kept as it is.
struct Segment {
    /// Its tokens, comments and line ends inside it included.
    tokens: Range<usize>,
    role: Role,
    /// What its value looks like; `None` where that is not known.
    kind: Option<Kind>,
}

#[derive(Clone, Copy, PartialEq, Eq)]
enum Role {
    Head,
    Argument,
    Whole,
}

impl Layout<'_> {
    fn slice(&self, token: usize) -> &str {
        self.source.slice(self.tree.tokens[token].span())
    }

    fn kind(&self, token: usize) -> TokenKind {
        self.tree.tokens[token].kind
    }

    fn line(&mut self, text: &str) {
        if self.started {
            self.out.push_str(self.line_end);
        }
        self.started = true;
        self.out.push_str(text);
    }

    fn whole(&mut self) {
        let mut at = 0;
        let mut end = self.tree.end;
        let first = self
            .tree
            .tokens
            .iter()
            .find(|token| token.kind != TokenKind::Whitespace);
        // An empty title, and the empty line before the commands, say that they are empty. Commands
        // get that line, since the first of several on one line might be taken for a title.
        let commands = self.language == Language::Commands;
        if first.is_none_or(|token| match token.kind {
            TokenKind::Newline => true,
            TokenKind::Line | TokenKind::Comment => false,
            _ => commands,
        }) {
            self.line("");
        }
        let mut buffer = Vec::new();
        for statement in &self.tree.statements {
            self.between(at..statement.tokens.start);
            at = statement.tokens.end;
            let stops = self.statement(statement, &mut buffer);
            if stops {
                end = Some(at - 1);
                break;
            }
        }
        let Some(end) = end else {
            self.between(at..self.tree.tokens.len());
            self.out.push_str(self.line_end);
            return;
        };
        if end >= at {
            self.between(at..end);
            self.blank_line();
            self.line(self.source.slice(self.tree.tokens[end].span()));
        }
        let rest = Span::new(self.tree.tokens[end].span().end, self.source.text().len());
        let rest = self.source.slice(rest);
        let is_empty = rest.trim_ascii().is_empty();
        self.out
            .push_str(if is_empty { self.line_end } else { rest });
    }

    /// Keeps the `;` behind a statement whose last mark, as it is written, would continue it else.
    fn open_end(&mut self, written: usize, end: usize) {
        let open = matches!(self.kind(end - 1), TokenKind::Comma | TokenKind::Ampersand);
        let behind = self.tree.tokens[end..]
            .iter()
            .find(|token| !token.is_trivia());
        let closed = behind.is_some_and(|token| token.kind == TokenKind::Semicolon);
        if written == end && open && closed {
            self.out.push(';');
        }
    }

    fn blank_line(&mut self) {
        if std::mem::take(&mut self.blank) {
            self.line("");
        }
    }

    /// Comments, and blank lines between statements.
    fn between(&mut self, tokens: Range<usize>) {
        let mut newlines = 0;
        for token in tokens {
            match self.kind(token) {
                TokenKind::Newline => newlines += 1,
                TokenKind::Line => {
                    // Commands begin behind an empty line also where the first line names the
                    // model: the line after it would name the output.
                    let first = !self.started && self.language == Language::Commands;
                    self.line(self.source.slice(self.tree.tokens[token].span()));
                    newlines = usize::from(first);
                }
                TokenKind::Comment => {
                    self.blank = newlines > 1;
                    self.comment(token, newlines > 0);
                    newlines = 0;
                }
                _ => {}
            }
        }
        self.blank = newlines > 1;
    }

    /// A comment on a line of its own, or at the end of the line before.
    fn comment(&mut self, token: usize, own_line: bool) {
        let text = self.source.slice(self.tree.tokens[token].span());
        if own_line || !self.started {
            self.blank_line();
            self.line(text.trim_ascii_end());
        } else {
            self.out.push(' ');
            self.out.push_str(text.trim_ascii_end());
        }
    }

    /// Lays out one statement; whether it is STOP.
    fn statement(&mut self, statement: &StatementTokens, buffer: &mut Vec<Item>) -> bool {
        items(&self.tree.tokens, statement, buffer);
        self.blank_line();
        // All that can be wrong has been found before.
        let parts = Parts::new(buffer, self.language, &mut Diagnostics::new(self.source));
        let segments = self.segments(statement, parts.as_ref(), buffer);
        let line = match self.language {
            Language::Dataset => None,
            _ => self.one_line(&segments, statement.tokens.end),
        };
        if let Some(line) = line {
            self.line(&line);
        } else {
            for (index, segment) in segments.iter().enumerate() {
                self.segment(segment);
                let next = segments.get(index + 1);
                let end = next.map_or(statement.tokens.end, |next| next.tokens.start);
                self.separator(segment.tokens.end..end);
            }
        }
        let written = segments.last().map_or(0, |segment| segment.tokens.end);
        self.open_end(written, statement.tokens.end);
        let grammar = parts.and_then(|parts| parts.grammar);
        let stops = grammar.is_some_and(|grammar| grammar.name == "STOP");
        stops && self.language == Language::Commands
    }

    fn segments(
        &self,
        statement: &StatementTokens,
        parts: Option<&Parts>,
        items: &[Item],
    ) -> Vec<Segment> {
        let whole = |role| Segment {
            tokens: statement.tokens.clone(),
            role,
            kind: None,
        };
        let Some((head, arguments)) = parts.and_then(|parts| {
            let arguments = parts.arguments.as_ref()?;
            Some((parts.head.rest, arguments))
        }) else {
            return vec![whole(Role::Whole)];
        };
        let tokens = |range: Range<usize>| {
            let token = |item: usize| {
                let start = items[item].span().start;
                let inside = &self.tree.tokens[statement.tokens.clone()];
                let before = inside.partition_point(|token| token.span().start < start);
                statement.tokens.start + before
            };
            token(range.start)..token(range.end - 1) + 1
        };
        let head = Segment {
            tokens: tokens(0..head),
            ..whole(Role::Head)
        };
        let argument = |part: &Part| Segment {
            tokens: tokens(part.items.clone()),
            role: Role::Argument,
            kind: part.kind,
        };
        std::iter::once(head)
            .chain(arguments.iter().map(argument))
            .collect()
    }

    /// What stands between two segments: `\\`, comments, and commas that the lines make.
    fn separator(&mut self, tokens: Range<usize>) {
        if self.has(&tokens, TokenKind::Backslash) {
            self.out.push('\\');
        }
        let mut own_line = false;
        for token in tokens {
            match self.kind(token) {
                TokenKind::Newline => own_line = true,
                TokenKind::Comment => self.comment(token, own_line),
                _ => {}
            }
        }
    }

    fn has(&self, tokens: &Range<usize>, kind: TokenKind) -> bool {
        let mut tokens = self.tree.tokens[tokens.clone()].iter();
        tokens.any(|token| token.kind == kind)
    }

    /// A command on one line; `None` where it is too long or must not be on one line.
    fn one_line(&self, segments: &[Segment], end: usize) -> Option<String> {
        let mut line = String::new();
        for (index, segment) in segments.iter().enumerate() {
            let next = segments.get(index + 1);
            let behind = segment.tokens.end..next.map_or(end, |next| next.tokens.start);
            let flag_follows = next.is_some_and(|next| !self.has(&next.tokens, TokenKind::Equals));
            // Only the start of a line ends a text before a flag.
            let text = matches!(segment.kind, Some(Kind::Text | Kind::Strings));
            if segment.role == Role::Whole
                || self.has(&segment.tokens, TokenKind::Newline)
                || self.has(&behind, TokenKind::Comment)
                || (text && flag_follows)
            {
                return None;
            }
            let behind_slash = index == 1 && line.ends_with('/');
            if segment.role == Role::Argument && !behind_slash {
                line.push_str(", ");
            }
            let (start, pieces) = self.pieces(segment, segment.tokens.clone(), true, false);
            line.push_str(&start);
            for piece in pieces {
                line.push_str(piece.before);
                line.push_str(piece.text);
            }
            if self.has(&behind, TokenKind::Backslash) {
                line.push('\\');
            }
        }
        (line.chars().count() <= WIDTH).then_some(line)
    }

    /// The lines of a head or argument.
    fn segment(&mut self, segment: &Segment) {
        let several = self.has(&segment.tokens, TokenKind::Newline);
        let breaks = match segment.kind {
            Some(Kind::Expression) => Breaks::Terms,
            Some(Kind::Strings) => Breaks::Commas,
            Some(kind) if kind.is_numeric() => Breaks::Commas,
            _ => Breaks::Never,
        };
        let mut from = segment.tokens.start;
        while from < segment.tokens.end {
            let rest = &self.tree.tokens[from..segment.tokens.end];
            let length = rest
                .iter()
                .position(|token| token.kind == TokenKind::Newline);
            let to = from + length.unwrap_or(rest.len());
            let first = from == segment.tokens.start;
            let line = self.trimmed(from..to);
            from = to + 1;
            if line.is_empty() {
                continue;
            }
            if segment.role == Role::Whole {
                let span = |token: usize| self.tree.tokens[token].span();
                let text = span(line.start).to(span(line.end - 1));
                self.line(self.source.slice(text).trim_ascii());
                continue;
            }
            let comment = Some(line.end - 1).filter(|last| self.kind(*last) == TokenKind::Comment);
            let line = self.trimmed(line.start..comment.unwrap_or(line.end));
            if !line.is_empty() {
                let (start, pieces) = self.pieces(segment, line.clone(), first, several);
                let comma = if first && segment.role == Role::Argument {
                    ", "
                } else {
                    ""
                };
                for line in fill(&format!("{comma}{start}"), &pieces, breaks) {
                    self.line(line.trim_ascii_end());
                }
            }
            if let Some(comment) = comment {
                self.comment(comment, line.is_empty());
            }
        }
    }

    /// Tokens without blanks at their ends.
    fn trimmed(&self, mut tokens: Range<usize>) -> Range<usize> {
        let blank = |token: usize| self.kind(token) == TokenKind::Whitespace;
        while !tokens.is_empty() && blank(tokens.start) {
            tokens.start += 1;
        }
        while !tokens.is_empty() && blank(tokens.end - 1) {
            tokens.end -= 1;
        }
        tokens
    }

    /// The start of a line and the pieces behind it. `several`: the segment has several lines,
    /// in which the author's blanks are kept.
    fn pieces(
        &self,
        segment: &Segment,
        tokens: Range<usize>,
        first: bool,
        several: bool,
    ) -> (String, Vec<Piece<'_>>) {
        let mut at = tokens.start;
        let mut start = String::new();
        let as_it_is = match segment.kind {
            None => segment.role == Role::Argument,
            Some(kind) => matches!(kind, Kind::Text),
        };
        if first && segment.role == Role::Argument {
            start.push_str(self.slice(at));
            let behind = self.trimmed(at + 1..tokens.end);
            at = behind.start;
            if !behind.is_empty() && self.kind(at) == TokenKind::Equals {
                at = self.trimmed(at + 1..tokens.end).start;
                start.push_str(match self.language {
                    Language::Dataset => " = ",
                    _ => "=",
                });
            }
        } else if !first && self.kind(at) == TokenKind::Comma {
            start.push(',');
            at += 1;
            let blank = at < tokens.end && self.kind(at) == TokenKind::Whitespace;
            if blank {
                start.push_str(self.slice(at));
                at += 1;
            } else if !as_it_is {
                start.push(' ');
            }
        }
        let numbers = segment.kind.is_some_and(Kind::is_numeric);
        let keeps_blanks = several || as_it_is;
        let mut pieces: Vec<Piece> = Vec::with_capacity(tokens.end.saturating_sub(at));
        let mut end = None;
        for token in at..tokens.end {
            if self.kind(token) == TokenKind::Whitespace {
                continue;
            }
            let span = self.tree.tokens[token].span();
            let blank = Span::new(end.unwrap_or(span.start), span.start);
            let blank = self.source.slice(blank);
            end = Some(span.end);
            let before = match pieces.last().map(|piece| piece.kind) {
                None => "",
                Some(_) if segment.role == Role::Head => "",
                Some(_) if keeps_blanks => blank,
                Some(TokenKind::Comma) if numbers => " ",
                Some(_) if numbers || blank.is_empty() => "",
                Some(_) => " ",
            };
            pieces.push(Piece {
                text: self.slice(token),
                kind: self.kind(token),
                before,
            });
        }
        (start, pieces)
    }
}
