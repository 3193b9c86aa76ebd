//! The original law against published and independent numbers, and its physical properties.

mod shared;

use friction::step::odd_step;
use friction::{Effect, Original, Regime};
use shared::{Random, dot, law, norm, of_the_law};
use verification::check;

/// The real Adams model behind the vectors: all defaults in metres.
const ADAMS: Original = Original {
    mu_static: 1e-3,
    mu_dynamic: 5e-4,
    transition_velocity: 0.1,
    transition_coefficient: 1.5,
    max_deformation: 0.01,
    effect: Effect::All,
};

fn close(actual: f64, expected: f64, relative: f64) {
    assert!(
        (actual - expected).abs() <= relative * expected.abs(),
        "{actual} instead of {expected}, tolerance {relative}"
    );
}

/// Largest relative error.
fn worst(pairs: &[(f64, f64)]) -> f64 {
    let errors = pairs
        .iter()
        .map(|(ours, exact)| ((ours - exact) / exact).abs());
    errors.fold(0.0, |m, e| if e > m || e.is_nan() { e } else { m })
}

#[test]
fn real_adams_vectors() {
    let case = of_the_law(
        "9.1",
        "the original law, μs 1e-3, μd 5e-4, Vs 0.1, c 1.5, Dm 0.01",
        "a run of Adams Solver C++ 2015.1, samples of the specification 1.6",
    );
    let digits = "the inputs have 7 digits; μ is up to 8 times as sensitive (relatively)";
    let stuck = ADAMS.evaluate(&[0.03374113], &[9.495873e-5]);
    let faster = ADAMS.evaluate(&[0.06658201], &[3.582297e-4]);
    let resting = ADAMS.evaluate(&[0.0], &[1.998308e-9]);
    assert_eq!(resting.beta, 0.0);
    let transition = [
        (0.1013044, 9.99914657e-4),
        (0.1278806, 6.96464200e-4),
        (0.1410852, 5.21301202e-4),
    ]
    .map(|(v, mu)| {
        let transition = ADAMS.evaluate(&[v], &[0.0]);
        assert_eq!(transition.regime, Regime::Transition);
        (-transition.mu[0], mu)
    });
    let sliding = -ADAMS.evaluate(&[0.1500001], &[0.0]).mu[0];
    check(&[
        case.worst(
            "β and μ1 while stuck, relative",
            worst(&[
                (ADAMS.evaluate(&[0.05568446], &[0.0]).beta, 0.84833059),
                (stuck.beta, 0.58626987),
                (stuck.mu1, 1.780369e-5),
                (faster.beta, 0.92852143),
                (faster.mu1, 6.711063e-5),
                (resting.mu1, 3.746828e-10),
            ]),
            2e-6,
            digits,
        ),
        case.worst(
            "|μ| while stuck, relative",
            worst(&[(-faster.mu[0], 9.33130743e-4)]),
            3e-4,
            "V and D of the sample are only nearly parallel: 2e-4 below the sum of their magnitudes",
        ),
        case.worst("|μ| in transition, relative", worst(&transition), 2e-6, digits),
        case.values("|μ| sliding", &[sliding], &[5e-4], 0.0, "exact"),
    ]);
}

#[test]
fn curve() {
    let case = of_the_law(
        "9.2",
        "the original law, μs 0.3, μd 0.2, Vs 0.1, c 1.5, Dm 0.01",
        "decimal values of the polynomials",
    );
    let law = law(Effect::All);
    let mut mu = vec![(law.evaluate(&[0.05], &[0.0]).beta, 0.79296875)];
    for (v, exact) in [
        (0.05, 0.237890625),
        (0.09, 0.299305125),
        (0.11, 0.294208),
        (0.125, 0.25),
        (0.14, 0.205792),
    ] {
        mu.push((-law.evaluate(&[v], &[0.0]).mu[0], exact));
        mu.push((law.evaluate(&[-v], &[0.0]).mu[0], exact));
    }
    let creep = [
        (0.0025, 0.134875488),
        (0.005, 0.237890625),
        (0.0075, 0.290368652),
    ]
    .map(|(creep, mu1)| (law.evaluate(&[0.0], &[creep]).mu1, mu1));
    check(&[
        case.worst("β and μ by speed, relative", worst(&mu), 4e-15, "rounding"),
        case.worst(
            "μ1 by creep, relative",
            worst(&creep),
            5e-9,
            "nine digits are given",
        ),
    ]);
}

