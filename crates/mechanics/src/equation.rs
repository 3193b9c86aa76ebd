//! Scalar constraint equations between two markers and all their derivatives.
//!
//! Every joint is made of the two kinds of equations of Haug (*Computer Aided Kinematics and
//! Dynamics of Mechanical Systems*, section 9.2), with `d = o_I − o_J`:
//!
//! ```text
//! along   g = d · a_J            a_J an axis of J; the force acts at the origin of I
//! axes    g = a_I · b_J          axes of I and of J; a torque along a_I × b_J
//! ```
//!
//! and motions, friction, screws, racks and constant velocity joints add angles,
//!
//! ```text
//! about   g = ±atan2(a_I · b_J, c_I · d_J)     about z of J, or about a pin of a cross
//! thread  g = d · z_J − start − pitch/2π · (angle about z of J, or of a pinion about z of I)
//! curve   g = g_k(p), p = (d · x_J, d · y_J, d · z_J): see [`crate::curve`]
//! even    g = x_I · y_J ± y_I · x_J            shafts along z of I and of J turn evenly
//! ```
//!
//! With a multiplier λ an equation applies to I the force and torque `λ ∂g/∂(δr_I, δθ_I)`, and to J
//! `λ ∂g/∂(δr_J, δθ_J)`. The twelve local motions are `δr_I, δθ_I, δr_J, δθ_J`, rotations along
//! ground axes. All derivatives are exact, also off the constraint; tests check them by
//! differences.

use std::f64::consts::TAU;

use nalgebra::{Matrix3, SMatrix, SVector, Vector3};

use crate::curve::Curve;
use crate::rotation::skew;
use crate::state::MarkerFrame;

/// Vector over the twelve local motions of a pair of bodies.
pub(crate) type Local = SVector<f64, 12>;
/// Matrix over the twelve local motions of a pair of bodies.
pub(crate) type LocalMatrix = SMatrix<f64, 12, 12>;

/// The kinds of scalar equations.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Equation {
    /// `d · a_J` with axis `0..3` of J.
    Along(usize),
    /// Axis of I times axis of J.
    Axes(usize, usize),
    /// Angle of I against J.
    About(Axis),
    /// Displacement along z of J less what a thread of this pitch makes of an angle: that about z
    /// of J, or for a pinion I on a rack J that from z of J to x of I about z of I.
    Thread {
        /// The angle.
        about: Axis,
        /// Length a turn.
        pitch: f64,
        /// Displacement at the angle zero.
        start: f64,
    },
    /// The axis about which I is turned against J (half a turn about x taken off where z of I and J
    /// point away from one another) has no part along z: so shafts along z turn evenly however
    /// they are bent. `x_I · y_J − y_I · x_J`, with a plus in the second case.
    EvenTurns {
        /// Whether z of I and z of J point away from one another.
        away: bool,
    },
    /// One of the two functions (0 or 1) that are zero where the origin of I is on a curve of the
    /// model, which is fixed to J.
    OnCurve {
        /// Place of the curve.
        curve: usize,
        /// Which function.
        component: usize,
    },
}

/// What an angle is about.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(crate) enum Axis {
    /// z of J, which z of I is parallel to.
    Z,
    /// A pin of a cross.
    Pin(Pin),
}

/// A pin of the cross of a hooke or universal joint.
///
/// The joint has two pins at right angles, `p` fixed to I and `q` fixed to J. The angle about a pin
/// is that of the part of I against the cross (about `p`), or of the cross against the part of J
/// (about `q`), so that `ω_I − ω_J = θ̇_p p + θ̇_q q`.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Pin {
    /// x of I, the pin of I of a hooke joint.
    HookeI,
    /// y of J, the pin of J of a hooke joint.
    HookeJ,
    /// z of I, the pin of I of a universal joint.
    UniversalI,
    /// z of J, the pin of J of a universal joint.
    UniversalJ,
}

impl Pin {
    /// Whether it is fixed to I, and which axis of its marker it is.
    pub(crate) const fn axis(self) -> (bool, usize) {
        match self {
            Self::HookeI => (true, 0),
            Self::HookeJ => (false, 1),
            Self::UniversalI => (true, 2),
            Self::UniversalJ => (false, 2),
        }
    }
}

impl Axis {
    /// z of a pinion I, the angle being that from z of its rack J to x of I: as if the rack carried
    /// the other pin of a universal joint.
    pub(crate) const PINION: Self = Self::Pin(Pin::UniversalI);

