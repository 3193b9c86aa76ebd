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

/// Euclidean length, scaled by the largest component so that squares neither overflow nor vanish.
pub(crate) fn length<const N: usize>(x: &[f64; N]) -> f64 {
    let largest = x.iter().fold(0.0, |m: f64, c| m.max(c.abs()));
    if largest == 0.0 {
        return 0.0;
    }
    largest * square_root(x.iter().map(|c| (c / largest) * (c / largest)).sum())
}

/// Length and unit vector; the unit vector of zero is zero, which is a subgradient of the length.
pub(crate) fn length_and_direction<const N: usize>(x: &[f64; N]) -> (f64, [f64; N]) {
    let length = length(x);
    if length == 0.0 {
        (0.0, [0.0; N])
    } else {
        (length, x.map(|c| c / length))
    }
}

/// Matrix from its entries by row and column.
pub(crate) fn matrix<const N: usize>(entry: impl Fn(usize, usize) -> f64) -> [[f64; N]; N] {
    core::array::from_fn(|i| core::array::from_fn(|j| entry(i, j)))
}

/// Kronecker delta.
pub(crate) fn delta(i: usize, j: usize) -> f64 {
    if i == j { 1.0 } else { 0.0 }
}
