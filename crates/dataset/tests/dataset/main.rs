//! The dataset crate as its users see it.

#![allow(clippy::print_stdout, reason = "tests print the figures they measure")]

mod cases;
mod changes;
mod corpus;
mod edit;
mod forces;
mod format;
mod hostile;
mod json;
mod language;
mod lints;
mod misuse;
mod mutations;
mod shared;
mod splines;
mod writers;
