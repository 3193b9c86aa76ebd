//! The functions that operations apply, with their derivatives.

use crate::scalar::Scalar;

/// Functions of one number.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Unary {
    /// `−x`
    Negate,
    /// `|x|`, slope zero at zero
    Abs,
    /// inverse cosine
    Acos,
    /// towards zero
    Truncate,
    /// to the nearest integer, halves away from zero
    Round,
    /// inverse sine
    Asin,
    /// inverse tangent
    Atan,
    /// cosine
    Cos,
    /// hyperbolic cosine
    Cosh,
    /// exponential
    Exp,
    /// natural logarithm
    Log,
    /// decimal logarithm
    Log10,
    /// sine
    Sin,
    /// hyperbolic sine
    Sinh,
    /// square root
    Sqrt,
    /// tangent
    Tan,
    /// hyperbolic tangent
    Tanh,
    /// `s²(3 − 2s)` for s in 0..1, constant outside: the STEP function
    CubicStep,
    /// `s³(10 − 15s + 6s²)` for s in 0..1, constant outside: STEP5
    QuinticStep,
    /// `(1 − cos πs)/2` for s in 0..1, constant outside: HAVSIN
    Haversine,
}

/// Functions of two numbers.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Binary {
    /// `x + y`
    Add,
    /// `x − y`
    Subtract,
    /// `x y`
    Multiply,
    /// `x / y`
    Divide,
    /// `x ** y`
    Power,
    /// angle of the point (y, x)
    Atan2,
    /// remainder of `x / y` with the sign of x
    Modulo,
    /// `|x|` with the sign of y
    Sign,
    /// the larger
    Max,
    /// the smaller
    Min,
}

/// Value, slope and curvature.
pub(super) fn unary(function: Unary, x: f64) -> (f64, f64, f64) {
    let inside = (0.0..=1.0).contains(&x);
    match function {
        Unary::Negate => (-x, -1.0, 0.0),
        Unary::Abs => (x.abs(), if x == 0.0 { 0.0 } else { x.signum() }, 0.0),
        Unary::Acos => {
            let r = (1.0 - x * x).sqrt();
            (x.acos(), -1.0 / r, -x / (r * r * r))
        }
        Unary::Truncate => (x.trunc(), 0.0, 0.0),
        Unary::Round => (x.round(), 0.0, 0.0),
        Unary::Asin => {
            let r = (1.0 - x * x).sqrt();
            (x.asin(), 1.0 / r, x / (r * r * r))
        }
        Unary::Atan => {
            let r = 1.0 / (1.0 + x * x);
            (x.atan(), r, -2.0 * x * r * r)
        }
        Unary::Cos => (x.cos(), -x.sin(), -x.cos()),
        Unary::Cosh => (x.cosh(), x.sinh(), x.cosh()),
        Unary::Exp => (x.exp(), x.exp(), x.exp()),
        Unary::Log => (x.ln(), 1.0 / x, -1.0 / (x * x)),
        Unary::Log10 => {
            let r = std::f64::consts::LOG10_E;
            (x.log10(), r / x, -r / (x * x))
        }
        Unary::Sin => (x.sin(), x.cos(), -x.sin()),
        Unary::Sinh => (x.sinh(), x.cosh(), x.sinh()),
        Unary::Sqrt => {
            let r = x.sqrt();
            // An infinite slope helps no iteration, and `√(x² + y²)` has none at its kink.
            if r == 0.0 {
                return (0.0, 0.0, 0.0);
            }
            (r, 0.5 / r, -0.25 / (r * r * r))
        }
        Unary::Tan => {
            let t = x.tan();
            (t, 1.0 + t * t, 2.0 * t * (1.0 + t * t))
        }
        Unary::Tanh => {
            let t = x.tanh();
            (t, 1.0 - t * t, -2.0 * t * (1.0 - t * t))
        }
        Unary::CubicStep if inside => {
            (x * x * (3.0 - 2.0 * x), 6.0 * x * (1.0 - x), 6.0 - 12.0 * x)
        }
        Unary::QuinticStep if inside => {
            let r = x * (1.0 - x);
            (
                x * x * x * (10.0 + x * (6.0 * x - 15.0)),
                30.0 * r * r,
                60.0 * r * (1.0 - 2.0 * x),
            )
        }
        Unary::Haversine if inside => {
            let pi = std::f64::consts::PI;
            let (sine, cosine) = (pi * x).sin_cos();
            (0.5 - 0.5 * cosine, 0.5 * pi * sine, 0.5 * pi * pi * cosine)
        }
        Unary::CubicStep | Unary::QuinticStep | Unary::Haversine => {
            // Below 0, above 1, or not a number, which must stay visible.
            (if x.is_nan() { x } else { x.clamp(0.0, 1.0) }, 0.0, 0.0)
        }
    }
}

