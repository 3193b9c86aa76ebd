//! Simulation of machine joints with friction from Adams Solver datasets.
//!
//! This crate joins the others: it reads a dataset (`.adm`) and its command file (`.acf`), lowers
//! the model to mechanics and friction, carries out the commands and writes the results.
//!
//! ```text
//! Project::load -> Session::new -> Session::run -> .res, .req, .msg and a RunReport
//! ```
//!
//! | step | file |
//! |---|---|
//! | files to a checked dataset and commands | `files.rs`, `loader.rs`, `project.rs` |
//! | arguments by name, units of numbers | `argument.rs`, `quantity.rs` |
//! | dataset to mechanics | `lower/` |
//! | a run from outside | `session.rs` |
//! | what the commands will ask for | `survey.rs` |
//! | commands carried out | `runner.rs`, equilibria in `statics.rs`, settings and output times in `settings.rs` |
//! | how accurate a run is | `accuracy.rs`, by a second run in `second_run.rs` |
//! | one run at a time in a folder | `claim.rs` |
//! | SAVE and RELOAD | `saving.rs`, their file `saved_system.rs` |
//! | rows of results | `channels.rs`, forces of elements in `wrenches.rs`, written by `recorder.rs`, given to others by `sink.rs` |
//! | events | `sensors.rs` |
//! | message file | `journal.rs`, LIST in `listing.rs`, INFO and TIME in `info.rs` |
//! | our own channels of a friction | `friction_detail.rs` |
//! | table of friction, energy balance | `report.rs`, `balance.rs`, `text_table.rs`; as JSON `report_json.rs` |
//! | where friction came from, read back | `explain/` |
//! | a look without a run | `check.rs` |
//!
//! # Example
//! ```no_run
//! use stiction::{Project, RunOptions, Session, friction_table};
//!
//! struct Silent;
//! impl stiction::Watch for Silent {
//!     fn progress(&mut self, _: &stiction::Progress) -> bool {
//!         true
//!     }
//! }
//!
//! let mut project = Project::load("pendulum.adm".as_ref())?;
//! project.set("FRICTION/1, MU_STATIC=0.2")?;
//! project.push_dynamic(2.0, Some(200), None);
//! let session = Session::new(&project)?;
//! std::fs::create_dir_all("results")?;
//! let report = session.run("results".as_ref(), RunOptions::default(), &mut Silent)?;
//! println!("{:?}\n{}", report.outcome, friction_table(&report.frictions));
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod about;
mod accuracy;
mod argument;
mod balance;
mod channels;
mod check;
mod checkpoint;
mod claim;
mod defaults;
mod eigensolution;
pub mod explain;
mod failure;
mod files;
mod friction_detail;
mod info;
mod journal;
mod levels;
mod listing;
mod loader;
mod lower;
mod message;
mod method;
mod project;
mod quantity;
mod reactions;
mod recorder;
mod refusal;
mod report;
mod report_json;
mod resuming;
mod runner;
mod saved_system;
mod saving;
mod second_run;
mod sensors;
mod session;
mod settings;
pub mod sink;
mod statics;
mod survey;
mod text_table;
mod time_span;
mod warnings;
mod whole_file;
mod wrenches;

pub use accuracy::{AccuracyReport, BodyDeviation, ElementDeviation, SecondFailure};
pub use argument::{Argument, ArgumentError};
pub use balance::{EnergyBalance, EnergyTerm};
pub use check::{CheckReport, check};
pub use checkpoint::{CheckpointError, ResumeError};
pub use claim::Claim;
pub use dataset::{Code, Diagnostic, Location, Place, Replacement, Severity, Span};
pub use defaults::{FrictionDefaults, defaults_in_use};
pub use eigensolution::{ModeLine, ModeReport};
pub use files::{Disk, Files};
pub use levels::{LevelError, Levels};
pub use message::{InputError, Message};
pub use method::Method;
pub use project::{Project, hexadecimal};
pub use quantity::{conversion, unit_of};
pub use reactions::reactions;
pub use report::{FrictionReport, friction_table};
pub use session::{
    FailedCommand, Outcome, OutputError, Progress, RunOptions, RunReport, Session, Watch,
};
pub use whole_file::{unfinished, write_whole};
