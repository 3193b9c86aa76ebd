//! Cases on the cores of one machine.

use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::atomic::{AtomicBool, AtomicUsize, Ordering};
use std::sync::mpsc::{self, RecvTimeoutError};
use std::time::{Duration, Instant};

use stiction::{OutputError, Progress, Watch};

use crate::record::{Record, RecordError};
use crate::study::Row;

/// Wall time between two looks whether to go on.
const LOOK: Duration = Duration::from_millis(50);

/// Goes on until a flag says not to.
pub struct Until<'a>(pub &'a AtomicBool);

impl Watch for Until<'_> {
    fn progress(&mut self, _: &Progress) -> bool {
        !self.0.load(Ordering::Relaxed)
    }
}

/// Makes the row of a case, with a folder for its files and a flag that stops it; `None` where that
/// has happened.
pub type Evaluate<'a> =
    dyn Fn(usize, &Path, &AtomicBool) -> Result<Option<Row>, OutputError> + Sync + 'a;

/// Runs the cases that are not done, so many at a time, and records each when it is done. `told` is
/// called now and then with the record and says whether to go on. Returns whether all cases are done.
///
/// A case that panics has failed, as one that cannot be solved.
///
/// # Errors
/// Files that cannot be written; what was written before is whole.
pub fn run(
    record: &mut Record,
    workers: usize,
    evaluate: &Evaluate<'_>,
    told: &mut dyn FnMut(&Record) -> bool,
) -> Result<bool, RecordError> {
    let open = record.open_cases();
    let outputs = record.study().outputs().count();
    let (next, stopped) = (AtomicUsize::new(0), AtomicBool::new(false));
    let scratch =
        tempfile::tempdir().map_err(|error| OutputError::at(&std::env::temp_dir(), &error))?;
    let (send, receive) = mpsc::channel();
    let work = |folder: &Path, send: mpsc::Sender<Result<Row, OutputError>>| {
        while !stopped.load(Ordering::Relaxed) {
            let Some(case) = open.get(next.fetch_add(1, Ordering::Relaxed)) else {
                break;
            };
            let made = catch_unwind(AssertUnwindSafe(|| evaluate(*case, folder, &stopped)));
            let failed = || {
                let message = "internal error; please report it with the model".to_owned();
                Ok(Some(Row::failed(*case, outputs, message, 0)))
            };
            let Some(row) = made.unwrap_or_else(|_| failed()).transpose() else {
                break;
            };
            if send.send(row).is_err() {
                break;
            }
        }
    };
    let mut result = Ok(());
    std::thread::scope(|scope| {
        for worker in 0..workers.clamp(1, open.len().max(1)) {
            let (send, folder) = (send.clone(), scratch.path().join(worker.to_string()));
            let work = &work;
            scope.spawn(move || {
                // Where it cannot be made the runs say so.
                let _ = std::fs::create_dir_all(&folder);
                work(&folder, send);
            });
        }
        drop(send);
        let mut looked = Instant::now();
        loop {
            let taken = match receive.recv_timeout(LOOK) {
                Ok(row) => row
                    .map_err(RecordError::from)
                    .and_then(|row| record.push(row)),
                Err(RecvTimeoutError::Timeout) => record.keep_up(),
                Err(RecvTimeoutError::Disconnected) => break,
            };
            if result.is_ok() {
                result = taken;
            }
            let due = looked.elapsed() >= LOOK;
            if due {
                looked = Instant::now();
            }
            if result.is_err() || (due && !told(record)) {
                stopped.store(true, Ordering::Relaxed);
            }
        }
    });
    result?;
    record.finish()?;
    Ok(record.open_cases().is_empty())
}
