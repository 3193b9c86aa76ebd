//! Kinematic quantities between markers, as functions read them.
//!
//! Every quantity of displacement or velocity is written once over a number type, so that its
//! exact derivatives by the motions of each body, and its rates in time, come from the same lines.
//! `d = o_i − o_j`; components are along the axes of marker k; velocities and accelerations are
//! those seen from marker l. Ground stands for markers that a function leaves out.

use nalgebra::Vector3;

use crate::rotation;
use crate::scalar::{Dual, Jet, Scalar, Triple};
use crate::state::MarkerFrame;

/// The quantities, named after the functions of the dataset language.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Quantity {
    /// DX, DY, DZ: component of `d` along axis 0, 1 or 2 of k.
    Displacement(usize),
    /// DM: `|d|`.
    Distance,
    /// AX, AY, AZ: rotation of i about axis 0, 1 or 2 of j, continuous over many turns.
    Rotation(usize),
    /// PSI, THETA, PHI: body-fixed 3-1-3 angle 0, 1 or 2 of i in j.
    Euler(usize),
    /// YAW, PITCH, ROLL: body-fixed 3-2-1 angle 0, 1 or 2 of i in j; pitch with the opposite sign.
    YawPitchRoll(usize),
    /// B1, B2, B3 of a motion: body-fixed 1-2-3 angle 0, 1 or 2 of i in j.
    Body123(usize),
    /// INCANG: angle at j between the lines to i and to k.
    IncludedAngle,
    /// ORIENT type 27: Euler parameter 0 to 3 of i in j.
    EulerParameter(usize),
    /// VX, VY, VZ: component along k of the rate of `d` seen from l.
    Velocity(usize),
    /// VM: its magnitude.
    Speed,
    /// VR: rate of `|d|`, positive apart.
    SeparationRate,
    /// WX, WY, WZ: component along k of the angular velocity of i against j.
    AngularVelocity(usize),
    /// WM: its magnitude.
    AngularSpeed,
    /// ACCX, ACCY, ACCZ: component along k of the second derivative of `d` seen from l.
    Acceleration(usize),
    /// ACCM: its magnitude.
    AccelerationMagnitude,
    /// WDTX, WDTY, WDTZ: component along k of the rate, seen from l, of the angular velocity of i
    /// against j.
    AngularAcceleration(usize),
    /// WDTM: its magnitude.
    AngularAccelerationMagnitude,
}

/// How many time derivatives a quantity needs.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Order {
    /// Positions only.
    Displacement,
    /// Positions and velocities.
    Velocity,
    /// Accelerations too.
    Acceleration,
}

impl Quantity {
    /// How many time derivatives it needs.
    #[must_use]
    pub fn order(self) -> Order {
        match self {
            Self::Displacement(_)
            | Self::Distance
            | Self::Rotation(_)
            | Self::Euler(_)
            | Self::YawPitchRoll(_)
            | Self::Body123(_)
            | Self::IncludedAngle
            | Self::EulerParameter(_) => Order::Displacement,
            Self::Velocity(_)
            | Self::Speed
            | Self::SeparationRate
            | Self::AngularVelocity(_)
            | Self::AngularSpeed => Order::Velocity,
            Self::Acceleration(_)
            | Self::AccelerationMagnitude
            | Self::AngularAcceleration(_)
            | Self::AngularAccelerationMagnitude => Order::Acceleration,
        }
    }
}

/// A quantity and its markers, by their places in [`crate::model::Model::markers`].
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Measure {
    /// What is measured.
    pub quantity: Quantity,
    /// Marker i.
    pub i: usize,
    /// Marker j.
    pub j: usize,
    /// Marker k, whose axes resolve (for INCANG the third point).
    pub k: usize,
    /// Marker l, from which rates are seen.
    pub l: usize,
}

impl Measure {
    /// Its markers i, j, k and l.
    #[must_use]
    pub fn markers(&self) -> [usize; 4] {
        [self.i, self.j, self.k, self.l]
    }
}

/// A marker with derivatives.
#[derive(Clone, Copy)]
struct Frame<T> {
    origin: Triple<T>,
    axes: [Triple<T>; 3],
    velocity: Triple<T>,
    omega: Triple<T>,
}

