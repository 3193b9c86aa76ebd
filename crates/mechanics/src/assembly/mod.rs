//! Initial positions and velocities that meet the constraints, and redundant equations.
//!
//! Positions: Gauss-Newton steps, each the smallest weighted change of positions and rotations
//! that meets the linearised constraints. Components given as EXACT weigh so much that they stay.
//! Redundant equations do no harm there: a small number on the diagonal of the multipliers selects
//! the smallest ones (Tikhonov). Velocities: one such step. Then the equations that depend on
//! others are found (`numerics::rank`), and what they say must hold anyway.

mod least_change;
mod loops;
mod massless;
mod redundancy;
mod report;
mod rows;

use nalgebra::Vector3;
use numerics::linear::Singular;

pub use report::{Assembly, AssemblyError, Massless, Moved, Redundancy, Unmet, VelocityChange};

use crate::constraint::{Form, codirected_axes, name};
use crate::model::{Element, Level};
use crate::state::State;
use crate::system::System;
use least_change::{Least, REGULARISATION};
use rows::{Row, Start, along, unmet};

/// Equations that were dropped must hold to this accuracy (lengths relative to the model's).
const CONSISTENT: f64 = 1e-4;
/// Iterations before assembly is given up.
const ITERATIONS: usize = 60;
/// Largest rotation in one step, 30 degrees, as the default of the IC statement.
const LARGEST_TURN: f64 = std::f64::consts::FRAC_PI_6;
/// Weight of components that must stay, against one for the others.
const EXACT_WEIGHT: f64 = 1e10;
/// Corrections of the initial velocities, at most.
const VELOCITY_PASSES: usize = 6;
/// Weight of velocities that were given, against one for the others.
const GIVEN_WEIGHT: f64 = 1e4;
/// Diagonal of the multipliers there: beside such a weight that of positions would count for as much more.
/// (Small weights for the others, which would do the same, are no pivots: fronts then grow along chains.)
const VELOCITY_REGULARISATION: f64 = 1e-12;
/// Where steps no longer lessen the error, that number grows up to this.
const LARGEST_REGULARISATION: f64 = 1.0;

impl System {
    /// A length that is typical of the model: the farthest marker from its body's centre of mass,
    /// or from ground's origin where no body has one.
    #[must_use]
    pub fn length_scale(&self) -> f64 {
        let used = self.constraints.iter().filter_map(|c| match c.form {
            Form::Pair { i, j, .. } => Some([i, j]),
            Form::Function => None,
        });
        let used = used.chain(self.model.forces.iter().map(|force| [force.i, force.j]));
        let mut largest = [0.0_f64; 2];
        for marker in used.flatten().map(|m| &self.model.markers[m]) {
            let on = usize::from(marker.body.is_none());
            largest[on] = largest[on].max(marker.offset.norm());
        }
        let gyration = self
            .model
            .bodies
            .iter()
            .filter(|b| b.mass > 0.0)
            .map(|b| (b.inertia.trace() / (2.0 * b.mass)).sqrt());
        let gyration = gyration.fold(0.0_f64, f64::max);
        if largest[0].max(gyration) > 0.0 {
            largest[0].max(gyration)
        } else if largest[1] > 0.0 {
            largest[1]
        } else {
            1.0
        }
    }

    /// The state that the model gives, before assembly.
    #[must_use]
    pub fn given_state(&self, time: f64) -> State {
        let bodies = &self.model.bodies;
        let mut values = vec![0.0; 13 * bodies.len()];
        let (positions, velocities) = values.split_at_mut(7 * bodies.len());
        for (place, body) in bodies.iter().enumerate() {
            let centre = body.origin + body.orientation.matrix() * body.centre;
            positions[7 * place..7 * place + 3].copy_from_slice(centre.as_slice());
            body.orientation
                .normalized()
                .write(&mut positions[7 * place + 3..7 * place + 7]);
            velocities[6 * place..6 * place + 3].copy_from_slice(body.velocity.as_slice());
            velocities[6 * place + 3..6 * place + 6]
                .copy_from_slice(body.angular_velocity.as_slice());
        }
        let mut state = State::new(time, values);
        let states = self.first_states();
        state.extend(&states, self.bristle_count(), self.work_count());
        state
    }

