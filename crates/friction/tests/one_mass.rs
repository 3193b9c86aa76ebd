//! One mass with friction, integrated by a reference integrator: what the laws do in a motion.

mod shared;

use friction::{Effect, LuGre, Original};
use shared::integrator::Integrator;
use shared::{canudas, of_the_law, reference, table};
use verification::check;

/// Position, velocity and deflection of 1 kg under the force `u(t, x)` on bristles with a load of 1.
fn on_bristles(law: &LuGre, u: impl Fn(f64, f64) -> f64) -> impl Fn(f64, &[f64; 3]) -> [f64; 3] {
    move |t, &[x, v, z]| {
        let b = law.evaluate(&[v], &[z], 0.0, 1.0, &[0.0], 1e-12);
        [v, u(t, x) + b.force[0], b.rate[0]]
    }
}

/// Position, velocity and creep of a mass `m` under the force `u(t, x)` on the original law with the
/// load `n`, on ground that moves with the velocity `ground`. The creep grows no further than `Dm`.
fn on_creep(
    law: &Original,
    m: f64,
    n: f64,
    ground: f64,
    u: impl Fn(f64, f64) -> f64,
) -> impl Fn(f64, &[f64; 3]) -> [f64; 3] {
    move |t, &[x, v, d]| {
        let sliding = v - ground;
        let stuck = sliding.abs() < law.transition_velocity;
        let full = d.abs() >= law.max_deformation && d * sliding > 0.0;
        let friction = n * law.evaluate(&[sliding], &[d]).mu[0];
        let creeps = stuck && !full;
        [
            v,
            (u(t, x) + friction) / m,
            if creeps { sliding } else { 0.0 },
        ]
    }
}

/// A piecewise linear function of time.
fn ramps(knots: &[[f64; 2]], t: f64) -> f64 {
    let k = knots.windows(2).position(|pair| t <= pair[1][0]);
    let Some(k) = k else {
        return knots[knots.len() - 1][1];
    };
    let [[t0, u0], [t1, u1]] = [knots[k], knots[k + 1]];
    u0 + (u1 - u0) * (t - t0) / (t1 - t0)
}

fn largest(errors: impl IntoIterator<Item = f64>) -> f64 {
    errors
        .into_iter()
        .map(f64::abs)
        .fold(0.0, |m, e| if e > m || e.is_nan() { e } else { m })
}

#[test]
fn stick_slip_a08() {
    let Some(text) = reference("validation/data/A08_cdw_stick_slip.csv") else {
        return;
    };
    let law = canudas();
    let f = on_bristles(&law, |t, x| 2.0 * (0.1 * t - x));
    let mut run = Integrator::new([0.0; 3], [1e-14, 1e-14, 1e-18], 1e-2);
    let rows = table(&text);
    assert_eq!(rows.last().unwrap()[0], 25.0);
    let [mut x, mut v, mut z] = [const { Vec::new() }; 3];
    for row in &rows {
        let state = run.to(row[0], &f);
        x.push(state[0] - row[1]);
        v.push(state[1] - row[2]);
        z.push(state[2] - row[3]);
    }
    // The start of a slip is an instability that magnifies errors a thousandfold; the reference is
    // good to 7e-12 m against itself and to 3e-10 m against another integrator.
    let case = of_the_law(
        "A08",
        "stick-slip of Canudas de Wit et al. (1995): 1 kg on 2 N/m pulled at 0.1 m/s, to 25 s",
        "independent DOP853 solution; EXUDYN publishes the end to 9 digits",
    );
    let exudyn = [1.908839199, 9.42415459e-6, 1.18167954e-5];
    check(&[
        case.worst("position [m]", largest(x), 3e-10, "of the reference"),
        case.worst("velocity [m/s]", largest(v), 1e-9, "of the reference"),
        case.worst("deflection [m]", largest(z), 1e-12, "of the reference"),
        case.values(
            "position at 25 s, EXUDYN [m]",
            &run.state[..1],
            &exudyn[..1],
            1e-9,
            "printed",
        ),
        case.values(
            "velocity at 25 s, EXUDYN [m/s]",
            &run.state[1..2],
            &exudyn[1..2],
            1e-13,
            "printed",
        ),
        case.values(
            "deflection at 25 s, EXUDYN [m]",
            &run.state[2..],
            &exudyn[2..],
            2e-13,
            "printed",
        ),
    ]);
}

