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

mod corrector;
mod formulation;
mod kept_axes;
mod local_error;
mod newton;
mod positions;
mod projection;
mod quadrature;
mod scales;
mod steps;
mod switching;

use numerics::bdf::{self, Family, History};
use numerics::linear::{FrontalLu, Matrix};
use serde::{Deserialize, Serialize};

use crate::instant::{Failure, Instant};
use crate::joint_friction::Memory;
use crate::model::Model;
use crate::state::State;
use crate::system::System;
pub use corrector::{Corrector, Pattern};
pub use formulation::Formulation;
pub(crate) use formulation::Index;
use kept_axes::KeptAxes;
use quadrature::Quadrature;
pub(crate) use scales::Scales;
use scales::raise;
pub use switching::Sliding;
use switching::Switching;

/// Values of every multiplier that are kept.
const MULTIPLIER_NODES: usize = Family::Adams.highest_order();
/// Degree of the polynomial that predicts multipliers, at most, where constraints do not enter with their
/// accelerations: a higher one magnifies what Newton's iteration leaves by more than the next iteration
/// takes off.
const MULTIPLIER_DEGREE: usize = 3;

/// Part of the error tolerance that index 3 may use. Positions say little of velocities, which lose an
/// order; with this part they, too, stay near the tolerance.
const INDEX3_SHARE: f64 = 0.1;

/// Largest error of positions past a singular one: the velocities on the other side follow from them,
/// and with a loose tolerance four-bars came out of it with eight times their energy.
const CROSSING_ERROR: f64 = 1e-4;

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
    /// New at the iterations that are asked for, and at the first.
    Patterned { pattern: Pattern, first: bool },
    /// New at every iteration.
    RenewedAlways,
}

/// Counts of the work done.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq, Serialize, Deserialize)]
pub struct Work {
    /// Evaluations of the residual.
    pub residuals: usize,
    /// Newton matrices built and factored.
    pub factorisations: usize,
    /// Steps of SI2 that were solved as I3, near a position where constraints depend on others.
    pub index3_steps: usize,
}

