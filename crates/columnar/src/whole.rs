//! Tables that are written and read as a whole, as Parquet files.

use std::fs::File;
use std::io;
use std::path::Path;

use parquet::column::reader::{ColumnReader, ColumnReaderImpl};
use parquet::data_type::DataType;
use parquet::errors::ParquetError;
use parquet::file::reader::{FileReader, SerializedFileReader};
use stiction::{OutputError, write_whole};

use crate::parquet_file::ParquetFile;
use crate::table::{Heading, TableFile, Values};

/// A column of a table.
#[derive(Clone, Debug, PartialEq)]
pub struct Column {
    /// Its name.
    pub name: String,
    /// Its values, as many as those of the other columns.
    pub values: Values,
}

/// A table with what is said of it in its metadata.
#[derive(Clone, Debug, PartialEq)]
pub struct WholeTable {
    /// In their order.
    pub columns: Vec<Column>,
    /// Names without the prefix `stiction.` that they have in the file.
    pub facts: Vec<(String, String)>,
}

/// Writes a table to a Parquet file, which is there as a whole or not at all: it is written under
/// another name (`.part`), brought to the disk and gets its own then.
///
/// ```
/// use columnar::{Column, Values, WholeTable};
/// let column = Column { name: "peak".into(), values: Values::Optional(vec![Some(2.5), None]) };
/// let table = WholeTable { columns: vec![column], facts: vec![("title".into(), "two".into())] };
/// let folder = tempfile::tempdir()?;
/// let path = folder.path().join("peaks.parquet");
/// columnar::write(&path, &table)?;
/// assert_eq!(columnar::read(&path)?, table);
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
///
/// # Errors
/// A file that cannot be written, on a full disk for instance.
pub fn write(path: &Path, table: &WholeTable) -> Result<(), OutputError> {
    let headings = table.columns.iter();
    let headings: Vec<_> = headings
        .map(|c| Heading::new(&c.name, c.values.kind()))
        .collect();
    let values: Vec<_> = table.columns.iter().map(|c| c.values.clone()).collect();
    let fill = |file| -> Result<(), String> {
        let mut file = ParquetFile::new(file, &headings)?;
        file.batch(&values, 0)?;
        Box::new(file).finish(&table.facts)
    };
    write_whole(path, |part| {
        fill(File::create(part)?).map_err(io::Error::other)
    })
    .and_then(|()| sync_folder(path))
    .map_err(|error| OutputError::at(path, &error))
}

/// Brings the names of a folder to the disk.
fn sync_folder(path: &Path) -> std::io::Result<()> {
    match path.parent() {
        Some(folder) if cfg!(unix) && !folder.as_os_str().is_empty() => {
            File::open(folder)?.sync_all()
        }
        _ => Ok(()),
    }
}

/// Reads a Parquet file that [`write()`] has written.
///
/// # Errors
/// A file that is not there, that is damaged, or that holds other types.
pub fn read(path: &Path) -> Result<WholeTable, OutputError> {
    let opened = File::open(path).map_err(|error| OutputError::at(path, &error))?;
    table_of(opened).map_err(|error| OutputError::at(path, &error))
}

fn table_of(file: File) -> Result<WholeTable, ParquetError> {
    let reader = SerializedFileReader::new(file)?;
    let metadata = reader.metadata().file_metadata();
    let facts = metadata.key_value_metadata().into_iter().flatten();
    let facts = facts.filter_map(|entry| {
        let name = entry.key.strip_prefix("stiction.")?;
        Some((name.to_owned(), entry.value.clone()?))
    });
    let facts = facts.collect();
    let described = metadata.schema_descr().columns();
    let mut columns: Vec<Column> = Vec::new();
    for number in 0..reader.num_row_groups() {
        let group = reader.get_row_group(number)?;
        let rows = usize::try_from(group.metadata().num_rows()).unwrap_or_default();
        for (place, description) in described.iter().enumerate() {
            let optional = description.max_def_level() > 0;
            let values = values(group.get_column_reader(place)?, rows, optional)?;
            match columns.get_mut(place) {
                None => columns.push(Column {
                    name: description.name().to_owned(),
                    values,
                }),
                Some(column) => column.values.extend(values),
            }
        }
    }
    Ok(WholeTable { columns, facts })
}

impl Values {
    /// Appends those of another part of the same column.
    fn extend(&mut self, more: Self) {
        match (self, more) {
            (Self::Double(all), Self::Double(more)) => all.extend(more),
            (Self::Optional(all), Self::Optional(more)) => all.extend(more),
            (Self::Integer(all), Self::Integer(more)) => all.extend(more),
            (Self::Long(all), Self::Long(more)) => all.extend(more),
            (Self::Boolean(all), Self::Boolean(more)) => all.extend(more),
            (Self::Text(all), Self::Text(more)) => all.extend(more),
            // A column has one type in a file.
            _ => {}
        }
    }
}

fn values(reader: ColumnReader, rows: usize, optional: bool) -> Result<Values, ParquetError> {
    Ok(match reader {
        ColumnReader::DoubleColumnReader(reader) if optional => {
            let (values, levels) = all(reader, rows)?;
            let mut values = values.into_iter();
            let each = levels.into_iter().map(|level| match level {
                0 => None,
                _ => values.next(),
            });
            Values::Optional(each.collect())
        }
        ColumnReader::DoubleColumnReader(reader) => Values::Double(all(reader, rows)?.0),
        ColumnReader::Int32ColumnReader(reader) => Values::Integer(all(reader, rows)?.0),
        ColumnReader::Int64ColumnReader(reader) => Values::Long(all(reader, rows)?.0),
        ColumnReader::BoolColumnReader(reader) => Values::Boolean(all(reader, rows)?.0),
        ColumnReader::ByteArrayColumnReader(reader) => Values::Text(all(reader, rows)?.0),
        _ => return Err(ParquetError::NYI("a column of another type".to_owned())),
    })
}

/// The values that are there, and for each row whether it has one.
fn all<T: DataType>(
    mut reader: ColumnReaderImpl<T>,
    rows: usize,
) -> Result<(Vec<T::T>, Vec<i16>), ParquetError> {
    let (mut values, mut levels) = (Vec::new(), Vec::new());
    let mut read = 0;
    while read < rows {
        let (more, _, _) =
            reader.read_records(rows - read, Some(&mut levels), None, &mut values)?;
        if more == 0 {
            return Err(ParquetError::EOF("rows are missing".to_owned()));
        }
        read += more;
    }
    Ok((values, levels))
}
