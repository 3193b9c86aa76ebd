//! The quintic step of the friction law.
//!
//! # Law
//! ```text
//! STEP5(x, x0, h0, x1, h1) = h0                                       x <= x0
//!                          = h0 + (h1 - h0) s^3 (10 - 15 s + 6 s^2)   s = (x - x0)/(x1 - x0)
//!                          = h1                                       x >= x1
//! psi(s) = STEP5(s, -1, -1, 1, 1) = (15 s - 10 s^3 + 3 s^5)/8         |s| <= 1
//! ```
//! Both are twice continuously differentiable. `psi` is odd; `psi'(0) = 15/8`.
//!
//! # Source
//! The help of the `FRICTION` statement names "a STEP function". Real results of Adams Solver C++
//! 2015.1 follow the quintic to 2e-15 and differ from the cubic by up to 5 % of the local value.

/// Value of a step and its derivative.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Step {
    /// Value, in the unit of `h0` and `h1`.
    pub value: f64,
    /// Derivative with respect to `x`.
    pub slope: f64,
}

/// Quintic step from `h0` at `x0` to `h1` at `x1`, constant outside, for `x0 < x1`.
///
/// `x`, `x0`, `x1` share one unit and `h0`, `h1` another.
///
/// ```
/// use friction::step::step5;
/// let middle = step5(0.125, 0.1, 0.3, 0.15, 0.2);
/// assert!((middle.value - 0.25).abs() < 1e-15);
/// assert_eq!(step5(0.2, 0.1, 0.3, 0.15, 0.2).value, 0.2);
/// ```
#[inline]
pub fn step5(x: f64, x0: f64, h0: f64, x1: f64, h1: f64) -> Step {
    if x <= x0 {
        return Step {
            value: h0,
            slope: 0.0,
        };
    }
    if x >= x1 {
        return Step {
            value: h1,
            slope: 0.0,
        };
    }
    let (width, height) = (x1 - x0, h1 - h0);
    let s = (x - x0) / width;
    let rest = 1.0 - s;
    Step {
        value: h0 + height * s * s * s * (10.0 - s * (15.0 - 6.0 * s)),
        slope: height / width * 30.0 * s * s * rest * rest,
    }
}

/// The odd quintic step `psi` for `s >= 0`, in the forms the law needs without cancellation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct OddStep {
    /// `psi(s)`, from 0 at `s = 0` to 1 for `s >= 1`.
    pub value: f64,
    /// `psi(s)/s`, 15/8 at `s = 0`.
    pub ratio: f64,
    /// `psi'(s) = 15/8 (1 - s^2)^2`, zero for `s >= 1`.
    pub slope: f64,
    /// `1 - psi(s)`, exact to rounding also near `s = 1`, never negative.
    pub complement: f64,
}

/// `psi(s) = STEP5(s, -1, -1, 1, 1)` for `s >= 0` (dimensionless).
///
/// ```
/// use friction::step::odd_step;
/// assert_eq!(odd_step(0.0).ratio, 1.875);
/// assert_eq!(odd_step(0.5).value, 0.79296875);
/// assert_eq!(odd_step(7.0).value, 1.0);
/// ```
#[inline]
pub fn odd_step(s: f64) -> OddStep {
    if s >= 1.0 {
        return OddStep {
            value: 1.0,
            ratio: 1.0 / s,
            slope: 0.0,
            complement: 0.0,
        };
    }
    let square = s * s;
    let ratio = (15.0 - square * (10.0 - 3.0 * square)) / 8.0;
    let rest = 1.0 - s;
    OddStep {
        value: (s * ratio).min(1.0),
        ratio,
        slope: 1.875 * (1.0 - square) * (1.0 - square),
        complement: rest * rest * rest * (8.0 + s * (9.0 + 3.0 * s)) / 8.0,
    }
}
