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
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
pub(super) struct KeptAxes(Vec<JointAxes>);

/// Rows along the axes of a marker, and how these were.
#[derive(Clone, Debug, Serialize, Deserialize)]
struct JointAxes {
    marker: usize,
    rows: [Option<usize>; 3],
    axes: Matrix3<f64>,
}

impl KeptAxes {
    /// Remembers the axes as they were evaluated last.
    pub(super) fn keep(&mut self, system: &System) {
        self.0.clear();
        let joints = system.axis_rows();
        self.0.extend(joints.map(|(marker, rows)| JointAxes {
            marker,
            rows,
            axes: system.frame(marker).axes,
        }));
    }

    /// Brings what the equations lack, row by row, into the axes of the matrix.
    pub(super) fn bring_back(&self, system: &System, lacks: &mut [f64]) {
        for joint in &self.0 {
            let turn = joint.axes.tr_mul(&system.frame(joint.marker).axes);
            joint.turn(&turn, lacks);
        }
    }

    /// Brings multipliers from the axes of the matrix into those evaluated last.
    pub(super) fn bring_forth(&self, system: &System, multipliers: &mut [f64]) {
        for joint in &self.0 {
            let turn = system.frame(joint.marker).axes.tr_mul(&joint.axes);
            joint.turn(&turn, multipliers);
        }
    }
}

impl JointAxes {
    fn turn(&self, turn: &Matrix3<f64>, values: &mut [f64]) {
        let old = self.rows.map(|row| row.map_or(0.0, |row| values[row]));
        let new = turn * Vector3::from(old);
        for (row, value) in self.rows.iter().zip(&new) {
            if let Some(row) = *row {
                values[row] = *value;
            }
        }
    }
}
