//! The equations of motion, numbered: residual parts and their exact derivatives.
//!
//! Velocities `u` are six numbers a body (centre of mass and rotation, ground axes), multipliers
//! `λ` one a constraint equation in force:
//!
//! ```text
//! M u̇ = Q(t, x, u) + f(t, x, u, λ) + Gᵀλ      Newton and Euler; f is joint friction
//! G u = rate,   G u̇ = acceleration             constraints, differentiated
//! ```
//!
//! System elements add differential states `y` to the velocities and algebraic variables `w` to the
//! multipliers (`elements.rs`); forces may read them, too. Rates are `(u̇, ẏ)`, and what is called
//! multipliers below are `(λ, w)`: both are determined by the instant alone and are stepped alike. Behind
//! them are the unknowns of reactions that are shared (`sharing.rs`), where there are such.
//!
//! [`System::evaluate`] brings everything that depends on time and state alone up to date, and
//! [`System::assemble`] builds the Newton matrix over `(δu, δy, δλ̂, δŵ)` that all solvers share,
//!
//! ```text
//! [ M − γ ∂(Q+f)/∂u − γ² ∂(Q+f+Gᵀλ)/∂x    −Gᵀ − ∂f/∂λ ]
//! [ G  (+ γ ∂(G u)/∂x)                           0       ]      λ̂ = γλ, ŵ = γw, δx = γ δu
//! ```
//!
//! At `γ = 0` it is the matrix of the instantaneous accelerations and reactions.

mod accelerations;
mod bristles;
mod elements;
mod elimination;
mod evaluation;
mod force_components;
mod forces;
mod inputs;
mod markers;
mod newton_matrix;
mod pairs;
mod reactions;
mod sharing;
mod single_force;
mod switches;
mod works;

use crate::constraint::{Constraint, Evaluated, Form, Owner, list, places_of};
use crate::equation::Equation;
use crate::expression::{Input, Program};
use crate::force_element::{ForceElement, Side};
use crate::joint_friction::{BristlePast, Contribution, Memory, Share, StepEnd};
use crate::measure::Quantity;
use crate::model::{Definition, Element, Level, Model};
use crate::scalar::Jet;
use crate::state::{BodyFrame, MarkerFrame};
use inputs::Inputs;
use markers::Markers;
pub(crate) use newton_matrix::Weights;
use pairs::PairGroup;
use serde::{Deserialize, Serialize};
use sharing::Sharing;
pub(crate) use switches::{Course, Reading, SwitchPlace, Units};

/// Which equations the constraint rows of the Newton matrix belong to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rows {
    /// `G δu`: positions, or accelerations at `γ = 0`.
    Position,
    /// `(G + γ ∂(G u)/∂x) δu`: velocities.
    Velocity,
    /// `(G + 2 γ ∂(G u)/∂x) δu`: accelerations, whose `Ġ u` has the velocities twice; what goes with
    /// `γ²` is left out.
    Acceleration,
}

/// History that the equations need beside the state.
#[derive(Clone, Debug, Default, PartialEq, Serialize, Deserialize)]
pub struct History {
    /// Friction by element.
    pub frictions: Vec<Memory>,
    /// Last value of every measured rotation, which makes it continuous over many turns.
    pub angles: Vec<f64>,
}

/// A model's equations and the storage to evaluate them. Written out it is without its model and
/// what follows from that, see `take_model`.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct System {
    #[serde(skip)]
    pub(crate) model: Model,
    #[serde(skip)]
    pub(crate) constraints: Vec<Constraint>,
    #[serde(skip)]
    pairs: Vec<PairGroup>,
    /// The markers that the equations read, where they were evaluated last.
    #[serde(skip)]
    markers: Markers,
    /// Constraints that are functions of the model.
    #[serde(skip)]
    functions: Vec<usize>,
    /// Constraint of each row in force, and its level.
    pub(crate) rows: Vec<usize>,
    #[serde(skip)]
    pub(crate) levels: Vec<Level>,
    /// Contributions to the reaction of each friction's joint.
    #[serde(skip)]
    reactions: Vec<Vec<Contribution>>,
    /// Frictions where they were taken last.
    #[serde(skip)]
    friction_ends: Vec<StepEnd>,
    /// How constraints that depend on one another share their reactions.
    sharing: Sharing,
    /// What is known of each friction's bristles before the instant is solved.
    bristles: Vec<BristlePast>,
    /// Whether the instant is a static one, where some frictions rest.
    statics: bool,
    /// What happened so far, as of the last accepted step.
    pub(crate) history: History,
    pub(crate) bodies: Vec<BodyFrame>,
    pub(crate) evaluated: Vec<Evaluated>,
    inputs: Inputs,
    /// The elements whose force each algebraic variable reads.
    #[serde(skip)]
    acting: Vec<Vec<(ForceElement, Side)>>,
    /// Measures that the equations (not only outputs) read.
    #[serde(skip)]
    needed: Vec<bool>,
    #[serde(skip)]
    measure_bodies: Vec<Vec<usize>>,
    measure_slopes: Vec<Vec<[f64; 12]>>,
    #[serde(skip)]
    registers: Vec<f64>,
    #[serde(skip)]
    adjoints: Vec<f64>,
    #[serde(skip)]
    jets: Vec<Jet>,
}