#[test]
fn effects() {
    let (v, d) = ([0.06, -0.02], [0.002, 0.003]);
    let all = law(Effect::All);
    // Below Vs stiction alone is the full law; above it the static coefficient stays.
    let stiction = law(Effect::Stiction);
    assert_eq!(stiction.evaluate(&v, &d), all.evaluate(&v, &d));
    assert_eq!(stiction.evaluate(&[0.12], &[0.0]).mu, [-0.3]);
    assert_eq!(stiction.evaluate(&[5.0], &[0.0]).mu, [-0.3]);
    // Sliding alone knows neither creep nor the static coefficient.
    let sliding = law(Effect::Sliding);
    let c = sliding.evaluate(&v, &d);
    assert_eq!(c.mu, sliding.evaluate(&v, &[0.0; 2]).mu);
    close(norm(&c.mu), 0.2 * odd_step(norm(&v) / 0.1).value, 1e-15);
    assert_eq!((c.beta, c.mu1, c.regime), (1.0, 0.0, Regime::Sliding));
    assert_eq!(sliding.evaluate(&[0.1], &[0.0]).mu, [-0.2]);
    assert_eq!(sliding.settle(&[0.0], [0.005]), [0.0]);
}

/// A block of unit mass placed at rest on an incline: position at the given times, by Runge-Kutta
/// of fourth order, settling the creep after each step.
fn block_on_incline(degrees: f64, times: &[f64]) -> Vec<f64> {
    let law = law(Effect::All);
    let (sin, cos) = degrees.to_radians().sin_cos();
    let g = 9.81;
    let h = 1e-4;
    let acceleration = |v: f64, d: f64| g * sin + law.evaluate(&[v], &[d]).mu[0] * g * cos;
    let (mut x, mut v, mut d, mut steps) = (0.0, 0.0, 0.0, 0u32);
    let mut positions = Vec::new();
    for &time in times {
        while f64::from(steps) * h < time - 0.5 * h {
            let (v1, a1) = (v, acceleration(v, d));
            let (v2, a2) = (
                v + 0.5 * h * a1,
                acceleration(v + 0.5 * h * a1, d + 0.5 * h * v1),
            );
            let (v3, a3) = (
                v + 0.5 * h * a2,
                acceleration(v + 0.5 * h * a2, d + 0.5 * h * v2),
            );
            let (v4, a4) = (v + h * a3, acceleration(v + h * a3, d + h * v3));
            let shift = h / 6.0 * (v1 + 2.0 * v2 + 2.0 * v3 + v4);
            x += shift;
            v += h / 6.0 * (a1 + 2.0 * a2 + 2.0 * a3 + a4);
            [d] = law.settle(&[v], [d + shift]);
            steps += 1;
        }
        positions.push(x);
    }
    positions
}

#[test]
fn block_comes_to_rest_and_does_not_drift() {
    let case = of_the_law(
        "9.4 law",
        "a block at rest on a slope, μs 0.3, Vs 0.1, Dm 0.01, the law alone in Runge–Kutta steps of 0.1 ms",
        "specification 9.4",
    );
    let x = block_on_incline(10.0, &[0.1, 0.2, 0.5, 1.0, 3.0]);
    let exact = [
        2.2637078e-3,
        3.5339204e-3,
        3.4402149e-3,
        3.3883e-3,
        3.3842188e-3,
    ];
    let digits = "five digits are given";
    let mut claims = vec![case.values("x(0.1 .. 3) at 10° [m]", &x, &exact, 3e-8, digits)];
    // Equilibrium creep of the closed form, then no motion at all.
    for (degrees, quantity, creep) in [
        (5.0, "x(20) at 5° [m]", 1.5815279e-3),
        (15.0, "x(20) at 15° [m]", 6.1199337e-3),
    ] {
        let x = block_on_incline(degrees, &[20.0, 40.0]);
        claims.push(case.values(quantity, &x[..1], &[creep], 5e-11, "eight digits are given"));
        close(x[1], x[0], 1e-12);
    }
    check(&claims);
}

