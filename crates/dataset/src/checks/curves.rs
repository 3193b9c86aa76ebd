//! Curves have points, and points on curves hang together.

use crate::diagnostic::{Code, Diagnostics};
use crate::model::{Curve, Dataset};

/// The fewest points of a curve.
const FEWEST: usize = 4;

/// Reports curves that cannot be drawn, and points on curves that have no points.
pub(super) fn check(dataset: &Dataset, diagnostics: &mut Diagnostics) {
    for curve in &dataset.curves {
        points(dataset, curve, diagnostics);
    }
    for point in &dataset.point_curves {
        let (id, span) = (point.header.id, point.header.span);
        let name = format!("PTCV/{id}");
        if let Some(curve) = dataset.curves.by_id(point.curve)
            && curve.matrix.is_none()
        {
            let message = format!(
                "{name} needs points of CURVE/{}, which has none",
                point.curve
            );
            diagnostics
                .error(Code::MissingElement, span, message)
                .help("give the curve its points: MATRIX = id, CURVE_POINTS");
        }
        let owner = |id| dataset.markers.by_id(id).map(|marker| marker.owner);
        let (Some(j), Some(rm)) = (owner(point.j_float), owner(point.rm)) else {
            continue;
        };
        if j != rm {
            let message = format!("JFLOAT and RM of {name} are on different parts");
            diagnostics
                .error(Code::InvalidConnection, span, message)
                .help("both belong on the part that carries the curve");
        }
    }
}

fn points(dataset: &Dataset, curve: &Curve, diagnostics: &mut Diagnostics) {
    let Some(matrix) = curve.matrix.and_then(|id| dataset.matrices.by_id(id)) else {
        return;
    };
    let (curve_id, id) = (curve.header.id, matrix.header.id);
    if matrix.columns != 3 || matrix.rows < FEWEST {
        let message = format!(
            "CURVE/{curve_id} needs at least {FEWEST} points of 3 coordinates, but MATRIX/{id} has \
             {} rows and {} columns",
            matrix.rows, matrix.columns
        );
        diagnostics.error(Code::InvalidValue, curve.header.span, message);
        return;
    }
    let Some(values) = matrix.by_rows() else {
        let message = format!("CURVE/{curve_id} needs every number of MATRIX/{id} given once");
        diagnostics.error(Code::InvalidValue, curve.header.span, message);
        return;
    };
    let ends = (values.get(..3), values.get(3 * matrix.rows - 3..));
    if curve.closed && ends.0 != ends.1 {
        let message = format!(
            "CURVE/{curve_id} is CLOSED, but the last point of MATRIX/{id} is not the first one"
        );
        diagnostics
            .error(Code::InvalidValue, curve.header.span, message)
            .help("repeat the first point at the end");
    }
}
