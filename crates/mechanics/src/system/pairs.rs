//! The equations between two markers, evaluated and differentiated together: those of a joint share
//! the frames of its markers, and their stiffnesses are one.

#[cfg(test)]
use nalgebra::Vector3;
use numerics::linear::Matrix;

use super::evaluation::nearest_turn;
use super::{Rows, System, Weights};
use crate::constraint::{Constraint, Evaluated, Form, Owner};
use crate::equation::{Axis, Equation, Local, Pair, Stiffness};
use crate::expression::Input;
use crate::model::{Level, Model};
use crate::scalar::Jet;

/// Constraint equations that follow one another in the list and are between the same two markers.
#[derive(Clone, Debug)]
pub(super) struct PairGroup {
    markers: [usize; 2],
    constraints: std::ops::Range<usize>,
    /// Whether the bodies of the two markers turn: a point mass does not.
    turns: [bool; 2],
}

/// The groups of a model's list of constraints.
pub(super) fn groups(model: &Model, constraints: &[Constraint]) -> Vec<PairGroup> {
    let turns = |marker: usize| {
        let body = model.markers[marker].body;
        body.is_none_or(|body| model.bodies[body].rotates)
    };
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
                turns: [i, j].map(turns),
            }),
        }
    }
    groups
}

/// Axis of J and row of an equation in force that is about the displacement along it.
fn along_row(constraint: &Constraint) -> Option<(usize, usize)> {
    match (constraint.form, constraint.row) {
        (
            Form::Pair {
                equation: Equation::Along(k),
                ..
            },
            Some(row),
        ) => Some((k, row)),
        _ => None,
    }
}

impl System {
    /// Brings the equations of a group up to date with the bodies.
    pub(super) fn evaluate_pairs(&mut self, group: usize) {
        let PairGroup {
            markers: [i, j],
            constraints,
            turns,
        } = self.pairs[group].clone();
        let held = self.held(&constraints);
        let pair = Pair::with_held(self.markers.get(i), self.markers.get(j), held);
        for place in constraints {
            let constraint = &self.constraints[place];
            let Form::Pair { equation, .. } = constraint.form else {
                continue;
            };
            let evaluated = &mut self.evaluated[place];
            let value = equation.evaluate(&pair, &self.model.curves, &mut evaluated.local);
            for (side, turns) in turns.into_iter().enumerate() {
                if !turns {
                    // The rotations of a point mass take no part.
                    let mut rotations = evaluated.local.fixed_rows_mut::<3>(6 * side + 3);
                    rotations.fill(0.0);
                }
            }
            evaluated.error = value;
            evaluated.rate = 0.0;
            evaluated.unbiased_acceleration = 0.0;
            if let Owner::Motion(motion) = constraint.owner {
                let function = &self.model.motions[motion].function;
                let drive = function.run(&mut self.jets, |input| {
                    debug_assert_eq!(input, Input::Time, "motions depend on time only");
                    Jet {
                        value: self.inputs.time,
                        rate: 1.0,
                        acceleration: 0.0,
                    }
                });
                evaluated.drive(&drive, constraint.level, equation);
            }
        }
    }

    /// The axes of J along which equations in force of a group hold the displacement of I at zero.
    fn held(&self, constraints: &std::ops::Range<usize>) -> [bool; 3] {
        let mut held = [false; 3];
        for constraint in &self.constraints[constraints.clone()] {
            if let (Owner::Joint(_), Some((k, _))) = (constraint.owner, along_row(constraint)) {
                held[k] = true;
            }
        }
        held
    }

    /// Moves markers J to where equations hold those of I, as bodies stand.
    #[cfg(test)]
    pub(crate) fn join_markers(&mut self) {
        for group in 0..self.pairs.len() {
            let PairGroup {
                markers: [i, j],
                constraints,
                ..
            } = self.pairs[group].clone();
            let (frame, held) = (self.frame(j), self.held(&constraints));
            let apart = frame.axes.tr_mul(&(self.frame(i).origin - frame.origin));
            let apart = Vector3::from_fn(|k, _| if held[k] { apart[k] } else { 0.0 });
            let marker = &mut self.model.markers[j];
            marker.offset += marker.axes * apart;
        }
    }

    /// Marker J, if it turns, of each joint that has several equations about displacements along its axes,
    /// and their rows by axis.
    pub(crate) fn axis_rows(&self) -> impl Iterator<Item = (usize, [Option<usize>; 3])> {
        let turning = |group: &&PairGroup| self.model.markers[group.markers[1]].body.is_some();
        let all = self.pairs.iter().filter(turning).map(|group| {
            let mut rows = [None; 3];
            for constraint in &self.constraints[group.constraints.clone()] {
                if let (Owner::Joint(_), Some((k, row))) = (constraint.owner, along_row(constraint))
                {
                    rows[k] = Some(row);
                }
            }
            (group.markers[1], rows)
        });
        all.filter(|(_, rows)| rows.iter().flatten().count() > 1)
    }

    /// Whether an equation prescribes accelerations, and nothing else.
    pub(crate) fn prescribes_accelerations(&self) -> bool {
        let mut motions = self.model.motions.iter();
        motions.any(|motion| motion.level == Level::Acceleration)
    }

    /// Writes, for every row, the value that its equation prescribes for `G u̇` at the instant evaluated
    /// last.
    pub(crate) fn prescribe_accelerations(&self, prescribed: &mut [f64]) {
        for (prescribed, &place) in prescribed.iter_mut().zip(&self.rows) {
            *prescribed = self.evaluated[place].unbiased_acceleration;
        }
        for PairGroup {
            constraints,
            markers: [i, j],
            ..
        } in &self.pairs
        {
            let held = self.held(constraints);
            let pair = Pair::with_held(self.frame(*i), self.frame(*j), held);
            for constraint in &self.constraints[constraints.clone()] {
                if let (Form::Pair { equation, .. }, Some(row)) = (constraint.form, constraint.row)
                {
                    prescribed[row] -= equation.bias(&pair, &self.model.curves);
                }
            }
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
            constraints,
            markers: [i, j],
            ..
        } in &self.pairs
        {
            let (i, j) = (self.frame(*i), self.frame(*j));
            let pair = Pair::with_held(i, j, self.held(constraints));
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

impl Evaluated {
    /// Takes the function of a motion off the value of its equation, or prescribes what it says.
    fn drive(&mut self, drive: &Jet, level: Level, equation: Equation) {
        match level {
            Level::Position => {
                self.error -= drive.value;
                if equation == Equation::About(Axis::Z) {
                    self.error = nearest_turn(self.error, 0.0);
                }
                self.rate = drive.rate;
                self.unbiased_acceleration = drive.acceleration;
            }
            Level::Velocity => {
                self.error = 0.0;
                self.rate = drive.value;
                self.unbiased_acceleration = drive.rate;
            }
            Level::Acceleration => {
                self.error = 0.0;
                self.unbiased_acceleration = drive.value;
            }
        }
    }
}