    /// Brings `state` onto the constraints with as little change as needed, finds redundant
    /// equations and drops them, and starts the history of friction there.
    ///
    /// # Errors
    /// [`AssemblyError`] where the constraints contradict one another.
    pub fn assemble_initial(&mut self, state: &mut State) -> Result<Assembly, AssemblyError> {
        self.history.angles.fill(0.0);
        let starts = self.starts();
        let weights = [self.position_weights(), self.velocity_weights()];
        let assembly = self.assemble_all(state, &starts, &weights)?;
        self.start_history();
        Ok(assembly)
    }

    /// The same during a run, after elements were activated or deactivated: nothing that was given
    /// at the start counts, and the history goes on.
    pub(crate) fn assemble_again(&mut self, state: &mut State) -> Result<Assembly, AssemblyError> {
        let equal = vec![1.0; self.velocity_count()];
        self.assemble_all(state, &[], &[equal.clone(), equal])
    }

    fn assemble_all(
        &mut self,
        state: &mut State,
        starts: &[Start],
        [positions, velocities]: &[Vec<f64>; 2],
    ) -> Result<Assembly, AssemblyError> {
        let given = state.clone();
        let length = self.length_scale();
        let all = vec![true; self.constraints.len()];
        self.set_active(&all);
        let iterations = self.assemble_positions(state, starts, positions, length)?;
        let (active, order) = self.independent(length);
        // Velocities that contradict one another show only with the redundant equations.
        self.assemble_velocities(state, starts, velocities, length)?;
        self.set_active(&active);
        // What inaccurate redundant equations left over is now removed from the others.
        self.assemble_positions(state, starts, positions, length)?;
        self.check_directions()?;
        let not_unique = self.not_unique(&active, length)?;
        self.assemble_velocities(state, starts, velocities, length)?;
        self.share_reactions();
        let redundant = order
            .into_iter()
            .filter(|&place| !active[place])
            .map(|place| Redundancy {
                owner: self.owner_label(self.constraints[place].owner).clone(),
                equation: name(self.constraints[place].form),
            })
            .collect();
        Ok(Assembly {
            moved: self.moved(&given, state, length),
            velocity_changes: self.velocity_changes(&given, state, length),
            massless: self.massless(&self.assembly_rows(&[], length)),
            redundant,
            not_unique,
            iterations,
        })
    }

    /// Weights of the position components: large for those that must stay.
    fn position_weights(&self) -> Vec<f64> {
        let weights = self.model.bodies.iter().flat_map(|body| body.exact);
        weights
            .map(|exact| if exact { EXACT_WEIGHT } else { 1.0 })
            .collect()
    }

    fn velocity_weights(&self) -> Vec<f64> {
        let weights = self
            .model
            .bodies
            .iter()
            .flat_map(|body| body.given_velocity);
        weights
            .map(|given| if given { GIVEN_WEIGHT } else { 1.0 })
            .collect()
    }

    /// Rows at `state`, those that say nothing of positions emptied.
    fn position_rows(&mut self, state: &State, starts: &[Start], length: f64) -> Vec<Row> {
        self.evaluate(state, false);
        let mut rows = self.assembly_rows(starts, length);
        for row in rows.iter_mut().filter(|row| !row.in_position) {
            row.error = 0.0;
            row.blocks.iter_mut().for_each(|block| block.1 = [0.0; 6]);
        }
        rows
    }

