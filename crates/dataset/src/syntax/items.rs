//! The tokens of one statement that carry meaning, with continuation marks removed.

use super::{StatementTokens, Token, TokenKind};
use crate::source::{Source, Span};

/// A token that carries meaning.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Item {
    token: Token,
    /// Whether it is the comma that starts a continued line: a separator between arguments, and
    /// nothing at all inside an expression.
    pub(crate) continues: bool,
    /// Whether it is the first item of a line of the statement but the first.
    pub(crate) starts_line: bool,
}

impl Item {
    pub(crate) const fn kind(&self) -> TokenKind {
        self.token.kind
    }

    pub(crate) const fn span(&self) -> Span {
        self.token.span()
    }
}

/// Fills `items` with the items of a statement.
///
/// `&` at the end of a line is left out. So is the comma that starts a continued line where the
/// line before ends in `,` or `=`: both commas are one separator.
pub(crate) fn items(tokens: &[Token], statement: &StatementTokens, items: &mut Vec<Item>) {
    items.clear();
    let mut new_line = false;
    for token in &tokens[statement.tokens.clone()] {
        match token.kind {
            TokenKind::Newline => {
                new_line = true;
                if items
                    .last()
                    .is_some_and(|item| item.kind() == TokenKind::Ampersand)
                {
                    items.pop();
                }
                continue;
            }
            _ if token.is_trivia() => continue,
            _ => {}
        }
        let starts_line = new_line;
        let continues = starts_line && token.kind == TokenKind::Comma;
        new_line = false;
        let before = items.last().map(|item: &Item| item.kind());
        if continues && matches!(before, Some(TokenKind::Comma | TokenKind::Equals)) {
            continue;
        }
        items.push(Item {
            token: *token,
            continues,
            starts_line,
        });
    }
}

/// The text of items on one line: blanks as one blank, comments and marks left out.
pub(crate) fn join<'a>(source: &Source, items: impl IntoIterator<Item = &'a Item>) -> String {
    let mut text = String::new();
    // Items that stand next to one another are copied in one go.
    let mut run: Option<Span> = None;
    for item in items {
        let span = item.span();
        match &mut run {
            Some(run) if run.end == span.start => run.end = span.end,
            _ => {
                if let Some(before) = run.replace(span) {
                    text.push_str(source.slice(before));
                    text.push(' ');
                }
            }
        }
    }
    text.push_str(run.map_or("", |run| source.slice(run)));
    text
}
