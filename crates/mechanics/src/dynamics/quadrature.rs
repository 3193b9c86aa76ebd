//! Works from powers: the integral over a step of the polynomial through the powers of the last
//! instants.
//!
//! The integrator's own formula would do, but nothing controls its error for what no equation reads:
//! a motion of low order has works of twice that order, so that the polynomial's degree is higher
//! than the order of the step.

use serde::{Deserialize, Serialize};

/// Instants that the polynomial goes through, at most; the new one counts.
const MOST: usize = 7;
/// The same at low order.
const LEAST: usize = 4;

/// Points and weights of Gauss's rule with four points over (0, 1), exact to degree seven.
const GAUSS: [(f64, f64); 4] = [
    (0.069_431_844_202_973_71, 0.173_927_422_568_726_93),
    (0.330_009_478_207_571_87, 0.326_072_577_431_273_07),
    (0.669_990_521_792_428_13, 0.326_072_577_431_273_07),
    (0.930_568_155_797_026_29, 0.173_927_422_568_726_93),
];

/// Works up to the last accepted step, with the powers that it takes to go on.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Quadrature {
    /// Times of the last accepted instants, newest first, and how many there are.
    times: [f64; MOST - 1],
    count: usize,
    powers: [Vec<f64>; MOST - 1],
    works: Vec<f64>,
}

impl Quadrature {
    pub(super) fn new(size: usize) -> Self {
        Self {
            times: [0.0; MOST - 1],
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

    /// Works at `time` after the last accepted instant, with the powers there, for a step of this
    /// `order`.
    pub(super) fn works(&self, time: f64, order: usize, powers: &[f64], works: &mut [f64]) {
        let mut nodes = [time; MOST];
        nodes[1..].copy_from_slice(&self.times);
        let count = (order + 2).clamp(LEAST, MOST).min(self.count + 1);
        let weights = weights(&nodes[..count]);
        for (k, work) in works.iter_mut().enumerate() {
            let past = weights[1..count].iter().zip(&self.powers);
            let gain = past.fold(weights[0] * powers[k], |gain, (w, p)| gain + w * p[k]);
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
        self.count = (self.count + 1).min(MOST - 1);
    }
}

/// Integrals from the second node to the first of Lagrange's polynomials through the nodes.
fn weights(nodes: &[f64]) -> [f64; MOST] {
    let step = nodes[0] - nodes[1];
    let points = GAUSS.map(|(point, _)| nodes[1] + point * step);
    let mut weights = [0.0; MOST];
    for (k, weight) in weights[..nodes.len()].iter_mut().enumerate() {
        let (mut products, mut divisor) = (GAUSS.map(|(_, part)| part), 1.0);
        for (other, node) in nodes.iter().enumerate() {
            if other != k {
                divisor *= nodes[k] - node;
                for (product, point) in products.iter_mut().zip(points) {
                    *product *= point - node;
                }
            }
        }
        *weight = step * products.iter().sum::<f64>() / divisor;
    }
    weights
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn powers_of_degree_six_are_integrated_exactly_at_high_order() {
        let power = |t: f64| 1.0 - 7.0 * t.powi(6);
        let work = |t: f64| t - t.powi(7);
        let mut quadrature = Quadrature::new(1);
        quadrature.start(0.3, &[work(0.3)], &[power(0.3)]);
        for time in [0.4, 0.55, 0.6, 0.7, 0.85] {
            quadrature.accept(time, &[work(time)], &[power(time)]);
        }
        let mut works = [0.0];
        quadrature.works(1.0, 5, &[power(1.0)], &mut works);
        assert!((works[0] - work(1.0)).abs() < 1e-14, "{}", works[0]);
    }

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
            quadrature.works(time, 1, &[power(time)], &mut works);
            assert!((works[0] - work(time)).abs() < 1e-14, "{time}");
            quadrature.accept(time, &works, &[power(time)]);
        }
    }
}
