//! Reactions from multipliers, and the friction that they cause.

use nalgebra::{Matrix3, Vector3};

use super::System;
use crate::constraint::{Constraint, Evaluated, Form, Owner, places_of};
use crate::equation::Equation;
use crate::joint_friction::{self, Element, Past, Share, Values, Wanted};
use crate::model::Element as ModelElement;
use crate::rotation::skew;
use crate::snapshot::Wrench;
use crate::state::MarkerFrame;

impl System {
    /// Reaction of a joint, motion or general constraint on the part of its marker I, at the origin
    /// of I, ground axes; zero for a general constraint without a marker I.
    pub(crate) fn reaction_on_i(&self, owner: Owner, multipliers: &[f64]) -> Wrench {
        let mut wrench = Wrench::default();
        for place in places_of(&self.constraints, owner) {
            let (constraint, evaluated) = (&self.constraints[place], &self.evaluated[place]);
            let multiplier = self.multiplier(place, multipliers);
            match (constraint.form, owner) {
                (Form::Pair { i, .. }, _) => {
                    let local = multiplier * evaluated.local;
                    let force = Vector3::new(local[0], local[1], local[2]);
                    let torque = Vector3::new(local[3], local[4], local[5]);
                    wrench.force += force;
                    wrench.torque += torque - self.marker(i).arm.cross(&force);
                }
                (Form::Function, Owner::General(place)) => {
                    let Some(i) = self.model.constraints[place].i else {
                        continue;
                    };
                    let on_part = self.gradient_about(&self.marker(i), constraint, evaluated);
                    wrench.force += multiplier * on_part.force;
                    wrench.torque += multiplier * on_part.torque;
                }
                (Form::Function, _) => {}
            }
        }
        wrench
    }

    /// What a unit multiplier of a constraint applies to the part of a marker, about its origin. On
    /// ground it is the opposite of what it applies to all bodies.
    pub(super) fn gradient_about(
        &self,
        marker: &MarkerFrame,
        constraint: &Constraint,
        evaluated: &Evaluated,
    ) -> Wrench {
        let mut sum = Wrench::default();
        for (body, block) in evaluated.blocks(constraint) {
            let force = Vector3::new(block[0], block[1], block[2]);
            let arm = self.bodies[body].centre - marker.origin;
            let torque = Vector3::new(block[3], block[4], block[5]) + arm.cross(&force);
            if marker.body == Some(body) {
                return Wrench { force, torque };
            }
            sum.force -= force;
            sum.torque -= torque;
        }
        match marker.body {
            None => sum,
            Some(_) => Wrench::default(),
        }
    }

    /// Reaction of a friction's joint on I at marker I, along the axes of J.
    fn reaction(
        &self,
        place: usize,
        j: &MarkerFrame,
        multipliers: &[f64],
    ) -> (Vector3<f64>, Vector3<f64>) {
        let (mut force, mut moment) = (Vector3::zeros(), Vector3::zeros());
        for contribution in &self.reactions[place] {
            let multiplier = self.multiplier(contribution.constraint, multipliers);
            match contribution.share {
                Share::Force(axis) => force[axis] += multiplier,
                Share::Moment => {
                    moment += multiplier * self.moment_axis(contribution.constraint, j);
                }
            }
        }
        (force, moment)
    }

    /// Direction along the axes of J of the moment that an equation between axes applies to I.
    pub(crate) fn moment_axis(&self, constraint: usize, j: &MarkerFrame) -> Vector3<f64> {
        j.axes.transpose() * self.evaluated[constraint].local.fixed_rows::<3>(3)
    }

    /// Change of the reaction moment along the axes of J with the rotation of I, of which that with the
    /// rotation of J is the opposite; none where no equation makes a moment.
    pub(super) fn moment_change(
        &self,
        place: usize,
        i: &MarkerFrame,
        j: &MarkerFrame,
        multipliers: &[f64],
    ) -> Option<Matrix3<f64>> {
        let mut by_turn: Option<Matrix3<f64>> = None;
        for contribution in &self.reactions[place] {
            let constraint = &self.constraints[contribution.constraint];
            let Form::Pair {
                equation: Equation::Axes(k, l),
                ..
            } = constraint.form
            else {
                continue;
            };
            // δ(A_Jᵀ (a × b)) = A_Jᵀ b× a× (δθ_I − δθ_J), as b is fixed to J.
            let multiplier = self.multiplier(contribution.constraint, multipliers);
            let one = multiplier * skew(&j.axis(l)) * skew(&i.axis(k));
            by_turn = Some(by_turn.map_or(one, |sum| sum + one));
        }
        by_turn.map(|by_turn| j.axes.tr_mul(&by_turn))
    }

    /// Whether a friction acts at the present kind of instant.
    pub(super) fn friction_acts(&self, place: usize) -> bool {
        let rests = self.statics && self.model.frictions[place].inactive_static;
        !rests && self.model.is_active(ModelElement::Friction(place))
    }

    /// The frames of the markers of a friction's joint as they were evaluated last.
    pub(crate) fn friction_frames(&self, place: usize) -> [&MarkerFrame; 2] {
        let joint = &self.model.joints[self.model.frictions[place].joint];
        [self.frame(joint.i), self.frame(joint.j)]
    }

    /// Friction element `place`.
    #[inline(always)]
    pub(crate) fn friction(&self, place: usize, multipliers: &[f64]) -> Element {
        self.evaluate_friction(place, multipliers, Wanted::default())
    }

    /// What results read of a friction.
    pub(crate) fn friction_values(&self, place: usize, multipliers: &[f64]) -> Values {
        let mut values = Values::NONE;
        let wanted = Wanted {
            values: Some(&mut values),
            ..Wanted::default()
        };
        self.evaluate_friction(place, multipliers, wanted);
        values
    }

    #[inline(always)]
    pub(super) fn evaluate_friction(
        &self,
        place: usize,
        multipliers: &[f64],
        wanted: Wanted<'_>,
    ) -> Element {
        if !self.friction_acts(place) {
            return Element::AT_REST;
        }
        let [i, j] = self.friction_frames(place);
        let (force, moment) = self.reaction(place, j, multipliers);
        let past = Past {
            memory: &self.history.frictions[place],
            bristles: self.bristle_past(place),
            time: self.inputs.time,
        };
        let (force, moment) = (force.into(), moment.into());
        let friction = &self.model.frictions[place];
        joint_friction::evaluate(friction, &past, i, j, force, moment, wanted)
    }
}
