//! Angles and Euler parameters from the cosines `c(a, b)` between axis a of marker i and axis b of
//! marker j: the entry in row b and column a of the rotation matrix of i in j.

use crate::rotation;
use crate::scalar::Scalar;

/// The axes about which a frame turns one after the other, each fixed to the turned frame.
pub type Sequence = [usize; 3];

/// Angle `n` of a body-fixed sequence of turns; principal values. Sequences of three different
/// axes have their middle angle within a quarter turn, the others theirs within 0 and half a turn.
///
/// ```text
/// R = R_a(θ₁) R_b(θ₂) R_c(θ₃);   ε = 1 where (a, b, third axis) follow one another, else −1
/// ```
pub(super) fn body_fixed<T: Scalar>(
    sequence: Sequence,
    n: usize,
    c: &impl Fn(usize, usize) -> T,
) -> T {
    let [a, b, last] = sequence;
    let third = 3 - a - b;
    let even = (a + 1) % 3 == b;
    let signed = |x: T| if even { x } else { -x };
    // Entry of the rotation matrix.
    let r = |row: usize, column: usize| c(column, row);
    if last == a {
        let parallel = r(a, b).value().hypot(r(a, third).value()) < rotation::PARALLEL;
        return match n {
            // Only the sum (or difference) of the outer angles is determined; the last is zero.
            0 if parallel => signed(r(third, b)).atan2(r(b, b)),
            2 if parallel => T::constant(0.0),
            0 => r(b, a).atan2(signed(-r(third, a))),
            1 => {
                let sine = (r(a, b) * r(a, b) + r(a, third) * r(a, third)).sqrt();
                sine.atan2(r(a, a))
            }
            _ => r(a, b).atan2(signed(r(a, third))),
        };
    }
    match n {
        0 => signed(-r(b, third)).atan2(r(third, third)),
        1 => asin_safe(signed(r(a, third))),
        _ => signed(-r(a, b)).atan2(r(a, a)),
    }
}

fn asin_safe<T: Scalar>(sine: T) -> T {
    let cosine = (T::constant(1.0) - sine * sine).sqrt();
    sine.atan2(cosine)
}

/// Euler parameter `n` of the rotation with cosines `c(a, b)` between axis a of i and b of j; the
/// first parameter is not negative.
pub(super) fn euler_parameter<T: Scalar>(n: usize, c: &impl Fn(usize, usize) -> T) -> T {
    // Four times the product of parameters p and q, from the matrix R with R[b][a] = c(a, b).
    let one = T::constant(1.0);
    let product = |p: usize, q: usize| {
        let (p, q) = (p.min(q), p.max(q));
        match (p, q) {
            (0, 0) => one + c(0, 0) + c(1, 1) + c(2, 2),
            (0, q) => {
                let (a, b) = (q % 3, (q + 1) % 3);
                c(a, b) - c(b, a)
            }
            (p, q) if p == q => {
                let (a, b) = (p % 3, (p + 1) % 3);
                one + c(p - 1, p - 1) - c(a, a) - c(b, b)
            }
            (p, q) => c(p - 1, q - 1) + c(q - 1, p - 1),
        }
    };
    // Divide by the largest parameter (Shepperd 1978).
    let largest = (0..4).fold(0, |b, p| {
        if product(p, p).value() > product(b, b).value() {
            p
        } else {
            b
        }
    });
    let half = T::constant(0.5);
    let parameter = half * product(n, largest) / product(largest, largest).sqrt();
    if largest != 0 && product(0, largest).value() < 0.0 {
        -parameter
    } else {
        parameter
    }
}
