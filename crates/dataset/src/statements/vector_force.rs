//! VFORCE, VTORQUE and GFORCE.

use super::{Builder, Target, add};
use crate::diagnostic::Code;
use crate::expression::Expression;
use crate::keywords::{INTERFACE, Keyword, Kind, abbreviated, keyword};
use crate::model::VectorForce;
use crate::reading::Reading;

const SUBROUTINE: &str = "subroutines are not called; write its components";

const I: Keyword = keyword("I", Kind::Id);
const JFLOAT: Keyword = abbreviated("JFLOAT", "J", Kind::Id);
const RM: Keyword = keyword("RM", Kind::Id);
const FX: Keyword = keyword("FX", Kind::Expression);
const FY: Keyword = keyword("FY", Kind::Expression);
const FZ: Keyword = keyword("FZ", Kind::Expression);
const TX: Keyword = keyword("TX", Kind::Expression);
const TY: Keyword = keyword("TY", Kind::Expression);
const TZ: Keyword = keyword("TZ", Kind::Expression);
const FXYZ: Keyword = keyword("FXYZ", Kind::Expression);
const TXYZ: Keyword = keyword("TXYZ", Kind::Expression);
const FUNCTION: Keyword = abbreviated("FUNCTION", "FU", Kind::Unsupported(SUBROUTINE));
const ROUTINE: Keyword = keyword("ROUTINE", Kind::Unsupported(SUBROUTINE));

pub(crate) const FORCE_KEYWORDS: &[Keyword] = &[
    I, JFLOAT, RM, FX, FY, FZ, FXYZ, FUNCTION, ROUTINE, INTERFACE,
];
pub(crate) const TORQUE_KEYWORDS: &[Keyword] = &[
    I, JFLOAT, RM, TX, TY, TZ, TXYZ, FUNCTION, ROUTINE, INTERFACE,
];
pub(crate) const GENERAL_KEYWORDS: &[Keyword] = &[
    I, JFLOAT, RM, FX, FY, FZ, TX, TY, TZ, FXYZ, TXYZ, FUNCTION, ROUTINE, INTERFACE,
];

/// The components that are given; one that the statement has no argument for is not.
pub(crate) fn components(reading: &mut Reading) -> [Option<Expression>; 6] {
    ["FX", "FY", "FZ", "TX", "TY", "TZ"].map(|keyword| reading.expression(keyword))
}

/// Whether a component is given, be it read or refused.
fn has_component(reading: &Reading) -> bool {
    let names = [
        "FX", "FY", "FZ", "TX", "TY", "TZ", "FXYZ", "TXYZ", "FUNCTION", "ROUTINE",
    ];
    names.iter().any(|keyword| reading.has(keyword))
}

/// VFORCE.
pub(super) fn force(reading: &mut Reading, builder: &mut Builder) {
    let force = vector_force(reading, builder, "FX, FY and FZ");
    let list = &mut builder.dataset.vector_forces;
    add(list, force, reading.name, reading.diagnostics);
}

/// VTORQUE.
pub(super) fn torque(reading: &mut Reading, builder: &mut Builder) {
    let force = vector_force(reading, builder, "TX, TY and TZ");
    let list = &mut builder.dataset.vector_torques;
    add(list, force, reading.name, reading.diagnostics);
}

/// GFORCE.
pub(super) fn general(reading: &mut Reading, builder: &mut Builder) {
    let force = vector_force(reading, builder, "FX, FY, FZ, TX, TY and TZ");
    let list = &mut builder.dataset.general_forces;
    add(list, force, reading.name, reading.diagnostics);
}

fn vector_force(reading: &mut Reading, builder: &mut Builder, names: &str) -> VectorForce {
    if !has_component(reading) {
        let message = format!("{} has no component", reading.label());
        let span = reading.head;
        reading
            .diagnostics
            .error(Code::MissingArgument, span, message)
            .help(format!("add {names}; one that is left out is zero"));
    }
    reading.exclude("FXYZ", &["FX", "FY", "FZ"]);
    reading.exclude("TXYZ", &["TX", "TY", "TZ"]);
    VectorForce {
        header: reading.header(),
        i: builder.require(reading, "I", Target::Marker),
        j_float: builder.require(reading, "JFLOAT", Target::FloatingMarker),
        rm: builder.require(reading, "RM", Target::Marker),
        components: components(reading),
        vectors: ["FXYZ", "TXYZ"].map(|keyword| reading.vector_expression(keyword)),
    }
}
