//! Writer of `.res` files (XRF 2.0 XML), one step at a time.

use crate::channels::{Component, Entity};
use crate::layout::Layout;
use crate::number::push_shortest;
use crate::units::UnitNames;
use serde::{Deserialize, Serialize};
use std::fmt::Write as _;
use std::io::{self, Write};

/// What a block of steps holds.
#[derive(Debug, Clone, Copy, PartialEq, Eq, Serialize, Deserialize)]
pub enum DataKind {
    /// The model as given (`modelInput`).
    ModelInput,
    /// After assembly (`initialConditions`).
    InitialConditions,
    /// A static equilibrium.
    Static,
    /// A sequence of equilibria (`quasiStatic`).
    QuasiStatic,
    /// A dynamic simulation; its start time is not repeated.
    Dynamic,
    /// A kinematic simulation.
    Kinematic,
}

impl DataKind {
    const COUNT: usize = 6;
    /// All of them in the order of their numbers, as in `DataKind::Dynamic as usize`.
    pub const ALL: [Self; Self::COUNT] = [
        Self::ModelInput,
        Self::InitialConditions,
        Self::Static,
        Self::QuasiStatic,
        Self::Dynamic,
        Self::Kinematic,
    ];

    /// Its name, in a `.res` before the number of the block: `initialConditions`, `dynamic`, ...
    #[must_use]
    pub const fn name(self) -> &'static str {
        match self {
            Self::ModelInput => "modelInput",
            Self::InitialConditions => "initialConditions",
            Self::Static => "static",
            Self::QuasiStatic => "quasiStatic",
            Self::Dynamic => "dynamic",
            Self::Kinematic => "kinematic",
        }
    }

    /// Type of its steps.
    fn step_type(self) -> &'static str {
        match self {
            Self::ModelInput => "input",
            other => other.name(),
        }
    }
}

/// What the head of a `.res` says.
#[derive(Debug, Clone, PartialEq)]
pub struct Header {
    /// Title of the model.
    pub title: String,
    /// Name of the analysis.
    pub analysis: String,
    /// Name of the program.
    pub program: String,
    /// Version of the program.
    pub version: String,
    /// Date and time, `2026-01-31 12:00:00`, UTC; `None` keeps files of equal runs equal.
    pub date: Option<String>,
    /// Units of the model.
    pub units: UnitNames,
}

impl Default for Header {
    fn default() -> Self {
        Self {
            title: String::new(),
            analysis: "ANALYSIS_01".into(),
            program: "stiction".into(),
            version: env!("CARGO_PKG_VERSION").into(),
            date: None,
            units: UnitNames::default(),
        }
    }
}

/// Why a `.res` cannot be written on.
#[derive(Debug, thiserror::Error)]
pub enum WriteError {
    /// The file system refused.
    #[error("cannot write results: {0}")]
    Io(#[from] io::Error),
    /// A value that is no number: nothing of its step is written.
    #[error("{component} is {value} at time {time}")]
    NotFinite {
        /// Full name of the component, or `time`.
        component: String,
        /// The value.
        value: f64,
        /// Time of the step.
        time: f64,
    },
    /// A step of another length than the layout's.
    #[error("a step has {given} values, the layout {expected}")]
    ValueCount {
        /// Number of values given.
        given: usize,
        /// Number of values of the layout.
        expected: usize,
    },
    /// A step before any block was begun.
    #[error("a step outside of a block of data")]
    OutsideData,
}

/// Streaming writer of a `.res`: each step is on its way to the file when [`step`](Self::step)
/// returns.
#[derive(Debug)]
pub struct ResWriter<W: Write> {
    out: W,
    layout: Layout,
    /// Text of one step, kept to reuse its memory.
    text: String,
    blocks: Blocks,
}

/// How far a `.res` is written: what it takes, beside the file, to write on.
#[derive(Debug, Clone, Copy, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Blocks {
    open: Option<DataKind>,
    count: usize,
    of_kind: [usize; DataKind::COUNT],
}

