//! Curves through data points, in pieces of cubic polynomials.

mod akima;
mod cubic;
mod surface;

pub use surface::{Surface, SurfacePoint};

/// A piecewise cubic with its extrapolation on both sides.
///
/// ```
/// use numerics::interpolation::{Extrapolation, PiecewiseCubic};
/// let x = [0.0, 1.0, 2.0, 4.0];
/// let curve = PiecewiseCubic::cubic_spline(&x, &x.map(|x| x * x), Extrapolation::Parabola).unwrap();
/// let [value, slope, curvature, ..] = curve.derivatives(3.0);
/// assert!((value - 9.0).abs() < 1e-14);
/// assert!((slope - 6.0).abs() < 1e-14);
/// assert!((curvature - 2.0).abs() < 1e-14);
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct PiecewiseCubic {
    knots: Vec<f64>,
    /// Before the first knot, between the knots, behind the last one: coefficients of the powers
    /// of the distance from the knot before the piece (of the first piece: from the first knot).
    pieces: Vec<[f64; 4]>,
}

/// How a curve goes on outside its data.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Extrapolation {
    /// The line through the first or the last two points.
    Line,
    /// The parabola through the first or the last three points.
    Parabola,
    /// The tangent at the first or the last point.
    Tangent,
}

impl PiecewiseCubic {
    /// Akima's interpolation: slopes from the four nearest secants, no overshoot beside jumps; the
    /// slope is continuous. H. Akima, *A new method of interpolation and smooth curve fitting based
    /// on local procedures*, J. ACM 17 (1970) 589-602; ends by his section 2.3.
    ///
    /// `None` through fewer than four points, where `x` does not increase, and where not every `x`
    /// has its `y`; so for all curves.
    #[must_use]
    pub fn akima(x: &[f64], y: &[f64], extrapolation: Extrapolation) -> Option<Self> {
        is_drawable(x, y).then(|| Self::through(x, y, &akima::slopes(x, y), extrapolation))
    }

    /// The cubic spline: two continuous derivatives; at the second and the last but one point the
    /// third is continuous too ("not a knot": C. de Boor, *A Practical Guide to Splines*, chapter
    /// IV), so that a cubic is met everywhere. `None` as for [`PiecewiseCubic::akima`].
    #[must_use]
    pub fn cubic_spline(x: &[f64], y: &[f64], extrapolation: Extrapolation) -> Option<Self> {
        is_drawable(x, y).then(|| Self::through(x, y, &cubic::slopes(x, y), extrapolation))
    }

    /// The cubic spline that repeats itself: the last `y` is the first one, and two derivatives are
    /// continuous there too. Outside its points it goes on by tangents, not by repetition. `None` as
    /// for [`PiecewiseCubic::akima`].
    #[must_use]
    pub fn periodic(x: &[f64], y: &[f64]) -> Option<Self> {
        /// Points that the curve is continued by on both sides. What its ends do fades by more
        /// than one half from point to point, so that nothing is left of it.
        const ROUND: usize = 60;
        if !is_drawable(x, y) {
            return None;
        }
        let (last, period) = (x.len() - 1, x[x.len() - 1] - x[0]);
        let count = x.len() + 2 * ROUND;
        let (mut xs, mut ys) = (Vec::with_capacity(count), Vec::with_capacity(count));
        for k in 0..count {
            let place = (k + ROUND * last - ROUND) % last;
            let turns = (k + ROUND * last - ROUND) / last;
            xs.push(x[place] + (turns as f64 - ROUND as f64) * period + period);
            ys.push(y[place]);
        }
        let slopes = cubic::slopes(&xs, &ys);
        let slopes = &slopes[ROUND..ROUND + x.len()];
        Some(Self::through(x, y, slopes, Extrapolation::Tangent))
    }

    /// The line from point to point. `None` as for [`PiecewiseCubic::akima`].
    #[must_use]
    pub fn polyline(x: &[f64], y: &[f64]) -> Option<Self> {
        if !is_drawable(x, y) {
            return None;
        }
        let last = x.len() - 1;
        let mut pieces = vec![[y[0], secant(x, y, 0), 0.0, 0.0]];
        pieces.extend((0..last).map(|k| [y[k], secant(x, y, k), 0.0, 0.0]));
        pieces.push([y[last], secant(x, y, last - 1), 0.0, 0.0]);
        Some(Self {
            knots: x.to_vec(),
            pieces,
        })
    }

