//! Numbers as the manual prints them: with so few digits that a run elsewhere prints the same.

/// A value with five significant digits; what is of the size of rounding is zero.
///
/// ```
/// use verification::number::value;
/// assert_eq!(value(-4e-17), "0");
/// assert_eq!(value(-2.163_122_8), "-2.1631");
/// assert_eq!(value(3.384_218_7e-3), "3.3842e-3");
/// ```
#[must_use]
pub fn value(x: f64) -> String {
    let size = x.abs();
    if size < 1e-15 {
        "0".into()
    } else if (1e-2..1e5).contains(&size) {
        let before = size.log10().floor() as i32;
        format!("{x:.*}", (4 - before).max(0) as usize)
    } else {
        format!("{x:.4e}")
    }
}

/// An error with two significant digits, and without any where it is of the size of rounding.
///
/// ```
/// use verification::number::error;
/// assert_eq!(error(4.239e-7), "4.2e-7");
/// assert_eq!(error(3e-17), "< 1e-15");
/// ```
#[must_use]
pub fn error(x: f64) -> String {
    if x == 0.0 {
        "0".into()
    } else if x < 1e-15 {
        "< 1e-15".into()
    } else {
        format!("{x:.1e}")
    }
}

/// Several, separated by commas.
#[must_use]
pub fn list(values: &[f64], digits: fn(f64) -> String) -> String {
    let texts: Vec<String> = values.iter().map(|x| digits(*x)).collect();
    texts.join(", ")
}

/// An observed order with two decimals.
#[must_use]
pub fn order(x: f64) -> String {
    format!("{x:.2}")
}