const UNKNOWN: &str = "-unknown-";

impl<W: Write> ResWriter<W> {
    /// Writes the head and the map of components.
    ///
    /// # Errors
    /// [`WriteError::Io`].
    pub fn new(mut out: W, header: &Header, layout: Layout) -> Result<Self, WriteError> {
        let mut text = String::new();
        push_head(&mut text, header);
        for (k, entity) in layout.entities().iter().enumerate() {
            push_entity(&mut text, entity, |component| {
                layout.column(k, component) + 2
            });
        }
        text.push_str("</StepMap>\n");
        out.write_all(text.as_bytes())?;
        out.flush()?;
        text.clear();
        Ok(Self {
            out,
            layout,
            text,
            blocks: Blocks::default(),
        })
    }

    /// Writes on, behind a head and `blocks` that another writer of the same layout has written.
    pub fn append(out: W, layout: Layout, blocks: Blocks) -> Self {
        let text = String::new();
        Self {
            out,
            layout,
            text,
            blocks,
        }
    }

    /// How far it has written.
    pub fn blocks(&self) -> Blocks {
        self.blocks
    }

    /// What it writes to.
    pub fn get_ref(&self) -> &W {
        &self.out
    }

    /// The layout given.
    pub fn layout(&self) -> &Layout {
        &self.layout
    }

    /// Begins a block of steps, one per simulation, ending the one before.
    ///
    /// # Errors
    /// [`WriteError::Io`].
    pub fn begin_data(&mut self, kind: DataKind) -> Result<(), WriteError> {
        self.end_data()?;
        self.blocks.count += 1;
        let number = &mut self.blocks.of_kind[kind as usize];
        *number += 1;
        writeln!(
            self.out,
            "<Data name=\"{}_{number:03}\" id=\"{}\">",
            kind.name(),
            self.blocks.count
        )?;
        self.blocks.open = Some(kind);
        Ok(())
    }

    /// Writes a step: the time and the values in the order of the layout.
    ///
    /// # Errors
    /// A value that is not finite, a wrong number of values, no block begun, or the file system.
    /// The step is then not written and the file stays well-formed.
    pub fn step(&mut self, time: f64, values: &[f64]) -> Result<(), WriteError> {
        let Some(kind) = self.blocks.open else {
            return Err(WriteError::OutsideData);
        };
        let expected = self.layout.value_count();
        if values.len() != expected {
            return Err(WriteError::ValueCount {
                given: values.len(),
                expected,
            });
        }
        if !time.is_finite() {
            return Err(WriteError::NotFinite {
                component: "time".into(),
                value: time,
                time,
            });
        }
        if let Some(column) = values.iter().position(|value| !value.is_finite()) {
            let component = self.layout.name_of(column).unwrap_or_default();
            return Err(WriteError::NotFinite {
                component,
                value: values[column],
                time,
            });
        }
        let text = &mut self.text;
        text.clear();
        let _ = writeln!(text, "<Step type=\"{}\">", kind.step_type());
        push_shortest(text, time);
        text.push('\n');
        let mut rest = values;
        for &count in self.layout.lines() {
            let (line, after) = rest.split_at(count);
            rest = after;
            for (k, &value) in line.iter().enumerate() {
                if k > 0 {
                    text.push(' ');
                }
                push_shortest(text, value);
            }
            text.push('\n');
        }
        text.push_str("</Step>\n");
        self.out.write_all(text.as_bytes())?;
        self.out.flush()?;
        Ok(())
    }

    /// Ends the open block, if there is one.
    ///
    /// # Errors
    /// [`WriteError::Io`].
    pub fn end_data(&mut self) -> Result<(), WriteError> {
        if self.blocks.open.take().is_some() {
            self.out.write_all(b"</Data>\n")?;
            self.out.flush()?;
        }
        Ok(())
    }

