//! SENSOR.

use super::{Builder, add};
use crate::keywords::{INTERFACE, Keyword, Kind, ROUTINE, SUBROUTINE, abbreviated, keyword};
use crate::model::{Comparison, Sensor};
use crate::reading::Reading;

const FOUND: &str = "events are looked for at outputs";

pub(super) const KEYWORDS: &[Keyword] = &[
    keyword("EQ", Kind::Flag),
    keyword("GE", Kind::Flag),
    keyword("LE", Kind::Flag),
    abbreviated("VALUE", "V", Kind::Real),
    abbreviated("ERROR", "ER", Kind::Real),
    abbreviated("FUNCTION", "FU", Kind::Expression),
    abbreviated("HALT", "H", Kind::Flag),
    abbreviated("RETURN", "RET", Kind::Flag),
    // Every event is told in the message file, and is looked for at outputs only.
    abbreviated("PRINT", "P", Kind::Flag),
    abbreviated("EVALUATE", "EV", Kind::Expression),
    abbreviated(
        "CODGEN",
        "C",
        Kind::Ignored("it is about another linear solver"),
    ),
    abbreviated(
        "RESTART",
        "RES",
        Kind::Ignored("the integrator restarts by itself"),
    ),
    abbreviated(
        "YYDUMP",
        "Y",
        Kind::Ignored("it asks for diagnostics of another program"),
    ),
    abbreviated("BISECTION", "B", Kind::Ignored(FOUND)),
    abbreviated("TERROR", "T", Kind::Ignored(FOUND)),
    keyword(
        "DT",
        Kind::Ignored("outputs stay where SIMULATE asks for them"),
    ),
    abbreviated(
        "STEPSIZE",
        "S",
        Kind::Ignored("the integrator chooses its steps by its error"),
    ),
    ROUTINE,
    keyword("EVALUATE_ROUTINE", Kind::Ignored(SUBROUTINE)),
    INTERFACE,
];

/// Without ERROR: the documentation of the SENSOR statement.
const DEFAULT_ERROR: f64 = 1e-3;

/// SENSOR.
pub(super) fn sensor(reading: &mut Reading, builder: &mut Builder) {
    let comparisons = [
        Comparison::Equal,
        Comparison::GreaterOrEqual,
        Comparison::LessOrEqual,
    ]
    .map(|comparison| (comparison.keyword(), comparison));
    let comparison = reading.one_flag(&comparisons);
    reading.require("VALUE");
    let sensor = Sensor {
        header: reading.header(),
        function: reading.required_expression("FUNCTION"),
        comparison: comparison.unwrap_or(Comparison::Equal),
        value: reading.real("VALUE").unwrap_or(0.0),
        error: reading.positive("ERROR").unwrap_or(DEFAULT_ERROR),
        evaluate: reading.expression("EVALUATE"),
        returns: reading.has("RETURN"),
        halts: reading.has("HALT"),
    };
    add(
        &mut builder.dataset.sensors,
        sensor,
        reading.name,
        reading.diagnostics,
    );
}
