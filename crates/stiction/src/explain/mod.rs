//! Where friction came from, read back from the results of a run.
//!
//! The `.res` of a run holds for each friction its 26 components and our own channels
//! ([`results::friction_detail`]). This module turns them into what a person asks: what a joint did
//! over the run ([`FrictionHistory`]), why its friction was what it was at an instant
//! ([`FrictionMoment`]), and what there is to plot ([`FrictionSeries`], [`EnergySeries`]).
//!
//! ```no_run
//! use stiction::explain::RunResults;
//!
//! let run = RunResults::open("pendulum-run".as_ref())?;
//! println!("{}", run.history(1)?);
//! println!("{}", run.at(1, 2.5)?);
//! # Ok::<(), stiction::explain::ExplainError>(())
//! ```

mod history;
mod moment;
mod naming;
mod record;
mod series;
mod sticks;

use std::path::{Path, PathBuf};

use results::{FRICTION_DETAIL, ReadError, ResFile};

pub use history::{FrictionHistory, Limited, Peak};
pub use moment::FrictionMoment;
pub use series::{EnergySeries, FrictionSeries};
pub use sticks::StickInterval;

use crate::text_table::text_table;
use record::{Record, Records};

/// What makes friction, in the order of all lists of causes.
pub const CAUSES: [&str; 4] = ["preload", "reaction force", "bending", "torsion"];

/// The regimes by number.
pub const REGIMES: [&str; 3] = ["stuck", "transition", "sliding"];

/// Why a run cannot be explained.
#[derive(Debug, thiserror::Error)]
pub enum ExplainError {
    /// The folder holds no results.
    #[error(
        "there is no .res in {0}; give the folder of a run that has written one (stiction run does so, \
         unless --format leaves res out)"
    )]
    NoResults(PathBuf),
    /// The folder holds several results.
    #[error("there are several .res in {folder}; give one of them: {}", .files.join(", "))]
    SeveralResults {
        /// The folder.
        folder: PathBuf,
        /// Their paths.
        files: Vec<String>,
    },
    /// The folder or file cannot be read.
    #[error("cannot read {path}: {cause}")]
    Unreadable {
        /// The folder or file.
        path: PathBuf,
        /// Why.
        cause: String,
    },
    /// The file has none of our channels of friction.
    #[error(
        "{0} has no friction to explain: the model has no FRICTION, or the file was written by \
         another program or an older version"
    )]
    NoFriction(PathBuf),
    /// There is no friction of that id.
    #[error("there is no FRICTION/{id}; there is {}", .known.join(", "))]
    UnknownFriction {
        /// The id.
        id: u32,
        /// The frictions that there are.
        known: Vec<String>,
    },
    /// There is no friction of that name, and none in a joint of that name.
    #[error("there is no friction {name:?}; {help}")]
    UnknownName {
        /// The name.
        name: String,
        /// What may have been meant, or what there is.
        help: String,
    },
    /// The file has no channels of energy.
    #[error(
        "{0} has no energies: it was written by another program or an older version; run the model \
         again"
    )]
    NoEnergy(PathBuf),
    /// The run ended before its first output.
    #[error("{0} has no output yet")]
    NoOutput(PathBuf),
    /// The time is outside of the run.
    #[error("time {time} is outside of the run, which goes from {start} to {end}")]
    OutsideRun {
        /// The time asked for.
        time: f64,
        /// Time of the first output.
        start: f64,
        /// Time of the last one.
        end: f64,
    },
}

/// The results of a run.
#[derive(Debug)]
pub struct RunResults {
    path: PathBuf,
    file: ResFile,
}

impl RunResults {
    /// Opens the results in the folder of a run, or a `.res` itself.
    ///
    /// # Errors
    /// A folder with no or several `.res`, or one that cannot be read.
    pub fn open(path: &Path) -> Result<Self, ExplainError> {
        let path = if path.is_dir() {
            only_results(path)?
        } else {
            path.to_owned()
        };
        let file = ResFile::read(&path).map_err(|error| ExplainError::Unreadable {
            path: path.clone(),
            cause: match error {
                ReadError::Io(error) => error.to_string(),
                other => other.to_string(),
            },
        })?;
        Ok(Self { path, file })
    }

