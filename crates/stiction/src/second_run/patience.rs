//! How long a run waits for its second run: steps, not seconds, so that what is told of it does not
//! depend on the machine.

use std::cmp::Ordering as Order;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::sync::mpsc::SyncSender;
use std::sync::{Arc, Mutex, PoisonError};

use super::Told;
use crate::accuracy::SecondFailure;
use crate::session::{Progress, Watch};

/// Attempts at steps that the second run may take for one of the first run, beside [`FREE_ATTEMPTS`]. A
/// tenth of ERROR takes 1.5 to 3.2 times as many (docs/accuracy.md).
const ATTEMPTS: usize = 5;
/// Attempts that it may take anyway.
const FREE_ATTEMPTS: usize = 1000;

/// How long the first run waits for the second one.
#[derive(Default)]
pub(super) struct Patience {
    /// Place of the command that the second run is at.
    pub(super) command: AtomicUsize,
    waiting: Mutex<Waiting>,
}

/// What the first run waits for.
#[derive(Clone, Copy, Default)]
pub(super) enum Waiting {
    /// Nothing.
    #[default]
    Not,
    /// The output of the second run at this time of this command, if it comes after no more than so many
    /// attempts at steps.
    For {
        command: usize,
        time: f64,
        attempts: usize,
    },
    /// Nothing any more.
    Over,
}

impl Patience {
    pub(super) fn set(&self, waiting: Waiting) {
        *self.waiting.lock().unwrap_or_else(PoisonError::into_inner) = waiting;
    }

    fn get(&self) -> Waiting {
        *self.waiting.lock().unwrap_or_else(PoisonError::into_inner)
    }
}

/// Attempts at steps that the second run may have taken where the first one has taken `attempts`.
pub(super) fn bearable(attempts: usize) -> usize {
    attempts
        .saturating_mul(ATTEMPTS)
        .saturating_add(FREE_ATTEMPTS)
}

/// What is told of a second run that takes more.
pub(super) fn impatience(time: f64) -> SecondFailure {
    SecondFailure {
        time: Some(time),
        cause: format!("until then it takes more than {ATTEMPTS} times the steps"),
    }
}

/// Goes on while the first run waits.
pub(super) struct WhileAwaited {
    pub(super) told: SyncSender<Told>,
    pub(super) patience: Arc<Patience>,
}

impl Watch for WhileAwaited {
    fn progress(&mut self, progress: &Progress) -> bool {
        let (command, time, attempts) = match self.patience.get() {
            Waiting::Not => return true,
            Waiting::Over => return false,
            Waiting::For {
                command,
                time,
                attempts,
            } => (command, time, attempts),
        };
        let own = self.patience.command.load(Ordering::Relaxed);
        // Beyond the output that the first run waits for these are no attempts to get there.
        let before = own.cmp(&command).then(progress.time.total_cmp(&time)) == Order::Less;
        let goes_on = !before || progress.statistics.steps.attempts() <= attempts;
        if !goes_on {
            // The first run may have ended.
            let _ = self.told.send(Told::Failed(impatience(time)));
        }
        goes_on
    }
}
