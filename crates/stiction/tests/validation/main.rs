//! The whole program against results of real Adams runs and independent references.
#![allow(
    clippy::print_stdout,
    reason = "the figures of the comparisons are what these tests show"
)]

mod corpus;
mod delta_robot;
mod instants;
mod invariance;
mod jumps;
mod machines;
mod run;
mod table;
