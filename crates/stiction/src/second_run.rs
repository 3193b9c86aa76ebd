//! A second run of the same commands with a tenth of ERROR, beside the first one in a thread of its own.
//!
//! Both carry out the command file. The second one writes nothing; it sends what it has at each output
//! through a channel that holds a few, and the first one waits for it there, so that neither gets far
//! ahead and no run is kept. The other way goes how long the first one will wait.

mod patience;

use std::cmp::Ordering as Order;
use std::panic::{AssertUnwindSafe, catch_unwind};
use std::path::Path;
use std::sync::Arc;
use std::sync::atomic::Ordering;
use std::sync::mpsc::{Receiver, RecvTimeoutError, SyncSender, sync_channel};
use std::thread;
use std::time::Duration;

use mechanics::model::Model;
use mechanics::{
    Comparison, EquilibriumSettings, Formulation, Moment, Settings, Snapshot, StepError,
};
use results::UnitNames;

use crate::accuracy::{AccuracyReport, SecondFailure, remedy};
use crate::session::{Outcome, OutputError, RunOptions, RunReport, Session};
use patience::{Patience, Waiting, WhileAwaited, bearable, impatience};

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
    /// What it has at an output, of the command at a place among the commands, after so many attempts
    /// at steps.
    Output {
        command: usize,
        moment: Moment,
        attempts: usize,
    },
    /// What has failed.
    Failed(SecondFailure),
}

/// The second run's way to the first one.
pub(crate) struct Second {
    told: SyncSender<Told>,
    patience: Arc<Patience>,
}

