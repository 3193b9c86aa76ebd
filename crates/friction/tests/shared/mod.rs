//! What several tests need.
#![allow(
    dead_code,
    reason = "each test binary uses its own part of this module"
)]

pub(crate) mod integrator;

use friction::{Effect, LuGre, Original};
use verification::{Case, Section};

/// The text of a file of the reference data, or `None` with a printed reason.
pub(crate) fn reference(path: &str) -> Option<String> {
    let file = reference_data::path(path)?;
    Some(std::fs::read_to_string(file).expect("reference files are text"))
}

/// A case of the law by itself, which is part of no joint.
pub(crate) fn of_the_law<'a>(id: &'a str, model: &'a str, source: &'a str) -> Case<'a> {
    Case {
        section: Section::Law,
        id,
        model,
        source,
        covers: &[],
    }
}

/// Parameters used by most tests.
pub(crate) fn law(effect: Effect) -> Original {
    Original {
        mu_static: 0.3,
        mu_dynamic: 0.2,
        transition_velocity: 0.1,
        transition_coefficient: 1.5,
        max_deformation: 0.01,
        effect,
    }
}

/// Set of Canudas de Wit et al. (1995), table 1: levels 1.5 N and 1 N at a load of one.
pub(crate) fn canudas() -> LuGre {
    LuGre {
        mu_static: 1.5,
        mu_dynamic: 1.0,
        bristle_stiffness: 1e5,
        damping: 1e5f64.sqrt(),
        viscous: 0.4,
        stribeck_velocity: 1e-3,
        stribeck_exponent: 2.0,
    }
}

/// Numbers of a comma-separated table after its header line.
pub(crate) fn table(text: &str) -> Vec<Vec<f64>> {
    let numbers = |line: &str| {
        line.split(',')
            .map(|cell| cell.trim().parse().unwrap())
            .collect()
    };
    text.lines().skip(1).map(numbers).collect()
}

/// Repeatable random numbers (`SplitMix64`).
pub(crate) struct Random(pub(crate) u64);

impl Random {
    /// Uniform in [-1, 1).
    pub(crate) fn number(&mut self) -> f64 {
        self.0 = self.0.wrapping_add(0x9e37_79b9_7f4a_7c15);
        let mut z = self.0;
        z = (z ^ (z >> 30)).wrapping_mul(0xbf58_476d_1ce4_e5b9);
        z = (z ^ (z >> 27)).wrapping_mul(0x94d0_49bb_1331_11eb);
        ((z ^ (z >> 31)) >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    }

    /// Vector of the given length in a random direction.
    pub(crate) fn vector<const N: usize>(&mut self, length: f64) -> [f64; N] {
        loop {
            let x: [f64; N] = core::array::from_fn(|_| self.number());
            let size = norm(&x);
            if size > 0.1 && size <= 1.0 {
                return x.map(|c| length * c / size);
            }
        }
    }
}

pub(crate) fn norm<const N: usize>(x: &[f64; N]) -> f64 {
    dot(x, x).sqrt()
}

pub(crate) fn dot<const N: usize>(x: &[f64; N], y: &[f64; N]) -> f64 {
    x.iter().zip(y).map(|(a, b)| a * b).sum()
}

/// Derivative of `f` at 0 by central differences of sixth order, exact for polynomials to degree 6.
pub(crate) fn slope<const N: usize>(h: f64, f: impl Fn(f64) -> [f64; N]) -> [f64; N] {
    let d = |k: f64| {
        let (a, b) = (f(k * h), f(-k * h));
        core::array::from_fn::<f64, N, _>(|i| a[i] - b[i])
    };
    let (one, two, three) = (d(1.0), d(2.0), d(3.0));
    core::array::from_fn(|i| (45.0 * one[i] - 9.0 * two[i] + three[i]) / (60.0 * h))
}
