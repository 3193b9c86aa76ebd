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
//! [`System::evaluate`] brings everything that depends on time and state alone up to date, and
//! [`System::assemble`] builds the Newton matrix over `(δu, δλ̂)` that all solvers share,
//!
//! ```text
//! [ M − γ ∂(Q+f)/∂u − γ² ∂(Q+f+Gᵀλ)/∂x    −Gᵀ − ∂f/∂λ ]
//! [ G  (+ γ ∂(G u)/∂x)                           0       ]      λ̂ = γλ, δx = γ δu
//! ```
//!
//! At `γ = 0` it is the matrix of the instantaneous accelerations and reactions.

mod bristles;
mod evaluation;
mod forces;
mod newton_matrix;
mod reactions;
mod single_force;
mod works;

use crate::constraint::{Constraint, Evaluated, Form, Owner, list};
use crate::equation::Equation;
use crate::expression::Input;
use crate::joint_friction::{BristlePast, Contribution, Memory, Share};
use crate::measure::Quantity;
use crate::model::{Element, Model};
use crate::scalar::Jet;
use crate::state::{BodyFrame, MarkerFrame};
pub(crate) use newton_matrix::Weights;

/// Which equations the constraint rows of the Newton matrix belong to.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Rows {
    /// `G δu`: positions, or accelerations at `γ = 0`.
    Position,
    /// `(G + γ ∂(G u)/∂x) δu`: velocities.
    Velocity,
}

/// History that the equations need beside the state.
#[derive(Clone, Debug, Default, PartialEq)]
pub struct History {
    /// Friction by element.
    pub frictions: Vec<Memory>,
    /// Last value of every measured rotation, which makes it continuous over many turns.
    pub angles: Vec<f64>,
}

/// A model's equations and the storage to evaluate them.
#[derive(Clone, Debug)]
pub struct System {
    pub(crate) model: Model,
    pub(crate) constraints: Vec<Constraint>,
    /// Constraint of each row in force.
    pub(crate) rows: Vec<usize>,
    /// Contributions to the reaction of each friction's joint.
    reactions: Vec<Vec<Contribution>>,
    /// What is known of each friction's bristles before the instant is solved.
    bristles: Vec<BristlePast>,
    /// Whether the instant is a static one, where some frictions rest.
    statics: bool,
    /// What happened so far, as of the last accepted step.
    pub(crate) history: History,
    pub(crate) bodies: Vec<BodyFrame>,
    pub(crate) evaluated: Vec<Evaluated>,
    measures: Vec<f64>,
    /// Measures that the equations (not only outputs) read.
    needed: Vec<bool>,
    measure_bodies: Vec<Vec<usize>>,
    measure_slopes: Vec<Vec<[f64; 12]>>,
    time: f64,
    registers: Vec<f64>,
    adjoints: Vec<f64>,
    jets: Vec<Jet>,
}

impl System {
    /// Numbers the equations of a model; all constraint equations are in force at first.
    #[must_use]
    pub fn new(model: Model) -> Self {
        let constraints = list(&model);
        let evaluated = constraints
            .iter()
            .map(|c| Evaluated::new(c.bodies.len()))
            .collect();
        let reactions = model
            .frictions
            .iter()
            .map(|friction| reaction_of(&constraints, friction.joint))
            .collect();
        let mut needed = vec![false; model.measures.len()];
        let functions = model.forces.iter().map(|f| &f.function);
        let functions = functions.chain(model.constraints.iter().map(|c| &c.function));
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
        let history = History {
            frictions: Vec::new(),
            angles: vec![0.0; model.measures.len()],
        };
        let mut system = Self {
            bodies: vec![BodyFrame::at_rest(); model.bodies.len()],
            measures: vec![0.0; model.measures.len()],
            measure_slopes: measure_bodies
                .iter()
                .map(|b| vec![[0.0; 12]; b.len()])
                .collect(),
            measure_bodies,
            needed,
            rows: Vec::new(),
            reactions,
            bristles: vec![BristlePast::default(); model.frictions.len()],
            statics: false,
            history,
            constraints,
            evaluated,
            time: 0.0,
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
        for (place, (constraint, &active)) in self.constraints.iter_mut().zip(active).enumerate() {
            let active = active && self.model.is_active(constraint.owner.element());
            constraint.row = active.then_some(self.rows.len());
            if active {
                self.rows.push(place);
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
                .flat_map(|force| force.function.inputs())
                .collect()
        };
        let same_pattern = inputs(&fresh.model) == inputs(&self.model);
        let same = fresh.constraints.len() == self.constraints.len()
            && fresh.bodies.len() == self.bodies.len()
            && fresh.model.measures.len() == self.model.measures.len()
            && fresh.model.frictions.len() == self.model.frictions.len();
        assert!(
            same,
            "a changed model must keep the numbering of its equations"
        );
        let active: Vec<bool> = self.constraints.iter().map(|c| c.row.is_some()).collect();
        let before = std::mem::replace(self, fresh);
        self.bodies = before.bodies;
        self.time = before.time;
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
        Memory::at(friction, self.time, &i, &j)
    }

    /// Says whether the instants that follow are static ones.
    pub(crate) fn set_statics(&mut self, statics: bool) {
        self.statics = statics;
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

    /// Takes over the present rotations as the last accepted ones.
    pub(crate) fn remember_angles(&mut self) {
        for place in 0..self.model.measures.len() {
            if matches!(self.model.measures[place].quantity, Quantity::Rotation(_)) {
                self.history.angles[place] = self.measure_value(place);
            }
        }
    }
}

fn reaction_of(constraints: &[Constraint], joint: usize) -> Vec<Contribution> {
    let of_joint = constraints
        .iter()
        .enumerate()
        .filter(|(_, c)| c.owner == Owner::Joint(joint));
    of_joint
        .filter_map(|(constraint, c)| {
            let share = match c.form {
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