    fn assemble_positions(
        &mut self,
        state: &mut State,
        starts: &[Start],
        weights: &[f64],
        length: f64,
    ) -> Result<usize, AssemblyError> {
        let n = self.velocity_count();
        let mut least = self.least_change(starts);
        let mut regularisation = REGULARISATION;
        let mut best = f64::INFINITY;
        let mut kept = state.clone();
        let given = unmet(&self.position_rows(state, starts, length), |row| row.error);
        for iteration in 0..ITERATIONS {
            let mut rows = self.position_rows(state, starts, length);
            if rows.iter().any(|row| !row.error.is_finite()) {
                return Err(AssemblyError::NotANumber {
                    element: self.find_not_a_number(),
                });
            }
            let error = rows.iter().fold(0.0_f64, |m, row| m.max(row.error.abs()));
            if error < 1e-14 {
                return Ok(iteration);
            }
            if error < 0.9 * best {
                best = error;
                kept.clone_from(state);
            } else {
                // Redundant equations that contradict one another leave an error that no step
                // removes; smaller multipliers keep the steps from running away with it.
                regularisation *= 100.0;
                if regularisation > LARGEST_REGULARISATION {
                    break;
                }
                state.clone_from(&kept);
                rows = self.position_rows(state, starts, length);
            }
            let right: Vec<f64> = rows.iter().map(|row| -row.error).collect();
            let change = least.solve(&rows, weights, &vec![0.0; n], &right, regularisation);
            let mut change = change.map_err(|singular| self.out_of_scale(singular))?;
            for body in change.chunks_exact_mut(6) {
                let turn = Vector3::from_column_slice(&body[3..6]).norm();
                let limit = (LARGEST_TURN / turn.max(1e-300)).min(1.0);
                for k in 0..6 {
                    body[k] *= if k < 3 { limit * length } else { limit };
                }
            }
            state.displace(&change);
        }
        state.clone_from(&kept);
        self.evaluate(state, false);
        if best < CONSISTENT {
            return Ok(ITERATIONS);
        }
        let unmet = unmet(&self.position_rows(&kept, starts, length), |row| row.error);
        Err(AssemblyError::Inconsistent { given, unmet })
    }

    /// Solver for the equations in force and the initial conditions.
    fn least_change(&self, starts: &[Start]) -> Least {
        let mut with = self.bodies_of_rows();
        with.resize(with.len() + starts.len(), None);
        Least::new(self.model.bodies.len(), &with)
    }

    fn assemble_velocities(
        &mut self,
        state: &mut State,
        starts: &[Start],
        weights: &[f64],
        length: f64,
    ) -> Result<(), AssemblyError> {
        self.evaluate(state, false);
        let n = self.velocity_count();
        let mut rows = self.assembly_rows(starts, length);
        for row in &mut rows {
            if !row.in_velocity {
                row.rate = 0.0;
                row.blocks.iter_mut().for_each(|block| block.1 = [0.0; 6]);
            }
        }
        let mut wanted = state.velocities().to_vec();
        wanted
            .iter_mut()
            .enumerate()
            .filter(|(k, _)| k % 6 < 3)
            .for_each(|(_, v)| *v /= length);
        let right: Vec<f64> = rows.iter().map(|row| row.rate).collect();
        let mut least = self.least_change(starts);
        let largest = |values: &[f64]| values.iter().fold(0.0_f64, |m, v| m.max(v.abs()));
        let size = largest(&wanted).max(largest(&right));
        let solve = |least: &mut Least, wanted: &[f64], right: &[f64]| {
            let solved = least.solve(&rows, weights, wanted, right, VELOCITY_REGULARISATION);
            solved.map_err(|singular| self.out_of_scale(singular))
        };
        let mut velocities = solve(&mut least, &wanted, &right)?;
        let mut missing = right;
        // Each further pass removes what the regularisation left of the one before.
        for _ in 0..VELOCITY_PASSES {
            for (missing, row) in missing.iter_mut().zip(&rows) {
                *missing = row.rate - along(row, &velocities);
            }
            if largest(&missing) <= 1e-15 * size {
                break;
            }
            let correction = solve(&mut least, &vec![0.0; n], &missing)?;
            for (v, c) in velocities.iter_mut().zip(correction) {
                *v += c;
            }
        }
        let unmet = unmet(&rows, |row| row.rate - along(row, &velocities));
        let largest = rows.iter().fold(0.0_f64, |m, row| {
            m.max((row.rate - along(row, &velocities)).abs())
        });
        if !(largest <= CONSISTENT * size) {
            return Err(AssemblyError::Velocities { unmet });
        }
        for (k, (u, v)) in state
            .velocities_mut()
            .iter_mut()
            .zip(&velocities)
            .enumerate()
        {
            *u = if k % 6 < 3 { v * length } else { *v };
        }
        self.evaluate(state, false);
        Ok(())
    }

