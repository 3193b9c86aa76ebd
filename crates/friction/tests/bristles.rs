//! The LuGre law at prescribed velocities: steady state, memory, and every derivative.

mod shared;

use friction::{
    LuGre, Resultant, bristle_resultant, cylindrical_bristle_resultant, cylindrical_resultant,
};
use shared::integrator::Integrator;
use shared::{Random, canudas, law, norm, of_the_law, reference, slope, table};
use verification::check;

/// Largest of some errors; one that is not a number wins.
fn worst(errors: impl IntoIterator<Item = f64>) -> f64 {
    errors
        .into_iter()
        .fold(0.0, |m, e| if e > m || e.is_nan() { e } else { m })
}

/// Friction opposing a velocity, and the rate of the deflection `z`, at an instant.
fn at(law: &LuGre, v: f64, z: f64, load: f64) -> (f64, f64) {
    let b = law.evaluate(&[v], &[z], 0.0, load, &[0.0], 1e-12);
    (-b.force[0], b.rate[0])
}

#[test]
fn steady_state_a03() {
    let Some(text) = reference("validation/data/A03_lugre_steady_state.json") else {
        return;
    };
    let data: serde_json::Value = serde_json::from_str(&text).unwrap();
    let numbers = |value: &serde_json::Value| -> Vec<f64> {
        let list = value.as_array().unwrap();
        list.iter().map(|x| x.as_f64().unwrap()).collect()
    };
    let (mut force, mut curve, mut count) = (Vec::new(), Vec::new(), 0);
    for set in data["sets"].as_object().unwrap().values() {
        let number = |key: &str| set[key].as_f64().unwrap();
        let law = LuGre {
            mu_static: number("Fs"),
            mu_dynamic: number("Fd"),
            bristle_stiffness: 1e4,
            damping: 100.0,
            viscous: number("sigma2"),
            stribeck_velocity: number("vs"),
            stribeck_exponent: number("alpha"),
        };
        let (speeds, forces, levels) = (numbers(&set["v"]), numbers(&set["F"]), numbers(&set["g"]));
        for ((v, f), g) in speeds.into_iter().zip(forces).zip(levels) {
            // The deflection of steady motion, for either direction.
            let z = law.stribeck(v).0 / law.bristle_stiffness;
            for sign in [1.0, -1.0] {
                let (ours, rate) = at(&law, sign * v, sign * z, 1.0);
                force.push((sign * ours / f - 1.0).abs());
                // Steady: what is left of the rate is rounding of the speed.
                assert!(rate.abs() <= 4e-16 * v, "{rate} at {v}");
            }
            curve.push((law.stribeck(v).0 / g - 1.0).abs());
            count += 1;
        }
    }
    assert!(count >= 40);
    let model = "LuGre in steady motion, exponents 2, 1 and 1/2, and the set of example 103";
    let case = of_the_law("A03", model, "closed form");
    // The argument of the exponential carries its own rounding times its size, up to 10 here.
    check(&[
        case.worst("friction (relative)", worst(force), 1e-14, "rounding"),
        case.worst("Stribeck curve (relative)", worst(curve), 1e-14, "rounding"),
    ]);
}

#[test]
fn steps_of_the_velocity_a04() {
    let law = canudas();
    let mut claims = Vec::new();
    let files = [
        ("A04a", "A04a_velocity_step_v0.002.csv", 2e-3, 0.0),
        ("A04b", "A04b_velocity_reversal.csv", -1e-3, f64::NAN),
    ];
    for (id, file, v, z0) in files {
        let Some(text) = reference(&format!("validation/data/{file}")) else {
            return;
        };
        let rows = table(&text);
        assert!(rows.len() >= 7);
        let z0 = if z0.is_nan() { rows[0][1] } else { z0 };
        let mut run = Integrator::new([z0], [1e-19], 1e-3);
        let (mut deflection, mut force) = (Vec::new(), Vec::new());
        for row in &rows {
            let [z] = run.to(row[0], |_, y| [at(&law, v, y[0], 1.0).1]);
            deflection.push(z - row[1]);
            force.push(at(&law, v, z, 1.0).0 - row[3]);
        }
        let model = format!("Canudas de Wit's set after a step of the velocity to {v} m/s");
        let case = of_the_law(id, &model, "closed form, exponential in time");
        let size = |errors: Vec<f64>| worst(errors.into_iter().map(f64::abs));
        // The integrator keeps 1e-19 m a step over at most some hundred steps; s0 makes it newtons.
        claims.push(case.worst("deflection [m]", size(deflection), 1e-17, "integrator"));
        claims.push(case.worst("friction [N]", size(force), 1e-12, "integrator"));
    }
    check(&claims);
}

