//! Random joints with random states, and their friction through the stepper.

use friction::explicit::{
    CylindricalStepper, RevoluteStepper, SphericalStepper, TranslationalStepper,
};
use friction::{
    CylindricalLoad, Effect, Inputs, LuGre, Original, Resultant, RevoluteLoad, SphericalLoad,
    TranslationalLoad,
};
use friction::{ForceAndTorque, Law};
use proptest::prelude::*;

/// The joints of the statement; the pins of a hooke joint are `x_I` and `y_J`, those of a universal
/// one `z_I` and `z_J`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Kind {
    Translational,
    Revolute,
    Cylindrical,
    Spherical,
    HookeI,
    HookeJ,
    Universal,
}

/// A joint with friction and its state. Components of velocity, state and friction beyond the
/// freedoms of the joint are ignored or zero.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Joint {
    pub(crate) kind: Kind,
    pub(crate) law: Law,
    pub(crate) inputs: Inputs,
    /// Pin or ball radius, friction arm, bending arm, reaction arm, overlap.
    pub(crate) arms: [f64; 5],
    pub(crate) bending_factor: f64,
    pub(crate) overlap_sign: f64,
    pub(crate) preload: ForceAndTorque,
    pub(crate) maximum: ForceAndTorque,
    /// Velocities of the freedoms: a length or an angle by time.
    pub(crate) velocity: [f64; 3],
    /// Creep or deflection.
    pub(crate) state: [f64; 3],
    pub(crate) force: [f64; 3],
    pub(crate) moment: [f64; 3],
    pub(crate) displacement: f64,
    pub(crate) dt: f64,
}

/// Friction with what it is measured by.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Answer {
    pub(crate) freedoms: usize,
    pub(crate) force: [f64; 3],
    /// By surface velocity.
    pub(crate) by_velocity: [[f64; 3]; 3],
    /// By the joint's load.
    pub(crate) by_load: [f64; 3],
    /// State after the step.
    pub(crate) state: [f64; 3],
    /// The joint's load.
    pub(crate) load: f64,
    /// Load and preloads as forces at the surfaces.
    pub(crate) surface_load: f64,
    pub(crate) surface_preload: [f64; 3],
    /// From surface velocity to the velocity of the freedom; one for sliding.
    pub(crate) arms: [f64; 3],
    /// Preload and maximum by component, in its unit.
    pub(crate) preload: [f64; 3],
    pub(crate) maximum: [f64; 3],
}

impl Answer {
    fn new<const N: usize>(r: Resultant<N>, state: [f64; N], load: f64) -> Self {
        let mut answer = Self {
            freedoms: N,
            force: [0.0; 3],
            by_velocity: [[0.0; 3]; 3],
            by_load: [0.0; 3],
            state: [0.0; 3],
            load,
            surface_load: load,
            surface_preload: [0.0; 3],
            arms: [1.0; 3],
            preload: [0.0; 3],
            maximum: [0.0; 3],
        };
        answer.force[..N].copy_from_slice(&r.force);
        answer.by_load[..N].copy_from_slice(&r.by_load);
        answer.state[..N].copy_from_slice(&state);
        for k in 0..N {
            answer.by_velocity[k][..N].copy_from_slice(&r.by_velocity[k]);
        }
        answer
    }
}

fn first<const N: usize>(x: [f64; 3]) -> [f64; N] {
    core::array::from_fn(|k| x[k])
}

