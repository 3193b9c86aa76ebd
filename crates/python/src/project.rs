//! Models: reading them, changing them.

use std::collections::BTreeMap;
use std::path::PathBuf;

use pyo3::exceptions::PyException;
use pyo3::prelude::*;
use pyo3::types::PyBytes;
use serde_json::Value;
use stiction::{ArgumentError, Disk, InputError, Levels, Message, OutputError};

use crate::description;
use crate::recording::{Recording, Texts};

pyo3::create_exception!(
    _native,
    InputFailure,
    PyException,
    "What is wrong with an input: text for people, and its messages as JSON."
);
pyo3::create_exception!(
    _native,
    OutputFailure,
    PyException,
    "A file that cannot be written: its path, and why."
);

pyo3::create_exception!(
    _native,
    NameFailure,
    PyException,
    "A name of nothing: what it should name, the name, and the names that there are."
);
pyo3::create_exception!(
    _native,
    ValueFailure,
    PyException,
    "A value that cannot be used: why, and what to write instead."
);

pub(crate) fn argument_failure(error: ArgumentError) -> PyErr {
    match error {
        ArgumentError::Unknown { what, name, known } => NameFailure::new_err((what, name, known)),
        ArgumentError::Value(text) => ValueFailure::new_err(text),
    }
}

/// The number by which a number in one unit is multiplied to be in another.
#[pyfunction]
pub(crate) fn conversion(from: &str, into: &str) -> PyResult<f64> {
    stiction::conversion(from, into).map_err(argument_failure)
}

/// A dataset with its commands and the changes made to it.
#[pyclass(frozen, module = "stiction._native")]
pub(crate) struct Project {
    pub(crate) project: stiction::Project,
    texts: Texts,
}

pub(crate) fn input_failure(error: &InputError) -> PyErr {
    InputFailure::new_err((error.to_string(), messages(&error.messages)))
}

pub(crate) fn output_failure(error: OutputError) -> PyErr {
    OutputFailure::new_err((error.path, error.cause))
}

/// Messages as JSON, each with its text for people.
pub(crate) fn messages<'a>(messages: impl IntoIterator<Item = &'a Message>) -> String {
    let each = messages.into_iter().map(|message| {
        let mut value = message.to_json();
        value["text"] = message.to_string().into();
        value
    });
    each.collect::<Value>().to_string()
}

#[pymethods]
impl Project {
    /// Reads a file and those that it names, from the disk or from the texts given.
    #[staticmethod]
    #[pyo3(signature = (path, texts = None))]
    fn load(
        py: Python<'_>,
        path: PathBuf,
        texts: Option<BTreeMap<PathBuf, Vec<u8>>>,
    ) -> PyResult<Self> {
        let read = py.detach(|| {
            let files: &dyn stiction::Files = match &texts {
                Some(texts) => texts,
                None => &Disk,
            };
            let recording = Recording::of(files);
            let project = stiction::Project::load_from(&recording, &path, Levels::default())?;
            Ok((project, recording.into_texts()))
        });
        let (project, texts) = read.map_err(|error| input_failure(&error))?;
        Ok(Self { project, texts })
    }

    /// The same with changes made to it, each as a command would make it.
    fn changed(&self, changes: Vec<String>) -> PyResult<Self> {
        let mut project = self.project.clone();
        for change in &changes {
            let made = project.set_as("change", change);
            made.map_err(|error| input_failure(&error))?;
        }
        Ok(Self {
            project,
            texts: self.texts.clone(),
        })
    }

    /// What a change of the argument of that name begins with, and its unit where it is known.
    fn argument(&self, name: &str) -> PyResult<(String, Option<String>)> {
        let argument = self.project.argument(name).map_err(argument_failure)?;
        Ok((argument.change, argument.unit))
    }

    /// The files that were read, by their paths.
    fn texts(&self) -> BTreeMap<PathBuf, Vec<u8>> {
        self.texts.clone()
    }

    /// A checksum of the model as given and the changes made to it.
    fn checksum(&self) -> String {
        self.project.model_checksum()
    }

    /// The file of the dataset with the changes written into it.
    fn dataset_file<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let file = self.project.to_dataset_file();
        let file = file.map_err(|error| input_failure(&error))?;
        Ok(PyBytes::new(py, &file))
    }

    /// What the model holds, as JSON.
    fn description(&self) -> String {
        description::of(&self.project).to_string()
    }

    /// Warnings so far, as JSON.
    fn diagnostics(&self) -> String {
        messages(self.project.warnings())
    }

    /// The statement of an element, as it was changed last.
    fn statement(&self, statement: &str, id: u32) -> Option<String> {
        let dataset = self.project.dataset();
        let mut elements = dataset.headers();
        let (statement, _) = elements.find(|(name, h)| *name == statement && h.id == id)?;
        dataset.text_of(statement, id)
    }
}
