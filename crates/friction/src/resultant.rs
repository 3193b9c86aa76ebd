//! Friction force or torque from coefficient or bristles, load, preload and limit.
//!
//! # Law
//! ```text
//! ORIGINAL   F = clip(N mu, MAX) + P direction          clip(x, MAX) = x min(1, MAX/|x|)
//! LUGRE      F = clip(R (surface force of the bristles), MAX + P)
//! ```
//! | symbol | keyword | unit (translational / rotational) |
//! |---|---|---|
//! | `N` | effective load of the [joint](crate::joint) | force / torque |
//! | `P` | `FRICTION_FORCE_PRELOAD` / `FRICTION_TORQUE_PRELOAD` | force / torque |
//! | `MAX` | `MAX_FRICTION_FORCE` / `MAX_FRICTION_TORQUE` | force / torque |
//! | `R` | arm from surface to axis; one for sliding | 1 / length |
//!
//! A cylindrical joint has a force and a torque from one coefficient or one set of bristles, each
//! with a preload and a limit of its own.
//!
//! # Limits
//! The preload is a friction of its own, not multiplied by the coefficient; the total never exceeds
//! `P + MAX`. The coefficient itself is reported unclipped. `F` has a kink where the clip begins.
//! The bristles' preload is part of their level, see [`lugre`](crate::lugre).
//!
//! # Source
//! The help page says that with a preload the limit becomes `PRELOAD + MAX`, which is this sum. The
//! direction of the preload in the stuck regime is our choice: no source gives it.

use core::ops::Range;

use crate::lugre::Bristles;
use crate::original::Coefficient;
use crate::vector::length;

/// Friction on the I part with its derivatives; matrices are `[row][column]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Resultant<const N: usize> {
    /// Friction on the I part in the axes of the velocity: a force for translational joints, a
    /// torque for rotational ones, force and torque for cylindrical ones. One component means along
    /// or about the axis of the joint.
    pub force: [f64; N],
    /// Derivative by the load, as the joint's [`Load`](crate::Load) gives it.
    pub by_load: [f64; N],
    /// Derivative by the surface velocity.
    pub by_velocity: [[f64; N]; N],
    /// Derivative by the creep; zero for bristles, whose past deflection is given.
    pub by_creep: [[f64; N]; N],
    /// Whether a limit is active.
    pub clipped: bool,
}

impl<const N: usize> Resultant<N> {
    const ZERO: Self = Self {
        force: [0.0; N],
        by_load: [0.0; N],
        by_velocity: [[0.0; N]; N],
        by_creep: [[0.0; N]; N],
        clipped: false,
    };

    /// Limits the length of the components in `group` to `maximum`. Returns whether it did.
    #[inline(always)]
    fn clip(&mut self, group: Range<usize>, maximum: f64) -> bool {
        let mut part = [0.0; N];
        part[group.clone()].copy_from_slice(&self.force[group.clone()]);
        let magnitude = length(&part);
        let clips = magnitude > maximum;
        if clips {
            self.shorten(group, &part, magnitude, maximum);
        }
        clips
    }

    /// Gives `part`, the components in `group`, the length `maximum` instead of `magnitude`. A clipped
    /// vector keeps its direction only: the part of a derivative along it is taken out.
    #[inline(always)]
    fn shorten(&mut self, group: Range<usize>, part: &[f64; N], magnitude: f64, maximum: f64) {
        self.clipped = true;
        let unit = part.map(|c| c / magnitude);
        let scale = maximum / magnitude;
        let clip = |column: &mut [f64; N]| {
            let along: f64 = group.clone().map(|k| unit[k] * column[k]).sum();
            for k in group.clone() {
                column[k] = scale * (column[k] - along * unit[k]);
            }
        };
        for k in group.clone() {
            self.force[k] *= scale;
        }
        clip(&mut self.by_load);
        for matrix in [&mut self.by_velocity, &mut self.by_creep] {
            for j in 0..N {
                let mut column = core::array::from_fn(|k| matrix[k][j]);
                clip(&mut column);
                for k in group.clone() {
                    matrix[k][j] = column[k];
                }
            }
        }
    }

