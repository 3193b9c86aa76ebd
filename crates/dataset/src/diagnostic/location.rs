//! Where a message is, and its text.

use super::Diagnostic;
use crate::source::{Source, Span};
use serde::{Deserialize, Serialize};
use std::fmt::Write;

/// A place in a text as people count.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
pub struct Place {
    /// Line, counted from 1.
    pub line: usize,
    /// Column in characters, counted from 1.
    pub column: usize,
}

/// Where a [`Diagnostic`] is in its source: what is needed to show it without the source.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub struct Location {
    /// The first character.
    pub start: Place,
    /// Behind the last character.
    pub end: Place,
    /// Where its replacement goes, first character and behind the last.
    pub replacement: Option<[Place; 2]>,
    /// The line of the source, cut to a window where it is long, and carets under the place; none
    /// where the message is about the file as a whole.
    excerpt: Option<(String, String)>,
}

impl Diagnostic {
    /// Where the message is in its source.
    #[must_use]
    pub fn locate(&self, source: &Source) -> Location {
        let place = |offset| {
            let (line, column) = source.line_column(offset);
            Place { line, column }
        };
        let ends = |span: Span| [place(span.start), place(span.end)];
        let [start, end] = ends(self.span);
        Location {
            start,
            end,
            replacement: self.replacement.as_ref().map(|new| ends(new.span)),
            excerpt: self.excerpt(source),
        }
    }

    /// The message with its place, the line of the source and a mark under the place.
    ///
    /// ```
    /// use dataset::{read_dataset, Source};
    /// let source = Source::from_text("m.adm", "title\nPART/1, GROUND\nPRAT/2\n".to_string());
    /// let (_, diagnostics) = read_dataset(&source);
    /// let text = diagnostics[0].render(&source);
    /// assert!(text.starts_with("m.adm:3:1: error[unknown-statement]: "));
    /// assert_eq!(diagnostics[0].replacement.as_ref().unwrap().text, "PART");
    /// ```
    #[must_use]
    pub fn render(&self, source: &Source) -> String {
        self.render_at(&self.locate(source))
    }

    /// [`Diagnostic::render`] at a location that is known already.
    #[must_use]
    pub fn render_at(&self, location: &Location) -> String {
        let Place { line, column } = location.start;
        let severity = self.severity.as_str();
        let code = self.code.as_str();
        let gutter = line.to_string();
        let margin = " ".repeat(gutter.len());
        let mut out = format!(
            "{}:{line}:{column}: {severity}[{code}]: {}\n",
            self.source, self.message
        );
        // Writing to a String cannot fail.
        if let Some((text, mark)) = &location.excerpt {
            let _ = writeln!(out, " {gutter} | {text}\n {margin} | {mark}");
        }
        for note in &self.notes {
            let _ = writeln!(out, " {margin} = note: {note}");
        }
        if let Some(help) = &self.help {
            let _ = writeln!(out, " {margin} = help: {help}");
        }
        out
    }

    fn excerpt(&self, source: &Source) -> Option<(String, String)> {
        const WINDOW: usize = 120;
        const BEFORE: usize = 80;
        // Messages about a file as a whole mark nothing in it.
        if self.span == Span::default() {
            return None;
        }
        let (line, start) = source.line_text(self.span.start);
        let from = line.len().min(self.span.start.saturating_sub(start));
        let to = line
            .len()
            .min(self.span.end.saturating_sub(start))
            .max(from);
        let left = line.floor_char_boundary(from.saturating_sub(BEFORE));
        let right = line.floor_char_boundary(line.len().min(from + WINDOW));
        let text = line.get(left..right)?;
        if text.trim().is_empty() {
            return None;
        }
        let marked = line.get(from..to.min(right)).unwrap_or("").chars().count();
        let before = line.get(left..from).unwrap_or("").chars();
        let blank: String = before.map(|c| if c == '\t' { '\t' } else { ' ' }).collect();
        // A control character would move what follows it away from the marks.
        let visible = |c: char| match c.is_control() && c != '\t' {
            true => char::REPLACEMENT_CHARACTER,
            false => c,
        };
        Some((
            text.chars().map(visible).collect(),
            format!("{blank}{}", "^".repeat(marked.max(1))),
        ))
    }
}