    /// Sign and axes (of I, of J) of sine and cosine: the other pin seen in axes that are fixed to
    /// the part of this one. For a pin of I the part turns, not what is seen: the sign is negative.
    const fn angle(self) -> (f64, [(usize, usize); 2]) {
        match self {
            Self::Z => (1.0, [(0, 1), (0, 0)]),
            Self::Pin(Pin::HookeI) => (-1.0, [(2, 1), (1, 1)]),
            Self::Pin(Pin::HookeJ) => (1.0, [(0, 0), (0, 2)]),
            Self::Pin(Pin::UniversalI) => (-1.0, [(1, 2), (0, 2)]),
            Self::Pin(Pin::UniversalJ) => (1.0, [(2, 1), (2, 0)]),
        }
    }
}

/// An equation at an instant.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Row {
    /// `g`.
    pub(crate) value: f64,
    /// `∂g` by the local motions: the constraint Jacobian `G`.
    pub(crate) jacobian: Local,
    /// `g̈` where all accelerations are zero: `Ġ u`.
    pub(crate) bias: f64,
}

fn parts(a: &Vector3<f64>, b: &Vector3<f64>, c: &Vector3<f64>, d: &Vector3<f64>) -> Local {
    let mut local = Local::zeros();
    local.fixed_rows_mut::<3>(0).copy_from(a);
    local.fixed_rows_mut::<3>(3).copy_from(b);
    local.fixed_rows_mut::<3>(6).copy_from(c);
    local.fixed_rows_mut::<3>(9).copy_from(d);
    local
}

fn add_block(matrix: &mut LocalMatrix, row: usize, column: usize, block: &Matrix3<f64>) {
    let mut view = matrix.fixed_view_mut::<3, 3>(row, column);
    view += block;
}

impl Equation {
    /// Value, Jacobian and bias; `curves` are those of the model.
    pub(crate) fn evaluate(self, i: &MarkerFrame, j: &MarkerFrame, curves: &[Curve]) -> Row {
        match self {
            Self::Along(k) => along(i, j, k),
            Self::Axes(k, l) => axes(i, j, k, l),
            Self::About(axis) => about(i, j, axis),
            Self::Thread {
                about,
                pitch,
                start,
            } => thread(i, j, about, pitch, start),
            Self::OnCurve { curve, component } => on_curve(i, j, &curves[curve], component),
            Self::EvenTurns { away } => {
                let (x, y) = (axes(i, j, 0, 1), axes(i, j, 1, 0));
                let sign = if away { 1.0 } else { -1.0 };
                Row {
                    value: x.value + sign * y.value,
                    jacobian: x.jacobian + sign * y.jacobian,
                    bias: x.bias + sign * y.bias,
                }
            }
        }
    }

    /// The first of a body's six motions that it depends on: 3 where it is of rotations alone.
    pub(crate) const fn first_motion(self) -> usize {
        match self {
            Self::Along(_) | Self::Thread { .. } | Self::OnCurve { .. } => 0,
            Self::Axes(..) | Self::About(_) | Self::EvenTurns { .. } => 3,
        }
    }

    /// `∂(Gᵀ)/∂x` for a unit multiplier: the change of the reaction with the configuration.
    ///
    /// With the multiplier it is the geometric stiffness `∂(Gᵀλ)/∂x`; its transpose times the
    /// velocities is `∂(G u)/∂x`.
    pub(crate) fn stiffness(
        self,
        i: &MarkerFrame,
        j: &MarkerFrame,
        curves: &[Curve],
    ) -> LocalMatrix {
        match self {
            Self::Along(k) => along_stiffness(i, j, k),
            Self::Axes(k, l) => axes_stiffness(i, j, k, l),
            Self::About(axis) => about_stiffness(i, j, axis),
            Self::Thread { about, pitch, .. } => {
                along_stiffness(i, j, 2) - about_stiffness(i, j, about) * (pitch / TAU)
            }
            Self::OnCurve { curve, component } => {
                on_curve_stiffness(i, j, &curves[curve], component)
            }
            Self::EvenTurns { away } => {
                let sign = if away { 1.0 } else { -1.0 };
                axes_stiffness(i, j, 0, 1) + sign * axes_stiffness(i, j, 1, 0)
            }
        }
    }
}

/// Velocities of both bodies in the order of the local motions.
pub(crate) fn local_velocities(i: &MarkerFrame, j: &MarkerFrame) -> Local {
    let centre = |m: &MarkerFrame| m.velocity - m.omega.cross(&m.arm);
    parts(&centre(i), &i.omega, &centre(j), &j.omega)
}

