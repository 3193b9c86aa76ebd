//! Reader of `.res` files (XRF XML), complete or cut off.

use crate::channels::{Component, Entity};
use quick_xml::Reader;
use quick_xml::events::{BytesStart, Event};
use std::collections::HashMap;
use std::fs::File;
use std::io::{self, BufRead, BufReader};
use std::path::Path;

/// Why a `.res` cannot be read, or has no such component.
#[derive(Debug, thiserror::Error)]
pub enum ReadError {
    /// The file system refused.
    #[error("cannot read results: {0}")]
    Io(#[from] io::Error),
    /// Not XML, or damaged in the middle.
    #[error("byte {position}: {message}")]
    Xml {
        /// Position in the file, bytes.
        position: u64,
        /// What is wrong.
        message: String,
    },
    /// No map of components.
    #[error("there is no StepMap: this is not a results file")]
    NoStepMap,
    /// A step whose values are not those the map promises.
    #[error("step {step} of {data}: {message}")]
    Step {
        /// Name of the block of data.
        data: String,
        /// Number of the step in it, from 1.
        step: usize,
        /// What is wrong.
        message: String,
    },
    /// A component that is not in the file.
    #[error("there is no component `{0}`")]
    NoComponent(String),
}

/// A block of steps, one per simulation.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct DataBlock {
    /// Name, for example `dynamic_001`.
    pub name: String,
    /// Time of each step.
    pub times: Vec<f64>,
    /// Values of all steps, one after another, without the times.
    values: Vec<f64>,
    value_count: usize,
}

impl DataBlock {
    /// Values of a step in the order of their ids, the time left out.
    ///
    /// # Panics
    /// When there is no such step.
    pub fn row(&self, step: usize) -> &[f64] {
        &self.values[step * self.value_count..(step + 1) * self.value_count]
    }

    /// Series of a column over the steps of this block.
    pub fn column(&self, column: usize) -> impl Iterator<Item = f64> + '_ {
        (0..self.times.len()).map(move |step| self.row(step)[column])
    }
}

/// A `.res` in memory.
#[derive(Debug, Clone, PartialEq, Default)]
pub struct ResFile {
    /// Title of the model.
    pub title: String,
    /// Program that wrote it.
    pub solver: String,
    /// Unit of time.
    pub time_unit: String,
    /// Entities in the order of the file, the time left out.
    pub entities: Vec<Entity>,
    /// Blocks of steps in the order of the file.
    pub data: Vec<DataBlock>,
    /// Status of the run, `None` where the file ends before.
    pub status: Option<String>,
    /// Column of each component of each entity.
    columns: Vec<Vec<usize>>,
    by_name: HashMap<String, usize>,
    value_count: usize,
}

impl ResFile {
    /// Reads a file.
    ///
    /// A file that was cut off gives its complete steps and no [`status`](Self::status).
    ///
    /// # Errors
    /// [`ReadError`].
    pub fn read(path: impl AsRef<Path>) -> Result<Self, ReadError> {
        Self::from_reader(BufReader::new(File::open(path)?))
    }

    /// Reads from anything; otherwise as [`read`](Self::read).
    ///
    /// # Errors
    /// [`ReadError`].
    pub fn from_reader(input: impl BufRead) -> Result<Self, ReadError> {
        let mut reader = Reader::from_reader(input);
        let mut parser = Parser::default();
        let mut buffer = Vec::new();
        loop {
            buffer.clear();
            match reader.read_event_into(&mut buffer) {
                Ok(Event::Eof) => break,
                Ok(event) => parser.event(&event, reader.buffer_position())?,
                Err(quick_xml::Error::Io(error)) => {
                    return Err(io::Error::new(error.kind(), error.to_string()).into());
                }
                // A tag that the file ends in: it was cut off there.
                Err(quick_xml::Error::Syntax(_)) if parser.has_map => break,
                Err(error) => {
                    let position = reader.error_position();
                    return Err(ReadError::Xml {
                        position,
                        message: error.to_string(),
                    });
                }
            }
        }
        if parser.has_map {
            Ok(parser.file)
        } else {
            Err(ReadError::NoStepMap)
        }
    }

    /// Column of a component by its full name: `ENTITY.COMPONENT`, where the entity is named by its
    /// result set (`PART_2_XFORM`) or by its element.
    pub fn column(&self, name: &str) -> Option<usize> {
        self.by_name.get(name).copied()
    }

    /// Column of an entity's component, both by position.
    ///
    /// # Panics
    /// When there is no such entity or component.
    pub fn column_of(&self, entity: usize, component: usize) -> usize {
        self.columns[entity][component]
    }

    /// Series of a component over all steps of all blocks; `time.TIME` is the time.
    ///
    /// # Errors
    /// [`ReadError::NoComponent`].
    pub fn get(&self, name: &str) -> Result<Vec<f64>, ReadError> {
        if name == "time.TIME" {
            return Ok(self
                .data
                .iter()
                .flat_map(|block| block.times.iter().copied())
                .collect());
        }
        let column = self
            .column(name)
            .ok_or_else(|| ReadError::NoComponent(name.into()))?;
        Ok(self
            .data
            .iter()
            .flat_map(|block| block.column(column))
            .collect())
    }

    /// The block of that name, for example `dynamic_001`.
    pub fn block(&self, name: &str) -> Option<&DataBlock> {
        self.data.iter().find(|block| block.name == name)
    }
}

