//! Text to tokens. Nothing is lost: the tokens, trivia included, cover the text without gaps.

use crate::source::Span;

/// The type of a [`Token`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum TokenKind {
    /// A whole line taken as it is: the title of a dataset, or model and output name at the top
    /// of an old command file.
    Line,
    /// Blanks and tabs.
    Whitespace,
    /// The end of a line.
    Newline,
    /// From `!` to the end of the line.
    Comment,
    /// Letters, digits and underscores, a letter or underscore first.
    Word,
    /// An unsigned number as far as letters and digits go, so that `3DBEAM` is one (malformed)
    /// number; `D` at the end means degrees.
    Number,
    /// Text in double quotes on one line.
    String,
    /// `,`
    Comma,
    /// `/`
    Slash,
    /// `=`
    Equals,
    /// `(`
    LeftParenthesis,
    /// `)`
    RightParenthesis,
    /// `:`
    Colon,
    /// `;`
    Semicolon,
    /// `\`
    Backslash,
    /// `&`, which continues a statement where it ends a line.
    Ampersand,
    /// `+`
    Plus,
    /// `-`
    Minus,
    /// `*`
    Star,
    /// `**`
    Power,
    /// Any other character.
    Other,
}

/// A piece of the text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Token {
    /// Its type.
    pub kind: TokenKind,
    // 32 bits each: a source is shorter than 4 GB, and large files have many tokens.
    start: u32,
    end: u32,
}

impl Token {
    /// Its place.
    #[must_use]
    pub const fn span(self) -> Span {
        Span {
            start: self.start as usize,
            end: self.end as usize,
        }
    }

    /// Whether it is blank or a comment.
    #[must_use]
    pub const fn is_trivia(self) -> bool {
        matches!(
            self.kind,
            TokenKind::Whitespace | TokenKind::Newline | TokenKind::Comment
        )
    }
}

/// Which rules hold at the top of a text.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Language {
    /// `.adm`: the first line is the title.
    Dataset,
    /// `.acf`: the first two lines may name the model and the output.
    Commands,
    /// Statements only.
    Statements,
}

/// Splits a text into tokens.
pub(super) struct Lexer<'a> {
    bytes: &'a [u8],
    at: usize,
    /// The tokens so far.
    pub(super) tokens: Vec<Token>,
}

impl<'a> Lexer<'a> {
    /// Starts at the top of a text, with the tokens of the lines that are taken as they are.
    pub(super) fn new(text: &'a str, language: Language) -> Self {
        let mut lexer = Self {
            bytes: text.as_bytes(),
            at: 0,
            tokens: Vec::new(),
        };
        match language {
            Language::Dataset => lexer.line(),
            Language::Commands => {
                for _ in 0..2 {
                    if lexer.at_plain_line() {
                        lexer.line();
                        lexer.advance();
                    } else {
                        break;
                    }
                }
            }
            Language::Statements => {}
        }
        lexer
    }

    fn peek(&self, ahead: usize) -> u8 {
        self.bytes.get(self.at + ahead).copied().unwrap_or(0)
    }

    fn push(&mut self, kind: TokenKind, end: usize) {
        // A source is shorter than 4 GB, so offsets fit in 32 bits.
        self.tokens.push(Token {
            kind,
            start: self.at as u32,
            end: end as u32,
        });
        self.at = end;
    }

    /// The end of the run of bytes from `start` on that satisfy `belongs`.
    fn run(&self, start: usize, belongs: impl Fn(u8) -> bool) -> usize {
        let mut end = start;
        while self.bytes.get(end).is_some_and(|byte| belongs(*byte)) {
            end += 1;
        }
        end
    }

    fn line_end(&self) -> usize {
        let rest = &self.bytes[self.at..];
        let end = self.at + memchr::memchr(b'\n', rest).unwrap_or(rest.len());
        let carriage_returns = self.bytes[self.at..end]
            .iter()
            .rev()
            .take_while(|byte| **byte == b'\r')
            .count();
        end - carriage_returns
    }

    fn line(&mut self) {
        let end = self.line_end();
        if end > self.at {
            self.push(TokenKind::Line, end);
        }
    }

    /// Whether the line is neither blank nor a comment nor a command.
    fn at_plain_line(&self) -> bool {
        let line = self.bytes[self.at..self.line_end()].trim_ascii();
        let is_stop = line.eq_ignore_ascii_case(b"stop");
        !(line.is_empty() || line[0] == b'!' || line.contains(&b'/') || is_stop)
    }

