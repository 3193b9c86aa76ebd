//! Accelerations, reactions and friction of one instant, and the return to the constraints.

use numerics::linear::{FrontalLu, Matrix, Singular};
use serde::{Deserialize, Serialize};

use crate::constraint::Owner;
use crate::dynamics::Scales;
use crate::model::Label;
use crate::state::State;
use crate::system::{Rows, System, Weights};

/// Newton iterations for reactions with friction before giving up.
const ITERATIONS: usize = 50;

/// Why equations could not be solved; rows and elements are named by [`System::describe`].
#[derive(Clone, Debug, PartialEq)]
pub enum Failure {
    /// The Newton matrix has no inverse: equation and unknown that depend on the others.
    Singular(Singular),
    /// Newton's iteration did not converge; the unknown that changed most.
    NotConverged {
        /// Place among velocities and multipliers.
        unknown: usize,
    },
    /// An element's function gave something that is not a number.
    NotANumber {
        /// The element; none where it shows in the reactions first.
        element: Option<Label>,
    },
    /// Positions at which all forces balance were not found; the component of a body that lacks
    /// most.
    NoEquilibrium {
        /// Place among the velocities.
        unknown: usize,
    },
    /// A body would turn too far in one step.
    TurnsTooFar {
        /// The body.
        body: usize,
    },
}

/// Magnitude below which rates of states and algebraic variables count as zero, in their own unit.
const SMALLEST: f64 = 1e-6;

/// Changes of the rates of states and of the algebraic variables in an iteration.
#[derive(Clone, Copy, Debug, Default)]
struct ElementChange {
    /// The largest one relative to the value itself, and its place among the unknowns.
    own: f64,
    unknown: usize,
    /// The largest one relative to all values of its kind.
    common: f64,
}

impl ElementChange {
    /// Whether nothing but rounding is left, where `last` was the change before.
    fn settled(&self, last: f64) -> bool {
        self.own <= 1e-13 || self.own >= 0.5 * last && self.common <= 1e-9
    }
}

/// What an equation or unknown of the Newton matrix belongs to.
enum Place {
    /// A component of the motion of a body: six numbers a body.
    Motion(usize),
    /// A differential state.
    State(usize),
    /// A constraint equation, by its place among all of them.
    Constraint(usize),
    /// An algebraic variable.
    Algebraic(usize),
}

/// Solves the equations at γ = 0: matrix, factors and right-hand side with fixed storage.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Instant {
    matrix: Matrix,
    factors: FrontalLu,
    /// Whether the factors are those of an instant as near as the guess of its solution is.
    fits: bool,
    right: Vec<f64>,
    force: Vec<f64>,
    momentum: Vec<f64>,
    zero: Vec<f64>,
    guess: Vec<f64>,
    guessed_accelerations: Vec<f64>,
}

impl Instant {
    pub(crate) fn new(system: &System) -> Self {
        let n = system.rate_count();
        let size = system.unknown_count();
        Self {
            matrix: Matrix::new(size),
            factors: FrontalLu::new(system.elimination_groups()),
            fits: false,
            right: vec![0.0; size],
            force: vec![0.0; n],
            momentum: vec![0.0; n],
            zero: vec![0.0; n],
            guess: vec![0.0; system.multiplier_count()],
            guessed_accelerations: vec![0.0; n],
        }
    }

    /// Leaves the factors of the instant solved last, for the next one is another.
    pub(crate) fn forget(&mut self) {
        self.fits = false;
    }

