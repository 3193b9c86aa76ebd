//! `stiction._native`: what the Python package `stiction` takes from Rust.
//!
//! It is kept small: models and tables cross the border as bytes and JSON, and the classes that users
//! see are written in Python, beside this crate in `stiction/`.
//!
//! | what | file |
//! |---|---|
//! | models: reading, changing, telling what they hold | `project.rs`, `description.rs`, `recording.rs` |
//! | runs: without the lock of the interpreter, stopped by Ctrl-C | `run.rs`, the table of results `table.rs` |
//! | results in memory as tables on disk | `saving.rs` |
//! | studies: cases on all cores, their table | `study.rs` |
//! | friction laws over arrays | `laws.rs` |

mod description;
mod laws;
mod project;
mod recording;
mod run;
mod saving;
mod study;
mod table;

/// What the package takes from Rust.
#[pyo3::pymodule]
mod _native {
    use pyo3::prelude::*;

    #[pymodule_init]
    fn init(module: &Bound<'_, PyModule>) -> PyResult<()> {
        let methods = stiction::Method::ALL.map(stiction::Method::name);
        module.add("METHODS", methods.to_vec())?;
        module.add("__version__", env!("CARGO_PKG_VERSION"))
    }

    #[pymodule_export]
    use crate::laws::{lugre, lugre_stribeck, original};
    #[pymodule_export]
    use crate::project::{
        InputFailure, NameFailure, OutputFailure, Project, ValueFailure, conversion,
    };
    #[pymodule_export]
    use crate::run::run;
    #[pymodule_export]
    use crate::saving::save;
    #[pymodule_export]
    use crate::study::{FolderFailure, Record, Study, read_study};
}
