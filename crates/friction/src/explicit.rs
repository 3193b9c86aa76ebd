//! Friction for simulators that step explicitly: a law, a joint's load and the state between steps.
//!
//! A [`Stepper`] is called once a step with the joint's relative velocity and its reaction, and
//! returns friction on the I part. It holds the only thing that friction has to remember: the
//! creep of the original law, or the deflection of the bristles. Four names, one for each geometry:
//!
//! | joint | name | velocity | friction |
//! |---|---|---|---|
//! | translational | [`TranslationalStepper`] | along `z_J` | force |
//! | revolute, each pin of a hooke or universal | [`RevoluteStepper`] | rate about the pin | torque |
//! | cylindrical | [`CylindricalStepper`] | along and about `z_J` | force and torque |
//! | spherical | [`SphericalStepper`] | rate, 3-vector along the axes of J | torque, same axes |
//!
//! # Law
//! With the velocity `V` of the surfaces at the step `h` and the state of the step before:
//! ```text
//! ORIGINAL   D = D_before + h V, friction at (V, D), then D is settled
//! LUGRE      z = z_before + h z'(V, z), solved in closed form, friction at (V, z)
//! ```
//! Both are the backward Euler formula in the state, first order in `h`. The state never grows
//! without bound for any step: creep is at most `Dm`, and the bristles' part `s0 z` at most the
//! largest level met so far, also where `s0 v/G` times the step is a million.
//!
//! # Limits
//! That is the state. The *mass* on the bristles or on the creep is integrated by the caller, and a
//! fully explicit caller must resolve their spring and damper: for a mass `m` the step has to stay
//! below about `2 m/c` with `c = s1 + s2 + h s0` for LuGre and `c = 1.875 mu_s N (1/Vs + h/Dm)` for
//! the original law. A caller who cannot uses [`Resultant::by_velocity`], which is this `c` (with
//! its sign and arm) at the step, and solves `(m - h F_v) dv = h F` instead of `m dv = h F`. Then
//! every step is stable.
//!
//! Reactions of the step before may be used: the result is of first order like the step itself,
//! as long as friction changes the reaction by less than the reaction changes friction (gain below
//! one).
//!
//! # Source
//! The formulas are those of [`original`](crate::original), [`lugre`](crate::lugre) and
//! [`joint`](crate::joint). That bristles need their rate to be taken implicitly in slip is the point
//! of Do, Ferri and Bauchau (2007).

use crate::joint::{CylindricalLoad, RevoluteLoad, SphericalLoad, TranslationalLoad};
use crate::law::{ForceAndTorque, Law};
use crate::lugre::Bristles;
use crate::original::Coefficient;
use crate::resultant::{
    Resultant, bristle_resultant, cylindrical_bristle_resultant, cylindrical_resultant, resultant,
};

/// Level, as a force, that bristles without load count with: it keeps the law defined and is
/// beneath notice.
const LEAST_LEVEL: f64 = 1e-12;

/// Friction of one joint, carried from step to step. `L` is the joint's load, `N` the number of
/// freedoms of its surfaces.
///
/// Law, load, preload and limits are parameters, which may change between steps.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Stepper<L, const N: usize> {
    /// The law.
    pub law: Law,
    /// The joint's load.
    pub load: L,
    /// Preloads, zero at first; they count where the load's `INPUTS` have `PRELOAD`.
    pub preload: ForceAndTorque,
    /// Limits without the preload, 1e40 at first.
    pub maximum: ForceAndTorque,
    /// Creep or deflection.
    state: [f64; N],
}

/// Friction of a translational joint.
pub type TranslationalStepper = Stepper<TranslationalLoad, 1>;
/// Friction of a revolute joint, or of one pin of a hooke or universal joint.
pub type RevoluteStepper = Stepper<RevoluteLoad, 1>;
/// Friction of a cylindrical joint.
pub type CylindricalStepper = Stepper<CylindricalLoad, 2>;
/// Friction of a spherical joint.
pub type SphericalStepper = Stepper<SphericalLoad, 3>;

impl<L, const N: usize> Stepper<L, N> {
    /// Friction at rest with a creep or deflection of zero, without preload and limit.
    pub fn new(law: Law, load: L) -> Self {
        Self {
            law,
            load,
            preload: ForceAndTorque {
                force: 0.0,
                torque: 0.0,
            },
            maximum: ForceAndTorque {
                force: 1e40,
                torque: 1e40,
            },
            state: [0.0; N],
        }
    }

    /// The creep of the original law or the deflection of the bristles: a length at the surfaces
    /// for each freedom, in the axes of the velocity.
    pub fn state(&self) -> [f64; N] {
        self.state
    }

    /// Goes on from another state, such as one kept before a step that is done again.
    pub fn set_state(&mut self, state: [f64; N]) {
        self.state = state;
    }

