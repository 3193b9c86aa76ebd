//! Quantities of acceleration, with their derivatives.

use nalgebra::Vector3;

use super::frame::{Frame, Seeded, triple, unit};
use super::{Quantity, evaluate};
use crate::scalar::{Dual, Scalar, Triple};
use crate::state::MarkerFrame;

/// Acceleration of a marker's origin and its body's angular acceleration, ground axes.
#[derive(Clone, Copy, Debug, Default)]
pub struct MarkerAcceleration {
    /// Of the origin.
    pub linear: Vector3<f64>,
    /// Of the frame.
    pub angular: Vector3<f64>,
}

/// A marker and its accelerations with derivatives.
#[derive(Clone, Copy)]
struct Accelerated<T, F> {
    frame: F,
    linear: Triple<T>,
    angular: Triple<T>,
}

/// Derivatives by eighteen motions of a body: position and rotation, velocity and angular velocity,
/// acceleration and angular acceleration.
type AccelerationDual = Dual<18>;

impl<'a> Accelerated<AccelerationDual, Seeded<'a>> {
    fn new(m: &'a MarkerFrame, a: &MarkerAcceleration, body: usize) -> Self {
        let frame = Seeded::by(m, body);
        let (omega, alpha) = (m.omega, a.angular);
        // a = a_c + α × ρ + ω × (ω × ρ)
        let by = |k: usize| {
            let e = unit(k);
            match k / 3 {
                1 => {
                    let arm = e.cross(&m.arm);
                    alpha.cross(&arm) + omega.cross(&omega.cross(&arm))
                }
                3 => e.cross(&omega.cross(&m.arm)) + omega.cross(&e.cross(&m.arm)),
                4 => e,
                5 => e.cross(&m.arm),
                _ => Vector3::zeros(),
            }
        };
        let turning = |k: usize| {
            if k / 3 == 5 {
                unit(k)
            } else {
                Vector3::zeros()
            }
        };
        Self {
            linear: frame.vector(&a.linear, by),
            angular: frame.vector(&a.angular, turning),
            frame,
        }
    }
}

fn evaluate_acceleration<T: Scalar, F: Frame<T>>(
    quantity: Quantity,
    [i, j, k, l]: &[Accelerated<T, F>; 4],
) -> T {
    let omega = l.frame.omega();
    let d = i.frame.origin().minus(&j.frame.origin());
    let seen = i.frame.velocity().minus(&j.frame.velocity());
    let two = T::constant(2.0);
    // d'' seen from l: d'' − α × d − 2 ω × (d' − ω × d) − ω × (ω × d)
    let linear = || {
        let drift = omega.cross(&d);
        let coriolis = omega.cross(&seen.minus(&drift)).times(two);
        let relative = i.linear.minus(&j.linear).minus(&l.angular.cross(&d));
        relative.minus(&coriolis).minus(&omega.cross(&drift))
    };
    let angular = || {
        let spin = i.frame.omega().minus(&j.frame.omega());
        i.angular.minus(&j.angular).minus(&omega.cross(&spin))
    };
    match quantity {
        Quantity::Acceleration(axis) => linear().dot(&k.frame.axis(axis)),
        Quantity::AccelerationMagnitude => linear().norm(),
        Quantity::AngularAcceleration(axis) => angular().dot(&k.frame.axis(axis)),
        Quantity::AngularAccelerationMagnitude => angular().norm(),
        _ => evaluate(quantity, [i, j, k, l].map(|m| m.frame)),
    }
}

/// Value of a quantity of acceleration.
#[must_use]
pub fn acceleration(
    quantity: Quantity,
    markers: [&MarkerFrame; 4],
    accelerations: &[MarkerAcceleration; 4],
) -> f64 {
    let made = std::array::from_fn(|n| Accelerated {
        frame: markers[n],
        linear: triple(&accelerations[n].linear),
        angular: triple(&accelerations[n].angular),
    });
    evaluate_acceleration(quantity, &made)
}

/// Slopes of a quantity of acceleration by the eighteen motions of `body`: position and rotation,
/// velocity and angular velocity, acceleration and angular acceleration, along ground axes.
#[must_use]
pub fn acceleration_slopes(
    quantity: Quantity,
    markers: [&MarkerFrame; 4],
    accelerations: &[MarkerAcceleration; 4],
    body: usize,
) -> [f64; 18] {
    let made = std::array::from_fn(|n| {
        Accelerated::<AccelerationDual, _>::new(markers[n], &accelerations[n], body)
    });
    evaluate_acceleration(quantity, &made).slopes
}