/// Where the parser is.
#[derive(Default)]
struct Parser {
    file: ResFile,
    has_map: bool,
    /// Text of the step being read.
    step: Option<String>,
}

impl Parser {
    fn event(&mut self, event: &Event<'_>, position: u64) -> Result<(), ReadError> {
        match event {
            Event::Start(tag) | Event::Empty(tag) => self
                .start(tag)
                .map_err(|message| ReadError::Xml { position, message }),
            Event::Text(text) => {
                if let Some(step) = &mut self.step {
                    step.push_str(text);
                }
                Ok(())
            }
            Event::End(tag) => match tag.local_name().as_ref() {
                "StepMap" => {
                    self.has_map = true;
                    self.finish_map()
                        .map_err(|message| ReadError::Xml { position, message })
                }
                "Step" => self.finish_step(),
                _ => Ok(()),
            },
            _ => Ok(()),
        }
    }

    fn start(&mut self, tag: &BytesStart<'_>) -> Result<(), String> {
        match tag.local_name().as_ref() {
            "Analysis" => self.file.solver = attribute(tag, "Solver")?.unwrap_or_default(),
            "ModelInfo" => self.file.title = attribute(tag, "title")?.unwrap_or_default(),
            "TerminationStatus" => self.file.status = attribute(tag, "runStatus")?,
            "Entity" => {
                let object_id = attribute(tag, "objectId")?;
                self.file.columns.push(Vec::new());
                self.file.entities.push(Entity {
                    name: attribute(tag, "name")?.ok_or("an entity without a name")?,
                    element: attribute(tag, "entity")?,
                    kind: attribute(tag, "entType")?.unwrap_or_default(),
                    object_id: object_id.and_then(|id| id.parse().ok()),
                    components: Vec::new(),
                });
            }
            "Component" => {
                let id = attribute(tag, "id")?.and_then(|id| id.parse::<usize>().ok());
                let id = id
                    .filter(|&id| id > 0)
                    .ok_or("a component without an id from 1 on")?;
                let (Some(entity), Some(columns)) =
                    (self.file.entities.last_mut(), self.file.columns.last_mut())
                else {
                    return Err("a component outside of an entity".into());
                };
                columns.push(id);
                entity.components.push(Component {
                    name: attribute(tag, "name")?.ok_or("a component without a name")?,
                    unit: attribute(tag, "unitsValue")?.unwrap_or_default(),
                    label: attribute(tag, "plotLabel")?,
                });
            }
            "Data" => self.file.data.push(DataBlock {
                name: attribute(tag, "name")?.unwrap_or_default(),
                value_count: self.file.value_count,
                ..DataBlock::default()
            }),
            "Step" => self.step = Some(String::new()),
            _ => {}
        }
        Ok(())
    }

    /// Turns ids (from 1, the time among them) into columns (from 0, without the time).
    fn finish_map(&mut self) -> Result<(), String> {
        let file = &mut self.file;
        let count = file.columns.iter().map(Vec::len).sum::<usize>();
        let mut seen = vec![false; count];
        for &id in file.columns.iter().flatten() {
            match seen.get_mut(id - 1) {
                Some(seen) if !*seen => *seen = true,
                _ => return Err(format!("component id {id} is used twice or beyond {count}")),
            }
        }
        if file.columns.first().map(Vec::as_slice) != Some(&[1]) {
            return Err("the first entity is not the time with id 1".into());
        }
        let time = file.entities.remove(0);
        file.time_unit = time.components.into_iter().map(|c| c.unit).collect();
        file.columns.remove(0);
        file.value_count = count - 1;
        for columns in &mut file.columns {
            for column in columns {
                *column -= 2;
            }
        }
        for by_element in [false, true] {
            for (entity, columns) in file.entities.iter().zip(&file.columns) {
                let Some(name) = (if by_element {
                    entity.element.as_ref()
                } else {
                    Some(&entity.name)
                }) else {
                    continue;
                };
                for (component, &column) in entity.components.iter().zip(columns) {
                    file.by_name
                        .entry(format!("{name}.{}", component.name))
                        .or_insert(column);
                }
            }
        }
        Ok(())
    }

    fn finish_step(&mut self) -> Result<(), ReadError> {
        let Some(text) = self.step.take() else {
            return Ok(());
        };
        let Some(block) = self.file.data.last_mut() else {
            return Ok(());
        };
        let step = block.times.len() + 1;
        let error = |message| ReadError::Step {
            data: block.name.clone(),
            step,
            message,
        };
        let mut numbers = Vec::with_capacity(block.value_count + 1);
        for word in text.split_ascii_whitespace() {
            match word.parse::<f64>() {
                Ok(value) if value.is_finite() => numbers.push(value),
                _ => return Err(error(format!("`{word}` is not a finite number"))),
            }
        }
        let expected = block.value_count + 1;
        if numbers.len() != expected {
            return Err(error(format!(
                "{} numbers instead of {expected}",
                numbers.len()
            )));
        }
        block.times.push(numbers[0]);
        block.values.extend_from_slice(&numbers[1..]);
        Ok(())
    }
}

/// Value of an attribute, its entities resolved.
fn attribute(tag: &BytesStart<'_>, name: &str) -> Result<Option<String>, String> {
    let attribute = tag
        .try_get_attribute(name)
        .map_err(|error| error.to_string())?;
    attribute
        .map(|attribute| {
            quick_xml::escape::unescape(&attribute.value)
                .map(String::from)
                .map_err(|error| error.to_string())
        })
        .transpose()
}
