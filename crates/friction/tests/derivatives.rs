//! Every derivative against finite differences, in every regime and at its boundaries.

mod shared;

use friction::{
    Coefficient, Effect, Inputs, Load, Original, RevoluteLoad, SphericalLoad, TranslationalLoad,
    resultant,
};
use shared::{Random, law, norm, slope};

fn moved<const N: usize>(x: &[f64; N], j: usize, e: f64) -> [f64; N] {
    core::array::from_fn(|i| if i == j { x[i] + e } else { x[i] })
}

fn check<const N: usize>(exact: [f64; N], numeric: [f64; N], scale: f64, what: &str) {
    for i in 0..N {
        assert!(
            (exact[i] - numeric[i]).abs() <= scale,
            "{what}: component {i} is {} and should be {}",
            exact[i],
            numeric[i]
        );
    }
}

fn column<const N: usize>(matrix: &[[f64; N]; N], j: usize) -> [f64; N] {
    core::array::from_fn(|i| matrix[i][j])
}

/// Compares all four Jacobians of the coefficient and the two of the clipped, preloaded resultant.
fn jacobians<const N: usize>(law: &Original, v: &[f64; N], d: &[f64; N]) {
    let force = |c: &Coefficient<N>| resultant(c, 10.0, 3.0, 1.7);
    let c = law.evaluate(v, d);
    let f = force(&c);
    // Steps of 1e-4 of each scale. Error of the sixth-order formula: below 1e-10 of the slope away
    // from the regime boundaries and, across them, where third derivatives jump, below 1e-6 of it.
    // Rounding: 1e-16/1e-4 of the same unit. A wrong or missing term is of order 1.
    let (hv, hd) = (1e-4 * law.transition_velocity, 1e-4 * law.max_deformation);
    let (tv, td) = (1e-6 / law.transition_velocity, 1e-6 / law.max_deformation);
    // At V = 0 the clipped force has terms in V|V|: the differences are of first order there.
    let tfv = if norm(v) == 0.0 {
        2e-3 / law.transition_velocity
    } else {
        13.0 * tv
    };
    // The clip has a kink: only compare well away from it.
    let clip_is_settled = (10.0 * norm(&c.mu) / 1.7 - 1.0).abs() > 1e-2;
    for j in 0..N {
        let at_v = |e: f64| law.evaluate(&moved(v, j, e), d);
        let at_d = |e: f64| law.evaluate(v, &moved(d, j, e));
        let place = format!("V = {v:?}, D = {d:?}, column {j}");
        check(
            column(&c.mu_by_velocity, j),
            slope(hv, |e| at_v(e).mu),
            tv,
            &place,
        );
        check(
            column(&c.mu_by_creep, j),
            slope(hd, |e| at_d(e).mu),
            td,
            &place,
        );
        check(
            column(&c.direction_by_velocity, j),
            slope(hv, |e| at_v(e).direction),
            tv,
            &place,
        );
        check(
            column(&c.direction_by_creep, j),
            slope(hd, |e| at_d(e).direction),
            td,
            &place,
        );
        if clip_is_settled {
            check(
                column(&f.by_velocity, j),
                slope(hv, |e| force(&at_v(e)).force),
                tfv,
                &place,
            );
            check(
                column(&f.by_creep, j),
                slope(hd, |e| force(&at_d(e)).force),
                13.0 * td,
                &place,
            );
        }
    }
    let by_load = slope(1e-4, |e| resultant(&c, 10.0 + e, 3.0, 1.7).force);
    if clip_is_settled {
        check(f.by_load, by_load, 1e-9, "by load");
    }
}

/// Speeds in units of `Vs` and creeps in units of `Dm`: inside every regime, on its boundaries, at
/// zero, beyond the largest creep. Values within the reach of a difference (3e-4) of a kink that is
/// not a boundary are left out.
const SPEEDS: [f64; 11] = [0.0, 0.01, 0.2, 0.5, 0.9, 1.0, 1.1, 1.3, 1.5, 1.7, 30.0];
const CREEPS: [f64; 8] = [0.0, 0.01, 0.3, 0.7, 0.99, 1.0, 1.2, 5.0];

