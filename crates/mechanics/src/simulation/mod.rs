//! A model run through time: assembly, dynamics between output times, snapshots.

mod blocked;
mod energy;
mod failure;
mod integration;
mod paused;
mod report;
mod saved;
mod statics;
mod stiffness;

use numerics::bdf::{self, Bdf, Family};
use serde::{Deserialize, Serialize};

pub use energy::{gravity_energy, kinetic_energy};
pub use paused::Paused;
pub use report::{Cause, Ending, Observer, RunError, Settings, Statistics, StepReport};
pub use saved::{ForeignState, SavedState};

use crate::assembly::{Assembly, AssemblyError};
use crate::dynamics::{Dynamics, Scales, Sliding};
use crate::gain::GainWatch;
use crate::instant::Instant;
use crate::model::{Element, Level, Model};
use crate::snapshot::Snapshot;
use crate::state::State;
use crate::system::System;
use stiffness::Stiffness;

/// A model with its state.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct Simulation {
    pub(crate) system: System,
    pub(crate) state: State,
    /// Rates of velocities and of differential states.
    pub(crate) accelerations: Vec<f64>,
    /// Multipliers and algebraic variables.
    pub(crate) multipliers: Vec<f64>,
    pub(crate) scales: Scales,
    statistics: Statistics,
    /// What the formula said of the bristles at the present instant, see [`Simulation::take`].
    bristle_past: Vec<f64>,
    bristle_gamma: f64,
    /// Jumps of functions that the motion has stayed at.
    slidings: Vec<Sliding>,
    /// Storage and matrix patterns, kept between instants and runs of the same equations.
    engine: Option<Engine>,
}

/// What a run needs beside the simulation's state, and where it is when it pauses.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct Engine {
    /// Counts of engines before this one.
    before: Statistics,
    instant: Instant,
    dynamics: Dynamics,
    gains: GainWatch,
    bdf: Bdf,
    crossing: Crossing,
    stiffness: Stiffness,
    /// The state that the last run ended with; none where the mechanism has changed since.
    left: Option<State>,
}

/// Steps of I3 in the place of those of SI2, past an instant that SI2 has not passed.
#[derive(Clone, Copy, Debug, Serialize, Deserialize)]
struct Crossing {
    /// The last such instant.
    from: f64,
    /// Whether the steps go on.
    goes_on: bool,
}

impl Crossing {
    const NONE: Self = Self {
        from: f64::NEG_INFINITY,
        goes_on: false,
    };
}

/// Limits of an integrator before a run sets its own.
const UNSET: bdf::Settings = bdf::Settings {
    family: Family::BackwardDifferences,
    highest_order: 1,
    longest_step: 0.0,
    shortest_step: 0.0,
    untested: false,
};

impl Engine {
    fn new(simulation: &Simulation) -> Self {
        let system = &simulation.system;
        Self {
            before: simulation.statistics,
            instant: Instant::new(system),
            dynamics: Dynamics::new(system.clone(), simulation.scales),
            gains: GainWatch::new(system),
            bdf: Bdf::new(simulation.value_count(), UNSET),
            crossing: Crossing::NONE,
            stiffness: Stiffness::default(),
            left: None,
        }
    }
}

impl Simulation {
    /// A model as it is given, at time zero. `second` is one second in the model's unit of time;
    /// one radian per second is the rate below which velocities count as small.
    #[must_use]
    pub fn new(model: Model, second: f64) -> Self {
        let system = System::new(model);
        let scales = Scales {
            length: system.length_scale(),
            rate: 1.0 / second,
        };
        let state = system.given_state(0.0);
        Self {
            bristle_past: vec![0.0; system.bristle_count()],
            bristle_gamma: 0.0,
            state,
            accelerations: system.first_rates(),
            multipliers: system.first_multipliers(),
            scales,
            statistics: Statistics::default(),
            slidings: Vec::new(),
            engine: None,
            system,
        }
    }

    /// Brings the given positions and velocities onto the constraints and drops redundant ones.
    ///
    /// # Errors
    /// [`AssemblyError`] where joints contradict one another.
    pub fn assemble(&mut self) -> Result<Assembly, AssemblyError> {
        let assembly = self.system.assemble_initial(&mut self.state)?;
        self.multipliers = self.system.first_multipliers();
        self.engine = None;
        Ok(assembly)
    }

