//! Slopes of Akima's interpolation.

use super::secant;

/// Slope at every point: the secants beside it, weighed by how much the secants on the other side
/// change (Akima 1970, equation 1); two secants at each end are those of the parabola that goes on
/// there (his section 2.3).
pub(super) fn slopes(x: &[f64], y: &[f64]) -> Vec<f64> {
    let count = x.len();
    let mut secants = Vec::with_capacity(count + 3);
    secants.extend([0.0; 2]);
    secants.extend((0..count - 1).map(|k| secant(x, y, k)));
    secants[1] = 2.0 * secants[2] - secants[3];
    secants[0] = 2.0 * secants[1] - secants[2];
    for _ in 0..2 {
        let last = secants.len() - 1;
        secants.push(2.0 * secants[last] - secants[last - 1]);
    }
    secants
        .windows(4)
        .map(|beside| {
            let left = (beside[1] - beside[0]).abs();
            let right = (beside[3] - beside[2]).abs();
            if left + right > 0.0 {
                (right * beside[1] + left * beside[2]) / (left + right)
            } else {
                0.5 * (beside[1] + beside[2])
            }
        })
        .collect()
}
