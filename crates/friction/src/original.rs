//! `FORMULATION=ORIGINAL`: friction regime determination and the vector coefficient of friction.
//!
//! # Law
//! With `v = |V|`, `d = |D|`, unit vectors `Vh`, `Dh` and `psi` of [`step`](crate::step):
//! ```text
//! stuck       v <  Vs       beta = psi(v/Vs),  mu1 = mu_s psi(d/Dm)
//!                           mu = -[ beta mu_s Vh + (1 - beta) mu1 Dh ]
//! transition  Vs <= v < cVs mu = -STEP5(v, Vs, mu_s, c Vs, mu_d) Vh      beta = 1, mu1 = 0
//! sliding     v >= c Vs     mu = -mu_d Vh                                beta = 1, mu1 = 0
//! ```
//! It is evaluated as `mu = gain(v) * direction(V, D)` with the one direction
//! `direction = -[psi(v/Vs) Vh + (1 - psi(v/Vs)) psi(d/Dm) Dh]`, `|direction| <= 1`, which is also
//! what a preload follows. For `v >= Vs` the direction is `-Vh` and the creep drops out by itself.
//!
//! | symbol | keyword | field | unit |
//! |---|---|---|---|
//! | `mu_s` | `MU_STATIC` | [`Original::mu_static`] | 1 |
//! | `mu_d` | `MU_DYNAMIC` | [`Original::mu_dynamic`] | 1 |
//! | `Vs` | `STICTION_TRANSITION_VELOCITY` | [`Original::transition_velocity`] | length/time |
//! | `c` | `TRANSITION_VELOCITY_COEFFICIENT` | [`Original::transition_coefficient`] | 1 |
//! | `Dm` | `MAX_STICTION_DEFORMATION` | [`Original::max_deformation`] | length |
//! | | `EFFECT` | [`Original::effect`] | |
//!
//! # Limits
//! * `mu` is twice continuously differentiable in `V` across `Vs` and `c Vs`, and erasing the creep
//!   at `Vs` causes no jump. It has a kink in `V` at rest where `D` is not zero: there the derivatives
//!   returned take zero for the unit vector.
//! * For small motions the joint is a spring of `1.875 mu_s/Dm` and a damper of `1.875 mu_s/Vs` per
//!   unit of load: under a load below the limit it holds with a bounded creep and no drift.
//! * At a constant load friction never gives back more than it took: `-F.V` is at least the rate of
//!   `N mu_s Dm` times the integral of `psi` from 0 to `d/Dm`.
//! * Whatever moves slower than `Vs` counts as stuck.
//!
//! # Source
//! Help page of the `FRICTION` statement for the arguments and regimes; the quintic blend agrees
//! with 2400 samples of Adams Solver C++ 2015.1 to 2e-15. Unknown from any source and therefore our
//! choice: the formulas of `EFFECT=STICTION` and `SLIDING`, and the limit on the creep.

use crate::step::{odd_step, step5};
use crate::vector::{delta, length, length_and_direction, matrix};

/// The frictional effects included (`EFFECT`).
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Effect {
    /// Stiction and sliding: the complete law.
    All,
    /// Stiction only: the stuck law below `Vs`, `mu_s` above; `mu_d` is not used.
    Stiction,
    /// Sliding only: no creep, `-mu_d psi(v/Vs) Vh`; `mu_s` is not used.
    Sliding,
}

/// The friction regime a surface velocity falls into.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Regime {
    /// `v < Vs`: creep and velocity both resist.
    Stuck,
    /// `Vs <= v < c Vs`: from the static to the dynamic coefficient.
    Transition,
    /// `v >= c Vs`, and every velocity where the effect leaves stiction or transition out.
    Sliding,
}

/// Parameters of the original (stick-slip) law. Symbols in the [module](self) documentation.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Original {
    /// Static coefficient `mu_s > 0`.
    pub mu_static: f64,
    /// Dynamic coefficient `mu_d > 0`.
    pub mu_dynamic: f64,
    /// Stiction transition velocity `Vs > 0` at the contact surface, length/time.
    pub transition_velocity: f64,
    /// `c > 1`: sliding is complete at `c Vs`.
    pub transition_coefficient: f64,
    /// Largest creep `Dm > 0`, length.
    pub max_deformation: f64,
    /// Effects included.
    pub effect: Effect,
}

