//! The stepper for explicit simulators: the example's pendulum against its closed form, order of the
//! formula, and steps far beyond what the bristles' own rates would allow.

#[path = "../examples/pendulum/pendulum.rs"]
mod pendulum;
mod shared;

use friction::Law;
use friction::explicit::{RevoluteStepper, SphericalStepper, TranslationalStepper};
use friction::{Effect, Inputs, LuGre, Original, RevoluteLoad, SphericalLoad, TranslationalLoad};
use pendulum::{GRAVITY, Pendulum};
use shared::{canudas, of_the_law};
use verification::{Rule, check};

const GUIDE: TranslationalLoad = TranslationalLoad {
    inputs: Inputs::ALL,
    reaction_arm: 1.0,
    bending_factor: 1.0,
    initial_overlap: 1.0,
    overlap_sign: 0.0,
};

/// Laws with the coefficient 0.3 throughout, the finer the higher the level.
fn laws(level: i32) -> [(&'static str, Law); 2] {
    let fine = 0.5f64.powi(level);
    let original = Original {
        mu_static: 0.3,
        mu_dynamic: 0.3,
        transition_velocity: 2e-2 * fine,
        transition_coefficient: 1.5,
        max_deformation: 2e-3 * fine,
        effect: Effect::All,
    };
    let lugre = LuGre {
        mu_static: 0.3,
        mu_dynamic: 0.3,
        bristle_stiffness: 2e4 / fine,
        damping: 10.0,
        viscous: 0.0,
        stribeck_velocity: 1e-3,
        stribeck_exponent: 2.0,
    };
    [
        ("ORIGINAL", Law::Original(original)),
        ("LUGRE", Law::LuGre(lugre)),
    ]
}

/// Angles in degrees where the pendulum of the specification's 9.11 turns.
fn turning_angles(law: Law, dt: f64) -> Vec<f64> {
    let pin = RevoluteLoad {
        inputs: Inputs::ALL,
        pin_radius: 0.05,
        friction_arm: 0.05,
        bending_reaction_arm: 1.0,
    };
    let mut pendulum = Pendulum {
        mass: 1.0,
        length: 1.0,
        angle: 60f64.to_radians(),
        rate: 0.0,
        friction: RevoluteStepper::new(law, pin),
        torque: 0.0,
        dissipated: 0.0,
    };
    let start = pendulum.energy();
    let mut turns = Vec::new();
    while turns.len() < 6 {
        let before = pendulum.rate;
        pendulum.step(dt);
        if before * pendulum.rate < 0.0 {
            // Top of the parabola through the last three angles.
            let (sum, fall) = (before + pendulum.rate, before - pendulum.rate);
            let top = pendulum.angle - dt * pendulum.rate + dt * sum * sum / (8.0 * fall);
            turns.push(top.to_degrees());
        }
        // The formula of first order oscillates about the energy by its step times the largest
        // power, 13 W here.
        let balance = pendulum.energy() + pendulum.dissipated - start;
        assert!(balance.abs() <= 13.0 * dt, "{balance}");
    }
    turns
}

/// The same by the exact solution of the ideal Coulomb pin, which is linear in the square of the
/// rate (specification 9.11).
fn exact_turning_angles() -> Vec<f64> {
    let sine: f64 = 0.3 * 0.05;
    let kappa = sine / (1.0 - sine * sine).sqrt();
    let divisor = 1.0 + 4.0 * kappa * kappa;
    let mut start = 60f64.to_radians();
    let mut turns = Vec::new();
    for _ in 0..6 {
        // Towards the other side; the sign of the rate is that of the motion.
        let s = -start.signum();
        let a = -6.0 * kappa * s * GRAVITY / divisor;
        let b = 2.0 * GRAVITY * (1.0 - 2.0 * kappa * kappa) / divisor;
        let particular = |th: f64| a * th.sin() + b * th.cos();
        let square =
            |th: f64| particular(th) - particular(start) * (-2.0 * kappa * s * (th - start)).exp();
        // It falls on the far side from the highest rate to the turn.
        let (mut low, mut high) = (0.0, -start);
        for _ in 0..60 {
            let middle = 0.5 * (low + high);
            if square(middle) > 0.0 {
                low = middle;
            } else {
                high = middle;
            }
        }
        start = 0.5 * (low + high);
        turns.push(start.to_degrees());
    }
    turns
}

#[test]
fn the_pendulum_of_the_example() {
    let exact = exact_turning_angles();
    let printed = [
        -56.99434176,
        54.12363919,
        -51.37368162,
        48.73218428,
        -46.18844028,
        43.73304844,
    ];
    let case = of_the_law(
        "9.11",
        "pendulum of 1 kg at 1 m, pin 0.05 m, mu 0.3, semi-implicit Euler with the explicit stepper",
        "exact solution of the ideal Coulomb pin",
    );
    let mut claims = vec![case.values(
        "closed form, printed [deg]",
        &exact,
        &printed,
        6e-9,
        "printed",
    )];
    for formulation in 0..2 {
        let name = laws(0)[formulation].0;
        let errors: Vec<f64> = (0..4)
            .map(|level| {
                let turns = turning_angles(laws(level)[formulation].1, 1e-3 * 0.5f64.powi(level));
                let errors = turns.iter().zip(&exact).map(|(a, b)| (a - b).abs());
                errors.fold(0.0, f64::max)
            })
            .collect();
        claims.push(case.vanishing(
            &format!("turning angles, {name} [deg]"),
            &errors,
            Rule::AtLeastOrder(1.0),
            "step and law are refined together, of first order or better at the turns",
        ));
    }
    check(&claims);
}

/// The bristles' own motion converges with the first order of the formula (A04a in closed form).
#[test]
fn order_of_the_bristles() {
    let law = canudas();
    let v = 2e-3;
    let level = law.stribeck(v).0;
    let rate = law.bristle_stiffness * v / level;
    let exact = level / law.bristle_stiffness * -(-rate * 0.01f64).exp_m1();
    let errors: Vec<f64> = (0..4)
        .map(|k| {
            let steps = 50 << k;
            let mut friction = TranslationalStepper::new(Law::LuGre(law), GUIDE);
            for _ in 0..steps {
                let dt = 0.01 / f64::from(steps);
                let _ = friction.step(v, 0.0, [1.0, 0.0, 0.0], [0.0; 3], dt);
            }
            friction.state()[0] / exact - 1.0
        })
        .collect();
    let case = of_the_law(
        "A04a",
        "the stepper after a step of the velocity",
        "closed form",
    );
    let why = "backward Euler";
    check(&[case.vanishing("deflection (relative)", &errors, Rule::Order(1.0), why)]);
}

/// `s0 v/G` times the step is up to 1e13 here; an explicit formula is unstable above 2.
#[test]
fn steady_at_once_however_stiff() {
    for (stiffness, dt, v) in [(1e9, 1e3, 10.0), (1e5, 1.0, 1e-3), (1e9, 1e-3, 0.1)] {
        let law = LuGre {
            bristle_stiffness: stiffness,
            ..canudas()
        };
        let mut friction = TranslationalStepper::new(Law::LuGre(law), GUIDE);
        for direction in [1.0, -1.0, 1.0] {
            let mut force = 0.0;
            for _ in 0..3 {
                let v = direction * v;
                force = friction.step(v, 0.0, [1.0, 0.0, 0.0], [0.0; 3], dt).force[0];
            }
            let steady = -direction * (law.stribeck(v).0 + law.viscous * v);
            // What three steps leave of the old direction: (1 + s0 v dt/G)^-3 of it, and s1 times
            // the rate.
            let rest = (1.0 + stiffness * v * dt / law.stribeck(v).0).powi(-3);
            let tolerance = 3.0 * steady.abs() * rest * (1.0 + law.damping * v) + 1e-12;
            assert!((force - steady).abs() <= tolerance, "{force} {steady}");
        }
    }
}

/// Blocks of both laws on an incline below the friction angle for 1e4 s, with reactions and steps of
/// a simulator: under a constant load bristles hold as well as creep.
#[test]
fn a_block_holds_on_an_incline() {
    let angle = 10f64.to_radians();
    let (normal, along) = (9.81 * angle.cos(), 9.81 * angle.sin());
    let case = of_the_law(
        "9.4",
        "1 kg on an incline of 10° with mu 0.3, explicit stepper with 5 ms",
        "what sticks does not move",
    );
    let mut claims = Vec::new();
    for (name, law) in laws(0) {
        let mut friction = TranslationalStepper::new(law, GUIDE);
        let (mut x, mut v, dt): (f64, f64, f64) = (0.0, 0.0, 5e-3);
        let mut at_ten = 0.0;
        for step in 0..2_000_000 {
            let f = friction.step(v, x, [0.0, normal, 0.0], [0.0; 3], dt);
            v += dt * (along + f.force[0]) / (1.0 - dt * f.by_velocity[0][0]);
            x += dt * v;
            if step == 2_000 {
                at_ten = x;
            }
        }
        // Creep and deflection themselves are some 1e-4 m.
        assert!(at_ten > 1e-6 && at_ten < 1e-3, "{name}: {at_ten}");
        let quantity = format!("drift from 10 s to 1e4 s, {name} [m]");
        claims.push(case.worst(&quantity, x - at_ten, 1e-12, "rounding of 2e6 steps"));
    }
    check(&claims);
}

/// A ball in its socket stops in a straight line of its angular velocity (spherical part of 9.3).
#[test]
fn a_ball_stops_straight() {
    let law = laws(6)[0].1;
    let ball = SphericalLoad {
        inputs: Inputs::ALL,
        ball_radius: 0.02,
    };
    let mut friction = SphericalStepper::new(law, ball);
    let (mut rate, inertia, dt) = ([3.0, 0.0, -4.0], 1e-3, 1e-6);
    // 0.3 * 0.02 * 100 = 0.6 N m: stops after 1e-3 * 5/0.6 s.
    let stop = inertia * 5.0 / 0.6;
    let mut time = 0.0;
    while time < 0.9 * stop {
        let torque = friction.step(rate, [60.0, 0.0, 80.0], dt).force;
        for k in 0..3 {
            rate[k] += dt * torque[k] / inertia;
        }
        time += dt;
    }
    // Constant deceleration: only the rounding of 7500 steps.
    let left = 5.0 - 600.0 * time;
    for (w, direction) in rate.iter().zip([0.6, 0.0, -0.8]) {
        assert!((w - left * direction).abs() < 1e-10, "{rate:?} {left}");
    }
}

/// Going back to a kept state repeats a step to the last digit.
#[test]
fn a_step_can_be_done_again() {
    for (_, law) in laws(0) {
        let mut friction = TranslationalStepper::new(law, GUIDE);
        let _ = friction.step(1e-3, 0.0, [0.0, 9.81, 0.0], [0.0; 3], 1e-3);
        let kept = friction.state();
        assert!(kept[0] > 0.0);
        let first = friction.step(5e-4, 0.0, [0.0, 9.81, 0.0], [0.0; 3], 1e-3);
        friction.set_state(kept);
        let second = friction.step(5e-4, 0.0, [0.0, 9.81, 0.0], [0.0; 3], 1e-3);
        assert_eq!(first, second);
    }
}