    /// One step `dt` at the surface velocity, with load and preload at the surface; `original` and
    /// `bristles` put the friction together.
    fn advance(
        &mut self,
        velocity: [f64; N],
        dt: f64,
        load: f64,
        preload: [f64; N],
        original: impl Fn(&Coefficient<N>) -> Resultant<N>,
        bristles: impl Fn(&Bristles<N>) -> Resultant<N>,
    ) -> Resultant<N> {
        match &self.law {
            Law::Original(law) => {
                let creep = core::array::from_fn(|k| self.state[k] + dt * velocity[k]);
                let mut friction = original(&law.evaluate(&velocity, &creep));
                // The creep at the end of the step follows the velocity.
                for (row, by_creep) in friction.by_velocity.iter_mut().zip(friction.by_creep) {
                    for (by_velocity, by_creep) in row.iter_mut().zip(by_creep) {
                        *by_velocity += dt * by_creep;
                    }
                }
                self.state = law.settle(&velocity, creep);
                friction
            }
            Law::LuGre(law) => {
                let b = law.evaluate(&velocity, &self.state, dt, load, &preload, LEAST_LEVEL);
                self.state = b.deflection;
                bristles(&b)
            }
        }
    }
}

impl TranslationalStepper {
    /// Force along `z_J` on the I part over a step `dt`.
    ///
    /// `velocity` and `displacement` are those of I relative to J along `z_J` (the displacement since
    /// assembly counts with `OVERLAP_DELTA` only), `force` and `moment` the joint's reaction on I at I
    /// in J axes, friction excluded. [`Resultant::by_velocity`] is force by velocity.
    ///
    /// ```
    /// use friction::Law;
    /// use friction::explicit::TranslationalStepper;
    /// use friction::{Inputs, LuGre, TranslationalLoad};
    /// let law = LuGre {
    ///     mu_static: 0.3, mu_dynamic: 0.2, bristle_stiffness: 1e5, damping: 300.0, viscous: 0.0,
    ///     stribeck_velocity: 1e-3, stribeck_exponent: 2.0,
    /// };
    /// let guide = TranslationalLoad {
    ///     inputs: Inputs::ALL, reaction_arm: 1.0, bending_factor: 1.0,
    ///     initial_overlap: 1.0, overlap_sign: 0.0,
    /// };
    /// let mut friction = TranslationalStepper::new(Law::LuGre(law), guide);
    /// // A block of 1 kg slides at 1 m/s; steps of a millisecond.
    /// let mut velocity = 1.0;
    /// for _ in 0..1000 {
    ///     let f = friction.step(velocity, 0.0, [0.0, 9.81, 0.0], [0.0; 3], 1e-3);
    ///     velocity += 1e-3 * f.force[0] / (1.0 - 1e-3 * f.by_velocity[0][0]);
    /// }
    /// assert!(velocity.abs() < 1e-6); // stopped after 1/(0.2 * 9.81) = 0.51 s
    /// ```
    pub fn step(
        &mut self,
        velocity: f64,
        displacement: f64,
        force: [f64; 3],
        moment: [f64; 3],
        dt: f64,
    ) -> Resultant<1> {
        let load = self.load.evaluate(force, moment, displacement).value;
        let preload = self.load.inputs.preloaded(self.preload.force);
        let maximum = self.maximum.force;
        self.advance(
            [velocity],
            dt,
            load,
            [preload],
            |c| resultant(c, load, preload, maximum),
            |b| bristle_resultant(b, 1.0, preload + maximum),
        )
    }
}

impl RevoluteStepper {
    /// Torque about the pin on the I part over a step `dt`.
    ///
    /// `rate` is the angular rate of I relative to J about the pin; `force` and `moment` are the
    /// joint's reaction on I at I, friction excluded, along axes whose z is the pin.
    /// [`Resultant::by_velocity`] is torque by *surface* velocity: times [`RevoluteLoad::pin_radius`] it
    /// is torque by rate.
    ///
    /// ```
    /// use friction::Law;
    /// use friction::explicit::RevoluteStepper;
    /// use friction::{Effect, Inputs, Original, RevoluteLoad};
    /// let law = Original {
    ///     mu_static: 0.3, mu_dynamic: 0.2, transition_velocity: 1e-3,
    ///     transition_coefficient: 1.5, max_deformation: 1e-5, effect: Effect::All,
    /// };
    /// let pin = RevoluteLoad {
    ///     inputs: Inputs::ALL, pin_radius: 0.05, friction_arm: 0.08, bending_reaction_arm: 1.0,
    /// };
    /// let mut friction = RevoluteStepper::new(Law::Original(law), pin);
    /// // Sliding: 0.2 * (0.05 * 50 + 0.08 * 10).
    /// let torque = friction.step(2.0, [30.0, 40.0, 10.0], [0.0; 3], 1e-3);
    /// assert!((torque.force[0] + 0.66).abs() < 1e-12);
    /// ```
    pub fn step(&mut self, rate: f64, force: [f64; 3], moment: [f64; 3], dt: f64) -> Resultant<1> {
        let load = self.load.evaluate(force, moment).value;
        let arm = self.load.pin_radius;
        let preload = self.load.inputs.preloaded(self.preload.torque);
        let maximum = self.maximum.torque;
        self.advance(
            [arm * rate],
            dt,
            load / arm,
            [preload / arm],
            |c| resultant(c, load, preload, maximum),
            |b| bristle_resultant(b, arm, preload + maximum),
        )
    }
}

