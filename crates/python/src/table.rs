//! The rows of a run as a table in memory.

use pyo3::prelude::*;
use pyo3::types::PyBytes;
use serde_json::{Value, json};
use stiction::OutputError;
use stiction::sink::{DataKind, Header, Layout, Sink};

/// Rows as they come, with what their values are.
#[derive(Default)]
pub(crate) struct Table {
    width: usize,
    times: Vec<f64>,
    kinds: Vec<u8>,
    /// Row after row.
    values: Vec<f64>,
    entities: Value,
}

impl Sink for Table {
    fn begin(&mut self, _: &Header, layout: &Layout) -> Result<(), OutputError> {
        self.width = layout.value_count();
        let entities = layout.entities().iter().enumerate();
        let entities = entities.map(|(place, entity)| {
            let components = entity.components.iter().enumerate();
            let components = components.map(|(k, component)| {
                json!([component.name, component.unit, layout.column(place, k)])
            });
            json!({
                "name": entity.name,
                "element": entity.element,
                "kind": entity.kind,
                "id": entity.object_id,
                "components": components.collect::<Vec<_>>(),
            })
        });
        self.entities = entities.collect();
        Ok(())
    }

    fn row(&mut self, kind: DataKind, time: f64, values: &[f64]) -> Result<(), OutputError> {
        self.times.push(time);
        self.kinds.push(kind as u8);
        self.values.extend_from_slice(values);
        Ok(())
    }
}

/// Rows that are taken from the table together, so that both sides stay in the cache.
const BLOCK: usize = 64;

impl Table {
    /// Entities and their components as JSON: name, unit and place of each.
    pub(crate) fn entities(&self) -> String {
        self.entities.to_string()
    }

    /// The times, as the bytes of numbers of 64 bits.
    pub(crate) fn times<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        numbers(py, &self.times)
    }

    /// What each row belongs to, one byte each.
    pub(crate) fn kinds<'py>(&self, py: Python<'py>) -> Bound<'py, PyBytes> {
        PyBytes::new(py, &self.kinds)
    }

    /// The values, column after column.
    pub(crate) fn columns<'py>(&self, py: Python<'py>) -> PyResult<Bound<'py, PyBytes>> {
        let (width, height) = (self.width, self.times.len());
        PyBytes::new_with(py, 8 * width * height, |bytes| {
            let mut columns: Vec<_> = bytes.chunks_exact_mut(8 * height.max(1)).collect();
            for (block, rows) in self.values.chunks(BLOCK * width.max(1)).enumerate() {
                for (place, column) in columns.iter_mut().enumerate() {
                    let from = 8 * BLOCK * block;
                    for (cell, row) in column[from..].chunks_exact_mut(8).zip(rows.chunks(width)) {
                        cell.copy_from_slice(&row[place].to_ne_bytes());
                    }
                }
            }
            Ok(())
        })
    }
}

/// Numbers as the bytes that numpy reads.
pub(crate) fn numbers<'py>(py: Python<'py>, values: &[f64]) -> PyResult<Bound<'py, PyBytes>> {
    PyBytes::new_with(py, 8 * values.len(), |bytes| {
        for (cell, value) in bytes.chunks_exact_mut(8).zip(values) {
            cell.copy_from_slice(&value.to_ne_bytes());
        }
        Ok(())
    })
}

/// The numbers of an array of numpy.
pub(crate) fn values(bytes: &[u8]) -> impl Iterator<Item = f64> {
    let cells = bytes.as_chunks::<8>().0.iter();
    cells.map(|cell| f64::from_ne_bytes(*cell))
}