impl Joint {
    /// The step that the joint's stepper makes from the joint's state.
    pub(crate) fn answer(&self) -> Answer {
        let [
            radius,
            friction_arm,
            bending_reaction_arm,
            reaction_arm,
            overlap,
        ] = self.arms;
        let (inputs, bending_factor) = (self.inputs, self.bending_factor);
        let (initial_overlap, overlap_sign) = (overlap, self.overlap_sign);
        let on = |x: f64| if inputs.preload { x } else { 0.0 };
        let (preload, maximum) = (self.preload, self.maximum);
        let (force_preload, torque_preload) = (on(preload.force), on(preload.torque));
        let mut answer = match self.kind {
            Kind::Translational => {
                let load = TranslationalLoad {
                    inputs,
                    reaction_arm,
                    bending_factor,
                    initial_overlap,
                    overlap_sign,
                };
                let mut s = TranslationalStepper::new(self.law, load);
                (s.preload, s.maximum) = (preload, maximum);
                s.set_state(first(self.state));
                let r = s.step(
                    self.velocity[0],
                    self.displacement,
                    self.force,
                    self.moment,
                    self.dt,
                );
                let load = load.evaluate(self.force, self.moment, self.displacement);
                Answer::new(r, s.state(), load.value)
            }
            Kind::Cylindrical => {
                let load = CylindricalLoad {
                    inputs,
                    pin_radius: radius,
                    bending_factor,
                    initial_overlap,
                    overlap_sign,
                };
                let mut s = CylindricalStepper::new(self.law, load);
                (s.preload, s.maximum) = (preload, maximum);
                s.set_state(first(self.state));
                let r = s.step(
                    self.velocity[0],
                    self.displacement,
                    self.velocity[1],
                    self.force,
                    self.moment,
                    self.dt,
                );
                let load = load.evaluate(self.force, self.moment, self.displacement);
                Answer {
                    arms: [1.0, radius, 1.0],
                    ..Answer::new(r, s.state(), load.value)
                }
            }
            Kind::Spherical => {
                let load = SphericalLoad {
                    inputs,
                    ball_radius: radius,
                };
                let mut s = SphericalStepper::new(self.law, load);
                (s.preload, s.maximum) = (preload, maximum);
                s.set_state(self.state);
                let r = s.step(self.velocity, self.force, self.dt);
                Answer {
                    arms: [radius; 3],
                    ..Answer::new(r, s.state(), load.evaluate(self.force).value)
                }
            }
            Kind::Revolute | Kind::HookeI | Kind::HookeJ | Kind::Universal => {
                let load = RevoluteLoad {
                    inputs,
                    pin_radius: radius,
                    friction_arm,
                    bending_reaction_arm,
                };
                // The axes of the pin: its direction becomes z.
                let along = |[x, y, z]: [f64; 3]| match self.kind {
                    Kind::HookeI => [y, z, x],
                    Kind::HookeJ => [z, x, y],
                    _ => [x, y, z],
                };
                let (force, moment) = (along(self.force), along(self.moment));
                let mut s = RevoluteStepper::new(self.law, load);
                (s.preload, s.maximum) = (preload, maximum);
                s.set_state(first(self.state));
                let r = s.step(self.velocity[0], force, moment, self.dt);
                Answer {
                    arms: [radius, 1.0, 1.0],
                    ..Answer::new(r, s.state(), load.evaluate(force, moment).value)
                }
            }
        };
        for k in 0..answer.freedoms {
            let slides = k == 0 && matches!(self.kind, Kind::Translational | Kind::Cylindrical);
            let (preload, maximum) = if slides {
                (force_preload, maximum.force)
            } else {
                (torque_preload, maximum.torque)
            };
            (answer.preload[k], answer.maximum[k]) = (preload, maximum);
            answer.surface_preload[k] = preload / answer.arms[k];
        }
        if !matches!(self.kind, Kind::Translational | Kind::Cylindrical) {
            answer.surface_load = answer.load / answer.arms[0];
        }
        answer
    }

    /// Velocity of the surfaces.
    pub(crate) fn surface_velocity(&self) -> [f64; 3] {
        let answer = self.answer();
        core::array::from_fn(|k| {
            if k < answer.freedoms {
                answer.arms[k] * self.velocity[k]
            } else {
                0.0
            }
        })
    }

    pub(crate) fn scaled_velocity(&self, factor: f64) -> Self {
        Self {
            velocity: self.velocity.map(|c| factor * c),
            ..*self
        }
    }
}

/// Ten to a uniform power.
fn decades(from: f64, to: f64) -> impl Strategy<Value = f64> {
    (from..to).prop_map(|power| 10f64.powf(power))
}

/// A vector whose components are of one size and now and then zero.
fn vector(from: f64, to: f64) -> impl Strategy<Value = [f64; 3]> {
    let component = prop_oneof![1 => Just(0.0), 9 => -1.0..1.0f64];
    (decades(from, to), prop::array::uniform3(component))
        .prop_map(|(size, direction)| direction.map(|c| size * c))
}

