//! The language of Adams Solver datasets (`.adm`) and command files (`.acf`).
//!
//! ```text
//! bytes -> Source -> tokens with spans -> statements -> typed Dataset or CommandFile
//! ```
//!
//! Everything wrong in a file is reported in one go as [`Diagnostic`]s with a place in the file.
//! No mechanics is in this crate.

mod arguments;
mod change;
mod checks;
mod commands;
mod diagnostic;
mod expression;
mod keywords;
mod model;
mod names;
mod reader;
mod reading;
mod source;
mod statements;
mod syntax;

pub use change::parse_change;
pub use commands::read_commands;
pub use diagnostic::{Code, Diagnostic, Severity};
pub use expression::{
    ArgumentKind, BinaryOperator, DEEPEST, ElementKind, Expr, Expression, Function,
    arguments_as_ids,
};
pub use model::*;
pub use reader::read_dataset;
pub use source::{LONGEST_SOURCE, Source, Span};
pub use syntax::{Language, StatementTokens, SyntaxTree, Token, TokenKind};
