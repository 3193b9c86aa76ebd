//! Rotations: unit quaternions, rotation vectors, Euler angles.
//!
//! A rotation matrix or quaternion of a frame F takes components along the axes of F to components
//! along ground axes: `v_ground = R v_F`. Its columns are the axes of F. A small rotation `δθ` is a
//! vector along ground axes and acts from the left, `R ← exp(δθ) R`.

use nalgebra::{Matrix3, Vector3};

/// Unit quaternion `(w, x, y, z)` of a frame, from its axes to ground axes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Quaternion {
    /// Scalar part.
    pub w: f64,
    /// Vector part.
    pub v: Vector3<f64>,
}

impl Quaternion {
    /// No rotation.
    pub const IDENTITY: Self = Self {
        w: 1.0,
        v: Vector3::new(0.0, 0.0, 0.0),
    };

    /// From the four components `w, x, y, z`, as they stand.
    #[must_use]
    pub fn from_slice(q: &[f64]) -> Self {
        Self {
            w: q[0],
            v: Vector3::new(q[1], q[2], q[3]),
        }
    }

    /// Writes the four components `w, x, y, z`.
    pub fn write(&self, q: &mut [f64]) {
        q[0] = self.w;
        q[1..4].copy_from_slice(self.v.as_slice());
    }

    /// A vector as a quaternion.
    #[must_use]
    pub fn from_vector(v: Vector3<f64>) -> Self {
        Self { w: 0.0, v }
    }

    /// The sum of the components.
    #[must_use]
    pub fn plus(&self, other: &Self) -> Self {
        Self {
            w: self.w + other.w,
            v: self.v + other.v,
        }
    }

    /// The product: first `other`, then `self`.
    #[must_use]
    pub fn times(&self, other: &Self) -> Self {
        Self {
            w: self.w * other.w - self.v.dot(&other.v),
            v: self.w * other.v + other.w * self.v + self.v.cross(&other.v),
        }
    }

    /// Angle of the rotation from this orientation to another, radians in `[0, π]`.
    ///
    /// ```
    /// use mechanics::rotation::Quaternion;
    /// let quarter = Quaternion::exp(&nalgebra::Vector3::new(0.0, std::f64::consts::FRAC_PI_2, 0.0));
    /// let angle = Quaternion::IDENTITY.angle_to(&quarter);
    /// assert!((angle - std::f64::consts::FRAC_PI_2).abs() < 1e-15);
    /// ```
    #[must_use]
    pub fn angle_to(&self, other: &Self) -> f64 {
        let back = Self {
            w: self.w,
            v: -self.v,
        };
        let turn = other.times(&back);
        2.0 * turn.v.norm().atan2(turn.w.abs())
    }

    /// Sum of the squares of the components.
    #[must_use]
    pub fn norm_squared(&self) -> f64 {
        self.w * self.w + self.v.norm_squared()
    }

    /// The same direction with norm one.
    #[must_use]
    pub fn normalized(&self) -> Self {
        let scale = 1.0 / self.norm_squared().sqrt();
        Self {
            w: self.w * scale,
            v: self.v * scale,
        }
    }

    /// Rotation by the rotation vector `theta` (axis times angle in radians).
    #[must_use]
    pub fn exp(theta: &Vector3<f64>) -> Self {
        let half = 0.5 * theta.norm();
        // sin(x)/x by its series where the quotient would lose digits.
        let sinc = if half < 1e-4 {
            1.0 - half * half / 6.0
        } else {
            half.sin() / half
        };
        Self {
            w: half.cos(),
            v: 0.5 * sinc * theta,
        }
    }

    /// The rotation matrix.
    #[must_use]
    pub fn matrix(&self) -> Matrix3<f64> {
        let (w, x, y, z) = (self.w, self.v.x, self.v.y, self.v.z);
        Matrix3::new(
            1.0 - 2.0 * (y * y + z * z),
            2.0 * (x * y - w * z),
            2.0 * (x * z + w * y),
            2.0 * (x * y + w * z),
            1.0 - 2.0 * (x * x + z * z),
            2.0 * (y * z - w * x),
            2.0 * (x * z - w * y),
            2.0 * (y * z + w * x),
            1.0 - 2.0 * (x * x + y * y),
        )
    }

    /// From a rotation matrix (Shepperd 1978: the largest component is found first).
    #[must_use]
    pub fn from_matrix(m: &Matrix3<f64>) -> Self {
        let trace = m.trace();
        let candidates = [trace, m[(0, 0)], m[(1, 1)], m[(2, 2)]];
        let largest = (0..4).fold(0, |b, i| if candidates[i] > candidates[b] { i } else { b });
        let off = |i: usize, j: usize| (m[(i, j)] + m[(j, i)], m[(j, i)] - m[(i, j)]);
        let (sxy, dxy) = off(0, 1);
        let (sxz, dxz) = off(0, 2);
        let (syz, dyz) = off(1, 2);
        let q = match largest {
            0 => [1.0 + trace, dyz, -dxz, dxy],
            1 => [dyz, 1.0 + 2.0 * m[(0, 0)] - trace, sxy, sxz],
            2 => [-dxz, sxy, 1.0 + 2.0 * m[(1, 1)] - trace, syz],
            _ => [dxy, sxz, syz, 1.0 + 2.0 * m[(2, 2)] - trace],
        };
        Self::from_slice(&q).normalized()
    }
}

