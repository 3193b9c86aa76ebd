//! A spatial four-bar with two pins and two balls (RSSR), all with friction.

use friction::{Inputs, Original, SphericalLoad};
use mechanics::model::{FrictionJoint, JointKind, Level, Model, MotionFreedom};
use nalgebra::{Matrix3, Vector3};

use crate::builder::{Builder, v};
use crate::{law, turning::bearing_load};

/// Lengths of crank, coupler and rocker, mm.
const LENGTHS: [f64; 3] = [201.6318, 350.0, 201.6318];

/// The mechanism with its crank at zero, driven at `rate` about the axis of joint 0; a torque of one
/// turns the rocker back about the axis of joint 3. Joint 1 is the ball between crank and coupler,
/// joint 2 that between rocker and coupler.
#[derive(Clone, Debug)]
pub struct Rssr {
    /// The mechanism.
    pub model: Model,
    /// Axis of the crank.
    pub axis: Vector3<f64>,
}

/// Millimetres; inertia is negligible. `pins` scales the coefficients of friction of the pins; zero
/// leaves friction out.
#[must_use]
pub fn rssr(pins: f64, rate: f64) -> Rssr {
    let [a, coupler, c] = LENGTHS;
    let axis = v(0.009_243, -0.951_003, 0.309_043).normalize();
    let base = 403.1627 * v(0.524_328, 0.835_662, -0.163_552);
    let crank = a * v(-0.379_646, 0.400_777, 0.833_815);
    // The rocker's ball on its circle, at the distance of the coupler from the crank's ball; of the
    // two places the one of the reference, which is where the branch of the smaller root is.
    let (sine, cosine) = 7.294_f64.to_radians().sin_cos();
    let p = crank - base;
    let square = p.norm_squared() - coupler * coupler + c * c + 2.0 * c * p.x * sine;
    let k2 = square + 2.0 * c * p.y * cosine;
    let k1 = -4.0 * c * cosine * p.z;
    let k0 = square - 2.0 * c * p.y * cosine;
    let angle = 2.0 * ((-k1 - (k1 * k1 - 4.0 * k0 * k2).sqrt()) / (2.0 * k2)).atan();
    let rocker = base + c * v(-sine, cosine * angle.cos(), cosine * angle.sin());

    let mut b = Builder::new(Vector3::zeros());
    let inertia = |body: usize, b: &mut Builder| {
        b.model.bodies[body].inertia = 1e-6 * Matrix3::identity();
        Some(body)
    };
    let bodies = [(Vector3::zeros(), crank), (crank, rocker), (base, rocker)];
    let [one, two, three] = bodies.map(|(from, to)| {
        let body = b.rod(1e-9, from, to);
        inertia(body, &mut b)
    });
    let first = b.joint(JointKind::Revolute, one, None, Vector3::zeros(), axis);
    b.joint(JointKind::Spherical, one, two, crank, Vector3::z());
    b.joint(JointKind::Spherical, three, two, rocker, Vector3::z());
    b.joint(JointKind::Revolute, three, None, base, Vector3::x());
    b.drive(first, MotionFreedom::AboutZ, Level::Position, rate);
    b.start_turning(first, rate);
    b.torque(2, Vector3::x(), -1.0);
    let sliding = |mu: f64| -> Original { law(mu, mu, 1e-5, 1e-6) };
    let ball = FrictionJoint::Spherical(SphericalLoad {
        inputs: Inputs::ALL,
        ball_radius: 20.0,
    });
    if pins > 0.0 {
        b.friction(0, sliding(0.7 * pins), bearing_load(5.0, 5.0, 30.0));
        b.friction(1, sliding(0.2), ball);
        b.friction(2, sliding(0.8), ball);
        b.friction(3, sliding(0.6 * pins), bearing_load(5.0, 5.0, 30.0));
    }
    Rssr {
        model: b.model,
        axis,
    }
}
