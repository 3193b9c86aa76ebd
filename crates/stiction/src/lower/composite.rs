//! Functions of the language that are several operations: steps, contacts and series.
//!
//! Arguments are registers in the order of the function's arguments in the dataset language.

use mechanics::expression::{Binary, Operation, Program, Register, Unary};

fn constant(program: &mut Program, value: f64) -> Register {
    program.push(Operation::Constant(value))
}

fn unary(program: &mut Program, function: Unary, a: Register) -> Register {
    program.push(Operation::Unary(function, a))
}

fn binary(program: &mut Program, function: Binary, a: Register, b: Register) -> Register {
    program.push(Operation::Binary(function, a, b))
}

/// `DIM(a, b)`: the excess of a over b, zero where there is none.
pub(super) fn dim(program: &mut Program, a: Register, b: Register) -> Register {
    let excess = binary(program, Binary::Subtract, a, b);
    let zero = constant(program, 0.0);
    binary(program, Binary::Max, excess, zero)
}

/// Magnitude of a vector, with slope zero where it is zero.
pub(super) fn magnitude(program: &mut Program, [x, y, z]: [Register; 3]) -> Register {
    let squares = [x, y, z].map(|c| binary(program, Binary::Multiply, c, c));
    let sum = binary(program, Binary::Add, squares[0], squares[1]);
    let sum = binary(program, Binary::Add, sum, squares[2]);
    let root = unary(program, Unary::Sqrt, sum);
    let zero = constant(program, 0.0);
    program.push(Operation::Select(sum, zero, zero, root))
}

/// `STEP(x, x0, h0, x1, h1)` and its kin: from h0 at x0 to h1 at x1 by `shape`.
pub(super) fn step(program: &mut Program, shape: Unary, arguments: &[Register]) -> Register {
    let [x, x0, h0, x1, h1] = *arguments else {
        return constant(program, f64::NAN);
    };
    let from = binary(program, Binary::Subtract, x, x0);
    let width = binary(program, Binary::Subtract, x1, x0);
    let s = binary(program, Binary::Divide, from, width);
    let share = unary(program, shape, s);
    let height = binary(program, Binary::Subtract, h1, h0);
    let rise = binary(program, Binary::Multiply, height, share);
    binary(program, Binary::Add, h0, rise)
}

/// `IMPACT(x, x', x1, k, e, cmax, d)`: a contact that pushes while `x < x1`:
/// `max(0, k (x1 − x)^e − cmax x' STEP(x, x1 − d, 1, x1, 0))`.
pub(super) fn impact(program: &mut Program, arguments: &[Register]) -> Register {
    let [x, rate, x1, k, e, cmax, d] = *arguments else {
        return constant(program, f64::NAN);
    };
    let zero = constant(program, 0.0);
    let depth = binary(program, Binary::Subtract, x1, x);
    let push = contact(program, depth, k, e);
    let full = binary(program, Binary::Subtract, x1, d);
    let one = constant(program, 1.0);
    let share = step(program, Unary::CubicStep, &[x, full, one, x1, zero]);
    let damping = damping(program, cmax, rate, share);
    let force = binary(program, Binary::Subtract, push, damping);
    let force = binary(program, Binary::Max, force, zero);
    program.push(Operation::Select(depth, zero, zero, force))
}

/// `BISTOP(x, x', x1, x2, k, e, cmax, d)`: [`impact`] at x1 and its mirror image at x2:
/// `min(0, −k (x − x2)^e − cmax x' STEP(x, x2, 0, x2 + d, 1))`.
pub(super) fn bistop(program: &mut Program, arguments: &[Register]) -> Register {
    let [x, rate, x1, x2, k, e, cmax, d] = *arguments else {
        return constant(program, f64::NAN);
    };
    let lower = impact(program, &[x, rate, x1, k, e, cmax, d]);
    let zero = constant(program, 0.0);
    let depth = binary(program, Binary::Subtract, x, x2);
    let push = contact(program, depth, k, e);
    let full = binary(program, Binary::Add, x2, d);
    let one = constant(program, 1.0);
    let share = step(program, Unary::CubicStep, &[x, x2, zero, full, one]);
    let damping = damping(program, cmax, rate, share);
    let sum = binary(program, Binary::Add, push, damping);
    let force = unary(program, Unary::Negate, sum);
    let force = binary(program, Binary::Min, force, zero);
    program.push(Operation::Select(depth, lower, lower, force))
}

/// `k depth^e`.
fn contact(program: &mut Program, depth: Register, k: Register, e: Register) -> Register {
    let power = binary(program, Binary::Power, depth, e);
    binary(program, Binary::Multiply, k, power)
}

