//! CURVE and PTCV.

use super::{Builder, Target, add};
use crate::diagnostic::Code;
use crate::keywords::{Keyword, Kind, abbreviated, keyword};
use crate::model::{Curve, PointCurve};
use crate::reading::Reading;

/// Why a curve of a subroutine is not read; what uses it is refused.
const SUBROUTINE: &str = "subroutines are not called, so that the curve has no points";

pub(super) const KEYWORDS: &[Keyword] = &[
    abbreviated("OPEN", "O", Kind::Flag),
    abbreviated("CLOSED", "CL", Kind::Flag),
    keyword("MATRIX", Kind::Id),
    abbreviated("CURVE_POINTS", "CU", Kind::Flag),
    keyword(
        "CONTROL_POINTS",
        Kind::Unsupported("the curve does not go through them; give CURVE_POINTS"),
    ),
    keyword("ORDER", Kind::Integer),
    abbreviated("FUNCTION", "FU", Kind::Ignored(SUBROUTINE)),
    abbreviated("ROUTINE", "RO", Kind::Ignored(SUBROUTINE)),
    abbreviated(
        "MINPAR",
        "MI",
        Kind::Ignored("it is -1 for a curve of points"),
    ),
    abbreviated(
        "MAXPAR",
        "MA",
        Kind::Ignored("it is 1 for a curve of points"),
    ),
];

/// CURVE.
pub(super) fn curve(reading: &mut Reading, builder: &mut Builder) {
    reading.exclude("OPEN", &["CLOSED"]);
    if !reading.has("FUNCTION") {
        reading.require("MATRIX");
    }
    let order = reading.integer("ORDER").unwrap_or(4);
    if !matches!(order, 2 | 4) {
        let span = reading.place("ORDER");
        let message = format!("a curve of ORDER {order} is not drawn");
        reading
            .diagnostics
            .error(Code::UnsupportedArgument, span, message)
            .help("ORDER = 4 is a cubic spline through the points, ORDER = 2 straight lines");
    }
    let curve = Curve {
        header: reading.header(),
        closed: reading.has("CLOSED"),
        matrix: builder.refer(reading, "MATRIX", Target::Matrix),
        order,
    };
    let list = &mut builder.dataset.curves;
    add(list, curve, reading.name, reading.diagnostics);
}

const NEAREST: &str = "I starts at the point of the curve that is nearest; place its part there";
const VELOCITY: &str = "give the velocity of the part: VX, VY and VZ of PART";

pub(super) const POINT_KEYWORDS: &[Keyword] = &[
    keyword("I", Kind::Id),
    abbreviated("JFLOAT", "J", Kind::Id),
    keyword("RM", Kind::Id),
    abbreviated("CURVE", "C", Kind::Id),
    abbreviated("DISP", "D", Kind::Unsupported(NEAREST)),
    keyword("ICM", Kind::Unsupported(NEAREST)),
    abbreviated("VEL", "V", Kind::Unsupported(VELOCITY)),
];

/// PTCV.
pub(super) fn point_curve(reading: &mut Reading, builder: &mut Builder) {
    let point_curve = PointCurve {
        header: reading.header(),
        i: builder.require(reading, "I", Target::Marker),
        j_float: builder.require(reading, "JFLOAT", Target::FloatingMarker),
        rm: builder.require(reading, "RM", Target::Marker),
        curve: builder.require(reading, "CURVE", Target::Curve),
    };
    let list = &mut builder.dataset.point_curves;
    add(list, point_curve, reading.name, reading.diagnostics);
}
