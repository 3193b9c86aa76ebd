//! What is known of the cases of a study, in memory and in a folder.
//!
//! ```text
//! DIR/study.json            what study it is
//! DIR/parts/NUMBER.parquet  cases that are done, while the study goes on
//! DIR/cases.parquet         all cases in their order, once the study is done; the parts go then
//! ```
//!
//! Every file is written under another name, brought to the disk and renamed, so that what has its
//! name is whole. One process writes; a case that is recorded already is not recorded again.

use std::path::{Path, PathBuf};
use std::sync::Arc;
use std::time::{Duration, Instant};

use columnar::WholeTable;
use serde_json::Value as Json;
use stiction::{Claim, OutputError, write_whole};

use crate::study::{Row, Study};
use crate::table;

/// Wall time after which cases that are done are written: what a computer that fails loses.
const INTERVAL: Duration = Duration::from_secs(2);
/// So many cases are written at once at the latest.
const BATCH: usize = 10_000;

/// A folder that cannot take a study.
#[derive(Debug, thiserror::Error)]
pub enum RecordError {
    /// A file that cannot be written.
    #[error(transparent)]
    Output(#[from] OutputError),
    /// Another process works on the study in it.
    #[error("{0} is in use by another process that works on its study")]
    InUse(String),
    /// It holds something else, or what cannot be read.
    #[error("{folder}: {cause}")]
    Refused {
        /// The folder.
        folder: String,
        /// Why, and what to do.
        cause: String,
    },
}

/// The cases that are done.
#[derive(Debug)]
pub struct Record {
    study: Arc<Study>,
    rows: Vec<Option<Row>>,
    done: usize,
    folder: Option<Folder>,
}

#[derive(Debug)]
struct Folder {
    path: PathBuf,
    _claim: Claim,
    /// Cases that are not in a part yet.
    pending: Vec<usize>,
    written: Instant,
    /// Number of the next part.
    next: usize,
}

impl Record {
    /// Of a study in memory alone.
    #[must_use]
    pub fn new(study: Arc<Study>) -> Self {
        Self {
            rows: vec![None; study.cases()],
            study,
            done: 0,
            folder: None,
        }
    }

    /// Of a study in a folder, which is made where it is not there. With `resume` cases that are done
    /// there are known; without it the folder must be empty.
    ///
    /// # Errors
    /// A folder in use, of another study or with other files, and files that cannot be written.
    pub fn open(study: Arc<Study>, path: &Path, resume: bool) -> Result<Self, RecordError> {
        let refused = |cause: String| RecordError::Refused {
            folder: path.display().to_string(),
            cause,
        };
        std::fs::create_dir_all(path).map_err(|error| OutputError::at(path, &error))?;
        let Some(claim) = Claim::of_free(path)? else {
            return Err(RecordError::InUse(path.display().to_string()));
        };
        let manifest = path.join("study.json");
        let parts = path.join("parts");
        if manifest.exists() {
            if !resume {
                return Err(refused(
                    "it holds a study already; resume that, or take another folder".to_owned(),
                ));
            }
            let known = std::fs::read_to_string(&manifest);
            let known = known.map_err(|error| refused(format!("study.json: {error}")))?;
            compare(&known, &study.manifest()).map_err(refused)?;
        } else {
            let entries = std::fs::read_dir(path).map_err(|error| OutputError::at(path, &error))?;
            let mut names = entries.flatten().map(|entry| entry.file_name());
            if let Some(other) = names.find(|name| name != "study.json.part") {
                let name = other.to_string_lossy();
                return Err(refused(format!(
                    "it holds {name}; take an empty folder, or a new one"
                )));
            }
            let text = format!("{:#}\n", study.manifest());
            let written = write_whole(&manifest, |part| {
                std::fs::write(part, text)?;
                std::fs::File::open(part)?.sync_all()
            });
            written.map_err(|error| OutputError::at(&manifest, &error))?;
        }
        std::fs::create_dir_all(&parts).map_err(|error| OutputError::at(&parts, &error))?;
        let mut record = Self::new(study);
        let next = record.read(path).map_err(refused)?;
        record.folder = Some(Folder {
            path: path.to_owned(),
            _claim: claim,
            pending: Vec::new(),
            written: Instant::now(),
            next,
        });
        Ok(record)
    }

    /// Takes over what is done in a folder; returns the number of the next part.
    fn read(&mut self, path: &Path) -> Result<usize, String> {
        let whole = path.join("cases.parquet");
        if whole.exists() {
            self.read_table(&whole)?;
        }
        let mut next = 0;
        let parts = std::fs::read_dir(path.join("parts")).map_err(|error| error.to_string())?;
        for entry in parts.flatten() {
            let part = entry.path();
            if part
                .extension()
                .is_some_and(|extension| extension == "parquet")
            {
                self.read_table(&part)?;
                let number = part
                    .file_stem()
                    .and_then(|stem| stem.to_str()?.parse().ok());
                next = next.max(number.unwrap_or(0) + 1);
            }
        }
        Ok(next)
    }

    fn read_table(&mut self, path: &Path) -> Result<(), String> {
        let shown = path.display();
        let table = columnar::read(path).map_err(|e| format!("{shown}: {}", e.cause))?;
        let rows = table::rows(&self.study, &table).map_err(|cause| format!("{shown}: {cause}"))?;
        rows.into_iter().for_each(|row| {
            self.take(row);
        });
        Ok(())
    }

