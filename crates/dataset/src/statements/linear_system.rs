//! LSE and TFSISO.

use super::{Builder, Target, add};
use crate::diagnostic::Code;
use crate::keywords::{Keyword, Kind, abbreviated, keyword};
use crate::model::{LinearStateEquations, TransferFunction};
use crate::reading::Reading;

pub(super) const EQUATIONS_KEYWORDS: &[Keyword] = &[
    keyword("X", Kind::Id),
    keyword("U", Kind::Id),
    keyword("Y", Kind::Id),
    keyword("IC", Kind::Id),
    keyword("A", Kind::Id),
    keyword("B", Kind::Id),
    keyword("C", Kind::Id),
    keyword("D", Kind::Id),
    abbreviated("STATIC_HOLD", "ST", Kind::Flag),
];

/// LSE.
pub(super) fn equations(reading: &mut Reading, builder: &mut Builder) {
    let equations = LinearStateEquations {
        header: reading.header(),
        states: builder.require(reading, "X", Target::Array),
        inputs: builder.refer(reading, "U", Target::Array),
        outputs: builder.refer(reading, "Y", Target::Array),
        ic: builder.refer(reading, "IC", Target::Array),
        a: builder.require(reading, "A", Target::Matrix),
        b: builder.refer(reading, "B", Target::Matrix),
        c: builder.refer(reading, "C", Target::Matrix),
        d: builder.refer(reading, "D", Target::Matrix),
        static_hold: reading.has("STATIC_HOLD"),
    };
    for (keyword, with) in [("B", "U"), ("D", "U"), ("C", "Y"), ("D", "Y")] {
        if reading.has(keyword) {
            reading.require(with);
        }
    }
    let list = &mut builder.dataset.linear_equations;
    add(list, equations, reading.name, reading.diagnostics);
}

pub(super) const TRANSFER_KEYWORDS: &[Keyword] = &[
    keyword("X", Kind::Id),
    keyword("U", Kind::Id),
    keyword("Y", Kind::Id),
    abbreviated("NUMERATOR", "N", Kind::Reals(1, usize::MAX)),
    abbreviated("DENOMINATOR", "D", Kind::Reals(1, usize::MAX)),
    abbreviated("STATIC_HOLD", "ST", Kind::Flag),
];

/// TFSISO.
pub(super) fn transfer_function(reading: &mut Reading, builder: &mut Builder) {
    reading.require("NUMERATOR");
    reading.require("DENOMINATOR");
    let [mut numerator, denominator] = ["NUMERATOR", "DENOMINATOR"].map(|keyword| {
        let numbers = reading.reals(keyword).iter();
        numbers.map(|(number, _)| *number).collect::<Vec<f64>>()
    });
    while numerator.len() > 1 && numerator.last() == Some(&0.0) {
        numerator.pop();
    }
    let both = reading.has("NUMERATOR") && reading.has("DENOMINATOR");
    let span = reading.place("DENOMINATOR");
    let mut refuse = |message: &str| {
        reading.diagnostics.error(Code::OutOfRange, span, message);
    };
    if both && denominator.last() == Some(&0.0) {
        refuse("the last coefficient of DENOMINATOR, of the highest power of s, cannot be zero");
    } else if both && denominator.len() < 2 {
        refuse("DENOMINATOR needs a power of s; write a VARIABLE for a gain alone");
    } else if both && numerator.len() > denominator.len() {
        refuse("NUMERATOR has a higher power of s than DENOMINATOR, which would differentiate");
    }
    let function = TransferFunction {
        header: reading.header(),
        states: builder.require(reading, "X", Target::Array),
        input: builder.require(reading, "U", Target::Array),
        output: builder.require(reading, "Y", Target::Array),
        numerator,
        denominator,
        static_hold: reading.has("STATIC_HOLD"),
    };
    let list = &mut builder.dataset.transfer_functions;
    add(list, function, reading.name, reading.diagnostics);
}