    /// The `.res`.
    #[must_use]
    pub fn path(&self) -> &Path {
        &self.path
    }

    /// Ids of the frictions in the order of the dataset.
    ///
    /// # Errors
    /// [`ExplainError::NoFriction`].
    pub fn frictions(&self) -> Result<Vec<u32>, ExplainError> {
        let details = self.file.entities.iter();
        let details = details.filter(|entity| entity.kind == FRICTION_DETAIL);
        let ids: Vec<u32> = details.filter_map(|entity| entity.object_id).collect();
        if ids.is_empty() {
            return Err(ExplainError::NoFriction(self.path.clone()));
        }
        Ok(ids)
    }

    /// The friction of an id, of a name, or in a joint of a name or id: `103`, `FRICTION/103`, `GUIDE`,
    /// `JOINT/28`. The joints are those of the `run.json` beside the `.res`, which a run writes at its
    /// end.
    ///
    /// # Errors
    /// [`ExplainError::UnknownName`] with what may have been meant; [`ExplainError::NoFriction`].
    pub fn find(&self, name: &str) -> Result<u32, ExplainError> {
        naming::find(&self.names()?, name)
    }

    /// What pictures call a friction: itself and its joint, where that is known.
    ///
    /// # Errors
    /// No friction of that id.
    pub fn title(&self, id: u32) -> Result<String, ExplainError> {
        let names = self.names()?;
        let named = names.iter().find(|names| names.id == id);
        let named = named.ok_or_else(|| self.unknown(id, &names))?;
        Ok(named.title())
    }

    fn names(&self) -> Result<Vec<naming::Names>, ExplainError> {
        let ids = self.frictions()?;
        Ok(naming::names(&self.file, &ids, &self.path))
    }

    fn unknown(&self, id: u32, names: &[naming::Names]) -> ExplainError {
        let known = names.iter().map(|names| format!("FRICTION/{}", names.id));
        ExplainError::UnknownFriction {
            id,
            known: known.collect(),
        }
    }

    /// What a friction was at every output.
    ///
    /// # Errors
    /// No friction of that id, or no output.
    pub fn series(&self, id: u32) -> Result<FrictionSeries, ExplainError> {
        let series = FrictionSeries::new(&self.records(id)?);
        series.ok_or_else(|| ExplainError::NoOutput(self.path.clone()))
    }

    /// The energies of the model at every output.
    ///
    /// # Errors
    /// [`ExplainError::NoEnergy`], or no output.
    pub fn energies(&self) -> Result<EnergySeries, ExplainError> {
        let series = EnergySeries::new(&self.file);
        let series = series.ok_or_else(|| ExplainError::NoEnergy(self.path.clone()))?;
        if series.time.is_empty() {
            return Err(ExplainError::NoOutput(self.path.clone()));
        }
        Ok(series)
    }

    /// What a friction did over the run.
    ///
    /// # Errors
    /// No friction of that id, or no output.
    pub fn history(&self, id: u32) -> Result<FrictionHistory, ExplainError> {
        let records = self.records(id)?;
        FrictionHistory::new(&records).ok_or_else(|| ExplainError::NoOutput(self.path.clone()))
    }

    /// Why friction was what it was at the output nearest to a time.
    ///
    /// # Errors
    /// No friction of that id, no output, or a time outside of the run.
    pub fn at(&self, id: u32, time: f64) -> Result<FrictionMoment, ExplainError> {
        let records = self.records(id)?;
        let all = records.all();
        let (Some(first), Some(last)) = (all.first(), all.last()) else {
            return Err(ExplainError::NoOutput(self.path.clone()));
        };
        let (start, end) = (first.time(), last.time());
        if !(start..=end).contains(&time) {
            return Err(ExplainError::OutsideRun { time, start, end });
        }
        let away = |record: &Record<'_>| (record.time() - time).abs();
        let nearest = all.iter().fold(first, |best, record| {
            if away(record) < away(best) {
                record
            } else {
                best
            }
        });
        Ok(FrictionMoment::new(&records, nearest))
    }

