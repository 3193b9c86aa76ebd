//! Friction force or torque from coefficient, load, preload and limit.
//!
//! # Law
//! ```text
//! F = clip(N mu, MAX) + P direction        |clip(x, MAX)| = min(|x|, MAX)
//! ```
//! | symbol | keyword | unit (translational / rotational) |
//! |---|---|---|
//! | `N` | effective load of the [joint](crate::joint) | force / torque |
//! | `P` | `FRICTION_FORCE_PRELOAD` / `FRICTION_TORQUE_PRELOAD` | force / torque |
//! | `MAX` | `MAX_FRICTION_FORCE` / `MAX_FRICTION_TORQUE` | force / torque |
//!
//! # Limits
//! The preload is a friction of its own, not multiplied by the coefficient; the total never exceeds
//! `P + MAX`. The coefficient itself is reported unclipped. `F` has a kink where the clip begins.
//!
//! # Source
//! The help page says that with a preload the limit becomes `PRELOAD + MAX`, which is this sum. The
//! direction of the preload in the stuck regime is our choice: no source gives it.

use crate::original::Coefficient;
use crate::vector::{length_and_direction, matrix};

/// Friction on the I part with its derivatives; matrices are `[row][column]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resultant<const N: usize> {
    /// Friction force (translational) or torque (revolute, spherical) on the I part, in the axes
    /// of the velocity. One component means along or about the z axis of the J marker.
    pub force: [f64; N],
    /// Derivative by the load; dimensionless.
    pub by_load: [f64; N],
    /// Derivative by the surface velocity.
    pub by_velocity: [[f64; N]; N],
    /// Derivative by the creep.
    pub by_creep: [[f64; N]; N],
    /// Whether the limit is active.
    pub clipped: bool,
}

/// Friction from the coefficient `c`, the `load >= 0`, the `preload >= 0` and the `maximum > 0`.
///
/// `load`, `preload` and `maximum` share one unit: force for translational, torque for rotational
/// joints, whose load already contains the arms. Give a preload of zero where `INPUTS` leaves
/// `PRELOAD` out.
///
/// ```
/// use friction::{Effect, Original, resultant};
/// # let law = Original {
/// #     mu_static: 0.3, mu_dynamic: 0.2, transition_velocity: 0.1,
/// #     transition_coefficient: 1.5, max_deformation: 0.01, effect: Effect::All,
/// # };
/// let friction = resultant(&law.evaluate(&[-1.0], &[0.0]), 100.0, 5.0, 8.0);
/// assert_eq!(friction.force, [13.0]); // limit 8 plus preload 5, against the motion
/// assert!(friction.clipped);
/// ```
pub fn resultant<const N: usize>(
    c: &Coefficient<N>,
    load: f64,
    preload: f64,
    maximum: f64,
) -> Resultant<N> {
    let (mu, unit) = length_and_direction(&c.mu);
    let clipped = load * mu > maximum;
    let (scale, by_load) = if clipped {
        (maximum / mu, [0.0; N])
    } else {
        (load, c.mu)
    };
    // A clipped force keeps its direction only: the part of a derivative along it is taken out.
    let of_load = |derivative: &[[f64; N]; N], i: usize, j: usize| {
        let along = if clipped {
            unit[i] * (0..N).map(|k| unit[k] * derivative[k][j]).sum::<f64>()
        } else {
            0.0
        };
        scale * (derivative[i][j] - along)
    };
    Resultant {
        force: core::array::from_fn(|i| scale * c.mu[i] + preload * c.direction[i]),
        by_load,
        by_velocity: matrix(|i, j| {
            of_load(&c.mu_by_velocity, i, j) + preload * c.direction_by_velocity[i][j]
        }),
        by_creep: matrix(|i, j| {
            of_load(&c.mu_by_creep, i, j) + preload * c.direction_by_creep[i][j]
        }),
        clipped,
    }
}
