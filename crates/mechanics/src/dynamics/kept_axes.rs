//! The axes that the equations of joints had when the Newton matrix was made.
//!
//! Equations of a joint are along axes of its marker J, which turn. A matrix that is kept has them as they
//! were: what the equations lack now is given to it in those axes, and the multipliers that it answers
//! with are brought into those of now. In a loop whose joints have axes on different bodies errors of
//! positions that are common to the equations cancel only so, and where rods come into line what is left
//! of them is magnified.

use nalgebra::{Matrix3, Vector3};
use serde::{Deserialize, Serialize};

use crate::system::System;

/// The axes, joint by joint.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct KeptAxes {
    joints: Vec<JointAxes>,
    /// Whether the axes have turned since.
    turned: bool,
}

/// Rows along the axes of a marker.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct JointAxes {
    marker: usize,
    rows: [Option<usize>; 3],
    /// The axes as they were.
    axes: Matrix3<f64>,
    /// Axes of now in those.
    turn: Matrix3<f64>,
}

impl KeptAxes {
    /// Of the joints of a system, before there is a matrix.
    pub(super) fn of(system: &System) -> Self {
        let joints = system.axis_rows().map(|(marker, rows)| JointAxes {
            marker,
            rows,
            axes: Matrix3::identity(),
            turn: Matrix3::identity(),
        });
        Self {
            joints: joints.collect(),
            turned: false,
        }
    }

    /// Remembers the axes as they were evaluated last, with which a matrix is made.
    pub(super) fn keep(&mut self, system: &System) {
        for joint in &mut self.joints {
            joint.axes = system.frame(joint.marker).axes;
        }
        self.turned = false;
    }

    /// Takes the axes of now from what was evaluated last.
    pub(super) fn follow(&mut self, system: &System) {
        for joint in &mut self.joints {
            joint.turn = joint.axes.tr_mul(&system.frame(joint.marker).axes);
        }
        self.turned = true;
    }

    /// Brings what the equations lack, row by row, into the axes of the matrix.
    pub(super) fn bring_back(&self, lacks: &mut [f64]) {
        if self.turned {
            for joint in &self.joints {
                joint.change(lacks, |lacks| joint.turn * lacks);
            }
        }
    }

    /// Brings multipliers from the axes of the matrix into those of now.
    pub(super) fn bring_forth(&self, multipliers: &mut [f64]) {
        if self.turned {
            for joint in &self.joints {
                joint.change(multipliers, |multipliers| joint.turn.tr_mul(&multipliers));
            }
        }
    }
}

impl JointAxes {
    #[inline]
    fn change(&self, values: &mut [f64], turned: impl Fn(Vector3<f64>) -> Vector3<f64>) {
        let old = self.rows.map(|row| row.map_or(0.0, |row| values[row]));
        let new = turned(Vector3::from(old));
        for (row, value) in self.rows.iter().zip(&new) {
            if let Some(row) = *row {
                values[row] = *value;
            }
        }
    }
}
