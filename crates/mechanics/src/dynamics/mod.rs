//! Dynamics: the constrained equations of motion stepped by backward differentiation.
//!
//! With `ẋ = (x − x̂)/γ` and `u̇ = (u − û)/γ` from the integrator's formula, and `Λ = γλ`, a step
//! solves
//!
//! ```text
//! M (u − û) = γ (Q + f) + GᵀΛ                                   both formulations
//! I3:   g(x) = 0,        u from x by the formula
//! SI2:  G u = rate,      x = x̂ + γ u + ν   with  g(x) = 0
//! ```
//!
//! SI2 is the stabilised index-2 form of Gear, Gupta and Leimkuhler (1985): the correction `ν` of
//! the positions, of the size of the local error, lies in the directions of the constraint forces
//! `M⁻¹Gᵀ` (their `Gᵀμ`, weighted by the mass). Because it is that small, velocities and
//! multipliers are solved first and positions after, with one factorisation.
//!
//! Where constraints depend on others for an instant (a parallelogram that is stretched), SI2 has
//! nearly singular velocity equations while I3 passes; a step of SI2 that fails is solved as I3, and
//! so are the next few.
//!
//! Bristle deflections of LuGre follow from velocities and reactions in closed form (see
//! `joint_friction`), the works of frictions, forces and motions from their powers
//! (`quadrature.rs`). Neither is an unknown of Newton's iteration. Works take no part in the error test.
//! Deflections do with tolerances of their own: sliding bristles follow the reactions, which a step
//! determines to the Newton tolerance divided by its length only, so that a tight test on them is
//! answered with shorter steps, and those with rougher reactions (docs/decisions/0006).
//!
//! Orientations: the formula is applied to the unit quaternion, of which the component along `q`
//! is dropped, so that the norm holds exactly: `ω = −(2/γ) vec(q̂ q*)`. Solved for `q` at given `ω`
//! it is `q = (s, γω/2) q̂ / |q̂|²` with `s² = |q̂|² − |γω/2|²`.

mod positions;
mod quadrature;
mod scales;
mod switching;

use numerics::bdf::{self, Verdict, Within};
use numerics::linear::{FrontalLu, Matrix};

use crate::instant::Failure;
use crate::joint_friction::Memory;
use crate::model::Level;
use crate::state::{POSITIONS, State, VELOCITIES};
use crate::system::{Rows, System, Weights};
use quadrature::Quadrature;
pub(crate) use scales::Scales;
use scales::raise;
pub use switching::Sliding;
use switching::Switching;

/// How the constraints enter a step.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Formulation {
    /// Position constraints only; velocities and reactions follow by differentiation.
    I3,
    /// Stabilised index 2: position and velocity constraints.
    Si2,
}

/// Newton stops when what is left is this part of the error tolerance.
const NEWTON_TOLERANCE: f64 = 0.05;
/// The same for I3, whose velocities and reactions are what is left divided by the step and its
/// square.
const INDEX3_NEWTON_TOLERANCE: f64 = 0.002;
/// A kept Newton matrix serves while γ stays within this part of its own.
const GAMMA_RANGE: f64 = 0.25;
/// A kept Newton matrix is renewed when the iteration got slower than this.
const SLOW_RATE: f64 = 0.1;

/// Iterations with a matrix each, at least.
const FULL_ITERATIONS: usize = 20;
/// Corrections that may grow in such an iteration.
const GROWTHS: usize = 5;
/// Steps that are solved as I3 once SI2 has failed, so that a nearly singular position is behind.
const INDEX3_STEPS: usize = 10;

/// How an attempt at a step uses the Newton matrix.
///
/// Attempts go from cheap to sure. The friction law has a kink in the velocity at rest where there is
/// creep, so that a matrix of one side may diverge on the other; one matrix an iteration converges.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
enum MatrixUse {
    /// The factors of an earlier step.
    Kept,
    /// New at the first iteration.
    Renewed,
    /// New at every iteration.
    RenewedAlways,
}

/// Counts of the work done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Work {
    /// Evaluations of the residual.
    pub residuals: usize,
    /// Newton matrices built and factored.
    pub factorisations: usize,
    /// Steps of SI2 that were solved as I3, near a position where constraints depend on others.
    pub index3_steps: usize,
}