fn damping(program: &mut Program, cmax: Register, rate: Register, share: Register) -> Register {
    let full = binary(program, Binary::Multiply, cmax, rate);
    binary(program, Binary::Multiply, full, share)
}

/// `POLY(x, x0, a0, a1, ...)`: `Σ a_k (x − x0)^k`, by Horner's rule.
pub(super) fn polynomial(program: &mut Program, arguments: &[Register]) -> Register {
    let [x, x0, coefficients @ ..] = arguments else {
        return constant(program, f64::NAN);
    };
    let shift = binary(program, Binary::Subtract, *x, *x0);
    let zero = constant(program, 0.0);
    coefficients.iter().rev().fold(zero, |sum, coefficient| {
        let product = binary(program, Binary::Multiply, sum, shift);
        binary(program, Binary::Add, product, *coefficient)
    })
}

/// `CHEBY(x, x0, a0, a1, ...)`: `Σ a_k T_k(x − x0)` with Chebyshev's polynomials.
pub(super) fn chebyshev(program: &mut Program, arguments: &[Register]) -> Register {
    let [x, x0, first, others @ ..] = arguments else {
        return constant(program, f64::NAN);
    };
    let shift = binary(program, Binary::Subtract, *x, *x0);
    let two = constant(program, 2.0);
    let twice = binary(program, Binary::Multiply, two, shift);
    let one = constant(program, 1.0);
    let (mut before, mut now) = (one, shift);
    let mut sum = *first;
    for coefficient in others {
        let term = binary(program, Binary::Multiply, *coefficient, now);
        sum = binary(program, Binary::Add, sum, term);
        // T_{k+1} = 2 x T_k − T_{k−1}
        let product = binary(program, Binary::Multiply, twice, now);
        (before, now) = (now, binary(program, Binary::Subtract, product, before));
    }
    sum
}

/// `FORSIN` and `FORCOS(x, x0, w, a0, a1, ...)`: `a0 + Σ a_k f(k w (x − x0))`.
pub(super) fn fourier(program: &mut Program, wave: Unary, arguments: &[Register]) -> Register {
    let [x, x0, w, first, others @ ..] = arguments else {
        return constant(program, f64::NAN);
    };
    let shift = binary(program, Binary::Subtract, *x, *x0);
    let phase = binary(program, Binary::Multiply, *w, shift);
    let mut sum = *first;
    for (k, coefficient) in (1_u32..).zip(others) {
        let order = constant(program, f64::from(k));
        let angle = binary(program, Binary::Multiply, order, phase);
        let wave = unary(program, wave, angle);
        let term = binary(program, Binary::Multiply, *coefficient, wave);
        sum = binary(program, Binary::Add, sum, term);
    }
    sum
}

/// `SHF(x, x0, a, w, phi, b)`: `a sin(w (x − x0) − phi) + b`; b is zero where it is left out.
pub(super) fn harmonic(program: &mut Program, arguments: &[Register]) -> Register {
    let [x, x0, a, w, phi, ref average @ ..] = *arguments else {
        return constant(program, f64::NAN);
    };
    let shift = binary(program, Binary::Subtract, x, x0);
    let phase = binary(program, Binary::Multiply, w, shift);
    let angle = binary(program, Binary::Subtract, phase, phi);
    let sine = unary(program, Unary::Sin, angle);
    let wave = binary(program, Binary::Multiply, a, sine);
    let average = match average.first() {
        Some(average) => *average,
        None => constant(program, 0.0),
    };
    binary(program, Binary::Add, wave, average)
}