    /// Accelerations `u̇` and multipliers `λ` at `state`, with friction, reactions and system elements
    /// of the same instant. `accelerations` and `multipliers` hold the first guess on entry.
    pub(crate) fn accelerations(
        &mut self,
        system: &mut System,
        state: &State,
        accelerations: &mut [f64],
        multipliers: &mut [f64],
    ) -> Result<(), Failure> {
        self.guess.copy_from_slice(multipliers);
        self.guessed_accelerations.copy_from_slice(accelerations);
        system.set_statics(false);
        system.evaluate(state, false);
        let n = system.rate_count();
        let rows = system.row_count();
        let mut last = f64::INFINITY;
        let mut last_elements = f64::INFINITY;
        let mut worst = 0;
        let mut renew = !std::mem::take(&mut self.fits);
        for _ in 0..ITERATIONS {
            self.residual(system, accelerations, multipliers)?;
            if renew {
                self.factor(system, multipliers)?;
            }
            self.factors.solve(&mut self.right);
            let mut change = 0.0_f64;
            let mut size = 0.0_f64;
            for row in 0..rows {
                if self.right[n + row].abs() > change {
                    change = self.right[n + row].abs();
                    worst = n + row;
                }
                multipliers[row] += self.right[n + row];
                size = size.max(multipliers[row].abs());
            }
            for row in rows..multipliers.len() {
                multipliers[row] += self.right[n + row];
            }
            for k in 0..n {
                accelerations[k] += self.right[k];
            }
            // Reactions that are zero are so within the rounding of the forces.
            size = self.force.iter().fold(size, |m, f| m.max(f.abs()));
            let elements = self.element_change(system, accelerations, multipliers);
            if elements.own > 1e-9 {
                worst = elements.unknown;
            }
            if !(change.is_finite() && accelerations.iter().all(|a| a.is_finite())) {
                return Err(self.not_a_number(system));
            }
            // Without friction in the reactions the equations are linear: the second solve only
            // cleans up the rounding of the first. With it the iteration ends at rounding.
            let linear = system.model.frictions.is_empty() && !system.has_elements();
            let solved = last.is_finite() && linear;
            let rounding = change >= 0.5 * last && change <= 1e-9 * size;
            let settled = solved || change <= 1e-13 * size || rounding;
            if settled && elements.settled(last_elements) {
                self.fits = true;
                return Ok(());
            }
            // A matrix of a guess that was far off says nothing of how friction follows the reactions: with
            // it friction that loads itself may come to another solution, where the joint jams.
            renew = change > 0.1 * last.min(size) || elements.own > 0.1 * last_elements;
            last = change;
            last_elements = elements.own;
        }
        Err(Failure::NotConverged { unknown: worst })
    }

    /// How much the rates of states and the algebraic variables changed in the last iteration.
    fn element_change(
        &self,
        system: &System,
        accelerations: &[f64],
        multipliers: &[f64],
    ) -> ElementChange {
        let (moving, n) = (system.velocity_count(), system.rate_count());
        let largest = |values: &[f64]| values.iter().fold(SMALLEST, |m, v| m.max(v.abs()));
        let groups = [
            (moving, &accelerations[moving..]),
            (
                n + system.row_count(),
                &multipliers[system.row_count()..system.first_shared()],
            ),
        ];
        // Rounding in a variable that reads reactions is that of the reactions.
        let scales = [largest(groups[0].1), largest(multipliers)];
        let mut found = ElementChange::default();
        for ((first, values), scale) in groups.into_iter().zip(scales) {
            for (k, value) in values.iter().enumerate() {
                let change = self.right[first + k].abs();
                let own = change / value.abs().max(SMALLEST);
                if own > found.own {
                    found.own = own;
                    found.unknown = first + k;
                }
                found.common = found.common.max(change / scale);
            }
        }
        found
    }

    /// The matrix and its factors.
    pub(crate) fn factored(&self) -> (&Matrix, &FrontalLu) {
        (&self.matrix, &self.factors)
    }

    /// The multipliers that the last solution started from.
    pub(crate) fn guess(&self) -> &[f64] {
        &self.guess
    }

    /// The accelerations that the last solution started from.
    pub(crate) fn guessed_accelerations(&self) -> &[f64] {
        &self.guessed_accelerations
    }

    /// Builds and factors the matrix at the state evaluated last. At γ = 0 it needs no derivatives
    /// by position and velocity.
    fn factor(&mut self, system: &mut System, multipliers: &[f64]) -> Result<(), Failure> {
        system.assemble(
            Rows::Position,
            Weights::instant(),
            &self.zero,
            multipliers,
            &mut self.matrix,
        );
        let factored = self.factors.factor(&self.matrix);
        factored.map_err(|singular| system.without_solution(singular))
    }

    /// Right-hand side: forces less inertia, and what the constraints lack.
    fn residual(
        &mut self,
        system: &mut System,
        accelerations: &[f64],
        multipliers: &[f64],
    ) -> Result<(), Failure> {
        let n = system.rate_count();
        system.set_solution(accelerations, 1.0, multipliers);
        system.mass_times(accelerations, &mut self.momentum);
        system.forces(multipliers, &mut self.force);
        for k in 0..n {
            self.right[k] = self.force[k] - self.momentum[k];
        }
        system.prescribe_accelerations(&mut self.right[n..]);
        for (right, &place) in self.right[n..].iter_mut().zip(&system.rows) {
            let constraint = &system.constraints[place];
            *right -= system.evaluated[place].rate_of(constraint, accelerations);
        }
        let first = n + system.row_count();
        system.algebraic_residual(multipliers, &mut self.right[first..]);
        if self.right.iter().all(|r| r.is_finite()) {
            Ok(())
        } else {
            Err(self.not_a_number(system))
        }
    }

