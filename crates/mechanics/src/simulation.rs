//! A model run through time: assembly, dynamics between output times, snapshots.

use nalgebra::{Matrix3, Vector3};
use numerics::bdf::{self, Bdf};

use crate::assembly::{Assembly, AssemblyError};
use crate::dynamics::{Dynamics, Formulation, Scales, Work};
use crate::equilibrium::{EquilibriumReport, EquilibriumSettings, Statics};
use crate::gain::{GainWatch, Jam};
use crate::instant::{Failure, Instant};
use crate::model::{Element, Label, Model};
use crate::rotation::Quaternion;
use crate::snapshot::Snapshot;
use crate::state::{POSITIONS, State, VELOCITIES};
use crate::system::System;

/// Part of the error tolerance that the positions of I3 may use. Its test leaves velocities out,
/// which lose an order; with this part they, too, stay near the tolerance.
const INDEX3_SHARE: f64 = 0.1;

/// How to integrate.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Settings {
    /// How constraints enter.
    pub formulation: Formulation,
    /// Error tolerance per step: relative to the model's length for positions, radians for
    /// rotations, and with SI2 relative to the largest velocities for velocities.
    pub error: f64,
    /// Highest order of the formulas, 1 to 5.
    pub highest_order: usize,
    /// Longest step.
    pub longest_step: f64,
    /// Shortest step before the integration is given up.
    pub shortest_step: f64,
    /// Step to start with, where given.
    pub first_step: Option<f64>,
    /// Newton iterations per step before the step is tried again with a new matrix or shorter.
    pub newton_iterations: usize,
}

/// What the integrator did so far.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Statistics {
    /// Steps, rejections and starts.
    pub steps: bdf::Statistics,
    /// Residuals and factorisations.
    pub work: Work,
    /// Outputs whose accelerations and reactions are those of the step around them, because bristles
    /// that are not passive left the instant without a solution.
    pub rough_outputs: usize,
}

/// An accepted step, for tables and progress.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct StepReport {
    /// Time at its end.
    pub time: f64,
    /// Its length.
    pub size: f64,
    /// Order of the next step.
    pub order: usize,
    /// Counts so far.
    pub statistics: Statistics,
}

/// Is told of steps and outputs while a simulation runs.
pub trait Observer {
    /// After every accepted step; false stops the run.
    fn step(&mut self, report: &StepReport) -> bool;
    /// At every output time; false stops the run.
    fn output(&mut self, snapshot: &Snapshot<'_>) -> bool;
}

/// How a run ended.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Ending {
    /// At the end time.
    Completed,
    /// The observer stopped it.
    Stopped,
}

/// A run failed; everything up to its time was reported to the observer.
#[derive(Clone, Debug, PartialEq)]
pub struct RunError {
    /// Time of the last good state.
    pub time: f64,
    /// What happened, in mechanical words.
    pub message: String,
    /// The element that it is about, where there is one.
    pub element: Option<Label>,
}

impl std::fmt::Display for RunError {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "at time {}: {}", self.time, self.message)
    }
}

impl std::error::Error for RunError {}

/// A model with its state.
#[derive(Clone, Debug)]
pub struct Simulation {
    system: System,
    state: State,
    accelerations: Vec<f64>,
    multipliers: Vec<f64>,
    scales: Scales,
    statistics: Statistics,
    /// What the formula said of the bristles at the present instant, see [`Simulation::take`].
    bristle_past: Vec<f64>,
    bristle_gamma: f64,
    /// Storage and matrix patterns, kept between runs of the same equations.
    engine: Option<Engine>,
}

/// What a run needs beside the simulation's state.
#[derive(Clone, Debug)]
struct Engine {
    /// Counts of engines before this one.
    before: Statistics,
    instant: Instant,
    dynamics: Dynamics,
    gains: GainWatch,
    bdf: Bdf,
}

