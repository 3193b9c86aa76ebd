//! The Newton matrix that all solvers share; see the description of [`super`].

use nalgebra::{Matrix3, Vector3};
use numerics::linear::Matrix;

use super::single_force::{ByRotation, direction, direction_by_frame, direction_stiffness};
use super::{Rows, System};
use crate::constraint::Form;
use crate::equation::{Local, LocalMatrix};
use crate::joint_friction::{Share, Slopes};
use crate::model::{Element, Level};
use crate::rotation::skew;

/// What the parts of the Newton matrix are multiplied with.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) struct Weights {
    /// The mass matrix.
    pub(crate) mass: f64,
    /// Derivatives by velocity.
    pub(crate) velocity: f64,
    /// Derivatives by position.
    pub(crate) position: f64,
    /// Derivatives by differential states.
    pub(crate) state: f64,
    /// Derivatives by rates of velocities and states.
    pub(crate) rate: f64,
}

impl Weights {
    /// Those of a step with `δx = γ δu`; at zero those of an instant.
    pub(crate) fn step(gamma: f64) -> Self {
        Self {
            mass: 1.0,
            velocity: gamma,
            position: gamma * gamma,
            state: gamma,
            rate: 1.0,
        }
    }

    /// Those of an equilibrium, where rates are zero: the stiffness, with a part of mass and damping
    /// added.
    pub(crate) fn equilibrium(stability: f64) -> Self {
        Self {
            mass: stability,
            velocity: stability,
            position: 1.0,
            state: 1.0,
            rate: 0.0,
        }
    }
}

impl System {
    /// Builds the Newton matrix of the module's description at the state evaluated last with
    /// derivatives; `w` is what multiplies the mass matrix in the residual (`u̇` times `γ`).
    pub(crate) fn assemble(
        &mut self,
        rows: Rows,
        weights: Weights,
        w: &[f64],
        multipliers: &[f64],
        matrix: &mut Matrix,
    ) {
        self.assemble_without_friction(rows, weights, w, multipliers, matrix);
        self.assemble_frictions(weights, multipliers, matrix);
        matrix.compress();
    }

    /// The matrix of an instant as if friction did not depend on the reactions.
    pub(crate) fn assemble_frictionless_instant(
        &mut self,
        zero: &[f64],
        multipliers: &[f64],
        matrix: &mut Matrix,
    ) {
        let weights = Weights::step(0.0);
        self.assemble_without_friction(Rows::Position, weights, zero, multipliers, matrix);
        matrix.compress();
    }

    fn assemble_without_friction(
        &mut self,
        rows: Rows,
        weights: Weights,
        w: &[f64],
        multipliers: &[f64],
        matrix: &mut Matrix,
    ) {
        matrix.start();
        self.assemble_bodies(weights, w, matrix);
        let n = self.rate_count();
        for (row, &place) in self.rows.iter().enumerate() {
            let evaluated = &self.evaluated[place];
            let constraint = &self.constraints[place];
            let moves = rows == Rows::Velocity && constraint.level == Level::Position
                || constraint.level == Level::Velocity;
            for (block, &body) in constraint.bodies.iter().enumerate() {
                for k in 0..6 {
                    let g = evaluated.jacobian[block][k];
                    let change = evaluated.rate_change[block][k];
                    let rate = if moves {
                        weights.velocity * change
                    } else {
                        0.0
                    };
                    matrix.add(n + row, 6 * body + k, g + rate);
                    matrix.add(6 * body + k, n + row, -g);
                }
            }
            if let Form::Pair { equation, i, j } = constraint.form {
                let sides = [i, j].map(|m| self.model.markers[m].body);
                let scale = -weights.position * multipliers[row];
                let first = equation.first_motion();
                self.add_local_matrix(&sides, &evaluated.stiffness, first, scale, matrix);
            }
        }
        self.assemble_forces(weights, matrix);
        self.assemble_elements(&weights, multipliers, matrix);
    }

    fn assemble_bodies(&self, weights: Weights, w: &[f64], matrix: &mut Matrix) {
        for (place, (body, frame)) in self.model.bodies.iter().zip(&self.bodies).enumerate() {
            let first = 6 * place;
            for k in 0..3 {
                matrix.add(first + k, first + k, weights.mass * body.mass);
            }
            let inertia = frame.inertia;
            // δ(I w) = δθ × I w − I (δθ × w), the turning of the inertia with the body.
            let turning = |w: &Vector3<f64>| -skew(&(inertia * w)) + inertia * skew(w);
            let omega = frame.omega;
            let w = Vector3::from_column_slice(&w[first + 3..first + 6]);
            // Q = −ω × I ω
            let by_omega: Matrix3<f64> = skew(&(inertia * omega)) - skew(&omega) * inertia;
            let by_theta = -skew(&omega) * turning(&omega);
            let block = weights.mass * inertia + weights.velocity * (turning(&w) - by_omega)
                - weights.position * by_theta;
            for r in 0..3 {
                for c in 0..3 {
                    matrix.add(first + 3 + r, first + 3 + c, block[(r, c)]);
                }
            }
        }
    }

