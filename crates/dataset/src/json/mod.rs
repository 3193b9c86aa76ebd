//! Models as JSON: the statements of a dataset with full names and typed values.

mod reader;
mod schema;
mod unwritable;
mod value;
mod writer;

pub use reader::from_json;
pub use schema::json_schema;
pub use writer::to_json;

/// The value of `format` in the JSON form of a model.
const FORMAT: &str = "stiction-model";

/// The value of `version`.
const VERSION: u32 = 1;
