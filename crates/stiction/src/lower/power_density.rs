//! INVPSD: a signal with a given power density.

use std::f64::consts::TAU;

use dataset::{Code, Expr, Function, Span};
use mechanics::expression::{Binary, Operation, Program, Register, Unary};

use super::Lowering;
use super::expression::{Compiler, Refused};

/// The most sines that a signal is made of.
const MOST: f64 = 10_000.0;

impl Compiler {
    /// `INVPSD(x, spline, f0, f1, n, scale, seed)`: n sines at frequencies (cycles) from f0 to f1 at
    /// equal distances Δf, each with the amplitude `sqrt(2 S(f) Δf)`, so that the mean square is
    /// the integral of the power density S. S is interpolated linearly in both axes (scale 0) or
    /// in both logarithms (scale 1).
    ///
    /// The phases are random but the same for the same seed; they are not those of other programs,
    /// which is told.
    pub(super) fn power_density(
        &mut self,
        lowering: &mut Lowering,
        arguments: &[Expr],
        span: Span,
    ) -> Result<Register, Refused> {
        let x = self.expr(lowering, &arguments[0])?;
        let mut numbers = [0.0; 5];
        for (number, argument) in numbers.iter_mut().zip(&arguments[2..]) {
            let register = self.expr(lowering, argument)?;
            let Some(value) = self.program.constant_value(register) else {
                return Err(self.refuse(
                    lowering,
                    span,
                    "takes numbers from its third argument on",
                ));
            };
            *number = value;
        }
        let [from, to, count, scale, seed] = numbers;
        if !(from < to && from >= 0.0) {
            return Err(self.refuse(lowering, span, "takes frequencies f0 below f1, from 0 on"));
        }
        if !(2.0..=MOST).contains(&count) {
            return Err(self.refuse(lowering, span, "takes between 2 and 10000 frequencies"));
        }
        // The checks of the dataset have reported a spline that is not there.
        let spline = arguments[1].as_id();
        let spline = spline.and_then(|id| lowering.dataset.splines.by_id(id));
        let spline = spline.ok_or(Refused)?;
        let density = |f: f64| interpolate(&spline.x, &spline.curves[0].y, f, scale != 0.0);
        let count = count as u32;
        let step = (to - from) / f64::from(count - 1);
        let mut phases = Phases(seed.trunc() as i64 as u64);
        let mut waves = Vec::with_capacity(count as usize);
        for k in 0..count {
            let frequency = from + f64::from(k) * step;
            let amplitude = (2.0 * density(frequency) * step).sqrt();
            if !amplitude.is_finite() {
                let what = format!("finds no power density at {frequency} in its spline");
                return Err(self.refuse(lowering, span, &what));
            }
            waves.push((amplitude, frequency, phases.next()));
        }
        let message = format!(
            "{}: the random phases of INVPSD are those of stiction; other programs have others",
            self.owner
        );
        lowering.warn(Code::RandomPhases, span, message);
        Ok(sum_of_sines(&mut self.program, x, &waves))
    }

    fn refuse(&self, lowering: &mut Lowering, span: Span, what: &str) -> Refused {
        let message = format!("{}: {} {what}", self.owner, Function::Invpsd.name());
        lowering.error(Code::OutOfRange, span, message, None);
        Refused
    }
}

/// `Σ a sin(2π f x + φ)`.
fn sum_of_sines(program: &mut Program, x: Register, waves: &[(f64, f64, f64)]) -> Register {
    let mut sum = program.push(Operation::Constant(0.0));
    for &(amplitude, frequency, phase) in waves {
        let [amplitude, rate, phase] =
            [amplitude, TAU * frequency, phase].map(|c| program.push(Operation::Constant(c)));
        let turned = program.push(Operation::Binary(Binary::Multiply, rate, x));
        let angle = program.push(Operation::Binary(Binary::Add, turned, phase));
        let sine = program.push(Operation::Unary(Unary::Sin, angle));
        let wave = program.push(Operation::Binary(Binary::Multiply, amplitude, sine));
        sum = program.push(Operation::Binary(Binary::Add, sum, wave));
    }
    sum
}

/// The line through the two points beside `x`, constant outside; with `logarithmic` the line of
/// the logarithms.
fn interpolate(xs: &[f64], ys: &[f64], x: f64, logarithmic: bool) -> f64 {
    let right = xs.partition_point(|known| *known < x);
    if right == 0 {
        return ys[0];
    }
    if right == xs.len() {
        return ys[right - 1];
    }
    let [x0, x1, y0, y1] = [xs[right - 1], xs[right], ys[right - 1], ys[right]];
    if logarithmic {
        let share = (x / x0).ln() / (x1 / x0).ln();
        y0 * (y1 / y0).powf(share)
    } else {
        y0 + (x - x0) / (x1 - x0) * (y1 - y0)
    }
}

/// Phases from a seed, equally distributed over a turn: the generator `SplitMix64` (Steele, Lea and
/// Flood, *Fast splittable pseudorandom number generators*, 2014).
struct Phases(u64);

impl Phases {
    fn next(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^= z >> 31;
        // The upper 53 bits are as many as a number holds.
        TAU * (z >> 11) as f64 / (1_u64 << 53) as f64
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn phases_are_spread_evenly() {
        let mut phases = Phases(7);
        let drawn: Vec<f64> = (0..10_000).map(|_| phases.next()).collect();
        let mean = |f: fn(f64) -> f64| drawn.iter().map(|p| f(*p)).sum::<f64>() / 1e4;
        // Four standard deviations of the mean of ten thousand sines, sqrt(1/2)/100.
        assert!(mean(f64::sin).abs() < 0.028);
        assert!(mean(f64::cos).abs() < 0.028);
        assert!(drawn.iter().all(|p| (0.0..TAU).contains(p)));
    }

    #[test]
    fn lines_and_logarithmic_lines() {
        let (x, y) = ([1.0, 10.0, 100.0], [2.0, 20.0, 2000.0]);
        assert_eq!(interpolate(&x, &y, 5.5, false), 11.0);
        assert!((interpolate(&x, &y, 10.0_f64.sqrt(), true) - 40.0_f64.sqrt()).abs() < 1e-12);
        assert_eq!(interpolate(&x, &y, 0.5, true), 2.0);
        assert_eq!(interpolate(&x, &y, 1e3, false), 2000.0);
    }
}
