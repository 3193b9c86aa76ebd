//! Writes the rows of results while a simulation runs.

use std::fs::{File, OpenOptions};
use std::io::{self, Seek, Write};
use std::path::{Path, PathBuf};
use std::time::Instant;

use mechanics::{Snapshot, Statistics, StepReport};
use results::{Blocks, DataKind, Header, ReqWriter, ResWriter, StepRow, WriteError};

use crate::balance::EnergyAccount;
use crate::channels::{Channels, Row};
use crate::checkpoint::{CheckpointError, Keeper, Marks, ResumeError};
use crate::journal::Journal;
use crate::lower::Outputs;
use crate::report::{self, FrictionReport};
use crate::second_run::Role;
use crate::session::{OutputError, Progress, Watch};
use crate::sink::Sink;
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
        let create = |path: &Path| File::create(path).map_err(|e| OutputError::at(path, &e));
        let res = ResWriter::new(create(&paths[0])?, header, channels.layout().clone());
        let res = res.map_err(|error| OutputError::at(&paths[0], &error))?;
        let (title, units, requests) = (&header.title, &header.units, channels.requests());
        let req = ReqWriter::new(create(&paths[1])?, title, None, units, requests);
        let req = req.map_err(|error| OutputError::at(&paths[1], &error))?;
        Ok(Self { res, req, paths })
    }

    /// Goes on with both behind what was written before a checkpoint.
    pub(crate) fn resume(
        folder: &Path,
        marks: &Marks,
        channels: &Channels,
    ) -> Result<Self, ResumeError> {
        let paths = marks.names.each_ref().map(|name| folder.join(name));
        let res = reopened(&paths[0], marks.lengths[0])?;
        let req = reopened(&paths[1], marks.lengths[1])?;
        Ok(Self {
            res: ResWriter::append(res, channels.layout().clone(), marks.blocks),
            req: ReqWriter::append(req, channels.requests().len()),
            paths,
        })
    }

    /// Lengths and names, once everything is on the disk.
    fn marks(&self) -> Result<([u64; 2], [String; 2], Blocks), OutputError> {
        let length = |place: usize, file: &File| {
            length_on_disk(file).map_err(|error| self.error(place, &error))
        };
        let lengths = [
            length(0, self.res.get_ref())?,
            length(1, self.req.get_ref())?,
        ];
        Ok((
            lengths,
            self.paths.each_ref().map(|path| name(path)),
            self.res.blocks(),
        ))
    }
}

/// Length of a file that is being written, once all of it is on the disk.
pub(crate) fn length_on_disk(file: &File) -> io::Result<u64> {
    file.sync_data()?;
    // A device has no length.
    (&mut &*file).stream_position()
}

/// A file to be written on from `length`; what is behind that is dropped.
pub(crate) fn reopened(path: &Path, length: u64) -> Result<File, ResumeError> {
    let wrong = |error: io::Error| OutputError::at(path, &error);
    let mut file = OpenOptions::new().write(true).open(path).map_err(wrong)?;
    let found = file.metadata().map_err(wrong)?.len();
    if found < length {
        return Err(ResumeError::Refused {
            path: path.display().to_string(),
            cause: CheckpointError::Results {
                file: name(path),
                found,
                expected: length,
            },
        });
    }
    file.set_len(length).map_err(wrong)?;
    file.seek(io::SeekFrom::End(0)).map_err(wrong)?;
    Ok(file)
}

fn name(path: &Path) -> String {
    path.file_name()
        .unwrap_or_default()
        .to_string_lossy()
        .into_owned()
}

impl Recorder<'_, File> {
    /// How far its files are written.
    pub(crate) fn marks(&self, messages: u64) -> Result<Marks, OutputError> {
        let Some(files) = &self.files else {
            return Err(OutputError::new("checkpoint", &"the run writes no .res"));
        };
        let ([res, req], names, blocks) = files.marks()?;
        Ok(Marks {
            names,
            lengths: [res, req, messages],
            blocks,
            others: self.others.iter().map(|path| name(path)).collect(),
        })
    }
}

