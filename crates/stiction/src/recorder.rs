//! Writes the rows of results while a simulation runs.

use std::fs::File;
use std::io::Write;
use std::path::{Path, PathBuf};
use std::time::Instant;

use mechanics::{Snapshot, StepReport};
use results::{DataKind, Header, ReqWriter, ResWriter, StepRow, WriteError};

use crate::balance::EnergyAccount;
use crate::channels::{Channels, Row};
use crate::journal::Journal;
use crate::lower::Outputs;
use crate::report::{self, FrictionReport};
use crate::session::{OutputError, Progress, Watch};
use crate::wrenches::Wrenches;

/// Why writing stops a run.
pub(crate) enum Stop {
    /// A file cannot be written.
    Output(OutputError),
    /// A value is not a finite number.
    NotFinite(String),
}

/// A `.res` and a `.req` that are being written.
pub(crate) struct ResultFiles<W: Write> {
    res: ResWriter<W>,
    req: ReqWriter<W>,
    paths: [PathBuf; 2],
}

impl ResultFiles<File> {
    /// The paths of the two files of a prefix.
    pub(crate) fn paths(folder: &Path, prefix: &str) -> [PathBuf; 2] {
        ["res", "req"].map(|extension| folder.join(format!("{prefix}.{extension}")))
    }

    /// Creates both with their heads.
    pub(crate) fn create(
        paths: [PathBuf; 2],
        header: &Header,
        channels: &Channels,
    ) -> Result<Self, OutputError> {
        let wrong =
            |path: &Path, cause: String| OutputError::new(path.display().to_string(), &cause);
        let create = |path: &Path| File::create(path).map_err(|e| wrong(path, e.to_string()));
        let res = ResWriter::new(create(&paths[0])?, header, channels.layout().clone());
        let res = res.map_err(|error| wrong(&paths[0], error.to_string()))?;
        let (title, units, requests) = (&header.title, &header.units, channels.requests());
        let req = ReqWriter::new(create(&paths[1])?, title, None, units, requests);
        let req = req.map_err(|error| wrong(&paths[1], error.to_string()))?;
        Ok(Self { res, req, paths })
    }
}

impl<W: Write> ResultFiles<W> {
    fn error(&self, place: usize, cause: &impl ToString) -> OutputError {
        OutputError::new(self.paths[place].display().to_string(), cause)
    }

    fn res_error(&self, error: &WriteError) -> OutputError {
        self.error(0, error)
    }

    /// Ends both; returns their paths.
    pub(crate) fn finish(self, status: &str) -> Result<[PathBuf; 2], OutputError> {
        let Self { res, paths, .. } = self;
        let shown = paths[0].display().to_string();
        res.finish(status)
            .map_err(|error| OutputError::new(shown, &error))?;
        Ok(paths)
    }
}

/// The files of results and what a row needs.
pub(crate) struct Recorder<W: Write> {
    pub(crate) files: ResultFiles<W>,
    /// Paths of the message file and of results that are finished.
    pub(crate) others: Vec<PathBuf>,
    pub(crate) channels: Channels,
    pub(crate) outputs: Outputs,
    pub(crate) row: Row,
    pub(crate) frictions: Vec<FrictionReport>,
    pub(crate) account: EnergyAccount,
    /// Rows written after the initial conditions.
    pub(crate) count: usize,
}

impl<W: Write> Recorder<W> {
    /// Ends the files and writes others.
    pub(crate) fn change_files(
        &mut self,
        files: ResultFiles<W>,
        status: &str,
    ) -> Result<(), OutputError> {
        let before = std::mem::replace(&mut self.files, files);
        self.others.extend(before.finish(status)?);
        Ok(())
    }

    /// Whether one of the files of this run has this path.
    pub(crate) fn has_written(&self, path: &Path) -> bool {
        let all = self.others.iter().chain(&self.files.paths);
        all.into_iter().any(|written| written == path)
    }

    /// The block that stands for the model as given: zeros, as in Adams.
    pub(crate) fn model_input(&mut self) -> Result<(), OutputError> {
        let zeros = vec![0.0; self.channels.layout().value_count()];
        let written = self.files.res.begin_data(DataKind::ModelInput);
        let written = written.and_then(|()| self.files.res.step(0.0, &zeros));
        written.map_err(|error| self.files.res_error(&error))
    }

    /// Begins a block of rows.
    pub(crate) fn begin(&mut self, kind: DataKind) -> Result<(), OutputError> {
        self.account.pause();
        self.files
            .res
            .begin_data(kind)
            .map_err(|error| self.files.res_error(&error))
    }