impl Engine {
    fn new(simulation: &Simulation, limits: bdf::Settings) -> Self {
        let system = &simulation.system;
        Self {
            before: simulation.statistics,
            instant: Instant::new(system),
            dynamics: Dynamics::new(system.clone(), simulation.scales),
            gains: GainWatch::new(system),
            bdf: Bdf::new(simulation.state.values.len(), limits),
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
        let mut state = system.given_state(0.0);
        state.extend(system.bristle_count(), system.work_count());
        Self {
            bristle_past: vec![0.0; system.bristle_count()],
            bristle_gamma: 0.0,
            state,
            accelerations: vec![0.0; system.velocity_count()],
            multipliers: Vec::new(),
            scales,
            statistics: Statistics::default(),
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
        self.multipliers = vec![0.0; self.system.row_count()];
        self.engine = None;
        Ok(assembly)
    }

    /// Solves accelerations, reactions and friction of the present instant.
    ///
    /// # Errors
    /// [`RunError`] where they have no unique solution.
    pub fn solve_instant(&mut self) -> Result<(), RunError> {
        let mut instant = Instant::new(&self.system);
        self.system
            .set_bristles(&self.bristle_past, self.bristle_gamma);
        let solved = instant.accelerations(
            &mut self.system,
            &self.state,
            &mut self.accelerations,
            &mut self.multipliers,
        );
        // A jam shows as reactions without a solution, or as one that makes no sense.
        let jam = GainWatch::new(&self.system).look(&mut self.system, &self.multipliers);
        self.refuse_jam(jam)?;
        solved.map_err(|failure| self.unsolved(&failure, &instant))
    }

    /// Moves the model to an equilibrium at `time`, not before that of the state; forces and motions
    /// are taken at that time. The velocities are then zero, creep is carried on.
    ///
    /// # Errors
    /// [`RunError`] where none is found, naming the frictions that hold no more; the model is then
    /// as it was.
    pub fn find_equilibrium(
        &mut self,
        time: f64,
        settings: &EquilibriumSettings,
    ) -> Result<EquilibriumReport, RunError> {
        let (kept, history) = (self.state.clone(), self.system.history.clone());
        let reactions = self.multipliers.clone();
        self.state.time = time;
        self.state.velocities_mut().fill(0.0);
        self.freeze_bristles();
        self.system.evaluate(&self.state, false);
        self.system.stick_all();
        // Reactions to start from: without them no joint has a load, and no friction holds. Where
        // they cannot be found they stay what they were.
        let guess = Instant::new(&self.system).accelerations(
            &mut self.system,
            &self.state,
            &mut self.accelerations,
            &mut self.multipliers,
        );
        if guess.is_err() {
            self.multipliers.clone_from(&reactions);
        }
        self.system.set_statics(true);
        let solved = Statics::new(&self.system).solve(
            &mut self.system,
            &mut self.state,
            &mut self.multipliers,
            settings,
            self.scales.length,
        );
        match solved {
            Ok(report) => {
                self.system.accept_frictions(&self.multipliers, 0.0);
                self.system.remember_angles();
                self.accelerations.fill(0.0);
                Ok(report)
            }
            Err(failure) => {
                let mut error = self.error(&failure);
                if matches!(failure, Failure::NoEquilibrium { .. }) {
                    let causes = self.system.explain_no_equilibrium(&self.multipliers);
                    error.message = format!("{}; {causes}", error.message);
                }
                self.state = kept;
                self.system.history = history;
                self.multipliers = reactions;
                self.system.set_statics(false);
                self.system.evaluate(&self.state, false);
                Err(error)
            }
        }
    }

    /// Replaces element parameters, functions and what is active; bodies, markers and joints must be
    /// the same. Where other constraints are active than before, the model is assembled again from
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
        let same = constraints(&model) == constraints(self.model());
        let same_active = model.inactive == self.model().inactive;
        if !(self.system.replace_model(model) && same_active) {
            self.engine = None;
        }
        if same {
            return Ok(None);
        }
        let assembly = self.system.assemble_again(&mut self.state)?;
        self.multipliers = vec![0.0; self.system.row_count()];
        Ok(Some(assembly))
    }

    /// Puts the model into another state and history, such as one read from a file of results.
    pub fn set_state(&mut self, state: State, creep: &[[f64; 3]]) {
        self.state = state;
        let (bristles, works) = (self.system.bristle_count(), self.system.work_count());
        self.state.extend(bristles, works);
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

    /// A failure in mechanical words, with bristles that may be behind it.
    fn explain(&self, failure: &Failure) -> String {
        let mut text = self.system.explain(failure);
        let unsound = matches!(failure, Failure::NotConverged { .. } | Failure::Singular(_));
        let memories = self.system.history.frictions.iter();
        let active = memories.zip(&self.system.model().frictions);
        for (memory, friction) in active {
            if let (true, Some(time)) = (unsound, memory.tally.not_passive) {
                text.push_str(&format!(
                    "; {} has been faster than its bristles are passive for since time {time}: a \
                     smaller DAMPING_COEFFICIENT may help",
                    friction.label
                ));
            }
        }
        text
    }

    fn error(&self, failure: &Failure) -> RunError {
        RunError {
            time: self.state.time,
            message: self.explain(failure),
            element: self.system.element_of(failure).cloned(),
        }
    }

    /// Integrates to `end`, reporting every accepted step and the states at the rising `outputs`
    /// (the last of which should be `end`).
    ///
    /// # Errors
    /// [`RunError`]; the state is then that of the last good output.
    pub fn run(
        &mut self,
        end: f64,
        outputs: &[f64],
        settings: &Settings,
        observer: &mut impl Observer,
    ) -> Result<Ending, RunError> {
        let limits = bdf::Settings {
            highest_order: settings.highest_order,
            longest_step: settings.longest_step,
            shortest_step: settings.shortest_step,
        };
        let mut engine = match self.engine.take() {
            Some(engine) => engine,
            None => Engine::new(self, limits),
        };
        let ending = self.integrate(&mut engine, end, outputs, settings, limits, observer);
        self.engine = Some(engine);
        ending
    }

    fn integrate(
        &mut self,
        engine: &mut Engine,
        end: f64,
        outputs: &[f64],
        settings: &Settings,
        limits: bdf::Settings,
        observer: &mut impl Observer,
    ) -> Result<Ending, RunError> {
        let Engine {
            before,
            instant,
            dynamics,
            gains,
            bdf,
        } = engine;
        // Changed functions may have left the state off the constraints by rounding.
        self.settle(instant)?;
        let jam = gains.look(&mut self.system, &self.multipliers);
        self.refuse_jam(jam)?;
        self.system.observe_loads(&self.multipliers);
        dynamics.start(&self.system, settings.formulation, self.scales);
        dynamics.tolerance = match settings.formulation {
            Formulation::Si2 => settings.error,
            Formulation::I3 => INDEX3_SHARE * settings.error,
        };
        dynamics.newton_iterations = settings.newton_iterations;
        dynamics.scales.observe(self.state.velocities());
        dynamics.multipliers.copy_from_slice(&self.multipliers);
        bdf.set_settings(limits);
        let slope = self.slope();
        let first = match settings.first_step {
            Some(first) => first,
            None => self.first_step(instant, dynamics, &slope, end, settings),
        };
        bdf.start(self.state.time, &self.state.values, &slope, first);
        let mut next = 0;
        let mut ending = Ending::Completed;
        let (mut crossed, mut crossing) = (f64::NEG_INFINITY, false);
        while bdf.time() < end && ending == Ending::Completed {
            let advanced = bdf.advance(dynamics, end);
            self.scales = dynamics.scales;
            self.statistics = {
                let rough = self.statistics.rough_outputs;
                total(before, bdf.statistics(), dynamics.work, rough)
            };
            if let Err(error) = advanced {
                // A motion may prescribe a jump of velocity, which no step of SI2 can follow; I3
                // has only positions to meet.
                let further = bdf.time() > crossed;
                if settings.formulation == Formulation::I3 || !further {
                    let jam = gains.explain(&mut dynamics.system, &dynamics.multipliers);
                    return Err(
                        jam.map_or_else(|| self.run_error(&error), |jam| jammed(bdf.time(), &jam))
                    );
                }
                crossed = bdf.time();
                self.restart(bdf, dynamics, instant, settings)?;
                dynamics.cross();
                crossing = true;
                continue;
            }
            let jam = gains.look_seldom(&mut dynamics.system, &dynamics.multipliers);
            let report = StepReport {
                time: bdf.time(),
                size: bdf.last_size(),
                order: bdf.order(),
                statistics: self.statistics,
            };
            while next < outputs.len() && outputs[next] <= bdf.time() {
                self.take(bdf, dynamics, outputs[next], instant)?;
                next += 1;
                if !observer.output(&self.snapshot()) {
                    ending = Ending::Stopped;
                    break;
                }
            }
            if !observer.step(&report) {
                ending = Ending::Stopped;
            }
            // After the outputs within the step, whose end is not good any more.
            if let Ok(Some(jam)) = jam {
                return Err(jammed(bdf.time(), &jam));
            }
            // Only now: outputs within the step needed its past.
            if crossing && !dynamics.crosses() {
                crossing = false;
                self.restart(bdf, dynamics, instant, settings)?;
            }
        }
        if ending == Ending::Completed && self.state.time != end {
            self.take(bdf, dynamics, end, instant)?;
        }
        self.system.history.clone_from(&dynamics.system.history);
        Ok(ending)
    }

    /// A loop of friction and reaction without a sound solution at the present instant.
    fn refuse_jam(&self, looked: Result<Option<Jam>, Failure>) -> Result<(), RunError> {
        match looked {
            Ok(Some(jam)) => Err(jammed(self.state.time, &jam)),
            // What is singular is found and named when the step is solved.
            Ok(None) | Err(_) => Ok(()),
        }
    }

    /// Starts the integrator anew from where it is, without its past.
    fn restart(
        &mut self,
        bdf: &mut Bdf,
        dynamics: &mut Dynamics,
        instant: &mut Instant,
        settings: &Settings,
    ) -> Result<(), RunError> {
        self.take(bdf, dynamics, bdf.time(), instant)?;
        dynamics.multipliers.copy_from_slice(&self.multipliers);
        let first = 1e-3 * settings.longest_step;
        let slope = self.slope();
        bdf.start(self.state.time, &self.state.values, &slope, first);
        Ok(())
    }

    /// Brings the state onto the constraints and solves its accelerations and reactions.
    fn settle(&mut self, instant: &mut Instant) -> Result<(), RunError> {
        self.system
            .set_bristles(&self.bristle_past, self.bristle_gamma);
        let solved = instant
            .project(
                &mut self.system,
                &mut self.state,
                &self.multipliers,
                self.scales.length,
            )
            .and_then(|()| {
                instant.accelerations(
                    &mut self.system,
                    &self.state,
                    &mut self.accelerations,
                    &mut self.multipliers,
                )
            });
        let Err(failure) = solved else {
            return Ok(());
        };
        let bristles = !self.state.bristle_range().is_empty() && self.bristle_gamma > 0.0;
        let rough = matches!(failure, Failure::NotConverged { .. }) && bristles;
        if !rough || self.jam_behind(&failure, instant).is_some() {
            return Err(self.unsolved(&failure, instant));
        }
        // The step itself had a solution, and its reactions are near.
        self.statistics.rough_outputs += 1;
        self.multipliers.copy_from_slice(instant.guess());
        self.accelerations
            .copy_from_slice(instant.guessed_accelerations());
        Ok(())
    }

    /// The bristles keep their deflection at the present instant.
    fn freeze_bristles(&mut self) {
        let range = self.state.bristle_range();
        self.bristle_past.copy_from_slice(&self.state.values[range]);
        self.bristle_gamma = 0.0;
        self.system
            .set_bristles(&self.bristle_past, self.bristle_gamma);
    }

    /// An instant that could not be solved: a jam where that explains it, with the reactions as the
    /// iteration left them or as it found them.
    fn unsolved(&mut self, failure: &Failure, instant: &Instant) -> RunError {
        self.jam_behind(failure, instant)
            .map_or_else(|| self.error(failure), |jam| jammed(self.state.time, &jam))
    }

    fn jam_behind(&mut self, failure: &Failure, instant: &Instant) -> Option<Jam> {
        let mut watch = GainWatch::new(&self.system);
        match failure {
            Failure::NotConverged { .. } | Failure::Singular(_) => watch
                .explain(&mut self.system, &self.multipliers)
                .or_else(|| watch.explain(&mut self.system, instant.guess())),
            _ => None,
        }
    }

    /// State, accelerations and reactions at `time` within the last accepted step.
    fn take(
        &mut self,
        bdf: &Bdf,
        dynamics: &Dynamics,
        time: f64,
        instant: &mut Instant,
    ) -> Result<(), RunError> {
        bdf.interpolate(time, &mut self.state.values);
        self.state.time = time;
        self.relax_bristles(bdf, time);
        // The reactions of the step are near: bristles may know several solutions.
        self.multipliers.copy_from_slice(&dynamics.multipliers);
        let velocities = self.state.velocity_range();
        bdf.interpolate_slope(time, velocities, &mut self.accelerations);
        for body in 0..self.state.bodies() {
            let place = POSITIONS * body + 3;
            let q = self.state.orientation(body).normalized();
            q.write(&mut self.state.values[place..place + 4]);
        }
        self.system.history.clone_from(&dynamics.system.history);
        // Creep within the step counts from its start where the joint was stuck there, and back
        // from its end where the stick began within.
        for (memory, previous) in self
            .system
            .history
            .frictions
            .iter_mut()
            .zip(&dynamics.previous)
        {
            if time < bdf.time() && previous.stuck {
                *memory = *previous;
            }
        }
        self.settle(instant)?;
        let range = self.state.bristle_range();
        let deflections = &mut self.state.values[range];
        self.system
            .write_bristles(&self.multipliers, Some(deflections), None);
        Ok(())
    }

    /// Takes the formula of the last step for the bristles at `time` within it.
    ///
    /// Given the deflection, a small change of the load changes its rate by much, and the damping
    /// of the bristles makes a force of that: reactions at an instant need not have a solution
    /// where those of a step have one. So the deflection may follow the reactions at an output by
    /// as much as it does in a step: `z = past + γ z'` through the interpolated `z` and `z'`.
    fn relax_bristles(&mut self, bdf: &Bdf, time: f64) {
        let range = self.state.bristle_range();
        self.bristle_gamma = bdf.last_gamma();
        bdf.interpolate_slope(time, range.clone(), &mut self.bristle_past);
        for (past, deflection) in self.bristle_past.iter_mut().zip(&self.state.values[range]) {
            *past = deflection - self.bristle_gamma * *past;
        }
    }

    /// A first step whose error by the formula of order one is half the tolerance, from the second
    /// derivative; that of the velocities comes from the accelerations a little later.
    fn first_step(
        &self,
        instant: &mut Instant,
        dynamics: &Dynamics,
        slope: &[f64],
        end: f64,
        settings: &Settings,
    ) -> f64 {
        let longest = settings.longest_step.min(end - self.state.time);
        let ahead = 1e-3 * longest;
        match self.curvature_error(instant, dynamics, slope, ahead) {
            Some(error) => {
                let size = (0.5 / error.max(1e-300)).sqrt();
                size.min(0.1 * longest).max(settings.shortest_step)
            }
            None => ahead,
        }
    }

    /// Error of a step of one by the formula of order one, in units of the tolerance: half the
    /// second derivative, from the slope a time `ahead`. None where that cannot be found.
    fn curvature_error(
        &self,
        instant: &mut Instant,
        dynamics: &Dynamics,
        slope: &[f64],
        ahead: f64,
    ) -> Option<f64> {
        let mut later = self.clone();
        later.state.time += ahead;
        let step: Vec<f64> = self.state.velocities().iter().map(|u| u * ahead).collect();
        later.state.displace(&step);
        let velocities = later.state.velocities_mut().iter_mut();
        for (u, a) in velocities.zip(&self.accelerations) {
            *u += ahead * a;
        }
        instant
            .accelerations(
                &mut later.system,
                &later.state,
                &mut later.accelerations,
                &mut later.multipliers,
            )
            .ok()?;
        let half_curvature: Vec<f64> = later
            .slope()
            .iter()
            .zip(slope)
            .map(|(b, a)| 0.5 * (b - a) / ahead)
            .collect();
        let error = bdf::System::norm(dynamics, &half_curvature);
        error.is_finite().then_some(error)
    }

    /// Time derivative of the integrator's vector, at the instant solved last.
    fn slope(&mut self) -> Vec<f64> {
        let (state, values) = (&self.state, &self.state.values);
        let mut slope = Vec::with_capacity(values.len());
        for (body, u) in state.velocities().chunks_exact(VELOCITIES).enumerate() {
            slope.extend_from_slice(&u[..3]);
            let half = Quaternion {
                w: 0.0,
                v: 0.5 * Vector3::from_column_slice(&u[3..]),
            };
            let rate = half.times(&state.orientation(body));
            slope.extend_from_slice(&[rate.w, rate.v.x, rate.v.y, rate.v.z]);
        }
        slope.extend_from_slice(&self.accelerations);
        let (bristles, works) = (state.bristle_range(), state.work_range());
        slope.resize(values.len(), 0.0);
        self.system
            .write_bristles(&self.multipliers, None, Some(&mut slope[bristles]));
        self.system
            .write_powers(&self.multipliers, &mut slope[works]);
        slope
    }

    fn run_error(&self, error: &bdf::Error<Failure>) -> RunError {
        match error {
            bdf::Error::Failed { time, cause } => RunError {
                time: *time,
                message: format!(
                    "the step could not be solved with the shortest step allowed: {}",
                    self.explain(cause)
                ),
                element: self.system.element_of(cause).cloned(),
            },
            bdf::Error::Inaccurate { time, size } => RunError {
                time: *time,
                message: format!(
                    "the error tolerance cannot be met with the shortest step allowed (the last \
                     try was {size:.3e}); likely causes: a discontinuous function, or forces that \
                     change faster than HMIN resolves"
                ),
                element: None,
            },
        }
    }
}

fn jammed(time: f64, jam: &Jam) -> RunError {
    RunError {
        time,
        message: format!(
            "{} jams: the friction that a load causes adds {:.3} times as much to that load, and at \
             a gain of one the loads grow without bound; no motion obeys Coulomb's law beyond",
            jam.friction, jam.gain
        ),
        element: Some(jam.friction.clone()),
    }
}

fn total(
    before: &Statistics,
    steps: bdf::Statistics,
    work: Work,
    rough_outputs: usize,
) -> Statistics {
    Statistics {
        steps: bdf::Statistics {
            steps: before.steps.steps + steps.steps,
            rejections: before.steps.rejections + steps.rejections,
            failures: before.steps.failures + steps.failures,
            starts: before.steps.starts + steps.starts,
        },
        work: Work {
            residuals: before.work.residuals + work.residuals,
            factorisations: before.work.factorisations + work.factorisations,
            index3_steps: before.work.index3_steps + work.index3_steps,
        },
        rough_outputs,
    }
}

/// Kinetic energy of the bodies, in the model's unit of energy.
#[must_use]
pub fn kinetic_energy(model: &Model, state: &State) -> f64 {
    let energies = model
        .bodies
        .iter()
        .zip(state.velocities().chunks_exact(VELOCITIES));
    let energies = energies.enumerate().map(|(place, (body, u))| {
        let velocity = Vector3::from_column_slice(&u[..3]);
        let rotation: Matrix3<f64> = state.orientation(place).matrix();
        let omega = rotation.transpose() * Vector3::from_column_slice(&u[3..]);
        0.5 * (body.mass * velocity.norm_squared() + omega.dot(&(body.inertia * omega)))
    });
    energies.sum()
}

/// Potential energy of the weight of the bodies, zero at the ground's origin.
#[must_use]
pub fn gravity_energy(model: &Model, state: &State) -> f64 {
    let bodies = model.bodies.iter().enumerate();
    bodies
        .map(|(place, body)| -body.mass * model.gravity.dot(&state.centre(place)))
        .sum()
}