impl<W: Write> ResultFiles<W> {
    fn error(&self, place: usize, cause: &impl ToString) -> OutputError {
        OutputError::at(&self.paths[place], cause)
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

/// Where results go and what a row needs.
pub(crate) struct Recorder<'a, W: Write> {
    /// `.res` and `.req`; none where the run writes none.
    pub(crate) files: Option<ResultFiles<W>>,
    pub(crate) sink: Option<&'a mut dyn Sink>,
    /// What the rows that are written now belong to.
    pub(crate) kind: DataKind,
    /// Paths of the message file and of results that are finished.
    pub(crate) others: Vec<PathBuf>,
    pub(crate) channels: Channels,
    pub(crate) outputs: Outputs,
    pub(crate) row: Row,
    pub(crate) frictions: Vec<FrictionReport>,
    pub(crate) account: EnergyAccount,
    /// Rows written after the initial conditions.
    pub(crate) count: usize,
    /// What the run is in a comparison with another one.
    pub(crate) role: Role,
}

impl<W: Write> Recorder<'_, W> {
    /// Ends the files and writes others.
    pub(crate) fn change_files(
        &mut self,
        files: ResultFiles<W>,
        status: &str,
    ) -> Result<(), OutputError> {
        if let Some(before) = self.files.replace(files) {
            self.others.extend(before.finish(status)?);
        }
        Ok(())
    }

    /// Whether one of the files of this run has this path.
    pub(crate) fn has_written(&self, path: &Path) -> bool {
        let open = self.files.iter().flat_map(|files| &files.paths);
        self.others
            .iter()
            .chain(open)
            .any(|written| written == path)
    }

    /// The block that stands for the model as given: zeros, as in Adams.
    pub(crate) fn model_input(&mut self) -> Result<(), OutputError> {
        let Some(files) = &mut self.files else {
            return Ok(());
        };
        let zeros = vec![0.0; self.channels.layout().value_count()];
        let written = files.res.begin_data(DataKind::ModelInput);
        let written = written.and_then(|()| files.res.step(0.0, &zeros));
        written.map_err(|error| files.res_error(&error))
    }

    /// Begins a block of rows.
    pub(crate) fn begin(&mut self, kind: DataKind) -> Result<(), OutputError> {
        self.account.pause();
        self.kind = kind;
        let Some(files) = &mut self.files else {
            return Ok(());
        };
        let begun = files.res.begin_data(kind);
        begun.map_err(|error| files.res_error(&error))
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
        if let Some(sink) = &mut self.sink {
            let taken = sink.row(self.kind, time, &self.row.values);
            taken.map_err(Stop::Output)?;
        }
        let Some(files) = &mut self.files else {
            return Ok(());
        };
        let written = files.req.step(time, &self.row.requests);
        written.map_err(|error| Stop::Output(files.error(1, &error)))
    }

    fn write_results(&mut self, wrenches: &Wrenches<'_>) -> Result<(), Stop> {
        let (outputs, account) = (&self.outputs, &self.account);
        self.channels
            .fill(outputs, wrenches, account, &mut self.row);
        let time = wrenches.snapshot().time();
        if let Some(column) = self.row.values.iter().position(|value| !value.is_finite()) {
            let name = self.channels.layout().name_of(column).unwrap_or_default();
            return Err(Stop::NotFinite(format!(
                "the result {name} is not a finite number at time {time}"
            )));
        }
        let Some(files) = &mut self.files else {
            return Ok(());
        };
        let written = files.res.step(time, &self.row.values);
        written.map_err(|error| Stop::Output(files.res_error(&error)))
    }
}

/// Takes steps and outputs of a simulation to the files.
pub(crate) struct Observe<'a, 'p, W: Write> {
    pub(crate) recorder: &'a mut Recorder<'p, W>,
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
    /// Outputs written in this simulation.
    pub(crate) taken: usize,
    /// What knows when to write a checkpoint.
    pub(crate) keeper: Option<&'a Keeper>,
    /// What the integrator did up to the last step.
    pub(crate) statistics: Statistics,
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
        self.statistics = report.statistics;
        let progress = self.progress(report.time);
        self.interrupted = self.interrupted || !self.watch.progress(&progress);
        true
    }

    fn progress(&self, time: f64) -> Progress {
        Progress {
            time,
            end: self.end,
            statistics: self.statistics,
        }
    }

    /// Whether to pause after a step: the run is interrupted, or a checkpoint is due.
    pub(crate) fn pauses(&self) -> bool {
        self.interrupted || self.keeper.is_some_and(Keeper::is_due)
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
            Ok(()) => {
                self.taken += 1;
                self.compare(wrenches.snapshot());
                true
            }
            Err(stop) => {
                self.stop = Some(stop);
                false
            }
        }
    }

    /// Takes an output to the comparison with another run, which may have it wait for that one.
    fn compare(&mut self, snapshot: &Snapshot<'_>) {
        if self.interrupted {
            return;
        }
        let progress = self.progress(snapshot.time());
        let attempts = progress.statistics.steps.attempts();
        let goes_on = || self.watch.progress(&progress);
        self.interrupted = !self.recorder.role.output(snapshot, attempts, goes_on);
    }
}
