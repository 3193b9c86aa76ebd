//! Numbers that carry derivatives, so that a measure is written once and its derivatives follow.

use serde::{Deserialize, Serialize};
use std::ops::{Add, Div, Mul, Neg, Sub};

/// What the formulas of [`crate::measure`] need of a number.
pub(crate) trait Scalar:
    Copy
    + Add<Output = Self>
    + Sub<Output = Self>
    + Mul<Output = Self>
    + Div<Output = Self>
    + Neg<Output = Self>
{
    /// A number without derivatives.
    fn constant(value: f64) -> Self;
    /// The value alone.
    fn value(self) -> f64;
    /// A function of one variable, given its value, slope and curvature at `self.value()`.
    fn chain(self, value: f64, slope: f64, curvature: f64) -> Self;

    fn sqrt(self) -> Self {
        let root = self.value().sqrt();
        // The kink of |d| at zero: value with zero slope, as everywhere for magnitudes.
        if root == 0.0 {
            return Self::constant(0.0);
        }
        self.chain(root, 0.5 / root, -0.25 / (root * root * root))
    }

    /// The angle of the point (`x`, `self`), as `f64::atan2`, with zero slope at the origin.
    fn atan2(self, x: Self) -> Self {
        let (s, c) = (self.value(), x.value());
        let radius2 = s * s + c * c;
        if radius2 == 0.0 {
            return Self::constant(0.0);
        }
        // Turning the point back to angle zero makes the derivatives those of asin(sine/radius).
        let radius = (self * self + x * x).sqrt();
        let angle = s.atan2(c);
        let (sine, cosine) = angle.sin_cos();
        let across = (self * Self::constant(cosine) - x * Self::constant(sine)) / radius;
        // `across` is zero in value; asin has slope one and curvature zero there.
        across.chain(angle, 1.0, 0.0)
    }
}

impl Scalar for f64 {
    fn constant(value: f64) -> Self {
        value
    }
    fn value(self) -> f64 {
        self
    }
    fn chain(self, value: f64, _: f64, _: f64) -> Self {
        value
    }
}

/// Value and first derivatives with respect to `N` motions of one body: position and rotation
/// `(δr, δθ)`, velocity and angular velocity `(δv, δω)`, and so on, ground axes.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Dual<const N: usize> {
    pub(crate) value: f64,
    pub(crate) slopes: [f64; N],
}

impl<const N: usize> Dual<N> {
    fn combine(self, other: Self, value: f64, by_self: f64, by_other: f64) -> Self {
        let mut slopes = [0.0; N];
        for k in 0..N {
            slopes[k] = by_self * self.slopes[k] + by_other * other.slopes[k];
        }
        Self { value, slopes }
    }
}

impl<const N: usize> Add for Dual<N> {
    type Output = Self;
    fn add(self, other: Self) -> Self {
        self.combine(other, self.value + other.value, 1.0, 1.0)
    }
}
impl<const N: usize> Sub for Dual<N> {
    type Output = Self;
    fn sub(self, other: Self) -> Self {
        self.combine(other, self.value - other.value, 1.0, -1.0)
    }
}
impl<const N: usize> Mul for Dual<N> {
    type Output = Self;
    fn mul(self, other: Self) -> Self {
        self.combine(other, self.value * other.value, other.value, self.value)
    }
}
impl<const N: usize> Div for Dual<N> {
    type Output = Self;
    fn div(self, other: Self) -> Self {
        let value = self.value / other.value;
        self.combine(other, value, 1.0 / other.value, -value / other.value)
    }
}
impl<const N: usize> Neg for Dual<N> {
    type Output = Self;
    fn neg(self) -> Self {
        self.chain(-self.value, -1.0, 0.0)
    }
}
impl<const N: usize> Scalar for Dual<N> {
    fn constant(value: f64) -> Self {
        Self {
            value,
            slopes: [0.0; N],
        }
    }
    fn value(self) -> f64 {
        self.value
    }
    fn chain(self, value: f64, slope: f64, _: f64) -> Self {
        let mut slopes = self.slopes;
        for s in &mut slopes {
            *s *= slope;
        }
        Self { value, slopes }
    }
}