/// The step equations with their storage.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Dynamics {
    pub(crate) system: System,
    formulation: Formulation,
    /// How constraints enter the present step.
    present: Index,
    /// Steps of SI2 that are still to be solved as I3.
    index3_left: usize,
    /// ERROR, relative to the scales,
    pub(crate) error: f64,
    /// and what a step may make of it in motions.
    pub(crate) motion_error: f64,
    pub(crate) corrector: Corrector,
    /// Length of the present step,
    step_size: f64,
    /// of the shortest and the longest one.
    pub(crate) steps: [f64; 2],
    pub(crate) scales: Scales,
    pub(crate) work: Work,
    /// Multipliers λ of the last solved step.
    pub(crate) multipliers: Vec<f64>,
    /// The same of the last accepted steps, which those of the next one are predicted from.
    past_multipliers: History,
    /// Friction memory before the last accepted step, for outputs within it.
    pub(crate) previous: Vec<Memory>,
    powers: Vec<f64>,
    /// Errors of the bristle deflections that a step may make.
    bristle_errors: Vec<f64>,
    /// What Newton's iteration leaves of velocities, in units of the error of positions.
    left_of_velocities: f64,
    quadrature: Quadrature,
    switching: Switching,
    /// Largest magnitude of each differential state so far.
    state_scales: Vec<f64>,
    state: State,
    shift: Vec<f64>,
    impulses: Vec<f64>,
    trial: Vec<f64>,
    /// What equations prescribe of accelerations, by row.
    prescribed: Vec<f64>,
    change: Vec<f64>,
    force: Vec<f64>,
    /// Forces at the last accepted step less `M u̇` there, where HHT reads them,
    past_force: Vec<f64>,
    /// the rates there, and those times the present `M`.
    past_rates: Vec<f64>,
    past_inertia: Vec<f64>,
    /// Rates of bristles at the last accepted step by their own equations, where HHT reads them, and
    /// what its formula takes for their past.
    past_bristle_rates: Vec<f64>,
    bristle_past: Vec<f64>,
    /// Rates of velocities and differential states that the step was solved with.
    rates: Vec<f64>,
    momentum: Vec<f64>,
    right: Vec<f64>,
    position_right: Vec<f64>,
    matrix: Matrix,
    factors: FrontalLu,
    kept_axes: KeptAxes,
    /// γ of the factored matrix, none before the first.
    factored: Option<f64>,
    /// Rate of convergence of the last iteration.
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
            present: Index::StabilisedTwo,
            index3_left: 0,
            error: 1e-6,
            motion_error: 1e-7,
            corrector: Corrector::default(),
            step_size: 0.0,
            steps: [0.0, f64::INFINITY],
            scales,
            work: Work::default(),
            multipliers: vec![0.0; multipliers],
            past_multipliers: History::new(multipliers, MULTIPLIER_NODES),
            previous: system.history.frictions.clone(),
            powers: vec![0.0; system.work_count()],
            bristle_errors: vec![0.0; system.bristle_count()],
            left_of_velocities: 0.0,
            quadrature: Quadrature::new(system.work_count()),
            switching: Switching::default(),
            state,
            state_scales: vec![0.0; n - moving],
            shift: vec![0.0; moving],
            impulses: vec![0.0; multipliers],
            trial: vec![0.0; multipliers],
            prescribed: vec![0.0; multipliers],
            change: vec![0.0; n],
            force: vec![0.0; n],
            past_force: vec![0.0; n],
            past_rates: vec![0.0; n],
            past_inertia: vec![0.0; n],
            past_bristle_rates: vec![0.0; system.bristle_count()],
            bristle_past: vec![0.0; system.bristle_count()],
            rates: vec![0.0; n],
            momentum: vec![0.0; n],
            right: vec![0.0; size],
            position_right: vec![0.0; size],
            matrix: Matrix::new(size),
            factors: FrontalLu::new(system.elimination_groups()),
            kept_axes: KeptAxes::of(&system),
            factored: None,
            rate: 0.0,
            system,
        }
    }

    /// Takes over the pattern of the Newton matrix and its order of elimination, which are the same at an
    /// instant as in a step, unless they are known.
    pub(crate) fn take_pattern(&mut self, instant: &Instant) {
        if !self.matrix.has_pattern() {
            let (matrix, factors) = instant.factored();
            self.matrix.clone_from(matrix);
            self.factors.clone_from(factors);
        }
    }

    /// Takes over the equations and history of `system`; its numbering must be that of before.
    pub(crate) fn start(&mut self, system: &System, formulation: Formulation, scales: Scales) {
        self.system.clone_from(system);
        self.kept_axes = KeptAxes::of(&self.system);
        self.switching.start(&mut self.system);
        self.previous.clone_from(&system.history.frictions);
        self.formulation = formulation;
        self.present = formulation.index();
        self.index3_left = 0;
        self.scales = scales;
        self.factored = None;
        self.rate = 0.0;
    }

    /// How the equations are stepped now.
    pub(crate) fn formulation(&self) -> Formulation {
        self.formulation
    }

    /// Steps the equations by this formulation from here on, with what a step may make of ERROR in motions.
    pub(crate) fn take_over(&mut self, formulation: Formulation, motion_error: f64) {
        self.formulation = formulation;
        self.motion_error = motion_error;
        self.factored = None;
    }

    /// What the error test of the present step allows of all but motions: ERROR itself.
    fn tolerance(&self) -> f64 {
        self.allowed(self.error)
    }

    /// What it allows of positions.
    fn position_tolerance(&self) -> f64 {
        self.allowed(self.motion_error)
    }

    /// What the present step may use of an error.
    fn allowed(&self, error: f64) -> f64 {
        match (self.formulation.index(), self.present) {
            (Index::Three, _) => INDEX3_SHARE * error,
            (_, Index::Three) => error.min(CROSSING_ERROR),
            _ => error,
        }
    }

    /// Gives what was read its model back.
    pub(crate) fn take_model(&mut self, model: Model) {
        self.system.take_model(model);
        self.switching.hold_branches(&mut self.system);
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

    /// Takes over the multipliers of the instant that a run begins at.
    pub(crate) fn start_multipliers(&mut self, time: f64, multipliers: &[f64]) {
        self.multipliers.copy_from_slice(multipliers);
        self.past_multipliers.start_without_slope(time, multipliers);
    }

    /// Takes over the rates of velocities and states, and of bristles, of the instant that a run begins
    /// at.
    pub(crate) fn start_rates(&mut self, rates: &[f64], bristles: &[f64]) {
        if self.formulation.alpha() != 0.0 {
            // Forces and inertia are in balance.
            self.past_force.fill(0.0);
            self.past_rates.copy_from_slice(rates);
            self.past_bristle_rates.copy_from_slice(bristles);
        }
    }

    /// Gives the bristles their formula, `z = past + γ z'`.
    ///
    /// HHT has the rate of the time `t + αh`, `(1 + α) z' − α z'₀`, as for all that it integrates: with
    /// `z'` alone bristles are integrated to first order.
    fn set_bristles(&mut self, step: &bdf::Step<'_>) {
        let alpha = self.formulation.alpha();
        let past = &step.history[self.state.bristle_range()];
        let rates = past.iter().zip(&self.past_bristle_rates);
        for (out, (past, rate)) in self.bristle_past.iter_mut().zip(rates) {
            *out = past - alpha * step.gamma * rate;
        }
        self.system
            .set_bristles(&self.bristle_past, (1.0 + alpha) * step.gamma);
    }

    /// What multiplies the inertia forces: `M u̇/(1 + α) = F − α/(1 + α) (F₀ + (M − M₀) u̇₀)` with HHT.
    ///
    /// HHT has accelerations of the time `t + αh`. So `M` must be that of then, too, which for bodies
    /// that turn in space is `M + α (M − M₀)`; with `M` alone the method is of first order only.
    fn inertia_part(&self) -> f64 {
        1.0 / (1.0 + self.formulation.alpha())
    }

    /// What multiplies the forces of the last step.
    fn lag(&self) -> f64 {
        -self.formulation.alpha() * self.inertia_part()
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
        for (rate, change) in self.rates.iter_mut().zip(&self.change) {
            *rate = change / step.gamma;
        }
        if self.present == Index::One {
            self.return_to_constraints();
        }
        self.system
            .set_solution(&self.change, 1.0 / step.gamma, &self.multipliers);
        self.system.take_frictions(&self.multipliers);
        let range = self.state.bristle_range();
        let deflections = &mut self.state.values[range];
        self.system.write_bristles(Some(deflections), None);
        let rough = self.left_of_reactions(step);
        self.system
            .write_bristle_errors(self.tolerance(), rough, &mut self.bristle_errors);
        self.system
            .write_powers(&self.multipliers, &mut self.powers);
        let range = self.state.work_range();
        let works = &mut self.state.values[range.clone()];
        if self.present == Index::One {
            // The order of the step is that of what the powers follow.
            let past = step.history[range].iter();
            for ((work, past), power) in works.iter_mut().zip(past).zip(&self.powers) {
                *work = past + step.gamma * power;
            }
        } else {
            self.quadrature
                .works(step.time, step.order, &self.powers, works);
        }
        let range = self.state.share_range();
        let shares = &mut self.state.values[range];
        self.switching.write_shares(&mut self.system, shares);
    }

    /// First guess of the impulses: the polynomial through the multipliers of the last steps. What a
    /// guess lacks is forces that a kept matrix, which has the directions of another position, leaves in
    /// the velocities.
    fn predict_impulses(&mut self, step: &bdf::Step<'_>, usage: MatrixUse) {
        let known = self.past_multipliers.count() - 1;
        let degree = match (usage, self.present) {
            // Where reactions jump nothing is surer than the last ones.
            (MatrixUse::RenewedAlways, _) => 0,
            (_, Index::One) => step.order - 1,
            (_, Index::StabilisedTwo | Index::Three) => MULTIPLIER_DEGREE.min(step.order - 1),
        };
        let degree = degree.min(known);
        self.past_multipliers
            .evaluate(degree, step.time, &mut self.impulses);
        for impulse in &mut self.impulses {
            *impulse *= step.gamma;
        }
    }

    /// Loads the first guess of a step.
    fn load(
        &mut self,
        step: &bdf::Step<'_>,
        prediction: &[f64],
        usage: MatrixUse,
    ) -> Result<(), Failure> {
        self.state.time = step.time;
        self.state.values.copy_from_slice(prediction);
        self.set_bristles(step);
        self.shift.fill(0.0);
        self.predict_impulses(step, usage);
        match self.present {
            Index::One | Index::StabilisedTwo => self.positions_from_velocities(step),
            Index::Three => {
                self.state.normalize();
                self.velocities_from_positions(step);
                Ok(())
            }
        }
    }
}
