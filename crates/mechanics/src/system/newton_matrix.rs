//! The Newton matrix that all solvers share; see the description of [`super`].

use nalgebra::{Matrix3, Vector3};
use numerics::linear::Matrix;

use super::single_force::{ByRotation, direction, direction_by_frame, direction_stiffness};
use super::{Rows, System};
use crate::constraint::Form;
use crate::equation::{Local, LocalMatrix, Reach};
use crate::joint_friction::{Share, Slopes, Wanted};
use crate::model::Element;
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
    /// Those of a step whose rates are `δu/γ` and whose positions move by `δx = γ_x δu`, with a part
    /// of the inertia.
    pub(crate) fn step(inertia: f64, gamma: f64, position_gamma: f64) -> Self {
        Self {
            mass: inertia,
            velocity: gamma,
            position: gamma * position_gamma,
            state: gamma,
            rate: 1.0,
        }
    }

    /// Those of an instant.
    pub(crate) fn instant() -> Self {
        Self::step(1.0, 0.0, 0.0)
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
        let weights = Weights::instant();
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
        self.assemble_pairs(rows, weights, multipliers, matrix);
        self.assemble_functions(matrix);
        self.assemble_forces(weights, matrix);
        self.assemble_elements(&weights, multipliers, matrix);
        self.assemble_sharing(matrix);
    }

    /// Rows and columns of general constraints. How their gradients change is left out.
    fn assemble_functions(&self, matrix: &mut Matrix) {
        let n = self.rate_count();
        for (constraint, evaluated) in self.constraints.iter().zip(&self.evaluated) {
            let (Form::Function, Some(row)) = (constraint.form, constraint.row) else {
                continue;
            };
            for (body, block) in evaluated.blocks(constraint) {
                matrix.add_block(n + row, 6 * body, &[*block]);
                matrix.add_block(6 * body, n + row, &block.map(|g| [-g]));
            }
        }
    }

    fn assemble_bodies(&self, weights: Weights, w: &[f64], matrix: &mut Matrix) {
        for (place, frame) in self.bodies.iter().enumerate() {
            let first = 6 * place;
            for k in 0..3 {
                matrix.add(first + k, first + k, weights.mass * frame.mass);
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
            matrix.add_block(first + 3, first + 3, &block.transpose().data.0);
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
            self.add_local_matrix(&sides, &turning, Reach::Place, scale, matrix);
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
            let reach = self.model.frictions[place].load.reach();
            let first = if reach == Reach::Turns { 3 } else { 0 };
            let mut slopes = Slopes::zero(weights.velocity, weights.position, reach);
            let sides =
                self.friction_change(place, multipliers, &mut slopes, |sides, unknown, change| {
                    for (side, body) in sides.iter().enumerate() {
                        let Some(body) = *body else { continue };
                        for r in (first..6).step_by(3) {
                            let column = std::array::from_fn(|k| [-change[6 * side + r + k]]);
                            matrix.add_block::<3, 1>(6 * body + r, n + unknown, &column);
                        }
                    }
                });
            if let Some(sides) = sides {
                self.add_local_matrix(&sides, &slopes.by_motion, reach, -1.0, matrix);
            }
        }
    }

    /// How the generalised forces of a friction on its two bodies change with their local motions
    /// (`by_motion` of `slopes`, which are zero), and (`by_multiplier`, with the place of each) with the
    /// multipliers that it follows. Returns the bodies; `None` where the
    /// friction does not act.
    pub(super) fn friction_change(
        &self,
        place: usize,
        multipliers: &[f64],
        slopes: &mut Slopes,
        mut by_multiplier: impl FnMut(&[Option<usize>; 2], usize, &Local),
    ) -> Option<[Option<usize>; 2]> {
        if !self.friction_acts(place) {
            return None;
        }
        let wanted = Wanted {
            slopes: Some(&mut *slopes),
            ..Wanted::default()
        };
        self.evaluate_friction(place, multipliers, wanted);
        let [i, j] = self.friction_frames(place);
        let sides = [i.body, j.body];
        for contribution in &self.reactions[place] {
            let constraint = contribution.constraint;
            let change: Local = match contribution.share {
                Share::Force(axis) => slopes.by_reaction.column(axis).into_owned(),
                Share::Moment => {
                    let axis = self.moment_axis(constraint, j);
                    slopes.by_reaction.fixed_columns::<3>(3) * axis
                }
            };
            self.multiplier_parts(constraint, |unknown, slope| {
                by_multiplier(&sides, unknown, &(slope * change));
            });
        }
        if let Some(by_turn) = self.moment_change(place, i, j, multipliers) {
            slopes.turn(&by_turn);
        }
        Some(sides)
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

    /// Adds the parts that `reach` connects of a matrix over the local motions of two bodies.
    pub(super) fn add_local_matrix(
        &self,
        sides: &[Option<usize>; 2],
        local: &LocalMatrix,
        reach: Reach,
        scale: f64,
        matrix: &mut Matrix,
    ) {
        // Body, first motion and scale of the four parts; a point mass does not turn.
        let parts: [_; 4] = std::array::from_fn(|part| {
            let first = 3 * (part % 2);
            sides[part / 2].map(|body| {
                let free = first == 0 || self.model.bodies[body].rotates;
                (6 * body + first, f64::from(u8::from(free)))
            })
        });
        for (r, row) in parts.iter().enumerate() {
            let Some((row, row_free)) = *row else {
                continue;
            };
            for (c, column) in parts.iter().enumerate() {
                let (true, Some((column, column_free))) = (reach.connects(r, c), *column) else {
                    continue;
                };
                let scale = scale * row_free * column_free;
                let block: [[f64; 3]; 3] = std::array::from_fn(|k| {
                    std::array::from_fn(|l| scale * local[(3 * r + k, 3 * c + l)])
                });
                matrix.add_block(row, column, &block);
            }
        }
    }
}
