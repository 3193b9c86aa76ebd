//! A table that is filled row by row and written in batches, in several formats at once.

use std::path::{Path, PathBuf};

use parquet::data_type::ByteArray;
use stiction::{OutputError, unfinished};

use crate::Format;
use crate::csv::CsvFile;
use crate::parquet_file::ParquetFile;

/// Values of a table that are kept before they are written.
const BATCH: usize = 1 << 20;

/// What a column holds.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Kind {
    Double,
    /// Numbers of which some may be missing.
    Optional,
    Integer,
    Long,
    Boolean,
    Text,
}

/// Name and kind of a column.
pub(crate) struct Heading {
    pub(crate) name: String,
    pub(crate) kind: Kind,
}

impl Heading {
    pub(crate) fn new(name: &str, kind: Kind) -> Self {
        Self {
            name: name.to_owned(),
            kind,
        }
    }
}

/// Values of a column.
#[derive(Clone, Debug, PartialEq)]
pub enum Values {
    /// Numbers.
    Double(Vec<f64>),
    /// Numbers of which some are missing.
    Optional(Vec<Option<f64>>),
    /// Whole numbers of 32 bits.
    Integer(Vec<i32>),
    /// Whole numbers of 64 bits.
    Long(Vec<i64>),
    /// Truth values.
    Boolean(Vec<bool>),
    /// Texts in UTF-8.
    Text(Vec<ByteArray>),
}

impl Values {
    pub(crate) fn new(kind: Kind) -> Self {
        match kind {
            Kind::Double => Self::Double(Vec::new()),
            Kind::Optional => Self::Optional(Vec::new()),
            Kind::Integer => Self::Integer(Vec::new()),
            Kind::Long => Self::Long(Vec::new()),
            Kind::Boolean => Self::Boolean(Vec::new()),
            Kind::Text => Self::Text(Vec::new()),
        }
    }

    pub(crate) fn kind(&self) -> Kind {
        match self {
            Self::Double(_) => Kind::Double,
            Self::Optional(_) => Kind::Optional,
            Self::Integer(_) => Kind::Integer,
            Self::Long(_) => Kind::Long,
            Self::Boolean(_) => Kind::Boolean,
            Self::Text(_) => Kind::Text,
        }
    }

    fn clear(&mut self) {
        *self = Self::new(self.kind());
    }
}

/// A file of a table.
pub(crate) trait TableFile {
    /// Writes rows.
    fn batch(&mut self, columns: &[Values], rows: usize) -> Result<(), String>;
    /// Ends it, with facts about the run.
    fn finish(self: Box<Self>, facts: &[(String, String)]) -> Result<(), String>;
}

/// A table with its files.
pub(crate) struct Table {
    columns: Vec<Values>,
    rows: usize,
    /// Rows of a batch.
    most: usize,
    /// Each with the name that it gets in the end.
    files: Vec<(PathBuf, Box<dyn TableFile>)>,
}

impl Table {
    /// Creates the files of a table.
    pub(crate) fn create(
        folder: &Path,
        name: &str,
        formats: &[Format],
        headings: Vec<Heading>,
    ) -> Result<Self, OutputError> {
        let mut files = Vec::new();
        for format in formats {
            let extension = match format {
                Format::Parquet => "parquet",
                Format::Csv => "csv",
            };
            let path = folder.join(format!("{name}.{extension}"));
            let created = std::fs::File::create(unfinished(&path));
            let file = created.map_err(|error| OutputError::at(&path, &error))?;
            let begun: Result<Box<dyn TableFile>, String> = match format {
                Format::Parquet => {
                    ParquetFile::new(file, &headings).map(|file| Box::new(file) as _)
                }
                Format::Csv => CsvFile::new(file, &headings).map(|file| Box::new(file) as _),
            };
            let begun = begun.map_err(|cause| OutputError::at(&path, &cause))?;
            files.push((path, begun));
        }
        let columns = headings.iter().map(|heading| Values::new(heading.kind));
        Ok(Self {
            columns: columns.collect(),
            rows: 0,
            most: (BATCH / headings.len()).max(1),
            files,
        })
    }

    pub(crate) fn double(&mut self, column: usize, value: f64) {
        if let Values::Double(values) = &mut self.columns[column] {
            values.push(value);
        }
    }

    pub(crate) fn integer(&mut self, column: usize, value: i32) {
        if let Values::Integer(values) = &mut self.columns[column] {
            values.push(value);
        }
    }

    pub(crate) fn text(&mut self, column: usize, value: &ByteArray) {
        if let Values::Text(values) = &mut self.columns[column] {
            values.push(value.clone());
        }
    }

    /// Counts a row whose columns are filled; writes a batch where it is full.
    pub(crate) fn end_of_row(&mut self) -> Result<(), OutputError> {
        self.rows += 1;
        if self.rows == self.most {
            self.write()?;
        }
        Ok(())
    }

    fn write(&mut self) -> Result<(), OutputError> {
        for (path, file) in &mut self.files {
            let written = file.batch(&self.columns, self.rows);
            written.map_err(|cause| OutputError::at(path, &cause))?;
        }
        self.columns.iter_mut().for_each(Values::clear);
        self.rows = 0;
        Ok(())
    }

    /// Writes the rest, ends the files and gives them their names.
    pub(crate) fn finish(
        mut self,
        facts: &[(String, String)],
    ) -> Result<Vec<PathBuf>, OutputError> {
        if self.rows > 0 {
            self.write()?;
        }
        let mut paths = Vec::new();
        for (path, file) in self.files {
            let ended = file.finish(facts);
            ended.map_err(|cause| OutputError::at(&path, &cause))?;
            let named = std::fs::rename(unfinished(&path), &path);
            named.map_err(|error| OutputError::at(&path, &error))?;
            paths.push(path);
        }
        Ok(paths)
    }
}
