//! The text of a dataset or command file, and places in it.

use crate::diagnostic::{Code, Diagnostic, Severity};
use serde::{Deserialize, Serialize};
use std::sync::Arc;

/// A half-open range of byte offsets into the decoded text of a [`Source`].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Span {
    /// Offset of the first byte.
    pub start: usize,
    /// Offset behind the last byte.
    pub end: usize,
}

impl Span {
    /// The range from `start` to `end`.
    #[must_use]
    pub const fn new(start: usize, end: usize) -> Self {
        Self { start, end }
    }

    /// The smallest range that holds `self` and `other`.
    #[must_use]
    pub fn to(self, other: Self) -> Self {
        Self {
            start: self.start.min(other.start),
            end: self.end.max(other.end),
        }
    }
}

/// A named text with line numbers.
///
/// Bytes that are UTF-8 are read as such. Files of Adams are not: their bytes are read as Latin-1,
/// so that every byte string is a text, and a byte above 127 becomes a character of two bytes.
#[derive(Clone, Debug, PartialEq)]
pub struct Source {
    name: String,
    text: Arc<str>,
    encoding: Encoding,
    line_starts: Vec<u32>,
    /// For every character of more than one byte its offset, once for each further byte.
    wide: Vec<u32>,
}

/// How the characters of a file are kept in bytes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum Encoding {
    Utf8,
    /// UTF-8 with a byte order mark at its start.
    MarkedUtf8,
    Latin1,
}

const BYTE_ORDER_MARK: &[u8] = b"\xEF\xBB\xBF";

/// The longest file that is read, in bytes of decoded text (offsets are kept in 32 bits).
pub const LONGEST_SOURCE: usize = u32::MAX as usize - 1;

impl Source {
    /// Decodes the bytes of the file `name` (the path as it is shown in messages).
    ///
    /// # Errors
    /// `not-text` when more than one byte in twenty is a control character, as in a binary file
    /// (real datasets hold a few NULs in texts); `too-large` above [`LONGEST_SOURCE`].
    pub fn from_bytes(name: &str, bytes: &[u8]) -> Result<Self, Box<Diagnostic>> {
        let refuse = |code, message: String, help: &str| {
            let mut error = Diagnostic::new(Severity::Error, code, name, Span::default(), message);
            error.help(help);
            Err(Box::new(error))
        };
        let is_control = |byte: u8| {
            (byte < 32)
                & (byte != b'\t')
                & (byte != b'\n')
                & (byte != b'\r')
                & (byte != 12)
                & (byte != 26)
        };
        let controls = count(bytes, is_control);
        if controls * 20 > bytes.len() {
            return refuse(
                Code::NotText,
                "this file is not text".to_string(),
                "an Adams dataset (.adm) or command file (.acf) is plain text",
            );
        }
        let decoded = bytes.len() + count(bytes, |byte| byte >= 128);
        if decoded > LONGEST_SOURCE {
            return refuse(
                Code::TooLarge,
                format!("this file has {} bytes", bytes.len()),
                "files of up to 4 GB are read",
            );
        }
        let (bytes, utf8) = match bytes.strip_prefix(BYTE_ORDER_MARK) {
            Some(rest) => (rest, Encoding::MarkedUtf8),
            None => (bytes, Encoding::Utf8),
        };
        let (text, encoding) = match std::str::from_utf8(bytes) {
            Ok(text) => (Arc::from(text), utf8),
            Err(_) => {
                let text: String = bytes.iter().map(|byte| char::from(*byte)).collect();
                (text.into(), Encoding::Latin1)
            }
        };
        Ok(Self::new(name, text, encoding))
    }

    /// A source made of a text that is in memory already, for example one command line.
    ///
    /// ```
    /// let source = dataset::Source::from_text("--set", "FRICTION/103, MU_STATIC=0.2".to_string());
    /// assert_eq!(source.line_column(10), (1, 11));
    /// ```
    #[must_use]
    pub fn from_text(name: &str, text: String) -> Self {
        Self::new(name, text.into(), Encoding::Utf8)
    }

    fn new(name: &str, text: Arc<str>, encoding: Encoding) -> Self {
        // Offsets fit, since a source is not longer than `LONGEST_SOURCE`.
        let newlines = memchr::memchr_iter(b'\n', text.as_bytes());
        let line_starts = std::iter::once(0)
            .chain(newlines.map(|offset| offset as u32 + 1))
            .collect();
        let mut wide = Vec::new();
        if !text.is_ascii() {
            for (offset, character) in text.char_indices() {
                wide.extend((1..character.len_utf8()).map(|_| offset as u32));
            }
        }
        Self {
            name: name.to_string(),
            text,
            encoding,
            line_starts,
            wide,
        }
    }