/// The matrix of the cross product: `skew(a) b = a × b`.
#[must_use]
pub fn skew(a: &Vector3<f64>) -> Matrix3<f64> {
    Matrix3::new(0.0, -a.z, a.y, a.z, 0.0, -a.x, -a.y, a.x, 0.0)
}

/// Rotation vector of a rotation matrix, angle in `[0, π]`.
#[must_use]
pub fn log(m: &Matrix3<f64>) -> Vector3<f64> {
    let q = Quaternion::from_matrix(m);
    let sine = q.v.norm();
    let sign = if q.w < 0.0 { -1.0 } else { 1.0 };
    if sine < 1e-8 {
        return 2.0 * sign * q.v;
    }
    (2.0 * sine.atan2(sign * q.w) / sine * sign) * q.v
}

/// Inverse of the right Jacobian of the exponential map: `log(exp(θ) exp(ε)) ≈ θ + J ε`.
///
/// `J = 1 + ½ θ× + c θ×θ×` with `c = 1/θ² − (1 + cos θ)/(2 θ sin θ)` (Chirikjian, *Stochastic
/// Models, Information Theory and Lie Groups* 2, section 10.6).
#[must_use]
pub fn log_jacobian(theta: &Vector3<f64>) -> Matrix3<f64> {
    let angle = theta.norm();
    let c = if angle < 1e-3 {
        1.0 / 12.0 + angle * angle / 720.0
    } else {
        1.0 / (angle * angle) - (1.0 + angle.cos()) / (2.0 * angle * angle.sin())
    };
    let s = skew(theta);
    Matrix3::identity() + 0.5 * s + c * s * s
}

/// Rotation matrix of body-fixed 3-1-3 Euler angles ψ, θ, φ: `Rz(ψ) Rx(θ) Rz(φ)`.
#[must_use]
pub fn from_euler_313(angles: &[f64; 3]) -> Matrix3<f64> {
    let rz = |a: f64| Matrix3::new(a.cos(), -a.sin(), 0.0, a.sin(), a.cos(), 0.0, 0.0, 0.0, 1.0);
    let b = angles[1];
    let rx = Matrix3::new(1.0, 0.0, 0.0, 0.0, b.cos(), -b.sin(), 0.0, b.sin(), b.cos());
    rz(angles[0]) * rx * rz(angles[2])
}

/// Sine of θ below which the z axes of 3-1-3 angles count as parallel.
pub(crate) const PARALLEL: f64 = 1e-12;

/// Body-fixed 3-1-3 Euler angles ψ, θ, φ of a rotation matrix; θ in `[0, π]`.
///
/// Where θ is 0 or π only ψ ± φ is determined; φ is then zero.
#[must_use]
pub fn to_euler_313(m: &Matrix3<f64>) -> [f64; 3] {
    let sine = m[(2, 0)].hypot(m[(2, 1)]);
    let theta = sine.atan2(m[(2, 2)]);
    if sine < PARALLEL {
        return [m[(1, 0)].atan2(m[(0, 0)]), theta, 0.0];
    }
    [
        m[(0, 2)].atan2(-m[(1, 2)]),
        theta,
        m[(2, 0)].atan2(m[(2, 1)]),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn matrix_and_quaternion_agree_in_every_octant() {
        for k in 0..200 {
            let f = f64::from(k);
            let theta =
                Vector3::new((1.1 * f).sin(), (2.3 * f).cos(), (0.7 * f + 1.0).sin()) * (f % 3.1);
            let q = Quaternion::exp(&theta);
            let back = Quaternion::from_matrix(&q.matrix());
            let sign = if back.w * q.w + back.v.dot(&q.v) < 0.0 {
                -1.0
            } else {
                1.0
            };
            assert!((back.v * sign - q.v).norm() < 1e-14);
            assert!((back.w * sign - q.w).abs() < 1e-14);
        }
    }

    #[test]
    fn log_inverts_exp_and_its_jacobian_is_the_slope() {
        for k in 1..40 {
            let f = f64::from(k);
            let theta = Vector3::new((f).sin(), (2.0 * f).cos(), (3.0 * f).sin()) * (f / 25.0);
            let m = Quaternion::exp(&theta).matrix();
            assert!((log(&m) - theta).norm() < 1e-13);
            let jacobian = log_jacobian(&theta);
            for axis in 0..3 {
                let mut step = Vector3::zeros();
                step[axis] = 1e-6;
                let ahead = log(&(m * Quaternion::exp(&step).matrix()));
                let behind = log(&(m * Quaternion::exp(&-step).matrix()));
                let slope = (ahead - behind) / 2e-6;
                // Central differences at 1e-6: truncation 1e-12, rounding 1e-10.
                assert!((slope - jacobian.column(axis)).norm() < 1e-8);
            }
        }
    }

    #[test]
    fn euler_angles_invert() {
        for angles in [[0.3, 0.4, -2.0], [-3.0, 1.5, 3.0], [1.0, 3.1, 0.2]] {
            let back = to_euler_313(&from_euler_313(&angles));
            for (a, b) in angles.iter().zip(&back) {
                assert!((a - b).abs() < 1e-12);
            }
        }
        // At the singular positions the matrix, not the triple, is what comes back.
        for theta in [0.0, std::f64::consts::PI] {
            let m = from_euler_313(&[0.4, theta, 0.3]);
            assert!((from_euler_313(&to_euler_313(&m)) - m).norm() < 1e-12);
        }
    }
}
