//! Studies: their cases on all cores of this machine, or some of them for somebody else's workers.

use std::path::{Path, PathBuf};
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::{Arc, Mutex, PoisonError};

use columnar::Values;
use pyo3::exceptions::PyException;
use pyo3::prelude::*;
use pyo3::types::PyList;
use stiction::OutputError;
use studies::{
    Cause, Definition, Design, GivenOutput, GivenParameter, Levels, Range, RecordError, Row,
    Settings, StudyError, StudyFile, Until, Value,
};

use crate::project::{Project, argument_failure, input_failure, messages, output_failure};
use crate::run::{Ran, Told};
use crate::table::{Table, numbers};

pyo3::create_exception!(
    _native,
    FolderFailure,
    PyException,
    "A folder that cannot take a study: why, and what to do."
);

/// A value of a parameter.
#[derive(FromPyObject, IntoPyObject)]
pub(crate) enum Given {
    Number(f64),
    Text(String),
}

impl From<Given> for Value {
    fn from(given: Given) -> Self {
        match given {
            Given::Number(number) => Self::Number(number),
            Given::Text(text) => Self::Text(text),
        }
    }
}

impl From<Value> for Given {
    fn from(value: Value) -> Self {
        match value {
            Value::Number(number) => Self::Number(number),
            Value::Text(text) => Self::Text(text),
        }
    }
}

/// A parameter: its name, values with a unit each, or the ends of a range and whether it is
/// logarithmic, with a unit.
type PythonParameter = (
    String,
    Vec<(Given, Option<String>)>,
    Option<(f64, f64, bool, Option<String>)>,
);

/// Number, outputs, success, message and steps of a case.
type PythonRow = (usize, Vec<Option<f64>>, bool, String, i64);

/// What [`Study`] takes after the model.
type PythonDefinition = (
    Vec<PythonParameter>,
    &'static str,
    Option<usize>,
    u64,
    Vec<(String, bool, String)>,
    PythonSettings,
);

/// End, steps, dtout and error.
type PythonSettings = (Option<f64>, Option<u32>, Option<f64>, Option<f64>);

/// The file of the model of a study file, what else the study is made of, and warnings as JSON.
#[pyfunction]
pub(crate) fn read_study(path: PathBuf) -> PyResult<(PathBuf, PythonDefinition, String)> {
    let file = StudyFile::read(&path).map_err(|error| input_failure(&error))?;
    let definition = file.study.definition();
    let parameters = definition.parameters.iter().map(|given| {
        let name = given.name.clone();
        match &given.levels {
            Levels::Range(range) => {
                let unit = given.units.first().cloned().flatten();
                (
                    name,
                    Vec::new(),
                    Some((range.low, range.high, range.logarithmic, unit)),
                )
            }
            Levels::Values(values) => {
                let values = values.iter().cloned().map(Given::from);
                (
                    name,
                    values.zip(given.units.iter().cloned()).collect(),
                    None,
                )
            }
        }
    });
    let outputs = definition
        .outputs
        .iter()
        .map(|(name, output)| match output {
            GivenOutput::Reduction(text) => (name.clone(), false, text.clone()),
            GivenOutput::Called(text) => (name.clone(), true, text.clone()),
        });
    let Settings {
        end,
        steps,
        dtout,
        error,
    } = definition.settings;
    let said = (
        parameters.collect(),
        definition.design.name(),
        definition.cases,
        definition.seed,
        outputs.collect(),
        (end, steps, dtout, error),
    );
    Ok((file.model, said, messages(&file.warnings)))
}

/// A study that was put together.
#[pyclass(frozen, module = "stiction._native")]
pub(crate) struct Study {
    study: Arc<studies::Study>,
}

fn study_failure(error: StudyError) -> PyErr {
    match error.cause {
        Cause::Argument(error) => argument_failure(error),
        Cause::Input(error) => input_failure(&error),
    }
}

fn record_failure(error: RecordError) -> PyErr {
    match error {
        RecordError::Output(error) => output_failure(error),
        other => FolderFailure::new_err(other.to_string()),
    }
}

#[pymethods]
impl Study {
    /// A study of a model. An output is a reduction, or the text that tells a callable from others.
    #[new]
    fn new(
        model: &Project,
        parameters: Vec<PythonParameter>,
        design: &str,
        cases: Option<usize>,
        seed: u64,
        outputs: Vec<(String, bool, String)>,
        settings: PythonSettings,
    ) -> PyResult<Self> {
        let parameters = parameters.into_iter().map(|(name, values, range)| {
            let (levels, units) = match range {
                Some((low, high, logarithmic, unit)) => {
                    let range = Range {
                        low,
                        high,
                        logarithmic,
                    };
                    (Levels::Range(range), vec![unit])
                }
                None => {
                    let (values, units) =
                        values.into_iter().map(|(v, unit)| (v.into(), unit)).unzip();
                    (Levels::Values(values), units)
                }
            };
            GivenParameter {
                name,
                levels,
                units,
            }
        });
        let outputs = outputs
            .into_iter()
            .map(|(name, called, text)| match called {
                true => (name, GivenOutput::Called(text)),
                false => (name, GivenOutput::Reduction(text)),
            });
        let (end, steps, dtout, error) = settings;
        let definition = Definition {
            parameters: parameters.collect(),
            design: Design::named(design).map_err(argument_failure)?,
            cases,
            seed,
            outputs: outputs.collect(),
            settings: Settings {
                end,
                steps,
                dtout,
                error,
            },
        };
        let study = studies::Study::new(model.project.clone(), definition);
        let study = Arc::new(study.map_err(study_failure)?);
        Ok(Self { study })
    }

