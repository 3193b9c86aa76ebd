//! Writer of `.req` files: six values per request at every output time.
//!
//! The head is that of Adams. Real files with requests were not available: after the head come one
//! line per request (id and comment), and after each time one line per request (six values).

use crate::number::scientific;
use crate::units::UnitNames;
use std::io::{self, Write};

/// A request as the head of a `.req` names it.
#[derive(Debug, Clone, PartialEq, Eq)]
pub struct Request {
    /// Id in the dataset.
    pub id: u32,
    /// Comment, or its name.
    pub comment: String,
}

/// Streaming writer of a `.req`.
///
/// ```
/// use results::{ReqWriter, UnitNames};
/// let mut file = Vec::new();
/// let mut writer = ReqWriter::new(&mut file, "model", None, &UnitNames::default(), &[])?;
/// writer.step(0.01, &[])?;
/// let text = String::from_utf8(file)?;
/// assert!(text.ends_with("\n    0     M_KGS_N_RACA 1.000000000000000E+00\n   1.00000E-02\n"));
/// # Ok::<(), Box<dyn std::error::Error>>(())
/// ```
#[derive(Debug)]
pub struct ReqWriter<W: Write> {
    out: W,
    requests: usize,
}

impl<W: Write> ReqWriter<W> {
    /// Writes the head: title, date (`2026-01-31 12:00:00` or unknown), units, requests.
    ///
    /// # Errors
    /// Those of the file system.
    pub fn new(
        mut out: W,
        title: &str,
        date: Option<&str>,
        units: &UnitNames,
        requests: &[Request],
    ) -> io::Result<Self> {
        let one_line = |text: &str| text.replace(|c: char| c.is_control(), " ");
        let date = date.unwrap_or("-unknown-");
        let mut head = format!(" A.R3    {date:<19}{:>16}{:>10}  3D\n", 0, 0);
        head += &format!("{:<80}\n", one_line(title));
        let lengths = scientific(units.lengths_per_meter, 15);
        head += &format!("{:>5}     {} {lengths}\n", requests.len(), units.tag);
        for request in requests {
            head += &format!("{:>10}  {}\n", request.id, one_line(&request.comment));
        }
        out.write_all(head.as_bytes())?;
        out.flush()?;
        Ok(Self {
            out,
            requests: requests.len(),
        })
    }

    /// Writes on, behind a head of so many requests and what follows it.
    pub fn append(out: W, requests: usize) -> Self {
        Self { out, requests }
    }

    /// What it writes to.
    pub fn get_ref(&self) -> &W {
        &self.out
    }

    /// Writes the six values of every request at a time.
    ///
    /// # Errors
    /// [`io::ErrorKind::InvalidInput`] for another number of requests than in the head or a value
    /// that is not finite, else those of the file system.
    pub fn step(&mut self, time: f64, values: &[[f64; 6]]) -> io::Result<()> {
        if values.len() != self.requests {
            let (given, expected) = (values.len(), self.requests);
            let message = format!("{given} requests instead of {expected} at time {time}");
            return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
        }
        if !time.is_finite() || values.iter().flatten().any(|value| !value.is_finite()) {
            let message = format!("a request is not finite at time {time}");
            return Err(io::Error::new(io::ErrorKind::InvalidInput, message));
        }
        let mut text = format!("{:>14}\n", scientific(time, 5));
        for six in values {
            for &value in six {
                // A blank keeps the columns apart also where an exponent takes three digits.
                text += &format!(" {:>12}", scientific(value, 5));
            }
            text.push('\n');
        }
        self.out.write_all(text.as_bytes())?;
        self.out.flush()
    }
}
