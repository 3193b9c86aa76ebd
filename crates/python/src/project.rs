//! Models: reading them, changing them.

use std::collections::BTreeMap;
use std::path::PathBuf;

use pyo3::exceptions::PyException;
use pyo3::prelude::*;
use serde_json::Value;
use stiction::{Disk, InputError, Levels, Message};

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

/// A dataset with its commands and the changes made to it.
#[pyclass(frozen, module = "stiction._native")]
pub(crate) struct Project {
    pub(crate) project: stiction::Project,
    texts: Texts,
}

pub(crate) fn input_failure(error: &InputError) -> PyErr {
    InputFailure::new_err((error.to_string(), messages(&error.messages)))
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

    /// The files that were read, by their paths.
    fn texts(&self) -> BTreeMap<PathBuf, Vec<u8>> {
        self.texts.clone()
    }

    /// A checksum of the model as given and the changes made to it.
    fn checksum(&self) -> String {
        self.project.model_checksum()
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