#[test]
fn presliding_loop_a05() {
    let Some(text) = reference("validation/data/A05_presliding_loop.csv") else {
        return;
    };
    let law = canudas();
    let knots = [
        [0.0, 0.0],
        [5.0, 1.425],
        [6.0, 1.425],
        [16.0, -1.425],
        [17.0, -1.425],
        [27.0, 1.425],
    ];
    let f = on_bristles(&law, |t, _| ramps(&knots, t));
    let mut run = Integrator::new([0.0; 3], [1e-18; 3], 1e-2);
    let rows = table(&text);
    assert!(rows.len() > 100 && rows.last().unwrap()[0] == 27.0);
    let [mut x, mut z] = [const { Vec::new() }; 2];
    for row in &rows {
        // Rows and knots coincide: no step goes over a corner of the force.
        let state = run.to(row[0], &f);
        x.push(state[0] - row[2]);
        z.push(state[2] - row[4]);
    }
    let case = of_the_law(
        "A05",
        "1 kg in presliding, force 0, 1.425, -1.425, 1.425 N (95 % of the static friction) in ramps",
        "independent DOP853 solution, good to 9e-15 m",
    );
    check(&[
        case.worst("position [m]", largest(x), 3e-14, "of the reference"),
        case.worst("deflection [m]", largest(z), 3e-14, "of the reference"),
    ]);
}

#[test]
fn micro_vibration_a10() {
    let Some(text) = reference("validation/data/A10_stick_microvibration.csv") else {
        return;
    };
    let law = canudas();
    let f = on_bristles(&law, |_, _| 0.0);
    let mut run = Integrator::new([0.0, 1e-7, 0.0], [1e-22, 1e-20, 1e-22], 1e-3);
    let (mut exact, mut linear) = (Vec::new(), Vec::new());
    for row in table(&text) {
        let [x, ..] = run.to(row[0], &f);
        exact.push((x - row[1]) / 1.7e-10);
        linear.push((x - row[2]) / 1.7e-10);
    }
    let case = of_the_law(
        "A10",
        "1 kg stuck on bristles with 1e-7 m/s: omega 316 rad/s, damping ratio 0.5006",
        "linear closed form; independent solution",
    );
    check(&[
        case.worst(
            "position (of its largest)",
            largest(exact),
            1e-8,
            "of the reference, 1e-18 m",
        ),
        case.worst(
            "position, linear (of its largest)",
            largest(linear),
            2e-5,
            "s0 |v| z/g, neglected, is 1.4e-5 of the motion",
        ),
    ]);
}

/// Drift of `LuGre` under a load that comes and goes, and none of the original law (9.9).
#[test]
fn drift_under_cycles() {
    let (law, share) = (canudas(), 0.95);
    let (level, rate) = (1.5, 0.0285);
    let peak = share * level;
    let half = peak / rate;
    // Up, down, and a second at rest, which is an eternity for the bristles' damping.
    let cycle = 2.0 * half + 1.0;
    let knots: Vec<[f64; 2]> = (0..3)
        .flat_map(|k| {
            let t = f64::from(k) * cycle;
            [[t, 0.0], [t + half, peak], [t + 2.0 * half, 0.0]]
        })
        .chain([[3.0 * cycle, 0.0]])
        .collect();
    let f = on_bristles(&law, |t, _| ramps(&knots, t));
    let mut run = Integrator::new([0.0; 3], [1e-16; 3], 1e-2);
    let positions: Vec<f64> = knots[1..]
        .iter()
        .map(|knot| run.to(knot[0], &f)[0])
        .collect();
    let reach = level / law.bristle_stiffness;
    let first = -reach * (1.0 - share).ln();
    let drift = -reach * (1.0 - share * share).ln();
    let per_cycle = [
        positions[2],
        positions[5] - positions[2],
        positions[8] - positions[5],
    ];
    let case = of_the_law(
        "9.9",
        "1 kg under 0 to 95 % of the static friction and back, three times, at 0.0285 N/s",
        "quasi-static closed form -(Fs/s0) ln(1 - a^2); full equations 3.49568e-5 m",
    );
    let relative = per_cycle.map(|x| x / drift - 1.0);
    let exact = Original {
        mu_static: 0.15,
        mu_dynamic: 0.1,
        transition_velocity: 1e-3,
        transition_coefficient: 1.5,
        max_deformation: 1.5e-5,
        effect: Effect::All,
    };
    let g = on_creep(&exact, 1.0, 10.0, 0.0, |t, _| ramps(&knots, t));
    let mut creep = Integrator::new([0.0; 3], [1e-16; 3], 1e-2);
    let mut back = 0.0;
    for knot in &knots[1..] {
        back = creep.to(knot[0], &g)[0];
    }
    check(&[
        case.worst(
            "first loading (relative)",
            positions[0] / first - 1.0,
            0.01,
            "not quite quasi-static",
        ),
        case.worst(
            "drift per cycle (relative)",
            largest(relative),
            0.01,
            "not quite quasi-static",
        ),
        case.worst(
            "first cycle, full equations (relative)",
            per_cycle[0] / 3.49568e-5 - 1.0,
            3e-6,
            "six digits are printed",
        ),
        // In a second at rest the creep decays by its relaxation time Dm/Vs = 15 ms.
        case.worst(
            "position of ORIGINAL after three cycles [m]",
            back,
            1e-12,
            "integrator",
        ),
    ]);
}

