//! LSE and TFSISO.

use super::Header;

/// LSE: a linear system `x' = A x + B u`, `y = C x + D u`.
#[derive(Clone, Debug, PartialEq)]
pub struct LinearStateEquations {
    /// Identifier, name and place.
    pub header: Header,
    /// X: the ARRAY that names its states.
    pub states: u32,
    /// U: the ARRAY of its inputs.
    pub inputs: Option<u32>,
    /// Y: the ARRAY that names its outputs.
    pub outputs: Option<u32>,
    /// IC: the ARRAY of the states at the start, zero where there is none.
    pub ic: Option<u32>,
    /// The MATRIX by which the rates follow the states.
    pub a: u32,
    /// The MATRIX by which the rates follow the inputs.
    pub b: Option<u32>,
    /// The MATRIX by which the outputs follow the states.
    pub c: Option<u32>,
    /// The MATRIX by which the outputs follow the inputs.
    pub d: Option<u32>,
    /// `STATIC_HOLD`: the states keep their values in static solutions, instead of coming to rest.
    pub static_hold: bool,
}

/// TFSISO: a transfer function from one input to one output.
#[derive(Clone, Debug, PartialEq)]
pub struct TransferFunction {
    /// Identifier, name and place.
    pub header: Header,
    /// X: the ARRAY that names its states, as many as the degree of the denominator.
    pub states: u32,
    /// U: the ARRAY of its input.
    pub input: u32,
    /// Y: the ARRAY that names its output.
    pub output: u32,
    /// Coefficients by rising power of s; its degree is at most that of the denominator.
    pub numerator: Vec<f64>,
    /// Coefficients by rising power of s; the last one is not zero.
    pub denominator: Vec<f64>,
    /// `STATIC_HOLD`: the states keep their values in static solutions, instead of coming to rest.
    pub static_hold: bool,
}
