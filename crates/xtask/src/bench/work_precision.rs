//! Error against time: all integrators at all tolerances and all peers, by turns.

use mechanics::Statistics;

use super::case::{Case, Timed};
use super::clock::{Times, median};
use super::integrators::{self, Integrator};
use super::peers::{Environment, Peer};

/// Most runs of a row.
const RUNS: usize = 5;
/// A row is not run again when it has taken this long, seconds.
const ENOUGH: f64 = 0.5;

/// Where one of our rows fails or takes longer than this, seconds, tighter ones are left out.
const LONGEST: f64 = 4.0;

/// How a row was run.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Setting {
    /// One of our integrators with this ERROR.
    Error(f64),
    /// A peer with this many steps.
    Steps(u32),
}

/// One row of a table.
pub(crate) struct Row {
    /// The integrator, or the peer and its method.
    pub(crate) name: &'static str,
    /// How it was run.
    pub(crate) setting: Setting,
    /// What came of it, or why nothing.
    pub(crate) outcome: Result<Outcome, String>,
}

impl Row {
    /// Whether one of our integrators ran it.
    pub(crate) fn is_ours(&self) -> bool {
        matches!(self.setting, Setting::Error(_))
    }
}

/// Medians and results of a row.
pub(crate) struct Outcome {
    /// Medians.
    pub(crate) times: Times,
    /// Largest error of the numbers that are compared.
    pub(crate) error: f64,
    /// What the integrator did; unknown of peers.
    pub(crate) statistics: Option<Statistics>,
}

/// A case measured.
pub(crate) struct Measured {
    /// The case.
    pub(crate) case: Case,
    /// Where the exact numbers are from.
    pub(crate) source: String,
    /// Rows, those of one integrator or peer together, the tighter the later.
    pub(crate) rows: Vec<Row>,
}

/// Who runs a row.
enum Runner {
    Ours(Integrator),
    /// Place among the peers that were started.
    Peer(usize),
}

/// A row while it is measured.
struct Trial {
    runner: Runner,
    name: &'static str,
    setting: Setting,
    times: Vec<Times>,
    last: Option<Result<Timed, String>>,
}

impl Trial {
    fn new(runner: Runner, name: &'static str, setting: Setting) -> Self {
        Self {
            runner,
            name,
            setting,
            times: Vec::new(),
            last: None,
        }
    }

    /// Whether another run would tell more.
    fn wants_more(&self) -> bool {
        let failed = matches!(self.last, Some(Err(_)));
        let spent: f64 = self.times.iter().map(|times| times.wall).sum();
        !failed && spent < ENOUGH
    }

    /// Whether the last run came to its end within the longest time.
    fn is_fast(&self) -> bool {
        let within = |times: &Times| times.wall < LONGEST;
        matches!(self.last, Some(Ok(_))) && self.times.last().is_some_and(within)
    }

    fn run(&mut self, case: &Case, peers: &mut [Peer]) {
        let outcome = match (&self.runner, self.setting) {
            (Runner::Ours(integrator), Setting::Error(error)) => case.run(integrator, error),
            (Runner::Peer(place), Setting::Steps(steps)) => peers[*place].run(steps),
            _ => return,
        };
        if let Ok(timed) = &outcome {
            self.times.push(timed.times);
        }
        self.last = Some(outcome);
    }

    fn row(self, exact: &[f64]) -> Row {
        let outcome = match (self.last, median(&self.times)) {
            (Some(Ok(timed)), Some(times)) => {
                largest_error(&timed.values, exact).map(|error| Outcome {
                    times,
                    error,
                    statistics: timed.statistics,
                })
            }
            (Some(Err(message)), _) => Err(message),
            _ => Err("not run".into()),
        };
        Row {
            name: self.name,
            setting: self.setting,
            outcome,
        }
    }
}

/// Largest difference of numbers that belong together.
fn largest_error(values: &[f64], exact: &[f64]) -> Result<f64, String> {
    if values.len() != exact.len() {
        return Err(format!(
            "{} numbers instead of {}",
            values.len(),
            exact.len()
        ));
    }
    let error = values
        .iter()
        .zip(exact)
        .fold(0.0_f64, |worst, (value, exact)| {
            // What is not a number stays.
            let error = (value - exact).abs();
            if error > worst || error.is_nan() {
                error
            } else {
                worst
            }
        });
    if error.is_nan() {
        return Err("it says that it succeeded, with what is not a number".into());
    }
    Ok(error)
}

/// Measures a case; `quick` stays with loose tolerances and one run each.
///
/// # Errors
/// When there is no reference, or a peer cannot be started.
pub(crate) fn measure(
    case: Case,
    environment: Option<&Environment>,
    quick: bool,
) -> Result<Measured, String> {
    let (exact, source) = case.reference()?;
    let mut trials = Vec::new();
    for integrator in integrators::ALL {
        for error in case.errors(quick) {
            trials.push(Trial::new(
                Runner::Ours(integrator),
                integrator.name,
                Setting::Error(error),
            ));
        }
    }
    let mut peers = Vec::new();
    if let Some(environment) = environment {
        for setup in &case.peers {
            for &steps in setup.steps {
                let runner = Runner::Peer(peers.len());
                trials.push(Trial::new(runner, setup.name, Setting::Steps(steps)));
            }
            peers.push(environment.start(setup)?);
        }
    }
    for _ in 0..if quick { 1 } else { RUNS } {
        let mut given_up = None;
        for trial in trials.iter_mut().filter(|trial| trial.wants_more()) {
            if given_up == Some(trial.name) {
                trial.last = Some(Err("not run, as the row before took too long".into()));
                continue;
            }
            trial.run(&case, &mut peers);
            if matches!(trial.runner, Runner::Ours(_)) && !trial.is_fast() {
                given_up = Some(trial.name);
            }
        }
    }
    let rows = trials.into_iter().map(|trial| trial.row(&exact)).collect();
    Ok(Measured { case, source, rows })
}