    /// Keeps a row; returns whether its case was not done yet.
    fn take(&mut self, row: Row) -> bool {
        let case = row.case;
        let new = self.rows.get(case).is_some_and(Option::is_none);
        if new {
            self.rows[case] = Some(row);
            self.done += 1;
        }
        new
    }

    /// Records a case that is done, once; writes now and then what is not written yet.
    ///
    /// # Errors
    /// A part that cannot be written.
    pub fn push(&mut self, row: Row) -> Result<(), RecordError> {
        let case = row.case;
        if self.take(row)
            && let Some(folder) = &mut self.folder
        {
            folder.pending.push(case);
        }
        self.keep_up()
    }

    /// Writes what has waited for long, or is much; to be called now and then.
    ///
    /// # Errors
    /// A part that cannot be written.
    pub fn keep_up(&mut self) -> Result<(), RecordError> {
        let due = self.folder.as_ref().is_some_and(|folder| {
            folder.pending.len() >= BATCH || folder.written.elapsed() >= INTERVAL
        });
        if due { self.flush() } else { Ok(()) }
    }

    /// Writes what is not written yet.
    ///
    /// # Errors
    /// A part that cannot be written.
    pub fn flush(&mut self) -> Result<(), RecordError> {
        let Some(folder) = &mut self.folder else {
            return Ok(());
        };
        if !folder.pending.is_empty() {
            folder.pending.sort_unstable();
            let rows = folder
                .pending
                .iter()
                .filter_map(|case| self.rows[*case].as_ref());
            let rows: Vec<&Row> = rows.collect();
            let path = folder
                .path
                .join("parts")
                .join(format!("{:06}.parquet", folder.next));
            columnar::write(&path, &table::table(&self.study, &rows))?;
            folder.pending.clear();
            folder.next += 1;
        }
        folder.written = Instant::now();
        Ok(())
    }

    /// Writes what is not written yet and, where every case is done, the table of all of them.
    ///
    /// # Errors
    /// A file that cannot be written.
    pub fn finish(&mut self) -> Result<(), RecordError> {
        self.flush()?;
        let Some(folder) = &self.folder else {
            return Ok(());
        };
        if self.done == self.rows.len() {
            let whole = folder.path.join("cases.parquet");
            if !whole.exists() {
                columnar::write(&whole, &self.table())?;
            }
            // The table has all that is in the parts.
            let _ = std::fs::remove_dir_all(folder.path.join("parts"));
        }
        Ok(())
    }

    /// The study that it is of.
    #[must_use]
    pub fn study(&self) -> &Arc<Study> {
        &self.study
    }

    /// The cases that are not done.
    #[must_use]
    pub fn open_cases(&self) -> Vec<usize> {
        let open = |case: &usize| self.rows[*case].is_none();
        (0..self.rows.len()).filter(open).collect()
    }

    /// Number of cases that are done, and of those that have failed.
    #[must_use]
    pub fn counts(&self) -> (usize, usize) {
        let failed = self.rows.iter().flatten().filter(|row| !row.success);
        (self.done, failed.count())
    }

    /// What a program says at the end: how many cases, where they are, the first that have failed, and
    /// the range of each output.
    #[must_use]
    pub fn summary(&self, folder: &Path, seconds: f64) -> String {
        /// Failures that are told.
        const TOLD: usize = 5;
        let (done, failed) = self.counts();
        let of = self.rows.len();
        let mut text = format!("{done} of {of} cases done, {failed} failed, {seconds:.2} s\n");
        let file = if done == of { "cases.parquet" } else { "parts" };
        text += &format!("results in {}: {file} study.json\n", folder.display());
        if done < of {
            text += "the same command with --resume goes on from here\n";
        }
        for (place, (name, unit)) in self.study.outputs().enumerate() {
            let values = || self.rows().filter_map(|row| row.outputs[place]);
            if let (Some(low), Some(high)) = (values().reduce(f64::min), values().reduce(f64::max))
            {
                let range = format!("{name}: {low:.6} to {high:.6} {}", unit.unwrap_or_default());
                text += &format!("{}\n", range.trim_end());
            }
        }
        for row in self.rows().filter(|row| !row.success).take(TOLD) {
            let names = self
                .study
                .parameters()
                .iter()
                .map(|parameter| &parameter.name);
            let values = names.zip(self.study.values(row.case));
            let values: Vec<_> = values
                .map(|(name, value)| format!("{name} = {value}"))
                .collect();
            let message = row.message.lines().next().unwrap_or_default();
            text += &format!(
                "case {} ({}) failed: {message}\n",
                row.case,
                values.join(", ")
            );
        }
        if failed > TOLD {
            text += &format!("and {} more failed\n", failed - TOLD);
        }
        text
    }

    /// The rows that are there, in the order of the cases.
    pub fn rows(&self) -> impl Iterator<Item = &Row> {
        self.rows.iter().flatten()
    }

    /// The table of the rows that are there.
    #[must_use]
    pub fn table(&self) -> WholeTable {
        let rows: Vec<&Row> = self.rows().collect();
        table::table(&self.study, &rows)
    }
}

/// Whether a folder holds the same study.
fn compare(known: &str, study: &Json) -> Result<(), String> {
    let known: Json = serde_json::from_str(known).map_err(|e| format!("study.json: {e}"))?;
    let names = study
        .as_object()
        .into_iter()
        .flat_map(|object| object.keys());
    let differs: Vec<&str> = names
        .filter(|name| known[name] != study[name])
        .map(|n| &**n)
        .collect();
    match differs.is_empty() {
        true => Ok(()),
        false => Err(format!(
            "it holds another study ({} differ); take another folder",
            differs.join(", ")
        )),
    }
}