#[test]
fn coefficient_and_resultant() {
    let mut random = Random(3);
    for effect in [Effect::All, Effect::Stiction, Effect::Sliding] {
        let law = law(effect);
        for speed in SPEEDS {
            for creep in CREEPS {
                let (v, d) = (speed * law.transition_velocity, creep * law.max_deformation);
                for sign in [-1.0, 1.0] {
                    jacobians(&law, &[v], &[sign * d]);
                }
                for _ in 0..5 {
                    jacobians::<2>(&law, &random.vector(v), &random.vector(d));
                    jacobians::<3>(&law, &random.vector(v), &random.vector(d));
                }
            }
        }
    }
}

/// Compares the derivatives of a load, whose pieces are lengths of vectors of about the size 100.
fn load_jacobians(
    evaluate: impl Fn([f64; 3], [f64; 3], f64) -> Load,
    f: [f64; 3],
    m: [f64; 3],
    x: f64,
) {
    let load = evaluate(f, m, x);
    // Step 1e-3 on magnitudes of at least 1: sixth-order error 1e-18, rounding 1e-13/1e-3.
    let (h, tolerance) = (1e-3, 1e-8 + 1e-12 * load.value);
    for j in 0..3 {
        let numeric = slope(h, |e| [evaluate(moved(&f, j, e), m, x).value]);
        check([load.by_force[j]], numeric, tolerance, "by force");
        let numeric = slope(h, |e| [evaluate(f, moved(&m, j, e), x).value]);
        check([load.by_moment[j]], numeric, tolerance, "by moment");
    }
    let numeric = slope(1e-4, |e| [evaluate(f, m, x + e).value]);
    check([load.by_displacement], numeric, 1e-6, "by displacement");
    let sum = load.from_reaction + load.from_bending + load.from_torsion;
    assert_eq!(load.value, sum);
}

#[test]
fn loads() {
    let mut random = Random(4);
    let switches = [false, true];
    for reaction_force in switches {
        for bending_moment in switches {
            for torsional_moment in switches {
                let inputs = Inputs {
                    preload: true,
                    reaction_force,
                    bending_moment,
                    torsional_moment,
                };
                let guide = |overlap_sign| TranslationalLoad {
                    inputs,
                    reaction_arm: 0.7,
                    bending_factor: 1.5,
                    initial_overlap: 0.6,
                    overlap_sign,
                };
                let pin = RevoluteLoad {
                    inputs,
                    pin_radius: 0.5,
                    friction_arm: 0.8,
                    bending_reaction_arm: 2.0,
                };
                let ball = SphericalLoad {
                    inputs,
                    ball_radius: 0.3,
                };
                for _ in 0..20 {
                    let f = random.vector(100.0);
                    let m = random.vector(20.0);
                    // +-0.3 moves the overlap by half; -2 exhausts it.
                    for x in [-0.3, 0.0, 0.3, -2.0] {
                        for sign in [-1.0, 0.0, 1.0] {
                            load_jacobians(|f, m, x| guide(sign).evaluate(f, m, x), f, m, x);
                        }
                    }
                    load_jacobians(|f, m, _| pin.evaluate(f, m), f, m, 0.0);
                    load_jacobians(|f, _, _| ball.evaluate(f), f, m, 0.0);
                }
                // Where a magnitude vanishes its derivative is taken as zero: differences agree
                // because they are symmetric.
                for (f, m) in [([0.0; 3], [0.0; 3]), ([0.0, 0.0, 5.0], [0.0, 0.0, 5.0])] {
                    load_jacobians(|f, m, x| guide(1.0).evaluate(f, m, x), f, m, 0.1);
                    load_jacobians(|f, m, _| pin.evaluate(f, m), f, m, 0.0);
                    load_jacobians(|f, _, _| ball.evaluate(f), f, m, 0.0);
                }
            }
        }
    }
}