#[test]
fn varying_load_a04c() {
    let Some(text) = reference("validation/data/A04c_varying_normal_force.csv") else {
        return;
    };
    let law = LuGre {
        mu_static: 0.3,
        mu_dynamic: 0.25,
        bristle_stiffness: 1e4,
        damping: 100.0,
        viscous: 0.0,
        stribeck_velocity: 1e-3,
        stribeck_exponent: 2.0,
    };
    let load = |t: f64| 100.0 * (1.0 + 0.5 * (20.0 * t).sin());
    let rows = table(&text);
    assert!(rows.len() >= 7);
    let mut run = Integrator::new([0.0], [1e-17], 1e-3);
    let (mut deflection, mut force) = (Vec::new(), Vec::new());
    for row in rows {
        let [z] = run.to(row[0], |t, y| [at(&law, 0.01, y[0], load(t)).1]);
        deflection.push((z - row[1]).abs());
        force.push((at(&law, 0.01, z, load(row[0])).0 - row[2]).abs());
    }
    let case = of_the_law(
        "A04c",
        "LuGre at 0.01 m/s under the load 100 (1 + sin(20 t)/2) N, stiffness not scaled by the load",
        "independent Radau solution, 1e-12",
    );
    // The reference is good to 1e-12 relative of 2e-3 m and 20 N; scaled bristles differ by 1e-4 m.
    check(&[
        case.worst(
            "deflection [m]",
            worst(deflection),
            1e-14,
            "of the reference",
        ),
        case.worst("friction [N]", worst(force), 1e-10, "of the reference"),
    ]);
}

#[test]
fn frictional_lag_a04d() {
    let law = canudas();
    let mut claims = Vec::new();
    for omega in [1.0, 10.0, 25.0] {
        let Some(text) = reference(&format!("validation/data/A04d_lag_w{omega}.csv")) else {
            return;
        };
        let velocity = |t: f64| 1e-3 * (1.5 + (omega * t).cos());
        let period = core::f64::consts::TAU / omega;
        let mut run = Integrator::new([1e-5], [1e-19], period / 200.0);
        // The slowest decay is at 0.5e-3 m/s, s0 v/g = 36/s: some periods are an eternity.
        let start = (2.0 / period).ceil() * period + period;
        run.to(start, |t, y| [at(&law, velocity(t), y[0], 1.0).1]);
        let rows = table(&text);
        assert!(rows.len() >= 49);
        let errors = rows.into_iter().map(|row| {
            let t = start + row[0] / omega;
            let [z] = run.to(t, |t, y| [at(&law, velocity(t), y[0], 1.0).1]);
            (at(&law, row[1], z, 1.0).0 - row[3]).abs()
        });
        let model = format!("Canudas de Wit's set at v = 1e-3 (1.5 + cos {omega} t) m/s, periodic");
        let case = of_the_law("A04d", &model, "independent DOP853 solution, 1e-13");
        // 1e-19 m a step over 600 steps, times s0.
        claims.push(case.worst("friction [N]", worst(errors), 1e-11, "integrators"));
    }
    check(&claims);
}