    /// Begins the rows of a dynamic or kinematic simulation that starts at this instant, whose
    /// velocities may be off by `error`.
    pub(crate) fn begin_motion(
        &mut self,
        kind: DataKind,
        snapshot: &Snapshot<'_>,
        error: f64,
    ) -> Result<(), OutputError> {
        self.begin(kind)?;
        self.account.begin(&Wrenches::new(snapshot), error);
        Ok(())
    }

    /// The assembled model at its start.
    pub(crate) fn initial(&mut self, snapshot: &Snapshot<'_>) -> Result<(), Stop> {
        self.begin(DataKind::InitialConditions)
            .map_err(Stop::Output)?;
        self.write(&Wrenches::new(snapshot))
    }

    /// The start of a motion from an equilibrium whose requests are written already.
    pub(crate) fn initial_without_requests(&mut self, snapshot: &Snapshot<'_>) -> Result<(), Stop> {
        self.begin(DataKind::InitialConditions)
            .map_err(Stop::Output)?;
        self.write_results(&Wrenches::new(snapshot))
    }

    /// A row at an output time.
    fn output(&mut self, wrenches: &Wrenches<'_>) -> Result<(), Stop> {
        self.account.output(wrenches);
        self.write(wrenches)?;
        self.count += 1;
        Ok(())
    }

    fn write(&mut self, wrenches: &Wrenches<'_>) -> Result<(), Stop> {
        self.write_results(wrenches)?;
        let dissipated = self.account.dissipated();
        report::add(&mut self.frictions, wrenches, dissipated);
        let time = wrenches.snapshot().time();
        let written = self.files.req.step(time, &self.row.requests);
        written.map_err(|error| Stop::Output(self.files.error(1, &error)))
    }

    fn write_results(&mut self, wrenches: &Wrenches<'_>) -> Result<(), Stop> {
        let (outputs, dissipated) = (&self.outputs, self.account.dissipated());
        self.channels
            .fill(outputs, wrenches, dissipated, &mut self.row);
        let time = wrenches.snapshot().time();
        if let Some(column) = self.row.values.iter().position(|value| !value.is_finite()) {
            let name = self.channels.layout().name_of(column).unwrap_or_default();
            return Err(Stop::NotFinite(format!(
                "the result {name} is not a finite number at time {time}"
            )));
        }
        let written = self.files.res.step(time, &self.row.values);
        written.map_err(|error| Stop::Output(self.files.res_error(&error)))
    }
}

/// Takes steps and outputs of a simulation to the files.
pub(crate) struct Observe<'a, 'p, W: Write> {
    pub(crate) recorder: &'a mut Recorder<W>,
    pub(crate) log: &'a mut Journal<'p, W>,
    pub(crate) watch: &'a mut dyn Watch,
    /// When the run began.
    pub(crate) started: Instant,
    /// End of the last simulation of the run.
    pub(crate) end: f64,
    /// Time from which the next row of the integrator's table is due.
    pub(crate) next_row: f64,
    pub(crate) row_interval: f64,
    /// Typical length of the model.
    pub(crate) length: f64,
    /// Set when writing stops the run.
    pub(crate) stop: Option<Stop>,
    /// Set when the watch stops the run.
    pub(crate) interrupted: bool,
}

impl<W: Write> Observe<'_, '_, W> {
    /// After an accepted step; returns whether to go on.
    pub(crate) fn step(&mut self, report: &StepReport) -> bool {
        if report.time >= self.next_row {
            let row = StepRow {
                time: report.time,
                step: report.size,
                evaluations: report.statistics.work.residuals as u64,
                steps: report.statistics.steps.steps as u64,
                order: report.order as u32,
                elapsed: self.started.elapsed().as_secs_f64(),
            };
            self.next_row = report.time + self.row_interval;
            if let Err(error) = self.log.step_row(&row) {
                self.stop = Some(Stop::Output(error));
                return false;
            }
        }
        let progress = Progress {
            time: report.time,
            end: self.end,
            statistics: report.statistics,
        };
        self.interrupted = !self.watch.progress(&progress);
        !self.interrupted
    }

    /// At an output; returns whether to go on.
    pub(crate) fn output(&mut self, wrenches: &Wrenches<'_>) -> bool {
        let written = self.recorder.output(wrenches);
        let warned = written.and_then(|()| {
            let watched = self.log.watch_overlap(wrenches);
            let snapshot = wrenches.snapshot();
            let watched = watched.and_then(|()| self.log.watch_redundant(snapshot, self.length));
            watched.map_err(Stop::Output)
        });
        match warned {
            Ok(()) => true,
            Err(stop) => {
                self.stop = Some(stop);
                false
            }
        }
    }
}
