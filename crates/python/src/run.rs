//! Runs without the lock of the interpreter, stopped by Ctrl-C.

use std::path::{Path, PathBuf};
use std::time::{Duration, Instant};

use columnar::{Format, Tables};
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use stiction::sink::Sink;
use stiction::{Claim, Message, Method, Progress, RunOptions, RunReport, Session, Watch};

use crate::project::{Project, argument_failure, input_failure, messages, output_failure};
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
pub(crate) type Ran<'py> = (
    String,
    Bound<'py, PyBytes>,
    Bound<'py, PyBytes>,
    Bound<'py, PyBytes>,
    String,
    String,
    String,
    Option<PyErr>,
);

/// What a run tells of itself beside its rows.
pub(crate) struct Told {
    report: String,
    messages: String,
    log: String,
}

impl Told {
    /// Of a run whose message file is in a folder.
    pub(crate) fn of(
        project: &stiction::Project,
        report: &RunReport,
        warnings: &[Message],
        folder: &Path,
    ) -> Self {
        let log = folder.join(format!("{}.msg", project.prefix()));
        let mut value = report.to_json();
        value["elapsed_seconds"] = report.elapsed.into();
        Self {
            report: value.to_string(),
            messages: messages(warnings.iter().chain(&report.messages)),
            log: std::fs::read_to_string(log).unwrap_or_default(),
        }
    }

    /// With the rows.
    pub(crate) fn with<'py>(
        self,
        py: Python<'py>,
        table: &Table,
        stopped: Option<PyErr>,
    ) -> PyResult<Ran<'py>> {
        Ok((
            table.entities(),
            table.times(py)?,
            table.kinds(py),
            table.columns(py)?,
            self.report,
            self.messages,
            self.log,
            stopped,
        ))
    }
}

/// Runs a model: with a folder results go there in the formats (`res`, `parquet`, `csv`), without one
/// there are no files. `method` is the name of a method of integration, `reactions` how
/// redundant constraints have theirs, with its length. `facts` stand in the metadata of tables, `told` is called with time and end
/// now and then.
#[pyfunction]
#[pyo3(signature = (model, folder, formats, end, steps, dtout, error, method, reactions, check_accuracy, facts, told))]
pub(crate) fn run<'py>(
    py: Python<'py>,
    model: &Project,
    folder: Option<PathBuf>,
    formats: Vec<String>,
    end: Option<f64>,
    steps: Option<u32>,
    dtout: Option<f64>,
    error: Option<f64>,
    method: Option<String>,
    reactions: (String, Option<f64>),
    check_accuracy: bool,
    facts: Vec<(String, String)>,
    told: Option<Py<PyAny>>,
) -> PyResult<Ran<'py>> {
    let mut monitor = Monitor {
        last: Instant::now(),
        told: told.as_ref(),
        stopped: None,
    };
    let method = method.map(|name| name.parse::<Method>()).transpose();
    let method = method.map_err(argument_failure)?;
    let (reactions, length) = reactions;
    let reactions = stiction::reactions(&reactions, length).map_err(argument_failure)?;
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
        let _claim = Claim::of(into).map_err(output_failure)?;
        let wanted = |format: &str| formats.iter().any(|wanted| wanted == format);
        let settings = RunOptions {
            error,
            method,
            reactions,
            text_results: folder.is_some() && wanted("res"),
            check_accuracy,
            ..RunOptions::default()
        };
        let cleared = columnar::clear(into, project.prefix(), settings.text_results);
        cleared.map_err(output_failure)?;
        let mut tables = Tables::new(into, of_tables(&formats));
        let mut sinks: Vec<&mut dyn Sink> = vec![&mut table];
        if folder.is_some() && !tables.is_empty() {
            sinks.push(&mut tables);
        }
        let report = session.run_into(into, settings, &mut monitor, &mut sinks);
        let report = report.map_err(output_failure)?;
        let own = [
            ("version", env!("CARGO_PKG_VERSION").to_owned()),
            ("outcome", report.outcome.words().0.to_owned()),
        ];
        let given = facts.iter().map(|(name, fact)| (&**name, fact.clone()));
        let facts: Vec<_> = own.into_iter().chain(given).collect();
        tables.finish(&facts).map_err(output_failure)?;
        PyResult::Ok(Told::of(&project, &report, session.warnings(), into))
    });
    ran?.with(py, &table, monitor.stopped)
}

/// Those of the formats that are formats of tables.
pub(crate) fn of_tables(formats: &[String]) -> Vec<Format> {
    let each = [("parquet", Format::Parquet), ("csv", Format::Csv)];
    let wanted = each.into_iter();
    wanted
        .filter(|(name, _)| formats.iter().any(|wanted| wanted == name))
        .map(|(_, format)| format)
        .collect()
}
