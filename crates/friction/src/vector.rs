//! The few operations on fixed-size vectors that the laws need, safe at zero and at any scale.

#[cfg(feature = "std")]
fn square_root(x: f64) -> f64 {
    x.sqrt()
}

#[cfg(not(feature = "std"))]
fn square_root(x: f64) -> f64 {
    libm::sqrt(x)
}

#[cfg(feature = "std")]
pub(crate) fn natural_exp(x: f64) -> f64 {
    x.exp()
}

#[cfg(not(feature = "std"))]
pub(crate) fn natural_exp(x: f64) -> f64 {
    libm::exp(x)
}

/// `x^exponent` for `x >= 0`.
pub(crate) fn power(x: f64, exponent: f64) -> f64 {
    if exponent == 2.0 {
        return x * x;
    }
    #[cfg(feature = "std")]
    return x.powf(exponent);
    #[cfg(not(feature = "std"))]
    return libm::pow(x, exponent);
}

/// Squares of lengths in this range are exact to rounding: what underflows in them is beneath it.
const ORDINARY: core::ops::Range<f64> = 1e-280..1e280;

/// Euclidean length at any scale.
pub(crate) fn length<const N: usize>(x: &[f64; N]) -> f64 {
    length_and_inverse(x).0
}

/// Length and unit vector; the unit vector of zero is zero, which is a subgradient of the length.
#[inline(always)]
pub(crate) fn length_and_direction<const N: usize>(x: &[f64; N]) -> (f64, [f64; N]) {
    let (length, inverse) = length_and_inverse(x);
    let unit = if N == 1 {
        // Exactly plus or minus one.
        x.map(|c| if c == 0.0 { 0.0 } else { c.signum() })
    } else if let Some(inverse) = inverse {
        x.map(|c| c * inverse)
    } else if length == 0.0 {
        [0.0; N]
    } else {
        x.map(|c| c / length)
    };
    (length, unit)
}

/// Length, and its inverse where the length is an ordinary number. Others are scaled by the largest
/// component, so that squares neither overflow nor vanish.
#[inline(always)]
fn length_and_inverse<const N: usize>(x: &[f64; N]) -> (f64, Option<f64>) {
    if N == 1 {
        return (x[0].abs(), None);
    }
    let square: f64 = x.iter().map(|c| c * c).sum();
    if ORDINARY.contains(&square) {
        let length = square_root(square);
        return (length, Some(1.0 / length));
    }
    let largest = x.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
    if largest == 0.0 {
        // Zero, or what is not a number.
        return (square, None);
    }
    let scaled = x.iter().map(|c| (c / largest) * (c / largest)).sum();
    (largest * square_root(scaled), None)
}

/// Matrix from its entries by row and column.
#[inline(always)]
pub(crate) fn matrix<const N: usize>(entry: impl Fn(usize, usize) -> f64) -> [[f64; N]; N] {
    let mut matrix = [[0.0; N]; N];
    for (i, row) in matrix.iter_mut().enumerate() {
        for (j, value) in row.iter_mut().enumerate() {
            *value = entry(i, j);
        }
    }
    matrix
}

/// Kronecker delta.
pub(crate) fn delta(i: usize, j: usize) -> f64 {
    if i == j { 1.0 } else { 0.0 }
}
