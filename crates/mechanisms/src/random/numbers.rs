//! Repeatable random numbers.

use nalgebra::Vector3;

/// The generator `SplitMix64` (Steele, Lea and Flood, *Fast splittable pseudorandom number
/// generators*, 2014): the same numbers from the same seed everywhere and for ever.
#[derive(Clone, Debug)]
pub(super) struct Numbers(u64);

impl Numbers {
    pub(super) fn new(seed: u64) -> Self {
        Self(seed)
    }

    fn next(&mut self) -> u64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        z ^ (z >> 31)
    }

    /// Uniform from `low` to `high`.
    pub(super) fn between(&mut self, low: f64, high: f64) -> f64 {
        low + (high - low) * ((self.next() >> 11) as f64 / (1u64 << 53) as f64)
    }

    /// Ten to a power that is uniform from `low` to `high`.
    pub(super) fn decades(&mut self, low: f64, high: f64) -> f64 {
        10f64.powf(self.between(low, high))
    }

    /// True with this probability.
    pub(super) fn chance(&mut self, probability: f64) -> bool {
        self.between(0.0, 1.0) < probability
    }

    /// A number below `count`.
    pub(super) fn below(&mut self, count: usize) -> usize {
        (self.between(0.0, count as f64) as usize).min(count - 1)
    }

    /// A member of a list, by weights.
    pub(super) fn choose<T: Copy>(&mut self, list: &[(f64, T)]) -> T {
        let total: f64 = list.iter().map(|(weight, _)| weight).sum();
        let mut left = self.between(0.0, total);
        for (weight, member) in list {
            left -= weight;
            if left < 0.0 {
                return *member;
            }
        }
        list[list.len() - 1].1
    }

    /// A direction, all alike.
    pub(super) fn direction(&mut self) -> Vector3<f64> {
        loop {
            let v = Vector3::from_fn(|_, _| self.between(-1.0, 1.0));
            let size = v.norm();
            if size > 0.1 && size <= 1.0 {
                return v / size;
            }
        }
    }
}
