//! Runs that do not fail: random mechanisms, and a table of mechanisms, integrators, errors and frictions.

mod energy;
mod gaps;
mod lessons;
mod table;
mod trial;

use std::path::Path;
use std::sync::Mutex;
use std::sync::atomic::{AtomicUsize, Ordering};
use std::thread::available_parallelism;

/// What to run.
#[derive(clap::Args)]
pub(crate) struct Arguments {
    /// Seeds of random mechanisms to run by themselves, such as `17` or `0..100`; without any,
    /// docs/robustness.md is written.
    seeds: Vec<String>,
    /// Rows of the table to print: mechanisms whose name contains this.
    #[arg(long)]
    table: Vec<String>,
}

/// Seeds of the page.
const ALL_SEEDS: std::ops::Range<u64> = 0..1000;

/// Runs the mechanisms: some and prints what came of them, or all and writes the page.
pub(crate) fn run(arguments: &Arguments) -> Result<(), String> {
    if !arguments.seeds.is_empty() {
        for text in &arguments.seeds {
            range(text)?.for_each(|seed| println!("{}", trial::run(seed)));
        }
        return Ok(());
    }
    if !arguments.table.is_empty() {
        println!("{}", table::section(&arguments.table));
        return Ok(());
    }
    let seeds: Vec<u64> = ALL_SEEDS.collect();
    let trials = side_by_side(&seeds, |&seed| trial::run(seed));
    let page = format!(
        "# Robustness\n\nWritten by `cargo xtask robustness`; `cargo xtask robustness 17` runs the \
         mechanism of seed 17 by itself. A hundred of the mechanisms run with the tests.\n\n{}{}",
        lessons::section(&trials),
        table::section(&[])
    );
    let path = Path::new(env!("CARGO_MANIFEST_DIR")).join("../../docs/robustness.md");
    std::fs::write(&path, page).map_err(|error| format!("{}: {error}", path.display()))
}

/// What comes of every item, in their order, by as many threads as there are cores.
fn side_by_side<I: Sync, O: Send>(items: &[I], work: impl Fn(&I) -> O + Sync) -> Vec<O> {
    let next = AtomicUsize::new(0);
    let done = Mutex::new(Vec::with_capacity(items.len()));
    let worker = || {
        loop {
            let place = next.fetch_add(1, Ordering::Relaxed);
            let Some(item) = items.get(place) else {
                return;
            };
            let outcome = work(item);
            done.lock()
                .expect("no worker panics")
                .push((place, outcome));
        }
    };
    std::thread::scope(|scope| {
        for _ in 0..available_parallelism().map_or(1, usize::from) {
            scope.spawn(worker);
        }
    });
    let mut done = done.into_inner().expect("no worker panics");
    done.sort_by_key(|(place, _)| *place);
    done.into_iter().map(|(_, outcome)| outcome).collect()
}

fn range(text: &str) -> Result<std::ops::Range<u64>, String> {
    let number = |text: &str| {
        let number = text.parse::<u64>();
        number.map_err(|error| format!("{text}: {error}"))
    };
    match text.split_once("..") {
        Some((first, end)) => Ok(number(first)?..number(end)?),
        None => number(text).map(|seed| seed..seed + 1),
    }
}

#[cfg(test)]
mod tests {
    use super::trial::{self, Outcome, Trial};

    #[test]
    fn random_mechanisms_end_well_or_say_why_not() {
        let trials: Vec<Trial> = (0..100).map(trial::run).collect();
        let wrong = trials
            .iter()
            .filter(|trial| matches!(trial.outcome, Outcome::Wrong { .. }));
        let wrong: Vec<&Trial> = wrong.collect();
        assert!(wrong.is_empty(), "{wrong:#?}");
        let well = trials
            .iter()
            .filter(|trial| matches!(trial.outcome, Outcome::Success { .. }));
        // Three of these jam, one is refused for its bristles; more would be a loss.
        assert!(well.count() >= 95);
    }

    /// Mechanisms with stiff bristles, or with such that are not passive, which took 24,000 to 700,000 steps
    /// by Adams and NEWMARK before SI2 took over.
    #[test]
    fn stiff_bristles_take_no_endless_steps() {
        for seed in [147, 279, 339, 539, 627, 877] {
            let trial = trial::run(seed);
            assert!(matches!(trial.outcome, Outcome::Success { .. }), "{trial}");
            assert!(trial.statistics.steps.steps < 12_000, "{trial}");
            assert!(trial.statistics.stiff_from.is_some(), "{trial}");
        }
    }

    /// Nothing moves in seed 573, which has no weight and springs of their free length: what rounding
    /// makes of that with position constraints is no energy that is missing.
    #[test]
    fn rounding_at_rest_is_no_missing_energy() {
        let trial = trial::run(573);
        assert!(matches!(trial.outcome, Outcome::Success { .. }), "{trial}");
    }
}