#[test]
fn block_slips_down_a_steep_incline() {
    let case = of_the_law(
        "9.5 law",
        "a block from rest on 20°, μs 0.3, μd 0.2, Vs 0.1, Dm 0.01, the law alone",
        "specification 9.5",
    );
    let x = block_on_incline(20.0, &[1.0]);
    check(&[case.values(
        "x(1) [m]",
        &x,
        &[0.68143702],
        1e-7,
        "creep is settled every 0.1 ms",
    )]);
}

#[test]
fn slow_drive_and_reversal() {
    // Below Vs with the creep used up, friction is exactly mu_s; on reversal it lets go at once.
    let law = law(Effect::All);
    let (v, mut d) = ([0.02], [0.0]);
    for _ in 0..200 {
        d = law.settle(&v, [d[0] + 1e-4]);
    }
    assert_eq!(d, [0.01]);
    close(-law.evaluate(&v, &d).mu[0], 0.3, 1e-15);
    for _ in 0..100 {
        d = law.settle(&[-0.02], [d[0] - 1e-4]);
    }
    assert!(d[0].abs() < 1e-14, "the anchor was dragged along: {d:?}");
}

#[test]
fn settled_creep_keeps_its_direction() {
    let mut random = Random(1);
    let law = law(Effect::All);
    for _ in 0..100 {
        let size = 0.01 * (1.5 + random.number());
        let creep = random.vector::<3>(size);
        let settled = law.settle(&[0.0, 0.05, 0.0], creep);
        let expected = norm(&creep).min(0.01);
        close(norm(&settled), expected, 1e-14);
        close(dot(&settled, &creep), expected * norm(&creep), 1e-14);
        // Settling is idempotent but for rounding of the length.
        let again = law.settle(&[0.0; 3], settled);
        close(dot(&again, &settled), dot(&settled, &settled), 1e-14);
    }
}

/// Random velocities and creeps over every regime, with the exact boundaries among them.
fn states() -> impl Iterator<Item = ([f64; 3], [f64; 3])> {
    let mut random = Random(2);
    let speeds = [
        0.0, 1e-12, 1e-3, 0.05, 0.0999999, 0.1, 0.1000001, 0.12, 0.15, 0.1500001, 1.0, 1e6,
    ];
    let lengths = [0.0, 1e-15, 1e-4, 0.005, 0.0099999, 0.01, 0.0100001, 0.3];
    (0..20)
        .flat_map(move |_| speeds)
        .flat_map(move |speed| lengths.map(|length| (speed, length)))
        .map(move |(speed, length)| (random.vector(speed), random.vector(length)))
}

#[test]
fn bounded_odd_and_dissipative() {
    // One unit in the last place of each of the handful of operations.
    let rounding = 1e-15;
    for effect in [Effect::All, Effect::Stiction, Effect::Sliding] {
        let law = law(effect);
        for (v, d) in states() {
            let c = law.evaluate(&v, &d);
            let speed = norm(&v);
            assert!(norm(&c.mu) <= 0.3 * (1.0 + rounding), "{v:?} {d:?} {c:?}");
            assert!(norm(&c.direction) <= 1.0 + rounding, "{v:?} {d:?} {c:?}");
            let mirrored = law.evaluate(&v.map(|c| -c), &d.map(|c| -c));
            assert_eq!(mirrored.mu, c.mu.map(|c| -c));
            // Power of friction plus the rate of the creep's energy mu_s Dm Psi(d/Dm), whose
            // gradient is mu1 dh, never exceeds zero.
            let creep_length = norm(&d);
            let stored = if creep_length > 0.0 {
                c.mu1 * dot(&d, &v) / creep_length
            } else {
                0.0
            };
            assert!(
                dot(&c.mu, &v) + stored <= rounding * speed,
                "{v:?} {d:?} {c:?}"
            );
        }
    }
}

