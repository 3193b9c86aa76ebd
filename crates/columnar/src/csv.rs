//! A table as comma separated values (RFC 4180, lines end in a line feed).

use std::borrow::Cow;
use std::fs::File;
use std::io::{BufWriter, Write};

use crate::table::{Heading, TableFile, Values};

/// A file of comma separated values.
pub(crate) struct CsvFile {
    file: BufWriter<File>,
    line: Vec<u8>,
}

impl CsvFile {
    pub(crate) fn new(file: File, headings: &[Heading]) -> Result<Self, String> {
        let mut file = BufWriter::new(file);
        let names: Vec<_> = headings.iter().map(|h| quoted(&h.name)).collect();
        writeln!(file, "{}", names.join(",")).map_err(|error| error.to_string())?;
        Ok(Self {
            file,
            line: Vec::new(),
        })
    }

    fn write(&mut self, columns: &[Values], rows: usize) -> std::io::Result<()> {
        for row in 0..rows {
            self.line.clear();
            for (place, values) in columns.iter().enumerate() {
                if place > 0 {
                    self.line.push(b',');
                }
                match values {
                    // The shortest digits that give the same number.
                    Values::Double(values) => write!(self.line, "{:?}", values[row])?,
                    Values::Optional(values) => {
                        if let Some(value) = values[row] {
                            write!(self.line, "{value:?}")?;
                        }
                    }
                    Values::Long(values) => write!(self.line, "{}", values[row])?,
                    Values::Boolean(values) => write!(self.line, "{}", values[row])?,
                    Values::Integer(values) => write!(self.line, "{}", values[row])?,
                    Values::Text(values) => {
                        let text = String::from_utf8_lossy(values[row].data());
                        self.line.extend_from_slice(quoted(&text).as_bytes());
                    }
                }
            }
            self.line.push(b'\n');
            self.file.write_all(&self.line)?;
        }
        Ok(())
    }
}

impl TableFile for CsvFile {
    fn batch(&mut self, columns: &[Values], rows: usize) -> Result<(), String> {
        self.write(columns, rows).map_err(|error| error.to_string())
    }

    fn finish(mut self: Box<Self>, _: &[(String, String)]) -> Result<(), String> {
        self.file.flush().map_err(|error| error.to_string())
    }
}

/// A text between quotes where it needs them.
fn quoted(text: &str) -> Cow<'_, str> {
    if text.contains(['"', ',', '\n', '\r']) {
        format!("\"{}\"", text.replace('"', "\"\"")).into()
    } else {
        text.into()
    }
}
