//! `FORMULATION=LUGRE`: the bristle model of Canudas de Wit, Olsson, Åström and Lischinsky (1995).
//!
//! # Law
//! In surface variables, for one, two or three components alike, with `v = |V|`:
//! ```text
//! F    = -(s0 z + s1 z' + s2 V)                              friction on I, component by component
//! z'   = V - s0 v z / G                                      bristle deflection
//! G    = g(v) N + P
//! g(v) = mu_d + (mu_s - mu_d) exp(-(v/vs)^delta)             Stribeck curve
//! ```
//! A turning joint has `V = R omega`, `N = T/R` and `P = TP/R` with its arm `R`, and the torque is
//! `R F`: these are equations (4) to (6) of the statement's page with `z` the deflection at the arm.
//!
//! The deflection is a state. An implicit formula gives it as `z = z_past + gamma z'` at the end of
//! a step, which is linear in `z` and solved here in closed form,
//! ```text
//! z = (z_past + gamma V) G / (G + gamma s0 v),   z' = (V G - s0 v z_past) / (G + gamma s0 v)
//! ```
//! stable for every `gamma >= 0`, however stiff the bristles. `gamma = 0` gives the law at an
//! instant with `z = z_past`.
//!
//! | symbol | keyword | field | unit |
//! |---|---|---|---|
//! | `mu_s`, `mu_d` | `MU_STATIC`, `MU_DYNAMIC` | [`LuGre::mu_static`], [`LuGre::mu_dynamic`] | 1 |
//! | `s0` | `BRISTLE_STIFFNESS_COEFFICIENT` | [`LuGre::bristle_stiffness`] | force/length |
//! | `s1` | `DAMPING_COEFFICIENT` | [`LuGre::damping`] | force time/length |
//! | `s2` | `VISCOUS_FRICTION_COEFFICIENT` | [`LuGre::viscous`] | force time/length |
//! | `vs` | `VELOCITY_THRESHOLD_STRIBECK` | [`LuGre::stribeck_velocity`] | length/time |
//! | `delta` | `DECAY_EXPONENT_STRIBECK` | [`LuGre::stribeck_exponent`] | 1 |
//! | `N`, `P` | | effective load and preload at the surface | force |
//!
//! # Limits
//! * Loads below the limit that come and go make the joint drift: a cycle from zero to `a mu_s N`
//!   and back moves it by `-(mu_s N/s0) ln(1 - a^2)`. The original formulation does not drift.
//! * `s0` does not scale with the load, so that `z` may exceed `G/s0` after the load has dropped;
//!   it decays as the surfaces move.
//! * The friction takes energy out at every instant only where `s1 < 4 G/v` (Åström and Canudas de
//!   Wit 2008); [`LuGre::passive_speed`] is the speed up to which that holds.
//! * In slip `z` decays at the rate `s0 v/G`, which may be 1e5 per unit of time and more.
//!
//! # Source
//! Help page of the `FRICTION` statement, section "LuGre Formulation". The page gives one
//! dimension; the vector form, the preload in the level and `N` as the effective load of the
//! original formulation are our choice.

use crate::original::Regime;
use crate::vector::{delta, length_and_direction, natural_exp, power};

/// Parameters of the LuGre law. Symbols in the [module](self) documentation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LuGre {
    /// Static coefficient `mu_s > 0`.
    pub mu_static: f64,
    /// Dynamic coefficient `mu_d > 0`.
    pub mu_dynamic: f64,
    /// Bristle stiffness `s0 > 0`, force/length.
    pub bristle_stiffness: f64,
    /// Bristle damping `s1 >= 0`, force * time/length.
    pub damping: f64,
    /// Viscous coefficient `s2 >= 0`, force * time/length.
    pub viscous: f64,
    /// Stribeck velocity `vs > 0` at the contact surface, length/time.
    pub stribeck_velocity: f64,
    /// Stribeck exponent `delta > 0`.
    pub stribeck_exponent: f64,
}

/// Friction of the bristles with its derivatives, in the axes of the velocity.
///
/// Matrices are `[row][column]`: row a component of the result, column a component of `V`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Bristles<const N: usize> {
    /// Surface force on the I part, force.
    pub force: [f64; N],
    /// Deflection `z`, length.
    pub deflection: [f64; N],
    /// Rate `z'` of the deflection, length/time.
    pub rate: [f64; N],
    /// Stribeck coefficient `g(v)`: friction by load in steady motion, without the viscous part.
    pub coefficient: f64,
    /// `d force / d V` at the given past deflection, force * time/length.
    pub by_velocity: [[f64; N]; N],
    /// `d force / d N`.
    pub by_load: [f64; N],
}

