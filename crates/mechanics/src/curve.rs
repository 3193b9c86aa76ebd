//! Curves in space, and how far a point is from one.
//!
//! With `s` the parameter, `c(s)` the curve and `e = p − c(s)` from its nearest point to `p`,
//!
//! ```text
//! c' · e = 0                        decides s(p)
//! g₁ = r · e,   g₂ = (c' × r) · e   are zero where p is on the curve
//! ```
//!
//! where `r(s)` is a smooth field of directions across the curve. All derivatives by `p`, those of
//! `s(p)` too, are exact also beside the curve.

use nalgebra::{Matrix3, Rotation3, Unit, Vector3};
use numerics::interpolation::{Extrapolation, PiecewiseCubic};

/// Points looked at in every interval between two given points, for the nearest one to start from.
const FINENESS: usize = 8;

/// What a curve is drawn through its points by.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Drawing {
    /// Straight lines: a curve of order 2.
    Lines,
    /// A cubic spline, curvature being continuous: a curve of order 4.
    Spline,
}

/// A curve through points, fixed to a frame. Its parameter is the length of the chords between the
/// points; beyond the ends of an open curve it goes on straight.
///
/// ```
/// use mechanics::curve::{Curve, Drawing};
/// use nalgebra::Vector3;
/// let point = |x: f64| Vector3::new(x, x * x, 0.0);
/// let points: Vec<_> = (0..9).map(|k| point(0.25 * f64::from(k))).collect();
/// let curve = Curve::through(&points, false, Drawing::Spline).unwrap();
/// assert!((curve.coordinate(0, 0, curve.length()) - 2.0).abs() < 1e-12);
/// let across = curve.across(&point(1.0));
/// assert!(across.iter().all(|g| g.value.abs() < 1e-12));
/// ```
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    coordinates: [PiecewiseCubic; 3],
    /// The field r.
    across: [PiecewiseCubic; 3],
    length: f64,
    closed: bool,
    /// Parameters and points to start the search for the nearest point from.
    samples: Vec<(f64, Vector3<f64>)>,
}

/// One of the two functions that are zero on a curve, with derivatives by the point.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Across {
    /// Value.
    pub value: f64,
    /// Gradient.
    pub gradient: Vector3<f64>,
    /// Second derivatives.
    pub hessian: Matrix3<f64>,
}

/// Why there is no curve through given points.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Undrawable {
    /// The point of this number, from 0, is the same as the one before it.
    Coincident(usize),
    /// There are fewer than four points, or some are too far apart to tell others from one another.
    FewPoints,
}

impl Curve {
    /// A curve through at least four points; of a closed one the last point is the first.
    ///
    /// # Errors
    /// Why there is none.
    pub fn through(
        points: &[Vector3<f64>],
        closed: bool,
        drawing: Drawing,
    ) -> Result<Self, Undrawable> {
        let mut parameters = vec![0.0];
        let mut length = 0.0;
        for (place, pair) in points.windows(2).enumerate() {
            let chord = (pair[1] - pair[0]).norm();
            if !(chord > 0.0) {
                return Err(Undrawable::Coincident(place + 1));
            }
            length += chord;
            parameters.push(length);
        }
        let coordinates = draw(&parameters, points, closed, drawing)?;
        let mut curve = Self {
            across: coordinates.clone(),
            coordinates,
            length,
            closed,
            samples: Vec::new(),
        };
        let mut places = Vec::with_capacity(FINENESS * points.len());
        for pair in parameters.windows(2) {
            let share = |k: usize| k as f64 / FINENESS as f64;
            places.extend((0..FINENESS).map(|k| pair[0] + share(k) * (pair[1] - pair[0])));
        }
        places.push(length);
        curve.across = curve.field(&places)?;
        curve.samples = places
            .into_iter()
            .map(|s| (s, curve.vector(0, s)))
            .collect();
        Ok(curve)
    }