    /// Equations that were dropped as redundant and do not hold at the instant evaluated last, by
    /// more than a part `tolerance` of the length, or as many radians.
    pub(crate) fn broken(&self, tolerance: f64, length: f64) -> impl Iterator<Item = Unmet> + '_ {
        let constraints = self.constraints.iter().zip(&self.evaluated);
        constraints
            .filter(|(constraint, _)| constraint.row.is_none())
            .filter(|(constraint, _)| self.model.is_active(constraint.owner.element()))
            .filter_map(move |(constraint, evaluated)| {
                let (scale, quantity) = rows::scale_of(constraint.form, evaluated, length);
                let error = match constraint.level {
                    Level::Position => evaluated.error,
                    Level::Velocity => evaluated.rate - self.rate_along(constraint, evaluated),
                    Level::Acceleration => 0.0,
                };
                let error = error.abs();
                (scale * error > tolerance).then(|| Unmet {
                    owner: self.owner_label(constraint.owner).clone(),
                    equation: name(constraint.form),
                    error,
                    quantity,
                })
            })
    }

    /// The element whose numbers leave nothing of others beside them.
    pub(super) fn out_of_scale(&self, singular: Singular) -> AssemblyError {
        AssemblyError::OutOfScale {
            element: self.element_at(singular.column).cloned(),
        }
    }

    /// The equations of a joint also hold with opposite axes; that is not what the joint means.
    fn check_directions(&self) -> Result<(), AssemblyError> {
        for (place, joint) in self.model.joints.iter().enumerate() {
            if !self.model.is_active(Element::Joint(place)) {
                continue;
            }
            let (i, j) = (self.marker(joint.i), self.marker(joint.j));
            for &axis in codirected_axes(joint.kind) {
                if i.axis(axis).dot(&j.axis(axis)) < 0.0 {
                    return Err(AssemblyError::Opposite {
                        joint: joint.label.clone(),
                        axis,
                    });
                }
            }
        }
        Ok(())
    }

    fn moved(&self, given: &State, state: &State, length: f64) -> Vec<Moved> {
        let mut moved = Vec::new();
        for (place, body) in self.model.bodies.iter().enumerate() {
            let distance = (state.centre(place) - given.centre(place)).norm();
            let before = given.orientation(place).matrix();
            let angle =
                crate::rotation::log(&(state.orientation(place).matrix() * before.transpose()))
                    .norm();
            if distance > 1e-7 * length || angle > 1e-7 {
                moved.push(Moved {
                    body: body.label.clone(),
                    distance,
                    angle,
                });
            }
        }
        moved
    }

    fn velocity_changes(&self, given: &State, state: &State, length: f64) -> Vec<VelocityChange> {
        let mut changes = Vec::new();
        for (place, body) in self.model.bodies.iter().enumerate() {
            let part = |state: &State, from: usize| {
                let first = 6 * place + from;
                Vector3::from_column_slice(&state.velocities()[first..first + 3])
            };
            let linear = (part(state, 0) - part(given, 0)).norm();
            let angular = (part(state, 3) - part(given, 3)).norm();
            let given = body.given_velocity.contains(&true);
            if given && (linear > 1e-7 * length || angular > 1e-7) {
                changes.push(VelocityChange {
                    body: body.label.clone(),
                    linear,
                    angular,
                });
            }
        }
        changes
    }
}
