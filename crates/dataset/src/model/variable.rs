//! VARIABLE, PINPUT and POUTPUT.

use super::Header;
use crate::expression::Expression;

/// VARIABLE: an algebraic variable defined by an expression.
#[derive(Clone, Debug, PartialEq)]
pub struct Variable {
    /// Identifier, name and place.
    pub header: Header,
    /// IC: a first guess of its value.
    pub ic: Option<f64>,
    /// Its value.
    pub function: Expression,
}

/// PINPUT or POUTPUT: variables that a control system sets or reads.
#[derive(Clone, Debug, PartialEq)]
pub struct PlantPort {
    /// Identifier, name and place.
    pub header: Header,
    /// VARIABLES: ids.
    pub variables: Vec<u32>,
}
