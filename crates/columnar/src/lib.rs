//! Results of simulations as tables, written while a simulation runs: Parquet and CSV.
//!
//! | table | columns | a row |
//! |---|---|---|
//! | `friction` | `time`, `friction` (id), `name`, `channel`, `value`, `unit` | one channel of one friction at one time |
//! | `states` | `time`, `analysis`, one for each other channel by its name in the `.res` | one time |
//!
//! What the tables are of is told in the metadata of a Parquet file, and for CSV in `tables.json`
//! beside it: title, units by column, and what the caller adds. A file that is being written ends in
//! `.part` and gets its name once it is whole.
//!
//! A table that is there as a whole is written and read by [`write()`] and [`read()`].
//!
//! ```
//! use columnar::{Format, Tables};
//! use stiction::sink::{DataKind, Header, Layout, Sink};
//!
//! let folder = tempfile::tempdir()?;
//! let mut tables = Tables::new(folder.path(), vec![Format::Csv]);
//! tables.begin(&Header::default(), &Layout::new())?;
//! tables.row(DataKind::Dynamic, 0.5, &[])?;
//! tables.finish(&[("model", "of nothing".to_owned())])?;
//! let states = std::fs::read_to_string(folder.path().join("states.csv"))?;
//! assert_eq!(states, "time,analysis\n0.5,dynamic\n");
//! # Ok::<(), Box<dyn std::error::Error>>(())
//! ```

mod csv;
mod parquet_file;
mod table;
mod whole;

use std::path::{Path, PathBuf};

use parquet::data_type::ByteArray;
use serde_json::{Map, Value, json};
use stiction::sink::{DataKind, Header, Layout, Sink};
use stiction::{OutputError, write_whole};

pub use crate::table::Values;
use crate::table::{Heading, Kind, Table};
pub use crate::whole::{Column, WholeTable, read, write};

/// A format of tables.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Format {
    /// Apache Parquet with a row group for about a million values.
    Parquet,
    /// Comma separated values, RFC 4180.
    Csv,
}

/// A channel of a friction.
struct FrictionChannel {
    id: i32,
    name: ByteArray,
    channel: ByteArray,
    unit: ByteArray,
    place: usize,
}

/// The tables of a run.
pub struct Tables {
    folder: PathBuf,
    formats: Vec<Format>,
    open: Option<Open>,
}

/// Tables that are being written.
struct Open {
    states: Table,
    frictions: Table,
    state_places: Vec<usize>,
    friction_channels: Vec<FrictionChannel>,
    facts: Vec<(String, String)>,
}

impl Tables {
    /// Tables in a folder, which must exist. Nothing is written before the first row.
    #[must_use]
    pub fn new(folder: &Path, formats: Vec<Format>) -> Self {
        Self {
            folder: folder.to_owned(),
            formats,
            open: None,
        }
    }

    /// Whether there is nothing to write.
    #[must_use]
    pub fn is_empty(&self) -> bool {
        self.formats.is_empty()
    }

    /// Writes the rest and gives the files their names; `facts` about the run go into the metadata.
    /// Returns the files.
    ///
    /// # Errors
    /// Files that cannot be written.
    pub fn finish(self, facts: &[(&str, String)]) -> Result<Vec<PathBuf>, OutputError> {
        let Some(mut open) = self.open else {
            return Ok(Vec::new());
        };
        let more = facts.iter();
        open.facts
            .extend(more.map(|(name, fact)| ((*name).to_owned(), fact.clone())));
        let mut files = open.frictions.finish(&open.facts)?;
        files.extend(open.states.finish(&open.facts)?);
        if self.formats.contains(&Format::Csv) {
            let path = self.folder.join("tables.json");
            let facts = open.facts.into_iter();
            let facts: Map<String, Value> = facts.map(|(k, fact)| (k, fact.into())).collect();
            let text = format!("{:#}\n", Value::Object(facts));
            let written = write_whole(&path, |part| std::fs::write(part, text));
            written.map_err(|error| OutputError::at(&path, &error))?;
            files.push(path);
        }
        Ok(files)
    }
}

