//! Works from powers: the integral of the cubic through the powers of the last four instants.
//!
//! The integrator's own formula would do, but nothing controls its error for what no equation reads:
//! a motion of low order has works of twice that order.

/// Works up to the last accepted step, with the powers that it takes to go on.
#[derive(Clone, Debug)]
pub(super) struct Quadrature {
    /// Times of the last accepted instants, newest first, and how many there are.
    times: [f64; 3],
    count: usize,
    powers: [Vec<f64>; 3],
    works: Vec<f64>,
}

impl Quadrature {
    pub(super) fn new(size: usize) -> Self {
        Self {
            times: [0.0; 3],
            count: 0,
            powers: std::array::from_fn(|_| vec![0.0; size]),
            works: vec![0.0; size],
        }
    }

    /// Begins anew with works and powers of an instant.
    pub(super) fn start(&mut self, time: f64, works: &[f64], powers: &[f64]) {
        self.times[0] = time;
        self.count = 1;
        self.powers[0].copy_from_slice(powers);
        self.works.copy_from_slice(works);
    }

    /// Works at `time` after the last accepted instant, with the powers there.
    pub(super) fn works(&self, time: f64, powers: &[f64], works: &mut [f64]) {
        let [t0, t1, t2] = self.times;
        let h = time - t0;
        // Integrals over the step of Newton's products through the new instant and the last ones.
        let d = t0 - t1;
        let integrals = [
            h,
            -0.5 * h * h,
            -h * h * h / 6.0,
            -h * h * h * (h / 12.0 + d / 6.0),
        ];
        for (k, work) in works.iter_mut().enumerate() {
            let p = |place: usize| self.powers[place][k];
            let first = (powers[k] - p(0)) / h;
            let mut gain = integrals[0] * powers[k] + integrals[1] * first;
            if self.count > 1 {
                let before = (p(0) - p(1)) / d;
                let second = (first - before) / (time - t1);
                gain += integrals[2] * second;
                if self.count > 2 {
                    let last = (before - (p(1) - p(2)) / (t1 - t2)) / (t0 - t2);
                    gain += integrals[3] * (second - last) / (time - t2);
                }
            }
            *work = self.works[k] + gain;
        }
    }

    /// Takes over an accepted instant.
    pub(super) fn accept(&mut self, time: f64, works: &[f64], powers: &[f64]) {
        self.times.rotate_right(1);
        self.powers.rotate_right(1);
        self.times[0] = time;
        self.powers[0].copy_from_slice(powers);
        self.works.copy_from_slice(works);
        self.count = (self.count + 1).min(3);
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn cubic_powers_are_integrated_exactly() {
        let power = |t: f64| 2.0 - t + 3.0 * t * t - 0.5 * t * t * t;
        let work = |t: f64| 2.0 * t - 0.5 * t * t + t * t * t - 0.125 * t.powi(4);
        let mut quadrature = Quadrature::new(1);
        quadrature.start(0.3, &[work(0.3)], &[power(0.3)]);
        // The first two steps lack the past of a cubic: here they get the exact work.
        for time in [0.4, 0.7] {
            quadrature.accept(time, &[work(time)], &[power(time)]);
        }
        for time in [0.9, 1.7, 1.75] {
            let mut works = [0.0];
            quadrature.works(time, &[power(time)], &mut works);
            assert!((works[0] - work(time)).abs() < 1e-14, "{time}");
            quadrature.accept(time, &works, &[power(time)]);
        }
    }
}
