//! The program `stiction`: runs and checks Adams Solver datasets.

mod arguments;
mod check;
mod exit;
mod progress;
mod record;
mod run;

use std::process::ExitCode;

use clap::Parser;

use crate::arguments::{Arguments, Command};

fn main() -> ExitCode {
    let status = match Arguments::parse().command {
        Command::Run(arguments) => run::run(&arguments),
        Command::Check(arguments) => check::check(&arguments),
    };
    ExitCode::from(status.code())
}