/// The step equations with their storage.
#[derive(Clone, Debug)]
pub(crate) struct Dynamics {
    pub(crate) system: System,
    formulation: Formulation,
    /// How constraints enter the present step.
    present: Formulation,
    /// Steps of SI2 that are still to be solved as I3.
    index3_left: usize,
    /// Error tolerance per step, relative to the scales.
    pub(crate) tolerance: f64,
    pub(crate) newton_iterations: usize,
    /// Shortest and longest step.
    pub(crate) steps: [f64; 2],
    pub(crate) scales: Scales,
    pub(crate) work: Work,
    /// Multipliers λ of the last solved step.
    pub(crate) multipliers: Vec<f64>,
    /// Friction memory before the last accepted step, for outputs within it.
    pub(crate) previous: Vec<Memory>,
    powers: Vec<f64>,
    /// Errors of the bristle deflections that a step may make.
    bristle_errors: Vec<f64>,
    quadrature: Quadrature,
    switching: Switching,
    /// Largest magnitude of each differential state so far.
    state_scales: Vec<f64>,
    state: State,
    shift: Vec<f64>,
    impulses: Vec<f64>,
    trial: Vec<f64>,
    change: Vec<f64>,
    force: Vec<f64>,
    momentum: Vec<f64>,
    right: Vec<f64>,
    position_right: Vec<f64>,
    matrix: Matrix,
    factors: FrontalLu,
    /// γ of the factored matrix, none before the first.
    factored: Option<f64>,
    rate: f64,
}

impl Dynamics {
    pub(crate) fn new(system: System, scales: Scales) -> Self {
        let n = system.rate_count();
        let moving = system.velocity_count();
        let size = system.unknown_count();
        let multipliers = system.multiplier_count();
        let mut state = system.given_state(0.0);
        state.set_shares(system.switch_count());
        Self {
            formulation: Formulation::Si2,
            present: Formulation::Si2,
            index3_left: 0,
            tolerance: 1e-6,
            newton_iterations: 4,
            steps: [0.0, f64::INFINITY],
            scales,
            work: Work::default(),
            multipliers: vec![0.0; multipliers],
            previous: system.history.frictions.clone(),
            powers: vec![0.0; system.work_count()],
            bristle_errors: vec![0.0; system.bristle_count()],
            quadrature: Quadrature::new(system.work_count()),
            switching: Switching::default(),
            state,
            state_scales: vec![0.0; n - moving],
            shift: vec![0.0; moving],
            impulses: vec![0.0; multipliers],
            trial: vec![0.0; multipliers],
            change: vec![0.0; n],
            force: vec![0.0; n],
            momentum: vec![0.0; n],
            right: vec![0.0; size],
            position_right: vec![0.0; size],
            matrix: Matrix::new(size),
            factors: FrontalLu::new(system.elimination_groups()),
            factored: None,
            rate: 0.0,
            system,
        }
    }

    /// Takes over the equations and history of `system`; its numbering must be that of before.
    pub(crate) fn start(&mut self, system: &System, formulation: Formulation, scales: Scales) {
        self.system.clone_from(system);
        self.switching.start(&mut self.system);
        self.previous.clone_from(&system.history.frictions);
        self.formulation = formulation;
        self.present = formulation;
        self.index3_left = 0;
        self.scales = scales;
        self.factored = None;
        self.rate = 0.0;
    }

    /// Raises the scales to the velocities and differential states of `state`, from which a run to
    /// `end` begins.
    pub(crate) fn observe(&mut self, state: &State, end: f64) {
        self.scales.observe(state.velocities());
        let small = self.scales.small_states(&mut self.system, state, end);
        raise(&mut self.state_scales, &small);
        raise(&mut self.state_scales, state.states());
    }

    /// Begins the works anew at an instant.
    pub(crate) fn start_works(&mut self, time: f64, works: &[f64], powers: &[f64]) {
        self.quadrature.start(time, works, powers);
    }

    /// Solves the next steps as I3.
    pub(crate) fn cross(&mut self) {
        self.index3_left = INDEX3_STEPS;
        self.factored = None;
    }

    /// Whether the next step is one of SI2 that is solved as I3.
    pub(crate) fn crosses(&self) -> bool {
        self.index3_left > 0
    }