    fn not_a_number(&self, system: &mut System) -> Failure {
        Failure::NotANumber {
            element: system.find_not_a_number(),
        }
    }

    /// Moves `state` onto the position constraints and then its velocities onto the velocity
    /// constraints, by the least change in the metric of the mass matrix. Leaves a state that lacks
    /// nothing but rounding as it is.
    pub(crate) fn project(
        &mut self,
        system: &mut System,
        state: &mut State,
        multipliers: &[f64],
        scales: &Scales,
    ) -> Result<(), Failure> {
        let n = system.rate_count();
        let moving = system.velocity_count();
        let rounding = 1e-14 * scales.length;
        system.set_statics(false);
        system.evaluate(state, false);
        let rates = &mut self.right[n..n + system.row_count()];
        system.velocity_lacks(state.velocities(), rates);
        let meets = |place: &usize| system.evaluated[*place].error.abs() <= rounding;
        let stays = |lack: &f64| lack.abs() <= rounding * scales.rate;
        if system.rows.iter().all(meets) && rates.iter().all(stays) {
            return Ok(());
        }
        self.fits = false;
        self.factor(system, multipliers)?;
        // One matrix serves: the corrections are of the size of the integration error.
        for _ in 0..10 {
            let mut error = 0.0_f64;
            self.right.fill(0.0);
            for (row, &place) in system.rows.iter().enumerate() {
                self.right[n + row] = -system.evaluated[place].error;
                error = error.max(system.evaluated[place].error.abs());
            }
            if error <= rounding {
                break;
            }
            self.factors.solve(&mut self.right);
            state.displace(&self.right[..moving]);
            system.evaluate(state, false);
        }
        self.right.fill(0.0);
        system.velocity_lacks(state.velocities(), &mut self.right[n..]);
        self.factors.solve(&mut self.right);
        for (u, change) in state.velocities_mut().iter_mut().zip(&self.right[..n]) {
            *u += change;
        }
        // Reactions start from those that it was built with.
        self.fits = true;
        Ok(())
    }
}

impl System {
    /// Why a matrix has no inverse: a force or slope that is not finite makes any matrix look so.
    pub(crate) fn without_solution(&mut self, singular: Singular) -> Failure {
        let element = self.find_not_a_number();
        match element.or_else(|| self.find_infinite_slope()) {
            None => Failure::Singular(singular),
            element => Failure::NotANumber { element },
        }
    }

    /// Names the element whose function is not a number at the instant evaluated last.
    pub(crate) fn find_not_a_number(&mut self) -> Option<Label> {
        for place in 0..self.model.forces.len() {
            if !self.force_value(place).is_finite() {
                return Some(self.model.forces[place].label.clone());
            }
        }
        if let Some(label) = self.element_not_a_number() {
            return Some(label.clone());
        }
        // Motions and functions first: what they give spreads to joints through the state.
        let constraints = self.constraints.iter().zip(&self.evaluated);
        let (joints, others): (Vec<_>, Vec<_>) =
            constraints.partition(|(constraint, _)| matches!(constraint.owner, Owner::Joint(_)));
        for (constraint, evaluated) in others.into_iter().chain(joints) {
            let sum = evaluated.error + evaluated.rate + evaluated.unbiased_acceleration;
            if !sum.is_finite() {
                return Some(self.owner_label(constraint.owner).clone());
            }
        }
        for (body, frame) in self.model.bodies.iter().zip(&self.bodies) {
            if !(frame.centre.sum() + frame.velocity.sum() + frame.omega.sum()).is_finite() {
                return Some(body.label.clone());
            }
        }
        None
    }

    /// Label of the element that a constraint equation belongs to.
    #[must_use]
    pub fn owner_label(&self, owner: Owner) -> &Label {
        match owner {
            Owner::Joint(place) => &self.model.joints[place].label,
            Owner::Motion(place) => &self.model.motions[place].label,
            Owner::General(place) => &self.model.constraints[place].label,
        }
    }

    /// What a place among the equations and unknowns of the Newton matrix stands for.
    fn place(&self, place: usize) -> Option<Place> {
        let velocities = self.velocity_count();
        if place < velocities {
            return Some(Place::Motion(place));
        }
        let Some(row) = place.checked_sub(self.rate_count()) else {
            return Some(Place::State(place - velocities));
        };
        if let Some(&constraint) = self.rows.get(row) {
            return Some(Place::Constraint(constraint));
        }
        let Some(shared) = row.checked_sub(self.first_shared()) else {
            return Some(Place::Algebraic(row - self.rows.len()));
        };
        self.shared_place(shared).map(|place| match place {
            Ok(motion) => Place::Motion(motion),
            Err(constraint) => Place::Constraint(constraint),
        })
    }