impl System {
    /// Numbers the equations of a model; all constraint equations are in force at first.
    #[must_use]
    pub fn new(model: Model) -> Self {
        let constraints = list(&model);
        let evaluated = constraints
            .iter()
            .map(|constraint| Evaluated::new(constraint, &model.markers))
            .collect();
        let reactions = model
            .frictions
            .iter()
            .map(|friction| reaction_of(&constraints, friction.joint))
            .collect();
        let bodies = vec![BodyFrame::at_rest(); model.bodies.len()];
        let mut needed = vec![false; model.measures.len()];
        let functions = model.forces.iter().map(|f| &f.function);
        let functions = functions.chain(model.constraints.iter().map(|c| &c.function));
        let functions = functions.chain(element_functions(&model));
        let mut longest = 0;
        for function in functions.chain(model.motions.iter().map(|m| &m.function)) {
            longest = longest.max(function.len());
            for input in function.inputs() {
                if let Input::Measure(measure) = input {
                    needed[measure] = true;
                }
            }
        }
        let measure_bodies: Vec<Vec<usize>> = model
            .measures
            .iter()
            .map(|measure| {
                let markers = measure.markers();
                let mut bodies: Vec<usize> = markers
                    .iter()
                    .filter_map(|&m| model.markers[m].body)
                    .collect();
                bodies.sort_unstable();
                bodies.dedup();
                bodies
            })
            .collect();
        let acting = model
            .algebraics
            .iter()
            .map(|variable| match &variable.definition {
                Definition::Force(component) => model.acting(component.acting),
                Definition::Function(..) | Definition::Acceleration(_) => Vec::new(),
            })
            .collect();
        let history = History {
            frictions: Vec::new(),
            angles: vec![0.0; model.measures.len()],
        };
        let of_functions = |place: &usize| constraints[*place].form == Form::Function;
        let functions = (0..constraints.len()).filter(of_functions).collect();
        let mut system = Self {
            markers: Markers::new(&model, &constraints, &needed, &bodies),
            bodies,
            inputs: Inputs {
                time: 0.0,
                measures: vec![0.0; model.measures.len()],
                states: model.states.iter().map(|state| state.start).collect(),
                rates: vec![0.0; 6 * model.bodies.len() + model.states.len()],
                algebraics: model.algebraics.iter().map(|w| w.start).collect(),
            },
            measure_slopes: measure_bodies
                .iter()
                .map(|b| vec![[0.0; 12]; b.len()])
                .collect(),
            acting,
            measure_bodies,
            rows: Vec::new(),
            levels: Vec::new(),
            pairs: pairs::groups(&model, &constraints),
            needed,
            functions,
            reactions,
            friction_ends: Vec::with_capacity(model.frictions.len()),
            sharing: Sharing::default(),
            bristles: vec![BristlePast::default(); model.frictions.len()],
            statics: false,
            history,
            constraints,
            evaluated,
            registers: vec![0.0; longest],
            adjoints: vec![0.0; longest],
            jets: vec![
                Jet {
                    value: 0.0,
                    rate: 0.0,
                    acceleration: 0.0
                };
                longest
            ],
            model,
        };
        let all = vec![true; system.constraints.len()];
        system.set_active(&all);
        system
    }