impl CylindricalStepper {
    /// Force along and torque about `z_J` on the I part over a step `dt`.
    ///
    /// `velocity`, `displacement` and `rate` are those of I relative to J along and about `z_J`, `force`
    /// and `moment` the joint's reaction on I at I in J axes, friction excluded.
    /// [`Resultant::by_velocity`] has columns for the velocity and for `Rp` times the rate.
    ///
    /// ```
    /// use friction::Law;
    /// use friction::explicit::CylindricalStepper;
    /// use friction::{CylindricalLoad, Effect, Inputs, Original};
    /// let law = Original {
    ///     mu_static: 0.2, mu_dynamic: 0.2, transition_velocity: 1e-3,
    ///     transition_coefficient: 1.5, max_deformation: 1e-5, effect: Effect::All,
    /// };
    /// let sleeve = CylindricalLoad {
    ///     inputs: Inputs::ALL, pin_radius: 0.05, bending_factor: 1.0,
    ///     initial_overlap: 1.0, overlap_sign: 0.0,
    /// };
    /// let mut friction = CylindricalStepper::new(Law::Original(law), sleeve);
    /// // 3 along and 4 around at the surface share 0.2 * 50.
    /// let f = friction.step(3.0, 0.0, 80.0, [50.0, 0.0, 0.0], [0.0; 3], 1e-3).force;
    /// assert!((f[0] + 6.0).abs() < 1e-12 && (f[1] + 0.05 * 8.0).abs() < 1e-12);
    /// ```
    pub fn step(
        &mut self,
        velocity: f64,
        displacement: f64,
        rate: f64,
        force: [f64; 3],
        moment: [f64; 3],
        dt: f64,
    ) -> Resultant<2> {
        let load = self.load.evaluate(force, moment, displacement).value;
        let arm = self.load.pin_radius;
        let preloaded = |preload| self.load.inputs.preloaded(preload);
        let preload = [
            preloaded(self.preload.force),
            preloaded(self.preload.torque),
        ];
        let maximum = [self.maximum.force, self.maximum.torque];
        let limit = [preload[0] + maximum[0], preload[1] + maximum[1]];
        self.advance(
            [velocity, arm * rate],
            dt,
            load,
            [preload[0], preload[1] / arm],
            |c| cylindrical_resultant(c, load, arm, preload, maximum),
            |b| cylindrical_bristle_resultant(b, arm, limit),
        )
    }
}

impl SphericalStepper {
    /// Torque on the I part over a step `dt`, along the axes of J.
    ///
    /// `rate` is the angular velocity of I relative to J along the axes of J, `force` the joint's
    /// reaction on I in any axes. [`Resultant::by_velocity`] is torque by surface velocity.
    ///
    /// ```
    /// use friction::Law;
    /// use friction::explicit::SphericalStepper;
    /// use friction::{Effect, Inputs, Original, SphericalLoad};
    /// let law = Original {
    ///     mu_static: 0.1, mu_dynamic: 0.1, transition_velocity: 1e-3,
    ///     transition_coefficient: 1.5, max_deformation: 1e-5, effect: Effect::All,
    /// };
    /// let ball = SphericalLoad { inputs: Inputs::ALL, ball_radius: 0.02 };
    /// let mut friction = SphericalStepper::new(Law::Original(law), ball);
    /// let torque = friction.step([3.0, 0.0, -4.0], [0.0, 100.0, 0.0], 1e-3).force;
    /// assert!((torque[0] + 0.12).abs() < 1e-12 && (torque[2] - 0.16).abs() < 1e-12);
    /// ```
    pub fn step(&mut self, rate: [f64; 3], force: [f64; 3], dt: f64) -> Resultant<3> {
        let load = self.load.evaluate(force).value;
        let arm = self.load.ball_radius;
        let preload = self.load.inputs.preloaded(self.preload.torque);
        let maximum = self.maximum.torque;
        self.advance(
            rate.map(|w| arm * w),
            dt,
            load / arm,
            [preload / arm; 3],
            |c| resultant(c, load, preload, maximum),
            |b| bristle_resultant(b, arm, preload + maximum),
        )
    }
}
