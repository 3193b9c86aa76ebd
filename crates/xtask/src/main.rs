//! Commands of the project itself.
//!
//! `cargo xtask bench` measures the solver beside its peers and writes `docs/performance.md`;
//! `cargo xtask bench andrews --no-peers` measures one case and prints it. `cargo xtask robustness` runs
//! random mechanisms and writes `docs/robustness.md`.
#![allow(clippy::print_stdout, reason = "a program says what it measured")]

mod bench;
mod robustness;

use std::process::ExitCode;

use clap::{Parser, Subcommand};

#[derive(Parser)]
#[command(name = "cargo xtask")]
struct Arguments {
    #[command(subcommand)]
    command: Command,
}

#[derive(Subcommand)]
enum Command {
    /// Measure the solver, beside its peers where they can be had.
    Bench(bench::Arguments),
    /// Measure a chain of one size, for the table of growth.
    #[command(hide = true)]
    Grow(bench::growth::Arguments),
    /// Run random mechanisms: every run ends well or says why not.
    Robustness(robustness::Arguments),
}

fn main() -> ExitCode {
    let outcome = match Arguments::parse().command {
        Command::Bench(arguments) => bench::run(&arguments),
        Command::Grow(arguments) => bench::growth::measure(&arguments),
        Command::Robustness(arguments) => robustness::run(&arguments),
    };
    match outcome {
        Ok(()) => ExitCode::SUCCESS,
        Err(message) => {
            println!("{message}");
            ExitCode::FAILURE
        }
    }
}
