//! Simulation of machine joints with friction from Adams Solver datasets.
//!
//! This crate joins the others: it reads a dataset (`.adm`) and its command file (`.acf`), lowers
//! the model to mechanics and friction, carries out the commands and writes the results.
//!
//! ```text
//! Project::load -> Session::new -> Session::run -> .res, .req, .msg and a RunReport
//! ```

mod channels;
mod check;
mod defaults;
mod journal;
mod lower;
mod message;
mod project;
mod recorder;
mod report;
mod session;
mod settings;
mod wrenches;

pub use check::{CheckReport, check};
pub use defaults::{FrictionDefaults, defaults_in_use};
pub use message::{InputError, Message};
pub use project::Project;
pub use report::{FrictionReport, friction_table};
pub use session::{Outcome, OutputError, Progress, RunOptions, RunReport, Session, Watch};