/// Value, rate and acceleration along a motion in time.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
pub(crate) struct Jet {
    pub(crate) value: f64,
    pub(crate) rate: f64,
    pub(crate) acceleration: f64,
}

impl Add for Jet {
    type Output = Self;
    fn add(self, o: Self) -> Self {
        Self {
            value: self.value + o.value,
            rate: self.rate + o.rate,
            acceleration: self.acceleration + o.acceleration,
        }
    }
}
impl Sub for Jet {
    type Output = Self;
    fn sub(self, o: Self) -> Self {
        self + -o
    }
}
impl Mul for Jet {
    type Output = Self;
    fn mul(self, o: Self) -> Self {
        Self {
            value: self.value * o.value,
            rate: self.rate * o.value + self.value * o.rate,
            acceleration: self.acceleration * o.value
                + 2.0 * self.rate * o.rate
                + self.value * o.acceleration,
        }
    }
}
impl Div for Jet {
    type Output = Self;
    fn div(self, o: Self) -> Self {
        let inverse = 1.0 / o.value;
        let squared = inverse * inverse;
        self * o.chain(inverse, -squared, 2.0 * squared * inverse)
    }
}
impl Neg for Jet {
    type Output = Self;
    fn neg(self) -> Self {
        Self {
            value: -self.value,
            rate: -self.rate,
            acceleration: -self.acceleration,
        }
    }
}
impl Scalar for Jet {
    fn constant(value: f64) -> Self {
        Self {
            value,
            rate: 0.0,
            acceleration: 0.0,
        }
    }
    fn value(self) -> f64 {
        self.value
    }
    fn chain(self, value: f64, slope: f64, curvature: f64) -> Self {
        Self {
            value,
            rate: slope * self.rate,
            acceleration: slope * self.acceleration + curvature * self.rate * self.rate,
        }
    }
}

/// Three components.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Triple<T>(pub(crate) [T; 3]);

impl<T: Scalar> Triple<T> {
    pub(crate) fn dot(&self, other: &Self) -> T {
        self.0[0] * other.0[0] + self.0[1] * other.0[1] + self.0[2] * other.0[2]
    }
    pub(crate) fn cross(&self, other: &Self) -> Self {
        let (a, b) = (&self.0, &other.0);
        Self([
            a[1] * b[2] - a[2] * b[1],
            a[2] * b[0] - a[0] * b[2],
            a[0] * b[1] - a[1] * b[0],
        ])
    }
    pub(crate) fn minus(&self, other: &Self) -> Self {
        Self([
            self.0[0] - other.0[0],
            self.0[1] - other.0[1],
            self.0[2] - other.0[2],
        ])
    }
    pub(crate) fn times(&self, factor: T) -> Self {
        Self(self.0.map(|component| component * factor))
    }
    pub(crate) fn norm(&self) -> T {
        self.dot(self).sqrt()
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn jets_follow_the_chain_rule() {
        // f(t) = atan2(sin 2t, 1 + t²)·sqrt(3 + t), differentiated by central differences.
        let f = |t: Jet| {
            let a = t.value * 2.0;
            let sine = (t * Jet::constant(2.0)).chain(a.sin(), a.cos(), -a.sin());
            sine.atan2(Jet::constant(1.0) + t * t) * (Jet::constant(3.0) + t).sqrt()
        };
        let at = |t: f64| {
            f(Jet {
                value: t,
                rate: 1.0,
                acceleration: 0.0,
            })
        };
        let (t, h) = (0.4, 1e-4);
        let jet = at(t);
        let rate = (at(t + h).value - at(t - h).value) / (2.0 * h);
        let acceleration = (at(t + h).rate - at(t - h).rate) / (2.0 * h);
        // Truncation h²/6 times the third derivative, about 1e-8.
        assert!((jet.rate - rate).abs() < 1e-7, "{} {rate}", jet.rate);
        assert!((jet.acceleration - acceleration).abs() < 1e-6);
    }
}