fn triple(v: &Vector3<f64>) -> Triple<f64> {
    Triple([v.x, v.y, v.z])
}

impl Frame<f64> {
    fn new(m: &MarkerFrame) -> Self {
        Self {
            origin: triple(&m.origin),
            axes: [0, 1, 2].map(|k| triple(&m.axis(k))),
            velocity: triple(&m.velocity),
            omega: triple(&m.omega),
        }
    }
}

impl Frame<Dual> {
    /// With the slopes by the motions of its body, where it is `seeded`.
    fn new(m: &MarkerFrame, seeded: bool) -> Self {
        // Vector `v` plus its change: `by(k)` is the change by motion k.
        let vector = |v: &Vector3<f64>, by: &dyn Fn(usize) -> Vector3<f64>| {
            let mut out = [0, 1, 2].map(|axis| Dual::constant(v[axis]));
            if seeded {
                for k in 0..12 {
                    let change = by(k);
                    for axis in 0..3 {
                        out[axis].slopes[k] = change[axis];
                    }
                }
            }
            Triple(out)
        };
        let unit = |k: usize| {
            let mut e = Vector3::zeros();
            e[k % 3] = 1.0;
            e
        };
        let turned = |v: Vector3<f64>| {
            move |k: usize| {
                if k / 3 == 1 {
                    unit(k).cross(&v)
                } else {
                    Vector3::zeros()
                }
            }
        };
        let axes = [0, 1, 2].map(|axis| vector(&m.axis(axis), &turned(m.axis(axis))));
        Self {
            origin: vector(&m.origin, &|k| match k / 3 {
                0 => unit(k),
                1 => unit(k).cross(&m.arm),
                _ => Vector3::zeros(),
            }),
            axes,
            velocity: vector(&m.velocity, &|k| match k / 3 {
                1 => m.omega.cross(&unit(k).cross(&m.arm)),
                2 => unit(k),
                3 => unit(k).cross(&m.arm),
                _ => Vector3::zeros(),
            }),
            omega: vector(&m.omega, &|k| {
                if k / 3 == 3 {
                    unit(k)
                } else {
                    Vector3::zeros()
                }
            }),
        }
    }
}

impl Frame<Jet> {
    /// Along the motion with all accelerations zero.
    fn new(m: &MarkerFrame) -> Self {
        let vector = |v: &Vector3<f64>, rate: Vector3<f64>, acceleration: Vector3<f64>| {
            Triple([0, 1, 2].map(|k| Jet {
                value: v[k],
                rate: rate[k],
                acceleration: acceleration[k],
            }))
        };
        let turned = |v: &Vector3<f64>| (m.omega.cross(v), m.omega.cross(&m.omega.cross(v)));
        let zero = Vector3::zeros();
        let arm = turned(&m.arm);
        Self {
            origin: vector(&m.origin, m.velocity, arm.1),
            axes: [0, 1, 2].map(|k| {
                let axis = m.axis(k);
                let (rate, acceleration) = turned(&axis);
                vector(&axis, rate, acceleration)
            }),
            // Only quantities of displacement are asked for along a motion.
            velocity: vector(&m.velocity, zero, zero),
            omega: vector(&m.omega, zero, zero),
        }
    }
}

fn asin_safe<T: Scalar>(sine: T) -> T {
    let cosine = (T::constant(1.0) - sine * sine).sqrt();
    sine.atan2(cosine)
}

