//! Studies: many runs of a model with other arguments, and a number or more of each.
//!
//! A study is made of a model, parameters with values, a design and outputs. Its cases are numbered,
//! and each can be run by itself, on any machine: the table of all of them is the same, bit for bit,
//! whoever runs them in whatever order.
//!
//! | what | file |
//! |---|---|
//! | which cases there are | `design/` |
//! | values, ranges, units | `parameter.rs` |
//! | outputs | `reduction.rs` of the channels of `channel.rs` |
//! | the study and one case of it | `study.rs` |
//! | the table, the folder it is written into | `table.rs`, `record.rs` |
//! | cases on all cores | `engine.rs` |
//! | study files | `file.rs` |
//!
//! ```no_run
//! use studies::{Record, StudyFile, Until};
//!
//! let file = StudyFile::read("study.toml".as_ref())?;
//! let study = std::sync::Arc::new(file.study);
//! let mut record = Record::open(study.clone(), "results".as_ref(), false)?;
//! let evaluate = |case: usize, scratch: &std::path::Path, stopped: &_| {
//!     Ok(study.run(case, scratch, &mut Until(stopped), None)?.map(|(row, _)| row))
//! };
//! studies::run(&mut record, 2, &evaluate, &mut |_| true)?;
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod channel;
mod design;
mod engine;
mod file;
mod parameter;
mod record;
mod reduction;
mod study;
mod table;

pub use design::Design;
pub use engine::{Evaluate, Until, run};
pub use file::StudyFile;
pub use parameter::{GivenParameter, Levels, Parameter, Range, Value};
pub use record::{Record, RecordError};
pub use study::{
    CaseRun, Cause, Definition, GivenOutput, Row, Settings, Study, StudyError, Subject,
};
