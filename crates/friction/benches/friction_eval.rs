//! Time of one friction evaluation with all derivatives: load, law and resultant of each joint.
//!
//! `cargo bench -p friction`. The states are spread over all regimes and change from one evaluation
//! to the next. The baseline of the same run is what a joint without a friction law often gets,
//! `-mu N tanh(v/Vs)` with its derivative.
#![allow(clippy::print_stdout, reason = "a benchmark prints its figures")]

use std::hint::black_box;
use std::time::Instant;

use friction::{
    CylindricalLoad, Effect, Inputs, Load, LuGre, Original, Resultant, RevoluteLoad, SphericalLoad,
    TranslationalLoad, bristle_resultant, cylindrical_bristle_resultant, cylindrical_resultant,
    resultant,
};

const ORIGINAL: Original = Original {
    mu_static: 0.3,
    mu_dynamic: 0.2,
    transition_velocity: 0.1,
    transition_coefficient: 1.5,
    max_deformation: 0.01,
    effect: Effect::All,
};
const LUGRE: LuGre = LuGre {
    mu_static: 0.3,
    mu_dynamic: 0.2,
    bristle_stiffness: 1e5,
    damping: 300.0,
    viscous: 0.4,
    stribeck_velocity: 0.05,
    stribeck_exponent: 2.0,
};
const GUIDE: TranslationalLoad = TranslationalLoad {
    inputs: Inputs::ALL,
    reaction_arm: 0.1,
    bending_factor: 1.5,
    initial_overlap: 0.5,
    overlap_sign: 1.0,
};
const PIN: RevoluteLoad = RevoluteLoad {
    inputs: Inputs::ALL,
    pin_radius: 0.05,
    friction_arm: 0.08,
    bending_reaction_arm: 0.1,
};
const SLEEVE: CylindricalLoad = CylindricalLoad {
    inputs: Inputs::ALL,
    pin_radius: 0.05,
    bending_factor: 1.5,
    initial_overlap: 0.5,
    overlap_sign: 1.0,
};
const BALL: SphericalLoad = SphericalLoad {
    inputs: Inputs::ALL,
    ball_radius: 0.02,
};
const PRELOAD: f64 = 0.1;
const MAXIMUM: f64 = 1e40;
const GAMMA: f64 = 1e-3;

/// State of a joint.
#[derive(Clone, Copy)]
struct State {
    velocity: [f64; 3],
    creep: [f64; 3],
    force: [f64; 3],
    moment: [f64; 3],
    displacement: f64,
}

/// States whose surface speeds range from a thousandth to ten times the transition velocity.
fn states() -> Vec<State> {
    let mut seed = 1u64;
    let mut number = move || {
        seed = seed
            .wrapping_mul(6364136223846793005)
            .wrapping_add(1442695040888963407);
        (seed >> 11) as f64 / (1u64 << 52) as f64 - 1.0
    };
    (0..256)
        .map(|_| {
            let speed = 0.1 * 10f64.powf(2.0 * number() - 1.0);
            let mut vector = |size: f64| [size * number(), size * number(), size * number()];
            State {
                velocity: vector(speed),
                creep: vector(0.005),
                force: vector(100.0),
                moment: vector(10.0),
                displacement: vector(0.1)[0],
            }
        })
        .collect()
}

fn first<const N: usize>(x: &[f64; 3]) -> [f64; N] {
    core::array::from_fn(|k| x[k])
}

/// The reaction along axes whose z is the x axis: the pin of the I yoke of a hooke joint.
fn along_x(x: &[f64; 3]) -> [f64; 3] {
    [x[1], x[2], x[0]]
}

fn original<const N: usize>(s: &State, load: &Load) -> Resultant<N> {
    let c = ORIGINAL.evaluate::<N>(&first(&s.velocity), &first(&s.creep));
    resultant(&c, load.value, PRELOAD, MAXIMUM)
}

/// The deflection is of the size of the creep over a hundred.
fn lugre<const N: usize>(s: &State, load: &Load, arm: f64) -> Resultant<N> {
    let past = first::<N>(&s.creep).map(|d| 0.01 * d);
    let at_surface = load.value / arm;
    let preload = [PRELOAD / arm; N];
    let b = LUGRE.evaluate(
        &first(&s.velocity),
        &past,
        GAMMA,
        at_surface,
        &preload,
        1e-9,
    );
    bristle_resultant(&b, arm, MAXIMUM)
}

