//! Time at a given error, between the measured ones.

use super::work_precision::{Row, Setting};

/// How far below the smallest measured error the line is drawn on.
const FARTHEST: f64 = 10.0;

/// The time that an error takes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Matched {
    /// Processor time, seconds.
    pub(crate) time: f64,
    /// Whether it lies beyond what was measured.
    pub(crate) extrapolated: bool,
}

/// Processor time at which the named integrator or peer reaches the error `target`.
///
/// A setting counts with the largest error of itself and of all tighter ones, so that no lucky
/// error counts. Between settings, error and time are taken as powers of one another. A peer of
/// fixed steps is followed on beyond its last error by a factor of ten at most.
pub(crate) fn time_at(rows: &[Row], name: &str, target: f64) -> Option<Matched> {
    let mut points: Vec<(f64, f64)> = Vec::new();
    let mut fixed_steps = false;
    for row in rows.iter().filter(|row| row.name == name) {
        fixed_steps |= matches!(row.setting, Setting::Steps(_));
        if let Ok(outcome) = &row.outcome {
            points.push((outcome.error, outcome.times.processor));
        }
    }
    let mut worst = 0.0_f64;
    for point in points.iter_mut().rev() {
        worst = worst.max(point.0);
        point.0 = worst;
    }
    let between = |a: (f64, f64), b: (f64, f64)| {
        let part = (a.0 / target).ln() / (a.0 / b.0).ln();
        a.1 * (b.1 / a.1).powf(part)
    };
    let measured = |time| Matched {
        time,
        extrapolated: false,
    };
    match points.iter().position(|point| point.0 <= target) {
        Some(0) => Some(measured(points[0].1)),
        Some(k) => Some(measured(between(points[k - 1], points[k]))),
        None => {
            let [.., a, b] = points[..] else {
                return None;
            };
            let near = fixed_steps && b.0 <= FARTHEST * target && b.0 < a.0;
            near.then(|| Matched {
                time: between(a, b),
                extrapolated: true,
            })
        }
    }
}

#[cfg(test)]
mod tests {
    use mechanics::Statistics;

    use super::super::clock::Times;
    use super::super::work_precision::Outcome;
    use super::*;

    fn rows(settings: fn(usize) -> Setting, points: &[(f64, f64)]) -> Vec<Row> {
        let row = |(k, &(error, time)): (usize, &(f64, f64))| Row {
            name: "it",
            setting: settings(k),
            outcome: Ok(Outcome {
                times: Times {
                    processor: time,
                    wall: time,
                },
                error,
                statistics: Some(Statistics::default()),
            }),
        };
        points.iter().enumerate().map(row).collect()
    }

    /// Ten times the work for a hundredth of the error: ten times less error costs √10.
    #[test]
    fn time_is_a_power_of_the_error() {
        let rows = rows(|_| Setting::Steps(1), &[(1e-2, 1.0), (1e-4, 10.0)]);
        let at = |target: f64| time_at(&rows, "it", target);
        let close = |found: Option<Matched>, time: f64, extrapolated: bool| {
            let found = found.expect("a time");
            assert!((found.time / time - 1.0).abs() < 1e-12);
            assert_eq!(found.extrapolated, extrapolated);
        };
        close(at(1.0), 1.0, false);
        close(at(1e-3), 10f64.sqrt(), false);
        close(at(1e-5), 10.0 * 10f64.sqrt(), true);
        assert_eq!(at(1e-6), None);
        assert_eq!(time_at(&rows, "another", 1.0), None);
    }

    /// An error that the next tighter setting does not keep is luck.
    #[test]
    fn luck_does_not_count() {
        let points = [(1e-2, 1.0), (1e-9, 2.0), (1e-4, 3.0)];
        let rows = rows(|_| Setting::Error(1.0), &points);
        let found = time_at(&rows, "it", 1e-4).expect("a time");
        assert!((found.time - 2.0).abs() < 1e-12, "{found:?}");
        assert_eq!(time_at(&rows, "it", 1e-5), None);
    }
}
