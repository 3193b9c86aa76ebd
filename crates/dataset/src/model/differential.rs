//! DIFF.

use super::Header;
use crate::expression::Expression;

/// DIFF: a differential equation of first order with a state of its own.
#[derive(Clone, Debug, PartialEq)]
pub struct DifferentialEquation {
    /// Identifier, name and place.
    pub header: Header,
    /// IC: the state at the start, zero where it is not given.
    pub ic: f64,
    /// The second number of IC: a first guess of its rate there.
    pub ic_rate: Option<f64>,
    /// The rate; with IMPLICIT what is zero.
    pub function: Expression,
    /// IMPLICIT: the function is zero, instead of the rate.
    pub implicit: bool,
    /// `STATIC_HOLD`: the state keeps its value in static solutions, instead of coming to rest.
    pub static_hold: bool,
}