    /// Adds the tokens up to the end of the line, the line end too; returns whether there are any.
    pub(super) fn advance(&mut self) -> bool {
        let before = self.at;
        while let Some(first) = self.bytes.get(self.at) {
            self.next(*first);
            if self.tokens.last().map(|token| token.kind) == Some(TokenKind::Newline) {
                break;
            }
        }
        self.at > before
    }

    /// Adds the token that starts with the byte `first`.
    fn next(&mut self, first: u8) {
        let one = self.at + 1;
        match first {
            byte if is_blank(byte) => self.push(TokenKind::Whitespace, self.run(one, is_blank)),
            b'\n' => self.push(TokenKind::Newline, one),
            b'\r' => {
                let end = self.run(one, |byte| byte == b'\r');
                match self.bytes.get(end) {
                    Some(b'\n') => self.push(TokenKind::Newline, end + 1),
                    _ => self.push(TokenKind::Whitespace, end),
                }
            }
            b'!' => self.push(TokenKind::Comment, self.line_end().max(one)),
            b'"' => {
                let end = self.run(one, |byte| !matches!(byte, b'"' | b'\n' | b'\r'));
                match self.bytes.get(end) {
                    Some(b'"') => self.push(TokenKind::String, end + 1),
                    _ => self.push(TokenKind::Other, one),
                }
            }
            b',' => self.push(TokenKind::Comma, one),
            b'/' => self.push(TokenKind::Slash, one),
            b'=' => self.push(TokenKind::Equals, one),
            b'(' => self.push(TokenKind::LeftParenthesis, one),
            b')' => self.push(TokenKind::RightParenthesis, one),
            b':' => self.push(TokenKind::Colon, one),
            b';' => self.push(TokenKind::Semicolon, one),
            b'\\' => self.push(TokenKind::Backslash, one),
            b'&' => self.push(TokenKind::Ampersand, one),
            b'+' => self.push(TokenKind::Plus, one),
            b'-' => self.push(TokenKind::Minus, one),
            b'*' if self.peek(1) == b'*' => self.push(TokenKind::Power, one + 1),
            b'*' => self.push(TokenKind::Star, one),
            b'0'..=b'9' => self.number(),
            b'.' if self.peek(1).is_ascii_digit() => self.number(),
            byte if is_word(byte) => self.push(TokenKind::Word, self.run(one, is_word)),
            _ => self.push(TokenKind::Other, one),
        }
    }

    fn number(&mut self) {
        let is_digit = |byte: u8| byte.is_ascii_digit();
        let mut end = self.run(self.at, is_digit);
        if self.bytes.get(end) == Some(&b'.') {
            end = self.run(end + 1, is_digit);
        }
        if matches!(self.bytes.get(end), Some(b'e' | b'E')) {
            let signed = matches!(self.bytes.get(end + 1), Some(b'+' | b'-'));
            let digits = end + 1 + usize::from(signed);
            let exponent_end = self.run(digits, is_digit);
            if exponent_end > digits {
                end = exponent_end;
            }
        }
        self.push(TokenKind::Number, self.run(end, is_word));
    }
}

/// Whether a byte is a blank or tab, a form feed, or the byte 26 with which old systems end a text.
const fn is_blank(byte: u8) -> bool {
    matches!(byte, b' ' | b'\t' | 11 | 12 | 26)
}

/// Whether a byte can stand in a word.
const fn is_word(byte: u8) -> bool {
    WORD[byte as usize]
}

/// The bytes of words. Those above 127 count as letters, so that no character is split.
const WORD: [bool; 256] = {
    let mut word = [false; 256];
    let mut byte = 0;
    while byte < 256 {
        word[byte] = byte >= 128 || (byte as u8).is_ascii_alphanumeric() || byte as u8 == b'_';
        byte += 1;
    }
    word
};

/// A number with an exponent after `D`, as FORTRAN writes it, with `E` instead.
pub(crate) fn with_exponent(text: &str) -> Option<String> {
    let (mantissa, exponent) = text.split_once(['d', 'D'])?;
    let digits = exponent.strip_prefix(['+', '-']).unwrap_or(exponent);
    let whole = !digits.is_empty() && digits.bytes().all(|byte| byte.is_ascii_digit());
    let right = whole && mantissa.parse::<f64>().is_ok();
    right.then(|| format!("{mantissa}E{exponent}"))
}

/// The value of a number token, with `D` at its end in radians; `None` where it is malformed.
///
/// The value may be infinite.
pub(crate) fn number_value(text: &str) -> Option<f64> {
    let plain = text.strip_suffix(['d', 'D']);
    let value: f64 = plain.unwrap_or(text).parse().ok()?;
    Some(match plain {
        Some(_) => value.to_radians(),
        None => value,
    })
}
