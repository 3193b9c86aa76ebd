//! Algebraic variables that are a quantity of acceleration: values and derivatives.

use nalgebra::Vector3;
use numerics::linear::Matrix;

use super::System;
use super::newton_matrix::Weights;
use crate::measure::{self, MarkerAcceleration};

impl System {
    /// Linear and angular acceleration at a point of a body, `arm` from its centre of mass, for the
    /// accelerations of all bodies, ground axes.
    pub(crate) fn acceleration_at(
        &self,
        body: usize,
        arm: &Vector3<f64>,
        accelerations: &[f64],
    ) -> MarkerAcceleration {
        let a = &accelerations[6 * body..6 * body + 6];
        let angular = Vector3::from_column_slice(&a[3..]);
        let omega = self.bodies[body].omega;
        let linear = Vector3::from_column_slice(&a[..3])
            + angular.cross(arm)
            + omega.cross(&omega.cross(arm));
        MarkerAcceleration { linear, angular }
    }

    /// The same at a marker.
    pub(crate) fn marker_acceleration(
        &self,
        marker: usize,
        accelerations: &[f64],
    ) -> MarkerAcceleration {
        let frame = self.marker(marker);
        match frame.body {
            Some(body) => self.acceleration_at(body, &frame.arm, accelerations),
            None => MarkerAcceleration::default(),
        }
    }

    /// Value of a measure of acceleration.
    pub(crate) fn acceleration_value(&self, place: usize, accelerations: &[f64]) -> f64 {
        let measure = &self.model.measures[place];
        let [i, j, k, l] = &measure.markers().map(|m| self.marker(m));
        let at = measure
            .markers()
            .map(|m| self.marker_acceleration(m, accelerations));
        measure::acceleration(measure.quantity, [i, j, k, l], &at)
    }

    /// Adds the derivatives of a measure of acceleration, with the opposite sign, to a row.
    pub(super) fn assemble_acceleration(
        &self,
        place: usize,
        row: usize,
        weights: &Weights,
        matrix: &mut Matrix,
    ) {
        let measure = &self.model.measures[place];
        let [i, j, k, l] = &measure.markers().map(|m| self.marker(m));
        let at = measure
            .markers()
            .map(|m| self.marker_acceleration(m, &self.inputs.rates));
        for &body in &self.measure_bodies[place] {
            let slopes = measure::acceleration_slopes(measure.quantity, [i, j, k, l], &at, body);
            for k in 0..6 {
                let free = k < 3 || self.model.bodies[body].rotates;
                let value = weights.position * slopes[k]
                    + weights.velocity * slopes[6 + k]
                    + weights.rate * slopes[12 + k];
                let value = if free { -value } else { 0.0 };
                matrix.add(row, 6 * body + k, value);
            }
        }
    }
}
