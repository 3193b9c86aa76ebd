//! Markers whose coordinates carry derivatives.

use nalgebra::Vector3;

use crate::scalar::{Dual, Jet, Scalar, Triple};
use crate::state::MarkerFrame;

/// A marker with derivatives.
#[derive(Clone, Copy)]
pub(super) struct Frame<T> {
    pub(super) origin: Triple<T>,
    pub(super) axes: [Triple<T>; 3],
    pub(super) velocity: Triple<T>,
    pub(super) omega: Triple<T>,
}

pub(super) fn triple(v: &Vector3<f64>) -> Triple<f64> {
    Triple([v.x, v.y, v.z])
}

impl Frame<f64> {
    pub(super) fn new(m: &MarkerFrame) -> Self {
        Self {
            origin: triple(&m.origin),
            axes: [0, 1, 2].map(|k| triple(&m.axis(k))),
            velocity: triple(&m.velocity),
            omega: triple(&m.omega),
        }
    }
}

/// Vector `v` and, where it is `seeded`, its changes `by(k)` with the motions k of a body.
pub(super) fn seeded_vector<const N: usize>(
    v: &Vector3<f64>,
    seeded: bool,
    by: &dyn Fn(usize) -> Vector3<f64>,
) -> Triple<Dual<N>> {
    let mut out = [0, 1, 2].map(|axis| Dual::constant(v[axis]));
    if seeded {
        for k in 0..N {
            let change = by(k);
            for axis in 0..3 {
                out[axis].slopes[k] = change[axis];
            }
        }
    }
    Triple(out)
}

impl<const N: usize> Frame<Dual<N>> {
    /// With the slopes by the motions of its body, where it is `seeded`.
    pub(super) fn new(m: &MarkerFrame, seeded: bool) -> Self {
        let vector = |v: &Vector3<f64>, by: &dyn Fn(usize) -> Vector3<f64>| {
            seeded_vector::<N>(v, seeded, by)
        };
        let unit = |k: usize| {
            let mut e = Vector3::zeros();
            e[k % 3] = 1.0;
            e
        };
        let turned = |v: Vector3<f64>| {
            move |k: usize| {
                if k / 3 == 1 {
                    unit(k).cross(&v)
                } else {
                    Vector3::zeros()
                }
            }
        };
        let axes = [0, 1, 2].map(|axis| vector(&m.axis(axis), &turned(m.axis(axis))));
        Self {
            origin: vector(&m.origin, &|k| match k / 3 {
                0 => unit(k),
                1 => unit(k).cross(&m.arm),
                _ => Vector3::zeros(),
            }),
            axes,
            velocity: vector(&m.velocity, &|k| match k / 3 {
                1 => m.omega.cross(&unit(k).cross(&m.arm)),
                2 => unit(k),
                3 => unit(k).cross(&m.arm),
                _ => Vector3::zeros(),
            }),
            omega: vector(&m.omega, &|k| {
                if k / 3 == 3 {
                    unit(k)
                } else {
                    Vector3::zeros()
                }
            }),
        }
    }
}

impl Frame<Jet> {
    /// Along the motion with all accelerations zero.
    pub(super) fn new(m: &MarkerFrame) -> Self {
        let vector = |v: &Vector3<f64>, rate: Vector3<f64>, acceleration: Vector3<f64>| {
            Triple([0, 1, 2].map(|k| Jet {
                value: v[k],
                rate: rate[k],
                acceleration: acceleration[k],
            }))
        };
        let turned = |v: &Vector3<f64>| (m.omega.cross(v), m.omega.cross(&m.omega.cross(v)));
        let zero = Vector3::zeros();
        let arm = turned(&m.arm);
        Self {
            origin: vector(&m.origin, m.velocity, arm.1),
            axes: [0, 1, 2].map(|k| {
                let axis = m.axis(k);
                let (rate, acceleration) = turned(&axis);
                vector(&axis, rate, acceleration)
            }),
            // Only quantities of displacement are asked for along a motion.
            velocity: vector(&m.velocity, zero, zero),
            omega: vector(&m.omega, zero, zero),
        }
    }
}
