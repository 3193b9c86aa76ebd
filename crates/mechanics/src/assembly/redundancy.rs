//! Which constraint equations depend on others, and whose reactions are then not unique.

use numerics::linear::Singular;
use numerics::rank::independent_rows;

use super::least_change::Least;
use super::report::AssemblyError;
use super::rows::{Block, bodies_of, expand};
use crate::constraint::Owner;
use crate::model::Reactions;
use crate::system::System;

/// What is left of a row, relative to its length, for it to count as independent. Datasets carry
/// six to ten digits, so equations that are redundant by design are dependent to that accuracy.
const RANK_TOLERANCE: f64 = 1e-5;

impl System {
    /// Which of the equations in force to keep, and in what order they were tried: those of joints
    /// that lock most come first, so that the equation dropped is that of the element that is most
    /// likely meant as the extra one.
    pub(super) fn independent(&mut self, length: f64) -> (Vec<bool>, Vec<usize>) {
        let mut locks = vec![0; self.model.joints.len()];
        for constraint in &self.constraints {
            if let Owner::Joint(joint) = constraint.owner {
                locks[joint] += 1;
            }
        }
        let preference = |place: usize| match self.constraints[place].owner {
            Owner::Joint(joint) => 6 - locks[joint].min(6),
            Owner::Motion(_) => 7,
            Owner::General(_) => 8,
        };
        let rows = self.assembly_rows(&[], length);
        let mut active = vec![false; self.constraints.len()];
        for mut places in self.loops_of_constraints() {
            places.sort_by_key(|&place| (preference(place), place));
            let row = |&place: &usize| &rows[self.constraints[place].row.unwrap_or_default()];
            let bodies = bodies_of(places.iter().map(row));
            let full = places.iter().map(row);
            let full = full.map(|row| expand(&row.among(&bodies), bodies.len()));
            let full: Vec<Vec<f64>> = full.collect();
            let kept = independent_rows(&full, RANK_TOLERANCE);
            for (&place, kept) in places.iter().zip(kept) {
                active[place] = kept;
            }
        }
        let mut order = self.rows.clone();
        order.sort_by_key(|&place| (preference(place), place));
        (active, order)
    }

    /// The constraints in force by loops.
    fn loops_of_constraints(&self) -> Vec<Vec<usize>> {
        let place = |row: usize| self.rows[row];
        let loops = self.loops().into_iter();
        loops
            .map(|rows| rows.into_iter().map(place).collect())
            .collect()
    }

    /// The constraints of loops where some were dropped, ascending.
    pub(crate) fn constraints_of_dependent_loops(&mut self) -> Vec<usize> {
        let in_force: Vec<bool> = self.constraints.iter().map(|c| c.row.is_some()).collect();
        self.set_active(&vec![true; in_force.len()]);
        let loops = self.loops_of_constraints();
        self.set_active(&in_force);
        let dependent = |places: &Vec<usize>| places.iter().any(|&place| !in_force[place]);
        let mut places: Vec<usize> = loops.into_iter().filter(dependent).flatten().collect();
        places.sort_unstable();
        places
    }

    /// Frictions of joints whose multipliers take part in a dependency.
    pub(super) fn not_unique(
        &mut self,
        active: &[bool],
        length: f64,
    ) -> Result<Vec<usize>, AssemblyError> {
        let unique = self.model.reactions != Reactions::OfKept;
        if unique || self.model.frictions.is_empty() {
            return Ok(Vec::new());
        }
        let all: Vec<bool> = vec![true; active.len()];
        self.set_active(&all);
        let rows = self.assembly_rows(&[], length);
        let row_of: Vec<Option<usize>> = self.constraints.iter().map(|c| c.row).collect();
        let loops = self.loops_of_constraints();
        self.set_active(active);
        let mut touched = vec![false; self.model.joints.len()];
        let mut touch = |place: usize| {
            if let Owner::Joint(joint) = self.constraints[place].owner {
                touched[joint] = true;
            }
        };
        for places in loops {
            let (kept, dropped): (Vec<usize>, _) =
                places.into_iter().partition(|&place| active[place]);
            if dropped.is_empty() {
                continue;
            }
            let row = |&place: &usize| &rows[row_of[place].unwrap_or_default()];
            let bodies = bodies_of(kept.iter().chain(&dropped).map(row));
            let blocks = |places: &[usize]| -> Vec<Vec<Block>> {
                places
                    .iter()
                    .map(|place| row(place).among(&bodies))
                    .collect()
            };
            // Every dropped row as a combination of kept ones: rest + Gᵀ c = row, G rest = 0.
            let combinations = Least::new(bodies.len(), &vec![None; kept.len()])
                .combinations(&blocks(&kept), &blocks(&dropped))
                .map_err(|singular| {
                    let body = bodies.get(singular.column / 6).or(bodies.first());
                    let column = 6 * body.copied().unwrap_or_default();
                    self.out_of_scale(Singular { column, ..singular })
                })?;
            for (&place, coefficients) in dropped.iter().zip(combinations) {
                touch(place);
                for (&place, c) in kept.iter().zip(coefficients) {
                    if c.abs() > 1e-6 {
                        touch(place);
                    }
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
