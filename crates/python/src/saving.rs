//! Results that are in memory as tables on disk.

use std::path::PathBuf;

use columnar::Tables;
use pyo3::exceptions::PyValueError;
use pyo3::prelude::*;
use serde_json::Value;
use stiction::OutputError;
use stiction::sink::{Component, DataKind, Entity, Header, Layout, Sink, UnitNames};

use crate::project::output_failure;
use crate::table::values;

/// Writes the table of a result into a folder, which must exist: entities as JSON, times, kinds and columns
/// as a run hands them over, title and unit of time of the model.
#[pyfunction]
pub(crate) fn save(
    py: Python<'_>,
    folder: PathBuf,
    formats: Vec<String>,
    table: (String, Vec<u8>, Vec<u8>, Vec<u8>),
    title: String,
    time_unit: String,
    facts: Vec<(String, String)>,
) -> PyResult<()> {
    let (entities, times, kinds, columns) = table;
    let wrong = || PyValueError::new_err("this is not the table of a result");
    let (layout, places) = layout(&entities).ok_or_else(wrong)?;
    let count = kinds.len();
    if times.len() != 8 * count || columns.len() != 8 * count * places.len() {
        return Err(wrong());
    }
    let kinds: Option<Vec<DataKind>> = kinds
        .into_iter()
        .map(|kind| DataKind::ALL.get(usize::from(kind)).copied())
        .collect();
    let kinds = kinds.ok_or_else(wrong)?;
    let header = Header {
        title,
        units: UnitNames {
            time: time_unit,
            ..UnitNames::default()
        },
        ..Header::default()
    };
    let written = py.detach(|| -> Result<(), OutputError> {
        let mut tables = Tables::new(&folder, crate::run::of_tables(&formats));
        tables.begin(&header, &layout)?;
        let columns: Vec<f64> = values(&columns).collect();
        let mut row = Vec::with_capacity(places.len());
        for (number, (time, kind)) in values(&times).zip(kinds).enumerate() {
            row.clear();
            row.extend(places.iter().map(|place| columns[place * count + number]));
            tables.row(kind, time, &row)?;
        }
        let facts: Vec<_> = facts
            .iter()
            .map(|(name, fact)| (&**name, fact.clone()))
            .collect();
        tables.finish(&facts)?;
        Ok(())
    });
    written.map_err(output_failure)
}

/// The layout of entities one after another, and the place of each of its values among the columns.
fn layout(entities: &str) -> Option<(Layout, Vec<usize>)> {
    let entities: Value = serde_json::from_str(entities).ok()?;
    let mut layout = Layout::new();
    let mut places = Vec::new();
    for said in entities.as_array()? {
        let mut components = Vec::new();
        for component in said["components"].as_array()? {
            let text = |place: usize| component[place].as_str();
            components.push(Component::new(text(0)?, text(1)?));
            places.push(usize::try_from(component[2].as_u64()?).ok()?);
        }
        layout.push(Entity {
            name: said["name"].as_str()?.to_owned(),
            element: said["element"].as_str().map(str::to_owned),
            kind: said["kind"].as_str()?.to_owned(),
            object_id: said["id"].as_u64().and_then(|id| id.try_into().ok()),
            components,
        });
    }
    let count = places.len();
    places
        .iter()
        .all(|place| *place < count)
        .then_some((layout, places))
}