fn along(i: &MarkerFrame, j: &MarkerFrame, k: usize) -> Row {
    let a = j.axis(k);
    let d = i.origin - j.origin;
    // Where the force acts, seen from J's centre of mass.
    let c = j.arm + d;
    let d_rate = i.velocity - j.velocity;
    let a_rate = j.omega.cross(&a);
    let d_bias = i.omega.cross(&i.omega.cross(&i.arm)) - j.omega.cross(&j.omega.cross(&j.arm));
    Row {
        value: d.dot(&a),
        jacobian: parts(&a, &i.arm.cross(&a), &-a, &-c.cross(&a)),
        bias: a.dot(&d_bias) + 2.0 * a_rate.dot(&d_rate) + d.dot(&j.omega.cross(&a_rate)),
    }
}

fn along_stiffness(i: &MarkerFrame, j: &MarkerFrame, k: usize) -> LocalMatrix {
    let mut matrix = LocalMatrix::zeros();
    // The pair of forces ±f at o_I, with f = a turning with J: δf = −f× δθ_J.
    let f = j.axis(k);
    let c = j.arm + i.origin - j.origin;
    let (f, rho, c) = (skew(&f), skew(&i.arm), skew(&c));
    add_block(&mut matrix, 0, 9, &-f);
    add_block(&mut matrix, 3, 3, &(f * rho));
    add_block(&mut matrix, 3, 9, &-(rho * f));
    add_block(&mut matrix, 6, 9, &f);
    add_block(&mut matrix, 9, 0, &f);
    add_block(&mut matrix, 9, 3, &-(f * rho));
    add_block(&mut matrix, 9, 6, &-f);
    add_block(&mut matrix, 9, 9, &(c * f));
    matrix
}

fn axes(i: &MarkerFrame, j: &MarkerFrame, k: usize, l: usize) -> Row {
    let (a, b) = (i.axis(k), j.axis(l));
    let n = a.cross(&b);
    let (a_rate, b_rate) = (i.omega.cross(&a), j.omega.cross(&b));
    let zero = Vector3::zeros();
    Row {
        value: a.dot(&b),
        jacobian: parts(&zero, &n, &zero, &-n),
        bias: i.omega.cross(&a_rate).dot(&b)
            + 2.0 * a_rate.dot(&b_rate)
            + a.dot(&j.omega.cross(&b_rate)),
    }
}

fn axes_stiffness(i: &MarkerFrame, j: &MarkerFrame, k: usize, l: usize) -> LocalMatrix {
    let mut matrix = LocalMatrix::zeros();
    // δ(a × b) = b×a× δθ_I − a×b× δθ_J
    let (a, b) = (skew(&i.axis(k)), skew(&j.axis(l)));
    let (by_i, by_j) = (b * a, -a * b);
    add_block(&mut matrix, 3, 3, &by_i);
    add_block(&mut matrix, 3, 9, &by_j);
    add_block(&mut matrix, 9, 3, &-by_i);
    add_block(&mut matrix, 9, 9, &-by_j);
    matrix
}

fn about(i: &MarkerFrame, j: &MarkerFrame, axis: Axis) -> Row {
    let (sign, [sine, cosine]) = axis.angle();
    let sine = axes(i, j, sine.0, sine.1);
    let cosine = axes(i, j, cosine.0, cosine.1);
    let (s, c) = (sine.value, cosine.value);
    let r2 = s * s + c * c;
    let jacobian = (c * sine.jacobian - s * cosine.jacobian) / r2;
    // Rates of s and c from their Jacobians and the velocities.
    let u = parts(&i.velocity, &i.omega, &j.velocity, &j.omega);
    let (s_rate, c_rate) = (sine.jacobian.dot(&u), cosine.jacobian.dot(&u));
    let bias = (c * sine.bias - s * cosine.bias) / r2
        - 2.0 * (s * s_rate + c * c_rate) * (c * s_rate - s * c_rate) / (r2 * r2);
    Row {
        value: sign * s.atan2(c),
        jacobian: sign * jacobian,
        bias: sign * bias,
    }
}

fn about_stiffness(i: &MarkerFrame, j: &MarkerFrame, axis: Axis) -> LocalMatrix {
    let (sign, [(k, l), (m, n)]) = axis.angle();
    let sine = axes(i, j, k, l);
    let cosine = axes(i, j, m, n);
    let (s, c) = (sine.value, cosine.value);
    let r2 = s * s + c * c;
    // δ(c/r²) and δ(s/r²), with δs and δc along their Jacobians.
    let (ds, dc) = (sine.jacobian, cosine.jacobian);
    let d_r2 = 2.0 * (s * ds + c * dc);
    let by_sine = (dc - d_r2 * (c / r2)) / r2;
    let by_cosine = (ds - d_r2 * (s / r2)) / r2;
    sign * (axes_stiffness(i, j, k, l) * (c / r2) - axes_stiffness(i, j, m, n) * (s / r2)
        + ds * by_sine.transpose()
        - dc * by_cosine.transpose())
}