/// `SWEEP(x, a, x0, f0, x1, f1, dx)`: `a sin(2π φ(x))` where the frequency `φ'` (cycles) rises
/// linearly from f0 at x0 to f1 at x1 and is constant outside, and `φ(x0) = f0 x0`; it fades in by
/// the quintic step from x0 to x0 + dx, so that it is zero below x0.
pub(super) fn sweep(program: &mut Program, arguments: &[Register]) -> Register {
    let [x, a, x0, f0, x1, f1, dx] = *arguments else {
        return constant(program, f64::NAN);
    };
    let (zero, one) = (constant(program, 0.0), constant(program, 1.0));
    let inside = binary(program, Binary::Min, x, x1);
    let inside = binary(program, Binary::Subtract, inside, x0);
    let width = binary(program, Binary::Subtract, x1, x0);
    let rise = binary(program, Binary::Subtract, f1, f0);
    // f0 x0 + (f0 + rise u/(2 width)) u, and f1 (x − x1) beyond.
    let start = binary(program, Binary::Multiply, f0, x0);
    let half = constant(program, 0.5);
    let bend = binary(program, Binary::Divide, rise, width);
    let bend = binary(program, Binary::Multiply, half, bend);
    let mean = binary(program, Binary::Multiply, bend, inside);
    let mean = binary(program, Binary::Add, f0, mean);
    let cycles = binary(program, Binary::Multiply, mean, inside);
    let cycles = binary(program, Binary::Add, start, cycles);
    let beyond = dim(program, x, x1);
    let beyond = binary(program, Binary::Multiply, f1, beyond);
    let cycles = binary(program, Binary::Add, cycles, beyond);
    let turn = constant(program, std::f64::consts::TAU);
    let angle = binary(program, Binary::Multiply, turn, cycles);
    let sine = unary(program, Unary::Sin, angle);
    let full = binary(program, Binary::Add, x0, dx);
    let share = step(program, Unary::QuinticStep, &[x, x0, zero, full, one]);
    let amplitude = binary(program, Binary::Multiply, a, share);
    binary(program, Binary::Multiply, amplitude, sine)
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Value of a composite function of constants, which come first in the program.
    fn value(build: impl FnOnce(&mut Program, &[Register]) -> Register, arguments: &[f64]) -> f64 {
        let mut program = Program::default();
        let registers: Vec<Register> = arguments
            .iter()
            .map(|a| program.push(Operation::Constant(*a)))
            .collect();
        let last = build(&mut program, &registers);
        let mut values = vec![0.0; program.len()];
        program.evaluate(&mut values, |_| f64::NAN);
        values[last as usize]
    }

    /// A dozen roundings of numbers near one.
    fn close(a: f64, b: f64) {
        assert!((a - b).abs() <= 1e-14 * b.abs().max(1.0), "{a} is not {b}");
    }

    #[test]
    fn steps_are_constant_outside_and_blend_inside() {
        let cubic = |x| {
            value(
                |p, a| step(p, Unary::CubicStep, a),
                &[x, 1.0, 10.0, 3.0, 20.0],
            )
        };
        close(cubic(0.0), 10.0);
        close(cubic(1.5), 10.0 + 10.0 * 0.0625 * (3.0 - 0.5));
        close(cubic(4.0), 20.0);
        // Mirrored where x0 > x1.
        close(
            value(
                |p, a| step(p, Unary::CubicStep, a),
                &[0.0, 3.0, 10.0, 1.0, 20.0],
            ),
            20.0,
        );
    }

    #[test]
    fn contacts_push_only() {
        let at = |x: f64, rate: f64| value(impact, &[x, rate, 1.0, 100.0, 1.5, 8.0, 0.1]);
        close(at(1.2, -3.0), 0.0);
        close(at(0.8, -3.0), 100.0 * 0.2_f64.powf(1.5) + 24.0);
        close(at(0.8, 100.0), 0.0);
        let both = |x: f64| value(bistop, &[x, 0.0, 1.0, 2.0, 100.0, 1.5, 8.0, 0.1]);
        close(both(0.9), 100.0 * 0.1_f64.powf(1.5));
        close(both(1.5), 0.0);
        close(both(2.1), -100.0 * 0.1_f64.powf(1.5));
    }

    #[test]
    fn series_follow_their_definitions() {
        close(
            value(polynomial, &[3.0, 1.0, 5.0, 6.0, 7.0]),
            5.0 + 12.0 + 28.0,
        );
        let x: f64 = 0.3;
        let chebyshev_sum = 1.0 + 2.0 * x + 3.0 * (2.0 * x * x - 1.0);
        close(value(chebyshev, &[1.3, 1.0, 1.0, 2.0, 3.0]), chebyshev_sum);
        let fourier_sum = 1.0 + 2.0 * 0.6_f64.sin() + 3.0 * 1.2_f64.sin();
        close(
            value(
                |p, a| fourier(p, Unary::Sin, a),
                &[1.3, 1.0, 2.0, 1.0, 2.0, 3.0],
            ),
            fourier_sum,
        );
        close(
            value(harmonic, &[1.3, 1.0, 5.0, 2.0, 0.1, 7.0]),
            5.0 * 0.5_f64.sin() + 7.0,
        );
        close(
            value(harmonic, &[1.3, 1.0, 5.0, 2.0, 0.1]),
            5.0 * 0.5_f64.sin(),
        );
        close(value(|p, a| dim(p, a[0], a[1]), &[3.0, 5.0]), 0.0);
    }
}
