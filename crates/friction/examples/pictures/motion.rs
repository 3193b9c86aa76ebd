//! Motions of one mass, stepped as a hand-written simulator would.

use friction::Law;
use friction::explicit::TranslationalStepper;
use friction::{Effect, Inputs, LuGre, Original, TranslationalLoad};

const GRAVITY: f64 = 9.81;

const GUIDE: TranslationalLoad = TranslationalLoad {
    inputs: Inputs::ALL,
    reaction_arm: 1.0,
    bending_factor: 1.0,
    initial_overlap: 1.0,
    overlap_sign: 0.0,
};

/// Bristles of 1 kg with coefficients 0.3 and 0.2; damping about half the critical.
pub(crate) const BRISTLES: LuGre = LuGre {
    mu_static: 0.3,
    mu_dynamic: 0.2,
    bristle_stiffness: 1e5,
    damping: 300.0,
    viscous: 0.0,
    stribeck_velocity: 1e-3,
    stribeck_exponent: 2.0,
};

pub(crate) fn lugre() -> Law {
    Law::LuGre(BRISTLES)
}

/// The original law with the same coefficients; its creep reaches as far as the bristles.
pub(crate) fn original() -> Law {
    Law::Original(Original {
        mu_static: 0.3,
        mu_dynamic: 0.2,
        transition_velocity: 1e-3,
        transition_coefficient: 1.5,
        max_deformation: 6e-5,
        effect: Effect::All,
    })
}

/// Position and velocity after a step `dt` of 1 kg under `force`, on ground that moves.
fn step(
    friction: &mut TranslationalStepper,
    [x, v]: [f64; 2],
    ground: f64,
    force: f64,
    dt: f64,
) -> [f64; 2] {
    let f = friction.step(v - ground, x, [0.0, GRAVITY, 0.0], [0.0; 3], dt);
    let v = v + dt * (force + f.force[0]) / (1.0 - dt * f.by_velocity[0][0]);
    [x + dt * v, v]
}

/// Displacement in micrometres and load over static friction, three times up and down.
pub(crate) fn presliding(law: Law) -> Vec<(f64, f64)> {
    let mut friction = TranslationalStepper::new(law, GUIDE);
    let (mut state, dt, steps) = ([0.0; 2], 1e-4, 240_000);
    let mut points = Vec::new();
    for k in 0..steps {
        // Four seconds up, four down.
        let phase = f64::from(k) * dt / 4.0 % 2.0;
        let load = 0.95 * (1.0 - (phase - 1.0).abs());
        state = step(&mut friction, state, 0.0, load * 0.3 * GRAVITY, dt);
        if k % 400 == 0 {
            points.push((1e6 * state[0], load));
        }
    }
    points
}

/// Velocity in mm/s and friction over load, once around after many times.
pub(crate) fn lag(omega: f64) -> Vec<(f64, f64)> {
    let mut friction = TranslationalStepper::new(lugre(), GUIDE);
    let steps = 20_000;
    let dt = core::f64::consts::TAU / omega / f64::from(steps);
    let mut points = Vec::new();
    for turn in 0..10 {
        for k in 0..=steps {
            let v = 1.5e-3 + 1e-3 * (omega * f64::from(k) * dt).cos();
            let f = friction.step(v, 0.0, [0.0, GRAVITY, 0.0], [0.0; 3], dt);
            if turn == 9 && k % 50 == 0 {
                points.push((1e3 * v, -f.force[0] / GRAVITY));
            }
        }
    }
    points
}

/// Time and velocity of 1 kg on a spring on a belt.
pub(crate) fn belt(law: Law) -> Vec<(f64, f64)> {
    let mut friction = TranslationalStepper::new(law, GUIDE);
    let (mut state, dt) = ([0.0, 0.1], 1e-5);
    let mut points = Vec::new();
    for k in 0..600_000 {
        if k % 500 == 0 {
            points.push((f64::from(k) * dt, state[1]));
        }
        state = step(&mut friction, state, 0.1, -20.0 * state[0], dt);
    }
    points
}
