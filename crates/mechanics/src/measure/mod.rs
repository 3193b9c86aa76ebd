//! Kinematic quantities between markers, as functions read them.
//!
//! Every quantity of displacement or velocity is written once over a number type, so that its
//! exact derivatives by the motions of each body, and its rates in time, come from the same lines.
//! `d = o_i − o_j`; components are along the axes of marker k; velocities and accelerations are
//! those seen from marker l. Ground stands for markers that a function leaves out.

mod acceleration;
mod angles;
mod frame;

use crate::scalar::{Dual, Jet, Scalar};
use crate::state::MarkerFrame;
pub use acceleration::{MarkerAcceleration, acceleration, acceleration_slopes};
pub use angles::Sequence;
use angles::{body_fixed, euler_parameter};
use frame::{Frame, Moving, Seeded};
use serde::{Deserialize, Serialize};

/// The quantities, named after the functions of the dataset language.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Quantity {
    /// DX, DY, DZ: component of `d` along axis 0, 1 or 2 of k.
    Displacement(usize),
    /// DM: `|d|`.
    Distance,
    /// AX, AY, AZ: rotation of i about axis 0, 1 or 2 of j, continuous over many turns.
    Rotation(usize),
    /// PSI, THETA, PHI (3-1-3), B1, B2, B3 of a motion (1-2-3), ORIENT: angle 0, 1 or 2 of a
    /// sequence of body-fixed turns of i in j.
    BodyFixed(Sequence, usize),
    /// YAW, PITCH, ROLL: body-fixed 3-2-1 angle 0, 1 or 2 of i in j; pitch with the opposite sign.
    YawPitchRoll(usize),
    /// INCANG: angle at j between the lines to i and to k.
    IncludedAngle,
    /// ORIENT type 27: Euler parameter 0 to 3 of i in j.
    EulerParameter(usize),
    /// Cosine between axis a of i and axis b of j, for UVX, UVY, UVZ and TRANS.
    DirectionCosine(usize, usize),
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
            | Self::BodyFixed(..)
            | Self::YawPitchRoll(_)
            | Self::IncludedAngle
            | Self::EulerParameter(_)
            | Self::DirectionCosine(..) => Order::Displacement,
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
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
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

/// Quantities of displacement and velocity; angles are principal values.
fn evaluate<T: Scalar, F: Frame<T>>(quantity: Quantity, [i, j, k, l]: [F; 4]) -> T {
    let d = || i.origin().minus(&j.origin());
    // Cosines between axis a of i and axis b of j.
    let c = |a: usize, b: usize| i.axis(a).dot(&j.axis(b));
    let seen = || {
        let drift = l.omega().cross(&d());
        i.velocity().minus(&j.velocity()).minus(&drift)
    };
    let spin = || i.omega().minus(&j.omega());
    match quantity {
        Quantity::Displacement(axis) => d().dot(&k.axis(axis)),
        Quantity::Distance => d().norm(),
        Quantity::Rotation(0) => (-c(2, 1)).atan2(c(2, 2)),
        Quantity::Rotation(1) => c(2, 0).atan2(c(2, 2)),
        Quantity::Rotation(_) => c(0, 1).atan2(c(0, 0)),
        Quantity::BodyFixed(sequence, n) => body_fixed(sequence, n, &c),
        Quantity::YawPitchRoll(1) => -body_fixed([2, 1, 0], 1, &c),
        Quantity::YawPitchRoll(n) => body_fixed([2, 1, 0], n, &c),
        Quantity::IncludedAngle => {
            let (d, e) = (d(), k.origin().minus(&j.origin()));
            d.cross(&e).norm().atan2(d.dot(&e))
        }
        Quantity::EulerParameter(n) => euler_parameter(n, &c),
        Quantity::DirectionCosine(a, b) => c(a, b),
        Quantity::Velocity(axis) => seen().dot(&k.axis(axis)),
        Quantity::Speed => seen().norm(),
        Quantity::SeparationRate => {
            let d = d();
            let length = d.norm();
            // Markers that coincide have no line along which they could part.
            if length.value() == 0.0 {
                T::constant(0.0)
            } else {
                i.velocity().minus(&j.velocity()).dot(&d) / length
            }
        }
        Quantity::AngularVelocity(axis) => spin().dot(&k.axis(axis)),
        Quantity::AngularSpeed => spin().norm(),
        Quantity::Acceleration(_)
        | Quantity::AccelerationMagnitude
        | Quantity::AngularAcceleration(_)
        | Quantity::AngularAccelerationMagnitude => T::constant(f64::NAN),
    }
}

