//! Tests of the facade: datasets in, results out.

mod adams;
mod commands;
mod examples;
mod lowering;
mod shared;
