//! A solved instant, as results read it.

use nalgebra::{Matrix3, Vector3};

use crate::assembly::Unmet;
use crate::constraint::Owner;
use crate::expression::{Input, Program};
use crate::joint_friction::{Tally, Values};
use crate::measure::{MarkerAcceleration, Order};
use crate::model::{Element, Model};
use crate::state::{MarkerFrame, State};
use crate::system::System;

/// A force and a torque, along ground axes.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Wrench {
    /// Force.
    pub force: Vector3<f64>,
    /// Torque about the point that goes with it.
    pub torque: Vector3<f64>,
}

/// State, accelerations and reactions of one instant.
#[derive(Clone, Copy, Debug)]
pub struct Snapshot<'a> {
    system: &'a System,
    state: &'a State,
    accelerations: &'a [f64],
    multipliers: &'a [f64],
}

impl<'a> Snapshot<'a> {
    pub(crate) fn new(
        system: &'a System,
        state: &'a State,
        accelerations: &'a [f64],
        multipliers: &'a [f64],
    ) -> Self {
        Self {
            system,
            state,
            accelerations,
            multipliers,
        }
    }

    /// Time.
    #[must_use]
    pub fn time(&self) -> f64 {
        self.state.time
    }

    /// The model.
    #[must_use]
    pub fn model(&self) -> &Model {
        self.system.model()
    }

    /// Positions and velocities.
    #[must_use]
    pub fn state(&self) -> &State {
        self.state
    }

    /// Frame of a marker.
    #[must_use]
    pub fn marker(&self, marker: usize) -> MarkerFrame {
        self.system.marker(marker)
    }

    /// Linear and angular acceleration at a marker, ground axes.
    #[must_use]
    pub fn marker_acceleration(&self, marker: usize) -> MarkerAcceleration {
        self.system.marker_acceleration(marker, self.accelerations)
    }

    /// Frame of a part's own axes: origin, rotation, velocity and angular velocity.
    #[must_use]
    pub fn part(&self, body: usize) -> MarkerFrame {
        let frame = self.system.body(body);
        let arm = -(frame.rotation * self.model().bodies[body].centre);
        MarkerFrame {
            body: Some(body),
            origin: frame.centre + arm,
            arm,
            axes: frame.rotation,
            velocity: frame.velocity + frame.omega.cross(&arm),
            omega: frame.omega,
        }
    }

    /// Acceleration of a part's origin and its angular acceleration, ground axes.
    #[must_use]
    pub fn part_acceleration(&self, body: usize) -> MarkerAcceleration {
        self.system
            .acceleration_at(body, &self.part(body).arm, self.accelerations)
    }

    /// Force and torque of a joint, motion or general constraint on the part of its marker I, at
    /// the origin of I, ground axes; friction is not in it.
    ///
    /// Zero for a general constraint without a marker I.
    #[must_use]
    pub fn reaction(&self, owner: Owner) -> Wrench {
        self.system.reaction_on_i(owner, self.multipliers)
    }

    /// Constraint equations that were dropped as redundant and do not hold here: by more than a part
    /// `tolerance` of the `length`, or as many radians.
    pub fn broken(&self, tolerance: f64, length: f64) -> impl Iterator<Item = Unmet> + '_ {
        self.system.broken(tolerance, length)
    }

    /// Force and torque of a single-component force on the part of its marker I, at the origin of
    /// I, ground axes.
    #[must_use]
    pub fn applied(&self, force: usize) -> Wrench {
        if !self.model().is_active(Element::Force(force)) {
            return Wrench::default();
        }
        let element = &self.model().forces[force];
        let (i, value) = (self.marker(element.i), self.force_value(force));
        let local = self.system.force_direction(element) * value;
        let push = Vector3::new(local[0], local[1], local[2]);
        let turn = Vector3::new(local[3], local[4], local[5]);
        Wrench {
            force: push,
            torque: turn - i.arm.cross(&push),
        }
    }

    fn force_value(&self, force: usize) -> f64 {
        let function = &self.model().forces[force].function;
        self.evaluate(function, &|_| f64::NAN)
    }

    /// Friction of a joint.
    #[must_use]
    pub fn friction(&self, friction: usize) -> Values {
        self.system.friction_values(friction, self.multipliers)
    }

    /// What a friction did up to the end of an accepted step, the last one or, within a step, one of
    /// the two that enclose the instant.
    #[must_use]
    pub fn tally(&self, friction: usize) -> &Tally {
        &self.system.history.frictions[friction].tally
    }

    /// Work of dynamic simulations since the start: what each friction took out, then what forces
    /// and what motions put in; force · length.
    #[must_use]
    pub fn works(&self) -> &[f64] {
        self.state.works()
    }

    /// Rate of a differential state.
    #[must_use]
    pub fn state_rate(&self, state: usize) -> f64 {
        self.accelerations[self.system.velocity_count() + state]
    }

    /// Value of a measure, of accelerations too.
    #[must_use]
    pub fn measure(&self, place: usize) -> f64 {
        let measure = self.model().measures[place];
        if measure.quantity.order() != Order::Acceleration {
            return self.system.measure_value(place);
        }
        self.system.acceleration_value(place, self.accelerations)
    }

    /// Value of a function; `result` gives the results that it reads.
    pub fn evaluate(&self, function: &Program, result: &dyn Fn(usize) -> f64) -> f64 {
        let mut registers = vec![0.0; function.len()];
        function.evaluate(&mut registers, |input| self.read(input, result))
    }

    /// What a function reads; `result` gives the results.
    #[must_use]
    pub fn read(&self, input: Input, result: &dyn Fn(usize) -> f64) -> f64 {
        match input {
            Input::Time => self.time(),
            Input::Measure(measure) => self.measure(measure),
            Input::State(state) => self.state.states()[state],
            Input::StateRate(state) => self.state_rate(state),
            Input::Algebraic(variable) => self.multipliers[self.system.row_count() + variable],
            Input::Result(number) => result(number),
        }
    }

    /// Part axes to ground axes of a body.
    #[must_use]
    pub fn rotation(&self, body: usize) -> Matrix3<f64> {
        self.system.body(body).rotation
    }
}
