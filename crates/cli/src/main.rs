//! The program `stiction`: runs, checks and explains Adams Solver datasets.

mod arguments;
mod check;
mod convert;
mod diagnostics;
mod exit;
mod explain;
mod file;
mod fmt;
mod plot;
mod progress;
mod record;
mod replace;
mod run;
mod sweep;

use std::process::ExitCode;

use clap::Parser;

use crate::arguments::{Arguments, Command};

fn main() -> ExitCode {
    let status = match Arguments::parse().command {
        Command::Run(arguments) => run::run(&arguments),
        Command::Check(arguments) => check::check(&arguments),
        Command::Explain(arguments) => explain::explain(&arguments),
        Command::Plot(arguments) => plot::plot(&arguments),
        Command::Sweep(arguments) => sweep::sweep(&arguments),
        Command::Convert(arguments) => convert::convert(&arguments),
        Command::Fmt(arguments) => fmt::fmt(&arguments),
    };
    ExitCode::from(status.code())
}