    fn records(&self, id: u32) -> Result<Records<'_>, ExplainError> {
        if !self.frictions()?.contains(&id) {
            return Err(self.unknown(id, &self.names()?));
        }
        Records::new(&self.file, id).ok_or_else(|| ExplainError::NoFriction(self.path.clone()))
    }
}

fn only_results(folder: &Path) -> Result<PathBuf, ExplainError> {
    let unreadable = |error: std::io::Error| ExplainError::Unreadable {
        path: folder.to_owned(),
        cause: error.to_string(),
    };
    let mut files = Vec::new();
    for entry in std::fs::read_dir(folder).map_err(unreadable)? {
        let path = entry.map_err(unreadable)?.path();
        if path.extension().is_some_and(|extension| extension == "res") {
            files.push(path);
        }
    }
    files.sort();
    match files.len() {
        0 => Err(ExplainError::NoResults(folder.to_owned())),
        1 => Ok(files.remove(0)),
        _ => Err(ExplainError::SeveralResults {
            folder: folder.to_owned(),
            files: files
                .iter()
                .map(|path| path.display().to_string())
                .collect(),
        }),
    }
}

/// One line for each friction, the one that dissipated most first.
///
/// ```
/// assert_eq!(stiction::explain::overview(&[]), "");
/// ```
#[must_use]
pub fn overview(histories: &[FrictionHistory]) -> String {
    if histories.is_empty() {
        return String::new();
    }
    let mut sorted: Vec<&FrictionHistory> = histories.iter().collect();
    sorted.sort_by(|a, b| b.dissipated.total_cmp(&a.dissipated));
    let heads = [
        "friction",
        "most from",
        "dissipated",
        "peak",
        "at time",
        "stuck",
        "trans.",
        "sliding",
        "sticks",
        "largest creep",
    ];
    let rows = sorted.into_iter().map(|history| {
        let units = &history.units;
        let most = (0..4).fold(0, |best, k| {
            if history.mean_shares[k] > history.mean_shares[best] {
                k
            } else {
                best
            }
        });
        let cause = if history.mean_shares[most] > 0.0 {
            CAUSES[most]
        } else {
            ""
        };
        [
            history.label(),
            cause.to_owned(),
            quantity(history.dissipated, &units.energy),
            quantity(history.peak.value, &units.load),
            format!("{:.6} {}", history.peak.time, units.time),
            percent(history.regimes[0]),
            percent(history.regimes[1]),
            percent(history.regimes[2]),
            history.stick_count.to_string(),
            quantity(history.largest_creep, &units.length),
        ]
    });
    text_table(heads, 2, rows)
}

/// Units of what is told of a friction.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct Units {
    /// Time.
    pub time: String,
    /// Force.
    pub force: String,
    /// Torque.
    pub torque: String,
    /// Load, and the friction that it is compared with: a force where the joint slides, else a torque.
    pub load: String,
    /// Creep.
    pub length: String,
    /// Velocity of the sliding surfaces.
    pub velocity: String,
    /// Energy.
    pub energy: String,
    /// Power.
    pub power: String,
}

/// A number for people with its unit.
fn quantity(value: f64, unit: &str) -> String {
    if value == 0.0 {
        format!("0 {unit}")
    } else {
        format!("{value:.4e} {unit}")
    }
}

fn percent(share: f64) -> String {
    format!("{:.1} %", 100.0 * share)
}

/// `FRICTION/3 (HINGE)`.
fn label(id: u32, name: &str) -> String {
    if name == format!("FRICTION_{id}") {
        format!("FRICTION/{id}")
    } else {
        format!("FRICTION/{id} ({name})")
    }
}
