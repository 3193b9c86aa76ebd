//! Bodies without mass or inertia that can move while everything with mass stands still.
//!
//! Such a motion is a vector of velocities `v` with `G v = 0` whose components with mass are zero:
//! the columns of `G` that belong to the other components depend on one another.

use numerics::rank::independent_rows;

use super::report::Massless;
use super::rows::Row;
use crate::system::System;

/// What is left of a column, relative to its length, for it to count as independent; as for
/// redundant equations.
const RANK_TOLERANCE: f64 = 1e-5;

impl System {
    /// The bodies that equations of motion say nothing about, for these rows in force.
    pub(super) fn massless(&self, rows: &[Row]) -> Vec<Massless> {
        let bodies = self.model.bodies.iter().enumerate();
        let without = bodies.flat_map(|(place, body)| {
            let moves = (body.mass == 0.0).then_some(0..3);
            let still = body.inertia.iter().all(|element| *element == 0.0);
            let turns = (body.rotates && still).then_some(3..6);
            let components = moves.into_iter().chain(turns).flatten();
            components.map(move |component| (place, component))
        });
        let without: Vec<(usize, usize)> = without.collect();
        let columns: Vec<Vec<f64>> = without
            .iter()
            .map(|&(body, component)| rows.iter().map(|row| entry(row, body, component)).collect())
            .collect();
        let held = independent_rows(&columns, RANK_TOLERANCE);
        let mut found: Vec<Massless> = Vec::new();
        for (&(body, component), _) in without.iter().zip(held).filter(|(_, held)| !held) {
            let free = Massless {
                body: self.model.bodies[body].label.clone(),
                turns: component >= 3,
            };
            // The components of one body come one after another.
            if found.last().is_none_or(|last| last.body != free.body) {
                found.push(free);
            }
        }
        found
    }
}

/// The entry of a row in the column of a component of a body.
fn entry(row: &Row, body: usize, component: usize) -> f64 {
    let blocks = row.blocks.iter().filter(|(place, _)| *place == body);
    blocks.map(|(_, block)| block[component]).sum()
}
