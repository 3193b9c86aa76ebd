//! Tests of the facade: datasets in, results out.

mod adams;
mod lowering;
mod shared;