#[test]
fn turns_with_its_arguments() {
    // Rotation by the angle of 3-4-5 about z, then of 5-12-13 about x.
    let turn = |x: [f64; 3]| {
        let y = [0.6 * x[0] - 0.8 * x[1], 0.8 * x[0] + 0.6 * x[1], x[2]];
        [
            y[0],
            (5.0 * y[1] - 12.0 * y[2]) / 13.0,
            (12.0 * y[1] + 5.0 * y[2]) / 13.0,
        ]
    };
    for (v, d) in states() {
        let c = law(Effect::All).evaluate(&v, &d);
        let turned = law(Effect::All).evaluate(&turn(v), &turn(d));
        let (expected, tolerance) = (turn(c.mu), 1e-13);
        // At the exact boundary of the slope-free ends the speed may round either way; mu is C2.
        for i in 0..3 {
            assert!(
                (turned.mu[i] - expected[i]).abs() < tolerance,
                "{v:?} {d:?}"
            );
        }
    }
}

#[test]
fn one_dimension_is_the_axis_of_three() {
    for v in [-0.3, -0.11, -0.04, 0.0, 0.07, 0.13] {
        for d in [-0.02, -0.003, 0.0, 0.006] {
            let one = law(Effect::All).evaluate(&[v], &[d]);
            let three = law(Effect::All).evaluate(&[0.0, v, 0.0], &[0.0, d, 0.0]);
            assert_eq!(three.mu, [0.0, one.mu[0], 0.0]);
            assert_eq!(three.mu_by_velocity[1][1], one.mu_by_velocity[0][0]);
            assert_eq!(three.mu_by_creep[1][1], one.mu_by_creep[0][0]);
        }
    }
}

#[test]
fn twice_differentiable_at_the_regime_boundaries() {
    let law = law(Effect::All);
    let d = [0.004];
    for boundary in [0.1, 0.15] {
        let at = |e: f64| law.evaluate(&[boundary + e], &d);
        let e = 1e-7;
        let (below, above) = (at(-e), at(e));
        // Third derivatives are below 60/0.05^3 * 0.1 = 5e4, and 1/width * e of a slope's change.
        assert!((below.mu[0] - above.mu[0]).abs() < 1e-15);
        assert!((below.mu_by_velocity[0][0] - above.mu_by_velocity[0][0]).abs() < 5e4 * e * e);
        let curvature = (above.mu_by_velocity[0][0] - below.mu_by_velocity[0][0]) / (2.0 * e);
        assert!(
            curvature.abs() < 5e4 * e,
            "second derivative {curvature} at {boundary}"
        );
    }
    // Erasing the creep at Vs makes no jump in any derivative.
    let (kept, erased) = (law.evaluate(&[0.1], &d), law.evaluate(&[0.1], &[0.0]));
    assert_eq!(kept, erased);
}

#[test]
fn survives_extreme_numbers() {
    let law = law(Effect::All);
    for v in [0.0, 5e-324, 1e-200, 1e200, f64::MAX] {
        for d in [0.0, 5e-324, 1e-200, 1e200, f64::MAX] {
            let c = law.evaluate(&[v, -v, v], &[d, d, -d]);
            let settled = law.settle(&[v, -v, v], [d, d, -d]);
            let matrices = [
                c.mu_by_velocity,
                c.mu_by_creep,
                c.direction_by_velocity,
                c.direction_by_creep,
            ];
            let finite =
                c.mu.iter()
                    .chain(&c.direction)
                    .chain(&settled)
                    .all(|x| x.is_finite())
                    && matrices.iter().flatten().flatten().all(|x| x.is_finite());
            assert!(finite, "{v} {d}: {c:?} {settled:?}");
            assert!(norm(&c.mu) <= 0.3 * (1.0 + 1e-15));
        }
    }
}
