//! SENSOR: an event in a simulation and what it does.

use super::Header;
use crate::expression::Expression;

/// How the function of a sensor is compared with its value.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Comparison {
    /// EQ, and where none is given: within ERROR of VALUE.
    Equal,
    /// GE: at least VALUE - ERROR.
    GreaterOrEqual,
    /// LE: at most VALUE + ERROR.
    LessOrEqual,
}

impl Comparison {
    /// The name in the dataset language.
    #[must_use]
    pub const fn keyword(self) -> &'static str {
        match self {
            Self::Equal => "EQ",
            Self::GreaterOrEqual => "GE",
            Self::LessOrEqual => "LE",
        }
    }
}

/// SENSOR.
#[derive(Clone, Debug, PartialEq)]
pub struct Sensor {
    /// Identifier, name and place.
    pub header: Header,
    /// What is watched.
    pub function: Expression,
    /// How it is compared.
    pub comparison: Comparison,
    /// VALUE: with what it is compared.
    pub value: f64,
    /// ERROR: how far from `value` still counts, positive; default 1e-3.
    pub error: f64,
    /// EVALUATE: what SENVAL gives from the event on.
    pub evaluate: Option<Expression>,
    /// RETURN: the event ends the simulation; the next command follows.
    pub returns: bool,
    /// HALT: the event ends the run.
    pub halts: bool,
}
