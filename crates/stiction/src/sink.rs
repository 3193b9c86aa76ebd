//! Rows of results for whoever wants them beside the files: tables in memory, other formats.

pub use results::{Component, DataKind, Entity, Header, Layout, UnitNames};

use crate::session::OutputError;

/// Takes the rows of results while a run makes them.
///
/// It is given the rows that the `.req` holds, one for each instant, with the values of the `.res`.
///
/// ```
/// use stiction::{OutputError, sink::{DataKind, Header, Layout, Sink}};
///
/// /// Keeps the times.
/// #[derive(Default)]
/// struct Times(Vec<f64>);
/// impl Sink for Times {
///     fn begin(&mut self, _: &Header, _: &Layout) -> Result<(), OutputError> {
///         Ok(())
///     }
///     fn row(&mut self, _: DataKind, time: f64, _: &[f64]) -> Result<(), OutputError> {
///         self.0.push(time);
///         Ok(())
///     }
/// }
/// ```
pub trait Sink {
    /// Before the first row: title and units of the model, and what the values of a row are.
    ///
    /// # Errors
    /// What keeps it from taking rows, which ends the run.
    fn begin(&mut self, header: &Header, layout: &Layout) -> Result<(), OutputError>;

    /// One row: the values at a time, in the order of the layout, all of them finite.
    ///
    /// # Errors
    /// What keeps it from taking the row, which ends the run.
    fn row(&mut self, kind: DataKind, time: f64, values: &[f64]) -> Result<(), OutputError>;
}

/// Several sinks, each of which is given everything.
impl Sink for Vec<&mut dyn Sink> {
    fn begin(&mut self, header: &Header, layout: &Layout) -> Result<(), OutputError> {
        self.iter_mut()
            .try_for_each(|sink| sink.begin(header, layout))
    }

    fn row(&mut self, kind: DataKind, time: f64, values: &[f64]) -> Result<(), OutputError> {
        self.iter_mut()
            .try_for_each(|sink| sink.row(kind, time, values))
    }
}
