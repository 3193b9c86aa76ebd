//! Derivatives of the equations against differences.

use nalgebra::Vector3;

use super::*;
use crate::curve::Drawing;
use crate::rotation::Quaternion;

/// Two markers on two moving bodies in general position, displaced by `change` (12 numbers).
fn frames(change: &Local) -> [MarkerFrame; 2] {
    let mut made = [(0usize, 0.3), (1, 1.7)].map(|(body, seed): (usize, f64)| {
        let r = |k: f64| Vector3::new((seed + k).sin(), (seed * k).cos(), (k - seed).sin());
        let place = 6 * body;
        let delta = change.fixed_rows::<3>(place).into_owned();
        let theta = change.fixed_rows::<3>(place + 3).into_owned();
        let turn = Quaternion::exp(&theta).matrix();
        let omega = 0.9 * r(4.0);
        let arm = turn * r(2.0);
        MarkerFrame {
            body: Some(body),
            origin: r(1.0) + delta + arm,
            arm,
            axes: turn * Quaternion::exp(&r(3.0)).matrix(),
            velocity: 1.3 * r(5.0) + omega.cross(&arm),
            omega,
        }
    });
    made[0].body = Some(0);
    made
}

const ALL: [Equation; 16] = [
    Equation::Along(0),
    Equation::Along(2),
    Equation::Axes(2, 0),
    Equation::Axes(0, 1),
    Equation::Axes(2, 2),
    Equation::About(Axis::Z),
    Equation::About(Axis::Pin(Pin::HookeI)),
    Equation::About(Axis::Pin(Pin::HookeJ)),
    Equation::About(Axis::Pin(Pin::UniversalI)),
    Equation::About(Axis::Pin(Pin::UniversalJ)),
    Equation::Thread {
        about: Axis::Z,
        pitch: 3.0,
        start: 0.4,
    },
    Equation::Thread {
        about: Axis::PINION,
        pitch: -2.0,
        start: 0.3,
    },
    Equation::EvenTurns { away: true },
    Equation::EvenTurns { away: false },
    Equation::OnCurve {
        curve: 0,
        component: 0,
    },
    Equation::OnCurve {
        curve: 0,
        component: 1,
    },
];

/// A curve that passes where the markers are.
fn curves() -> Vec<Curve> {
    let at = |k: usize| {
        let a = 0.3 * k as f64 - 2.0;
        Vector3::new(a, 2.0 * a.sin(), 1.0 + (1.3 * a).cos())
    };
    let points: Vec<_> = (0..14).map(at).collect();
    vec![Curve::through(&points, false, Drawing::Spline).unwrap()]
}

/// Central differences of `f` over the twelve motions at step 1e-5: truncation 1e-10 times the
/// third derivative, rounding 1e-11; the tests allow 1e-8.
fn differences(f: impl Fn(&Local) -> Local) -> LocalMatrix {
    let mut slopes = LocalMatrix::zeros();
    for k in 0..12 {
        let mut step = Local::zeros();
        step[k] = 1e-5;
        slopes.set_column(k, &((f(&step) - f(&-step)) / 2e-5));
    }
    slopes
}

/// Value and Jacobian.
fn evaluated(equation: Equation, pair: &Pair<'_>, curves: &[Curve]) -> (f64, Local) {
    let mut jacobian = Local::zeros();
    let value = equation.evaluate(pair, curves, &mut jacobian);
    (value, jacobian)
}

#[test]
fn jacobian_and_stiffness_match_differences() {
    let [i, j] = frames(&Local::zeros());
    let curves = curves();
    for equation in ALL {
        let value = |x: &Local| {
            let [i, j] = frames(x);
            Local::repeat(evaluated(equation, &Pair::new(&i, &j), &curves).0)
        };
        let jacobian = differences(value).row(0).transpose();
        assert!(
            (jacobian - evaluated(equation, &Pair::new(&i, &j), &curves).1).norm() < 1e-8,
            "{equation:?}"
        );
        let gradient = |x: &Local| {
            let [i, j] = frames(x);
            evaluated(equation, &Pair::new(&i, &j), &curves).1
        };
        let stiffness = differences(gradient);
        let pair = Pair::new(&i, &j);
        let error = (stiffness - equation.stiffness(&pair, &curves).matrix(&pair)).norm();
        assert!(error < 1e-8, "{equation:?} {error}");
    }
}

/// The same markers, that of J where I is on it along `held` axes, and I at rest along them.
fn held_frames(change: &Local, held: [bool; 3]) -> [MarkerFrame; 2] {
    let [i, j] = frames(&Local::zeros());
    let free = Pair::with_held(&i, &j, held);
    let shift = free.between - free.slack;
    let drift = Pair::new(&i, &j).drift();
    let drift = drift - free.free(drift);
    let [i, mut j] = frames(change);
    let theta = change.fixed_rows::<3>(9).into_owned();
    let shift = Quaternion::exp(&theta).matrix() * shift;
    j.arm += shift;
    j.origin += shift;
    j.velocity += j.omega.cross(&shift) + drift;
    [i, j]
}

