//! The equations between two markers, evaluated and differentiated together: those of a joint share
//! the frames of its markers, and their stiffnesses are one.

use numerics::linear::Matrix;

use super::evaluation::nearest_turn;
use super::{Rows, System, Weights};
use crate::constraint::{Constraint, Form, Owner};
use crate::equation::{Axis, Equation, Local, Pair, Row, Stiffness};
use crate::expression::Input;
use crate::model::Level;
use crate::scalar::Jet;

/// Constraint equations that follow one another in the list and are between the same two markers.
#[derive(Clone, Debug)]
pub(super) struct PairGroup {
    markers: [usize; 2],
    constraints: std::ops::Range<usize>,
}

/// The groups of a list of constraints.
pub(super) fn groups(constraints: &[Constraint]) -> Vec<PairGroup> {
    let mut groups: Vec<PairGroup> = Vec::new();
    for (place, constraint) in constraints.iter().enumerate() {
        let Form::Pair { i, j, .. } = constraint.form else {
            continue;
        };
        match groups.last_mut() {
            Some(last) if last.markers == [i, j] => last.constraints.end = place + 1,
            _ => groups.push(PairGroup {
                markers: [i, j],
                constraints: place..place + 1,
            }),
        }
    }
    groups
}

impl System {
    /// Brings the equations of a group up to date with the bodies.
    pub(super) fn evaluate_pairs(&mut self, group: usize) {
        let PairGroup {
            markers,
            constraints,
        } = self.pairs[group].clone();
        let [i, j] = markers.map(|marker| self.marker(marker));
        let pair = Pair::new(&i, &j);
        let sides = [i.body, j.body];
        let turns = sides.map(|body| body.is_none_or(|body| self.model.bodies[body].rotates));
        for place in constraints {
            let Form::Pair { equation, .. } = self.constraints[place].form else {
                continue;
            };
            let row = equation.evaluate(&pair, &self.model.curves);
            self.take_pair(place, equation, &row);
            let evaluated = &mut self.evaluated[place];
            for (side, turns) in turns.into_iter().enumerate() {
                if !turns {
                    // A point mass does not turn: its rotations take no part.
                    let mut rotations = evaluated.local.fixed_rows_mut::<3>(6 * side + 3);
                    rotations.fill(0.0);
                }
            }
            let blocks = evaluated.local.as_slice().as_chunks::<6>().0.iter();
            let present = blocks.zip(&sides).filter(|(_, body)| body.is_some());
            for (into, (block, _)) in evaluated.jacobian.iter_mut().zip(present) {
                *into = *block;
            }
        }
    }

    /// Error and prescribed rates of an equation, with the function of the motion that it is of.
    fn take_pair(&mut self, place: usize, equation: Equation, row: &Row) {
        let constraint = &self.constraints[place];
        let (mut value, mut rate, mut acceleration) = (row.value, 0.0, 0.0);
        if let Owner::Motion(motion) = constraint.owner {
            let drive = self.model.motions[motion]
                .function
                .run(&mut self.jets, |input| {
                    debug_assert_eq!(input, Input::Time, "motions depend on time only");
                    Jet {
                        value: self.inputs.time,
                        rate: 1.0,
                        acceleration: 0.0,
                    }
                });
            match constraint.level {
                Level::Position => {
                    value -= drive.value;
                    if equation == Equation::About(Axis::Z) {
                        value = nearest_turn(value, 0.0);
                    }
                    rate = drive.rate;
                    acceleration = drive.acceleration;
                }
                Level::Velocity => {
                    value = 0.0;
                    rate = drive.value;
                    acceleration = drive.rate;
                }
                Level::Acceleration => {
                    value = 0.0;
                    acceleration = drive.value;
                }
            }
        }
        let evaluated = &mut self.evaluated[place];
        evaluated.error = value;
        evaluated.rate = rate;
        evaluated.unbiased_acceleration = acceleration;
        evaluated.local = row.jacobian;
    }

    /// Value that a constraint equation prescribes for `G u̇` at the instant evaluated last.
    pub(crate) fn prescribed_acceleration(&self, place: usize) -> f64 {
        let unbiased = self.evaluated[place].unbiased_acceleration;
        match self.constraints[place].form {
            Form::Pair { equation, i, j } => {
                let (i, j) = (self.marker(i), self.marker(j));
                unbiased - equation.bias(&Pair::new(&i, &j), &self.model.curves)
            }
            Form::Function => unbiased,
        }
    }

    /// Adds the rows and columns of the equations between markers, and their stiffness.
    pub(super) fn assemble_pairs(
        &self,
        rows: Rows,
        weights: Weights,
        multipliers: &[f64],
        matrix: &mut Matrix,
    ) {
        for PairGroup {
            markers,
            constraints,
        } in &self.pairs
        {
            let [i, j] = markers.map(|marker| self.marker(marker));
            let pair = Pair::new(&i, &j);
            let mut stiffness = Stiffness::none();
            let mut reach = None;
            for place in constraints.clone() {
                let constraint = &self.constraints[place];
                let (Form::Pair { equation, .. }, Some(row)) = (constraint.form, constraint.row)
                else {
                    continue;
                };
                self.assemble_pair(rows, weights, place, equation, row, &pair, matrix);
                let multiplier = -weights.position * multipliers[row];
                stiffness.add(equation, multiplier, &pair, &self.model.curves);
                reach = reach.max(Some(equation.reach()));
            }
            if let Some(reach) = reach {
                let local = stiffness.matrix(&pair);
                self.add_local_matrix(&[i.body, j.body], &local, reach, 1.0, matrix);
            }
        }
    }

    /// Adds row and column of an equation.
    fn assemble_pair(
        &self,
        rows: Rows,
        weights: Weights,
        place: usize,
        equation: Equation,
        row: usize,
        pair: &Pair<'_>,
        matrix: &mut Matrix,
    ) {
        let local = &self.evaluated[place].local;
        let mut moved = *local;
        let velocities = self.velocities_in(rows, place);
        if velocities > 0.0 {
            let stiffness = equation.stiffness(pair, &self.model.curves);
            moved += velocities * weights.velocity * stiffness.rate_change(pair);
        }
        let row = self.rate_count() + row;
        for (side, body) in [pair.i.body, pair.j.body].into_iter().enumerate() {
            let Some(body) = body else { continue };
            for k in (equation.first_motion()..6).step_by(3) {
                let part = |local: &Local| -> [f64; 3] {
                    std::array::from_fn(|c| local[6 * side + k + c])
                };
                matrix.add_block(row, 6 * body + k, &[part(&moved)]);
                let column = part(local).map(|g| [-g]);
                matrix.add_block(6 * body + k, row, &column);
            }
        }
    }

    /// How often the velocities stand in the equation whose derivatives make the row of a constraint in
    /// the Newton matrix, so that the row changes with the positions.
    pub(super) fn velocities_in(&self, rows: Rows, place: usize) -> f64 {
        match (self.constraints[place].level, rows) {
            (Level::Position, Rows::Position) | (Level::Acceleration, _) => 0.0,
            (Level::Velocity, Rows::Position) | (_, Rows::Velocity) => 1.0,
            (_, Rows::Acceleration) => 2.0,
        }
    }
}
