//! What must hold of the friction of every joint with either formulation, whatever its state and
//! parameters: limits, dissipation, invariance, continuity, derivatives, no number lost.

mod joint;

use friction::step::odd_step;
use friction::{Effect, LuGre, Original};
use friction::{ForceAndTorque, Law};
use joint::{Answer, Joint, Kind, joint, lugre, original};
use proptest::prelude::*;
use proptest::test_runner::RngSeed;

fn dot(x: &[f64; 3], y: &[f64; 3]) -> f64 {
    x.iter().zip(y).map(|(a, b)| a * b).sum()
}

fn norm(x: &[f64; 3]) -> f64 {
    x.iter().fold(0.0, |m: f64, c| m.hypot(*c))
}

fn config() -> ProptestConfig {
    ProptestConfig {
        cases: 2000,
        failure_persistence: None,
        max_global_rejects: 20_000,
        rng_seed: RngSeed::Fixed(8),
        ..ProptestConfig::default()
    }
}

/// The groups of components that a limit is for: each of a cylindrical joint, else all.
fn groups(joint: &Joint, a: &Answer) -> Vec<([f64; 3], usize)> {
    if joint.kind == Kind::Cylindrical {
        vec![([a.force[0], 0.0, 0.0], 0), ([0.0, a.force[1], 0.0], 1)]
    } else {
        vec![(a.force, 0)]
    }
}

/// Size of the terms that friction is the sum of, by component: what its rounding is measured by.
fn size(joint: &Joint, a: &Answer) -> f64 {
    let v = joint.surface_velocity();
    let arm = a.arms[..a.freedoms].iter().fold(1.0, |m: f64, c| m.max(*c));
    let own = match joint.law {
        Law::Original(law) => law.mu_static * a.surface_load,
        Law::LuGre(law) => {
            law.mu_static * a.surface_load
                + law.bristle_stiffness * norm(&joint.state)
                + (law.damping + law.viscous) * norm(&v)
                // The least level of the stepper.
                + 1e-12
        }
    };
    arm * (own + norm(&a.surface_preload))
}

/// A law in other units of length, time and force.
fn in_units(law: Law, [length, time, force]: [f64; 3]) -> Law {
    match law {
        Law::Original(law) => Law::Original(Original {
            transition_velocity: law.transition_velocity * length / time,
            max_deformation: law.max_deformation * length,
            ..law
        }),
        Law::LuGre(law) => Law::LuGre(LuGre {
            bristle_stiffness: law.bristle_stiffness * force / length,
            damping: law.damping * force * time / length,
            viscous: law.viscous * force * time / length,
            stribeck_velocity: law.stribeck_velocity * length / time,
            ..law
        }),
    }
}

/// Rotation about a unit axis (Rodrigues).
fn turned(x: [f64; 3], axis: [f64; 3], angle: f64) -> [f64; 3] {
    let (sine, cosine) = angle.sin_cos();
    let cross = [
        axis[1] * x[2] - axis[2] * x[1],
        axis[2] * x[0] - axis[0] * x[2],
        axis[0] * x[1] - axis[1] * x[0],
    ];
    let along = dot(&axis, &x);
    core::array::from_fn(|k| x[k] * cosine + cross[k] * sine + axis[k] * along * (1.0 - cosine))
}