    /// The bytes for a new file with `text`: Latin-1, as Adams writes it, where that reads back the
    /// same, else UTF-8.
    #[must_use]
    pub fn encode_new(text: &str) -> Vec<u8> {
        match latin1(text) {
            Some(bytes) if std::str::from_utf8(&bytes).is_err() => bytes,
            _ => text.as_bytes().to_vec(),
        }
    }

    /// The bytes of `text` in the encoding of the file that this source was decoded from.
    ///
    /// ```
    /// let source = dataset::Source::from_bytes("m.adm", b"\xB7")?;
    /// assert_eq!(source.text(), "\u{B7}");
    /// assert_eq!(source.encode(source.text()), b"\xB7");
    /// # Ok::<(), Box<dataset::Diagnostic>>(())
    /// ```
    #[must_use]
    pub fn encode(&self, text: &str) -> Vec<u8> {
        match self.encoding {
            Encoding::Utf8 => text.as_bytes().to_vec(),
            Encoding::MarkedUtf8 => [BYTE_ORDER_MARK, text.as_bytes()].concat(),
            // A text with other characters than those of the file is kept as UTF-8.
            Encoding::Latin1 => latin1(text).unwrap_or_else(|| text.as_bytes().to_vec()),
        }
    }

    /// The name of the file as it is shown in messages.
    #[must_use]
    pub fn name(&self) -> &str {
        &self.name
    }

    /// The decoded text.
    #[must_use]
    pub fn text(&self) -> &str {
        &self.text
    }

    /// The decoded text, to be kept for longer than the source.
    pub(crate) fn shared_text(&self) -> Arc<str> {
        Arc::clone(&self.text)
    }

    /// The text of `span`; empty where the span lies outside the text or splits a character.
    #[must_use]
    pub fn slice(&self, span: Span) -> &str {
        self.text.get(span.start..span.end).unwrap_or("")
    }

    /// The text of `span` for a message: on one line and at most 60 characters long, control
    /// characters as `\u{0}`.
    #[must_use]
    pub fn excerpt(&self, span: Span) -> String {
        const LONGEST: usize = 60;
        let text = self.slice(span);
        let line = text.lines().next().unwrap_or("").trim_end();
        let short: String = line.chars().take(LONGEST).collect();
        let dots = if short.len() < text.trim_end().len() {
            "..."
        } else {
            ""
        };
        let visible = |c: char| match c.is_control() && c != '\t' {
            true => c.escape_default().to_string(),
            false => c.to_string(),
        };
        short.chars().map(visible).collect::<String>() + dots
    }

    /// Line and column of a byte offset, both counted from 1, columns in characters.
    #[must_use]
    pub fn line_column(&self, offset: usize) -> (usize, usize) {
        let line = self.line_of(offset);
        let start = self.line_starts[line] as usize;
        let end = offset.min(self.text.len());
        let wide = |end: usize| self.wide.partition_point(|at| (*at as usize) < end);
        (line + 1, end - start - (wide(end) - wide(start)) + 1)
    }

    /// The text of the line that holds `offset`, without its end, and the offset of its start.
    #[must_use]
    pub fn line_text(&self, offset: usize) -> (&str, usize) {
        let line = self.line_of(offset);
        let start = self.line_starts[line] as usize;
        let end = match self.line_starts.get(line + 1) {
            Some(next) => *next as usize - 1,
            None => self.text.len(),
        };
        (self.text[start..end].trim_end_matches('\r'), start)
    }

    /// The byte offset of a line and a column, both counted from 1, the column in bytes.
    pub(crate) fn offset(&self, line: usize, column: usize) -> usize {
        let line = line.clamp(1, self.line_starts.len());
        let start = self.line_starts[line - 1] as usize;
        let end = start.saturating_add(column.saturating_sub(1));
        self.text.floor_char_boundary(end.min(self.text.len()))
    }

    fn line_of(&self, offset: usize) -> usize {
        self.line_starts
            .partition_point(|start| *start as usize <= offset)
            .saturating_sub(1)
    }
}

/// The number of bytes that satisfy a condition; in blocks, so that they are looked at in parallel.
fn count(bytes: &[u8], condition: impl Fn(u8) -> bool) -> usize {
    let in_block = |block: &[u8]| -> usize {
        let count: u8 = block.iter().map(|byte| u8::from(condition(*byte))).sum();
        usize::from(count)
    };
    bytes.chunks(255).map(in_block).sum()
}

/// The bytes of a text in Latin-1; `None` where it has other characters.
fn latin1(text: &str) -> Option<Vec<u8>> {
    text.chars()
        .map(|character| u8::try_from(u32::from(character)).ok())
        .collect()
}
