//! Latin hypercube: each of `n` equal layers of each parameter is met by one case.
//!
//! `McKay`, Beckman, Conover, *A comparison of three methods for selecting values of input variables in
//! the analysis of output from a computer code*, Technometrics 21 (1979). The recipe, for other
//! programs to make the same points:
//!
//! 1. Parameter `d` (from 0) has the generator `ChaCha` with 8 rounds, the key being the seed as
//!    eight bytes, least first, and 24 zeros, and the stream being `d`.
//! 2. A number below `k` is the upper half of the product of `k` and the next 64 bits.
//! 3. The layers 0 .. n-1 are shuffled: for i from n-1 down to 1 layer i changes places with the one
//!    at a number below i+1 (Durstenfeld, Algorithm 235, 1964).
//! 4. Case by case a position in its layer is drawn, the upper 53 bits of the next 64 over 2^53: the
//!    point is (layer + position) / n.

use rand_chacha::ChaCha8Rng;
use rand_chacha::rand_core::{Rng, SeedableRng};

/// Points between 0 and 1, case by case, of so many parameters each.
pub(super) fn points(cases: usize, parameters: usize, seed: u64) -> Vec<Vec<f64>> {
    let columns: Vec<_> = (0..parameters)
        .map(|parameter| column(cases, parameter, seed))
        .collect();
    let case = |case: usize| columns.iter().map(|column| column[case]).collect();
    (0..cases).map(case).collect()
}

fn column(cases: usize, parameter: usize, seed: u64) -> Vec<f64> {
    let mut key = [0; 32];
    key[..8].copy_from_slice(&seed.to_le_bytes());
    let mut generator = ChaCha8Rng::from_seed(key);
    generator.set_stream(parameter as u64);
    let mut layers: Vec<usize> = (0..cases).collect();
    for i in (1..cases).rev() {
        let product = u128::from(generator.next_u64()) * (i as u128 + 1);
        layers.swap(i, (product >> 64) as usize);
    }
    let positions = layers.into_iter().map(|layer| {
        let position = (generator.next_u64() >> 11) as f64 / (1_u64 << 53) as f64;
        (layer as f64 + position) / cases as f64
    });
    positions.collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn every_layer_is_met_once_and_the_seed_alone_matters() {
        let points = points(50, 3, 7);
        for parameter in 0..3 {
            let mut layers: Vec<_> = points
                .iter()
                .map(|p| (p[parameter] * 50.0) as usize)
                .collect();
            layers.sort_unstable();
            assert_eq!(layers, (0..50).collect::<Vec<_>>());
        }
        assert_eq!(points, super::points(50, 3, 7));
        assert_ne!(points, super::points(50, 3, 8));
        // The points of a parameter do not depend on how many follow it.
        assert_eq!(points[4][..2], super::points(50, 2, 7)[4]);
    }
}
