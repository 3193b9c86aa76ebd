//! Text forms of numbers in result files.

/// Appends the shortest decimal form that reads back as the same number: `0`, `0.1`, `-2.5E-14`.
pub(crate) fn push_shortest(text: &mut String, value: f64) {
    let mut buffer = zmij::Buffer::new();
    let written = buffer.format(value);
    let (sign, digits) = written.split_at(usize::from(written.starts_with('-')));
    text.push_str(sign);
    if let Some((mantissa, exponent)) = digits.split_once('e') {
        text.push_str(mantissa);
        text.push('E');
        text.push_str(exponent.strip_prefix('+').unwrap_or(exponent));
    } else if let Some(small) = digits.strip_prefix("0.0000") {
        // Below 1e-4 with an exponent, as everywhere else in Rust.
        let (first, others) = small.split_at(1);
        text.push_str(first);
        if !others.is_empty() {
            text.push('.');
            text.push_str(others);
        }
        text.push_str("E-5");
    } else {
        text.push_str(digits.strip_suffix(".0").unwrap_or(digits));
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

    /// The form is that of the standard library with a capital E. Of two shortest numbers that are as near
    /// either may be taken, so the digits are compared by what they read back as, and by their count.
    #[test]
    fn form_is_that_of_the_standard_library() {
        let mut bits = 0x9e37_79b9_7f4a_7c15_u64;
        for exponent in (-20..20).cycle().take(100_000) {
            // Marsaglia's xorshift: any bits, and numbers of ordinary size.
            bits ^= bits << 13;
            bits ^= bits >> 7;
            bits ^= bits << 17;
            let ordinary = (bits >> 40) as f64 * 10_f64.powi(exponent);
            for value in [f64::from_bits(bits), ordinary, -ordinary] {
                let standard = format!("{value:?}").replace('e', "E");
                let standard = standard.strip_suffix(".0").unwrap_or(&standard);
                let own = shortest(value);
                assert_eq!(own.len(), standard.len(), "{own} {standard}");
                let signs = |text: &str| text.replace(|c: char| c.is_ascii_digit(), "0");
                assert_eq!(signs(&own), signs(standard));
                if value.is_finite() {
                    assert_eq!(own.parse::<f64>().unwrap().to_bits(), value.to_bits());
                }
            }
        }
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