/// Quantities of displacement and velocity; angles are principal values.
fn evaluate<T: Scalar>(quantity: Quantity, [i, j, k, l]: &[Frame<T>; 4]) -> T {
    let d = i.origin.minus(&j.origin);
    // Cosines between axis a of i and axis b of j.
    let c = |a: usize, b: usize| i.axes[a].dot(&j.axes[b]);
    let seen = || {
        let drift = l.omega.cross(&d);
        i.velocity.minus(&j.velocity).minus(&drift)
    };
    let spin = || i.omega.minus(&j.omega);
    let parallel = || c(2, 0).value().hypot(c(2, 1).value()) < rotation::PARALLEL;
    match quantity {
        Quantity::Displacement(axis) => d.dot(&k.axes[axis]),
        Quantity::Distance => d.norm(),
        Quantity::Rotation(0) => (-c(2, 1)).atan2(c(2, 2)),
        Quantity::Rotation(1) => c(2, 0).atan2(c(2, 2)),
        Quantity::Rotation(_) => c(0, 1).atan2(c(0, 0)),
        // Where the z axes are parallel only ψ ± φ is determined; φ is then zero.
        Quantity::Euler(0) if parallel() => c(0, 1).atan2(c(0, 0)),
        Quantity::Euler(2) if parallel() => T::constant(0.0),
        Quantity::Euler(0) => c(2, 0).atan2(-c(2, 1)),
        Quantity::Euler(1) => (c(2, 0) * c(2, 0) + c(2, 1) * c(2, 1))
            .sqrt()
            .atan2(c(2, 2)),
        Quantity::Euler(_) => c(0, 2).atan2(c(1, 2)),
        Quantity::YawPitchRoll(0) => c(0, 1).atan2(c(0, 0)),
        Quantity::YawPitchRoll(1) => asin_safe(c(0, 2)),
        Quantity::YawPitchRoll(_) => c(1, 2).atan2(c(2, 2)),
        Quantity::Body123(0) => (-c(2, 1)).atan2(c(2, 2)),
        Quantity::Body123(1) => asin_safe(c(2, 0)),
        Quantity::Body123(_) => (-c(1, 0)).atan2(c(0, 0)),
        Quantity::IncludedAngle => {
            let e = k.origin.minus(&j.origin);
            d.cross(&e).norm().atan2(d.dot(&e))
        }
        Quantity::EulerParameter(n) => euler_parameter(n, &c),
        Quantity::Velocity(axis) => seen().dot(&k.axes[axis]),
        Quantity::Speed => seen().norm(),
        Quantity::SeparationRate => {
            let length = d.norm();
            // Markers that coincide have no line along which they could part.
            if length.value() == 0.0 {
                T::constant(0.0)
            } else {
                i.velocity.minus(&j.velocity).dot(&d) / length
            }
        }
        Quantity::AngularVelocity(axis) => spin().dot(&k.axes[axis]),
        Quantity::AngularSpeed => spin().norm(),
        Quantity::Acceleration(_)
        | Quantity::AccelerationMagnitude
        | Quantity::AngularAcceleration(_)
        | Quantity::AngularAccelerationMagnitude => T::constant(f64::NAN),
    }
}

/// Euler parameter `n` of the rotation with cosines `c(a, b)` between axis a of i and b of j; the
/// first parameter is not negative.
fn euler_parameter<T: Scalar>(n: usize, c: &impl Fn(usize, usize) -> T) -> T {
    // Four times the product of parameters p and q, from the matrix R with R[b][a] = c(a, b).
    let one = T::constant(1.0);
    let product = |p: usize, q: usize| {
        let (p, q) = (p.min(q), p.max(q));
        match (p, q) {
            (0, 0) => one + c(0, 0) + c(1, 1) + c(2, 2),
            (0, q) => {
                let (a, b) = (q % 3, (q + 1) % 3);
                c(a, b) - c(b, a)
            }
            (p, q) if p == q => {
                let (a, b) = (p % 3, (p + 1) % 3);
                one + c(p - 1, p - 1) - c(a, a) - c(b, b)
            }
            (p, q) => c(p - 1, q - 1) + c(q - 1, p - 1),
        }
    };
    // Divide by the largest parameter (Shepperd 1978).
    let largest = (0..4).fold(0, |b, p| {
        if product(p, p).value() > product(b, b).value() {
            p
        } else {
            b
        }
    });
    let half = T::constant(0.5);
    let parameter = half * product(n, largest) / product(largest, largest).sqrt();
    if largest != 0 && product(0, largest).value() < 0.0 {
        -parameter
    } else {
        parameter
    }
}

fn frames<T>(markers: [&MarkerFrame; 4], make: impl Fn(&MarkerFrame) -> Frame<T>) -> [Frame<T>; 4] {
    markers.map(make)
}

/// Value of a quantity of displacement or velocity at markers i, j, k, l.
#[must_use]
pub fn value(quantity: Quantity, markers: [&MarkerFrame; 4]) -> f64 {
    evaluate(quantity, &frames(markers, Frame::<f64>::new))
}