    /// The curve through points with given slopes there.
    fn through(x: &[f64], y: &[f64], slopes: &[f64], extrapolation: Extrapolation) -> Self {
        let last = x.len() - 1;
        let (first_secant, last_secant) = (secant(x, y, 0), secant(x, y, last - 1));
        let (first_bend, last_bend) = match extrapolation {
            Extrapolation::Line | Extrapolation::Tangent => (0.0, 0.0),
            Extrapolation::Parabola => (
                (secant(x, y, 1) - first_secant) / (x[2] - x[0]),
                (last_secant - secant(x, y, last - 2)) / (x[last] - x[last - 2]),
            ),
        };
        let mut pieces = Vec::with_capacity(x.len() + 1);
        // The parabola's slope at its outer point, from that of the secant beside it.
        let tangent = extrapolation == Extrapolation::Tangent;
        let slope = if tangent {
            slopes[0]
        } else {
            first_secant - first_bend * (x[1] - x[0])
        };
        pieces.push([y[0], slope, first_bend, 0.0]);
        for k in 0..last {
            let h = x[k + 1] - x[k];
            let m = secant(x, y, k);
            let (left, right) = (slopes[k], slopes[k + 1]);
            pieces.push([
                y[k],
                left,
                (3.0 * m - 2.0 * left - right) / h,
                (left + right - 2.0 * m) / (h * h),
            ]);
        }
        let slope = if tangent {
            slopes[last]
        } else {
            last_secant + last_bend * (x[last] - x[last - 1])
        };
        pieces.push([y[last], slope, last_bend, 0.0]);
        Self {
            knots: x.to_vec(),
            pieces,
        }
    }

    /// The given `x` of the points.
    #[must_use]
    pub fn knots(&self) -> &[f64] {
        &self.knots
    }

    /// Value and first four derivatives at `x`; at a knot those of the piece behind it, at the last
    /// knot of the piece before it.
    #[must_use]
    pub fn derivatives(&self, x: f64) -> [f64; 5] {
        let behind = self.knots.partition_point(|knot| *knot <= x);
        let at_end = self.knots.last() == Some(&x);
        let piece = behind - usize::from(at_end);
        let [a, b, c, d] = self.pieces[piece];
        let s = x - self.knots[piece.saturating_sub(1)];
        [
            a + s * (b + s * (c + s * d)),
            b + s * (2.0 * c + s * 3.0 * d),
            2.0 * c + 6.0 * d * s,
            6.0 * d,
            0.0,
        ]
    }
}

fn is_drawable(x: &[f64], y: &[f64]) -> bool {
    x.len() >= 4 && x.len() == y.len() && x.is_sorted_by(|a, b| a < b)
}

/// Slope of the line from point `k` to the next one.
fn secant(x: &[f64], y: &[f64], k: usize) -> f64 {
    (y[k + 1] - y[k]) / (x[k + 1] - x[k])
}

#[cfg(test)]
mod tests {
    use super::*;

    const X: [f64; 7] = [-1.0, 0.0, 0.5, 2.0, 2.5, 4.0, 5.0];
    const Y: [f64; 7] = [2.0, -1.0, 0.0, 3.0, 3.0, 1.0, 1.5];

    fn both(extrapolation: Extrapolation) -> [PiecewiseCubic; 2] {
        [
            PiecewiseCubic::akima(&X, &Y, extrapolation),
            PiecewiseCubic::cubic_spline(&X, &Y, extrapolation),
        ]
        .map(Option::unwrap)
    }

    #[test]
    fn derivatives_match_differences_inside_every_piece() {
        for curve in both(Extrapolation::Parabola) {
            for x in [-2.0, -0.3, 0.2, 1.1, 2.2, 3.3, 4.4, 6.0] {
                let h = 1e-5;
                let [behind, here, ahead] = [x - h, x, x + h].map(|x| curve.derivatives(x));
                for k in 0..4 {
                    let slope = (ahead[k] - behind[k]) / (2.0 * h);
                    // Truncation h² times a third derivative of about ten, rounding 1e-16/h.
                    assert!((here[k + 1] - slope).abs() < 1e-8, "{x} {k}");
                }
            }
        }
    }

    #[test]
    fn curves_meet_their_points_and_are_as_smooth_as_said() {
        let beside = 1e-9;
        for (curve, smooth) in both(Extrapolation::Parabola).into_iter().zip([1, 2]) {
            for (k, (x, y)) in X.into_iter().zip(Y).enumerate() {
                assert!((curve.derivatives(x)[0] - y).abs() < 1e-14);
                if k == 0 || k == X.len() - 1 {
                    continue;
                }
                let (left, right) = (curve.derivatives(x - beside), curve.derivatives(x));
                for order in 0..=smooth {
                    // The distance of the two places times derivatives of up to fifty.
                    let jump = (left[order] - right[order]).abs();
                    assert!(jump < 1e-7, "derivative {order} at {x}: {jump}");
                }
            }
        }
    }

