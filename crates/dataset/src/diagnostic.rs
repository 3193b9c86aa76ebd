//! Messages about a source text, as data that every front end renders in its own way.

use crate::source::{Source, Span};
use std::fmt::Write;

/// How serious a [`Diagnostic`] is.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Severity {
    /// The model cannot be used.
    Error,
    /// The model can be used, but the reader should know.
    Warning,
    /// A remark.
    Note,
}

impl Severity {
    /// `error`, `warning` or `note`.
    #[must_use]
    pub const fn as_str(self) -> &'static str {
        match self {
            Self::Error => "error",
            Self::Warning => "warning",
            Self::Note => "note",
        }
    }
}

macro_rules! codes {
    ($($(#[$documentation:meta])* $variant:ident = $text:literal,)*) => {
        /// What a [`Diagnostic`] is about; its text is stable and fit for filters.
        #[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
        pub enum Code { $($(#[$documentation])* $variant,)* }

        impl Code {
            /// The stable text of this code, for example `unknown-statement`.
            #[must_use]
            pub const fn as_str(self) -> &'static str {
                match self { $(Self::$variant => $text,)* }
            }
        }
    };
}

codes! {
    /// The file is binary.
    NotText = "not-text",
    /// The file is too large to be read.
    TooLarge = "too-large",
    /// The file holds no statement.
    Empty = "empty",
    /// The text breaks the rules of the language.
    Syntax = "syntax",
    /// More messages than are shown.
    TooMany = "too-many",
    /// The title line looks like a statement.
    TitleIsStatement = "title-is-statement",
    /// No statement or command has this name.
    UnknownStatement = "unknown-statement",
    /// A statement or command of the language that is not simulated.
    UnsupportedStatement = "unsupported-statement",
    /// The statement has no argument of this name.
    UnknownArgument = "unknown-argument",
    /// An abbreviation that fits several names.
    AmbiguousName = "ambiguous-name",
    /// An argument of the language that is not simulated.
    UnsupportedArgument = "unsupported-argument",
    /// A function of the language that is not simulated, or not in this place.
    UnsupportedFunction = "unsupported-function",
    /// The initial conditions cannot be met.
    Assembly = "assembly",
    /// No equilibrium is found.
    Equilibrium = "equilibrium",
    /// The integration cannot go on.
    Integration = "integration",
    /// An argument or statement without effect here, which cannot change the motion.
    Ignored = "ignored",
    /// An argument is given twice.
    DuplicateArgument = "duplicate-argument",
    /// A required argument is missing.
    MissingArgument = "missing-argument",
    /// Arguments that exclude each other.
    ConflictingArguments = "conflicting-arguments",
    /// A value of the wrong type or number.
    InvalidValue = "invalid-value",
    /// A value outside its range.
    OutOfRange = "out-of-range",
    /// An identifier is missing or malformed.
    InvalidId = "invalid-id",
    /// An identifier is used twice.
    DuplicateId = "duplicate-id",
    /// A statement that may occur once occurs again.
    DuplicateStatement = "duplicate-statement",
    /// A reference to an element that does not exist.
    MissingElement = "missing-element",
    /// No part, or more than one, is the ground.
    Ground = "ground",
    /// Mass or inertia that no body can have.
    ImpossibleInertia = "impossible-inertia",
    /// An orientation given by points that define no axes.
    DegenerateOrientation = "degenerate-orientation",
    /// A joint or force whose ends cannot be joined this way.
    InvalidConnection = "invalid-connection",
    /// A motion on a freedom that the joint does not have.
    NoSuchFreedom = "no-such-freedom",
    /// An expression that cannot be understood.
    Expression = "expression",
    /// No run-time function has this name.
    UnknownFunction = "unknown-function",
    /// A function with too few or too many arguments.
    ArgumentCount = "argument-count",
    /// Variables that define each other in a circle.
    CircularVariables = "circular-variables",
    /// FRICTION on a joint without friction or with the wrong yoke.
    FrictionJoint = "friction-joint",
    /// A friction argument that this joint or formulation does not use.
    UnusedArgument = "unused-argument",
    /// The coefficient of static friction is below that of dynamic friction.
    StaticBelowDynamic = "static-below-dynamic",
    /// A default with a length in it, in a model that is not in millimetres.
    DimensionalDefault = "dimensional-default",
    /// An element that rests because its joint is deactivated.
    Deactivated = "deactivated",
    /// A change of an element that a command cannot make.
    InvalidChange = "invalid-change",
}

/// One message about one place of a source text.
#[derive(Clone, Debug, PartialEq)]
pub struct Diagnostic {
    /// What the message is about.
    pub code: Code,
    /// How serious it is.
    pub severity: Severity,
    /// The message, one line.
    pub message: String,
    /// The name of the file.
    pub source: String,
    /// The place in the file.
    pub span: Span,
    /// Further facts, one line each.
    pub notes: Vec<String>,
    /// How to put it right, one line.
    pub help: Option<String>,
}

impl Diagnostic {
    /// The message with its place, the line of the source and a mark under the place.
    ///
    /// ```
    /// use dataset::{read_dataset, Source};
    /// let source = Source::from_text("m.adm", "title\nPART/1, GROUND\nPRAT/2\n".to_string());
    /// let (_, diagnostics) = read_dataset(&source);
    /// assert!(diagnostics[0].render(&source).starts_with("m.adm:3:1: error[unknown-statement]: "));
    /// ```
    #[must_use]
    pub fn render(&self, source: &Source) -> String {
        let (line, column) = source.line_column(self.span.start);
        let severity = self.severity.as_str();
        let code = self.code.as_str();
        let gutter = line.to_string();
        let margin = " ".repeat(gutter.len());
        let mut out = format!(
            "{}:{line}:{column}: {severity}[{code}]: {}\n",
            self.source, self.message
        );
        // Writing to a String cannot fail.
        if let Some((text, mark)) = self.excerpt(source) {
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

    /// The line of the source, cut to a window where it is long, and carets under the place.
    fn excerpt(&self, source: &Source) -> Option<(String, String)> {
        const WINDOW: usize = 120;
        const BEFORE: usize = 80;
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
        Some((
            text.to_string(),
            format!("{blank}{}", "^".repeat(marked.max(1))),
        ))
    }

    pub(crate) fn help(&mut self, help: impl Into<String>) -> &mut Self {
        self.help = Some(help.into());
        self
    }

    pub(crate) fn note(&mut self, note: impl Into<String>) -> &mut Self {
        self.notes.push(note.into());
        self
    }
}

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

    fn add(
        &mut self,
        severity: Severity,
        code: Code,
        span: Span,
        message: String,
    ) -> &mut Diagnostic {
        let diagnostic = Diagnostic {
            code,
            severity,
            message,
            source: self.source.name().to_string(),
            span,
            notes: Vec::new(),
            help: None,
        };
        if self.list.len() < MOST {
            self.list.push(diagnostic);
            let last = self.list.len() - 1;
            return &mut self.list[last];
        }
        self.dropped += 1;
        self.dropped_errors += usize::from(severity == Severity::Error);
        self.overflow.insert(Box::new(diagnostic))
    }

    /// The messages in the order of their places. The last one tells how many are not shown.
    pub(crate) fn finish(mut self) -> Vec<Diagnostic> {
        self.list.sort_by_key(|diagnostic| diagnostic.span.start);
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
            self.list.push(*last);
        }
        self.list
    }
}