fn thread(i: &MarkerFrame, j: &MarkerFrame, axis: Axis, pitch: f64, start: f64) -> Row {
    let (along, about) = (along(i, j, 2), about(i, j, axis));
    let factor = pitch / TAU;
    let value = along.value - start - factor * about.value;
    Row {
        // After a whole turn the thread is the same: the turns need not be counted.
        value: value - pitch * (value / pitch).round(),
        jacobian: along.jacobian - factor * about.jacobian,
        bias: along.bias - factor * about.bias,
    }
}

/// The origin of I along the axes of J: three equations of their own.
fn position(i: &MarkerFrame, j: &MarkerFrame) -> ([Row; 3], Vector3<f64>) {
    let rows = [0, 1, 2].map(|axis| along(i, j, axis));
    let p = Vector3::from(rows.map(|row| row.value));
    (rows, p)
}

fn on_curve(i: &MarkerFrame, j: &MarkerFrame, curve: &Curve, component: usize) -> Row {
    let (rows, p) = position(i, j);
    let across = curve.across(&p)[component];
    let u = local_velocities(i, j);
    let rates = Vector3::from(rows.map(|row| row.jacobian.dot(&u)));
    let mut row = Row {
        value: across.value,
        jacobian: Local::zeros(),
        bias: rates.dot(&(across.hessian * rates)),
    };
    for (slope, along) in across.gradient.iter().zip(&rows) {
        row.jacobian += *slope * along.jacobian;
        row.bias += slope * along.bias;
    }
    row
}

fn on_curve_stiffness(
    i: &MarkerFrame,
    j: &MarkerFrame,
    curve: &Curve,
    component: usize,
) -> LocalMatrix {
    let (rows, p) = position(i, j);
    let across = curve.across(&p)[component];
    let mut matrix = LocalMatrix::zeros();
    for a in 0..3 {
        matrix += across.gradient[a] * along_stiffness(i, j, a);
        for b in 0..3 {
            let bend = across.hessian[(a, b)];
            matrix += bend * rows[a].jacobian * rows[b].jacobian.transpose();
        }
    }
    matrix
}

#[cfg(test)]
mod tests {
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

    #[test]
    fn jacobian_and_stiffness_match_differences() {
        let [i, j] = frames(&Local::zeros());
        let curves = curves();
        for equation in ALL {
            let value = |x: &Local| {
                let [i, j] = frames(x);
                Local::repeat(equation.evaluate(&i, &j, &curves).value)
            };
            let jacobian = differences(value).row(0).transpose();
            assert!(
                (jacobian - equation.evaluate(&i, &j, &curves).jacobian).norm() < 1e-8,
                "{equation:?}"
            );
            let gradient = |x: &Local| {
                let [i, j] = frames(x);
                equation.evaluate(&i, &j, &curves).jacobian
            };
            let stiffness = differences(gradient);
            let error = (stiffness - equation.stiffness(&i, &j, &curves)).norm();
            assert!(error < 1e-8, "{equation:?} {error}");
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
                let row = Equation::About(Axis::Pin(pin)).evaluate(&i, &j, &[]);
                let found = row.jacobian.dot(&local_velocities(&i, &j));
                assert!((found - rate).abs() < 1e-14, "{pin:?} {found} {rate}");
                // A torque about the pin acts on I along it, and the opposite on J.
                let torque = row.jacobian.fixed_rows::<3>(3);
                assert!((torque - axis).norm() < 1e-14, "{pin:?}");
            }
        }
    }

    #[test]
    fn bias_is_the_acceleration_at_constant_velocities() {
        let [i, j] = frames(&Local::zeros());
        let u = local_velocities(&i, &j);
        let curves = curves();
        for equation in ALL {
            // Rate of G u along the motion with u held: ∂(G u)/∂x · u.
            let bias = (equation.stiffness(&i, &j, &curves).transpose() * u).dot(&u);
            let row = equation.evaluate(&i, &j, &curves);
            assert!(
                (row.bias - bias).abs() < 1e-12 * (1.0 + bias.abs()),
                "{equation:?}"
            );
        }
    }
}