proptest! {
    #![proptest_config(config())]

    /// At most the static friction with the preload, and at most limit and preload.
    #[test]
    fn original_within_limits(joint in joint(original())) {
        let Law::Original(law) = joint.law else { unreachable!() };
        let a = joint.answer();
        for (force, k) in groups(&joint, &a) {
            let arm = if joint.kind == Kind::Translational || k == 0 && joint.kind == Kind::Cylindrical {
                1.0
            } else {
                a.arms[k]
            };
            let free = law.mu_static * arm * a.surface_load + a.preload[k];
            // Rounding of a sum of three products.
            prop_assert!(norm(&force) <= free * (1.0 + 4e-15), "{force:?} above {free}");
            let limit = a.maximum[k] + a.preload[k];
            prop_assert!(norm(&force) <= limit * (1.0 + 4e-15), "{force:?} above {limit}");
        }
        for k in 0..a.freedoms {
            prop_assert!(a.state[k].abs() <= law.max_deformation);
        }
    }

    /// At most limit and preload; the elastic part at most the static friction with the preload.
    #[test]
    fn lugre_within_limits(joint in joint(lugre())) {
        let Law::LuGre(law) = joint.law else { unreachable!() };
        let a = joint.answer();
        for (force, k) in groups(&joint, &a) {
            let limit = a.maximum[k] + a.preload[k];
            prop_assert!(norm(&force) <= limit * (1.0 + 4e-15), "{force:?} above {limit}");
        }
        for k in 0..a.freedoms {
            let level = law.mu_static * a.surface_load + a.surface_preload[k];
            // The least level of the stepper is 1e-12.
            let elastic = law.bristle_stiffness * a.state[k].abs();
            prop_assert!(elastic <= level.max(1e-12) * (1.0 + 4e-15), "{elastic} above {level}");
        }
    }

    /// Sliding takes energy out.
    #[test]
    fn original_dissipates_in_sliding(joint in joint(original())) {
        let Law::Original(law) = joint.law else { unreachable!() };
        prop_assume!(norm(&joint.surface_velocity()) >= law.transition_velocity);
        let power = dot(&joint.answer().force, &joint.velocity);
        prop_assert!(power <= 0.0, "{power}");
    }

    /// Stuck, too, friction takes out no less than the creep stores, `N mu_s Dm` times the integral
    /// of psi. Components with preloads of their own share no such store.
    #[test]
    fn original_is_passive_while_stuck(joint in joint(original())) {
        let Law::Original(law) = joint.law else { unreachable!() };
        prop_assume!(law.effect != Effect::Sliding && joint.kind != Kind::Cylindrical);
        let unlimited = Joint {
            dt: 0.0,
            maximum: ForceAndTorque { force: 1e40, torque: 1e40 },
            ..joint
        };
        let v = unlimited.surface_velocity();
        prop_assume!(norm(&v) < law.transition_velocity);
        let a = unlimited.answer();
        let level = law.mu_static * a.surface_load + a.surface_preload[0];
        let creep: [f64; 3] = core::array::from_fn(|k| if k < a.freedoms { joint.state[k] } else { 0.0 });
        let d = norm(&creep);
        let along = if d > 0.0 { dot(&creep, &v) / d } else { 0.0 };
        let stored = level * odd_step(d / law.max_deformation).value * along;
        let power = dot(&a.force, &v) / a.arms[0];
        prop_assert!(-power - stored >= -4e-15 * level * norm(&v), "{power} {stored}");
    }

    /// Up to the passive speed the bristles take out no less than they store, wherever they stand;
    /// in steady motion they take out energy at any speed.
    #[test]
    fn lugre_is_passive(joint in joint(lugre()), share in 0.0..1.0f64) {
        let Law::LuGre(law) = joint.law else { unreachable!() };
        let unlimited = Joint {
            dt: 0.0,
            maximum: ForceAndTorque { force: 1e40, torque: 1e40 },
            ..joint
        };
        let speed = norm(&unlimited.surface_velocity());
        prop_assume!(speed > 0.0);
        let a = unlimited.answer();
        let level = |a: &Answer, g: f64| -> f64 {
            let preloads = &a.surface_preload[..a.freedoms];
            g * a.surface_load + preloads.iter().copied().fold(f64::INFINITY, f64::min)
        };
        prop_assume!(level(&a, law.mu_dynamic) > 1e-6);
        // The level only falls with the speed, so that of mu_d makes the lowest passive speed.
        let passive = law.passive_speed(level(&a, law.mu_dynamic)).min(speed);
        let slow = unlimited.scaled_velocity(share * passive / speed);
        let (v, a) = (slow.surface_velocity(), slow.answer());
        let surface: [f64; 3] = core::array::from_fn(|k| a.force[k] / a.arms[k]);
        let (g, _) = law.stribeck(norm(&v));
        let rate: [f64; 3] = core::array::from_fn(|k| {
            let level = g * a.surface_load + a.surface_preload[k];
            if k < a.freedoms { v[k] - law.bristle_stiffness * norm(&v) * slow.state[k] / level } else { 0.0 }
        });
        let stored = law.bristle_stiffness * dot(&slow.state, &rate);
        let dissipated = -dot(&surface, &v) - stored;
        let rounding = 1e-14 * norm(&v) * size(&slow, &a) / a.arms.iter().copied().fold(f64::INFINITY, f64::min);
        prop_assert!(dissipated >= -rounding, "{dissipated}");

        let (v, (g, _)) = (unlimited.surface_velocity(), law.stribeck(speed));
        let mut steady = unlimited;
        for k in 0..a.freedoms {
            let level = g * a.surface_load + a.surface_preload[k];
            steady.state[k] = level / law.bristle_stiffness * v[k] / speed;
        }
        prop_assert!(dot(&steady.answer().force, &steady.velocity) < 0.0);
    }

    /// Turning everything about the axis of the joint, or about any axis for a spherical one, turns
    /// friction along. Seen from the other part everything has the opposite sign.
    #[test]
    fn frames_do_not_matter(
        joint in joint(prop_oneof![original(), lugre()]),
        angle in -3.0..3.0f64,
        axis in prop::array::uniform3(-1.0..1.0f64),
    ) {
        let a = joint.answer();
        let axis = match joint.kind {
            Kind::Spherical => axis.map(|c| c / norm(&axis)),
            Kind::HookeI => [1.0, 0.0, 0.0],
            Kind::HookeJ => [0.0, 1.0, 0.0],
            _ => [0.0, 0.0, 1.0],
        };
        let turn = |x| turned(x, axis, angle);
        let ball = joint.kind == Kind::Spherical;
        let b = Joint {
            force: turn(joint.force),
            moment: turn(joint.moment),
            velocity: if ball { turn(joint.velocity) } else { joint.velocity },
            state: if ball { turn(joint.state) } else { joint.state },
            ..joint
        }
        .answer();
        let expected = if ball { turn(a.force) } else { a.force };
        // A rotation rounds each vector to 1e-16 of it; friction is at most a few hundred times as
        // sensitive to velocity and state as their sizes say (the slope of the laws at small s).
        let slopes = norm(&a.by_velocity.map(|row| norm(&row))) * norm(&joint.surface_velocity());
        let tolerance = 1e-13 * (size(&joint, &a) + slopes);
        for k in 0..3 {
            prop_assert!((b.force[k] - expected[k]).abs() <= tolerance, "{b:?} {expected:?}");
        }

        let opposite = Joint {
            velocity: joint.velocity.map(|c| -c),
            state: joint.state.map(|c| -c),
            force: joint.force.map(|c| -c),
            moment: joint.moment.map(|c| -c),
            ..joint
        };
        prop_assert_eq!(opposite.answer().force, a.force.map(|c| -c));
    }

    /// Other units of length, time and force give the same friction in those units.
    #[test]
    fn units_do_not_matter(
        joint in joint(prop_oneof![original(), lugre()]),
        powers in prop::array::uniform3(-10..10i32),
    ) {
        let a = joint.answer();
        // Below, the least level of the stepper, a plain 1e-12, would show.
        prop_assume!(a.surface_load > 1e-3);
        // Powers of two scale without rounding; only the exponential and powers see another number.
        let units = powers.map(|p| 2f64.powi(p));
        let [length, time, force] = units;
        let slides = matches!(joint.kind, Kind::Translational | Kind::Cylindrical);
        let first = if slides { length } else { 1.0 };
        let scaled = |x: ForceAndTorque| ForceAndTorque {
            force: x.force * force,
            torque: x.torque * force * length,
        };
        let b = Joint {
            law: in_units(joint.law, units),
            arms: joint.arms.map(|c| c * length),
            preload: scaled(joint.preload),
            maximum: scaled(joint.maximum),
            velocity: [
                joint.velocity[0] * first / time,
                joint.velocity[1] / time,
                joint.velocity[2] / time,
            ],
            state: joint.state.map(|c| c * length),
            force: joint.force.map(|c| c * force),
            moment: joint.moment.map(|c| c * force * length),
            displacement: joint.displacement * length,
            dt: joint.dt * time,
            ..joint
        }
        .answer();
        let tolerance = 1e-14 * size(&joint, &a);
        for k in 0..3 {
            let unit = if slides && k == 0 { force } else { force * length };
            prop_assert!((b.force[k] / unit - a.force[k]).abs() <= tolerance, "{a:?} {b:?}");
        }
    }

    /// The original law has no jump: two velocities, however far apart and in whatever regimes, give
    /// frictions no further apart than the largest slope times the distance.
    #[test]
    fn original_is_continuous(
        joint in joint(original()),
        other in prop::array::uniform3(-1.0..1.0f64),
        distance in -12.0..1.0f64,
    ) {
        let Law::Original(law) = joint.law else { unreachable!() };
        let fixed = Joint { dt: 0.0, ..joint };
        let moved = Joint {
            velocity: core::array::from_fn(|k| {
                joint.velocity[k] + 10f64.powf(distance) * other[k] * law.transition_velocity
            }),
            ..fixed
        };
        let (a, b) = (fixed.answer(), moved.answer());
        let (v, w) = (fixed.surface_velocity(), moved.surface_velocity());
        let step = norm(&core::array::from_fn(|k| v[k] - w[k]));
        // Largest slope of psi is 15/8, of STEP5 as well; the blend has it twice.
        let vs = law.transition_velocity;
        let fall = (law.mu_static - law.mu_dynamic) / (law.transition_coefficient - 1.0);
        let slope = 1.875 * (2.0 * law.mu_static + fall) / vs * a.surface_load
            + 2.0 * 1.875 / vs * norm(&a.surface_preload);
        for k in 0..a.freedoms {
            let difference = (a.force[k] - b.force[k]).abs();
            // The clip of a vector is no expansion.
            let bound = a.arms[k] * slope * step + 1e-14 * size(&fixed, &a);
            prop_assert!(difference <= bound, "{difference} above {bound}");
        }
    }

    /// Nor have the bristles at a given deflection: `v/G(v)` has the slope `(1 - v G'/G)/G`, and
    /// `v g'` is at most `(mu_s - mu_d) delta/e`.
    #[test]
    fn lugre_is_continuous(
        joint in joint(lugre()),
        other in prop::array::uniform3(-1.0..1.0f64),
        distance in -12.0..1.0f64,
    ) {
        let Law::LuGre(law) = joint.law else { unreachable!() };
        let fixed = Joint { dt: 0.0, ..joint };
        let moved = Joint {
            velocity: core::array::from_fn(|k| {
                joint.velocity[k] + 10f64.powf(distance) * other[k] * law.stribeck_velocity
            }),
            ..fixed
        };
        let (a, b) = (fixed.answer(), moved.answer());
        let (v, w) = (fixed.surface_velocity(), moved.surface_velocity());
        let step = norm(&core::array::from_fn(|k| v[k] - w[k]));
        let fall = (law.mu_static - law.mu_dynamic) * law.stribeck_exponent / 1f64.exp();
        let mut bound = [0.0; 3];
        for k in 0..a.freedoms {
            let level = (law.mu_dynamic * a.surface_load + a.surface_preload[k]).max(1e-12);
            let decay = (1.0 + fall * a.surface_load / level) / level;
            let elastic = law.bristle_stiffness * joint.state[k].abs();
            let slope = law.damping * (1.0 + elastic * decay) + law.viscous;
            bound[k] = a.arms[k] * slope * step;
        }
        let size = size(&fixed, &a).max(size(&moved, &b));
        let difference: [f64; 3] = core::array::from_fn(|k| a.force[k] - b.force[k]);
        // The clip of a vector is no expansion.
        prop_assert!(norm(&difference) <= norm(&bound) + 1e-13 * size, "{difference:?} {bound:?}");
    }

    /// Derivatives by velocity and load agree with differences, except within the reach of a kink,
    /// where two differences do not agree with each other.
    #[test]
    fn derivatives(joint in joint(prop_oneof![original(), lugre()])) {
        let a = joint.answer();
        let v = joint.surface_velocity();
        let speed = norm(&v);
        prop_assume!(speed > 0.0);
        let slope = |h: f64, at: &dyn Fn(f64) -> [f64; 3]| -> [f64; 3] {
            let d = |e: f64| -> [f64; 3] {
                let (x, y) = (at(e), at(-e));
                core::array::from_fn(|k| (x[k] - y[k]) / (2.0 * e))
            };
            // Fourth order.
            let (fine, coarse) = (d(h), d(2.0 * h));
            core::array::from_fn(|k| (4.0 * fine[k] - coarse[k]) / 3.0)
        };
        let check = |h: f64, at: &dyn Fn(f64) -> [f64; 3], exact: [f64; 3]| {
            let (coarse, fine) = (slope(2.0 * h, at), slope(h, at));
            let rounding = 3e-15 * size(&joint, &a) / h;
            let spread = norm(&core::array::from_fn(|k| coarse[k] - fine[k]));
            prop_assume!(spread <= 1e-5 * norm(&fine) + rounding);
            let error = norm(&core::array::from_fn(|k| exact[k] - fine[k]));
            // At a kink all differences are the mean of two slopes, between which they jump.
            let near = 1e-2 * h;
            let (ahead, here, behind) = (at(near), at(0.0), at(-near));
            let jump: [f64; 3] =
                core::array::from_fn(|k| (ahead[k] - 2.0 * here[k] + behind[k]) / near);
            let allowed = 1e-5 * norm(&fine) + 200.0 * rounding + norm(&jump);
            prop_assert!(error <= allowed, "{exact:?} instead of {fine:?}");
            Ok(())
        };
        for j in 0..a.freedoms {
            let at = |e: f64| {
                let mut moved = joint;
                moved.velocity[j] += e / a.arms[j];
                moved.answer().force
            };
            check(1e-3 * speed, &at, a.by_velocity.map(|row| row[j]))?;
        }
        // Reaction and load in proportion.
        let at = |e: f64| {
            let force = joint.force.map(|c| c * (1.0 + e));
            let moment = joint.moment.map(|c| c * (1.0 + e));
            Joint { force, moment, ..joint }.answer().force
        };
        check(1e-3, &at, a.by_load.map(|c| c * a.load))?;
    }

    /// Numbers of any size give numbers, also without load, without motion and for endless steps.
    #[test]
    fn nothing_is_lost(
        joint in joint(prop_oneof![original(), lugre()]),
        powers in prop::array::uniform5(-150.0..80.0f64),
        zeros in prop::array::uniform5(prop::bool::weighted(0.2)),
    ) {
        let factor = |k: usize| if zeros[k] { 0.0 } else { 10f64.powf(powers[k]) };
        let extreme = Joint {
            velocity: joint.velocity.map(|c| c * factor(0)),
            state: joint.state.map(|c| c * factor(1)),
            force: joint.force.map(|c| c * factor(2)),
            moment: joint.moment.map(|c| c * factor(3)),
            dt: factor(4),
            ..joint
        };
        let a = extreme.answer();
        let numbers = a.force.iter().chain(&a.by_load).chain(&a.state);
        for x in numbers.chain(a.by_velocity.iter().flatten()) {
            prop_assert!(x.is_finite(), "{a:?}");
        }
    }

    /// A load that vanishes and comes back, stiff or soft bristles, long or short steps: deflection
    /// and friction stay within what the largest load allows.
    #[test]
    fn bristles_survive_a_vanishing_load(
        joint in joint(lugre()),
        steps in prop::collection::vec((-1.0..1.0f64, prop_oneof![Just(0.0), -1.0..1.0f64], -8.0..1.0f64), 1..60),
    ) {
        let Law::LuGre(law) = joint.law else { unreachable!() };
        let mut now = Joint { state: [0.0; 3], ..joint };
        let mut highest = [1e-12f64; 3];
        for (velocity, load, dt) in steps {
            now.velocity = joint.velocity.map(|c| c * velocity);
            // Through zero, with a change of sign.
            now.force = joint.force.map(|c| c * load);
            now.moment = joint.moment.map(|c| c * load);
            now.dt = 10f64.powf(dt);
            let a = now.answer();
            for k in 0..a.freedoms {
                highest[k] = highest[k].max(law.mu_static * a.surface_load + a.surface_preload[k]);
                let elastic = law.bristle_stiffness * a.state[k].abs();
                prop_assert!(elastic <= highest[k] * (1.0 + 1e-13), "{elastic} {highest:?}");
                let limit = a.preload[k] + a.maximum[k];
                prop_assert!(a.force[k].abs() <= limit * (1.0 + 4e-15));
            }
            now.state = a.state;
        }
    }
}