/// Break-away force against the rate of the applied force (9.8).
#[test]
fn break_away_falls_with_the_rate() {
    let law = canudas();
    let table = [
        (1.0, 1.46073, 1.43241),
        (2.0, 1.43626, 1.39441),
        (5.0, 1.37993, 1.31321),
        (10.0, 1.30706, 1.21995),
        (20.0, 1.18908, 1.09815),
        (30.0, 1.08839, 1.00262),
        (40.0, 0.98611, 0.90938),
        (50.0, 0.85241, 0.78742),
    ];
    let [mut applied, mut friction] = [const { Vec::new() }; 2];
    for (rate, _, _) in table {
        let f = on_bristles(&law, |t, _| rate * t);
        // Short steps, so that the crossing found on a line between two is exact to 1e-9.
        let mut run = Integrator::new([0.0; 3], [1e-14; 3], 1e-5);
        let (mut before, mut crossing, mut highest) = ([0.0; 3], None, 0.0f64);
        run.run(2.0, &f, |t, y| {
            let b = law.evaluate(&[y[1]], &[y[2]], 0.0, 1.0, &[0.0], 1e-12);
            let mut now = [t, y[1], -b.force[0]];
            let crosses = now[1] >= 1e-3;
            if crosses {
                let share = (1e-3 - before[1]) / (now[1] - before[1]);
                now = core::array::from_fn(|k| before[k] + share * (now[k] - before[k]));
                crossing = Some(now[0]);
            }
            highest = highest.max(now[2]);
            before = now;
            crosses
        });
        applied.push(rate * crossing.unwrap());
        friction.push(highest);
    }
    let case = of_the_law(
        "9.8",
        "1 kg under a force that rises at 1 to 50 N/s, Canudas de Wit's set",
        "independent solution, five decimals; trend of the paper's figure 4",
    );
    let (forces, highest): (Vec<f64>, Vec<f64>) = table.iter().map(|row| (row.1, row.2)).unzip();
    check(&[
        case.values(
            "applied force at 1e-3 m/s [N]",
            &applied,
            &forces,
            6e-6,
            "printed",
        ),
        case.values(
            "largest friction before [N]",
            &friction,
            &highest,
            6e-6,
            "printed",
        ),
    ]);
}

/// The original law on an incline against independent solutions (A12a).
#[test]
fn launch_up_an_incline_a12a() {
    let Some(text) = reference("validation/data/A12_original_law.json") else {
        return;
    };
    let data: serde_json::Value = serde_json::from_str(&text).unwrap();
    let levels = data["cases"]["a_incline_launch"]["table_vs_dmax_xend_err_vend"]
        .as_array()
        .unwrap();
    assert_eq!(levels.len(), 5);
    let (m, g, angle) = (2.0, 9.80665, 30f64.to_radians());
    let [mut ours, mut references] = [const { Vec::new() }; 2];
    for level in levels {
        let number = |k: usize| level[k].as_f64().unwrap();
        let law = Original {
            mu_static: 0.6,
            mu_dynamic: 0.5,
            transition_velocity: number(0),
            transition_coefficient: 1.5,
            max_deformation: number(1),
            effect: Effect::All,
        };
        let f = on_creep(&law, m, m * g * angle.cos(), 0.0, |_, _| {
            m * g * angle.sin()
        });
        let mut run = Integrator::new([0.0, -3.0, 0.0], [1e-13; 3], 1e-3);
        // Creep ends where the mass leaves the stick; the tolerance on it finds its beginning.
        run.run(2.0, &f, |_, y| {
            if y[1].abs() >= law.transition_velocity {
                y[2] = 0.0;
            }
            false
        });
        ours.push(run.state[0]);
        references.push(number(2));
    }
    let case = of_the_law(
        "A12a",
        "2 kg up an incline of 30° at 3 m/s, mu 0.6 and 0.5, Vs from 0.02 to 0.00125 m/s",
        "independent solution with located events, 1e-9",
    );
    let limit = -0.491817844397;
    check(&[
        case.values(
            "position after 2 s [m]",
            &ours,
            &references,
            1e-9,
            "of the reference",
        ),
        case.limit(
            "stop, against the set-valued law [m]",
            &ours,
            limit,
            verification::Rule::Order(1.0),
            "the law approaches it linearly in Vs",
        ),
    ]);
}