/// Compares the derivatives of a friction by velocity and load with differences. `rounding` is the
/// error of a friction as a share of `size`.
fn derivatives<const N: usize>(
    friction: impl Fn(&[f64; N], f64) -> Resultant<N>,
    v: &[f64; N],
    load: f64,
    size: f64,
    place: &str,
) {
    let exact = friction(v, load);
    // Steps of a thousandth: the sixth-order formula is good to 1e-12 of the derivatives for
    // functions of v/vs and load with scales of one; the exponent 1/2 and the decay of the bristles
    // at gamma s0 v/G of 1e4 cost some digits. A wrong or missing term is of order one.
    let (h, hn) = (1e-3 * norm(v), 1e-3 * load.max(1e-3));
    let mut moved = *v;
    for j in 0..N {
        let numeric = slope(h, |e| {
            let mut v = *v;
            v[j] += e;
            friction(&v, load).force
        });
        for k in 0..N {
            moved[k] = exact.by_velocity[k][j];
        }
        let scale = norm(&numeric).max(norm(&moved));
        let tolerance = 1e-7 * scale + 1e-14 * size / h;
        for k in 0..N {
            let error = (moved[k] - numeric[k]).abs();
            assert!(
                error <= tolerance,
                "{place}: {moved:?} and {numeric:?} by V[{j}]"
            );
        }
    }
    let numeric = slope(hn, |e| friction(v, load + e).force);
    let tolerance = 1e-9 * norm(&numeric) + 1e-14 * size / hn;
    for k in 0..N {
        let error = (exact.by_load[k] - numeric[k]).abs();
        assert!(
            error <= tolerance,
            "{place}: {:?} and {numeric:?} by load",
            exact.by_load
        );
    }
}

const ARM: f64 = 0.05;

/// The law bare, and behind its resultant with a limit that is active and one that is not.
fn bristles<const N: usize>(law: &LuGre, random: &mut Random, preload: [f64; N], floor: bool) {
    let load = if floor { 0.0 } else { 2.0 };
    let least = if floor { 5.0 } else { 1e-12 };
    for speed in [0.03, 0.5, 1.0, 2.0, 7.0, 300.0] {
        let v = random.vector::<N>(speed * law.stribeck_velocity);
        // The deflection as a share of the one of steady motion; more than one after unloading.
        for share in [0.0, 0.4, 0.95, 3.0] {
            let level =
                load * law.stribeck(norm(&v)).0 + preload[0] + if floor { 5.0 } else { 0.0 };
            let z = random.vector::<N>(share * level / law.bristle_stiffness);
            for gamma in [0.0, 1e-6, 1e-3, 10.0] {
                let place = format!("{law:?} V {v:?} z {z:?} gamma {gamma} preload {preload:?}");
                let evaluate =
                    |v: &[f64; N], n: f64| law.evaluate(v, &z, gamma, n, &preload, least);
                let b = evaluate(&v, load);
                // All terms that cancel are of the size of the level or of the past deflection.
                let size = 3.0 * level + law.damping * norm(&v) + share * level;
                let free = ARM * norm(&b.force);
                // A limit near the friction would have its kink within the reach of a difference.
                let limits = if free > 0.1 * ARM * size {
                    [1e40, 0.7 * free]
                } else {
                    [1e40; 2]
                };
                for limit in limits {
                    // At the floor the load's derivative is zero on both sides.
                    derivatives(
                        |v, load| {
                            // The joint's load is the arm times the load at the surface.
                            bristle_resultant(&evaluate(v, load / ARM), ARM, limit)
                        },
                        &v,
                        ARM * load,
                        size,
                        &place,
                    );
                }
            }
        }
    }
}

#[test]
fn derivatives_of_bristles() {
    let mut random = Random(11);
    for exponent in [0.5, 1.0, 1.7, 2.0] {
        for (mu_static, damping) in [(0.3, 300.0), (0.2, 0.0)] {
            let law = LuGre {
                mu_static,
                mu_dynamic: 0.2,
                bristle_stiffness: 1e4,
                damping,
                viscous: 0.4,
                stribeck_velocity: 1e-2,
                stribeck_exponent: exponent,
            };
            for floor in [false, true] {
                bristles(&law, &mut random, [0.0], floor);
                bristles(&law, &mut random, [0.0; 2], floor);
                bristles(&law, &mut random, [0.0; 3], floor);
            }
            bristles(&law, &mut random, [0.3], false);
            bristles(&law, &mut random, [0.3, 0.7], false);
            bristles(&law, &mut random, [0.3; 3], false);
        }
    }
}

/// Limits as shares of a friction, and none where it is so small that a difference may cross it.
fn limits(share: [f64; 2], free: &[f64; 2]) -> [f64; 2] {
    core::array::from_fn(|k| {
        if free[k].abs() > 0.1 * norm(free) {
            share[k] * free[k].abs()
        } else {
            1e40
        }
    })
}

