//! What loads answer frictions: the matrix of gains as an operator, one solution of the reduced system
//! for each product.

use numerics::linear::{FrontalLu, Matrix};
use serde::{Deserialize, Serialize};

use crate::instant::Failure;
use crate::joint_friction::{Memory, Share};
use crate::model::Element;
use crate::system::System;

/// A friction as the matrix of gains has it.
#[derive(Clone, Debug, Default, Serialize, Deserialize)]
struct Column {
    /// Places of the motions that it acts on, and the force there that a unit load brings about.
    forces: Vec<(usize, f64)>,
    /// Places of the unknowns that its load depends on, and how.
    loads: Vec<(usize, f64)>,
    /// The largest part of its coefficient against that in the gains; zero where it does not act.
    unused: f64,
}

/// The gains `A` of the instant that was taken last.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(super) struct Answers {
    matrix: Matrix,
    factors: FrontalLu,
    zero: Vec<f64>,
    right: Vec<f64>,
    columns: Vec<Column>,
}

impl Answers {
    pub(super) fn new(system: &System) -> Self {
        let size = system.unknown_count();
        let column = Column {
            forces: Vec::with_capacity(12),
            loads: Vec::with_capacity(6),
            unused: 0.0,
        };
        Self {
            matrix: Matrix::new(size),
            factors: FrontalLu::new(system.elimination_groups()),
            zero: vec![0.0; system.rate_count()],
            right: vec![0.0; size],
            columns: vec![column; system.model.frictions.len()],
        }
    }

    /// Number of frictions.
    pub(super) fn count(&self) -> usize {
        self.columns.len()
    }

    /// The largest part of the coefficient of a friction against that in the gains.
    pub(super) fn unused(&self, place: usize) -> f64 {
        self.columns[place].unused
    }

    /// Takes the instant evaluated last; tells whether a friction that a reaction loads has no
    /// coefficient yet, so that the way it would act is unknown.
    ///
    /// A joint that went from sliding to stuck in the step that `before` preceded, or back, passed the
    /// speed at which its coefficient is the static one: it counts with that, in the direction it has
    /// now.
    pub(super) fn take(
        &mut self,
        system: &mut System,
        multipliers: &[f64],
        before: Option<&[Memory]>,
    ) -> Result<bool, Failure> {
        let n = system.rate_count();
        system.assemble_frictionless_instant(&self.zero, multipliers, &mut self.matrix);
        self.factors
            .factor(&self.matrix)
            .map_err(Failure::Singular)?;
        let mut open = false;
        for (place, column) in self.columns.iter_mut().enumerate() {
            column.forces.clear();
            column.loads.clear();
            column.unused = 0.0;
            if !system.model.is_active(Element::Friction(place)) {
                continue;
            }
            let element = system.friction(place, multipliers);
            let [i, j] = system.friction_frames(place);
            let law = &system.model.frictions[place].law;
            let unused = law.largest_coefficient() / element.steady_coefficient;
            let crossed = before.is_some_and(|before| {
                let now = &system.history.frictions[place];
                before[place].tally.sticking != now.tally.sticking
            });
            let scale = if crossed && unused.is_finite() {
                unused
            } else {
                1.0
            };
            for (side, body) in [i.body, j.body].into_iter().enumerate() {
                if let Some(body) = body {
                    let by_load = (0..6).map(|r| scale * element.by_load[6 * side + r]);
                    let places = 6 * body..;
                    column.forces.extend(places.zip(by_load));
                }
            }
            if element.steady_coefficient > 0.0 {
                column.unused = unused / scale;
            } else if element.load_by_reaction.iter().any(|slope| *slope != 0.0) {
                open = true;
            }
            for contribution in system.contributions(place) {
                let by_reaction = element.load_by_reaction;
                let slope = match contribution.share {
                    Share::Force(axis) => by_reaction[axis],
                    Share::Moment => {
                        let axis = system.moment_axis(contribution.constraint, j);
                        by_reaction[3] * axis.x + by_reaction[4] * axis.y + by_reaction[5] * axis.z
                    }
                };
                let loads = &mut column.loads;
                system.multiplier_parts(contribution.constraint, |unknown, share| {
                    loads.push((n + unknown, share * slope));
                });
            }
        }
        Ok(open)
    }

    /// `answer = A x`: the change of every load where friction `k` has `x_k` more of it.
    pub(super) fn multiply(&mut self, x: impl Iterator<Item = (usize, f64)>, answer: &mut [f64]) {
        self.right.fill(0.0);
        for (place, load) in x {
            for (motion, force) in &self.columns[place].forces {
                self.right[*motion] += load * force;
            }
        }
        self.factors.solve(&mut self.right);
        for (answer, column) in answer.iter_mut().zip(&self.columns) {
            let changes = column.loads.iter();
            *answer = changes.map(|(row, slope)| slope * self.right[*row]).sum();
        }
    }
}