/// Slopes of a quantity of displacement or velocity by the twelve motions of `body`: position and
/// rotation, then velocity and angular velocity, along ground axes.
#[must_use]
pub fn slopes(quantity: Quantity, markers: [&MarkerFrame; 4], body: usize) -> [f64; 12] {
    evaluate(
        quantity,
        &frames(markers, |m| Frame::<Dual>::new(m, m.body == Some(body))),
    )
    .slopes
}

/// Value, rate, and second rate with all accelerations zero, of a quantity of displacement.
pub(crate) fn jet(quantity: Quantity, markers: [&MarkerFrame; 4]) -> Jet {
    evaluate(quantity, &frames(markers, Frame::<Jet>::new))
}

/// Acceleration of a marker's origin and its body's angular acceleration, ground axes.
#[derive(Clone, Copy, Debug)]
pub struct MarkerAcceleration {
    /// Of the origin.
    pub linear: Vector3<f64>,
    /// Of the frame.
    pub angular: Vector3<f64>,
}

/// Value of a quantity of acceleration.
#[must_use]
pub fn acceleration(
    quantity: Quantity,
    [i, j, k, l]: [&MarkerFrame; 4],
    accelerations: [MarkerAcceleration; 4],
) -> f64 {
    let [ai, aj, _, al] = accelerations;
    let d = i.origin - j.origin;
    let d_rate = i.velocity - j.velocity;
    let linear = ai.linear
        - aj.linear
        - al.angular.cross(&d)
        - 2.0 * l.omega.cross(&(d_rate - l.omega.cross(&d)))
        - l.omega.cross(&l.omega.cross(&d));
    let angular = ai.angular - aj.angular - l.omega.cross(&(i.omega - j.omega));
    match quantity {
        Quantity::Acceleration(axis) => linear.dot(&k.axis(axis)),
        Quantity::AccelerationMagnitude => linear.norm(),
        Quantity::AngularAcceleration(axis) => angular.dot(&k.axis(axis)),
        Quantity::AngularAccelerationMagnitude => angular.norm(),
        _ => value(quantity, [i, j, k, l]),
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::rotation::{Quaternion, from_euler_313};

    const ALL: [Quantity; 21] = [
        Quantity::Displacement(0),
        Quantity::Displacement(2),
        Quantity::Distance,
        Quantity::Rotation(0),
        Quantity::Rotation(1),
        Quantity::Rotation(2),
        Quantity::Euler(0),
        Quantity::Euler(1),
        Quantity::Euler(2),
        Quantity::YawPitchRoll(1),
        Quantity::YawPitchRoll(2),
        Quantity::Body123(1),
        Quantity::Body123(2),
        Quantity::IncludedAngle,
        Quantity::EulerParameter(0),
        Quantity::EulerParameter(3),
        Quantity::Velocity(1),
        Quantity::Speed,
        Quantity::SeparationRate,
        Quantity::AngularVelocity(2),
        Quantity::AngularSpeed,
    ];

    /// Marker `seed` on body `seed`, displaced by twelve motions of that body.
    fn marker(seed: usize, change: &[f64; 12]) -> MarkerFrame {
        let s = seed as f64 * 1.3 + 0.2;
        let r = |k: f64| Vector3::new((s + k).sin(), (s * k).cos(), (k - s).sin());
        let part = |k: usize| Vector3::from_column_slice(&change[3 * k..3 * k + 3]);
        let turn = Quaternion::exp(&part(1)).matrix();
        let arm = turn * r(2.0);
        let omega = 0.8 * r(4.0) + part(3);
        MarkerFrame {
            body: Some(seed),
            origin: r(1.0) + part(0) + arm,
            arm,
            axes: turn * Quaternion::exp(&r(3.0)).matrix(),
            velocity: r(5.0) + part(2) + omega.cross(&arm),
            omega,
        }
    }

    #[test]
    fn slopes_match_differences() {
        for quantity in ALL {
            for body in 0..4 {
                let at = |k: usize, h: f64| {
                    let made: Vec<MarkerFrame> = (0..4)
                        .map(|seed| {
                            let mut change = [0.0; 12];
                            if seed == body {
                                change[k] = h;
                            }
                            marker(seed, &change)
                        })
                        .collect();
                    value(quantity, [&made[0], &made[1], &made[2], &made[3]])
                };
                let made: Vec<MarkerFrame> = (0..4).map(|s| marker(s, &[0.0; 12])).collect();
                let markers = [&made[0], &made[1], &made[2], &made[3]];
                let slopes = slopes(quantity, markers, body);
                for k in 0..12 {
                    let slope = (at(k, 1e-5) - at(k, -1e-5)) / 2e-5;
                    // Truncation 1e-10 times third derivatives, rounding 1e-11.
                    assert!(
                        (slopes[k] - slope).abs() < 1e-8,
                        "{quantity:?} body {body} {k}"
                    );
                }
            }
        }
    }

    #[test]
    fn jets_are_the_rates_along_the_motion() {
        // Constant angular velocity and constant velocity of the centre: accelerations are zero.
        let at = |t: f64| {
            let made: Vec<MarkerFrame> = (0..4)
                .map(|seed| {
                    let start = marker(seed, &[0.0; 12]);
                    let turn = Quaternion::exp(&(start.omega * t)).matrix();
                    let centre = start.origin - start.arm;
                    let drift = start.velocity - start.omega.cross(&start.arm);
                    let arm = turn * start.arm;
                    MarkerFrame {
                        origin: centre + t * drift + arm,
                        arm,
                        axes: turn * start.axes,
                        velocity: drift + start.omega.cross(&arm),
                        ..start
                    }
                })
                .collect();
            made
        };
        for quantity in ALL.into_iter().filter(|q| q.order() == Order::Displacement) {
            let jet_at = |t: f64| {
                let made = at(t);
                jet(quantity, [&made[0], &made[1], &made[2], &made[3]])
            };
            let h = 1e-5;
            let (now, ahead, behind) = (jet_at(0.0), jet_at(h), jet_at(-h));
            assert!((now.rate - (ahead.value - behind.value) / (2.0 * h)).abs() < 1e-8);
            assert!(
                (now.acceleration - (ahead.rate - behind.rate) / (2.0 * h)).abs() < 1e-7,
                "{quantity:?}"
            );
        }
    }

    #[test]
    fn angles_follow_their_definitions() {
        let ground = MarkerFrame {
            body: None,
            origin: Vector3::zeros(),
            arm: Vector3::zeros(),
            axes: nalgebra::Matrix3::identity(),
            velocity: Vector3::zeros(),
            omega: Vector3::zeros(),
        };
        let angles = [0.4, 0.9, -1.1];
        let turned = MarkerFrame {
            axes: from_euler_313(&angles),
            ..ground
        };
        let markers = [&turned, &ground, &ground, &ground];
        for (n, angle) in angles.iter().enumerate() {
            assert!((value(Quantity::Euler(n), markers) - angle).abs() < 1e-14);
        }
        for tilt in [0.0, std::f64::consts::PI] {
            let flat = MarkerFrame {
                axes: from_euler_313(&[0.4, tilt, 0.0]),
                ..ground
            };
            let markers = [&flat, &ground, &ground, &ground];
            for (n, angle) in [0.4, tilt, 0.0].iter().enumerate() {
                assert!((value(Quantity::Euler(n), markers) - angle).abs() < 1e-14);
            }
        }
        let q = Quaternion::from_matrix(&turned.axes);
        for (n, e) in [q.w, q.v.x, q.v.y, q.v.z].iter().enumerate() {
            assert!((value(Quantity::EulerParameter(n), markers) - e).abs() < 1e-14);
        }
        for axis in 0..3 {
            let mut theta = Vector3::zeros();
            theta[axis] = 0.7;
            let turned = MarkerFrame {
                axes: Quaternion::exp(&theta).matrix(),
                ..ground
            };
            let markers = [&turned, &ground, &ground, &ground];
            assert!((value(Quantity::Rotation(axis), markers) - 0.7).abs() < 1e-14);
            assert!((value(Quantity::Body123(axis), markers) - 0.7).abs() < 1e-14);
        }
    }
}
