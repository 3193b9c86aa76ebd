//! The language of Adams Solver datasets (`.adm`) and command files (`.acf`).
//!
//! ```text
//! bytes -> Source -> tokens with spans -> statements -> typed Dataset or CommandFile
//! ```
//!
//! Everything wrong in a file is reported in one go as [`Diagnostic`]s with a place in the file.
//! Nothing is ignored in silence: what is not simulated is an error, or a warning where it cannot
//! change the motion. No mechanics is in this crate.
//!
//! Where to add what:
//!
//! | what | where |
//! |---|---|
//! | a statement | its row in `statements/table.rs`, its reader beside the others, its struct in `model` |
//! | an argument | its row in the `KEYWORDS` of the statement |
//! | a run-time function | its row in `expression/function.rs` |
//! | a command | its row in `commands/mod.rs` |
//! | a rule of the whole model | `checks` |
//! | a suspicion about a model that keeps the rules | `lints` |
//! | a malformed file and its message | `tests/cases` |

mod activity;
mod amendment;
mod arguments;
mod change;
mod checks;
mod commands;
mod diagnostic;
mod document;
mod edit;
mod expression;
mod format;
mod grammar;
mod json;
mod keywords;
mod lints;
mod model;
mod names;
mod parts;
mod reader;
mod reading;
mod source;
mod statements;
mod syntax;

pub use change::parse_change;
pub use commands::read_commands;
pub use diagnostic::{Code, Diagnostic, Location, Place, Replacement, Severity};
pub use edit::edit;
pub use expression::{
    ArgumentKind, BinaryOperator, DEEPEST, ElementKind, Expr, Expression, Function,
};
pub use format::format;
pub use json::{from_json, json_schema, to_json};
pub use model::*;
pub use names::nearest as nearest_name;
pub use reader::{lint_dataset, read_dataset};
pub use source::{LONGEST_SOURCE, Source, Span};
pub use syntax::{Language, StatementTokens, SyntaxTree, Token, TokenKind};
