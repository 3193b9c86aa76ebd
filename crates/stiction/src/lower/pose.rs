//! Where markers stand as the dataset places the parts: what coordinates of joints start from.

use mechanics::model::{Marker, Model};
use nalgebra::{Matrix3, Vector3};

/// Where a marker stands as the dataset places the parts, in ground.
pub(super) struct Pose {
    pub(super) origin: Vector3<f64>,
    pub(super) axes: Matrix3<f64>,
}

impl Pose {
    pub(super) fn of(model: &Model, marker: usize) -> Self {
        let Marker {
            body, offset, axes, ..
        } = model.markers[marker];
        match body {
            None => Self {
                origin: offset,
                axes,
            },
            Some(body) => {
                let body = &model.bodies[body];
                let turn = body.orientation.matrix();
                Self {
                    origin: body.origin + turn * (body.centre + offset),
                    axes: turn * axes,
                }
            }
        }
    }

    /// The angle from x of `j` to its own x about z of `j`.
    pub(super) fn angle_about_z(&self, j: &Self) -> f64 {
        let x = self.axes.column(0);
        x.dot(&j.axes.column(1)).atan2(x.dot(&j.axes.column(0)))
    }

    /// The displacement of its origin from that of `j` along z of `j`.
    pub(super) fn distance_along_z(&self, j: &Self) -> f64 {
        (self.origin - j.origin).dot(&j.axes.column(2))
    }
}
