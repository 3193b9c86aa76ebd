//! SENSOR.

use super::{Builder, add};
use crate::keywords::{Keyword, Kind, abbreviated, keyword};
use crate::model::{Comparison, Sensor};
use crate::reading::Reading;

const OUTPUTS: &str = "sensors do not change output times and steps";
const SUBROUTINE: &str = "subroutines are not called";

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
    abbreviated("EVALUATE", "EV", Kind::Ignored("SENVAL is not simulated")),
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
    keyword("DT", Kind::Unsupported(OUTPUTS)),
    abbreviated("STEPSIZE", "S", Kind::Unsupported(OUTPUTS)),
    abbreviated("ROUTINE", "RO", Kind::Unsupported(SUBROUTINE)),
];

/// Without ERROR; from the documentation of Adams as remembered.
const DEFAULT_ERROR: f64 = 1e-3;

/// SENSOR.
pub(super) fn sensor(reading: &mut Reading, builder: &mut Builder) {
    let comparisons = [
        Comparison::Equal,
        Comparison::GreaterOrEqual,
        Comparison::LessOrEqual,
    ]
    .map(|comparison| (comparison.keyword(), comparison));
    let comparison = reading.required_flag("a comparison", &comparisons);
    reading.require("VALUE");
    let sensor = Sensor {
        header: reading.header(),
        function: reading.required_expression("FUNCTION"),
        comparison: comparison.unwrap_or(Comparison::Equal),
        value: reading.real("VALUE").unwrap_or(0.0),
        error: reading.positive("ERROR").unwrap_or(DEFAULT_ERROR),
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