    /// Directions across the curve that turn about it as little as can be (the double reflections
    /// of Wang, Jüttler, Zheng and Liu, *Computation of rotation minimizing frames*, 2008); along a
    /// closed curve the turn that remains is spread evenly.
    fn field(&self, places: &[f64]) -> Result<[PiecewiseCubic; 3], Undrawable> {
        let tangent = |s: f64| self.vector(1, s).normalize();
        let reflected = |v: &Vector3<f64>, along: &Vector3<f64>| {
            let square = along.norm_squared();
            if square > 0.0 {
                v - 2.0 / square * along.dot(v) * along
            } else {
                *v
            }
        };
        let mut t = tangent(places[0]);
        let axis = t.iamin();
        let mut r = t.cross(&Vector3::ith(axis, 1.0)).normalize();
        let mut field = vec![r];
        for pair in places.windows(2) {
            let step = self.vector(0, pair[1]) - self.vector(0, pair[0]);
            let (r_half, t_half) = (reflected(&r, &step), reflected(&t, &step));
            t = tangent(pair[1]);
            r = reflected(&r_half, &(t - t_half));
            field.push(r);
        }
        if self.closed {
            let first = field[0];
            let turned = t.dot(&r.cross(&first)).atan2(r.dot(&first));
            for (direction, s) in field.iter_mut().zip(places) {
                let about = Unit::new_normalize(tangent(*s));
                let turn = Rotation3::from_axis_angle(&about, turned * s / self.length);
                *direction = turn * *direction;
            }
            // Equal but for rounding.
            let last = field.len() - 1;
            field[last] = first;
        }
        draw(places, &field, self.closed, Drawing::Spline)
    }

    /// Length of all chords: the greatest parameter.
    #[must_use]
    pub fn length(&self) -> f64 {
        self.length
    }

    /// The coordinate `axis`, or its `order`-th derivative (1 or 2), as a function of the parameter.
    #[must_use]
    pub fn coordinate(&self, axis: usize, order: usize, s: f64) -> f64 {
        self.coordinates[axis].derivatives(self.wrapped(s))[order]
    }

    /// A coordinate as a piecewise cubic of the parameter.
    #[must_use]
    pub fn axis(&self, axis: usize) -> &PiecewiseCubic {
        &self.coordinates[axis]
    }

    fn wrapped(&self, s: f64) -> f64 {
        if self.closed {
            s.rem_euclid(self.length)
        } else {
            s
        }
    }

    fn vector(&self, order: usize, s: f64) -> Vector3<f64> {
        vector(&self.coordinates, self.wrapped(s))[order]
    }

    /// Parameter of the point of the curve that is nearest to `p`.
    #[must_use]
    pub fn nearest(&self, p: &Vector3<f64>) -> f64 {
        let distance = |sample: &(f64, Vector3<f64>)| (sample.1 - p).norm_squared();
        let start = self
            .samples
            .iter()
            .min_by(|a, b| distance(a).total_cmp(&distance(b)));
        let mut s = start.map_or(0.0, |sample| sample.0);
        // The nearest point is not farther from the sample than its neighbours are.
        let widest = self.length / FINENESS as f64;
        for _ in 0..ITERATIONS {
            let [c, c1, c2, ..] = vector(&self.coordinates, self.wrapped(s));
            let e = p - c;
            let square = c1.norm_squared();
            let bend = square - c2.dot(&e);
            // Far from the curve on the inside of a bend the second derivative misleads.
            let slope = if bend > 0.1 * square { bend } else { square };
            let step = (c1.dot(&e) / slope).clamp(-widest, widest);
            s += step;
            if step.abs() <= 1e-15 * self.length {
                break;
            }
        }
        s
    }

    /// The two functions of a point that are zero on the curve.
    #[must_use]
    pub fn across(&self, p: &Vector3<f64>) -> [Across; 2] {
        let s = self.wrapped(self.nearest(p));
        let [c, c1, c2, c3] = vector(&self.coordinates, s);
        let [r, r1, r2, _] = vector(&self.across, s);
        let e = p - c;
        let slope = c1.norm_squared() - c2.dot(&e);
        let s_p = c1 / slope;
        let curvature = c3.dot(&e) - 3.0 * c1.dot(&c2);
        let turning = c2 * s_p.transpose();
        let s_pp = (curvature * s_p * s_p.transpose() + turning + turning.transpose()) / slope;
        let normals = [
            [r, r1, r2],
            [
                c1.cross(&r),
                c2.cross(&r) + c1.cross(&r1),
                c3.cross(&r) + 2.0 * c2.cross(&r1) + c1.cross(&r2),
            ],
        ];
        normals.map(|[n, n1, n2]| {
            let by_s = n1.dot(&e) - n.dot(&c1);
            let by_ss = n2.dot(&e) - 2.0 * n1.dot(&c1) - n.dot(&c2);
            let mixed = n1 * s_p.transpose();
            Across {
                value: n.dot(&e),
                gradient: n + by_s * s_p,
                hessian: by_ss * s_p * s_p.transpose() + mixed + mixed.transpose() + by_s * s_pp,
            }
        })
    }
}

/// Newton's method for the nearest point needs a handful; more only far from the curve.
const ITERATIONS: usize = 50;

