//! Axes of parts and markers from their statements.

use dataset::Orientation;
use mechanics::rotation::from_euler_313;
use nalgebra::{Matrix3, Vector3};

/// Rotation matrix of a frame at `origin`: its columns are the frame's axes along the axes of the
/// reference frame, in which `origin` and the points of the orientation are given too.
///
/// Points: z is exact and x lies in the half plane of the second point, or with USEXP the other
/// way round. A missing point is replaced by the reference axis of the same name, or where that is
/// parallel to the exact axis by the next one.
pub(crate) fn axes(orientation: &Orientation, origin: &[f64; 3]) -> Matrix3<f64> {
    let (z, x, use_x) = match orientation {
        Orientation::Identity => return Matrix3::identity(),
        Orientation::Euler(angles) => return from_euler_313(angles),
        Orientation::Points { z, x, use_x } => (z, x, *use_x),
    };
    let towards =
        |point: &Option<[f64; 3]>| point.map(|point| Vector3::from(point) - Vector3::from(*origin));
    let (z, x) = (towards(z), towards(x));
    if use_x {
        let x = x.unwrap_or_else(Vector3::x).normalize();
        let z = perpendicular(z, Vector3::z(), &x);
        Matrix3::from_columns(&[x, z.cross(&x), z])
    } else {
        let z = z.unwrap_or_else(Vector3::z).normalize();
        let x = perpendicular(x, Vector3::x(), &z);
        Matrix3::from_columns(&[x, z.cross(&x), z])
    }
}

/// The direction perpendicular to the unit vector `exact` that is nearest to `wanted`, else to
/// `reference`, else to the axes after it.
fn perpendicular(
    wanted: Option<Vector3<f64>>,
    reference: Vector3<f64>,
    exact: &Vector3<f64>,
) -> Vector3<f64> {
    /// Sine of the angle below which two directions count as parallel.
    const PARALLEL: f64 = 1e-8;
    let next = Vector3::new(reference.z, reference.x, reference.y);
    let candidates = [wanted.unwrap_or(reference), reference, next];
    let projected = candidates.map(|c| c.normalize() - c.normalize().dot(exact) * exact);
    let found = projected.iter().find(|p| p.norm() > PARALLEL);
    // Two different axes cannot both be parallel to `exact`.
    found.map_or(next, |p| p.normalize())
}

#[cfg(test)]
mod tests {
    use super::*;

    /// Rounding of a few normalisations.
    const ROUNDING: f64 = 1e-14;

    #[test]
    fn z_is_exact_without_usexp_and_x_with_it() {
        let (z, x) = (Some([1.0, 2.0, 8.0]), Some([4.0, 2.0, 4.0]));
        let origin = [1.0, 2.0, 3.0];
        let m = axes(&Orientation::Points { z, x, use_x: false }, &origin);
        assert!((m - Matrix3::identity()).norm() < ROUNDING);
        let m = axes(&Orientation::Points { z, x, use_x: true }, &origin);
        let exact = Vector3::new(3.0, 0.0, 1.0).normalize();
        assert!((m.column(0) - exact).norm() < ROUNDING);
        assert!(m.column(1).y > 0.999);
        assert!((m.determinant() - 1.0).abs() < ROUNDING);
    }

    #[test]
    fn a_missing_point_takes_the_reference_axis_or_the_next() {
        let points = Orientation::Points {
            z: Some([0.0, 0.0, -2.0]),
            x: None,
            use_x: false,
        };
        let m = axes(&points, &[0.0; 3]);
        assert!((m.column(0) - Vector3::x()).norm() < ROUNDING);
        assert!((m.column(1) + Vector3::y()).norm() < ROUNDING);
        let points = Orientation::Points {
            z: Some([3.0, 0.0, 0.0]),
            x: None,
            use_x: false,
        };
        let m = axes(&points, &[0.0; 3]);
        assert!((m.column(0) - Vector3::y()).norm() < ROUNDING);
        assert!((m.determinant() - 1.0).abs() < ROUNDING);
    }

    #[test]
    fn euler_angles_are_body_fixed_3_1_3() {
        let m = axes(
            &Orientation::Euler([std::f64::consts::FRAC_PI_2; 3]),
            &[0.0; 3],
        );
        // Rz(90°) Rx(90°) Rz(90°) sends x to z, y to -y... read off column by column.
        let expected = Matrix3::new(0.0, 0.0, 1.0, 0.0, -1.0, 0.0, 1.0, 0.0, 0.0);
        assert!((m - expected).norm() < ROUNDING);
    }
}