#[test]
fn derivatives_of_cylindrical_friction() {
    let mut random = Random(12);
    let bristles = LuGre {
        mu_static: 0.3,
        mu_dynamic: 0.2,
        bristle_stiffness: 1e4,
        damping: 300.0,
        viscous: 0.4,
        stribeck_velocity: 1e-2,
        stribeck_exponent: 2.0,
    };
    let original = law(friction::Effect::All);
    for _ in 0..200 {
        // Limits of force and torque as shares of what there would be without.
        for share in [[3.0, 3.0], [0.6, 3.0], [3.0, 0.6], [0.6, 0.6]] {
            let v = random.vector::<2>(0.02);
            let z = random.vector::<2>(3e-5);
            let at = |v: &[f64; 2], n: f64| bristles.evaluate(v, &z, 1e-3, n, &[0.1, 0.2], 1e-12);
            let free = at(&v, 2.0).force;
            let limit = limits(share, &free);
            let limit = [limit[0], ARM * limit[1]];
            let place = format!("V {v:?} z {z:?} limit {limit:?}");
            let friction =
                |v: &[f64; 2], n: f64| cylindrical_bristle_resultant(&at(v, n), ARM, limit);
            derivatives(friction, &v, 2.0, 10.0, &place);

            let v = random.vector::<2>(0.07);
            let d = random.vector::<2>(0.004);
            let limit = limits(share, &original.evaluate(&v, &d).mu);
            let limit = [2.0 * limit[0], 2.0 * ARM * limit[1]];
            let put = |v: &[f64; 2], d: &[f64; 2], n: f64| {
                cylindrical_resultant(&original.evaluate(v, d), n, ARM, [0.3, 0.01], limit)
            };
            derivatives(|v, n| put(v, &d, n), &v, 2.0, 1.0, &place);
            // By the creep in the same way, with the velocity given.
            let by_creep = |d: &[f64; 2], n: f64| {
                let r = put(&v, d, n);
                Resultant {
                    by_velocity: r.by_creep,
                    ..r
                }
            };
            derivatives(by_creep, &d, 2.0, 1.0, &place);
        }
    }
}

/// `z = past + gamma z'` holds for the deflection and rate returned, whatever the step.
#[test]
fn the_formula_of_the_step_holds() {
    let (law, mut random) = (canudas(), Random(13));
    for gamma in [0.0, 1e-6, 1e-3, 1.0, 1e6] {
        for _ in 0..100 {
            let speed = 10f64.powf(-3.0 + 3.0 * random.number());
            let v = random.vector::<3>(speed);
            let past = random.vector::<3>(1e-5);
            let b = law.evaluate(&v, &past, gamma, 1.0, &[0.0; 3], 1e-12);
            let at_end = law.evaluate(&v, &b.deflection, 0.0, 1.0, &[0.0; 3], 1e-12);
            for k in 0..3 {
                let step = gamma * b.rate[k];
                // Rounding of the terms; the rate itself is a difference of terms of the size v.
                let size = past[k].abs() + step.abs() + 1e-5;
                assert!(
                    (b.deflection[k] - past[k] - step).abs()
                        <= 4e-15 * size + 1e-15 * gamma * norm(&v)
                );
                assert!((b.rate[k] - at_end.rate[k]).abs() <= 1e-14 * norm(&v));
            }
        }
    }
}

/// The bristles give energy out for a moment above the passive speed, and never below it: at the
/// deflection that is worst, `s0 z = s1 v/2`, the sign changes just there.
#[test]
fn the_passive_speed_is_sharp() {
    let law = LuGre {
        viscous: 0.0,
        damping: 1e4,
        ..canudas()
    };
    // Level and speed depend on one another; far above the Stribeck velocity the level is mu_d N.
    let load = 50.0;
    let limit = law.passive_speed(law.mu_dynamic * load);
    assert!(limit > 5.0 * law.stribeck_velocity);
    for (share, gives) in [(0.99, false), (1.01, true)] {
        let v = share * limit;
        let z = 0.5 * law.damping * v / law.bristle_stiffness;
        let (friction, rate) = at(&law, v, z, load);
        let dissipated = friction * v - law.bristle_stiffness * z * rate;
        assert_eq!(dissipated < 0.0, gives, "{dissipated} at {v}");
    }
}