/// Value of a quantity of displacement or velocity at markers i, j, k, l.
#[must_use]
pub fn value(quantity: Quantity, markers: [&MarkerFrame; 4]) -> f64 {
    evaluate(quantity, markers)
}

/// Slopes of a quantity of displacement or velocity by the twelve motions of `body`: position and
/// rotation, then velocity and angular velocity, along ground axes.
#[must_use]
pub fn slopes(quantity: Quantity, markers: [&MarkerFrame; 4], body: usize) -> [f64; 12] {
    let seeded = markers.map(|marker| Seeded::by(marker, body));
    evaluate::<Dual<12>, _>(quantity, seeded).slopes
}

/// Value, rate, and second rate with all accelerations zero, of a quantity of displacement.
pub(crate) fn jet(quantity: Quantity, markers: [&MarkerFrame; 4]) -> Jet {
    evaluate(quantity, markers.map(Moving))
}

#[cfg(test)]
mod tests {
    use nalgebra::Vector3;

    use super::*;
    use crate::rotation::Quaternion;

    const ALL: [Quantity; 23] = [
        Quantity::Displacement(0),
        Quantity::Displacement(2),
        Quantity::Distance,
        Quantity::Rotation(0),
        Quantity::Rotation(1),
        Quantity::Rotation(2),
        Quantity::BodyFixed([2, 0, 2], 0),
        Quantity::BodyFixed([2, 0, 2], 1),
        Quantity::BodyFixed([2, 0, 2], 2),
        Quantity::YawPitchRoll(1),
        Quantity::YawPitchRoll(2),
        Quantity::BodyFixed([0, 1, 2], 1),
        Quantity::BodyFixed([1, 0, 2], 2),
        Quantity::IncludedAngle,
        Quantity::EulerParameter(0),
        Quantity::EulerParameter(3),
        Quantity::DirectionCosine(0, 2),
        Quantity::DirectionCosine(1, 1),
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
        let turned_by = |angles: [f64; 3], sequence: Sequence| {
            let turn = |k: usize| {
                let mut theta = Vector3::zeros();
                theta[sequence[k]] = angles[k];
                Quaternion::exp(&theta).matrix()
            };
            MarkerFrame {
                axes: turn(0) * turn(1) * turn(2),
                ..ground
            }
        };
        for (a, b) in [(0, 1), (1, 2), (2, 0), (0, 2), (1, 0), (2, 1)] {
            for last in [a, 3 - a - b] {
                let (angles, sequence) = ([0.4, 0.9, -1.1], [a, b, last]);
                let turned = turned_by(angles, sequence);
                let markers = [&turned, &ground, &ground, &ground];
                for (n, angle) in angles.iter().enumerate() {
                    let found = value(Quantity::BodyFixed(sequence, n), markers);
                    assert!((found - angle).abs() < 1e-14, "{sequence:?} {n}: {found}");
                }
                // Where the middle angle leaves only the sum of the others, the last is zero.
                if last == a {
                    for middle in [0.0, std::f64::consts::PI] {
                        let flat = turned_by([0.4, middle, 0.0], sequence);
                        let markers = [&flat, &ground, &ground, &ground];
                        for (n, angle) in [0.4, middle, 0.0].iter().enumerate() {
                            let found = value(Quantity::BodyFixed(sequence, n), markers);
                            assert!((found - angle).abs() < 1e-14, "{sequence:?} {n}");
                        }
                    }
                }
            }
        }
        let turned = turned_by([0.4, 0.9, -1.1], [2, 0, 2]);
        let markers = [&turned, &ground, &ground, &ground];
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
        }
    }
}