    /// Sets the components in `group` from a coefficient.
    #[inline(always)]
    fn take(
        &mut self,
        c: &Coefficient<N>,
        group: Range<usize>,
        factor: f64,
        load: f64,
        preload: f64,
        maximum: f64,
    ) {
        let load = factor * load;
        for k in group.clone() {
            self.force[k] = load * c.mu[k];
            self.by_load[k] = factor * c.mu[k];
            for j in 0..N {
                self.by_velocity[k][j] = load * c.mu_by_velocity[k][j];
                self.by_creep[k][j] = load * c.mu_by_creep[k][j];
            }
        }
        if self.clip(group.clone(), maximum) {
            // The load stretches the vector only: exactly, not but for rounding.
            self.by_load[group.clone()].fill(0.0);
        }
        for k in group {
            self.force[k] += preload * c.direction[k];
            for j in 0..N {
                self.by_velocity[k][j] += preload * c.direction_by_velocity[k][j];
                self.by_creep[k][j] += preload * c.direction_by_creep[k][j];
            }
        }
    }
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
#[inline(always)]
pub fn resultant<const N: usize>(
    c: &Coefficient<N>,
    load: f64,
    preload: f64,
    maximum: f64,
) -> Resultant<N> {
    let mut friction = Resultant::ZERO;
    friction.take(c, 0..N, 1.0, load, preload, maximum);
    friction
}

/// Friction force and torque of a cylindrical joint from the coefficient `c` of the surface velocity
/// `(DZ', Rp theta')`, the `load` (force), and preload and limit of force and torque.
///
/// ```
/// use friction::{Effect, Original, cylindrical_resultant};
/// # let law = Original {
/// #     mu_static: 0.3, mu_dynamic: 0.2, transition_velocity: 0.1,
/// #     transition_coefficient: 1.5, max_deformation: 0.01, effect: Effect::All,
/// # };
/// let c = law.evaluate(&[3.0, -4.0], &[0.0, 0.0]);
/// let friction = cylindrical_resultant(&c, 100.0, 0.05, [0.0, 0.0], [1e40, 1e40]);
/// assert!((friction.force[0] + 12.0).abs() < 1e-13); // 0.2 * 100 * 3/5
/// assert!((friction.force[1] - 0.8).abs() < 1e-13); // 0.05 * 0.2 * 100 * 4/5
/// ```
#[inline(always)]
pub fn cylindrical_resultant(
    c: &Coefficient<2>,
    load: f64,
    pin_radius: f64,
    preload: [f64; 2],
    maximum: [f64; 2],
) -> Resultant<2> {
    let mut friction = Resultant::ZERO;
    friction.take(c, 0..1, 1.0, load, preload[0], maximum[0]);
    friction.take(c, 1..2, pin_radius, load, preload[1], maximum[1]);
    friction
}

/// Friction of bristles at the `arm` from the axis (one for sliding), limited to `limit`, which is
/// `MAX + P` in the unit of the result. The load of the derivative is that of the joint, `arm` times
/// the load at the surface.
///
/// ```
/// # use friction::{LuGre, bristle_resultant};
/// # let law = LuGre {
/// #     mu_static: 0.3, mu_dynamic: 0.2, bristle_stiffness: 1e5, damping: 0.0, viscous: 0.0,
/// #     stribeck_velocity: 1e-3, stribeck_exponent: 2.0,
/// # };
/// let bristles = law.evaluate(&[0.5], &[0.0], 1e6, 100.0, &[0.0], 1e-9);
/// let torque = bristle_resultant(&bristles, 0.05, 1e40).force[0];
/// assert!((torque + 1.0).abs() < 1e-6); // 0.05 * 0.2 * 100
/// ```
#[inline(always)]
pub fn bristle_resultant<const N: usize>(
    bristles: &Bristles<N>,
    arm: f64,
    limit: f64,
) -> Resultant<N> {
    let mut friction = Resultant {
        force: bristles.force.map(|f| arm * f),
        by_load: bristles.by_load,
        by_velocity: bristles.by_velocity.map(|row| row.map(|f| arm * f)),
        ..Resultant::ZERO
    };
    friction.clip(0..N, limit);
    friction
}

/// Friction force and torque of the bristles of a cylindrical joint, whose surface velocity is
/// `(DZ', Rp theta')`, with the limits `MAX + P` of force and torque.
///
/// ```
/// # use friction::{LuGre, cylindrical_bristle_resultant};
/// # let law = LuGre {
/// #     mu_static: 0.3, mu_dynamic: 0.2, bristle_stiffness: 1e5, damping: 0.0, viscous: 0.0,
/// #     stribeck_velocity: 1e-3, stribeck_exponent: 2.0,
/// # };
/// let bristles = law.evaluate(&[3.0, -4.0], &[0.0; 2], 1e6, 100.0, &[0.0; 2], 1e-9);
/// let friction = cylindrical_bristle_resultant(&bristles, 0.05, [10.0, 1e40]);
/// assert_eq!(friction.force[0], -10.0); // limited from 12
/// assert!((friction.force[1] - 0.8).abs() < 1e-6);
/// ```
#[inline(always)]
pub fn cylindrical_bristle_resultant(
    bristles: &Bristles<2>,
    pin_radius: f64,
    limit: [f64; 2],
) -> Resultant<2> {
    let arms = [1.0, pin_radius];
    let mut friction = Resultant {
        force: core::array::from_fn(|k| arms[k] * bristles.force[k]),
        by_load: core::array::from_fn(|k| arms[k] * bristles.by_load[k]),
        by_velocity: core::array::from_fn(|k| bristles.by_velocity[k].map(|f| arms[k] * f)),
        ..Resultant::ZERO
    };
    friction.clip(0..1, limit[0]);
    friction.clip(1..2, limit[1]);
    friction
}
