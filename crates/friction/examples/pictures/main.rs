//! Draws the pictures of the README: `cargo run -p friction --example pictures`.
//!
//! Everything drawn is computed by the laws of this crate, the motions with its stepper.

mod chart;
mod motion;

use std::error::Error;

use chart::{BLUE, Chart, Curve, GREEN, GREY, ORANGE};
use friction::{Effect, LuGre, Original};
use plotters::prelude::SeriesLabelPosition;

/// The coefficients of all pictures.
const ORIGINAL: Original = Original {
    mu_static: 0.3,
    mu_dynamic: 0.2,
    transition_velocity: 1.0,
    transition_coefficient: 1.5,
    max_deformation: 1.0,
    effect: Effect::All,
};

/// Bristles with the same coefficients; one is the Stribeck velocity.
const LUGRE: LuGre = LuGre {
    mu_static: 0.3,
    mu_dynamic: 0.2,
    bristle_stiffness: 1.0,
    damping: 0.0,
    viscous: 0.0,
    stribeck_velocity: 1.0,
    stribeck_exponent: 2.0,
};

/// Points of a function of evenly spaced numbers.
fn sample(from: f64, to: f64, f: impl Fn(f64) -> f64) -> Vec<(f64, f64)> {
    let count = 600;
    (0..=count)
        .map(|k| from + (to - from) * f64::from(k) / f64::from(count))
        .map(|x| (x, f(x)))
        .collect()
}

fn regimes() -> Chart<'static> {
    let at_creep = |d: f64| sample(0.0, 2.2, move |v| -ORIGINAL.evaluate(&[v], &[d]).mu[0]);
    Chart {
        file: "regimes.svg",
        title: "ORIGINAL: coefficient of friction over the surface velocity",
        x: "surface velocity v / Vs",
        y: "friction / load",
        legend: SeriesLabelPosition::LowerRight,
        x_range: 0.0..2.2,
        y_range: -0.16..0.36,
        zones: &[
            (0.0, 1.0, "stuck"),
            (1.0, 1.5, "transition"),
            (1.5, 2.2, "sliding"),
        ],
        curves: vec![
            Curve::new("creep Dm along the velocity", ORANGE, at_creep(1.0)),
            Curve::new("creep Dm/4", GREEN, at_creep(0.25)),
            Curve::new("no creep", BLUE, at_creep(0.0)),
            Curve::new("creep Dm/4 against the velocity", GREY, at_creep(-0.25)),
        ],
    }
}

fn creep() -> Chart<'static> {
    let at_speed = |v: f64| sample(-1.5, 1.5, move |d| -ORIGINAL.evaluate(&[v], &[d]).mu[0]);
    let tangent = 1.875 * ORIGINAL.mu_static;
    Chart {
        file: "creep.svg",
        title: "ORIGINAL: what holds a joint that is stuck",
        x: "creep d / Dm",
        y: "friction / load",
        legend: SeriesLabelPosition::LowerRight,
        x_range: -1.5..1.5,
        y_range: -0.36..0.36,
        zones: &[],
        curves: vec![
            Curve::new("at rest", BLUE, at_speed(0.0)),
            Curve::new("moving at Vs/4", ORANGE, at_speed(0.25)),
            Curve::new(
                "stiffness at zero, 1.875 mu_s N/Dm",
                GREY,
                sample(-0.6, 0.6, |d| tangent * d),
            ),
        ],
    }
}

fn stribeck() -> Chart<'static> {
    let steady = |law: LuGre| sample(0.0, 4.0, move |v| law.stribeck(v).0 + law.viscous * v);
    let exponent = |stribeck_exponent| LuGre {
        stribeck_exponent,
        ..LUGRE
    };
    Chart {
        file: "stribeck.svg",
        title: "LUGRE: friction in steady motion",
        x: "surface velocity v / vs",
        y: "friction / load",
        legend: SeriesLabelPosition::LowerRight,
        x_range: 0.0..4.0,
        y_range: 0.15..0.33,
        zones: &[],
        curves: vec![
            Curve::new("exponent 2", BLUE, steady(exponent(2.0))),
            Curve::new("exponent 1", ORANGE, steady(exponent(1.0))),
            Curve::new("exponent 1/2", GREEN, steady(exponent(0.5))),
            Curve::new(
                "exponent 2 with viscous friction",
                GREY,
                steady(LuGre {
                    viscous: 0.01,
                    ..LUGRE
                }),
            ),
        ],
    }
}

fn presliding() -> Chart<'static> {
    Chart {
        file: "presliding.svg",
        title: "A load of 95 % of the static friction, put on and taken off three times",
        x: "displacement / micrometre",
        y: "load / static friction",
        legend: SeriesLabelPosition::LowerRight,
        x_range: -5.0..355.0,
        y_range: -0.05..1.05,
        zones: &[],
        curves: vec![
            Curve::new("LUGRE drifts", ORANGE, motion::presliding(motion::lugre())),
            Curve::new(
                "ORIGINAL comes back",
                BLUE,
                motion::presliding(motion::original()),
            ),
        ],
    }
}

fn lag() -> Chart<'static> {
    let steady =
        |v: f64| motion::BRISTLES.stribeck(1e-3 * v).0 + motion::BRISTLES.viscous * 1e-3 * v;
    Chart {
        file: "lag.svg",
        title: "LUGRE: friction lags behind the velocity 1.5 + cos(w t) mm/s",
        x: "surface velocity / (mm/s)",
        y: "friction / load",
        legend: SeriesLabelPosition::UpperRight,
        x_range: 0.4..2.6,
        y_range: 0.195..0.285,
        zones: &[],
        curves: vec![
            Curve::new("steady", GREY, sample(0.4, 2.6, steady)),
            Curve::new("w = 5 rad/s", GREEN, motion::lag(5.0)),
            Curve::new("w = 20 rad/s", BLUE, motion::lag(20.0)),
            Curve::new("w = 60 rad/s", ORANGE, motion::lag(60.0)),
        ],
    }
}

fn stick_slip() -> Chart<'static> {
    Chart {
        file: "stick-slip.svg",
        title: "Stick-slip: 1 kg on a belt of 0.1 m/s, held by a spring of 20 N/m",
        x: "time / s",
        y: "velocity / (m/s)",
        legend: SeriesLabelPosition::LowerRight,
        x_range: 0.0..6.0,
        y_range: -0.32..0.2,
        zones: &[],
        curves: vec![
            Curve::new("ORIGINAL", BLUE, motion::belt(motion::original())),
            Curve::new("LUGRE", ORANGE, motion::belt(motion::lugre())),
        ],
    }
}

fn main() -> Result<(), Box<dyn Error>> {
    for chart in [
        regimes(),
        creep(),
        stribeck(),
        presliding(),
        lag(),
        stick_slip(),
    ] {
        chart.draw()?;
    }
    Ok(())
}