fn cylindrical_original(s: &State, load: &Load) -> Resultant<2> {
    let c = ORIGINAL.evaluate::<2>(&first(&s.velocity), &first(&s.creep));
    cylindrical_resultant(
        &c,
        load.value,
        SLEEVE.pin_radius,
        [PRELOAD; 2],
        [MAXIMUM; 2],
    )
}

fn cylindrical_lugre(s: &State, load: &Load) -> Resultant<2> {
    let past = [0.01 * s.creep[0], 0.01 * s.creep[1]];
    let b = LUGRE.evaluate(
        &first(&s.velocity),
        &past,
        GAMMA,
        load.value,
        &[PRELOAD; 2],
        1e-9,
    );
    cylindrical_bristle_resultant(&b, SLEEVE.pin_radius, [MAXIMUM; 2])
}

fn tanh(s: &State) -> (f64, f64) {
    let t = (s.velocity[0] / ORIGINAL.transition_velocity).tanh();
    let level = ORIGINAL.mu_dynamic * s.force[0].abs();
    (
        -level * t,
        level * (t * t - 1.0) / ORIGINAL.transition_velocity,
    )
}

/// Median time of an evaluation in nanoseconds over 101 passes through the states.
fn nanoseconds<R>(states: &[State], mut evaluate: impl FnMut(&State) -> R) -> f64 {
    let mut times: Vec<f64> = (0..101)
        .map(|_| {
            let start = Instant::now();
            for state in states {
                black_box(&evaluate(black_box(state)));
            }
            start.elapsed().as_secs_f64() * 1e9 / states.len() as f64
        })
        .collect();
    times.sort_by(f64::total_cmp);
    times[times.len() / 2]
}

fn main() {
    let states = states();
    let guide = |s: &State| GUIDE.evaluate(s.force, s.moment, s.displacement);
    let sleeve = |s: &State| SLEEVE.evaluate(s.force, s.moment, s.displacement);
    let pin = |s: &State| PIN.evaluate(s.force, s.moment);
    let yoke = |s: &State| PIN.evaluate(along_x(&s.force), along_x(&s.moment));
    let ball = |s: &State| BALL.evaluate(s.force);
    let row = |joint: &str, original: f64, lugre: f64| {
        println!("{joint:<16} {original:8.1} ns {lugre:8.1} ns");
    };
    println!("{:<16} {:>11} {:>11}", "joint", "ORIGINAL", "LUGRE");
    row(
        "translational",
        nanoseconds(&states, |s| {
            let l = guide(s);
            (l, original::<1>(s, &l))
        }),
        nanoseconds(&states, |s| {
            let l = guide(s);
            (l, lugre::<1>(s, &l, 1.0))
        }),
    );
    row(
        "revolute",
        nanoseconds(&states, |s| {
            let l = pin(s);
            (l, original::<1>(s, &l))
        }),
        nanoseconds(&states, |s| {
            let l = pin(s);
            (l, lugre::<1>(s, &l, PIN.pin_radius))
        }),
    );
    row(
        "cylindrical",
        nanoseconds(&states, |s| {
            let l = sleeve(s);
            (l, cylindrical_original(s, &l))
        }),
        nanoseconds(&states, |s| {
            let l = sleeve(s);
            (l, cylindrical_lugre(s, &l))
        }),
    );
    row(
        "spherical",
        nanoseconds(&states, |s| {
            let l = ball(s);
            (l, original::<3>(s, &l))
        }),
        nanoseconds(&states, |s| {
            let l = ball(s);
            (l, lugre::<3>(s, &l, BALL.ball_radius))
        }),
    );
    row(
        "hooke yoke",
        nanoseconds(&states, |s| {
            let l = yoke(s);
            (l, original::<1>(s, &l))
        }),
        nanoseconds(&states, |s| {
            let l = yoke(s);
            (l, lugre::<1>(s, &l, PIN.pin_radius))
        }),
    );
    row(
        "universal yoke",
        nanoseconds(&states, |s| {
            let l = pin(s);
            (l, original::<1>(s, &l))
        }),
        nanoseconds(&states, |s| {
            let l = pin(s);
            (l, lugre::<1>(s, &l, PIN.pin_radius))
        }),
    );
    println!(
        "{:<16} {:8.1} ns",
        "baseline, tanh",
        nanoseconds(&states, tanh)
    );
}