    /// Gives a system that was read its model back, and all that follows from it.
    pub(crate) fn take_model(&mut self, model: Model) {
        let Self {
            model,
            mut constraints,
            pairs,
            markers,
            functions,
            reactions,
            friction_ends,
            acting,
            needed,
            measure_bodies,
            registers,
            adjoints,
            jets,
            ..
        } = Self::new(model);
        for constraint in &mut constraints {
            constraint.row = None;
        }
        self.levels.clear();
        for (row, &place) in self.rows.iter().enumerate() {
            constraints[place].row = Some(row);
            self.levels.push(constraints[place].level);
        }
        (self.model, self.constraints, self.pairs) = (model, constraints, pairs);
        (self.functions, self.reactions) = (functions, reactions);
        self.friction_ends = friction_ends;
        (self.acting, self.needed, self.measure_bodies) = (acting, needed, measure_bodies);
        (self.registers, self.adjoints, self.jets) = (registers, adjoints, jets);
        self.markers = markers;
        self.update_markers();
    }

    /// The model.
    #[must_use]
    pub fn model(&self) -> &Model {
        &self.model
    }

    /// Number of velocities.
    #[must_use]
    pub fn velocity_count(&self) -> usize {
        6 * self.model.bodies.len()
    }

    /// Number of velocities and differential states.
    #[must_use]
    pub fn rate_count(&self) -> usize {
        self.velocity_count() + self.model.states.len()
    }

    /// Number of multipliers, algebraic variables, and unknowns of reactions that are shared.
    #[must_use]
    pub fn multiplier_count(&self) -> usize {
        self.first_shared() + self.sharing.count()
    }

    /// Whether there are differential states or algebraic variables.
    pub(crate) fn has_elements(&self) -> bool {
        !(self.model.states.is_empty() && self.model.algebraics.is_empty())
    }

    /// Places of differential states and algebraic variables among the unknowns.
    pub(crate) fn element_places(&self) -> impl Iterator<Item = usize> + use<> {
        let states = self.velocity_count()..self.rate_count();
        let n = self.rate_count();
        states.chain(n + self.rows.len()..n + self.first_shared())
    }

    /// Number of unknowns: rates, then multipliers.
    #[must_use]
    pub fn unknown_count(&self) -> usize {
        self.rate_count() + self.multiplier_count()
    }

    /// Number of constraint equations in force.
    #[must_use]
    pub fn row_count(&self) -> usize {
        self.rows.len()
    }

    /// Degrees of freedom: those of the free bodies less the constraint equations in force.
    #[must_use]
    pub fn degrees_of_freedom(&self) -> usize {
        let free: usize = self
            .model
            .bodies
            .iter()
            .map(|b| if b.rotates { 6 } else { 3 })
            .sum();
        free.saturating_sub(self.rows.len())
    }

    /// What makes up the reaction of a friction's joint.
    pub(crate) fn contributions(&self, friction: usize) -> &[Contribution] {
        &self.reactions[friction]
    }

    /// Chooses the constraint equations in force, among those of active elements.
    pub(crate) fn set_active(&mut self, active: &[bool]) {
        self.rows.clear();
        self.levels.clear();
        for (place, (constraint, &active)) in self.constraints.iter_mut().zip(active).enumerate() {
            let active = active && self.model.is_active(constraint.owner.element());
            constraint.row = active.then_some(self.rows.len());
            if active {
                self.rows.push(place);
                self.levels.push(constraint.level);
            }
        }
    }

    /// Frame of a marker on the bodies as they were evaluated last.
    #[must_use]
    pub fn marker(&self, marker: usize) -> MarkerFrame {
        MarkerFrame::new(&self.model.markers[marker], &self.bodies)
    }

    /// Frames of the bodies as they were evaluated last.
    #[must_use]
    pub fn body(&self, body: usize) -> &BodyFrame {
        &self.bodies[body]
    }

    /// Replaces parameters and functions; the numbering of equations and the history stay. Returns
    /// whether the pattern of the Newton matrix stays, too.
    pub(crate) fn replace_model(&mut self, model: Model) -> bool {
        let fresh = Self::new(model);
        let inputs = |model: &Model| -> Vec<Input> {
            model
                .forces
                .iter()
                .map(|force| &force.function)
                .chain(element_functions(model))
                .flat_map(|function| function.inputs())
                .collect()
        };
        let ends = |model: &Model| -> Vec<[usize; 2]> {
            model
                .forces
                .iter()
                .map(|force| [force.i, force.j])
                .collect()
        };
        let same_pattern =
            inputs(&fresh.model) == inputs(&self.model) && ends(&fresh.model) == ends(&self.model);
        let same = fresh.constraints.len() == self.constraints.len()
            && fresh.bodies.len() == self.bodies.len()
            && fresh.model.measures.len() == self.model.measures.len()
            && fresh.model.frictions.len() == self.model.frictions.len()
            && fresh.model.states.len() == self.model.states.len()
            && fresh.model.algebraics.len() == self.model.algebraics.len();
        assert!(
            same,
            "a changed model must keep the numbering of its equations"
        );
        let active: Vec<bool> = self.constraints.iter().map(|c| c.row.is_some()).collect();
        let before = std::mem::replace(self, fresh);
        self.bodies = before.bodies;
        self.update_markers();
        self.inputs = before.inputs;
        self.sharing = before.sharing;
        self.set_active(&active);
        self.history = before.history;
        // Friction that was at rest begins anew.
        for place in 0..self.model.frictions.len() {
            let element = Element::Friction(place);
            if self.model.is_active(element) && !before.model.is_active(element) {
                let fresh = self.fresh_memory(place);
                self.history.frictions[place] = self.history.frictions[place].renewed(fresh);
            }
        }
        same_pattern
    }