impl LuGre {
    /// Friction at the surface velocity `V` (length/time, I relative to J) and the effective load
    /// `load >= 0` (force at the surface) after a step of the formula `z = past + gamma z'`.
    ///
    /// `past` is the past of the formula (length) and `gamma` its factor (time): for a step `h` of
    /// the backward Euler formula the last deflection and `h`, for an instant the deflection itself
    /// and zero. `preload` (force at the surface) adds to the level of each component. A level
    /// below `least > 0` counts as `least`, so that the law stays defined without load.
    ///
    /// ```
    /// use friction::LuGre;
    /// let law = LuGre {
    ///     mu_static: 1.5, mu_dynamic: 1.0, bristle_stiffness: 1e5, damping: 300.0, viscous: 0.4,
    ///     stribeck_velocity: 1e-3, stribeck_exponent: 2.0,
    /// };
    /// // A long step in steady motion ends on the Stribeck curve: 1.0 + 0.5 exp(-1) + 0.4e-3.
    /// let steady = law.evaluate(&[1e-3], &[0.0], 1e6, 1.0, &[0.0], 1e-12);
    /// assert!((steady.force[0] + 1.18433972).abs() < 1e-8);
    /// ```
    #[inline]
    pub fn evaluate<const N: usize>(
        &self,
        velocity: &[f64; N],
        past: &[f64; N],
        gamma: f64,
        load: f64,
        preload: &[f64; N],
        least: f64,
    ) -> Bristles<N> {
        let (speed, unit) = length_and_direction(velocity);
        let (coefficient, slope) = self.stribeck(speed);
        let (s0, s1, s2) = (self.bristle_stiffness, self.damping, self.viscous);
        let mut level = [0.0; N];
        // Derivatives of the level by the load and by the speed; zero where it is held up.
        let (mut by_load, mut by_speed) = ([0.0; N], [0.0; N]);
        for k in 0..N {
            let free = coefficient * load + preload[k];
            level[k] = free.max(least);
            if free > least {
                by_load[k] = coefficient;
                by_speed[k] = slope * load;
            }
        }
        let factor = gamma * s0;
        let mut bristles = Bristles {
            force: [0.0; N],
            deflection: [0.0; N],
            rate: [0.0; N],
            coefficient,
            by_velocity: [[0.0; N]; N],
            by_load: [0.0; N],
        };
        for k in 0..N {
            let divisor = level[k] + factor * speed;
            let inverse = 1.0 / divisor;
            // A quotient, not a product: exactly one at rest, where the bristles must not creep.
            let share = level[k] / divisor;
            let reach = past[k] + gamma * velocity[k];
            let z = reach * share;
            let rate = velocity[k] * share - past[k] * (s0 * speed * inverse);
            bristles.deflection[k] = z;
            bristles.rate[k] = rate;
            bristles.force[k] = -(s0 * z + s1 * rate + s2 * velocity[k]);
            let z_by_level = reach - z;
            let rate_by_level = velocity[k] - rate;
            let by_level = -(s0 * z_by_level + s1 * rate_by_level) * inverse;
            bristles.by_load[k] = by_load[k] * by_level;
            // The velocity acts by its own component, and by the speed on level and decay.
            let own = -(factor + s1) * share - s2;
            let decay = (s0 * gamma * z + s1 * (past[k] + gamma * rate)) * s0 * inverse;
            let by_velocity = by_speed[k] * by_level + decay;
            for j in 0..N {
                bristles.by_velocity[k][j] = own * delta(k, j) + by_velocity * unit[j];
            }
        }
        bristles
    }

    /// The Stribeck curve `g(v)` at the surface speed `v` (length/time), and its slope.
    ///
    /// The slope is zero at rest, where it does not exist for exponents of one and less.
    #[inline]
    pub fn stribeck(&self, speed: f64) -> (f64, f64) {
        let ratio = speed / self.stribeck_velocity;
        let decay = power(ratio, self.stribeck_exponent);
        let part = (self.mu_static - self.mu_dynamic) * natural_exp(-decay);
        let slope = if speed > 0.0 && part != 0.0 {
            -part * self.stribeck_exponent * decay / speed
        } else {
            0.0
        };
        (self.mu_dynamic + part, slope)
    }

    /// Regime at the surface speed `v` (length/time), to tell what a joint does: stuck below the
    /// Stribeck velocity, sliding where less than a twentieth of the Stribeck effect is left.
    pub fn regime(&self, speed: f64) -> Regime {
        let ratio = speed / self.stribeck_velocity;
        if ratio < 1.0 {
            Regime::Stuck
        } else if power(ratio, self.stribeck_exponent) < 3.0 {
            Regime::Transition
        } else {
            Regime::Sliding
        }
    }

    /// Speed up to which the map from velocity to friction is passive at the `level` `G` (force at
    /// the surface): `4 G/s1`, infinite without damping.
    pub fn passive_speed(&self, level: f64) -> f64 {
        if self.damping > 0.0 {
            4.0 * level / self.damping
        } else {
            f64::INFINITY
        }
    }
}