/// True where a power is that of a whole exponent, so that a negative base is fine.
fn whole(exponent: f64) -> bool {
    exponent == exponent.trunc() && exponent.abs() < 1e9
}

fn power(x: f64, y: f64) -> f64 {
    if whole(y) {
        x.powi(y as i32)
    } else {
        x.powf(y)
    }
}

/// `∂(x^y)/∂x`, where a zero factor wins over an infinite one. At zero a root has no finite slope,
/// which would help no iteration: it counts as none, as that of SQRT does.
fn power_slope(x: f64, y: f64) -> f64 {
    if y == 0.0 || (x == 0.0 && 0.0 < y && y < 1.0) {
        0.0
    } else {
        y * power(x, y - 1.0)
    }
}

pub(super) fn binary<T: Scalar>(function: Binary, a: T, b: T) -> T {
    let (x, y) = (a.value(), b.value());
    match function {
        Binary::Add => a + b,
        Binary::Subtract => a - b,
        Binary::Multiply => a * b,
        Binary::Divide => a / b,
        Binary::Power => {
            let value = power(x, y);
            // x^y with y fixed, plus (for a base above zero) x fixed with y moving. The product of
            // both rates, exact only with one of them constant, is taken by exp(y ln x) instead.
            if whole(y) {
                a.chain(value, power_slope(x, y), y * power_slope(x, y - 1.0))
            } else {
                let logarithm = a.chain(x.ln(), 1.0 / x, -1.0 / (x * x));
                (b * logarithm).chain(value, value, value)
            }
        }
        Binary::Atan2 => a.atan2(b),
        Binary::Modulo => a - b * T::constant((x / y).trunc()),
        Binary::Sign => {
            let keep = (x < 0.0) == (y < 0.0);
            if keep { a } else { -a }
        }
        Binary::Max => {
            // The comparison is written so that a number that is none is passed on.
            if x >= y || x.is_nan() { a } else { b }
        }
        Binary::Min => {
            if x <= y || x.is_nan() {
                a
            } else {
                b
            }
        }
    }
}

