//! Text forms of numbers in result files.

use std::fmt::Write;

/// Appends the shortest decimal form that reads back as the same number: `0`, `0.1`, `-2.5E-14`.
pub(crate) fn push_shortest(text: &mut String, value: f64) {
    let start = text.len();
    // Writing to a string cannot fail.
    let _ = write!(text, "{value:?}");
    if text.ends_with(".0") {
        text.truncate(text.len() - 2);
    } else if let Some(place) = text[start..].find('e') {
        text.replace_range(start + place..start + place + 1, "E");
    }
}

/// FORTRAN's `E` form: `digits` decimals, a sign and at least two digits of exponent.
pub(crate) fn scientific(value: f64, digits: usize) -> String {
    let text = format!("{value:.digits$E}");
    match text.split_once('E') {
        Some((mantissa, exponent)) => {
            let (sign, size) = match exponent.strip_prefix('-') {
                Some(size) => ('-', size),
                None => ('+', exponent),
            };
            format!("{mantissa}E{sign}{size:0>2}")
        }
        None => text,
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn shortest(value: f64) -> String {
        let mut text = String::from("x ");
        push_shortest(&mut text, value);
        text.split_off(2)
    }

    #[test]
    fn forms() {
        assert_eq!(shortest(0.0), "0");
        assert_eq!(shortest(-386.0), "-386");
        assert_eq!(shortest(0.07), "0.07");
        assert_eq!(shortest(-2.5e-14), "-2.5E-14");
        assert_eq!(shortest(1e300), "1E300");
        assert_eq!(scientific(0.0, 5), "0.00000E+00");
        assert_eq!(scientific(-0.0123456, 5), "-1.23456E-02");
        assert_eq!(scientific(1.0 / 0.0254, 15), "3.937007874015748E+01");
        assert_eq!(scientific(1e-120, 5), "1.00000E-120");
    }

    #[test]
    fn reads_back_bit_for_bit() {
        for value in [
            0.1,
            -0.0,
            f64::MAX,
            f64::MIN_POSITIVE,
            5e-324,
            1e16,
            123456789.123456789,
        ] {
            assert_eq!(
                shortest(value).parse::<f64>().unwrap().to_bits(),
                value.to_bits()
            );
        }
    }
}
