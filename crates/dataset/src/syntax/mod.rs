//! The faithful tree of a text: tokens, and statements as ranges of tokens.

mod items;
mod token;

pub(crate) use items::{Item, items, join};
pub use token::{Language, Token, TokenKind};
pub(crate) use token::{number_value, with_exponent};

use crate::source::{Source, Span};
use std::ops::Range;

/// One statement of a [`SyntaxTree`].
#[derive(Clone, Debug, PartialEq, Eq)]
pub struct StatementTokens {
    /// From the first to the last token that is neither blank nor comment.
    pub tokens: Range<usize>,
    /// The last `adams_view_name='...'` comment between the statement before and this one.
    pub name_comment: Option<usize>,
}

/// The tokens of a text and how they make statements.
///
/// ```
/// use dataset::{Language, Source, SyntaxTree};
/// let source = Source::from_text("m.adm", "title\nPART/1 ! the frame\n, GROUND\nEND".to_string());
/// let tree = SyntaxTree::new(&source, Language::Dataset);
/// assert_eq!(source.slice(tree.span(&tree.statements[0])), "PART/1 ! the frame\n, GROUND");
/// let text: String = tree.tokens.iter().map(|token| source.slice(token.span())).collect();
/// assert_eq!(text, source.text());
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct SyntaxTree {
    /// Every token; their texts joined give the text back.
    pub tokens: Vec<Token>,
    /// The statements in order, END excluded; what follows END is in none.
    pub statements: Vec<StatementTokens>,
    /// The token END of a dataset.
    pub end: Option<usize>,
}

impl SyntaxTree {
    /// The tree of a text; it cannot fail.
    #[must_use]
    pub fn new(source: &Source, language: Language) -> Self {
        let tokens = token::tokens(source, language);
        let (statements, end) = statements(source, &tokens, language);
        Self {
            tokens,
            statements,
            end,
        }
    }

    /// The place of a statement, from its name to its last argument.
    #[must_use]
    pub fn span(&self, statement: &StatementTokens) -> Span {
        let tokens = &self.tokens[statement.tokens.clone()];
        match (tokens.first(), tokens.last()) {
            (Some(first), Some(last)) => first.span().to(last.span()),
            _ => Span::default(),
        }
    }
}

/// What a comment holds that names the statement behind it.
const NAMES: &str = "adams_view_name";

/// A statement ends at `;`, or at the end of a line unless that line ends in `&` or `,` or the
/// next line that is neither blank nor comment starts with `,`.
///
/// Gives the statements and the position of END.
fn statements(
    source: &Source,
    tokens: &[Token],
    language: Language,
) -> (Vec<StatementTokens>, Option<usize>) {
    let finder = memchr::memmem::Finder::new(NAMES);
    let mut statements = Vec::new();
    let mut name_comment = None;
    let mut current: Option<StatementTokens> = None;
    let mut line_ended = false;
    let mut last_kind = TokenKind::Newline;
    for (index, token) in tokens.iter().enumerate() {
        match token.kind {
            TokenKind::Line | TokenKind::Whitespace => continue,
            TokenKind::Comment => {
                let comment = source.slice(token.span()).as_bytes();
                if comment.len() > NAMES.len() && finder.find(comment).is_some() {
                    name_comment = Some(index);
                }
                continue;
            }
            TokenKind::Newline => {
                line_ended |= !matches!(last_kind, TokenKind::Ampersand | TokenKind::Comma);
                continue;
            }
            TokenKind::Semicolon => {
                statements.extend(current.take());
                line_ended = false;
                last_kind = token.kind;
                continue;
            }
            _ => {}
        }
        if line_ended && token.kind != TokenKind::Comma {
            statements.extend(current.take());
        }
        line_ended = false;
        last_kind = token.kind;
        if current.is_none() && token.kind == TokenKind::Ampersand && ends_line(tokens, index) {
            // It continues nothing.
            continue;
        }
        match &mut current {
            Some(statement) => statement.tokens.end = index + 1,
            None => {
                let is_end = source.slice(token.span()).eq_ignore_ascii_case("END");
                if language == Language::Dataset && is_end {
                    return (statements, Some(index));
                }
                current = Some(StatementTokens {
                    tokens: index..index + 1,
                    name_comment: name_comment.take(),
                });
            }
        }
    }
    statements.extend(current);
    (statements, None)
}

/// Whether nothing but a comment follows a token on its line.
fn ends_line(tokens: &[Token], index: usize) -> bool {
    let behind = &tokens[index + 1..];
    let next = behind
        .iter()
        .find(|token| !matches!(token.kind, TokenKind::Whitespace | TokenKind::Comment));
    next.is_none_or(|token| token.kind == TokenKind::Newline)
}
