//! The language of Adams Solver datasets (`.adm`) and command files (`.acf`).
//!
//! ```text
//! bytes -> Source -> tokens with spans -> statements -> typed Dataset or CommandFile
//! ```
//!
//! Everything wrong in a file is reported in one go as [`Diagnostic`]s with a place in the file.
//! No mechanics is in this crate.

mod diagnostic;
mod expression;
mod model;
mod source;

pub use diagnostic::{Code, Diagnostic, Severity};
pub use expression::{
    ArgumentKind, BinaryOperator, DEEPEST, ElementKind, Expr, Expression, Function,
    arguments_as_ids,
};
pub use model::*;
pub use source::{LONGEST_SOURCE, Source, Span};

/// Reads a dataset.
#[must_use]
pub fn read_dataset(_source: &Source) -> (Dataset, Vec<Diagnostic>) {
    (Dataset::default(), Vec::new())
}

/// Reads a command file.
#[must_use]
pub fn read_commands(_source: &Source) -> (CommandFile, Vec<Diagnostic>) {
    (CommandFile::default(), Vec::new())
}

/// Reads one change of the model, such as `FRICTION/103, MU_STATIC=0.2`.
#[must_use]
pub fn parse_change(_source: &Source) -> (Option<Change>, Vec<Diagnostic>) {
    (None, Vec::new())
}

impl Dataset {
    /// Makes a change.
    pub fn apply(&mut self, _change: &Change) -> Vec<Diagnostic> {
        Vec::new()
    }
}
