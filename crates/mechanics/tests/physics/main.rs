//! Mechanics against closed forms, published solutions and invariances.
//!
//! `cargo test -p mechanics --test physics -- --nocapture` prints the tables.
#![allow(
    clippy::print_stdout,
    reason = "the tables of errors are what these tests show"
)]

mod convergence;
mod friction_cases;
mod frictionless;
mod instants;
mod integrator_arguments;
mod invariance;
mod least_squares;
mod linearization;
mod oracle;
mod redundancy;
mod runs;
mod shared;
mod singular;