    fn assemble_forces(&mut self, weights: Weights, matrix: &mut Matrix) {
        let (mut registers, mut adjoints) = self.take_scratch();
        for place in 0..self.model.forces.len() {
            if !self.model.is_active(Element::Force(place)) {
                continue;
            }
            let frames = self.force_frames(&self.model.forces[place]);
            let force = &self.model.forces[place];
            let function = &force.function;
            let value = function.evaluate(&mut registers, |input| self.inputs.read(input));
            let direction = direction(force.kind, &frames);
            let turning = direction_stiffness(force.kind, &frames);
            let sides = frames.sides();
            let scale = -weights.position * value;
            self.add_local_matrix(&sides, &turning, 0, scale, matrix);
            if let (Some(change), Some(carrier)) =
                (direction_by_frame(force.kind, &frames), frames.frame.body)
            {
                self.add_by_rotation(&sides, carrier, &change, scale, matrix);
            }
            function.gradient(&registers, &mut adjoints, |input, slope| {
                self.columns(input, slope, &weights, |column, change| {
                    for (side, on) in sides.iter().enumerate() {
                        let Some(on) = *on else { continue };
                        for r in 0..6 {
                            let entry = -direction[6 * side + r] * change;
                            matrix.add(6 * on + r, column, entry);
                        }
                    }
                });
            });
        }
        self.return_scratch(registers, adjoints);
    }

    fn assemble_frictions(&self, weights: Weights, multipliers: &[f64], matrix: &mut Matrix) {
        let n = self.rate_count();
        for place in 0..self.model.frictions.len() {
            let first = self.model.frictions[place].load.first_motion();
            let change = self.friction_change(place, weights, multipliers, |sides, row, change| {
                for (side, body) in sides.iter().enumerate() {
                    let Some(body) = *body else { continue };
                    for r in first..6 {
                        matrix.add(6 * body + r, n + row, -change[6 * side + r]);
                    }
                }
            });
            if let Some((sides, moving)) = change {
                self.add_local_matrix(&sides, &moving, first, -1.0, matrix);
            }
        }
    }

    /// How the generalised forces of a friction on its two bodies change with their local motions,
    /// weighted as the unknowns are, and (`by_multiplier`, with the row of each) with the
    /// multipliers that it follows. `None` where the friction does not act.
    pub(super) fn friction_change(
        &self,
        place: usize,
        weights: Weights,
        multipliers: &[f64],
        mut by_multiplier: impl FnMut(&[Option<usize>; 2], usize, &Local),
    ) -> Option<([Option<usize>; 2], LocalMatrix)> {
        if !self.friction_acts(place) {
            return None;
        }
        let mut slopes = Slopes::zero();
        let (_, i, j) = self.friction_with_slopes(place, multipliers, &mut slopes);
        let sides = [i.body, j.body];
        let turning = slopes.by_reaction.fixed_columns::<3>(3)
            * self.moment_change(place, &i, &j, multipliers);
        for contribution in &self.reactions[place] {
            let Some(row) = self.constraints[contribution.constraint].row else {
                continue;
            };
            let change: Local = match contribution.share {
                Share::Force(axis) => slopes.by_reaction.column(axis).into_owned(),
                Share::Moment => {
                    let axis = self.moment_axis(contribution.constraint, &j);
                    slopes.by_reaction.fixed_columns::<3>(3) * axis
                }
            };
            by_multiplier(&sides, row, &change);
        }
        let moving = weights.velocity * slopes.by_velocity
            + weights.position * (slopes.by_position + turning);
        Some((sides, moving))
    }

    /// Adds the change of a generalised force with the rotation of the body `carrier`.
    fn add_by_rotation(
        &self,
        sides: &[Option<usize>; 2],
        carrier: usize,
        change: &ByRotation,
        scale: f64,
        matrix: &mut Matrix,
    ) {
        let turns = |body: usize| self.model.bodies[body].rotates;
        for (side, body) in sides.iter().enumerate() {
            let Some(body) = *body else { continue };
            for r in 0..6 {
                for c in 0..3 {
                    let free = turns(carrier) && (r < 3 || turns(body));
                    let value = if free {
                        scale * change[(6 * side + r, c)]
                    } else {
                        0.0
                    };
                    matrix.add(6 * body + r, 6 * carrier + 3 + c, value);
                }
            }
        }
    }

    /// Adds a matrix over the local motions of two bodies; of each body's six from `first` on, the
    /// others being none of the element's.
    fn add_local_matrix(
        &self,
        sides: &[Option<usize>; 2],
        local: &LocalMatrix,
        first: usize,
        scale: f64,
        matrix: &mut Matrix,
    ) {
        let turns = |body: usize| self.model.bodies[body].rotates;
        for (row_side, row_body) in sides.iter().enumerate() {
            let Some(row_body) = *row_body else { continue };
            for (column_side, column_body) in sides.iter().enumerate() {
                let Some(column_body) = *column_body else {
                    continue;
                };
                for r in first..6 {
                    for c in first..6 {
                        let free = (r < 3 || turns(row_body)) && (c < 3 || turns(column_body));
                        let entry = local[(6 * row_side + r, 6 * column_side + c)];
                        let value = if free { scale * entry } else { 0.0 };
                        matrix.add(6 * row_body + r, 6 * column_body + c, value);
                    }
                }
            }
        }
    }
}
