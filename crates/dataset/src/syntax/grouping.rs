//! Tokens to statements, one statement at a time.

use super::StatementTokens;
use super::token::{Language, Lexer, Token, TokenKind};
use crate::source::Source;

/// What a comment holds that names the statement behind it.
pub(crate) const NAMES: &str = "adams_view_name";

/// Groups the tokens of a text into statements.
///
/// A statement ends at `;`, or at the end of a line unless that line ends in `&` or `,` or the
/// next line that is neither blank nor comment starts with `,`.
pub(crate) struct Grouping<'a> {
    source: &'a Source,
    language: Language,
    lexer: Lexer<'a>,
    names: memchr::memmem::Finder<'static>,
    /// The position of the next token to look at.
    at: usize,
    /// The last comment with a name since the last statement.
    name_comment: Option<usize>,
    current: Option<StatementTokens>,
    line_ended: bool,
    last_kind: TokenKind,
    end: Option<usize>,
}

impl<'a> Grouping<'a> {
    /// Starts at the top of a text.
    pub(crate) fn new(source: &'a Source, language: Language) -> Self {
        Self {
            source,
            language,
            lexer: Lexer::new(source.text(), language),
            names: memchr::memmem::Finder::new(NAMES),
            at: 0,
            name_comment: None,
            current: None,
            line_ended: false,
            last_kind: TokenKind::Newline,
            end: None,
        }
    }

    /// The tokens so far, without those that are forgotten.
    pub(crate) fn tokens(&self) -> &[Token] {
        &self.lexer.tokens
    }

    /// All tokens of the text that are not forgotten.
    pub(super) fn into_tokens(mut self) -> Vec<Token> {
        while self.lexer.advance() {}
        self.lexer.tokens
    }

    /// The position of END, if it has been reached.
    pub(super) const fn end(&self) -> Option<usize> {
        self.end
    }

    /// The token at a position; `None` behind the end of the text.
    fn token(&mut self, at: usize) -> Option<Token> {
        while at >= self.lexer.tokens.len() {
            if !self.lexer.advance() {
                return None;
            }
        }
        Some(self.lexer.tokens[at])
    }

    /// The next statement; `None` at END and at the end of the text.
    pub(crate) fn statement(&mut self) -> Option<StatementTokens> {
        while self.end.is_none() {
            let Some(token) = self.token(self.at) else {
                break;
            };
            let index = self.at;
            self.at += 1;
            match token.kind {
                TokenKind::Line | TokenKind::Whitespace => continue,
                TokenKind::Comment => {
                    let comment = self.source.slice(token.span()).as_bytes();
                    if comment.len() > NAMES.len() && self.names.find(comment).is_some() {
                        self.name_comment = Some(index);
                    }
                    continue;
                }
                TokenKind::Newline => {
                    let goes_on = matches!(self.last_kind, TokenKind::Ampersand | TokenKind::Comma);
                    self.line_ended |= !goes_on;
                    continue;
                }
                _ => {}
            }
            let mut ended = None;
            if token.kind == TokenKind::Semicolon
                || (self.line_ended && token.kind != TokenKind::Comma)
            {
                ended = self.current.take();
            }
            self.line_ended = false;
            self.last_kind = token.kind;
            if token.kind != TokenKind::Semicolon {
                self.take(token, index);
            }
            if ended.is_some() {
                return ended;
            }
        }
        self.current.take()
    }

    /// Takes a token of a statement.
    fn take(&mut self, token: Token, index: usize) {
        if let Some(statement) = &mut self.current {
            statement.tokens.end = index + 1;
            return;
        }
        if token.kind == TokenKind::Ampersand && self.ends_line(index) {
            // It continues nothing.
            return;
        }
        let is_end = || {
            let text = self.source.slice(token.span());
            text.eq_ignore_ascii_case("END")
        };
        if self.language == Language::Dataset && is_end() {
            self.end = Some(index);
            return;
        }
        self.current = Some(StatementTokens {
            tokens: index..index + 1,
            name_comment: self.name_comment.take(),
        });
    }

    /// Whether nothing but a comment follows a token on its line.
    fn ends_line(&mut self, index: usize) -> bool {
        let mut at = index + 1;
        while let Some(token) = self.token(at) {
            if !matches!(token.kind, TokenKind::Whitespace | TokenKind::Comment) {
                return token.kind == TokenKind::Newline;
            }
            at += 1;
        }
        true
    }

    /// Forgets the tokens of the statements so far: what is read by the statement needs little
    /// memory, however long the text is.
    pub(crate) fn forget(&mut self) {
        let comment = match &self.current {
            Some(current) => current.name_comment.or(Some(current.tokens.start)),
            None => self.name_comment,
        };
        // END stays, too: it may have ended the statement before.
        let first = comment.unwrap_or(self.at).min(self.end.unwrap_or(self.at));
        // Moving the rest costs no more than what is forgotten: a long line is read in linear time.
        if 2 * first < self.lexer.tokens.len() {
            return;
        }
        self.lexer.tokens.drain(..first);
        self.at -= first;
        let positions = [&mut self.name_comment, &mut self.end];
        for position in positions.into_iter().flatten() {
            *position -= first;
        }
        if let Some(current) = &mut self.current {
            current.tokens.start -= first;
            current.tokens.end -= first;
            current.name_comment = current.name_comment.map(|at| at - first);
        }
    }
}