    #[test]
    fn a_cubic_is_its_own_spline_and_a_parabola_is_extrapolated() {
        let cubic = |x: f64| 1.0 - 2.0 * x + 0.5 * x * x + 0.3 * x * x * x;
        let curve = PiecewiseCubic::cubic_spline(&X, &X.map(cubic), Extrapolation::Line).unwrap();
        for x in [-0.9, 0.3, 1.7, 3.1, 4.9] {
            assert!((curve.derivatives(x)[0] - cubic(x)).abs() < 1e-13);
        }
        let parabola = |x: f64| 1.0 - 2.0 * x + 0.5 * x * x;
        // Akima's ends are parabolas (his section 2.3) and a line's are lines.
        let curve = PiecewiseCubic::akima(&X, &X.map(parabola), Extrapolation::Parabola).unwrap();
        for x in [-5.0, 9.0] {
            assert!((curve.derivatives(x)[0] - parabola(x)).abs() < 1e-13);
        }
        let [akima, spline] = both(Extrapolation::Line);
        for curve in [akima, spline] {
            assert!((curve.derivatives(-2.0)[0] - 5.0).abs() < 1e-14);
            assert!((curve.derivatives(7.0)[0] - 2.5).abs() < 1e-14);
            assert_eq!(curve.derivatives(7.0)[2], 0.0);
        }
    }

    #[test]
    fn a_periodic_spline_closes_smoothly() {
        // Unevenly spaced points of a sine; few points, so that the continuation goes round often.
        let x = [0.0, 0.9, 2.1, 3.0, 4.4, 5.2, std::f64::consts::TAU];
        let mut y = x.map(f64::sin);
        y[6] = 0.0;
        let curve = PiecewiseCubic::periodic(&x, &y).unwrap();
        let (start, end) = (curve.derivatives(0.0), curve.derivatives(x[6] - 1e-12));
        for order in 0..=2 {
            // The distance to the end times derivatives of order one, and rounding.
            assert!((start[order] - end[order]).abs() < 1e-11, "{order}");
        }
        for k in 0..60 {
            let x = 0.1 * f64::from(k);
            // The error of a cubic spline, 5/384 h⁴ with gaps h of up to 1.4.
            assert!((curve.derivatives(x)[0] - x.sin()).abs() < 0.05);
        }
        assert_eq!(curve.derivatives(-1.0)[0], y[0] - start[1]);
    }

    #[test]
    fn akima_is_local_and_has_no_overshoot_beside_a_jump() {
        // Table 1 of the paper: flat on the left, so it stays flat up to the jump's interval.
        let x: [f64; 11] = std::array::from_fn(|k| k as f64);
        let y = [
            10.0, 10.0, 10.0, 10.0, 10.0, 10.0, 10.5, 15.0, 50.0, 60.0, 85.0,
        ];
        let curve = PiecewiseCubic::akima(&x, &y, Extrapolation::Parabola).unwrap();
        for k in 0..=40 {
            assert_eq!(curve.derivatives(0.1 * f64::from(k))[0], 10.0);
        }
        // At x = 6 the secants are 0, 1/2, 9/2 and 35: the slope is (30.5·0.5 + 0.5·4.5)/31.
        let wanted = (30.5 * 0.5 + 0.5 * 4.5) / 31.0;
        assert!((curve.derivatives(6.0)[1] - wanted).abs() < 1e-14);
    }

    #[test]
    fn what_is_no_curve_is_not_drawn() {
        let drawn = |x: &[f64], y: &[f64]| {
            [
                PiecewiseCubic::akima(x, y, Extrapolation::Line),
                PiecewiseCubic::cubic_spline(x, y, Extrapolation::Line),
                PiecewiseCubic::periodic(x, y),
                PiecewiseCubic::polyline(x, y),
            ]
        };
        let y = [0.0; 4];
        assert!(drawn(&[0.0, 1.0, 2.0, 3.0], &y).iter().all(Option::is_some));
        for x in [
            [0.0, 2.0, 1.0, 3.0],
            [0.0, 1.0, 1.0, 2.0],
            [0.0, 1.0, 2.0, f64::NAN],
            [0.0, 1.0, f64::INFINITY, f64::INFINITY],
        ] {
            assert!(drawn(&x, &y).iter().all(Option::is_none), "{x:?}");
        }
        assert!(drawn(&[0.0, 1.0, 2.0], &y[..3]).iter().all(Option::is_none));
        assert!(
            drawn(&[0.0, 1.0, 2.0, 3.0], &y[..3])
                .iter()
                .all(Option::is_none)
        );
    }
}