/// The first run's way to the second one, and what came of the comparison.
pub(crate) struct First {
    command: usize,
    /// None once it has given the second run up.
    told: Option<Receiver<Told>>,
    /// An output of the second run that waits for that of the first one.
    next: Option<(usize, Moment, usize)>,
    patience: Arc<Patience>,
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
        self.patience.set(Waiting::Over);
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
    let patience = Arc::<Patience>::default();
    let mut first_role = First {
        command: 0,
        told: Some(receiver),
        next: None,
        patience: Arc::clone(&patience),
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
            let run = || second_run(session, folder, options, sender, patience);
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
    patience: Arc<Patience>,
) -> Option<String> {
    let options = RunOptions {
        checkpoint: None,
        text_results: false,
        check_accuracy: false,
        ..options
    };
    let mut watch = WhileAwaited {
        told: told.clone(),
        patience: Arc::clone(&patience),
    };
    let role = Role::Second(Second { told, patience });
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
            Self::Second(second) => second.patience.command.store(place, Ordering::Relaxed),
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

    /// At an output, after so many attempts at steps; `goes_on` is asked now and then while the run waits
    /// for the other one. Returns whether to go on.
    pub(crate) fn output(
        &mut self,
        snapshot: &Snapshot<'_>,
        attempts: usize,
        goes_on: impl FnMut() -> bool,
    ) -> bool {
        match self {
            Self::Alone => true,
            Self::First(first) => first.output(&Moment::of(snapshot), attempts, goes_on),
            Self::Second(Second { told, patience }) => {
                let output = Told::Output {
                    command: patience.command.load(Ordering::Relaxed),
                    moment: Moment::of(snapshot),
                    attempts,
                };
                told.send(output).is_ok()
            }
        }
    }

    /// The run has come to its end after so many attempts at steps: looks whether the other one does, too.
    pub(crate) fn completed(&mut self, attempts: usize, goes_on: impl FnMut() -> bool) {
        if let Self::First(first) = self {
            first.wait_for(usize::MAX, f64::INFINITY, attempts);
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
    /// Tells the second run that it is waited for up to a time of a command, where the first one has
    /// come after so many attempts at steps.
    fn wait_for(&self, command: usize, time: f64, attempts: usize) {
        self.patience.set(Waiting::For {
            command,
            time,
            attempts: bearable(attempts),
        });
    }

    /// Waits for the next output of the second run, which is then in `next`.
    fn receive(&mut self, mut goes_on: impl FnMut() -> bool) -> Found {
        let Some(told) = &self.told else {
            return Found::End;
        };
        loop {
            match told.recv_timeout(LOOK) {
                Ok(Told::Output {
                    command,
                    moment,
                    attempts,
                }) => {
                    self.next = Some((command, moment, attempts));
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
    /// has one; what it has before that is passed over. This one is after `attempts` at steps.
    fn output(
        &mut self,
        moment: &Moment,
        attempts: usize,
        mut goes_on: impl FnMut() -> bool,
    ) -> bool {
        loop {
            if self.next.is_none() {
                self.wait_for(self.command, moment.time(), attempts);
                match self.receive(&mut goes_on) {
                    Found::Output => {}
                    Found::End => break,
                    Found::Stop => return false,
                }
            }
            let Some((command, other, taken)) = &self.next else {
                break;
            };
            let commands = command.cmp(&self.command);
            match commands.then(other.time().total_cmp(&moment.time())) {
                Order::Less => self.unmatched += 1,
                // It got here before it could know.
                Order::Equal if *taken > bearable(attempts) => {
                    self.failure.get_or_insert(impatience(moment.time()));
                    self.told = None;
                }
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
    use crate::session::{Progress, Watch};

    /// A first run, and the sender of what it is told.
    fn first() -> (First, SyncSender<Told>) {
        let (sender, told) = sync_channel(AHEAD);
        let first = First {
            command: 3,
            told: Some(told),
            next: None,
            patience: Arc::default(),
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

    /// An output of the second run.
    fn output(command: usize, time: f64, attempts: usize) -> Told {
        let moment = moment(time);
        Told::Output {
            command,
            moment,
            attempts,
        }
    }

    #[test]
    fn outputs_are_paired_by_command_and_time() {
        let (mut first, sender) = first();
        for (command, time) in [(2, 9.0), (3, 1.0), (3, 2.5), (4, 3.0)] {
            assert!(sender.send(output(command, time, 1)).is_ok());
        }
        let mut at = |time| first.output(&moment(time), 1, || unreachable!("nothing to wait for"));
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
        assert!(first.output(&moment(1.0), 1, || unreachable!("no one to wait for")));
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
        assert!(!first.output(&moment(1.0), 1, || false));
        let mut second = WhileAwaited {
            told: sender.clone(),
            patience: Arc::clone(&first.patience),
        };
        drop(first);
        // The second run has no one left to tell.
        assert!(!second.progress(&progress(1.0, 1)));
        assert!(sender.send(output(3, 1.0, 1)).is_err());
    }

    /// How far a run is at a time after so many steps.
    fn progress(time: f64, steps: usize) -> Progress {
        let mut statistics = mechanics::Statistics::default();
        statistics.steps.steps = steps;
        Progress {
            time,
            end: 9.0,
            statistics,
        }
    }

    /// What is told of the second run is the same, whether it takes too many steps while the first one
    /// waits or before that.
    #[test]
    fn a_second_run_of_too_many_steps_is_given_up() {
        let told = |waits: bool| {
            let (mut first, sender) = first();
            let mut second = WhileAwaited {
                told: sender.clone(),
                patience: Arc::clone(&first.patience),
            };
            second.patience.command.store(3, Ordering::Relaxed);
            assert!(sender.send(output(3, 1.0, 1000)).is_ok());
            assert!(first.output(&moment(1.0), 100, || unreachable!("nothing to wait for")));
            if waits {
                first.wait_for(3, 2.0, 200);
                assert!(second.progress(&progress(1.4, 2000)));
                // Too many for that output, and not for a later one.
                assert!(second.progress(&progress(2.0, 2001)));
                assert!(!second.progress(&progress(1.5, 2001)));
                drop((second, sender));
            } else {
                assert!(second.progress(&progress(1.9, 2001)));
                assert!(sender.send(output(3, 2.0, 2001)).is_ok());
                assert!(sender.send(output(3, 3.0, 2002)).is_ok());
            }
            for time in [2.0, 3.0] {
                assert!(first.output(&moment(time), 200, || unreachable!("no one to wait for")));
            }
            let role = Role::First(Box::new(first));
            let report = role.report(&Model::default(), &UnitNames::default());
            let report = report.expect("a report of the first run");
            (report.outputs, report.unmatched, report.second_failure)
        };
        let (outputs, unmatched, failure) = told(true);
        let failure = failure.expect("a failure");
        assert_eq!((outputs, unmatched, failure.time), (1, 2, Some(2.0)));
        assert!(failure.cause.contains("5 times"), "{}", failure.cause);
        assert_eq!(told(false), (1, 2, Some(failure)));
    }
}
