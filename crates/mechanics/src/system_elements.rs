//! System elements: unknowns beside those of the bodies, each with an equation of its own.
//!
//! ```text
//! ẏ = f(t, x, u, y, ẏ, w)   or   0 = f      differential states
//! w = f(t, x, u, y, ẏ, w)   or   0 = f      algebraic variables
//! ```
//!
//! They are solved together with velocities and reactions, at the same instant. An acceleration or a
//! force that a function reads is an algebraic variable, too: so functions depend on states and
//! variables only, and however they depend on one another is solved by Newton's iteration.

use crate::expression::Program;
use crate::force_element::ForceComponent;
use crate::model::Label;

/// How a function determines its unknown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Form {
    /// The unknown is the function.
    Explicit,
    /// The function is zero.
    Implicit,
}

/// A differential equation of first order.
#[derive(Clone, Debug)]
pub struct DifferentialState {
    /// How it is called.
    pub label: Label,
    /// Whether the function is the rate, or zero.
    pub form: Form,
    /// A function of time, displacements, velocities, states and their rates, and variables.
    pub function: Program,
    /// Value at the start, in the state's own unit.
    pub start: f64,
    /// First guess of the rate at the start, which an implicit function is solved from.
    pub start_rate: f64,
    /// Whether the state keeps its value in static solutions, instead of coming to rest.
    pub held_in_statics: bool,
}

/// An unknown that follows from everything else at the same instant.
#[derive(Clone, Debug)]
pub struct AlgebraicVariable {
    /// How it is called.
    pub label: Label,
    /// What determines it.
    pub definition: Definition,
    /// First guess.
    pub start: f64,
}

/// What determines an algebraic variable.
#[derive(Clone, Debug)]
pub enum Definition {
    /// A function, of the variable itself too.
    Function(Form, Program),
    /// A quantity of acceleration, by its place in [`crate::model::Model::measures`].
    Acceleration(usize),
    /// A component of a force or torque.
    Force(ForceComponent),
}

impl Definition {
    /// The function, where there is one.
    #[must_use]
    pub fn function(&self) -> Option<&Program> {
        match self {
            Self::Function(_, function) => Some(function),
            Self::Acceleration(_) | Self::Force(_) => None,
        }
    }
}
