//! Numbers as they are written: every text of a number gives the same bits again.

use std::fmt;

/// A number, perhaps in degrees.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Number {
    /// The number that is written, without `D`.
    pub(crate) written: f64,
    /// Whether `D` follows it: then the value is an angle, `written` in degrees.
    pub(crate) degrees: bool,
}

impl Number {
    /// The number in a text that the reader of numbers has accepted: sign, digits, `D`, and between
    /// sign and digits blanks, comments and marks that continue a line.
    pub(crate) fn of_text(text: &str) -> Option<Self> {
        let (negative, unsigned) = match text.strip_prefix('-') {
            Some(rest) => (true, rest),
            None => (false, text.strip_prefix('+').unwrap_or(text)),
        };
        let last_line = unsigned.lines().next_back()?;
        let before = |mark: char| !mark.is_ascii_digit() && mark != '.';
        let digits = last_line.trim_start_matches(before).trim_ascii_end();
        let plain = digits.strip_suffix(['d', 'D']);
        let written: f64 = plain.unwrap_or(digits).parse().ok()?;
        Some(Self {
            written: if negative { -written } else { written },
            degrees: plain.is_some(),
        })
    }
}

impl PartialEq for Number {
    /// The same bits: 0 and -0 differ.
    fn eq(&self, other: &Self) -> bool {
        self.degrees == other.degrees && self.written.to_bits() == other.written.to_bits()
    }
}

impl fmt::Display for Number {
    /// The shortest digits that give the same bits back.
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        let size = self.written.abs();
        // Like the engineers' own style: an exponent where there would be many zeros.
        if size == 0.0 || (1e-4..1e15).contains(&size) {
            write!(f, "{}", self.written)?;
        } else {
            write!(f, "{:E}", self.written)?;
        }
        f.write_str(if self.degrees { "D" } else { "" })
    }
}
