//! Slopes of the cubic spline.

use super::secant;

/// Slope at every point so that the second derivative is continuous, and the third at the second
/// and the last but one point. The equations are tridiagonal once the end ones are combined with
/// their neighbours (de Boor, chapter IV, equations 7 and 8).
pub(super) fn slopes(x: &[f64], y: &[f64]) -> Vec<f64> {
    let last = x.len() - 1;
    let width = |k: usize| x[k + 1] - x[k];
    let m = |k: usize| secant(x, y, k);
    // Row k: (left of the diagonal, diagonal, right of it, right-hand side).
    let mut rows = Vec::with_capacity(last + 1);
    let not_a_knot = |outer: f64, inner: f64, at_end: f64, beside: f64| {
        let both = outer + inner;
        let side = ((outer + 2.0 * both) * inner * at_end + outer * outer * beside) / both;
        (inner, both, side)
    };
    let (diagonal, right, side) = not_a_knot(width(0), width(1), m(0), m(1));
    rows.push((0.0, diagonal, right, side));
    for k in 1..last {
        let (before, behind) = (width(k - 1), width(k));
        let side = 3.0 * (behind * m(k - 1) + before * m(k));
        rows.push((behind, 2.0 * (before + behind), before, side));
    }
    let (diagonal, left, side) =
        not_a_knot(width(last - 1), width(last - 2), m(last - 1), m(last - 2));
    rows.push((left, diagonal, 0.0, side));

    for k in 1..=last {
        let factor = rows[k].0 / rows[k - 1].1;
        rows[k].1 -= factor * rows[k - 1].2;
        rows[k].3 -= factor * rows[k - 1].3;
    }
    let mut slopes = vec![0.0; last + 1];
    slopes[last] = rows[last].3 / rows[last].1;
    for k in (0..last).rev() {
        slopes[k] = (rows[k].3 - rows[k].2 * slopes[k + 1]) / rows[k].1;
    }
    slopes
}
