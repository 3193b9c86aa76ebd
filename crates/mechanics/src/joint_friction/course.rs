//! How the surfaces move within a step, and where their speed crosses a limit.
//!
//! Displacement and velocity are known at both ends of a step, so the displacement is taken as the
//! cubic of Hermite through them; its error is that of the fourth power of the step. Stick that begins
//! within the step is anchored on it, so that the creep at its end does not depend on where steps end.

/// Displacement of surfaces over a step, by component; `s` runs from 0 at its beginning to 1 at its end.
#[derive(Clone, Copy, Debug)]
pub(super) struct Course<const N: usize> {
    /// Displacement over the step, length.
    pub(super) slip: [f64; N],
    /// Velocity at the beginning and at the end, times the length of the step.
    pub(super) rates: [[f64; N]; 2],
}

/// The creep of a stick that begins within a step, at its end.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct FirstCreep<const N: usize> {
    /// Displacement since the stick began, length.
    pub(super) creep: [f64; N],
    /// Its derivative by the slip of the step.
    pub(super) by_slip: [[f64; N]; N],
    /// And by the velocity at the end times the length of the step.
    pub(super) by_rate: [[f64; N]; N],
}

impl<const N: usize> Course<N> {
    fn place(&self, s: f64) -> [f64; N] {
        let [start, end] = self.rates;
        let (by_slip, by_rate) = (s * s * (3.0 - 2.0 * s), s * s * (s - 1.0));
        let by_start = s * (1.0 - s) * (1.0 - s);
        std::array::from_fn(|k| by_start * start[k] + by_slip * self.slip[k] + by_rate * end[k])
    }

    fn rate(&self, s: f64) -> [f64; N] {
        let [start, end] = self.rates;
        let (by_slip, by_rate) = (6.0 * s * (1.0 - s), s * (3.0 * s - 2.0));
        let by_start = (1.0 - s) * (1.0 - 3.0 * s);
        std::array::from_fn(|k| by_start * start[k] + by_slip * self.slip[k] + by_rate * end[k])
    }

    fn curvature(&self, s: f64) -> [f64; N] {
        let [start, end] = self.rates;
        let (by_slip, by_rate) = (6.0 - 12.0 * s, 6.0 * s - 2.0);
        let by_start = 6.0 * s - 4.0;
        std::array::from_fn(|k| by_start * start[k] + by_slip * self.slip[k] + by_rate * end[k])
    }

    /// Where the rate crosses `limit` in magnitude: none unless one end is below it and the other not.
    pub(super) fn crossing(&self, limit: f64) -> Option<f64> {
        let outside = |rate: [f64; N]| dot(&rate, &rate) - limit * limit;
        let [mut a, mut b] = [0.0, 1.0];
        let [mut fa, mut fb] = self.rates.map(outside);
        if (fa < 0.0) == (fb < 0.0) || !(fa - fb).is_finite() {
            return None;
        }
        // The Illinois variant of the false position: it keeps the root between both ends.
        let mut s = a;
        for _ in 0..60 {
            s = (a * fb - b * fa) / (fb - fa);
            let f = outside(self.rate(s));
            if f.abs() <= 1e-12 * limit * limit || (b - a).abs() < 1e-14 {
                break;
            }
            if (f < 0.0) == (fb < 0.0) {
                fa *= 0.5;
            } else {
                (a, fa) = (b, fb);
            }
            (b, fb) = (s, f);
        }
        Some(s.clamp(0.0, 1.0))
    }

    /// Creep at the end of a step within which the rate falls below `limit` in magnitude.
    pub(super) fn first_creep(&self, limit: f64) -> Option<FirstCreep<N>> {
        let s = self.crossing(limit)?;
        let (place, rate) = (self.place(s), self.rate(s));
        // Where the crossing moves to: rate · (∂rate + curvature ∂s) = 0.
        let slope = dot(&rate, &self.curvature(s));
        let [place_by_slip, rate_by_slip] = [s * s * (3.0 - 2.0 * s), 6.0 * s * (1.0 - s)];
        let [place_by_rate, rate_by_rate] = [s * s * (s - 1.0), s * (3.0 * s - 2.0)];
        let derivative = |own: f64, of_place: f64, of_rate: f64| {
            std::array::from_fn(|i| {
                std::array::from_fn(|k| {
                    let moved = if slope < 0.0 {
                        rate[i] * rate[k] * of_rate / slope
                    } else {
                        0.0
                    };
                    moved + if i == k { own - of_place } else { 0.0 }
                })
            })
        };
        Some(FirstCreep {
            creep: std::array::from_fn(|k| self.slip[k] - place[k]),
            by_slip: derivative(1.0, place_by_slip, rate_by_slip),
            by_rate: derivative(0.0, place_by_rate, rate_by_rate),
        })
    }
}

fn dot<const N: usize>(a: &[f64; N], b: &[f64; N]) -> f64 {
    a.iter().zip(b).map(|(a, b)| a * b).sum()
}

#[cfg(test)]
mod tests {
    use super::{Course, FirstCreep};

    /// Of a cubic motion the crossing and the way since are exact.
    #[test]
    fn a_cubic_is_exact() {
        // x = 2 t - 1.5 t² + 0.2 t³ in 0 ≤ t ≤ 0.6: its rate falls to 0.5 where 0.6 t² - 3 t + 1.5 = 0.
        let h = 0.6_f64;
        let x = |t: f64| 2.0 * t - 1.5 * t * t + 0.2 * t * t * t;
        let v = |t: f64| 2.0 - 3.0 * t + 0.6 * t * t;
        let course = Course {
            slip: [x(h)],
            rates: [[h * v(0.0)], [h * v(h)]],
        };
        let t = (3.0 - (9.0_f64 - 3.6).sqrt()) / 1.2;
        let s = course.crossing(0.5 * h).unwrap();
        assert!((s * h - t).abs() < 1e-13, "{} {t}", s * h);
        let first = course.first_creep(0.5 * h).unwrap();
        assert!((first.creep[0] - (x(h) - x(t))).abs() < 1e-13);
        assert!(course.crossing(0.1 * h).is_none());
    }

    /// The derivatives are those of the creep in three directions.
    #[test]
    fn derivatives_are_differences() {
        let base = Course {
            slip: [0.5, -0.2, 0.1],
            rates: [[1.0, -0.3, 0.2], [0.1, 0.05, -0.12]],
        };
        let creep = |course: Course<3>| course.first_creep(0.4).unwrap().creep;
        let FirstCreep {
            by_slip, by_rate, ..
        } = base.first_creep(0.4).unwrap();
        let d = 1e-6;
        for k in 0..3 {
            let (mut slipped, mut faster) = (base, base);
            slipped.slip[k] += d;
            faster.rates[1][k] += d;
            for i in 0..3 {
                // Forward differences are off by d times the second derivative, which is about ten.
                let difference = |moved| (creep(moved)[i] - creep(base)[i]) / d;
                assert!((difference(slipped) - by_slip[i][k]).abs() < 1e-4);
                assert!((difference(faster) - by_rate[i][k]).abs() < 1e-4);
            }
        }
    }
}
