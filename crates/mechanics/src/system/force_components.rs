//! Algebraic variables that are a component of a force: values and derivatives.
//!
//! With the generalised force `f` of an element on the part of I, about the part's centre of mass, the
//! component along an axis `a` is `a · F` of the force or `a · T` of the torque about the marker's
//! origin,
//!
//! ```text
//! F = f_F,   T = f_T − ρ_I × f_F            on I
//! −F,        −(T + (o_I − o_J) × F)         on J
//! ```

use nalgebra::{SVector, Vector3};
use numerics::linear::Matrix;

use super::System;
use super::newton_matrix::Weights;
use super::single_force::{direction, direction_by_frame, direction_stiffness};
use crate::constraint::{Form, Owner, places_of};
use crate::equation::{Local, LocalMatrix, Pair};
use crate::force_element::{ForceComponent, ForceElement, Side};
use crate::joint_friction::Slopes;
use crate::model::Element;
use crate::snapshot::Wrench;
use crate::state::MarkerFrame;

/// What a component is of an element's generalised force, and how that changes with the markers.
struct Reading {
    /// Axis, with the sign of the side.
    axis: Vector3<f64>,
    /// What multiplies the force and the torque about the origin of I.
    by_force: Vector3<f64>,
    by_torque: Vector3<f64>,
    /// From the marker about which the torque is asked for to I.
    arm: Vector3<f64>,
    torque: bool,
    /// Markers I and J where there are such, and the one whose axes resolve.
    i: Option<MarkerFrame>,
    j: Option<MarkerFrame>,
    frame: MarkerFrame,
}

impl Reading {
    /// What multiplies the generalised force on the part of I.
    fn functional(&self) -> SVector<f64, 6> {
        let rho = self.i.map_or_else(Vector3::zeros, |i| i.arm);
        let force = self.by_force - self.by_torque.cross(&rho);
        let mut p = SVector::<f64, 6>::zeros();
        p.fixed_rows_mut::<3>(0).copy_from(&force);
        p.fixed_rows_mut::<3>(3).copy_from(&self.by_torque);
        p
    }

    /// The component of a force and torque about the origin of I.
    fn of(&self, wrench: &Wrench) -> f64 {
        self.by_force.dot(&wrench.force) + self.by_torque.dot(&wrench.torque)
    }
}

/// A row of the Newton matrix that takes derivatives of a component, with the opposite sign.
struct Row<'a> {
    row: usize,
    weights: &'a Weights,
    matrix: &'a mut Matrix,
}

impl Row<'_> {
    fn add(&mut self, column: usize, value: f64) {
        self.matrix.add(self.row, column, -value);
    }
}

impl System {
    /// How a component reads an element; `None` where the element does not act on that side.
    fn reading(
        &self,
        component: &ForceComponent,
        element: ForceElement,
        side: Side,
    ) -> Option<Reading> {
        let ends = self.model.ends(element);
        if side == Side::J && !ends.on_both {
            return None;
        }
        let [i, j] = [ends.i, ends.j].map(|marker| marker.map(|m| self.marker(m)));
        let frame = self.marker(component.frame);
        let axis = frame.axis(component.axis);
        let (axis, arm) = match (side, &i, &j) {
            (Side::I, ..) => (axis, Vector3::zeros()),
            (Side::J, Some(i), Some(j)) if !ends.floating => (-axis, i.origin - j.origin),
            (Side::J, ..) => (-axis, Vector3::zeros()),
        };
        let (by_force, by_torque) = if component.torque {
            (axis.cross(&arm), axis)
        } else {
            (axis, Vector3::zeros())
        };
        Some(Reading {
            axis,
            by_force,
            by_torque,
            arm,
            torque: component.torque,
            i,
            j: if ends.floating { None } else { j },
            frame,
        })
    }

    /// Value of the component that is algebraic variable `place`.
    pub(super) fn component_value(
        &self,
        place: usize,
        component: &ForceComponent,
        multipliers: &[f64],
        registers: &mut [f64],
    ) -> f64 {
        let read = |&(element, side): &(ForceElement, Side)| {
            let reading = self.reading(component, element, side)?;
            Some(reading.of(&self.wrench_on_i(element, multipliers, registers)))
        };
        self.acting[place].iter().filter_map(read).sum()
    }