pub(super) fn binary_slopes(function: Binary, x: f64, y: f64, value: f64) -> (f64, f64) {
    match function {
        Binary::Add => (1.0, 1.0),
        Binary::Subtract => (1.0, -1.0),
        Binary::Multiply => (y, x),
        Binary::Divide => (1.0 / y, -value / y),
        Binary::Power => {
            let by_exponent = if x > 0.0 { value * x.ln() } else { 0.0 };
            (power_slope(x, y), by_exponent)
        }
        Binary::Atan2 => {
            let r2 = x * x + y * y;
            if r2 == 0.0 {
                (0.0, 0.0)
            } else {
                (y / r2, -x / r2)
            }
        }
        Binary::Modulo => (1.0, -(x / y).trunc()),
        Binary::Sign => (if (x < 0.0) == (y < 0.0) { 1.0 } else { -1.0 }, 0.0),
        Binary::Max => {
            if x >= y || x.is_nan() {
                (1.0, 0.0)
            } else {
                (0.0, 1.0)
            }
        }
        Binary::Min => {
            if x <= y || x.is_nan() {
                (1.0, 0.0)
            } else {
                (0.0, 1.0)
            }
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::expression::{Input, Operation, Program};
    use crate::scalar::Jet;

    const UNARIES: [(Unary, f64); 20] = [
        (Unary::Negate, 0.3),
        (Unary::Abs, -0.7),
        (Unary::Acos, 0.4),
        (Unary::Truncate, 1.6),
        (Unary::Round, 1.6),
        (Unary::Asin, 0.4),
        (Unary::Atan, 1.4),
        (Unary::Cos, 0.9),
        (Unary::Cosh, 0.9),
        (Unary::Exp, -0.4),
        (Unary::Log, 2.4),
        (Unary::Log10, 2.4),
        (Unary::Sin, 0.9),
        (Unary::Sinh, 0.9),
        (Unary::Sqrt, 2.5),
        (Unary::Tan, 0.6),
        (Unary::Tanh, 0.6),
        (Unary::CubicStep, 0.3),
        (Unary::QuinticStep, 0.7),
        (Unary::Haversine, 0.2),
    ];

    #[test]
    fn slopes_and_curvatures_match_differences() {
        for (function, x) in UNARIES {
            let h = 1e-5;
            let (_, slope, curvature) = unary(function, x);
            let ahead = unary(function, x + h);
            let behind = unary(function, x - h);
            // Truncation h² = 1e-10 times the next derivatives, at most about 20 here.
            assert!(
                (slope - (ahead.0 - behind.0) / (2.0 * h)).abs() < 1e-8,
                "{function:?}"
            );
            assert!(
                (curvature - (ahead.1 - behind.1) / (2.0 * h)).abs() < 1e-7,
                "{function:?}"
            );
        }
    }

    #[test]
    fn gradients_and_jets_of_every_binary_match_differences() {
        use Binary::*;
        for function in [
            Add, Subtract, Multiply, Divide, Power, Atan2, Modulo, Sign, Max, Min,
        ] {
            for (x, y) in [(1.3, 0.7), (0.4, -1.7), (2.5, 3.0)] {
                let mut program = Program::default();
                let a = program.push(Operation::Input(Input::Measure(0)));
                let b = program.push(Operation::Input(Input::Measure(1)));
                program.push(Operation::Binary(function, a, b));
                let value = |x: f64, y: f64| {
                    program.evaluate(&mut [0.0; 3], |input| {
                        if input == Input::Measure(0) { x } else { y }
                    })
                };
                let h = 1e-6;
                let by_x = (value(x + h, y) - value(x - h, y)) / (2.0 * h);
                let by_y = (value(x, y + h) - value(x, y - h)) / (2.0 * h);
                let mut registers = [0.0; 3];
                program.evaluate(&mut registers, |input| {
                    if input == Input::Measure(0) { x } else { y }
                });
                let mut slopes = [0.0; 2];
                program.gradient(&registers, &mut [0.0; 3], |input, slope| {
                    slopes[usize::from(input == Input::Measure(1))] += slope;
                });
                assert!(
                    (slopes[0] - by_x).abs() < 1e-7,
                    "{function:?} {slopes:?} {by_x}"
                );
                assert!(
                    (slopes[1] - by_y).abs() < 1e-7,
                    "{function:?} {slopes:?} {by_y}"
                );

                // Along x = x0 + 2t − t², y = y0 + t for a constant exponent, with t² otherwise.
                let along = |t: f64| {
                    let bend = if function == Power { 0.0 } else { 1.0 };
                    (
                        Jet {
                            value: x + 2.0 * t - t * t,
                            rate: 2.0 - 2.0 * t,
                            acceleration: -2.0,
                        },
                        Jet {
                            value: y + bend * (t + t * t),
                            rate: bend * (1.0 + 2.0 * t),
                            acceleration: 2.0 * bend,
                        },
                    )
                };
                let jet = |t: f64| {
                    let (a, b) = along(t);
                    binary(function, a, b)
                };
                let h = 1e-4;
                let rate = (jet(h).value - jet(-h).value) / (2.0 * h);
                let acceleration = (jet(h).rate - jet(-h).rate) / (2.0 * h);
                // Truncation h²/6 times third derivatives of up to 1e4.
                assert!(
                    (jet(0.0).rate - rate).abs() < 1e-6 * (1.0 + rate.abs()),
                    "{function:?}"
                );
                let error = (jet(0.0).acceleration - acceleration).abs();
                assert!(error < 1e-5 * (1.0 + acceleration.abs()), "{function:?}");
            }
        }
    }
}