/// The vector coefficient of friction with its derivatives, in the axes of the arguments.
///
/// Matrices are `[row][column]`: row a component of the result, column a component of `V` or `D`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Coefficient<const N: usize> {
    /// Coefficient `mu`, opposing the motion; `|mu| <= max(mu_s, mu_d)`.
    pub mu: [f64; N],
    /// Direction that a preload follows, `|direction| <= 1`.
    pub direction: [f64; N],
    /// Share of the velocity term in the stuck regime; 1 when not stuck.
    pub beta: f64,
    /// Elastic coefficient `mu1 = mu_s psi(d/Dm)` of the creep; 0 when not stuck.
    pub mu1: f64,
    /// Regime of the velocity.
    pub regime: Regime,
    /// `d mu / d V`, time/length.
    pub mu_by_velocity: [[f64; N]; N],
    /// `d mu / d D`, 1/length.
    pub mu_by_creep: [[f64; N]; N],
    /// `d direction / d V`, time/length.
    pub direction_by_velocity: [[f64; N]; N],
    /// `d direction / d D`, 1/length.
    pub direction_by_creep: [[f64; N]; N],
}

impl Original {
    /// Coefficient of friction at the surface velocity `V` (length/time) and creep `D` (length).
    ///
    /// Both are given in the same axes, the velocity of the I part relative to the J part. `N` is 1
    /// for translational and revolute joints, 3 for spherical ones. The creep is used as given,
    /// also beyond `Dm`; it has no effect for `v >= Vs`.
    ///
    /// ```
    /// use friction::{Effect, Original};
    /// let law = Original {
    ///     mu_static: 0.3, mu_dynamic: 0.2, transition_velocity: 0.1,
    ///     transition_coefficient: 1.5, max_deformation: 0.01, effect: Effect::All,
    /// };
    /// let at_rest = law.evaluate(&[0.0], &[0.005]);
    /// assert!((at_rest.mu[0] + 0.237890625).abs() < 1e-15);
    /// ```
    // Inlined, as all that evaluates laws: derivatives that the caller does not read cost nothing then.
    #[inline(always)]
    pub fn evaluate<const N: usize>(
        &self,
        velocity: &[f64; N],
        creep: &[f64; N],
    ) -> Coefficient<N> {
        let along_velocity = Saturated::new(velocity, self.transition_velocity);
        let (speed, unit) = (along_velocity.length, along_velocity.unit);
        let regime = self.regime(speed);
        let blend = match regime {
            Regime::Stuck => {
                Blend::with_creep(along_velocity, &Saturated::new(creep, self.max_deformation))
            }
            Regime::Transition | Regime::Sliding => Blend::without_creep(along_velocity),
        };
        let (gain, gain_slope) = self.gain(speed);
        Coefficient {
            mu: blend.direction.map(|c| gain * c),
            direction: blend.direction,
            beta: blend.beta,
            mu1: self.mu_static * blend.elastic,
            regime,
            mu_by_velocity: matrix(|i, j| {
                gain * blend.by_velocity[i][j] + gain_slope * blend.direction[i] * unit[j]
            }),
            mu_by_creep: matrix(|i, j| gain * blend.by_creep[i][j]),
            direction_by_velocity: blend.by_velocity,
            direction_by_creep: blend.by_creep,
        }
    }

    /// Creep to carry on with after an accepted step, from the creep at its end (length).
    ///
    /// Zero when not stuck (`v >= Vs`, or `EFFECT=SLIDING`): the next stick is anchored where it
    /// begins. Otherwise the creep, its length limited to `Dm` by dragging the anchor along.
    ///
    /// ```
    /// # use friction::{Effect, Original};
    /// # let law = Original {
    /// #     mu_static: 0.3, mu_dynamic: 0.2, transition_velocity: 0.1,
    /// #     transition_coefficient: 1.5, max_deformation: 0.01, effect: Effect::All,
    /// # };
    /// assert_eq!(law.settle(&[0.02], [0.5]), [0.01]);
    /// assert_eq!(law.settle(&[0.1], [0.005]), [0.0]);
    /// ```
    pub fn settle<const N: usize>(&self, velocity: &[f64; N], creep: [f64; N]) -> [f64; N] {
        if self.regime(length(velocity)) != Regime::Stuck {
            return [0.0; N];
        }
        let (creep_length, unit) = length_and_direction(&creep);
        if creep_length > self.max_deformation {
            unit.map(|c| self.max_deformation * c)
        } else {
            creep
        }
    }