    /// Right-hand sides at the state evaluated last.
    fn residual(&mut self, step: &bdf::Step<'_>) -> Result<(), Failure> {
        self.work.residuals += 1;
        let n = self.system.rate_count();
        let gamma = step.gamma;
        self.take_change(step);
        for (trial, impulse) in self.trial.iter_mut().zip(&self.impulses) {
            *trial = impulse / gamma;
        }
        self.system
            .set_solution(&self.change, 1.0 / gamma, &self.trial);
        self.system.mass_times(&self.change, &mut self.momentum);
        self.system.forces(&self.trial, &mut self.force);
        for k in 0..n {
            self.right[k] = gamma * self.force[k] - self.momentum[k];
        }
        for (row, &place) in self.system.rows.iter().enumerate() {
            let evaluated = &self.system.evaluated[place];
            let constraint = &self.system.constraints[place];
            let of = |u: &[f64]| evaluated.rate_of(&constraint.bodies, u);
            self.right[n + row] = match (constraint.level, self.present) {
                (Level::Position, Formulation::I3) => -evaluated.error / gamma,
                (Level::Position, Formulation::Si2) | (Level::Velocity, _) => {
                    evaluated.rate - of(self.state.velocities())
                }
                (Level::Acceleration, _) => {
                    gamma * self.system.prescribed_acceleration(place) - of(&self.change)
                }
            };
        }
        let lacks = &mut self.right[n + self.system.row_count()..];
        self.system.algebraic_residual(&self.trial, lacks);
        for lack in lacks {
            *lack *= gamma;
        }
        if self.right.iter().all(|r| r.is_finite()) {
            Ok(())
        } else {
            Err(Failure::NotANumber {
                element: self.system.find_not_a_number(),
            })
        }
    }

    /// Size of a Newton correction in units of the error tolerance.
    fn correction_norm(&self, gamma: f64) -> f64 {
        let n = self.system.velocity_count();
        let (length, rate) = (self.scales.length, self.scales.rate);
        let mut norm = 0.0_f64;
        for k in 0..n {
            let unit = if k % 6 < 3 { length } else { 1.0 };
            norm = norm.max((gamma * self.right[k]).abs() / unit);
            if self.present == Formulation::Si2 {
                norm = norm.max(self.right[k].abs() / (unit * rate));
                norm = norm.max(self.position_right[k].abs() / unit);
            }
        }
        for (scale, change) in self.state_scales.iter().zip(&self.right[n..]) {
            norm = norm.max(change.abs() / scale);
        }
        norm / self.tolerance
    }

