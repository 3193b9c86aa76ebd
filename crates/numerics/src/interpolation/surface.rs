//! Families of curves over a second variable.

use super::PiecewiseCubic;

/// Curves `y(x)` at rising `z`, between which (and beyond which) `y` is linear in `z`; one curve
/// alone does not depend on `z`.
#[derive(Clone, Debug, PartialEq)]
pub struct Surface {
    z: Vec<f64>,
    curves: Vec<PiecewiseCubic>,
}

/// Value and derivatives of a surface at a point; it is linear in `z`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct SurfacePoint {
    /// Value.
    pub value: f64,
    /// `∂/∂x`.
    pub by_x: f64,
    /// `∂/∂z`.
    pub by_z: f64,
    /// `∂²/∂x²`.
    pub by_xx: f64,
    /// `∂²/∂x∂z`.
    pub by_xz: f64,
}

impl From<PiecewiseCubic> for Surface {
    fn from(curve: PiecewiseCubic) -> Self {
        Self {
            z: vec![0.0],
            curves: vec![curve],
        }
    }
}

impl Surface {
    /// A family of curves; `None` without a curve, and where `z` does not increase from curve to
    /// curve.
    #[must_use]
    pub fn new(family: Vec<(f64, PiecewiseCubic)>) -> Option<Self> {
        let (z, curves): (Vec<f64>, Vec<PiecewiseCubic>) = family.into_iter().unzip();
        let drawable = !z.is_empty() && z.is_sorted_by(|a, b| a < b);
        drawable.then_some(Self { z, curves })
    }

    /// The `order`-th derivative by `x` (at most 2) at a point, with its own derivatives.
    ///
    /// ```
    /// use numerics::interpolation::{Extrapolation, PiecewiseCubic, Surface};
    /// let x = [0.0, 1.0, 2.0, 4.0];
    /// let line = |slope: f64| {
    ///     PiecewiseCubic::akima(&x, &x.map(|x| slope * x), Extrapolation::Line).unwrap()
    /// };
    /// let surface = Surface::new(vec![(0.0, line(1.0)), (2.0, line(5.0))]).unwrap();
    /// let point = surface.at(0, 3.0, 0.5);
    /// assert_eq!((point.value, point.by_x, point.by_z, point.by_xz), (6.0, 2.0, 6.0, 2.0));
    /// ```
    #[must_use]
    pub fn at(&self, order: usize, x: f64, z: f64) -> SurfacePoint {
        let [first, others @ ..] = self.curves.as_slice() else {
            return SurfacePoint::default();
        };
        if others.is_empty() {
            let y = first.derivatives(x);
            return SurfacePoint {
                value: y[order],
                by_x: y[order + 1],
                by_xx: y[order + 2],
                ..SurfacePoint::default()
            };
        }
        // The curve below z, or the one before the last.
        let above = self.z.partition_point(|given| *given <= z);
        let below = above.clamp(1, self.z.len() - 1) - 1;
        let width = self.z[below + 1] - self.z[below];
        let share = (z - self.z[below]) / width;
        let [low, high] = [below, below + 1].map(|curve| self.curves[curve].derivatives(x));
        let between = |k: usize| low[k] + share * (high[k] - low[k]);
        let by_z = |k: usize| (high[k] - low[k]) / width;
        SurfacePoint {
            value: between(order),
            by_x: between(order + 1),
            by_z: by_z(order),
            by_xx: between(order + 2),
            by_xz: by_z(order + 1),
        }
    }
}

#[cfg(test)]
mod tests {
    use super::*;
    use crate::interpolation::Extrapolation;

    #[test]
    fn derivatives_match_differences() {
        let x = [0.0, 1.0, 2.0, 4.0, 5.0];
        let curve =
            |y: [f64; 5]| PiecewiseCubic::cubic_spline(&x, &y, Extrapolation::Parabola).unwrap();
        let surface = Surface::new(vec![
            (-1.0, curve([1.0, -1.0, 2.0, 3.0, 0.0])),
            (0.5, curve([0.0, 2.0, 2.0, -1.0, 1.0])),
            (2.0, curve([3.0, 1.0, -2.0, 0.0, 4.0])),
        ])
        .unwrap();
        let h = 1e-5;
        for order in 0..=2 {
            for x in [-1.0, 0.4, 3.0, 7.0] {
                for z in [-3.0, 0.1, 1.2, 5.0] {
                    let here = surface.at(order, x, z);
                    let along = |dx: f64, dz: f64| {
                        let ahead = surface.at(order, x + dx, z + dz);
                        let behind = surface.at(order, x - dx, z - dz);
                        [
                            (ahead.value - behind.value) / (2.0 * h),
                            (ahead.by_x - behind.by_x) / (2.0 * h),
                            (ahead.by_z - behind.by_z) / (2.0 * h),
                        ]
                    };
                    let (x_slopes, z_slopes) = (along(h, 0.0), along(0.0, h));
                    let wanted = [
                        here.by_x, here.by_xx, here.by_xz, here.by_z, here.by_xz, 0.0,
                    ];
                    for (wanted, found) in wanted.iter().zip(x_slopes.iter().chain(&z_slopes)) {
                        // Truncation h² times third derivatives of up to a hundred.
                        assert!((wanted - found).abs() < 1e-7, "{order} {x} {z}");
                    }
                }
            }
        }
    }
}