/// The three components of vectors as functions of a parameter.
fn draw(
    parameters: &[f64],
    vectors: &[Vector3<f64>],
    closed: bool,
    drawing: Drawing,
) -> Result<[PiecewiseCubic; 3], Undrawable> {
    let component = |axis: usize| {
        let values: Vec<f64> = vectors.iter().map(|vector| vector[axis]).collect();
        let drawn = match (drawing, closed) {
            (Drawing::Lines, _) => PiecewiseCubic::polyline(parameters, &values),
            (Drawing::Spline, false) => {
                PiecewiseCubic::cubic_spline(parameters, &values, Extrapolation::Tangent)
            }
            (Drawing::Spline, true) => PiecewiseCubic::periodic(parameters, &values),
        };
        drawn.ok_or(Undrawable::FewPoints)
    };
    Ok([component(0)?, component(1)?, component(2)?])
}

/// Value and three derivatives of a vector.
fn vector(coordinates: &[PiecewiseCubic; 3], s: f64) -> [Vector3<f64>; 4] {
    let [x, y, z] = [0, 1, 2].map(|axis| coordinates[axis].derivatives(s));
    std::array::from_fn(|order| Vector3::new(x[order], y[order], z[order]))
}

#[cfg(test)]
mod tests {
    use super::*;
    use std::f64::consts::TAU;

    /// A closed curve in space that twists.
    fn knot(count: usize) -> Vec<Vector3<f64>> {
        let at = |k: usize| {
            let a = TAU * (k % count) as f64 / count as f64;
            Vector3::new(2.0 * a.cos(), 1.5 * a.sin(), 0.7 * (2.0 * a).sin())
        };
        (0..=count).map(at).collect()
    }

    fn helix() -> Vec<Vector3<f64>> {
        let at = |k: usize| {
            let a = 0.2 * k as f64;
            Vector3::new(a.cos(), a.sin(), 0.3 * a)
        };
        (0..40).map(at).collect()
    }

    #[test]
    fn functions_across_have_exact_derivatives() {
        for curve in [
            Curve::through(&knot(24), true, Drawing::Spline).unwrap(),
            Curve::through(&helix(), false, Drawing::Spline).unwrap(),
        ] {
            for share in [0.13, 0.5, 0.77, 0.999] {
                let on = curve.vector(0, share * curve.length);
                let p = on + Vector3::new(0.11, -0.07, 0.05);
                let h = 1e-5;
                for component in 0..2 {
                    let here = curve.across(&p)[component];
                    for axis in 0..3 {
                        let step = Vector3::ith(axis, h);
                        let ahead = curve.across(&(p + step))[component];
                        let behind = curve.across(&(p - step))[component];
                        let slope = (ahead.value - behind.value) / (2.0 * h);
                        let bend = (ahead.gradient - behind.gradient) / (2.0 * h);
                        // Truncation h² times third derivatives of up to a hundred.
                        assert!((here.gradient[axis] - slope).abs() < 1e-7);
                        assert!((here.hessian.column(axis) - bend).norm() < 1e-6);
                    }
                }
                assert!(curve.across(&on).iter().all(|g| g.value.abs() < 1e-14));
            }
        }
    }

    #[test]
    fn the_functions_are_zero_on_the_curve_alone() {
        let curve = Curve::through(&knot(24), true, Drawing::Spline).unwrap();
        for k in 0..200 {
            let s = curve.length * f64::from(k) / 200.0;
            let on = curve.vector(0, s);
            let [a, b] = curve.across(&on).map(|g| g.gradient);
            // Both gradients are across the curve and not parallel.
            let tangent = curve.vector(1, s).normalize();
            assert!(a.dot(&tangent).abs() < 1e-12 && b.dot(&tangent).abs() < 1e-12);
            assert!(a.cross(&b).norm() > 0.5, "{k}");
            let round = (curve.nearest(&on) - s + 0.5 * curve.length).rem_euclid(curve.length);
            assert!((round - 0.5 * curve.length).abs() < 1e-12);
        }
    }

    #[test]
    fn lines_go_on_straight_and_points_that_coincide_are_told() {
        let points = [0.0, 1.0, 3.0, 4.0].map(|x| Vector3::new(x, 2.0 * x, 0.0));
        let curve = Curve::through(&points, false, Drawing::Lines).unwrap();
        for x in [-2.0, 0.3, 7.0] {
            let on = Vector3::new(x, 2.0 * x, 0.0);
            assert!(curve.across(&on).iter().all(|g| g.value.abs() < 1e-13));
        }
        let mut doubled = points;
        doubled[2] = doubled[1];
        assert_eq!(
            Curve::through(&doubled, false, Drawing::Lines),
            Err(Undrawable::Coincident(2))
        );
        let few = Curve::through(&doubled[..2], false, Drawing::Lines);
        assert_eq!(few, Err(Undrawable::FewPoints));
    }
}
