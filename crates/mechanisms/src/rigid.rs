//! One body: free, on a pin, on a point.

use mechanics::model::{JointKind, Model};
use nalgebra::{Matrix3, Vector3};

use crate::builder::{Builder, v};

/// A mass of 1 kg on a massless arm of 1 m, pinned at the origin, horizontal to the left, at rest.
#[must_use]
pub fn pendulum() -> Model {
    let mut b = Builder::new(v(0.0, -9.81, 0.0));
    let mass = b.body(1.0, [0.0; 3], v(-1.0, 0.0, 0.0));
    b.pin(Some(mass), None, Vector3::zeros());
    b.model
}

/// A body of 1 kg with nothing acting on it, turning with `omega`.
#[must_use]
pub fn free_body(inertia: [f64; 3], omega: Vector3<f64>) -> Model {
    let mut b = Builder::new(Vector3::zeros());
    let body = b.body(1.0, inertia, Vector3::zeros());
    b.spin(body, omega, Vector3::zeros());
    b.model
}

/// A heavy top on a point at the origin: mass 1 kg, centre 0.1 m along its axis, inertia about the
/// point 0.02 across and 0.005 kg m² along the axis. It starts 30° from the vertical towards x,
/// spinning at 100 rad/s about its axis.
#[must_use]
pub fn top() -> Model {
    let tilt = std::f64::consts::FRAC_PI_6;
    let axis = v(tilt.sin(), 0.0, tilt.cos());
    let mut b = Builder::new(v(0.0, 0.0, -9.81));
    let across = 0.02 - 0.1 * 0.1;
    let inertia = across * Matrix3::identity() + (0.005 - across) * axis * axis.transpose();
    let body = b.turned_body(
        1.0,
        inertia,
        0.1 * axis,
        mechanics::rotation::Quaternion::IDENTITY,
    );
    b.joint(
        JointKind::Spherical,
        Some(body),
        None,
        Vector3::zeros(),
        Vector3::z(),
    );
    b.spin(body, 100.0 * axis, Vector3::zeros());
    b.model
}
