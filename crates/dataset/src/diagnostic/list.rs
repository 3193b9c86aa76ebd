//! The messages about one source while it is read.

use std::collections::HashMap;
use std::collections::hash_map::Entry;

use super::{Code, Diagnostic, Severity};
use crate::source::{Source, Span};

/// The messages about one source, up to a limit.
pub(crate) struct Diagnostics<'a> {
    pub(crate) source: &'a Source,
    list: Vec<Diagnostic>,
    /// The last message over the limit.
    overflow: Option<Box<Diagnostic>>,
    dropped: usize,
    dropped_errors: usize,
}

/// More messages than this help nobody and would fill the memory.
const MOST: usize = 10_000;

impl<'a> Diagnostics<'a> {
    pub(crate) fn new(source: &'a Source) -> Self {
        Self {
            source,
            list: Vec::new(),
            overflow: None,
            dropped: 0,
            dropped_errors: 0,
        }
    }

    /// Whether an error is among the messages so far.
    pub(crate) fn has_error(&self) -> bool {
        let mut severities = self.list.iter().map(|diagnostic| diagnostic.severity);
        self.dropped_errors > 0 || severities.any(|severity| severity == Severity::Error)
    }

    /// Whether the last message has this code.
    pub(crate) fn ends_with(&self, code: Code) -> bool {
        self.list.last().is_some_and(|last| last.code == code)
    }

    pub(crate) fn error(
        &mut self,
        code: Code,
        span: Span,
        message: impl Into<String>,
    ) -> &mut Diagnostic {
        self.add(Severity::Error, code, span, message.into())
    }

    pub(crate) fn warning(
        &mut self,
        code: Code,
        span: Span,
        message: impl Into<String>,
    ) -> &mut Diagnostic {
        self.add(Severity::Warning, code, span, message.into())
    }

    pub(crate) fn note(
        &mut self,
        code: Code,
        span: Span,
        message: impl Into<String>,
    ) -> &mut Diagnostic {
        self.add(Severity::Note, code, span, message.into())
    }

    fn add(
        &mut self,
        severity: Severity,
        code: Code,
        span: Span,
        message: String,
    ) -> &mut Diagnostic {
        let diagnostic = Diagnostic::new(severity, code, self.source.name(), span, message);
        if self.list.len() < MOST {
            self.list.push(diagnostic);
            let last = self.list.len() - 1;
            return &mut self.list[last];
        }
        self.dropped += 1;
        self.dropped_errors += usize::from(severity == Severity::Error);
        self.overflow.insert(Box::new(diagnostic))
    }

    /// Whether further messages are only counted, so that nobody needs to know what was meant.
    pub(crate) fn is_full(&self) -> bool {
        self.list.len() >= MOST
    }

    /// Tells what is refused in many places once, at the first of them.
    fn gather_refusals(&mut self) {
        let mut firsts: HashMap<String, usize> = HashMap::new();
        let mut others: Vec<(usize, Vec<String>)> = Vec::new();
        let mut kept: Vec<Diagnostic> = Vec::with_capacity(self.list.len());
        for diagnostic in std::mem::take(&mut self.list) {
            let refused = matches!(
                diagnostic.code,
                Code::UnsupportedStatement | Code::UnsupportedArgument | Code::UnsupportedFunction
            );
            if !refused {
                kept.push(diagnostic);
                continue;
            }
            let (name, reason) = self.subject(&diagnostic);
            match firsts.entry(reason) {
                Entry::Occupied(first) => others[*first.get()].1.push(name),
                Entry::Vacant(first) => {
                    first.insert(others.len());
                    others.push((kept.len(), Vec::new()));
                    kept.push(diagnostic);
                }
            }
        }
        for (place, names) in others {
            kept[place].holds_for(&names);
        }
        self.list = kept;
    }

    /// What a refusal is about, and what is the same in all of its kind: `BEAM/2` and `BEAM: ...`
    /// where the message begins with the element, else the statement or line, and the message.
    fn subject(&self, diagnostic: &Diagnostic) -> (String, String) {
        let message = &diagnostic.message;
        if let Some((element, reason)) = message.split_once(": ")
            && let Some((statement, id)) = element.split_once('/')
            && id.bytes().all(|byte| byte.is_ascii_digit())
        {
            return (element.to_owned(), format!("{statement}: {reason}"));
        }
        let name = match diagnostic.code {
            Code::UnsupportedStatement => self.source.excerpt(diagnostic.span).to_string(),
            _ => {
                let (line, _) = self.source.line_column(diagnostic.span.start);
                format!("line {line}")
            }
        };
        (name, message.clone())
    }

    /// The messages in the order of their places. The last one tells how many are not shown.
    pub(crate) fn finish(mut self) -> Vec<Diagnostic> {
        self.list.sort_by_key(|diagnostic| diagnostic.span.start);
        self.gather_refusals();
        if let Some(mut last) = self.overflow {
            last.code = Code::TooMany;
            last.severity = match self.dropped_errors {
                0 => Severity::Warning,
                _ => Severity::Error,
            };
            last.message = format!(
                "{} more messages are not shown, {} of them errors",
                self.dropped, self.dropped_errors
            );
            last.notes.clear();
            last.help = None;
            last.replacement = None;
            self.list.push(*last);
        }
        self.list
    }
}
