//! The past of a solution as divided differences.

use serde::{Deserialize, Serialize};
use std::ops::Range;

/// Nodes that a history can keep.
pub(super) const MOST_NODES: usize = 14;

/// Past values `y(t_0), y(t_1), …` (newest first) in Newton's form: `difference(j)` is the divided
/// difference `y[t_0, …, t_j]`.
///
/// A start from a value and a slope is the double node `t_0 = t_1`, whose divided difference is
/// the slope. So the first step is already of second order, and no special starting formula is
/// needed.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub struct History {
    size: usize,
    /// How many nodes are kept.
    nodes: usize,
    times: [f64; MOST_NODES],
    count: usize,
    /// `nodes` vectors of `size` values.
    differences: Vec<f64>,
    work: Vec<f64>,
}

impl History {
    /// An empty past for `size` values that keeps `nodes` of them, at most 14.
    #[must_use]
    pub fn new(size: usize, nodes: usize) -> Self {
        assert!(nodes <= MOST_NODES);
        Self {
            size,
            nodes,
            times: [0.0; MOST_NODES],
            count: 0,
            differences: vec![0.0; size * nodes],
            work: vec![0.0; size],
        }
    }

    /// Forgets the past and starts from a value and a slope.
    pub fn start(&mut self, time: f64, value: &[f64], slope: &[f64]) {
        self.start_without_slope(time, value);
        self.count = 2;
        self.differences[self.size..2 * self.size].copy_from_slice(slope);
    }

    /// Forgets the past and starts from a value alone.
    pub fn start_without_slope(&mut self, time: f64, value: &[f64]) {
        self.times = [time; MOST_NODES];
        self.count = 1;
        self.differences[..self.size].copy_from_slice(value);
    }

    /// Appends a value at a later time.
    pub fn push(&mut self, time: f64, value: &[f64]) {
        let kept = (self.count + 1).min(self.nodes);
        self.work.copy_from_slice(value);
        // `work` runs through the new differences; each replaces the old one of its place, which
        // the next one still needs.
        for j in 0..kept {
            let row = j * self.size..(j + 1) * self.size;
            let last = j + 1 == kept;
            let differences = self.work.iter_mut().zip(&mut self.differences[row]);
            if last {
                differences.for_each(|(new, old)| *old = *new);
                break;
            }
            let span = time - self.times[j];
            for (new, old) in differences {
                let next = (*new - *old) / span;
                *old = *new;
                *new = next;
            }
        }
        self.times.copy_within(0..MOST_NODES - 1, 1);
        self.times[0] = time;
        self.count = kept;
    }

    /// Number of nodes, a double one counted twice.
    #[must_use]
    pub fn count(&self) -> usize {
        self.count
    }

    /// How many nodes it keeps.
    #[must_use]
    pub fn capacity(&self) -> usize {
        self.nodes
    }

    /// Number of values.
    #[must_use]
    pub fn size(&self) -> usize {
        self.size
    }