    /// Ends the file with the status of the run, `Successful` or what else became of it, and
    /// returns what was written to.
    ///
    /// # Errors
    /// [`WriteError::Io`].
    pub fn finish(mut self, status: &str) -> Result<W, WriteError> {
        self.end_data()?;
        let status = escaped(status);
        writeln!(
            self.out,
            "<TerminationStatus runTermObject=\"\" runStatus=\"{status}\" />"
        )?;
        self.out.write_all(b"</Analysis>\n</Results>\n")?;
        self.out.flush()?;
        Ok(self.out)
    }
}

/// Text of an attribute's value; characters that XML cannot hold become `?`.
fn escaped(text: &str) -> String {
    let mut safe = String::with_capacity(text.len());
    for c in text.chars() {
        match c {
            '&' => safe.push_str("&amp;"),
            '<' => safe.push_str("&lt;"),
            '>' => safe.push_str("&gt;"),
            '"' => safe.push_str("&quot;"),
            '\t' | '\n' | '\r' => safe.push(' '),
            '\u{0}'..='\u{1f}' | '\u{fffe}' | '\u{ffff}' => safe.push('?'),
            other => safe.push(other),
        }
    }
    safe
}

fn push_head(text: &mut String, header: &Header) {
    let Header { units, .. } = header;
    let [title, analysis, program, version] = [
        &header.title,
        &header.analysis,
        &header.program,
        &header.version,
    ]
    .map(|s| escaped(s));
    let date = escaped(header.date.as_deref().unwrap_or(UNKNOWN));
    let zone = if header.date.is_some() { "+00:00" } else { "" };
    let [angle, length, mass, time] =
        [&units.angle, &units.length, &units.mass, &units.time].map(|s| escaped(s));
    let system = std::env::consts::OS;
    // Writing to a string cannot fail.
    let _ = write!(
        text,
        r#"<?xml version="1.0" encoding="UTF-8"?>
<Results xmlns="http://www.mscsoftware.com/:xrf10">
<Bibliography>
<File URI="file://results.res" schema="xrf" version="2.0.0.0" publicationDate="{date}{zone}" />
<Corporation author="{program}" URI="{UNKNOWN}" />
<Author user="{UNKNOWN}" name="{UNKNOWN}" />
<Revision version="1" derivedFrom="{UNKNOWN}">
<Comment>

</Comment>
</Revision>
</Bibliography>
<Analysis name="{analysis}" executionDate="{date}" Solver="{program} {version}"  script="{UNKNOWN}">
<Bibliography>
<Environment operatingSystem="{system}" hostname="{UNKNOWN}" />
<Application name="{program}" version="{version}" />
</Bibliography>
<ModelInfo title="{title}" creationDate="{UNKNOWN}" checksum="{UNKNOWN}" />
<Units angle="{angle}" length="{length}" mass="{mass}" time="{time}" />
<StepMap name="map_001">
<Entity name="time">
<Component name="TIME" unitsValue="{time}" id="1" />
</Entity>
"#
    );
}

fn push_entity(text: &mut String, entity: &Entity, id: impl Fn(usize) -> usize) {
    let _ = write!(text, "<Entity name=\"{}\"", escaped(&entity.name));
    if let Some(element) = &entity.element {
        let _ = write!(text, " entity=\"{}\"", escaped(element));
    }
    if !entity.kind.is_empty() {
        let _ = write!(text, " entType=\"{}\"", escaped(&entity.kind));
    }
    if let Some(object_id) = entity.object_id {
        let _ = write!(text, " objectId=\"{object_id}\"");
    }
    text.push_str(">\n");
    for (k, Component { name, unit, label }) in entity.components.iter().enumerate() {
        let _ = write!(text, "<Component name=\"{}\"", escaped(name));
        if !unit.is_empty() {
            let _ = write!(text, " unitsValue=\"{}\"", escaped(unit));
        }
        if let Some(label) = label {
            let _ = write!(text, " plotLabel=\"{}\"", escaped(label));
        }
        let _ = writeln!(text, " id=\"{}\" />", id(k));
    }
    text.push_str("</Entity>\n");
}
