//! Energies of a state.

use nalgebra::{Matrix3, Vector3};

use crate::model::Model;
use crate::state::{State, VELOCITIES};

/// Kinetic energy of the bodies, in the model's unit of energy.
#[must_use]
pub fn kinetic_energy(model: &Model, state: &State) -> f64 {
    let energies = model
        .bodies
        .iter()
        .zip(state.velocities().chunks_exact(VELOCITIES));
    let energies = energies.enumerate().map(|(place, (body, u))| {
        let velocity = Vector3::from_column_slice(&u[..3]);
        let rotation: Matrix3<f64> = state.orientation(place).matrix();
        let omega = rotation.transpose() * Vector3::from_column_slice(&u[3..]);
        0.5 * (body.mass * velocity.norm_squared() + omega.dot(&(body.inertia * omega)))
    });
    energies.sum()
}

/// Potential energy of the weight of the bodies, zero at the ground's origin.
#[must_use]
pub fn gravity_energy(model: &Model, state: &State) -> f64 {
    let bodies = model.bodies.iter().enumerate();
    bodies
        .map(|(place, body)| -body.mass * model.gravity.dot(&state.centre(place)))
        .sum()
}