#[test]
fn derivatives_are_exact_where_displacements_are_held() {
    let ends = [
        Equation::Along(0),
        Equation::Along(1),
        Equation::Along(2),
        Equation::Axes(2, 0),
        Equation::Thread {
            about: Axis::Z,
            pitch: 3.0,
            start: 0.4,
        },
    ];
    for held in [[true; 3], [true, true, false], [false, false, true]] {
        let [i, j] = held_frames(&Local::zeros(), held);
        let pair = Pair::with_held(&i, &j, held);
        assert!((pair.between - pair.slack).norm() < 1e-15);
        let u = pair.velocities();
        for equation in ends {
            let at = |x: &Local| {
                let [i, j] = held_frames(x, held);
                evaluated(equation, &Pair::with_held(&i, &j, held), &[])
            };
            let jacobian = differences(|x| Local::repeat(at(x).0)).row(0).transpose();
            assert!((jacobian - at(&Local::zeros()).1).norm() < 1e-8);
            let stiffness = equation.stiffness(&pair, &[]);
            let matrix = stiffness.matrix(&pair);
            let error = (differences(|x| at(x).1) - matrix).norm();
            assert!(error < 1e-8, "{equation:?} {held:?} {error}");
            let change = matrix.transpose() * u;
            assert!((stiffness.rate_change(&pair) - change).norm() < 1e-12);
            let bias = change.dot(&u);
            assert!(
                (equation.bias(&pair, &[]) - bias).abs() < 1e-12,
                "{equation:?} {held:?}"
            );
        }
    }
}

/// The rates about both pins of a cross add up to the relative angular velocity.
#[test]
fn the_angles_about_two_pins_make_the_relative_rotation() {
    let [mut i, mut j] = frames(&Local::zeros());
    for (p, q, pins) in [
        (0, 1, [Pin::HookeI, Pin::HookeJ]),
        (2, 2, [Pin::UniversalI, Pin::UniversalJ]),
    ] {
        // Turn J about an axis across both pins until they are perpendicular.
        let across = i.axis(p).cross(&j.axis(q)).normalize();
        let angle = i.axis(p).dot(&j.axis(q)).asin();
        j.axes = Quaternion::exp(&(angle * across)).matrix() * j.axes;
        assert!(i.axis(p).dot(&j.axis(q)).abs() < 1e-15);
        let rates = [0.7, -1.9];
        i.omega = j.omega + rates[0] * i.axis(p) + rates[1] * j.axis(q);
        for ((pin, rate), axis) in pins.into_iter().zip(rates).zip([i.axis(p), j.axis(q)]) {
            let pair = Pair::new(&i, &j);
            let (_, jacobian) = evaluated(Equation::About(Axis::Pin(pin)), &pair, &[]);
            let found = jacobian.dot(&pair.velocities());
            assert!((found - rate).abs() < 1e-14, "{pin:?} {found} {rate}");
            // A torque about the pin acts on I along it, and the opposite on J.
            let torque = jacobian.fixed_rows::<3>(3);
            assert!((torque - axis).norm() < 1e-14, "{pin:?}");
        }
    }
}

#[test]
fn rate_change_and_bias_follow_from_the_stiffness() {
    let [i, j] = frames(&Local::zeros());
    let pair = Pair::new(&i, &j);
    let u = pair.velocities();
    let curves = curves();
    for equation in ALL {
        let stiffness = equation.stiffness(&pair, &curves);
        let change = stiffness.matrix(&pair).transpose() * u;
        let error = (stiffness.rate_change(&pair) - change).norm();
        assert!(error < 1e-12 * (1.0 + change.norm()), "{equation:?}");
        // Rate of G u along the motion with u held: ∂(G u)/∂x · u.
        let bias = change.dot(&u);
        assert!(
            (equation.bias(&pair, &curves) - bias).abs() < 1e-12 * (1.0 + bias.abs()),
            "{equation:?}"
        );
    }
}

#[test]
fn the_stiffness_connects_what_it_says() {
    let [i, j] = frames(&Local::zeros());
    let pair = Pair::new(&i, &j);
    let curves = curves();
    for equation in ALL {
        let matrix = equation.stiffness(&pair, &curves).matrix(&pair);
        for row in 0..4 {
            for column in 0..4 {
                let block = matrix.fixed_view::<3, 3>(3 * row, 3 * column);
                let connects = equation.reach().connects(row, column);
                assert_eq!(connects, block.norm() > 0.0, "{equation:?} {row} {column}");
            }
        }
    }
}

#[test]
fn equations_together_are_as_stiff_as_their_sum() {
    let [i, j] = frames(&Local::zeros());
    let pair = Pair::new(&i, &j);
    let curves = curves();
    let (mut together, mut sum) = (Stiffness::none(), LocalMatrix::zeros());
    for (k, equation) in ALL.into_iter().enumerate() {
        let multiplier = 1.0 - 0.3 * k as f64;
        together.add(equation, multiplier, &pair, &curves);
        sum += multiplier * equation.stiffness(&pair, &curves).matrix(&pair);
    }
    assert!((together.matrix(&pair) - sum).norm() < 1e-12 * sum.norm());
}
