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
//! ground axes. All derivatives are exact, also off the constraint but for displacements that are held at
//! zero ([`Pair`]); tests check them by differences.

use std::f64::consts::TAU;

#[cfg(test)]
mod equation_test;
mod stiffness;

use nalgebra::{ArrayStorage, Matrix3, SMatrix, SVector, Vector3};

use crate::curve::Curve;
use crate::state::MarkerFrame;
pub(crate) use stiffness::{Reach, Stiffness};

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

/// Two markers at an instant, and what the equations between them share.
///
/// Where equations hold `d` at zero along axes of J, its derivatives leave that part of `d` out: it is
/// zero but for what an iteration leaves. With it equations in axes that turn differently are off by
/// different parts of that, which positions where constraints depend on others (rods in line) magnify.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Pair<'a> {
    pub(crate) i: &'a MarkerFrame,
    pub(crate) j: &'a MarkerFrame,
    /// `d`, from the origin of J to that of I.
    between: Vector3<f64>,
    /// The axes of J along which `d` is held at zero.
    held: [bool; 3],
    /// The part of `d` along the other ones.
    slack: Vector3<f64>,
    /// From the centre of mass of J's body to where the forces act on it.
    reach: Vector3<f64>,
}

impl<'a> Pair<'a> {
    pub(crate) fn new(i: &'a MarkerFrame, j: &'a MarkerFrame) -> Self {
        Self::with_held(i, j, [false; 3])
    }

    /// With `d` held at zero along some axes of J.
    pub(crate) fn with_held(i: &'a MarkerFrame, j: &'a MarkerFrame, held: [bool; 3]) -> Self {
        let between = i.origin - j.origin;
        let slack = free_part(j, held, between);
        Self {
            i,
            j,
            between,
            held,
            slack,
            reach: j.arm + slack,
        }
    }

    /// The part of a vector along the axes of J that `d` is free along.
    fn free(&self, vector: Vector3<f64>) -> Vector3<f64> {
        free_part(self.j, self.held, vector)
    }

    /// The same as a matrix.
    fn free_matrix(&self) -> Matrix3<f64> {
        Matrix3::from_columns(&std::array::from_fn::<_, 3, _>(|k| {
            self.free(Vector3::ith(k, 1.0))
        }))
    }

    /// Velocities of both bodies in the order of the local motions.
    pub(crate) fn velocities(&self) -> Local {
        let centre = |m: &MarkerFrame| m.velocity - m.omega.cross(&m.arm);
        parts(
            &centre(self.i),
            &self.i.omega,
            &centre(self.j),
            &self.j.omega,
        )
    }

    /// Angular velocity of I against J.
    fn turning(&self) -> Vector3<f64> {
        self.i.omega - self.j.omega
    }

    /// Velocity of the origin of I against the body of J.
    fn drift(&self) -> Vector3<f64> {
        self.i.velocity - self.j.velocity - self.j.omega.cross(&self.slack)
    }
}

fn free_part(j: &MarkerFrame, held: [bool; 3], vector: Vector3<f64>) -> Vector3<f64> {
    match held {
        [false, false, false] => vector,
        [true, true, true] => Vector3::zeros(),
        held => (0..3)
            .filter(|&k| !held[k])
            .map(|k| j.axis(k) * j.axis(k).dot(&vector))
            .sum(),
    }
}

#[inline]
fn parts(a: &Vector3<f64>, b: &Vector3<f64>, c: &Vector3<f64>, d: &Vector3<f64>) -> Local {
    Local::from_array_storage(ArrayStorage([[
        a.x, a.y, a.z, b.x, b.y, b.z, c.x, c.y, c.z, d.x, d.y, d.z,
    ]]))
}

