//! A table as a Parquet file, a row group for each batch.

use std::fs::File;
use std::io::BufWriter;
use std::sync::Arc;

use parquet::basic::{Compression, LogicalType, Repetition, Type as Physical};
use parquet::data_type::{BoolType, ByteArrayType, DoubleType, Int32Type, Int64Type};
use parquet::errors::ParquetError;
use parquet::file::metadata::KeyValue;
use parquet::file::properties::WriterProperties;
use parquet::file::writer::SerializedFileWriter;
use parquet::schema::types::{ColumnPath, Type};

use crate::table::{Heading, Kind, TableFile, Values};

/// A Parquet file.
pub(crate) struct ParquetFile {
    writer: SerializedFileWriter<BufWriter<File>>,
}

impl ParquetFile {
    pub(crate) fn new(file: File, headings: &[Heading]) -> Result<Self, String> {
        Self::create(file, headings).map_err(|error| error.to_string())
    }

    fn create(file: File, headings: &[Heading]) -> Result<Self, ParquetError> {
        let fields: Result<Vec<_>, _> = headings.iter().map(field).collect();
        let schema = Type::group_type_builder("schema")
            .with_fields(fields?)
            .build()?;
        // A dictionary is worth its while for words, not for numbers.
        let mut properties = WriterProperties::builder()
            .set_compression(Compression::SNAPPY)
            .set_dictionary_enabled(false);
        for heading in headings.iter().filter(|h| h.kind == Kind::Text) {
            let path = ColumnPath::new(vec![heading.name.clone()]);
            properties = properties.set_column_dictionary_enabled(path, true);
        }
        let properties = Arc::new(properties.build());
        let writer = SerializedFileWriter::new(BufWriter::new(file), Arc::new(schema), properties)?;
        Ok(Self { writer })
    }

    fn write(&mut self, columns: &[Values]) -> Result<(), ParquetError> {
        let mut group = self.writer.next_row_group()?;
        for values in columns {
            let Some(mut column) = group.next_column()? else {
                break;
            };
            match values {
                Values::Double(values) => {
                    column.typed::<DoubleType>().write_batch(values, None, None)
                }
                Values::Optional(values) => {
                    let present: Vec<f64> = values.iter().flatten().copied().collect();
                    let levels: Vec<i16> = values.iter().map(|v| v.is_some().into()).collect();
                    let column = column.typed::<DoubleType>();
                    column.write_batch(&present, Some(&levels), None)
                }
                Values::Integer(values) => {
                    column.typed::<Int32Type>().write_batch(values, None, None)
                }
                Values::Long(values) => column.typed::<Int64Type>().write_batch(values, None, None),
                Values::Boolean(values) => {
                    column.typed::<BoolType>().write_batch(values, None, None)
                }
                Values::Text(values) => {
                    let column = column.typed::<ByteArrayType>();
                    column.write_batch(values, None, None)
                }
            }?;
            column.close()?;
        }
        group.close()?;
        Ok(())
    }
}

/// A column in the schema.
fn field(heading: &Heading) -> Result<Arc<Type>, ParquetError> {
    let (physical, logical) = match heading.kind {
        Kind::Double | Kind::Optional => (Physical::DOUBLE, None),
        Kind::Integer => (Physical::INT32, None),
        Kind::Long => (Physical::INT64, None),
        Kind::Boolean => (Physical::BOOLEAN, None),
        Kind::Text => (Physical::BYTE_ARRAY, Some(LogicalType::String)),
    };
    let repetition = match heading.kind {
        Kind::Optional => Repetition::OPTIONAL,
        _ => Repetition::REQUIRED,
    };
    let field = Type::primitive_type_builder(&heading.name, physical)
        .with_repetition(repetition)
        .with_logical_type(logical)
        .build()?;
    Ok(Arc::new(field))
}

impl TableFile for ParquetFile {
    fn batch(&mut self, columns: &[Values], _: usize) -> Result<(), String> {
        self.write(columns).map_err(|error| error.to_string())
    }

    fn finish(mut self: Box<Self>, facts: &[(String, String)]) -> Result<(), String> {
        for (name, fact) in facts {
            let entry = KeyValue::new(format!("stiction.{name}"), fact.clone());
            self.writer.append_key_value_metadata(entry);
        }
        let ended = self
            .writer
            .into_inner()
            .map_err(|error| error.to_string())?;
        let file = ended.into_inner().map_err(|error| error.to_string())?;
        // Its name is given to the file when its bytes are on the disk.
        file.sync_all().map_err(|error| error.to_string())
    }
}
