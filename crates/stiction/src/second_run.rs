//! A second run of the same commands with a tenth of ERROR, beside the first one in a thread of its own.
//!
//! Both carry out the command file. The second one writes nothing; it sends what it has at each output
//! through a channel that holds a few, and the first one waits for it there, so that neither gets far
//! ahead and no run is kept. Nothing goes the other way but that the first one has ended.

use std::cmp::Ordering as Order;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::{AtomicBool, Ordering};
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::thread;
use std::time::Duration;

use mechanics::model::Model;
use mechanics::{
    Comparison, EquilibriumSettings, Formulation, Moment, Settings, Snapshot, StepError,
};
use results::UnitNames;

use crate::accuracy::{AccuracyReport, SecondFailure, remedy};
use crate::session::{Outcome, OutputError, Progress, RunOptions, RunReport, Session, Watch};

/// Outputs that the second run may be ahead.
const AHEAD: usize = 4;
/// Time between two looks at the watch while the first run waits.
const LOOK: Duration = Duration::from_millis(500);

/// What a run is in a comparison.
pub(crate) enum Role {
    /// It is not compared.
    Alone,
    /// It is compared with a second run.
    First(Box<First>),
    /// It is the second run.
    Second(Second),
}

/// What the second run tells.
enum Told {
    /// What it has at an output, of the command at a place among the commands.
    Output { command: usize, moment: Moment },
    /// What has failed.
    Failed(SecondFailure),
}

/// The second run's way to the first one.
pub(crate) struct Second {
    command: usize,
    told: SyncSender<Told>,
}

/// The first run's way to the second one, and what came of the comparison.
pub(crate) struct First {
    command: usize,
    told: Receiver<Told>,
    /// An output of the second run that waits for that of the first one.
    next: Option<(usize, Moment)>,
    over: Arc<AtomicBool>,
    comparison: Comparison,
    unmatched: usize,
    failure: Option<SecondFailure>,
    /// One error of a step of the present simulation.
    step_error: StepError,
    length: f64,
    /// The largest ERROR of integrators so far, and the power of it that errors are (none where it has no
    /// say): what a simulation has left is not the fault of the next one.
    error: f64,
    exponent: Option<f64>,
    /// Error of a run with it for a difference of one.
    safety: f64,
}

impl Drop for First {
    fn drop(&mut self) {
        self.over.store(true, Ordering::Relaxed);
    }
}

/// Goes on until the first run has ended.
struct UntilOver(Arc<AtomicBool>);

impl Watch for UntilOver {
    fn progress(&mut self, _: &Progress) -> bool {
        !self.0.load(Ordering::Relaxed)
    }
}

/// Carries out a run beside a second one.
pub(crate) fn beside(
    session: &Session<'_>,
    folder: &Path,
    options: RunOptions,
    first: impl FnOnce(Role) -> Result<RunReport, OutputError>,
) -> Result<RunReport, OutputError> {
    let (sender, receiver) = sync_channel(AHEAD);
    let over = Arc::new(AtomicBool::new(false));
    let mut first_role = First {
        command: 0,
        told: receiver,
        next: None,
        over: Arc::clone(&over),
        comparison: Comparison::default(),
        unmatched: 0,
        failure: None,
        safety: 0.0,
        step_error: StepError::new(0.0, 0.0),
        length: 1.0,
        error: 0.0,
        exponent: None,
    };
    thread::scope(|scope| {
        let second = move || {
            let last_word = sender.clone();
            let run = || second_run(session, folder, options, sender, UntilOver(over));
            let ended = catch_unwind(AssertUnwindSafe(run));
            let cause = ended.unwrap_or_else(|_| Some("it panicked".to_owned()));
            if let Some(cause) = cause {
                let failure = SecondFailure { time: None, cause };
                // Without the first run there is no one to tell.
                let _ = last_word.send(Told::Failed(failure));
            }
        };
        let spawned = thread::Builder::new().spawn_scoped(scope, second);
        if let Err(error) = spawned {
            let cause = format!("it has no thread: {error}");
            first_role.failure = Some(SecondFailure { time: None, cause });
        }
        first(Role::First(Box::new(first_role)))
    })
}

