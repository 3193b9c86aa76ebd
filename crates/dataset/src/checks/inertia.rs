//! Whether a tensor of inertia is one that a body can have.
//!
//! Moments and products of inertia are integrals over the mass; `S = integral of r r^T dm` has
//! `S_xx = (yy + zz - xx) / 2`, ..., `S_xy = xy`, ... and no negative eigenvalue. That is the
//! triangle inequality of the principal moments and more: they cannot be negative either.

use crate::diagnostic::Code;
use crate::reading::Reading;

/// The digits of the file may break the inequality by this fraction of the largest moment, at
/// most: three digits, as in a thin plate with IP = 0.333, 0.333, 0.667.
const MOST_ROUNDING: f64 = 2e-3;

/// Reports IP = xx, yy, zz, xy, xz, yz where no body has it: an error where its tensor would give
/// negative energies, else a warning, as models lump the inertia of a rotor about its axis alone.
pub(crate) fn check(reading: &mut Reading, inertia: &[f64; 6]) {
    let largest = inertia.iter().fold(0.0, |a: f64, b| a.max(b.abs()));
    if largest == 0.0 {
        return;
    }
    // Relative to the largest, so that no square overflows.
    let [xx, yy, zz, xy, xz, yz] = inertia.map(|element| element / largest);
    let source = reading.diagnostics.source;
    let rounding: f64 = reading
        .reals("IP")
        .iter()
        .map(|(_, span)| last_digit(source.slice(*span)))
        .sum();
    let tolerance = (rounding / largest).min(MOST_ROUNDING) + 1e-12;
    let second_moments = [
        (yy + zz - xx) / 2.0,
        (zz + xx - yy) / 2.0,
        (xx + yy - zz) / 2.0,
    ];
    let smallest = smallest_eigenvalue(second_moments, [xy, xz, yz]);
    let negative = [xx, yy, zz].into_iter().any(|moment| moment < 0.0);
    let tensor = smallest_eigenvalue([xx, yy, zz], [-xy, -xz, -yz]);
    let usable = tensor >= -tolerance && !negative;
    if smallest >= -tolerance && !negative {
        return;
    }
    let span = reading
        .argument("IP")
        .map_or(reading.head, |argument| argument.value_span);
    let reason = if negative {
        "a moment of inertia cannot be negative".to_string()
    } else if let Some(axis) = (0..3).find(|axis| second_moments[*axis] < -tolerance) {
        let names = ["xx", "yy", "zz"];
        let (a, b) = ((axis + 1) % 3, (axis + 2) % 3);
        format!(
            "{} = {} is greater than {} + {} = {}",
            names[axis],
            inertia[axis],
            names[a],
            names[b],
            inertia[a] + inertia[b]
        )
    } else {
        "the products are too large for the moments".to_string()
    };
    let message = format!("no body has the inertia of {}: {reason}", reading.label());
    let diagnostics = &mut reading.diagnostics;
    let diagnostic = if usable {
        diagnostics
            .warning(Code::ImpossibleInertia, span, message)
            .note("it is used as it is given")
    } else {
        diagnostics.error(Code::ImpossibleInertia, span, message)
    };
    diagnostic.help("check the order xx, yy, zz, xy, xz, yz and the units");
}

/// One unit in the last digit of a number with a decimal point, 0 for other numbers.
fn last_digit(text: &str) -> f64 {
    let (mantissa, exponent) = match text.find(['e', 'E']) {
        Some(at) => (&text[..at], text[at + 1..].parse().unwrap_or(0)),
        None => (text, 0),
    };
    match mantissa.find('.') {
        Some(at) => {
            let decimals = i32::try_from(mantissa.len() - at - 1).unwrap_or(i32::MAX);
            10.0_f64.powi(i32::saturating_sub(exponent, decimals))
        }
        None => 0.0,
    }
}

/// The smallest eigenvalue of the symmetric matrix with this diagonal and these elements
/// xy, xz, yz, by the trigonometric solution of its characteristic polynomial.
fn smallest_eigenvalue(diagonal: [f64; 3], [xy, xz, yz]: [f64; 3]) -> f64 {
    let off = xy * xy + xz * xz + yz * yz;
    let mean = diagonal.iter().sum::<f64>() / 3.0;
    let [a, b, c] = diagonal.map(|element| element - mean);
    let spread = ((a * a + b * b + c * c + 2.0 * off) / 6.0).sqrt();
    if spread == 0.0 {
        return mean;
    }
    let [a, b, c, xy, xz, yz] = [a, b, c, xy, xz, yz].map(|element| element / spread);
    let determinant = a * (b * c - yz * yz) - xy * (xy * c - yz * xz) + xz * (xy * yz - b * xz);
    let angle = (determinant / 2.0).clamp(-1.0, 1.0).acos() / 3.0;
    mean + 2.0 * spread * (angle + 2.0 * std::f64::consts::PI / 3.0).cos()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_smallest_eigenvalue_is_that_of_known_matrices() {
        // Closed form in doubles: the error is a few units of the last place of the largest.
        assert!((smallest_eigenvalue([3.0, 1.0, 2.0], [0.0; 3]) - 1.0).abs() < 1e-14);
        // [[2,1,0],[1,2,0],[0,0,5]] has 1, 3 and 5.
        assert!((smallest_eigenvalue([2.0, 2.0, 5.0], [1.0, 0.0, 0.0]) - 1.0).abs() < 1e-14);
        // All ones: 0, 0 and 3; a double root loses half of the digits at worst.
        assert!(smallest_eigenvalue([1.0; 3], [1.0; 3]).abs() < 1e-7);
    }

    #[test]
    fn the_last_digit_follows_point_and_exponent() {
        assert_eq!(last_digit("12"), 0.0);
        assert_eq!(last_digit("0.25"), 0.01);
        assert_eq!(last_digit("2.5E-003"), 1e-4);
    }
}