impl Equation {
    /// Value; writes the Jacobian by the local motions, `G`. `curves` are those of the model.
    pub(crate) fn evaluate(self, pair: &Pair<'_>, curves: &[Curve], jacobian: &mut Local) -> f64 {
        match self {
            Self::Along(k) => along(pair, k, jacobian),
            Self::Axes(k, l) => Angular::axes(pair, k, l).write(jacobian),
            Self::About(axis) => Angle::new(pair, axis).angular().write(jacobian),
            Self::Thread {
                about,
                pitch,
                start,
            } => thread(pair, about, [pitch, start], jacobian),
            Self::OnCurve { curve, component } => {
                on_curve(pair, &curves[curve], component, jacobian)
            }
            Self::EvenTurns { away } => {
                let sign = if away { 1.0 } else { -1.0 };
                let (x, y) = (Angular::axes(pair, 0, 1), Angular::axes(pair, 1, 0));
                Angular {
                    value: x.value + sign * y.value,
                    moment: x.moment + sign * y.moment,
                }
                .write(jacobian)
            }
        }
    }

    /// Value alone.
    pub(crate) fn value(self, pair: &Pair<'_>, curves: &[Curve]) -> f64 {
        match self {
            Self::About(axis) => Angle::new(pair, axis).value(),
            _ => self.evaluate(pair, curves, &mut Local::zeros()),
        }
    }

    /// Writes the Jacobian alone.
    pub(crate) fn differentiate(self, pair: &Pair<'_>, curves: &[Curve], jacobian: &mut Local) {
        match self {
            Self::About(axis) => write_moment(&Angle::new(pair, axis).moment(), jacobian),
            _ => {
                self.evaluate(pair, curves, jacobian);
            }
        }
    }