/// The second run; returns why it could not be carried out.
fn second_run(
    session: &Session<'_>,
    folder: &Path,
    options: RunOptions,
    told: SyncSender<Told>,
    mut watch: UntilOver,
) -> Option<String> {
    let options = RunOptions {
        checkpoint: None,
        text_results: false,
        check_accuracy: false,
        ..options
    };
    let role = Role::Second(Second { command: 0, told });
    let runner = session.begin(folder, options, None, role);
    let ran = runner.and_then(|runner| runner.carry_out(&mut watch));
    ran.err().map(|error| error.to_string())
}

impl Role {
    /// Whether it is the second run, which writes no files.
    pub(crate) fn is_second(&self) -> bool {
        matches!(self, Self::Second(_))
    }

    /// The command at this place begins.
    pub(crate) fn command(&mut self, place: usize) {
        match self {
            Self::Alone => {}
            Self::First(first) => first.command = place,
            Self::Second(second) => second.command = place,
        }
    }

    /// A simulation begins: the settings that this run integrates with.
    pub(crate) fn integration(&mut self, settings: Settings, length: f64) -> Settings {
        match self {
            Self::Alone => settings,
            Self::First(first) => {
                if settings.error >= first.error {
                    first.error = settings.error;
                    first.safety = StepError::of(&settings, length).safety;
                    // Errors of steps, the square of the step for NEWMARK and its cube for HHT, add up to
                    // those of a run, which are a power of the step less; formulas of higher order are
                    // not worse.
                    let exponent = match settings.formulation {
                        Formulation::Newmark { .. } => 1.0 / 2.0,
                        _ => 2.0 / 3.0,
                    };
                    let fixed = settings.corrector.fixed.is_some();
                    first.exponent = (!fixed).then_some(exponent);
                }
                first.length = length;
                first.step_error = StepError {
                    safety: first.safety,
                    ..StepError::new(first.error, length)
                };
                settings
            }
            Self::Second(_) => settings.tighter(),
        }
    }

    /// Equilibria begin: the settings that this run finds them with.
    pub(crate) fn equilibria(&mut self, settings: EquilibriumSettings) -> EquilibriumSettings {
        match self {
            Self::Alone => settings,
            Self::First(first) => {
                // Their ERROR is a length and radians.
                first.step_error = StepError::new(settings.error, 1.0);
                settings
            }
            Self::Second(_) => settings.tighter(),
        }
    }

    /// At an output; `goes_on` is asked now and then while the run waits for the other one. Returns
    /// whether to go on.
    pub(crate) fn output(
        &mut self,
        snapshot: &Snapshot<'_>,
        goes_on: impl FnMut() -> bool,
    ) -> bool {
        match self {
            Self::Alone => true,
            Self::First(first) => first.output(&Moment::of(snapshot), goes_on),
            Self::Second(Second { command, told }) => {
                let (command, moment) = (*command, Moment::of(snapshot));
                told.send(Told::Output { command, moment }).is_ok()
            }
        }
    }

    /// The run has come to its end: looks whether the other one does, too.
    pub(crate) fn completed(&mut self, goes_on: impl FnMut() -> bool) {
        if let Self::First(first) = self {
            let another = first.next.is_some() || first.receive(goes_on) == Found::Output;
            first.unmatched += usize::from(another);
        }
    }

    /// A command has failed.
    pub(crate) fn failed(&self, time: f64, outcome: &Outcome, text: Option<&str>) {
        let (Self::Second(second), (_, Some(words))) = (self, outcome.words()) else {
            return;
        };
        let failure = SecondFailure {
            time: Some(time),
            cause: text.unwrap_or(words).to_owned(),
        };
        // The first run may have ended.
        let _ = second.told.send(Told::Failed(failure));
    }

    /// What came of the comparison.
    pub(crate) fn report(&self, model: &Model, units: &UnitNames) -> Option<AccuracyReport> {
        let Self::First(first) = self else {
            return None;
        };
        let comparison = &first.comparison;
        let mut report = AccuracyReport::new(comparison, model, units);
        report.unmatched = first.unmatched;
        report.second_failure.clone_from(&first.failure);
        let largest = comparison.largest().filter(|_| !report.is_accurate());
        let largest = largest.zip(first.exponent);
        report.remedy = largest
            .and_then(|(largest, exponent)| remedy(largest, first.error, exponent, first.length));
        Some(report)
    }
}

/// What the first run finds when it looks for an output of the second one.
#[derive(Clone, Copy, PartialEq, Eq)]
enum Found {
    Output,
    /// There are no more.
    End,
    /// It has not come, and the watch stops the run.
    Stop,
}

