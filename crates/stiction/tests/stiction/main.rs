//! The facade and with it the whole program: datasets in, results out, against results of real Adams
//! runs and independent references.
#![allow(
    clippy::print_stdout,
    reason = "the figures of the comparisons are what these tests show"
)]

mod accuracy;
mod adams;
mod applied_forces;
mod bristles;
mod commands;
mod corpus;
mod couplers;
mod curves;
mod damage;
mod delta_robot;
mod diagnostics;
mod differential;
mod energy;
mod examples;
mod explain;
mod failing;
mod functions;
mod instants;
mod integrators;
mod invariance;
mod jams;
mod jumps;
mod linear_systems;
mod lowering;
mod machines;
mod requests;
mod resuming;
mod run_time;
mod runs;
mod saving;
mod shared;
mod statics;
mod switches;
mod table;
mod unknowns;
