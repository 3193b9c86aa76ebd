//! Which constraint equations depend on others, and whose reactions are then not unique.

use numerics::rank::independent_rows;

use super::least_change::Least;
use super::report::AssemblyError;
use super::rows::{Row, expand};
use crate::constraint::Owner;
use crate::system::System;

/// What is left of a row, relative to its length, for it to count as independent. Datasets carry
/// six to ten digits, so equations that are redundant by design are dependent to that accuracy.
const RANK_TOLERANCE: f64 = 1e-5;

impl System {
    /// Which of the equations in force to keep, and in what order they were tried: those of joints that lock most come first, so that the equation
    /// dropped is that of the element that is most likely meant as the extra one.
    pub(super) fn independent(&mut self, length: f64) -> (Vec<bool>, Vec<usize>) {
        let count = |owner: Owner| self.constraints.iter().filter(|c| c.owner == owner).count();
        let mut order: Vec<(usize, usize)> = self
            .constraints
            .iter()
            .enumerate()
            .filter(|(_, c)| c.row.is_some())
            .map(|(place, c)| {
                let rank = match c.owner {
                    Owner::Joint(_) => 6 - count(c.owner).min(6),
                    Owner::Motion(_) => 7,
                    Owner::General(_) => 8,
                };
                (rank, place)
            })
            .collect();
        order.sort_unstable();
        let rows = self.assembly_rows(&[], length);
        let n = self.velocity_count();
        let full: Vec<Vec<f64>> = order
            .iter()
            .filter_map(|&(_, place)| self.constraints[place].row)
            .map(|row| expand(&rows[row], n))
            .collect();
        let kept = independent_rows(&full, RANK_TOLERANCE);
        let mut active = vec![false; self.constraints.len()];
        for (&(_, place), kept) in order.iter().zip(kept) {
            active[place] = kept;
        }
        (active, order.into_iter().map(|(_, place)| place).collect())
    }

    /// Frictions of joints whose multipliers take part in a dependency.
    pub(super) fn not_unique(
        &mut self,
        active: &[bool],
        length: f64,
    ) -> Result<Vec<usize>, AssemblyError> {
        let n = self.velocity_count();
        let all: Vec<bool> = vec![true; active.len()];
        self.set_active(&all);
        let rows = self.assembly_rows(&[], length);
        // Equations of elements at rest have no row, and take no part.
        let row_of: Vec<Option<usize>> = self.constraints.iter().map(|c| c.row).collect();
        self.set_active(active);
        let places = |wanted: bool| -> Vec<(usize, usize)> {
            let rows = row_of.iter().enumerate();
            let rows = rows.filter_map(|(place, row)| row.map(|row| (place, row)));
            rows.filter(|(place, _)| active[*place] == wanted).collect()
        };
        let (dropped, kept) = (places(false), places(true));
        if dropped.is_empty() || self.model.frictions.is_empty() {
            return Ok(Vec::new());
        }
        let kept_rows: Vec<&Row> = kept.iter().map(|&(_, row)| &rows[row]).collect();
        let mut touched = vec![false; self.model.joints.len()];
        let mut touch = |place: usize| {
            if let Owner::Joint(joint) = self.constraints[place].owner {
                touched[joint] = true;
            }
        };
        let mut least = Least::new(self.model.bodies.len(), &self.bodies_of_rows());
        for &(place, row) in &dropped {
            touch(place);
            // The dropped row as a combination of kept ones: rest + Gᵀ c = row, G rest = 0.
            let coefficients = least
                .combination(&kept_rows, &expand(&rows[row], n))
                .map_err(|singular| self.out_of_scale(singular))?;
            for (&(place, _), c) in kept.iter().zip(coefficients) {
                if c.abs() > 1e-6 {
                    touch(place);
                }
            }
        }
        let frictions = self.model.frictions.iter().enumerate();
        Ok(frictions
            .filter(|(_, friction)| touched[friction.joint])
            .map(|(place, _)| place)
            .collect())
    }
}
