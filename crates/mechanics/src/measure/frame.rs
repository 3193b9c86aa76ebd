//! Markers whose coordinates carry derivatives, found as they are asked for: a quantity needs few of them.

use nalgebra::Vector3;

use crate::scalar::{Dual, Jet, Scalar, Triple};
use crate::state::MarkerFrame;

/// A marker in numbers with derivatives.
pub(super) trait Frame<T>: Copy {
    fn origin(self) -> Triple<T>;
    fn axis(self, k: usize) -> Triple<T>;
    fn velocity(self) -> Triple<T>;
    fn omega(self) -> Triple<T>;
}

pub(super) fn triple(v: &Vector3<f64>) -> Triple<f64> {
    Triple([v.x, v.y, v.z])
}

impl Frame<f64> for &MarkerFrame {
    fn origin(self) -> Triple<f64> {
        triple(&self.origin)
    }

    fn axis(self, k: usize) -> Triple<f64> {
        triple(&MarkerFrame::axis(self, k))
    }

    fn velocity(self) -> Triple<f64> {
        triple(&self.velocity)
    }

    fn omega(self) -> Triple<f64> {
        triple(&self.omega)
    }
}

/// A marker with the slopes by the motions of its body, where it is `seeded`.
#[derive(Clone, Copy)]
pub(super) struct Seeded<'a> {
    pub(super) marker: &'a MarkerFrame,
    pub(super) seeded: bool,
}

impl<'a> Seeded<'a> {
    /// With the slopes by the motions of `body`.
    pub(super) fn by(marker: &'a MarkerFrame, body: usize) -> Self {
        let seeded = marker.body == Some(body);
        Self { marker, seeded }
    }

    /// A vector at the marker with its changes `by(k)` with the motions k of the body.
    pub(super) fn vector<const N: usize>(
        self,
        v: &Vector3<f64>,
        by: impl Fn(usize) -> Vector3<f64>,
    ) -> Triple<Dual<N>> {
        let mut out = [0, 1, 2].map(|axis| Dual::constant(v[axis]));
        if self.seeded {
            for k in 0..N {
                let change = by(k);
                for axis in 0..3 {
                    out[axis].slopes[k] = change[axis];
                }
            }
        }
        Triple(out)
    }
}

/// The direction of motion k of a body.
pub(super) fn unit(k: usize) -> Vector3<f64> {
    let mut e = Vector3::zeros();
    e[k % 3] = 1.0;
    e
}

impl<const N: usize> Frame<Dual<N>> for Seeded<'_> {
    fn origin(self) -> Triple<Dual<N>> {
        self.vector(&self.marker.origin, |k| match k / 3 {
            0 => unit(k),
            1 => unit(k).cross(&self.marker.arm),
            _ => Vector3::zeros(),
        })
    }

    fn axis(self, k: usize) -> Triple<Dual<N>> {
        let axis = self.marker.axis(k);
        self.vector(&axis, |k| {
            if k / 3 == 1 {
                unit(k).cross(&axis)
            } else {
                Vector3::zeros()
            }
        })
    }

    fn velocity(self) -> Triple<Dual<N>> {
        let m = self.marker;
        self.vector(&m.velocity, |k| match k / 3 {
            1 => m.omega.cross(&unit(k).cross(&m.arm)),
            2 => unit(k),
            3 => unit(k).cross(&m.arm),
            _ => Vector3::zeros(),
        })
    }

    fn omega(self) -> Triple<Dual<N>> {
        self.vector(&self.marker.omega, |k| {
            if k / 3 == 3 {
                unit(k)
            } else {
                Vector3::zeros()
            }
        })
    }
}

/// A marker along the motion with all accelerations zero.
#[derive(Clone, Copy)]
pub(super) struct Moving<'a>(pub(super) &'a MarkerFrame);

impl Moving<'_> {
    fn vector(v: &Vector3<f64>, rate: &Vector3<f64>, acceleration: &Vector3<f64>) -> Triple<Jet> {
        Triple([0, 1, 2].map(|k| Jet {
            value: v[k],
            rate: rate[k],
            acceleration: acceleration[k],
        }))
    }

    /// The rate of a vector that is fixed to the marker, and its second rate.
    fn turned(self, v: &Vector3<f64>) -> [Vector3<f64>; 2] {
        let omega = &self.0.omega;
        let rate = omega.cross(v);
        [rate, omega.cross(&rate)]
    }
}

impl Frame<Jet> for Moving<'_> {
    fn origin(self) -> Triple<Jet> {
        let [_, acceleration] = self.turned(&self.0.arm);
        Self::vector(&self.0.origin, &self.0.velocity, &acceleration)
    }

    fn axis(self, k: usize) -> Triple<Jet> {
        let axis = self.0.axis(k);
        let [rate, acceleration] = self.turned(&axis);
        Self::vector(&axis, &rate, &acceleration)
    }

    // Only quantities of displacement are asked for along a motion.
    fn velocity(self) -> Triple<Jet> {
        Self::vector(&self.0.velocity, &Vector3::zeros(), &Vector3::zeros())
    }

    fn omega(self) -> Triple<Jet> {
        Self::vector(&self.0.omega, &Vector3::zeros(), &Vector3::zeros())
    }
}
