//! Runs without the lock of the interpreter, stopped by Ctrl-C.

use std::path::PathBuf;
use std::time::{Duration, Instant};

use pyo3::prelude::*;
use pyo3::types::PyBytes;
use stiction::{OutputError, Progress, RunOptions, Session, Watch};

use crate::project::{OutputFailure, Project, input_failure, messages};
use crate::table::Table;

/// Wall time between two looks at the interpreter: short for people, long for a run.
const LOOK: Duration = Duration::from_millis(50);

/// Asks the interpreter now and then whether to go on.
struct Monitor<'a> {
    last: Instant,
    told: Option<&'a Py<PyAny>>,
    stopped: Option<PyErr>,
}

impl Watch for Monitor<'_> {
    fn progress(&mut self, progress: &Progress) -> bool {
        if self.last.elapsed() < LOOK {
            return true;
        }
        let looked = Python::attach(|py| {
            py.check_signals()?;
            if let Some(told) = self.told {
                told.call1(py, (progress.time, progress.end))?;
            }
            Ok(())
        });
        self.last = Instant::now();
        self.stopped = looked.err();
        self.stopped.is_none()
    }
}

/// What a run hands over: entities and report as JSON, times, kinds and columns as bytes, messages
/// as JSON, the text of the message file, and what stopped it.
type Ran<'py> = (
    String,
    Bound<'py, PyBytes>,
    Bound<'py, PyBytes>,
    Bound<'py, PyBytes>,
    String,
    String,
    String,
    Option<PyErr>,
);

/// Runs a model: with a folder the files of results go there, without one there are none. `told` is
/// called with time and end now and then.
#[pyfunction]
#[pyo3(signature = (model, folder, end, steps, dtout, error, told))]
pub(crate) fn run<'py>(
    py: Python<'py>,
    model: &Project,
    folder: Option<PathBuf>,
    end: Option<f64>,
    steps: Option<u32>,
    dtout: Option<f64>,
    error: Option<f64>,
    told: Option<Py<PyAny>>,
) -> PyResult<Ran<'py>> {
    let mut monitor = Monitor {
        last: Instant::now(),
        told: told.as_ref(),
        stopped: None,
    };
    let mut table = Table::default();
    let ran = py.detach(|| {
        let mut project = model.project.clone();
        if let Some(end) = end {
            project.push_dynamic(end, steps, dtout);
        }
        let session = Session::new(&project).map_err(|error| input_failure(&error))?;
        let scratch = tempfile::tempdir()?;
        let into = folder.as_deref().unwrap_or(scratch.path());
        std::fs::create_dir_all(into)?;
        let options = RunOptions {
            error,
            text_results: folder.is_some(),
            ..RunOptions::default()
        };
        let report = session.run_into(into, options, &mut monitor, &mut table);
        let report = report.map_err(output_failure)?;
        let log = into.join(format!("{}.msg", project.prefix()));
        let log = std::fs::read_to_string(log).unwrap_or_default();
        let told = messages(session.warnings().iter().chain(&report.messages));
        let mut value = report.to_json();
        value["elapsed_seconds"] = report.elapsed.into();
        PyResult::Ok((value.to_string(), told, log))
    });
    let (report, messages, log) = ran?;
    Ok((
        table.entities(),
        table.times(py)?,
        table.kinds(py),
        table.columns(py)?,
        report,
        messages,
        log,
        monitor.stopped,
    ))
}

fn output_failure(error: OutputError) -> PyErr {
    OutputFailure::new_err((error.path, error.cause))
}