    /// Friction and angles start anew where the bodies stand: stuck without creep.
    pub(crate) fn start_history(&mut self) {
        self.history.frictions.clear();
        for place in 0..self.model.frictions.len() {
            let memory = self.fresh_memory(place);
            self.history.frictions.push(memory);
        }
        self.history.angles.fill(0.0);
        self.remember_angles();
    }

    pub(super) fn fresh_memory(&self, place: usize) -> Memory {
        let friction = &self.model.frictions[place];
        let joint = &self.model.joints[friction.joint];
        let (i, j) = (self.marker(joint.i), self.marker(joint.j));
        Memory::at(friction, self.inputs.time, &i, &j)
    }

    /// Says whether the instants that follow are static ones.
    pub(crate) fn set_statics(&mut self, statics: bool) {
        self.statics = statics;
    }

    /// Whether the instants are static ones.
    pub(crate) fn is_static(&self) -> bool {
        self.statics
    }

    /// Stick begins anew, without creep, where friction slides.
    pub(crate) fn stick_all(&mut self) {
        for place in 0..self.model.frictions.len() {
            if !self.history.frictions[place].stuck {
                let fresh = self.fresh_memory(place);
                self.history.frictions[place] = self.history.frictions[place].renewed(fresh);
            }
        }
    }

    /// First guesses of multipliers and algebraic variables.
    pub(crate) fn first_multipliers(&self) -> Vec<f64> {
        let mut multipliers = vec![0.0; self.rows.len()];
        multipliers.extend(self.model.algebraics.iter().map(|w| w.start));
        multipliers.resize(self.multiplier_count(), 0.0);
        multipliers
    }

    /// First guesses of accelerations and rates of states.
    pub(crate) fn first_rates(&self) -> Vec<f64> {
        let mut rates = vec![0.0; self.velocity_count()];
        rates.extend(self.model.states.iter().map(|state| state.start_rate));
        rates
    }

    /// Values of the differential states at the start.
    pub(crate) fn first_states(&self) -> Vec<f64> {
        let states = self.model.states.iter();
        states.map(|state| state.start).collect()
    }

    /// Registers and adjoints for a while.
    fn take_scratch(&mut self) -> (Vec<f64>, Vec<f64>) {
        let registers = std::mem::take(&mut self.registers);
        (registers, std::mem::take(&mut self.adjoints))
    }

    fn return_scratch(&mut self, registers: Vec<f64>, adjoints: Vec<f64>) {
        self.registers = registers;
        self.adjoints = adjoints;
    }

    /// Takes over the present rotations as the last accepted ones.
    pub(crate) fn remember_angles(&mut self) {
        self.remember_angles_from(0);
    }

    /// The same for the measures from a place on.
    pub(crate) fn remember_angles_from(&mut self, first: usize) {
        for place in first..self.model.measures.len() {
            if matches!(self.model.measures[place].quantity, Quantity::Rotation(_)) {
                self.history.angles[place] = self.measure_value(place);
            }
        }
    }
}

/// The functions of the system elements.
fn element_functions(model: &Model) -> impl Iterator<Item = &Program> {
    let states = model.states.iter().map(|state| &state.function);
    let algebraics = model.algebraics.iter();
    states.chain(algebraics.filter_map(|variable| variable.definition.function()))
}

fn reaction_of(constraints: &[Constraint], joint: usize) -> Vec<Contribution> {
    places_of(constraints, Owner::Joint(joint))
        .filter_map(|constraint| {
            let share = match constraints[constraint].form {
                Form::Pair {
                    equation: Equation::Along(axis),
                    ..
                } => Share::Force(axis),
                Form::Pair { .. } => Share::Moment,
                Form::Function => return None,
            };
            Some(Contribution { constraint, share })
        })
        .collect()
}
