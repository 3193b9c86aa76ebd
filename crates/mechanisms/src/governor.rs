//! A flyball governor: stiff, because its balls carry the sleeve by springs instead of links.

use mechanics::model::{JointKind, Model};
use nalgebra::{Matrix3, Vector3};

use crate::builder::{Builder, v};

/// A shaft that turns freely about the vertical y axis at 10 rad/s at first, with 0.2 kg m². From its
/// head at 1 m height two arms of 1 m and 1 kg hang at 30° to it, each with a ball of 5 kg at its end.
/// The middle of every arm carries the sleeve of 1 kg on the shaft by a spring of 0.5 m, 8e5 N/m and
/// 4e4 N s/m. Bodies: shaft, sleeve, then arms with their balls; joint 1 is the guide of the sleeve.
#[must_use]
pub fn governor() -> Model {
    let mut b = Builder::new(v(0.0, -9.81, 0.0));
    let (rate, head) = (10.0 * Vector3::y(), Vector3::y());
    let (sine, cosine) = std::f64::consts::FRAC_PI_6.sin_cos();
    let place = v(0.0, 1.0 - cosine, 0.0);
    let shaft = b.body(1.0, [0.1, 0.2, 0.1], 0.5 * head);
    let sleeve = b.body(1.0, [0.01; 3], place);
    let y = Vector3::y();
    b.joint(JointKind::Revolute, Some(shaft), None, Vector3::zeros(), y);
    b.joint(
        JointKind::Translational,
        Some(sleeve),
        Some(shaft),
        place,
        y,
    );
    for body in [shaft, sleeve] {
        b.spin(body, rate, Vector3::zeros());
    }
    for side in [1.0, -1.0] {
        let end = head + v(side * sine, -cosine, 0.0);
        let arm = b.rod(1.0, head, end);
        let ball = b.body(5.0, [0.02; 3], end);
        b.joint(
            JointKind::Revolute,
            Some(arm),
            Some(shaft),
            head,
            Vector3::z(),
        );
        b.joint(JointKind::Fixed, Some(ball), Some(arm), end, y);
        let i = b.marker(Some(sleeve), place, Matrix3::identity());
        let j = b.marker(Some(arm), 0.5 * (head + end), Matrix3::identity());
        b.spring_damper(i, j, 8e5, 4e4, 0.5);
        for body in [arm, ball] {
            b.spin(body, rate, Vector3::zeros());
        }
    }
    b.model
}