    /// Regime at the surface speed `v = |V|` (length/time).
    pub fn regime(&self, speed: f64) -> Regime {
        match self.effect {
            Effect::Sliding => Regime::Sliding,
            _ if speed < self.transition_velocity => Regime::Stuck,
            Effect::All if speed < self.transition_coefficient * self.transition_velocity => {
                Regime::Transition
            }
            _ => Regime::Sliding,
        }
    }

    /// Energy stored in a creep of length `d` by unit of load (length): `mu_s Dm` times the integral of
    /// `psi` from 0 to `d/Dm`.
    ///
    /// It is what the elastic part of the friction gives back when the creep is taken out slowly at
    /// constant load; with it the friction of a stuck joint is passive at constant load, also in
    /// motion. It is lost where the creep is erased.
    ///
    /// ```
    /// # use friction::{Effect, Original};
    /// # let law = Original {
    /// #     mu_static: 0.3, mu_dynamic: 0.2, transition_velocity: 0.1,
    /// #     transition_coefficient: 1.5, max_deformation: 0.01, effect: Effect::All,
    /// # };
    /// assert!((law.creep_energy(0.01) - 0.3 * 0.01 * 0.6875).abs() < 1e-18);
    /// ```
    pub fn creep_energy(&self, creep: f64) -> f64 {
        let s = creep / self.max_deformation;
        let integral = if s < 1.0 {
            let square = s * s;
            square * (15.0 - square * (5.0 - square)) / 16.0
        } else {
            s - 0.3125
        };
        self.mu_static * self.max_deformation * integral
    }

    /// Magnitude that multiplies the direction, and its derivative by the speed.
    #[inline]
    fn gain(&self, speed: f64) -> (f64, f64) {
        match self.effect {
            Effect::Stiction => (self.mu_static, 0.0),
            Effect::Sliding => (self.mu_dynamic, 0.0),
            Effect::All => {
                let vs = self.transition_velocity;
                let step = step5(
                    speed,
                    vs,
                    self.mu_static,
                    self.transition_coefficient * vs,
                    self.mu_dynamic,
                );
                (step.value, step.slope)
            }
        }
    }
}

/// `psi(|x|/scale) xh`: the unit vector of `x`, smooth through zero.
struct Saturated<const N: usize> {
    length: f64,
    unit: [f64; N],
    value: [f64; N],
    /// `psi(|x|/scale)/|x|`: what a change across `x` is multiplied by.
    across: f64,
    /// `psi(|x|/scale)`.
    magnitude: f64,
    /// `1 - psi(|x|/scale)`.
    complement: f64,
    /// `d psi / d |x|`.
    slope: f64,
}

impl<const N: usize> Saturated<N> {
    #[inline(always)]
    fn new(x: &[f64; N], scale: f64) -> Self {
        let (length, unit) = length_and_direction(x);
        let psi = odd_step(length / scale);
        Self {
            length,
            unit,
            value: unit.map(|c| psi.value * c),
            across: psi.ratio / scale,
            magnitude: psi.value,
            complement: psi.complement,
            slope: psi.slope / scale,
        }
    }

    /// Derivative of component `i` of the value by component `j` of `x`.
    #[inline]
    fn derivative(&self, i: usize, j: usize) -> f64 {
        self.across * delta(i, j) + (self.slope - self.across) * self.unit[i] * self.unit[j]
    }
}

/// The direction of friction and its derivatives.
struct Blend<const N: usize> {
    direction: [f64; N],
    by_velocity: [[f64; N]; N],
    by_creep: [[f64; N]; N],
    beta: f64,
    /// `psi(d/Dm)`.
    elastic: f64,
}

impl<const N: usize> Blend<N> {
    #[inline(always)]
    fn with_creep(velocity: Saturated<N>, creep: &Saturated<N>) -> Self {
        Self {
            direction: core::array::from_fn(|i| {
                -(velocity.value[i] + velocity.complement * creep.value[i])
            }),
            by_velocity: matrix(|i, j| {
                velocity.slope * creep.value[i] * velocity.unit[j] - velocity.derivative(i, j)
            }),
            by_creep: matrix(|i, j| -velocity.complement * creep.derivative(i, j)),
            beta: velocity.magnitude,
            elastic: creep.magnitude,
        }
    }

    #[inline(always)]
    fn without_creep(velocity: Saturated<N>) -> Self {
        Self {
            direction: velocity.value.map(|c| -c),
            by_velocity: matrix(|i, j| -velocity.derivative(i, j)),
            by_creep: [[0.0; N]; N],
            beta: 1.0,
            elastic: 0.0,
        }
    }
}