    /// Number of cases.
    fn cases(&self) -> usize {
        self.study.cases()
    }

    /// What the study is, as JSON.
    fn manifest(&self) -> String {
        self.study.manifest().to_string()
    }

    /// Units of columns as JSON.
    fn units(&self) -> String {
        serde_json::Value::Object(self.study.units()).to_string()
    }

    /// The seed of a case.
    fn seed(&self, case: usize) -> i64 {
        self.study.seed(case)
    }

    /// The changes that make the model of a case.
    fn changes(&self, case: usize) -> Vec<String> {
        self.study.changes(case)
    }

    /// What is known of its cases: nothing, or what a folder holds.
    fn record(&self, folder: Option<PathBuf>, resume: bool) -> PyResult<Record> {
        let study = Arc::clone(&self.study);
        let record = match folder {
            Some(folder) => studies::Record::open(study, &folder, resume),
            None => Ok(studies::Record::new(study)),
        };
        let record = Mutex::new(record.map_err(record_failure)?);
        Ok(Record { record })
    }

    /// Runs some cases one after the other; `called` makes the outputs that are callables.
    fn run(
        &self,
        py: Python<'_>,
        cases: Vec<usize>,
        called: Option<Py<PyAny>>,
    ) -> PyResult<Vec<PythonRow>> {
        let failure = Mutex::new(None);
        let stopped = AtomicBool::new(false);
        let case = Case {
            study: &self.study,
            called: called.as_ref(),
            failure: &failure,
        };
        let rows = py.detach(|| {
            let scratch = tempfile::tempdir()?;
            let rows = cases.into_iter().map_while(|number| {
                let row = case.row(number, scratch.path(), &stopped);
                row.map_err(output_failure).transpose()
            });
            rows.collect::<PyResult<Vec<_>>>()
        })?;
        match failure.into_inner().unwrap_or_else(PoisonError::into_inner) {
            Some(error) => Err(error),
            None => Ok(rows.into_iter().map(python_row).collect()),
        }
    }
}

fn python_row(row: Row) -> PythonRow {
    (row.case, row.outputs, row.success, row.message, row.steps)
}

/// What runs a case.
struct Case<'a> {
    study: &'a studies::Study,
    /// Makes the outputs that are callables: numbers in their order, or what went wrong.
    called: Option<&'a Py<PyAny>>,
    /// What a callable has raised that ends the study.
    failure: &'a Mutex<Option<PyErr>>,
}

/// What a callable answers.
#[derive(FromPyObject)]
enum Answer {
    Values(Vec<f64>),
    Failed(String),
}

impl Case<'_> {
    fn row(
        &self,
        case: usize,
        scratch: &Path,
        stopped: &AtomicBool,
    ) -> Result<Option<Row>, OutputError> {
        let mut watch = Until(stopped);
        let Some(called) = self.called else {
            let ran = self.study.run(case, scratch, &mut watch, None)?;
            return Ok(ran.map(|(row, _)| row));
        };
        let mut table = Table::default();
        let ran = self
            .study
            .run(case, scratch, &mut watch, Some(&mut table))?;
        let Some((mut row, run)) = ran else {
            return Ok(None);
        };
        let Some(run) = run.filter(|_| row.success) else {
            return Ok(Some(row));
        };
        let told = Told::of(&run.project, &run.report, &run.warnings, scratch);
        let answer = Python::attach(|py| {
            let ran: Ran<'_> = told.with(py, &table, None)?;
            let checksum = run.project.model_checksum();
            called
                .call1(py, (case, ran, checksum))?
                .extract::<Answer>(py)
        });
        match answer {
            Ok(Answer::Values(values)) => {
                let given = self.study.definition().outputs.iter();
                let outputs = row.outputs.iter_mut().zip(given);
                let called = outputs.filter(|(_, (_, o))| matches!(o, GivenOutput::Called(_)));
                for ((output, _), value) in called.zip(values) {
                    *output = Some(value);
                }
            }
            Ok(Answer::Failed(message)) => {
                row = Row::failed(case, row.outputs.len(), message, row.steps);
            }
            Err(error) => {
                let mut failure = self.failure.lock().unwrap_or_else(PoisonError::into_inner);
                failure.get_or_insert(error);
                stopped.store(true, Ordering::Relaxed);
                return Ok(None);
            }
        }
        Ok(Some(row))
    }
}