pub(crate) fn original() -> impl Strategy<Value = Law> {
    let effect = prop_oneof![
        4 => Just(Effect::All),
        1 => Just(Effect::Stiction),
        1 => Just(Effect::Sliding)
    ];
    let coefficients = (decades(-2.0, 0.0), 1.0..3.0f64);
    (
        coefficients,
        decades(-3.0, 0.0),
        1.05..3.0f64,
        decades(-5.0, -1.0),
        effect,
    )
        .prop_map(
            |(
                (mu, ratio),
                transition_velocity,
                transition_coefficient,
                max_deformation,
                effect,
            )| {
                Law::Original(Original {
                    mu_static: ratio * mu,
                    mu_dynamic: mu,
                    transition_velocity,
                    transition_coefficient,
                    max_deformation,
                    effect,
                })
            },
        )
}

pub(crate) fn lugre() -> impl Strategy<Value = Law> {
    let or_zero = |from, to| prop_oneof![1 => Just(0.0), 3 => decades(from, to)];
    let coefficients = (decades(-2.0, 0.0), 1.0..3.0f64);
    let stribeck = (decades(-3.0, 0.0), 0.5..3.0f64);
    (
        coefficients,
        decades(2.0, 9.0),
        or_zero(-1.0, 4.0),
        or_zero(-2.0, 2.0),
        stribeck,
    )
        .prop_map(
            |((mu, ratio), bristle_stiffness, damping, viscous, (vs, delta))| {
                Law::LuGre(LuGre {
                    mu_static: ratio * mu,
                    mu_dynamic: mu,
                    bristle_stiffness,
                    damping,
                    viscous,
                    stribeck_velocity: vs,
                    stribeck_exponent: delta,
                })
            },
        )
}

/// Joints of every kind with the given laws: speeds and creeps over all regimes, loads over ten
/// decades and now and then none.
pub(crate) fn joint(law: impl Strategy<Value = Law>) -> impl Strategy<Value = Joint> {
    let kind = prop::sample::select(vec![
        Kind::Translational,
        Kind::Revolute,
        Kind::Cylindrical,
        Kind::Spherical,
        Kind::HookeI,
        Kind::HookeJ,
        Kind::Universal,
    ]);
    let switch = prop::bool::weighted(0.8);
    let inputs = prop::array::uniform4(switch);
    let sizes = (
        prop::array::uniform5(decades(-2.0, 1.0)),
        0.5..2.0f64,
        prop::sample::select(vec![-1.0, 0.0, 1.0]),
    );
    let limits = (
        prop::array::uniform2(prop_oneof![Just(0.0), decades(-2.0, 2.0)]),
        prop::array::uniform2(prop_oneof![Just(1e40), decades(-1.0, 3.0)]),
    );
    let motion = (
        vector(-4.0, 2.0),
        vector(-6.0, -1.0),
        -0.5..0.5f64,
        decades(-6.0, 0.0),
    );
    let reaction = (vector(-6.0, 4.0), vector(-6.0, 4.0));
    (kind, law, inputs, sizes, limits, motion, reaction).prop_map(
        |(kind, law, inputs, sizes, limits, motion, reaction)| {
            let (arms, bending_factor, overlap_sign) = sizes;
            let ([force, torque], [max_force, max_torque]) = limits;
            let (velocity, state, displacement, dt) = motion;
            let mut joint = Joint {
                kind,
                law,
                inputs: Inputs {
                    preload: inputs[0],
                    reaction_force: inputs[1],
                    bending_moment: inputs[2],
                    torsional_moment: inputs[3],
                },
                arms,
                bending_factor,
                overlap_sign,
                preload: ForceAndTorque { force, torque },
                maximum: ForceAndTorque {
                    force: max_force,
                    torque: max_torque,
                },
                velocity,
                state,
                force: reaction.0,
                moment: reaction.1,
                displacement: displacement * arms[4],
                dt,
            };
            // Bristles that have come from rest at most at the present load and preload.
            if let Law::LuGre(law) = law {
                let a = joint.answer();
                let size = state.iter().map(|c| c * c).sum::<f64>().sqrt();
                let share = (size / (1.0 + size)).sqrt();
                for k in 0..a.freedoms {
                    let level = law.mu_static * a.surface_load + a.surface_preload[k];
                    let direction = if size > 0.0 { state[k] / size } else { 0.0 };
                    joint.state[k] = share * direction * level / law.bristle_stiffness;
                }
            }
            joint
        },
    )
}
