//! One random mechanism run by one integrator, and what came of it.

use std::panic::{AssertUnwindSafe, catch_unwind};

use mechanics::{Ending, Observer, Simulation, Snapshot, Statistics, StepReport};

use super::energy::Balance;
use super::gaps::largest_gap;
use crate::bench::integrators::{ALL, Integrator};

/// Accepted steps after which a run counts as hanging.
const MOST_STEPS: usize = 100_000;
/// Outputs of a run.
const OUTPUTS: usize = 20;
/// Gap of a joint that counts as open, as a part of the length of the mechanism or in radians: outputs
/// are brought back onto the constraints, whatever ERROR is.
const OPEN: f64 = 1e-6;
/// Gap that joints with redundant equations may have before a run tells that they are broken.
const BROKEN: f64 = 1e-4;
/// Part of the energy that may be missing, in units of ERROR: it is one of each step.
const ENERGY: f64 = 100.0;

/// What came of a run.
#[derive(Clone, Debug)]
pub(crate) enum Outcome {
    /// It came to its end, with the balance of energy as a part of ERROR.
    Success { energy: f64 },
    /// It says why it does not go on.
    Refused { message: String },
    /// It says that equations that were redundant do not hold any more.
    Reported { message: String },
    /// It did what no run may do.
    Wrong { message: String },
}

/// A run of a random mechanism.
#[derive(Clone, Debug)]
pub(crate) struct Trial {
    pub(crate) seed: u64,
    pub(crate) frictions: usize,
    pub(crate) integrator: &'static str,
    pub(crate) error: f64,
    pub(crate) statistics: Statistics,
    pub(crate) outcome: Outcome,
}

impl std::fmt::Display for Trial {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        let Self {
            seed,
            frictions,
            integrator,
            error,
            ..
        } = self;
        let steps = &self.statistics.steps;
        write!(
            f,
            "seed {seed}, {frictions} frictions, {integrator}, ERROR {error:e}: {} steps, {} rejected, {} failed; ",
            steps.steps, steps.rejections, steps.failures
        )?;
        match &self.outcome {
            Outcome::Success { energy } => {
                write!(f, "ends well, energy to {energy:.1e} ERROR")
            }
            Outcome::Refused { message } => write!(f, "refused: {message}"),
            Outcome::Reported { message } => write!(f, "reported: {message}"),
            Outcome::Wrong { message } => write!(f, "WRONG: {message}"),
        }
    }
}

/// The integrator of a seed and its ERROR: each in its turn.
fn choice(seed: u64) -> (&'static Integrator, f64) {
    // Seeds of odd number have friction; all integrators are to run with it and without.
    let turn = (seed / 2) as usize;
    let errors = [1e-3, 1e-4, 1e-5];
    (
        &ALL[turn % ALL.len()],
        errors[turn / ALL.len() % errors.len()],
    )
}

/// Runs the mechanism of a seed.
pub(crate) fn run(seed: u64) -> Trial {
    let (integrator, error) = choice(seed);
    let mechanism = mechanisms::random(seed);
    let mut trial = Trial {
        seed,
        frictions: mechanism.model.frictions.len(),
        integrator: integrator.name,
        error,
        statistics: Statistics::default(),
        outcome: Outcome::Wrong {
            message: "panics".to_owned(),
        },
    };
    let mut simulation = Simulation::new(mechanism.model, 1.0);
    let ran = catch_unwind(AssertUnwindSafe(|| {
        let settings = integrator.settings(error, mechanism.end);
        attempt(&mut simulation, mechanism.end, &settings)
    }));
    if let Ok(outcome) = ran {
        trial.outcome = outcome;
    }
    trial.statistics = simulation.statistics();
    trial
}

fn attempt(simulation: &mut Simulation, end: f64, settings: &mechanics::Settings) -> Outcome {
    let refused = |message| Outcome::Refused { message };
    if let Err(error) = simulation.assemble() {
        return refused(error.to_string());
    }
    if let Err(error) = simulation.solve_instant() {
        return refused(error.to_string());
    }
    let length = simulation.system().length_scale();
    let mut watch = Watch {
        length,
        gap: 0.0,
        broken: None,
        strange: None,
        balance: Balance::start(&simulation.snapshot(), settings.error, length),
    };
    let outputs = (1..=OUTPUTS).map(|k| end * k as f64 / OUTPUTS as f64);
    let ending = simulation.run(end, outputs, settings, &mut watch);
    let wrong = |message| Outcome::Wrong { message };
    if let Some(message) = watch.strange {
        return wrong(message);
    }
    match ending {
        Ok(Ending::Stopped | Ending::Paused) => {
            return wrong(format!("takes more than {MOST_STEPS} steps"));
        }
        Err(error) => return refused(error.to_string()),
        Ok(Ending::Completed) => {}
    }
    if let Some(message) = watch.broken {
        return Outcome::Reported { message };
    }
    if !(watch.gap <= OPEN) {
        return wrong(format!("a joint is open by {:.1e}", watch.gap));
    }
    let energy = watch.balance.share() / settings.error;
    if !(energy <= ENERGY) {
        return wrong(format!("the energy is off by {energy:.1e} times ERROR"));
    }
    Outcome::Success { energy }
}

/// Looks at every output.
struct Watch {
    length: f64,
    gap: f64,
    /// The first redundant equation that no longer holds.
    broken: Option<String>,
    /// What is not a number.
    strange: Option<String>,
    balance: Balance,
}

impl Observer for Watch {
    fn step(&mut self, report: &StepReport) -> bool {
        report.statistics.steps.steps < MOST_STEPS
    }

    fn output(&mut self, snapshot: &Snapshot<'_>) -> bool {
        if let Some(what) = not_a_number(snapshot) {
            let time = snapshot.time();
            self.strange = Some(format!("{what} is not a number at time {time}"));
            return false;
        }
        if self.broken.is_none() {
            let mut broken = snapshot.broken(BROKEN, self.length);
            let told = |unmet| format!("at time {}: {unmet}", snapshot.time());
            self.broken = broken.next().map(told);
        }
        self.gap = self.gap.max(largest_gap(snapshot, self.length));
        self.balance.output(snapshot);
        true
    }
}

/// What of an output is not a number.
fn not_a_number(snapshot: &Snapshot<'_>) -> Option<&'static str> {
    let model = snapshot.model();
    let finite = |v: nalgebra::Vector3<f64>| v.iter().all(|x| x.is_finite());
    if !snapshot.state().values.iter().all(|x| x.is_finite()) {
        return Some("a position or velocity");
    }
    let mut accelerations = (0..model.bodies.len()).map(|body| snapshot.part_acceleration(body));
    if !accelerations.all(|a| finite(a.linear) && finite(a.angular)) {
        return Some("an acceleration");
    }
    let reactions = (0..model.joints.len()).map(mechanics::Owner::Joint);
    let mut reactions = reactions.map(|joint| snapshot.reaction(joint));
    if !reactions.all(|wrench| finite(wrench.force) && finite(wrench.torque)) {
        return Some("a reaction");
    }
    let mut frictions = (0..model.frictions.len()).map(|place| snapshot.friction(place));
    if !frictions.all(|values| finite(values.force) && finite(values.torque)) {
        return Some("a friction");
    }
    None
}
