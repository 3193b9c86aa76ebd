//! The faithful tree of a text: tokens, and statements as ranges of tokens.

mod grouping;
mod items;
mod token;

pub(crate) use grouping::{Grouping, NAMES};
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

impl StatementTokens {
    /// The place of the statement among the tokens that it was made of.
    pub(crate) fn span(&self, tokens: &[Token]) -> Span {
        let tokens = &tokens[self.tokens.clone()];
        match (tokens.first(), tokens.last()) {
            (Some(first), Some(last)) => first.span().to(last.span()),
            _ => Span::default(),
        }
    }
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
        let mut grouping = Grouping::new(source, language);
        let mut statements = Vec::new();
        while let Some(statement) = grouping.statement() {
            statements.push(statement);
        }
        let end = grouping.end();
        Self {
            tokens: grouping.into_tokens(),
            statements,
            end,
        }
    }

    /// The place of a statement, from its name to its last argument.
    #[must_use]
    pub fn span(&self, statement: &StatementTokens) -> Span {
        statement.span(&self.tokens)
    }
}