    /// Solves accelerations, reactions and friction of the present instant.
    ///
    /// # Errors
    /// [`RunError`] where they have no unique solution.
    pub fn solve_instant(&mut self) -> Result<(), RunError> {
        let mut engine = self.take_engine();
        engine.instant.forget();
        self.system
            .set_bristles(&self.bristle_past, self.bristle_gamma);
        let solved = engine.instant.accelerations(
            &mut self.system,
            &self.state,
            &mut self.accelerations,
            &mut self.multipliers,
        );
        // A jam shows as reactions without a solution, or as one that makes no sense.
        let jam = engine.gains.look(&mut self.system, &self.multipliers);
        let outcome = self
            .refuse_jam(jam)
            .and_then(|()| solved.map_err(|failure| self.unsolved(&failure, &engine.instant)));
        self.engine = Some(engine);
        outcome
    }

    /// Number of values that are integrated, with the shares of switches.
    fn value_count(&self) -> usize {
        self.state.share_range().start + self.system.switch_count()
    }

    /// The engine of the present equations.
    fn take_engine(&mut self) -> Engine {
        let size = self.value_count();
        let kept = self.engine.take();
        kept.filter(|engine| engine.bdf.value().len() == size)
            .unwrap_or_else(|| Engine::new(self))
    }

    /// Replaces element parameters, functions, the markers of forces and what is active; bodies,
    /// markers and joints must be the same. Where other constraints are active than before, the model is assembled again from
    /// where it stands.
    ///
    /// # Errors
    /// [`AssemblyError`] where constraints that are active now contradict one another.
    ///
    /// # Panics
    /// When the numbering of the equations would change.
    pub fn replace_model(&mut self, model: Model) -> Result<Option<Assembly>, AssemblyError> {
        let constraints = |model: &Model| -> Vec<Element> {
            let resting = model.inactive.iter().copied();
            let free = |e: &Element| matches!(e, Element::Force(_) | Element::Friction(_));
            resting.filter(|element| !free(element)).collect()
        };
        let levels = |model: &Model| -> Vec<Level> {
            model.motions.iter().map(|motion| motion.level).collect()
        };
        let same = constraints(&model) == constraints(self.model())
            && levels(&model) == levels(self.model());
        let rows = self.system.row_count();
        let same_active = model.inactive == self.model().inactive;
        let same_mechanism = model.is_mechanism_of(self.model());
        if !(self.system.replace_model(model) && same_active) {
            self.engine = None;
        }
        if let Some(engine) = self.engine.as_mut().filter(|_| !same_mechanism) {
            engine.left = None;
        }
        if same {
            return Ok(None);
        }
        let assembly = self.system.assemble_again(&mut self.state)?;
        let mut multipliers = self.system.first_multipliers();
        let (first, count) = (self.system.row_count(), self.model().algebraics.len());
        multipliers[first..first + count].copy_from_slice(&self.multipliers[rows..rows + count]);
        self.multipliers = multipliers;
        Ok(Some(assembly))
    }

    /// Puts the model into another state and history, such as one read from a file of results.
    pub fn set_state(&mut self, state: State, creep: &[[f64; 3]]) {
        self.state = state;
        let (bristles, works) = (self.system.bristle_count(), self.system.work_count());
        let states = self.system.first_states();
        self.state.extend(&states, bristles, works);
        self.freeze_bristles();
        self.system.evaluate(&self.state, false);
        self.system.start_history();
        for (memory, creep) in self.system.history.frictions.iter_mut().zip(creep) {
            memory.creep = *creep;
        }
    }

    /// The model.
    #[must_use]
    pub fn model(&self) -> &Model {
        self.system.model()
    }

    /// The equations.
    #[must_use]
    pub fn system(&self) -> &System {
        &self.system
    }

    /// Present state.
    #[must_use]
    pub fn state(&self) -> &State {
        &self.state
    }

    /// Counts of the work done so far.
    #[must_use]
    pub fn statistics(&self) -> Statistics {
        self.statistics
    }

    /// Where functions jump and the motion has stayed at the jump, each named once, in the order of
    /// time.
    #[must_use]
    pub fn slidings(&self) -> &[Sliding] {
        &self.slidings
    }

    /// The present instant, as it was solved last.
    #[must_use]
    pub fn snapshot(&self) -> Snapshot<'_> {
        Snapshot::new(
            &self.system,
            &self.state,
            &self.accelerations,
            &self.multipliers,
        )
    }

    /// The bristles keep their deflection at the present instant.
    fn freeze_bristles(&mut self) {
        let range = self.state.bristle_range();
        self.bristle_past.copy_from_slice(&self.state.values[range]);
        self.bristle_gamma = 0.0;
        self.system
            .set_bristles(&self.bristle_past, self.bristle_gamma);
    }
}