    /// Newest time.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.times[0]
    }

    /// Time of node `j`, newest first.
    #[must_use]
    pub fn node(&self, j: usize) -> f64 {
        self.times[j]
    }

    /// Divided difference over the nodes `0..=j`.
    #[must_use]
    pub fn difference(&self, j: usize) -> &[f64] {
        &self.differences[j * self.size..(j + 1) * self.size]
    }

    /// `Π_{i<j} (time − t_i)`: what multiplies difference `j` in Newton's form.
    #[must_use]
    pub fn product(&self, j: usize, time: f64) -> f64 {
        self.times[..j].iter().map(|node| time - node).product()
    }

    /// `γ` of the formula of `order` at `time`: the reciprocal of `Σ_{i<order} 1/(time − t_i)`.
    #[must_use]
    pub fn gamma(&self, order: usize, time: f64) -> f64 {
        1.0 / self.times[..order]
            .iter()
            .map(|node| 1.0 / (time - node))
            .sum::<f64>()
    }

    /// Value at `time` of the polynomial through the newest `degree + 1` nodes.
    pub fn evaluate(&self, degree: usize, time: f64, value: &mut [f64]) {
        self.evaluate_range(degree, time, 0..self.size, value);
    }

    /// The same of the values in `range`.
    pub fn evaluate_range(&self, degree: usize, time: f64, range: Range<usize>, value: &mut [f64]) {
        value.copy_from_slice(&self.difference(degree)[range.clone()]);
        for j in (0..degree).rev() {
            let span = time - self.times[j];
            for (v, d) in value.iter_mut().zip(&self.difference(j)[range.clone()]) {
                *v = *v * span + d;
            }
        }
    }

    /// Slope at `time` of the polynomial through the newest `degree + 1` nodes, of the values in
    /// `range`.
    pub fn slope(&self, degree: usize, time: f64, range: Range<usize>, slope: &mut [f64]) {
        slope.fill(0.0);
        // Newton's form differentiated: the slope of each product beside it.
        let (mut product, mut rate) = (1.0, 0.0);
        for j in 0..=degree {
            for (s, d) in slope.iter_mut().zip(&self.difference(j)[range.clone()]) {
                *s += rate * d;
            }
            let span = time - self.times[j];
            rate = rate * span + product;
            product *= span;
        }
    }

    /// Adds `scale` times the integral over time from the newest node to `time` of the polynomial
    /// through the newest `weights.len()` nodes, where `weights` are the integrals of the products of nodes to there.
    pub fn add_integral(&self, weights: &[f64], integral: &mut [f64]) {
        for (j, weight) in weights.iter().enumerate() {
            for (sum, d) in integral.iter_mut().zip(self.difference(j)) {
                *sum += weight * d;
            }
        }
    }

    /// The nodes, newest first.
    #[must_use]
    pub fn nodes(&self) -> &[f64] {
        &self.times[..self.count]
    }

    /// The formula's `ŷ = w − γ ẇ` at `time`, with `w` through the newest `order` nodes.
    pub fn formula(&self, order: usize, time: f64, gamma: f64, result: &mut [f64]) {
        // Newton's form of w and its slope share the products; both are linear in the differences.
        let mut product = 1.0;
        let mut slope = 0.0;
        result.fill(0.0);
        for j in 0..order {
            let weight = product - gamma * slope;
            for (r, d) in result.iter_mut().zip(self.difference(j)) {
                *r += weight * d;
            }
            let span = time - self.times[j];
            slope = slope * span + product;
            product *= span;
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn polynomials_are_reproduced_with_their_slopes() {
        let f = |t: f64| 2.0 + t - 3.0 * t * t + 0.5 * t * t * t;
        let slope = |t: f64| 1.0 - 6.0 * t + 1.5 * t * t;
        let mut history = History::new(1, 7);
        history.start(0.1, &[f(0.1)], &[slope(0.1)]);
        for t in [0.15, 0.3, 0.35] {
            history.push(t, &[f(t)]);
        }
        let t = 0.5;
        let mut value = [0.0];
        history.evaluate(3, t, &mut value);
        assert!((value[0] - f(t)).abs() < 1e-13);
        let mut rate = [0.0];
        history.slope(3, t, 0..1, &mut rate);
        assert!((rate[0] - slope(t)).abs() < 1e-12);
        // Order 3 through the new value and three past ones is exact for cubics.
        let gamma = history.gamma(3, t);
        let mut past = [0.0];
        history.formula(3, t, gamma, &mut past);
        assert!(((f(t) - past[0]) / gamma - slope(t)).abs() < 1e-12);
    }

    #[test]
    fn the_double_node_gives_the_trapezoidal_rule() {
        let mut history = History::new(1, 7);
        history.start(0.0, &[1.0], &[2.0]);
        let gamma = history.gamma(2, 0.1);
        let mut past = [0.0];
        history.formula(2, 0.1, gamma, &mut past);
        // y1 = y0 + h/2 (slope0 + slope1)
        let slope1 = 5.0;
        let y1 = past[0] + gamma * slope1;
        assert!((y1 - (1.0 + 0.05 * (2.0 + 5.0))).abs() < 1e-15);
    }
}