    /// `g̈` where all accelerations are zero: `Ġ u`.
    pub(crate) fn bias(self, pair: &Pair<'_>, curves: &[Curve]) -> f64 {
        match self {
            Self::Along(k) => along_bias(pair, k),
            Self::Axes(k, l) => axes_bias(pair, k, l),
            Self::About(axis) => Angle::new(pair, axis).bias(pair, axis),
            Self::Thread { about, pitch, .. } => {
                along_bias(pair, 2) - pitch / TAU * Angle::new(pair, about).bias(pair, about)
            }
            Self::OnCurve { curve, component } => on_curve_bias(pair, &curves[curve], component),
            Self::EvenTurns { away } => {
                let sign = if away { 1.0 } else { -1.0 };
                axes_bias(pair, 0, 1) + sign * axes_bias(pair, 1, 0)
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
}

fn along(pair: &Pair<'_>, k: usize, jacobian: &mut Local) -> f64 {
    let a = pair.j.axis(k);
    *jacobian = parts(&a, &pair.i.arm.cross(&a), &-a, &-pair.reach.cross(&a));
    pair.between.dot(&a)
}

fn along_bias(pair: &Pair<'_>, k: usize) -> f64 {
    let (i, j) = (pair.i, pair.j);
    let a = j.axis(k);
    let slack_rate = pair.free(pair.drift()) + j.omega.cross(&pair.slack);
    let a_rate = j.omega.cross(&a);
    let d_bias = i.omega.cross(&i.omega.cross(&i.arm)) - j.omega.cross(&j.omega.cross(&j.arm));
    a.dot(&d_bias) + 2.0 * a_rate.dot(&slack_rate) + pair.slack.dot(&j.omega.cross(&a_rate))
}

/// A function of the rotation of I against J.
struct Angular {
    value: f64,
    /// Its derivative by the rotation of I; that by the rotation of J is the opposite.
    moment: Vector3<f64>,
}

impl Angular {
    #[inline]
    fn axes(pair: &Pair<'_>, k: usize, l: usize) -> Self {
        let (a, b) = (pair.i.axis(k), pair.j.axis(l));
        Self {
            value: a.dot(&b),
            moment: a.cross(&b),
        }
    }

    /// Writes its Jacobian; returns the value.
    fn write(&self, jacobian: &mut Local) -> f64 {
        write_moment(&self.moment, jacobian);
        self.value
    }
}

/// The Jacobian of what has this derivative by the rotation of I.
fn write_moment(moment: &Vector3<f64>, jacobian: &mut Local) {
    let zero = Vector3::zeros();
    *jacobian = parts(&zero, moment, &zero, &-moment);
}

fn axes_bias(pair: &Pair<'_>, k: usize, l: usize) -> f64 {
    let (i, j) = (pair.i, pair.j);
    let (a, b) = (i.axis(k), j.axis(l));
    let (a_rate, b_rate) = (i.omega.cross(&a), j.omega.cross(&b));
    i.omega.cross(&a_rate).dot(&b) + 2.0 * a_rate.dot(&b_rate) + a.dot(&j.omega.cross(&b_rate))
}

/// An angle by its sine and cosine, both times the same.
struct Angle {
    sign: f64,
    sine: Angular,
    cosine: Angular,
    /// Sum of their squares.
    r2: f64,
}

impl Angle {
    fn new(pair: &Pair<'_>, axis: Axis) -> Self {
        let (sign, [(k, l), (m, n)]) = axis.angle();
        let (sine, cosine) = (Angular::axes(pair, k, l), Angular::axes(pair, m, n));
        let r2 = sine.value * sine.value + cosine.value * cosine.value;
        Self {
            sign,
            sine,
            cosine,
            r2,
        }
    }

    fn angular(&self) -> Angular {
        Angular {
            value: self.value(),
            moment: self.moment(),
        }
    }

    fn value(&self) -> f64 {
        self.sign * self.sine.value.atan2(self.cosine.value)
    }

    /// Derivative by the rotation of I.
    fn moment(&self) -> Vector3<f64> {
        let (sine, cosine) = (&self.sine, &self.cosine);
        let moment = (cosine.value * sine.moment - sine.value * cosine.moment) / self.r2;
        self.sign * moment
    }

    fn bias(&self, pair: &Pair<'_>, axis: Axis) -> f64 {
        let (_, [(k, l), (m, n)]) = axis.angle();
        let (s, c, r2) = (self.sine.value, self.cosine.value, self.r2);
        let turning = pair.turning();
        let (s_rate, c_rate) = (
            self.sine.moment.dot(&turning),
            self.cosine.moment.dot(&turning),
        );
        let bias = (c * axes_bias(pair, k, l) - s * axes_bias(pair, m, n)) / r2
            - 2.0 * (s * s_rate + c * c_rate) * (c * s_rate - s * c_rate) / (r2 * r2);
        self.sign * bias
    }
}

fn thread(pair: &Pair<'_>, axis: Axis, [pitch, start]: [f64; 2], jacobian: &mut Local) -> f64 {
    let factor = pitch / TAU;
    let mut turned = Local::zeros();
    let about = Angle::new(pair, axis).angular().write(&mut turned);
    let value = along(pair, 2, jacobian) - start - factor * about;
    *jacobian -= factor * turned;
    // After a whole turn the thread is the same: the turns need not be counted.
    value - pitch * (value / pitch).round()
}

/// The origin of I along the axes of J.
fn position(pair: &Pair<'_>) -> Vector3<f64> {
    pair.j.axes.tr_mul(&pair.between)
}

fn on_curve(pair: &Pair<'_>, curve: &Curve, component: usize, jacobian: &mut Local) -> f64 {
    let across = curve.across(&position(pair))[component];
    let mut moved = Local::zeros();
    jacobian.fill(0.0);
    for (k, slope) in across.gradient.iter().enumerate() {
        along(pair, k, &mut moved);
        *jacobian += *slope * moved;
    }
    across.value
}

fn on_curve_bias(pair: &Pair<'_>, curve: &Curve, component: usize) -> f64 {
    let across = curve.across(&position(pair))[component];
    let rates = pair.j.axes.tr_mul(&pair.drift());
    let slopes = across.gradient.iter().enumerate();
    slopes.fold(rates.dot(&(across.hessian * rates)), |bias, (k, slope)| {
        bias + slope * along_bias(pair, k)
    })
}