    /// Whether an equation is that of a system element.
    fn is_element(&self, place: usize) -> bool {
        matches!(
            self.place(place),
            Some(Place::State(_) | Place::Algebraic(_))
        )
    }

    /// The element that a row or unknown of the Newton matrix belongs to.
    pub(crate) fn element_at(&self, place: usize) -> Option<&Label> {
        Some(match self.place(place)? {
            Place::Motion(motion) => &self.model.bodies[motion / 6].label,
            Place::State(state) => &self.model.states[state].label,
            Place::Constraint(place) => self.owner_label(self.constraints[place].owner),
            Place::Algebraic(variable) => &self.model.algebraics[variable].label,
        })
    }

    /// The friction of the joint whose multiplier an unknown of the Newton matrix is.
    fn friction_at(&self, place: usize) -> Option<&Label> {
        let Some(Place::Constraint(constraint)) = self.place(place) else {
            return None;
        };
        let Owner::Joint(joint) = self.constraints[constraint].owner else {
            return None;
        };
        let friction = self.model.frictions.iter().find(|f| f.joint == joint)?;
        Some(&friction.label)
    }

    /// The element that a failure is about, where there is one.
    #[must_use]
    pub fn element_of<'a>(&'a self, failure: &'a Failure) -> Option<&'a Label> {
        match failure {
            Failure::Singular(singular) => self.element_at(singular.row),
            Failure::NotConverged { unknown } | Failure::NoEquilibrium { unknown } => {
                self.element_at(*unknown)
            }
            Failure::NotANumber { element } => element.as_ref(),
            Failure::TurnsTooFar { body } => Some(&self.model.bodies[*body].label),
        }
    }

    /// What a row or unknown of the Newton matrix means, for messages.
    #[must_use]
    pub fn describe(&self, place: usize) -> String {
        match self.place(place) {
            Some(Place::Motion(motion)) => {
                let component = [
                    "X",
                    "Y",
                    "Z",
                    "rotation about X",
                    "rotation about Y",
                    "rotation about Z",
                ];
                let body = &self.model.bodies[motion / 6];
                format!("{}, {}", body.label, component[motion % 6])
            }
            Some(Place::State(state)) => self.model.states[state].label.to_string(),
            Some(Place::Constraint(constraint)) => {
                let constraint = &self.constraints[constraint];
                let name = crate::constraint::name(constraint.form);
                format!("{}, equation {name}", self.owner_label(constraint.owner))
            }
            Some(Place::Algebraic(variable)) => self.model.algebraics[variable].label.to_string(),
            None => "an unknown equation".to_owned(),
        }
    }

    /// A failure in mechanical words.
    #[must_use]
    pub fn explain(&self, failure: &Failure) -> String {
        match failure {
            Failure::Singular(singular) if self.is_element(singular.row) => format!(
                "{} is not determined (with {}): its function leaves its own value, or its rate, as it \
                 is",
                self.describe(singular.row),
                self.describe(singular.column)
            ),
            Failure::Singular(singular) => format!(
                "the equations have no unique solution near {} (unknown of {}); likely causes: a \
                 part without mass that can move freely, a position where the mechanism locks, or \
                 friction so strong that the joint jams",
                self.describe(singular.row),
                self.describe(singular.column)
            ),
            Failure::NotConverged { unknown } => {
                let place = self.describe(*unknown);
                let jam = self.friction_at(*unknown).map_or(String::new(), |friction| {
                    format!(
                        "; {friction} jams where the friction that a load causes adds as much to \
                         that load (a gain of one)"
                    )
                });
                format!("Newton's iteration did not converge; {place} changed most{jam}")
            }
            Failure::NotANumber { element } => not_a_number(element.as_ref()),
            Failure::NoEquilibrium { unknown } => format!(
                "no equilibrium was found; what is left is largest at {}",
                self.describe(*unknown)
            ),
            Failure::TurnsTooFar { body } => {
                format!(
                    "{} would turn too far in one step",
                    self.model.bodies[*body].label
                )
            }
        }
    }
}

/// Says that an element's value is not a number.
pub(crate) fn not_a_number(element: Option<&Label>) -> String {
    match element {
        Some(element) => format!("{element} gives a value or slope that is not a finite number"),
        None => "the reactions are not finite numbers".to_owned(),
    }
}