impl First {
    /// Waits for the next output of the second run, which is then in `next`.
    fn receive(&mut self, mut goes_on: impl FnMut() -> bool) -> Found {
        loop {
            match self.told.recv_timeout(LOOK) {
                Ok(Told::Output { command, moment }) => {
                    self.next = Some((command, moment));
                    return Found::Output;
                }
                Ok(Told::Failed(failure)) => {
                    self.failure.get_or_insert(failure);
                }
                Err(RecvTimeoutError::Disconnected) => return Found::End,
                Err(RecvTimeoutError::Timeout) if goes_on() => {}
                Err(RecvTimeoutError::Timeout) => return Found::Stop,
            }
        }
    }

    /// Compares an output with that of the second run at the same time of the same command, where it
    /// has one; what it has before that is passed over.
    fn output(&mut self, moment: &Moment, mut goes_on: impl FnMut() -> bool) -> bool {
        loop {
            if self.next.is_none() {
                match self.receive(&mut goes_on) {
                    Found::Output => {}
                    Found::End => break,
                    Found::Stop => return false,
                }
            }
            let Some((command, other)) = &self.next else {
                break;
            };
            let commands = command.cmp(&self.command);
            match commands.then(other.time().total_cmp(&moment.time())) {
                Order::Less => self.unmatched += 1,
                Order::Equal => {
                    self.comparison.add(moment, other, self.step_error);
                    self.next = None;
                    return true;
                }
                Order::Greater => break,
            }
            self.next = None;
        }
        self.unmatched += 1;
        true
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    /// A first run, and the sender of what it is told.
    fn first() -> (First, SyncSender<Told>) {
        let (sender, told) = sync_channel(AHEAD);
        let first = First {
            command: 3,
            told,
            next: None,
            over: Arc::default(),
            comparison: Comparison::default(),
            unmatched: 0,
            failure: None,
            safety: 2.0,
            step_error: StepError::new(1e-3, 1.0),
            length: 1.0,
            error: 1e-3,
            exponent: Some(0.5),
        };
        (first, sender)
    }

    /// A model of nothing, and the moment of it at a time.
    fn moment(time: f64) -> Moment {
        let mut simulation = mechanics::Simulation::new(Model::default(), 1.0);
        simulation.set_state(mechanics::state::State::new(time, Vec::new()), &[]);
        Moment::of(&simulation.snapshot())
    }

    #[test]
    fn outputs_are_paired_by_command_and_time() {
        let (mut first, sender) = first();
        for (command, time) in [(2, 9.0), (3, 1.0), (3, 2.5), (4, 3.0)] {
            let moment = moment(time);
            assert!(sender.send(Told::Output { command, moment }).is_ok());
        }
        let mut at = |time| first.output(&moment(time), || unreachable!("nothing to wait for"));
        assert!(at(1.0) && at(2.0) && at(3.0));
        // One of the first has no counterpart at 2 and at 3, one of the second none at 9 and at 2.5.
        assert_eq!((first.comparison.instants, first.unmatched), (1, 4));
    }

    #[test]
    fn a_second_run_that_has_failed_is_told_and_none_waits_for_it() {
        let (mut first, sender) = first();
        for cause in ["it jams", "later"] {
            let (time, cause) = (Some(0.5), cause.to_owned());
            let failure = SecondFailure { time, cause };
            assert!(sender.send(Told::Failed(failure)).is_ok());
        }
        drop(sender);
        assert!(first.output(&moment(1.0), || unreachable!("no one to wait for")));
        let report = Role::First(Box::new(first)).report(&Model::default(), &UnitNames::default());
        let report = report.expect("a report of the first run");
        assert_eq!((report.outputs, report.unmatched), (0, 1));
        let failure = report.second_failure.expect("a failure");
        assert_eq!(
            (failure.time, failure.cause.as_str()),
            (Some(0.5), "it jams")
        );
    }

    #[test]
    fn an_interrupt_ends_the_wait() {
        let (mut first, sender) = first();
        assert!(!first.output(&moment(1.0), || false));
        let over = Arc::clone(&first.over);
        drop(first);
        // The second run has no one left to tell.
        assert!(over.load(Ordering::Relaxed));
        let moment = moment(1.0);
        assert!(sender.send(Told::Output { command: 3, moment }).is_err());
    }
}