    /// Force and torque of an element on the part of I, about the origin of I, ground axes.
    fn wrench_on_i(
        &self,
        element: ForceElement,
        multipliers: &[f64],
        registers: &mut [f64],
    ) -> Wrench {
        let about = |i: &MarkerFrame, local: &Local| {
            let force = Vector3::new(local[0], local[1], local[2]);
            let torque = Vector3::new(local[3], local[4], local[5]) - i.arm.cross(&force);
            Wrench { force, torque }
        };
        match element {
            ForceElement::Constraint(owner) => self.reaction_on_i(owner, multipliers),
            ForceElement::Applied { first, count } => {
                let mut sum = Wrench::default();
                for place in first..first + count {
                    if !self.model.is_active(Element::Force(place)) {
                        continue;
                    }
                    let force = &self.model.forces[place];
                    let frames = self.force_frames(force);
                    let value = force
                        .function
                        .evaluate(registers, |input| self.inputs.read(input));
                    let part = about(frames.i, &(value * direction(force.kind, &frames)));
                    sum.force += part.force;
                    sum.torque += part.torque;
                }
                sum
            }
            ForceElement::Friction(place) => {
                let [i, _] = self.friction_frames(place);
                about(i, &self.friction(place, multipliers).force)
            }
        }
    }

    /// Adds the derivatives of the component that is algebraic variable `place`, with the opposite
    /// sign, to a row. Of general constraints those by position are left out, as everywhere.
    pub(super) fn assemble_component(
        &self,
        place: usize,
        component: &ForceComponent,
        row: usize,
        weights: &Weights,
        multipliers: &[f64],
        [registers, adjoints]: [&mut [f64]; 2],
        matrix: &mut Matrix,
    ) {
        let mut row = Row {
            row,
            weights,
            matrix,
        };
        for &(element, side) in &self.acting[place] {
            let Some(reading) = self.reading(component, element, side) else {
                continue;
            };
            let wrench = self.wrench_on_i(element, multipliers, registers);
            self.add_markers(&reading, &wrench, &mut row);
            match element {
                ForceElement::Constraint(owner) => {
                    self.add_reaction(&reading, owner, multipliers, &mut row);
                }
                ForceElement::Applied { first, count } => {
                    for place in first..first + count {
                        if self.model.is_active(Element::Force(place)) {
                            let scratch = [&mut *registers, &mut *adjoints];
                            self.add_applied(&reading, place, scratch, &mut row);
                        }
                    }
                }
                ForceElement::Friction(place) => {
                    self.add_friction(&reading, place, multipliers, &mut row);
                }
            }
        }
    }

    /// The change of what a component reads of a constant force with the markers.
    fn add_markers(&self, reading: &Reading, wrench: &Wrench, row: &mut Row) {
        let vector = if reading.torque {
            wrench.torque + reading.arm.cross(&wrench.force)
        } else {
            wrench.force
        };
        self.add_turning(&reading.frame, &reading.axis.cross(&vector), row);
        if !reading.torque {
            return;
        }
        let zero = Vector3::zeros();
        if let Some(i) = &reading.i {
            // −a · ((δθ × ρ) × F)
            let turn = -i.arm.cross(&wrench.force.cross(&reading.by_torque));
            self.add_motion(i, &zero, &turn, row);
        }
        if let (Some(i), Some(j)) = (&reading.i, &reading.j) {
            // a · (δd × F) with d = o_I − o_J, where the torque is asked for on J.
            let v = if reading.arm == zero {
                zero
            } else {
                wrench.force.cross(&reading.axis)
            };
            self.add_motion(i, &v, &i.arm.cross(&v), row);
            self.add_motion(j, &-v, &-j.arm.cross(&v), row);
        }
    }

    fn add_turning(&self, marker: &MarkerFrame, turn: &Vector3<f64>, row: &mut Row) {
        self.add_motion(marker, &Vector3::zeros(), turn, row);
    }

    /// Adds slopes by the displacement and rotation of a marker's body.
    fn add_motion(
        &self,
        marker: &MarkerFrame,
        shift: &Vector3<f64>,
        turn: &Vector3<f64>,
        row: &mut Row,
    ) {
        let Some(body) = marker.body else { return };
        let position = row.weights.position;
        let turns = f64::from(u8::from(self.model.bodies[body].rotates));
        for k in 0..3 {
            row.add(6 * body + k, position * shift[k]);
            row.add(6 * body + 3 + k, turns * position * turn[k]);
        }
    }