/// The types of the entities that the table of frictions is made of.
const FRICTION_KINDS: [&str; 2] = ["Friction", "Stiction_Friction"];

impl Sink for Tables {
    fn begin(&mut self, header: &Header, layout: &Layout) -> Result<(), OutputError> {
        let mut states = vec![
            Heading::new("time", Kind::Double),
            Heading::new("analysis", Kind::Text),
        ];
        let mut units = Map::new();
        units.insert("time".into(), json!(header.units.time));
        let mut state_places = Vec::new();
        let mut friction_channels = Vec::new();
        for (entity, described) in layout.entities().iter().enumerate() {
            let of_friction = FRICTION_KINDS.contains(&described.kind.as_str());
            let element = described.element.as_ref().unwrap_or(&described.name);
            for (component, column) in described.components.iter().enumerate() {
                let place = layout.column(entity, component);
                if of_friction {
                    friction_channels.push(FrictionChannel {
                        id: described.object_id.unwrap_or(0).cast_signed(),
                        name: element.as_str().into(),
                        channel: column.name.as_str().into(),
                        unit: column.unit.as_str().into(),
                        place,
                    });
                } else {
                    let name = format!("{}.{}", described.name, column.name);
                    units.insert(name.clone(), json!(column.unit));
                    states.push(Heading::new(&name, Kind::Double));
                    state_places.push(place);
                }
            }
        }
        let frictions = vec![
            Heading::new("time", Kind::Double),
            Heading::new("friction", Kind::Integer),
            Heading::new("name", Kind::Text),
            Heading::new("channel", Kind::Text),
            Heading::new("value", Kind::Double),
            Heading::new("unit", Kind::Text),
        ];
        self.open = Some(Open {
            states: Table::create(&self.folder, "states", &self.formats, states)?,
            frictions: Table::create(&self.folder, "friction", &self.formats, frictions)?,
            state_places,
            friction_channels,
            facts: vec![
                ("title".to_owned(), header.title.clone()),
                ("units".to_owned(), Value::Object(units).to_string()),
            ],
        });
        Ok(())
    }

    fn row(&mut self, kind: DataKind, time: f64, values: &[f64]) -> Result<(), OutputError> {
        let Some(open) = &mut self.open else {
            return Ok(());
        };
        let states = &mut open.states;
        states.double(0, time);
        states.text(1, &kind.name().into());
        for (column, place) in open.state_places.iter().enumerate() {
            states.double(2 + column, values[*place]);
        }
        states.end_of_row()?;
        for channel in &open.friction_channels {
            let table = &mut open.frictions;
            table.double(0, time);
            table.integer(1, channel.id);
            table.text(2, &channel.name);
            table.text(3, &channel.channel);
            table.double(4, values[channel.place]);
            table.text(5, &channel.unit);
            table.end_of_row()?;
        }
        Ok(())
    }
}

/// Removes what another run has left in a folder: its tables and its record, and its `.res` and `.req`
/// where the run of this prefix has no `text_results` to put in their place. Beside the files of a new run
/// they would be taken for parts of it.
///
/// # Errors
/// Files that cannot be removed.
pub fn clear(folder: &Path, prefix: &str, text_results: bool) -> Result<(), OutputError> {
    let others = [
        "friction.parquet",
        "friction.csv",
        "states.parquet",
        "states.csv",
        "tables.json",
        "run.json",
    ];
    let [res, req] = ["res", "req"].map(|kind| format!("{prefix}.{kind}"));
    let texts = [res.as_str(), req.as_str()];
    let texts = texts.into_iter().filter(|_| !text_results);
    for name in others.into_iter().chain(texts) {
        let path = folder.join(name);
        match std::fs::remove_file(&path) {
            Err(error) if error.kind() != std::io::ErrorKind::NotFound => {
                return Err(OutputError::at(&path, &error));
            }
            _ => {}
        }
    }
    Ok(())
}
