//! The markers that the equations read, each brought up to date once an instant.

use super::System;
use crate::constraint::{Constraint, Form};
use crate::model::Model;
use crate::state::{BodyFrame, MarkerFrame};

/// Frames of markers on the bodies as they were evaluated last.
#[derive(Clone, Debug, Default)]
pub(super) struct Markers {
    /// The markers that equations read.
    read: Vec<usize>,
    /// By marker; those that no equation reads stay as they were.
    frames: Vec<MarkerFrame>,
}

impl Markers {
    /// The markers of constraints between markers, of forces, and of the measures that are `needed`.
    pub(super) fn new(
        model: &Model,
        constraints: &[Constraint],
        needed: &[bool],
        bodies: &[BodyFrame],
    ) -> Self {
        let pairs = constraints.iter().filter_map(|c| match c.form {
            Form::Pair { i, j, .. } => Some([i, j]),
            Form::Function => None,
        });
        let forces = model.forces.iter().flat_map(|f| [f.i, f.j, f.frame()]);
        let measures = model.measures.iter().zip(needed);
        let measures = measures.filter(|(_, needed)| **needed);
        let mut read: Vec<usize> = pairs
            .flatten()
            .chain(forces)
            .chain(measures.flat_map(|(measure, _)| measure.markers()))
            .collect();
        read.sort_unstable();
        read.dedup();
        let markers = model.markers.iter();
        let frames = markers.map(|m| MarkerFrame::new(m, bodies)).collect();
        Self { read, frames }
    }

    fn update(&mut self, model: &Model, bodies: &[BodyFrame]) {
        for &marker in &self.read {
            self.frames[marker].update(&model.markers[marker], bodies);
        }
    }

    /// Frame of a marker that the equations read.
    pub(super) fn get(&self, marker: usize) -> &MarkerFrame {
        debug_assert!(
            self.read.binary_search(&marker).is_ok(),
            "only markers that the equations read are kept up to date"
        );
        &self.frames[marker]
    }
}

impl System {
    /// Brings the markers that the equations read up to date with the bodies.
    pub(crate) fn update_markers(&mut self) {
        self.markers.update(&self.model, &self.bodies);
    }

    /// Frame of a marker that the equations read.
    pub(crate) fn frame(&self, marker: usize) -> &MarkerFrame {
        self.markers.get(marker)
    }
}