/// A mass put on an incline at rest (A12b, 9.4): the creep overshoots its limit and settles.
#[test]
fn placed_on_an_incline_a12b() {
    let Some(text) = reference("validation/data/A12b_incline_rest_defaults_clamp.csv") else {
        return;
    };
    let law = |mu_static| Original {
        mu_static,
        mu_dynamic: 0.2,
        transition_velocity: 0.1,
        transition_coefficient: 1.5,
        max_deformation: 0.01,
        effect: Effect::All,
    };
    let (m, g, angle) = (2.0, 9.80665, 30f64.to_radians());
    let steep = law(0.6);
    let f = on_creep(&steep, m, m * g * angle.cos(), 0.0, |_, _| {
        m * g * angle.sin()
    });
    let mut run = Integrator::new([0.0; 3], [1e-14; 3], 1e-3);
    let (mut position, mut creep) = (Vec::new(), Vec::new());
    for row in table(&text) {
        let [x, _, d] = run.to(row[0], &f);
        position.push(x - row[1]);
        creep.push(d - row[3]);
    }
    let (g, angle) = (9.81, 10f64.to_radians());
    let flat = law(0.3);
    let f = on_creep(&flat, 1.0, g * angle.cos(), 0.0, |_, _| g * angle.sin());
    let mut run = Integrator::new([0.0; 3], [1e-14; 3], 1e-3);
    let ours = [0.1, 0.2, 0.5, 1.0, 3.0].map(|t| run.to(t, &f)[0]);
    let printed = [
        2.2637078e-3,
        3.5339204e-3,
        3.4402149e-3,
        3.3883e-3,
        3.3842188e-3,
    ];
    let case = of_the_law(
        "A12b",
        "a mass put on an incline at rest, defaults in metres, creep limited to Dm",
        "independent solution; the limit of the creep taken at its events",
    );
    // The reference lets the creep pass its limit by 1.6e-12 m.
    check(&[
        case.worst(
            "position at 30°, mu_s 0.6 [m]",
            largest(position),
            1e-9,
            "of the reference",
        ),
        case.worst(
            "creep at 30°, mu_s 0.6 [m]",
            largest(creep),
            1e-9,
            "of the reference",
        ),
        case.values(
            "position at 10°, mu_s 0.3 [m]",
            &ours,
            &printed,
            6e-10,
            "printed",
        ),
    ]);
}

/// Period of stick-slip on a belt (9.10).
#[test]
fn stick_slip_on_a_belt() {
    let printed = [(1e-2, 0.703075), (1e-3, 0.677820), (1e-4, 0.671488)];
    let ours = printed.map(|(speed, _)| {
        let law = Original {
            mu_static: 0.3,
            mu_dynamic: 0.2,
            transition_velocity: speed,
            transition_coefficient: 1.5,
            max_deformation: 0.1 * speed,
            effect: Effect::All,
        };
        let f = on_creep(&law, 1.0, 9.81, 0.1, |_, x| -100.0 * x);
        let mut run = Integrator::new([0.0, 0.1, 0.0], [1e-12; 3], 1e-3);
        // Slips begin where the mass falls behind the belt by a tenth of the belt's speed.
        let (mut slips, mut before) = (Vec::new(), (0.0, 0.1));
        run.run(4.0, &f, |t, y| {
            if (y[1] - 0.1).abs() >= speed {
                y[2] = 0.0;
            }
            let (t0, v0) = before;
            if v0 > 0.08 && y[1] <= 0.08 {
                slips.push(t0 + (t - t0) * (0.08 - v0) / (y[1] - v0));
            }
            before = (t, y[1]);
            false
        });
        slips[slips.len() - 1] - slips[slips.len() - 2]
    });
    let case = of_the_law(
        "9.10",
        "1 kg on 100 N/m on a belt of 0.1 m/s, mu 0.3 and 0.2, Vs from 1e-2 to 1e-4 m/s",
        "independent solution, six decimals; 0.6693571 s in the set-valued limit",
    );
    let periods = printed.map(|(_, period)| period);
    check(&[case.values("period [s]", &ours, &periods, 2e-6, "printed")]);
}