    /// Newton's iteration from the loaded state, with the matrix used as `usage` says.
    fn newton(&mut self, step: &bdf::Step<'_>, usage: MatrixUse) -> Result<(), Failure> {
        let gamma = step.gamma;
        let moving = self.system.velocity_count();
        let n = self.system.rate_count();
        let rows = match self.present {
            Formulation::I3 => Rows::Position,
            Formulation::Si2 => Rows::Velocity,
        };
        let (mut last, mut worst, mut growths) = (0.0, 0, 0);
        let iterations = match usage {
            MatrixUse::RenewedAlways => self.newton_iterations.max(FULL_ITERATIONS),
            _ => self.newton_iterations,
        };
        let tolerance = match self.present {
            Formulation::Si2 => NEWTON_TOLERANCE,
            Formulation::I3 => INDEX3_NEWTON_TOLERANCE,
        };
        let tolerance = tolerance * self.switching.newton_part();
        for iteration in 0..iterations {
            let renew = match usage {
                MatrixUse::Kept => false,
                MatrixUse::Renewed => iteration == 0,
                MatrixUse::RenewedAlways => true,
            };
            self.system.evaluate(&self.state, renew);
            self.residual(step)?;
            if renew {
                self.factored = None;
                self.work.factorisations += 1;
                let weights = Weights::step(gamma);
                self.system
                    .assemble(rows, weights, &self.change, &self.trial, &mut self.matrix);
                let factored = self.factors.factor(&self.matrix);
                factored.map_err(|singular| self.system.without_solution(singular))?;
                self.factored = Some(gamma);
            }
            self.factors.solve(&mut self.right);
            for (impulse, change) in self.impulses.iter_mut().zip(&self.right[n..]) {
                *impulse += change;
            }
            match self.present {
                Formulation::Si2 => {
                    self.correct_positions(gamma);
                    for k in 0..moving {
                        self.state.velocities_mut()[k] += self.right[k];
                        self.shift[k] += self.position_right[k];
                    }
                    self.positions_from_velocities(step)?;
                }
                Formulation::I3 => {
                    for k in 0..moving {
                        self.change[k] = gamma * self.right[k];
                    }
                    self.state.displace(&self.change[..moving]);
                    self.velocities_from_positions(step);
                }
            }
            let states = self.state.states_mut().iter_mut();
            for (state, change) in states.zip(&self.right[moving..n]) {
                *state += change;
            }
            let norm = self.correction_norm(gamma);
            let size = |k: &usize| self.right[*k].abs();
            worst = (0..n)
                .max_by(|a, b| size(a).total_cmp(&size(b)))
                .unwrap_or(0);
            if !norm.is_finite() {
                break;
            }
            if norm == 0.0 {
                return Ok(());
            }
            // The first correction says nothing about how fast the iteration converges, and the
            // rate of an earlier step says nothing about a matrix that has gone stale since.
            if iteration > 0 {
                self.rate = norm / last;
                if self.rate >= 1.0 && norm > tolerance {
                    // With a matrix of its own in each iteration the kink may be crossed once or
                    // twice before the iteration settles on one side.
                    growths += 1;
                    if usage != MatrixUse::RenewedAlways || growths > GROWTHS {
                        break;
                    }
                }
                if norm * self.rate.min(0.9) / (1.0 - self.rate.min(0.9)) <= tolerance {
                    return Ok(());
                }
            }
            last = norm;
        }
        Err(Failure::NotConverged { unknown: worst })
    }

    /// Change of velocities and differential states against the past: `γ` times their rates.
    fn take_change(&mut self, step: &bdf::Step<'_>) {
        let rates = self.state.rate_range();
        let past = &step.history[rates.clone()];
        let values = self.state.values[rates].iter().zip(past);
        for (change, (now, past)) in self.change.iter_mut().zip(values) {
            *change = now - past;
        }
    }

    /// What follows from the solved velocities and reactions: bristle deflections and works.
    fn complete(&mut self, step: &bdf::Step<'_>) {
        self.system.evaluate(&self.state, false);
        self.take_change(step);
        self.system
            .set_solution(&self.change, 1.0 / step.gamma, &self.multipliers);
        let range = self.state.bristle_range();
        let deflections = &mut self.state.values[range];
        self.system
            .write_bristles(&self.multipliers, Some(deflections), None);
        self.system.write_bristle_errors(
            &self.multipliers,
            self.tolerance,
            &mut self.bristle_errors,
        );
        self.system
            .write_powers(&self.multipliers, &mut self.powers);
        let range = self.state.work_range();
        let works = &mut self.state.values[range];
        self.quadrature
            .works(step.time, step.order, &self.powers, works);
        let range = self.state.share_range();
        let shares = &mut self.state.values[range];
        self.switching.write_shares(&mut self.system, shares);
    }

    fn load(&mut self, step: &bdf::Step<'_>, prediction: &[f64]) -> Result<(), Failure> {
        self.state.time = step.time;
        self.state.values.copy_from_slice(prediction);
        let bristles = &step.history[self.state.bristle_range()];
        self.system.set_bristles(bristles, step.gamma);
        self.shift.fill(0.0);
        for (impulse, multiplier) in self.impulses.iter_mut().zip(&self.multipliers) {
            *impulse = step.gamma * multiplier;
        }
        self.state.normalize();
        match self.present {
            Formulation::Si2 => self.positions_from_velocities(step),
            Formulation::I3 => {
                self.velocities_from_positions(step);
                Ok(())
            }
        }
    }
}

impl bdf::System for Dynamics {
    type Failure = Failure;

