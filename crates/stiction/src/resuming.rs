//! Checkpoints of a run written and taken up.

use std::time::{Duration, Instant};

use crate::checkpoint::{Checkpoint, RunProgress, UnderWay};
use crate::lower::{Measures, lower};
use crate::recorder::length_on_disk;
use crate::runner::Runner;
use crate::session::OutputError;

impl Runner<'_> {
    /// Writes a checkpoint, between two commands or within the simulation that is under way.
    pub(crate) fn checkpoint(&mut self, under_way: Option<UnderWay>) -> Result<(), OutputError> {
        let Some(mut keeper) = self.keeper.take() else {
            return Ok(());
        };
        let messages = length_on_disk(self.log.get_ref());
        let messages = messages.map_err(|error| self.log.error(&error))?;
        let checkpoint = Checkpoint {
            job: keeper.job.clone(),
            command: self.command,
            under_way,
            progress: RunProgress {
                changes: self.changes_made.clone(),
                setting: self.setting(self.lowered.mode),
                numbering: self.measures.numbering(),
                buffers: self.buffers.clone(),
                assembled: self.assembled,
                recorded: self.instant,
                length: self.length,
                simulations: self.simulations,
                failures: self.failures.clone(),
                modes: self.modes.clone(),
                resumed: self.resumed.clone(),
                elapsed: self.started.elapsed(),
                frictions: self
                    .recorder
                    .frictions
                    .iter()
                    .map(|f| f.counted())
                    .collect(),
                account: self.recorder.account.clone(),
                count: self.recorder.count,
                told: self.log.told(),
                files: self.recorder.marks(messages)?,
            },
            simulation: self.simulation.paused(),
        };
        let written = keeper.write(&checkpoint);
        self.keeper = Some(keeper);
        written
    }

    /// Goes to where a checkpoint was written.
    pub(crate) fn take_up(&mut self, checkpoint: Checkpoint<'static>) -> Result<(), OutputError> {
        let progress = checkpoint.progress;
        self.command = checkpoint.command;
        self.under_way = checkpoint.under_way;
        self.dataset = self.changed_dataset(&progress.changes);
        self.changes_made = progress.changes;
        self.measures = Measures::of_numbering(&progress.numbering);
        let source = self.session.project.model_source().name();
        let lowered = lower(&self.dataset, source, &mut self.measures, &progress.setting);
        self.lowered = lowered.map_err(|diagnostics| {
            // It was lowered before the checkpoint.
            OutputError::new(source, &format!("{} errors", diagnostics.len()))
        })?;
        self.simulation = checkpoint.simulation.of_model(self.lowered.model.clone());
        self.kept = progress.setting.kept;
        self.buffers = progress.buffers;
        self.assembled = progress.assembled;
        self.instant = progress.recorded;
        self.length = progress.length;
        self.simulations = progress.simulations;
        self.failures = progress.failures;
        self.modes = progress.modes;
        self.resumed = progress.resumed;
        self.resumed.push(self.simulation.state().time);
        self.started = before(progress.elapsed);
        let recorder = &mut self.recorder;
        recorder.outputs = self.lowered.outputs.clone();
        for (report, counted) in recorder.frictions.iter_mut().zip(progress.frictions) {
            report.set_counted(counted);
        }
        recorder.account = progress.account;
        recorder.count = progress.count;
        let others = progress.files.others.iter();
        recorder.others = others.map(|name| self.folder.join(name)).collect();
        Ok(())
    }
}

/// The instant so long ago.
fn before(elapsed: Duration) -> Instant {
    let now = Instant::now();
    now.checked_sub(elapsed).unwrap_or(now)
}
