//! DIFF.

use super::{Builder, add};
use crate::keywords::{INTERFACE, Keyword, Kind, ROUTINE, abbreviated, keyword};
use crate::model::DifferentialEquation;
use crate::reading::Reading;

pub(super) const KEYWORDS: &[Keyword] = &[
    keyword("IC", Kind::Reals(1, 2)),
    abbreviated("FUNCTION", "FU", Kind::Expression),
    abbreviated("IMPLICIT", "IM", Kind::Flag),
    abbreviated("STATIC_HOLD", "ST", Kind::Flag),
    ROUTINE,
    INTERFACE,
];

/// DIFF.
pub(super) fn differential(reading: &mut Reading, builder: &mut Builder) {
    let ic = |place: usize| reading.reals("IC").get(place).map(|(value, _)| *value);
    let (ic, ic_rate) = (ic(0).unwrap_or(0.0), ic(1));
    let equation = DifferentialEquation {
        header: reading.header(),
        ic,
        ic_rate,
        function: reading.required_expression("FUNCTION"),
        implicit: reading.has("IMPLICIT"),
        static_hold: reading.has("STATIC_HOLD"),
    };
    let list = &mut builder.dataset.differentials;
    add(list, equation, reading.name, reading.diagnostics);
}
