//! The friction laws over arrays of numbers, which come and go as bytes.

use friction::{Effect, LuGre, Original, Regime};
use pyo3::prelude::*;
use pyo3::types::PyBytes;

use crate::table::{numbers, values};

/// The least level of bristles, force: below it they would not be defined.
const LEAST: f64 = 1e-12;

/// The coefficient of ORIGINAL, its regime (0 stuck, 1 transition, 2 sliding) and the creep to go on
/// with, by velocity and creep.
#[pyfunction]
pub(crate) fn original<'py>(
    py: Python<'py>,
    parameters: [f64; 5],
    effect: &str,
    velocity: &[u8],
    creep: &[u8],
) -> PyResult<[Bound<'py, PyBytes>; 3]> {
    let [
        mu_static,
        mu_dynamic,
        transition_velocity,
        transition_coefficient,
        max_deformation,
    ] = parameters;
    let effect = match effect {
        "stiction" => Effect::Stiction,
        "sliding" => Effect::Sliding,
        _ => Effect::All,
    };
    let law = Original {
        mu_static,
        mu_dynamic,
        transition_velocity,
        transition_coefficient,
        max_deformation,
        effect,
    };
    let mut found = [(); 3].map(|()| Vec::with_capacity(velocity.len() / 8));
    py.detach(|| {
        for (v, d) in values(velocity).zip(values(creep)) {
            let coefficient = law.evaluate(&[v], &[d]);
            let regime = match coefficient.regime {
                Regime::Stuck => 0.0,
                Regime::Transition => 1.0,
                Regime::Sliding => 2.0,
            };
            let [settled] = law.settle(&[v], [d]);
            for (column, value) in found.iter_mut().zip([coefficient.mu[0], regime, settled]) {
                column.push(value);
            }
        }
    });
    let [mu, regime, settled] = &found;
    Ok([
        numbers(py, mu)?,
        numbers(py, regime)?,
        numbers(py, settled)?,
    ])
}

fn bristles(parameters: [f64; 7]) -> LuGre {
    let [
        mu_static,
        mu_dynamic,
        bristle_stiffness,
        damping,
        viscous,
        stribeck_velocity,
        stribeck_exponent,
    ] = parameters;
    LuGre {
        mu_static,
        mu_dynamic,
        bristle_stiffness,
        damping,
        viscous,
        stribeck_velocity,
        stribeck_exponent,
    }
}

/// Force, deflection and rate of the bristles after a step `gamma`, by velocity, past deflection,
/// load and preload.
#[pyfunction]
pub(crate) fn lugre<'py>(
    py: Python<'py>,
    parameters: [f64; 7],
    gamma: f64,
    velocity: &[u8],
    deflection: &[u8],
    load: &[u8],
    preload: &[u8],
) -> PyResult<[Bound<'py, PyBytes>; 3]> {
    let law = bristles(parameters);
    let mut found = [(); 3].map(|()| Vec::with_capacity(velocity.len() / 8));
    py.detach(|| {
        let states = values(velocity).zip(values(deflection));
        let loads = values(load).zip(values(preload));
        for ((v, z), (n, p)) in states.zip(loads) {
            let bristles = law.evaluate(&[v], &[z], gamma, n, &[p], LEAST);
            let three = [bristles.force, bristles.deflection, bristles.rate];
            for (column, [value]) in found.iter_mut().zip(three) {
                column.push(value);
            }
        }
    });
    let [force, deflection, rate] = &found;
    Ok([
        numbers(py, force)?,
        numbers(py, deflection)?,
        numbers(py, rate)?,
    ])
}

/// The Stribeck curve of LUGRE by speed.
#[pyfunction]
pub(crate) fn lugre_stribeck<'py>(
    py: Python<'py>,
    parameters: [f64; 7],
    speed: &[u8],
) -> PyResult<Bound<'py, PyBytes>> {
    let law = bristles(parameters);
    let found: Vec<f64> = values(speed).map(|v| law.stribeck(v).0).collect();
    numbers(py, &found)
}
