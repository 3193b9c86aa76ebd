//! What SAVE keeps, and the file that holds it.
//!
//! A file has two lines and then JSON: `stiction saved system, format 1`, `sha256` with the checksum
//! of what follows, and the values under the names of the fields here and of
//! [`mechanics::SavedState`]; all in the units of the model. Numbers are written so that reading gives
//! the same bits back. docs/saved-systems.md describes it for users.

use mechanics::SavedState;
use serde::{Deserialize, Serialize};
use sha2::{Digest, Sha256};

use crate::balance::EnergyAccount;
use crate::lower::{Numbering, Setting};
use crate::project::hexadecimal;
use crate::runner::Recorded;

/// How files of this and all formats begin.
const FORMAT: &str = "stiction saved system, format 1";
const ANY_FORMAT: &str = "stiction saved system, format ";

/// A model with its state: the changes that commands have made of the dataset, and the simulation.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct SavedSystem {
    /// The version of the program that has written it.
    pub(crate) version: String,
    /// Checksum of the model as given, see `Project::model_checksum`.
    pub(crate) model: String,
    /// The commands that have changed the model, as a command file.
    pub(crate) changes: String,
    /// The analysis that functions were read for last, and what sensors have kept.
    pub(crate) setting: Setting,
    /// The numbering of what functions read.
    pub(crate) numbering: Numbering,
    /// Whether the model has been assembled.
    pub(crate) assembled: bool,
    /// What the results held of the instant.
    pub(crate) recorded: Recorded,
    /// Where the energy went so far.
    pub(crate) account: EnergyAccount,
    /// The simulation.
    pub(crate) simulation: SavedState,
}

/// Why a file cannot be read as a saved system.
#[derive(Clone, Debug, PartialEq, Eq, thiserror::Error)]
pub(crate) enum FileError {
    /// It is something else.
    #[error("it is not a file that SAVE has written")]
    NotSaved,
    /// Another version has written it.
    #[error("its format, `{0}`, is that of another version of stiction; save the state again")]
    AnotherFormat(String),
    /// The checksum is not that of the contents.
    #[error("its checksum is wrong: it is damaged or was edited")]
    Damaged,
}

impl SavedSystem {
    /// The text of its file.
    pub(crate) fn to_text(&self) -> Result<String, serde_json::Error> {
        let body = serde_json::to_string_pretty(self)? + "\n";
        Ok(format!("{FORMAT}\nsha256 {}\n{body}", checksum(&body)))
    }

    /// From the text of its file.
    pub(crate) fn from_text(text: &str) -> Result<Self, FileError> {
        let (format, rest) = text.split_once('\n').ok_or(FileError::NotSaved)?;
        if format != FORMAT {
            return Err(match format.strip_prefix(ANY_FORMAT) {
                Some(number) => FileError::AnotherFormat(number.to_owned()),
                None => FileError::NotSaved,
            });
        }
        let (sum, body) = rest.split_once('\n').ok_or(FileError::Damaged)?;
        if sum.strip_prefix("sha256 ") != Some(&checksum(body)) {
            return Err(FileError::Damaged);
        }
        serde_json::from_str(body).map_err(|_| FileError::Damaged)
    }
}

/// Whether a text begins as saved systems do.
pub(crate) fn is_saved_system(text: &[u8]) -> bool {
    text.starts_with(ANY_FORMAT.as_bytes())
}

fn checksum(text: &str) -> String {
    hexadecimal(&Sha256::digest(text))
}