    /// Derivatives through a reaction: by its multipliers, and by the motions that turn it.
    fn add_reaction(&self, reading: &Reading, owner: Owner, multipliers: &[f64], row: &mut Row) {
        let mut p = reading.functional();
        let turns = |body: usize| self.model.bodies[body].rotates;
        if !reading.i.and_then(|i| i.body).is_none_or(turns) {
            // Constraints apply no torque to a point mass.
            p.fixed_rows_mut::<3>(3).fill(0.0);
        }
        let first = self.rate_count();
        for place in places_of(&self.constraints, owner) {
            let (constraint, evaluated) = (&self.constraints[place], &self.evaluated[place]);
            if constraint.owner != owner {
                continue;
            }
            match constraint.form {
                Form::Pair { equation, i, j } => {
                    let local = evaluated.local.fixed_rows::<6>(0);
                    let unit = p.dot(&local);
                    self.multiplier_parts(place, |unknown, slope| {
                        row.add(first + unknown, unit * slope);
                    });
                    let [i, j] = [i, j].map(|marker| self.frame(marker));
                    let pair = Pair::new(i, j);
                    let stiffness = equation.stiffness(&pair, &self.model.curves).matrix(&pair);
                    let scale = row.weights.position * self.multiplier(place, multipliers);
                    self.add_local_row(&p, &[i.body, j.body], &stiffness, scale, row);
                }
                Form::Function => {
                    let Some(i) = &reading.i else { continue };
                    let unit = self.gradient_about(i, constraint, evaluated);
                    let unit = reading.of(&unit);
                    self.multiplier_parts(place, |unknown, slope| {
                        row.add(first + unknown, unit * slope);
                    });
                }
            }
        }
    }

    fn add_applied(
        &self,
        reading: &Reading,
        place: usize,
        [registers, adjoints]: [&mut [f64]; 2],
        row: &mut Row,
    ) {
        let p = reading.functional();
        let force = &self.model.forces[place];
        let frames = self.force_frames(force);
        let function = &force.function;
        let value = function.evaluate(registers, |input| self.inputs.read(input));
        let scale = row.weights.position * value;
        let turning = direction_stiffness(force.kind, &frames);
        self.add_local_row(&p, &frames.sides(), &turning, scale, row);
        if let Some(change) = direction_by_frame(force.kind, &frames) {
            let turn = value * change.fixed_rows::<6>(0).tr_mul(&p);
            self.add_turning(frames.frame, &turn, row);
        }
        let unit = p.dot(&direction(force.kind, &frames).fixed_rows::<6>(0));
        let weights = row.weights;
        function.gradient(registers, adjoints, |input, slope| {
            self.columns(input, unit * slope, weights, |column, value| {
                row.add(column, value);
            });
        });
    }

    fn add_friction(&self, reading: &Reading, place: usize, multipliers: &[f64], row: &mut Row) {
        let p = reading.functional();
        let first = self.rate_count();
        let Weights {
            velocity, position, ..
        } = *row.weights;
        let reach = self.model.frictions[place].load.reach();
        let mut slopes = Slopes::zero(velocity, position, reach);
        let by_multiplier = |_: &[Option<usize>; 2], unknown, change: &Local| {
            row.add(first + unknown, p.dot(&change.fixed_rows::<6>(0)));
        };
        let sides = self.friction_change(place, multipliers, &mut slopes, by_multiplier);
        if let Some(sides) = sides {
            self.add_local_row(&p, &sides, &slopes.by_motion, 1.0, row);
        }
    }

    /// Adds `scale` times the change of a generalised force on the first body with the local motions
    /// of two bodies, read by `p`.
    fn add_local_row(
        &self,
        p: &SVector<f64, 6>,
        sides: &[Option<usize>; 2],
        local: &LocalMatrix,
        scale: f64,
        row: &mut Row,
    ) {
        let change = local.fixed_rows::<6>(0).tr_mul(p);
        for (side, body) in sides.iter().enumerate() {
            let Some(body) = *body else { continue };
            for k in 0..6 {
                let free = k < 3 || self.model.bodies[body].rotates;
                let value = if free {
                    scale * change[6 * side + k]
                } else {
                    0.0
                };
                row.add(6 * body + k, value);
            }
        }
    }
}