    fn solve(&mut self, step: &bdf::Step<'_>, y: &mut [f64]) -> Result<(), Failure> {
        self.switching.attempt(step.size, self.steps[1]);
        let stale = self
            .factored
            .is_none_or(|gamma| (step.gamma / gamma - 1.0).abs() > GAMMA_RANGE);
        let mut usage = if stale || self.rate > SLOW_RATE || self.switching.slides() {
            MatrixUse::Renewed
        } else {
            MatrixUse::Kept
        };
        self.present = if self.index3_left > 0 {
            Formulation::I3
        } else {
            self.formulation
        };
        loop {
            let solved = self.load(step, y);
            let Err(failure) = solved.and_then(|()| self.newton(step, usage)) else {
                break;
            };
            usage = match (usage, &failure) {
                (MatrixUse::Kept, _) => MatrixUse::Renewed,
                (MatrixUse::Renewed, Failure::NotConverged { .. }) => MatrixUse::RenewedAlways,
                // Where the mechanism passes a position at which constraints depend on others,
                // velocity constraints are nearly singular, positions alone are not.
                (_, Failure::NotConverged { .. } | Failure::Singular(_))
                    if self.present == Formulation::Si2 =>
                {
                    self.present = Formulation::I3;
                    self.index3_left = INDEX3_STEPS;
                    MatrixUse::Renewed
                }
                _ => {
                    self.rate = 1.0;
                    self.factored = None;
                    return Err(failure);
                }
            };
        }
        if self.present != self.formulation {
            self.work.index3_steps += 1;
            self.index3_left -= 1;
            if self.index3_left == 0 {
                // The matrix does not fit the next step.
                self.factored = None;
            }
        }
        for (multiplier, impulse) in self.multipliers.iter_mut().zip(&self.impulses) {
            *multiplier = impulse / step.gamma;
        }
        self.complete(step);
        y.copy_from_slice(&self.state.values);
        Ok(())
    }

    fn norm(&self, difference: &[f64]) -> f64 {
        let bodies = self.system.model.bodies.len();
        let (length, rate) = (self.scales.length, self.scales.rate);
        let mut norm = 0.0_f64;
        for (k, d) in difference[..POSITIONS * bodies].iter().enumerate() {
            // A rotation is twice the change of its quaternion.
            let unit = if k % POSITIONS < 3 { length } else { 0.5 };
            norm = norm.max(d.abs() / unit);
            // `max` would pass over what is not a number.
            if d.is_nan() {
                return f64::NAN;
            }
        }
        if self.present == Formulation::Si2 {
            let velocities = POSITIONS * bodies..self.state.motions();
            for (k, d) in difference[velocities].iter().enumerate() {
                let unit = if k % VELOCITIES < 3 {
                    length * rate
                } else {
                    rate
                };
                norm = norm.max(d.abs() / unit);
            }
        }
        let states = &difference[self.state.state_range()];
        for ((d, scale), now) in states
            .iter()
            .zip(&self.state_scales)
            .zip(self.state.states())
        {
            norm = norm.max(d.abs() / scale.max(now.abs()));
            if d.is_nan() {
                return f64::NAN;
            }
        }
        norm /= self.tolerance;
        let bristles = &difference[self.state.bristle_range()];
        for (d, error) in bristles.iter().zip(&self.bristle_errors) {
            if *error > 0.0 {
                norm = norm.max(d.abs() / error);
            }
        }
        norm.max(self.switching.norm(&difference[self.state.share_range()]))
    }

    fn judge(&mut self, step: &bdf::Step<'_>, values: &[f64], within: Within<'_>) -> Verdict {
        if self.switching.is_empty() {
            return Verdict::Accept;
        }
        let mut switching = std::mem::take(&mut self.switching);
        let verdict = switching.judge(self, step, values, within);
        self.switching = switching;
        verdict
    }

    fn accepted(&mut self, step: &bdf::Step<'_>, _: &[f64]) {
        // The step solved last is the one accepted: everything is evaluated there.
        self.quadrature
            .accept(step.time, self.state.works(), &self.powers);
        self.previous.clone_from(&self.system.history.frictions);
        self.system.accept_frictions(&self.multipliers, step.size);
        self.system.remember_angles();
        self.scales.observe(self.state.velocities());
        raise(&mut self.state_scales, self.state.states());
        if !self.switching.is_empty() {
            self.switching.accepted(&mut self.system);
            let rates = self.change.iter().map(|change| change / step.gamma);
            self.switching.begin(rates, &self.multipliers);
        }
    }
}