/// The cases of a study that are done.
#[pyclass(frozen, module = "stiction._native")]
pub(crate) struct Record {
    record: Mutex<studies::Record>,
}

impl Record {
    /// Does something with it while others may use the interpreter.
    fn with<T: Send>(
        &self,
        py: Python<'_>,
        done: impl FnOnce(&mut studies::Record) -> T + Send,
    ) -> T {
        py.detach(|| done(&mut self.record.lock().unwrap_or_else(PoisonError::into_inner)))
    }
}

#[pymethods]
impl Record {
    /// The cases that are not done.
    fn open_cases(&self, py: Python<'_>) -> Vec<usize> {
        self.with(py, |record| record.open_cases())
    }

    /// Number of cases that are done, and of those that have failed.
    fn counts(&self, py: Python<'_>) -> (usize, usize) {
        self.with(py, |record| record.counts())
    }

    /// What a program says at the end.
    fn summary(&self, py: Python<'_>, folder: PathBuf, seconds: f64) -> String {
        self.with(py, |record| record.summary(&folder, seconds))
    }

    /// Records cases that are done, and writes what has waited for long.
    fn push(&self, py: Python<'_>, rows: Vec<PythonRow>) -> PyResult<()> {
        let rows = rows.into_iter();
        let rows = rows.map(|(case, outputs, success, message, steps)| Row {
            case,
            outputs,
            success,
            message,
            steps,
        });
        let mut rows = rows.collect::<Vec<_>>().into_iter();
        let recorded = self.with(py, |record| {
            rows.try_for_each(|row| record.push(row))?;
            record.keep_up()
        });
        recorded.map_err(record_failure)
    }

    /// Writes what is not written yet and, where all cases are done, the table of all of them.
    fn finish(&self, py: Python<'_>) -> PyResult<()> {
        self.with(py, studies::Record::finish)
            .map_err(record_failure)
    }

    /// Runs the cases that are not done, so many at a time, all cores without a number. `called`
    /// makes the outputs that are callables; `told` is called now and then with the numbers of cases
    /// that are done and that have failed.
    fn run(
        &self,
        py: Python<'_>,
        workers: Option<usize>,
        called: Option<Py<PyAny>>,
        told: Option<Py<PyAny>>,
    ) -> PyResult<()> {
        let cores = || std::thread::available_parallelism().map_or(1, usize::from);
        let workers = workers.unwrap_or_else(cores);
        let failure = Mutex::new(None);
        let ran = self.with(py, |record| {
            let study = Arc::clone(record.study());
            let case = Case {
                study: &study,
                called: called.as_ref(),
                failure: &failure,
            };
            let evaluate = |number: usize, scratch: &Path, stopped: &AtomicBool| {
                case.row(number, scratch, stopped)
            };
            let mut look = |record: &studies::Record| {
                let looked = Python::attach(|py| {
                    py.check_signals()?;
                    if let Some(told) = &told {
                        told.call1(py, record.counts())?;
                    }
                    Ok(())
                });
                let mut failure = failure.lock().unwrap_or_else(PoisonError::into_inner);
                if let Err(error) = looked {
                    failure.get_or_insert(error);
                }
                failure.is_none()
            };
            studies::run(record, workers, &evaluate, &mut look)
        });
        ran.map_err(record_failure)?;
        match failure.into_inner().unwrap_or_else(PoisonError::into_inner) {
            Some(error) => Err(error),
            None => Ok(()),
        }
    }

    /// The table of the cases that are done: name, type and values of each column. Numbers come as
    /// bytes, those that are missing as what is not a number.
    fn columns<'py>(
        &self,
        py: Python<'py>,
    ) -> PyResult<Vec<(String, &'static str, Bound<'py, PyAny>)>> {
        let table = self.with(py, |record| record.table());
        let columns = table.columns.into_iter().map(|column| {
            let (kind, values) = match column.values {
                Values::Double(values) => ("double", numbers(py, &values)?.into_any()),
                Values::Optional(values) => {
                    let values: Vec<f64> = values.iter().map(|v| v.unwrap_or(f64::NAN)).collect();
                    ("double", numbers(py, &values)?.into_any())
                }
                Values::Long(values) => ("long", PyList::new(py, values)?.into_any()),
                Values::Integer(values) => ("long", PyList::new(py, values)?.into_any()),
                Values::Boolean(values) => ("boolean", PyList::new(py, values)?.into_any()),
                Values::Text(values) => {
                    let texts = values
                        .iter()
                        .map(|text| String::from_utf8_lossy(text.data()));
                    let texts: Vec<_> = texts.collect();
                    ("text", PyList::new(py, texts)?.into_any())
                }
            };
            Ok((column.name, kind, values))
        });
        columns.collect()
    }
}
