//! Friction of a joint at an instant: from reaction, velocity and creep to force and derivatives.
//!
//! The reaction of the joint's own equations is known along the axes of marker J: an equation
//! `along` an axis contributes its multiplier to the force along that axis, an equation between
//! axes contributes its multiplier times `a_I × b_J` to the moment. So the load on the sliding
//! surfaces is a function of multipliers of the same instant, and the derivatives by them go into
//! the Newton matrix: friction and reactions are solved together.
//!
//! Creep is history. Between accepted steps it is the creep at the last one plus the displacement
//! since (shared spec of the law, "Creep: definition, integration, reset"): [`Memory`] holds what
//! the last accepted step left.

use friction::{Load, Regime, Resultant, resultant};
use nalgebra::{Matrix3, SMatrix, Vector3};

use crate::equation::{Equation, Local, LocalMatrix, local_velocities};
use crate::model::{Friction, FrictionJoint};
use crate::rotation::{log, log_jacobian, skew};
use crate::state::MarkerFrame;

/// What an equation of the joint contributes to its reaction.
#[derive(Clone, Copy, Debug)]
pub(crate) enum Share {
    /// Force along an axis of J.
    Force(usize),
    /// Moment along the equation's `a_I × b_J`.
    Moment,
}

/// An equation of the joint and its part in the reaction.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Contribution {
    /// Place in the list of constraints.
    pub(crate) constraint: usize,
    pub(crate) share: Share,
}

/// What friction remembers of the last accepted step.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Memory {
    /// Creep, in the axes of [`Values::creep`].
    pub creep: [f64; 3],
    /// Whether the joint was stuck, so that creep goes on from there.
    pub stuck: bool,
    /// Displacement along or angle about z of J, of the joint with one freedom.
    pub displacement: f64,
    /// Rotation of I against J, of the spherical joint: axes of I along axes of J.
    pub rotation: Matrix3<f64>,
    /// The same where the stick began, or now while sliding: the frame of printed vectors.
    pub anchor: Matrix3<f64>,
    /// Displacement at the first assembly, from which the overlap counts.
    pub initial_displacement: f64,
    /// Velocity of the sliding surfaces.
    pub velocity: [f64; 3],
}

/// Friction of a joint at an instant, on I.
#[derive(Clone, Copy, Debug)]
pub struct Values {
    /// Friction force along z of J (translational), torque about z of J (revolute), or torque
    /// along the axes of J (spherical).
    pub force: [f64; 3],
    /// Vector coefficient of friction, in the same axes.
    pub mu: [f64; 3],
    /// Effective static coefficient; zero while sliding.
    pub mu1: f64,
    /// Velocity of the sliding surfaces, I against J, in the same axes (length/time).
    pub velocity: [f64; 3],
    /// Creep, in the same axes (length).
    pub creep: [f64; 3],
    /// Blend between creep (0) and velocity (1).
    pub beta: f64,
    /// Regime of the law.
    pub regime: Regime,
    /// Load on the sliding surfaces.
    pub load: Load,
    /// Whether the limit of the friction force or torque was reached.
    pub clipped: bool,
    /// Spherical joint: axes of I along axes of J where the stick began, or now while sliding.
    pub anchor: Matrix3<f64>,
}

/// Values and derivatives over the local motions of the joint's markers.
pub(crate) struct Element {
    pub(crate) values: Values,
    /// Generalised force on both bodies.
    pub(crate) force: Local,
    /// Its derivatives by force and moment of the reaction along the axes of J (columns).
    pub(crate) by_reaction: SMatrix<f64, 12, 6>,
    pub(crate) by_velocity: LocalMatrix,
    pub(crate) by_position: LocalMatrix,
}

/// The equation whose value is the displacement of a joint with one freedom.
fn freedom(load: &FrictionJoint) -> Option<Equation> {
    match load {
        FrictionJoint::Translational(_) => Some(Equation::Along(2)),
        FrictionJoint::Revolute(_) => Some(Equation::AboutZ),
        FrictionJoint::Spherical(_) => None,
    }
}

impl Memory {
    /// Stuck without creep where the joint stands.
    pub(crate) fn at(friction: &Friction, i: &MarkerFrame, j: &MarkerFrame) -> Self {
        let displacement =
            freedom(&friction.load).map_or(0.0, |equation| equation.evaluate(i, j).value);
        Self {
            creep: [0.0; 3],
            stuck: true,
            displacement,
            rotation: j.axes.transpose() * i.axes,
            anchor: j.axes.transpose() * i.axes,
            initial_displacement: displacement,
            velocity: surface_velocity(friction, i, j),
        }
    }

    /// Displacement of the surfaces since the last accepted step.
    fn slip(&self, friction: &Friction, i: &MarkerFrame, j: &MarkerFrame) -> [f64; 3] {
        let arm = friction.load.arm();
        match freedom(&friction.load) {
            Some(equation) => {
                let value = equation.evaluate(i, j).value;
                [arm * self.change(friction, value), 0.0, 0.0]
            }
            None => {
                let turned = j.axes.transpose() * i.axes * self.rotation.transpose();
                (arm * log(&turned)).into()
            }
        }
    }

    /// Change of the displacement; an angle by less than half a turn since the last step.
    fn change(&self, friction: &Friction, value: f64) -> f64 {
        let change = value - self.displacement;
        match friction.load {
            FrictionJoint::Revolute(_) => {
                change - std::f64::consts::TAU * (change / std::f64::consts::TAU).round()
            }
            _ => change,
        }
    }

    /// Takes over an accepted step of length `size` that ended at the frames of I and J.
    ///
    /// Stick that begins within the step is anchored where the speed fell below the transition
    /// velocity, found with the velocity taken linear over the step; the law gives creep a weight
    /// there that vanishes with the third power of the distance to that velocity.
    pub(crate) fn accept(
        &mut self,
        friction: &Friction,
        i: &MarkerFrame,
        j: &MarkerFrame,
        size: f64,
    ) {
        let velocity = surface_velocity(friction, i, j);
        let creep = if self.stuck {
            let slip = self.slip(friction, i, j);
            std::array::from_fn(|k| self.creep[k] + slip[k])
        } else {
            self.first_creep(friction, &velocity, size)
        };
        let stuck = friction.law.regime(Vector3::from(velocity).norm()) == Regime::Stuck;
        if !(self.stuck && stuck) {
            self.anchor = j.axes.transpose() * i.axes;
        }
        self.stuck = stuck;
        self.creep = match friction.load {
            FrictionJoint::Spherical(_) => friction.law.settle(&velocity, creep),
            _ => {
                let [creep] = friction.law.settle(&[velocity[0]], [creep[0]]);
                [creep, 0.0, 0.0]
            }
        };
        self.rotation = j.axes.transpose() * i.axes;
        self.velocity = velocity;
        if let Some(equation) = freedom(&friction.load) {
            let value = equation.evaluate(i, j).value;
            self.displacement += self.change(friction, value);
        }
    }

    /// Displacement since the speed fell below the transition velocity within a step.
    fn first_creep(&self, friction: &Friction, velocity: &[f64; 3], size: f64) -> [f64; 3] {
        let (before, after) = (Vector3::from(self.velocity), Vector3::from(*velocity));
        let change = after - before;
        let limit = friction.law.transition_velocity;
        // |before + s change| = limit, for the last s in 0..1.
        let (a, b) = (change.norm_squared(), before.dot(&change));
        let root = b * b - a * (before.norm_squared() - limit * limit);
        if !(a > 0.0 && root >= 0.0) {
            return [0.0; 3];
        }
        let s = ((-b - root.sqrt()) / a).clamp(0.0, 1.0);
        (0.5 * size * (1.0 - s) * (before + s * change + after)).into()
    }
}

/// Velocity of the sliding surfaces, I against J.
fn surface_velocity(friction: &Friction, i: &MarkerFrame, j: &MarkerFrame) -> [f64; 3] {
    let arm = friction.load.arm();
    match freedom(&friction.load) {
        Some(equation) => {
            let row = equation.evaluate(i, j);
            [arm * row.jacobian.dot(&local_velocities(i, j)), 0.0, 0.0]
        }
        None => (arm * (j.axes.transpose() * (i.omega - j.omega))).into(),
    }
}

/// Friction and its derivatives, for a reaction along the axes of J.
pub(crate) fn evaluate(
    friction: &Friction,
    memory: &Memory,
    i: &MarkerFrame,
    j: &MarkerFrame,
    reaction_force: [f64; 3],
    reaction_moment: [f64; 3],
) -> Element {
    match &friction.load {
        FrictionJoint::Translational(load) => {
            let equation = Equation::Along(2);
            let value = equation.evaluate(i, j).value;
            let displacement =
                memory.displacement + memory.change(friction, value) - memory.initial_displacement;
            let load = load.evaluate(reaction_force, reaction_moment, displacement);
            along_freedom(friction, memory, equation, load, i, j)
        }
        FrictionJoint::Revolute(load) => {
            let load = load.evaluate(reaction_force, reaction_moment);
            along_freedom(friction, memory, Equation::AboutZ, load, i, j)
        }
        FrictionJoint::Spherical(load) => {
            spherical(friction, memory, load.evaluate(reaction_force), i, j)
        }
    }
}

/// A force or torque along the one freedom of a joint.
fn along_freedom(
    friction: &Friction,
    memory: &Memory,
    equation: Equation,
    load: Load,
    i: &MarkerFrame,
    j: &MarkerFrame,
) -> Element {
    let arm = friction.load.arm();
    let row = equation.evaluate(i, j);
    let stiffness = equation.stiffness(i, j);
    let u = local_velocities(i, j);
    let velocity = arm * row.jacobian.dot(&u);
    let velocity_by_position = arm * stiffness.tr_mul(&u);
    let creep = if memory.stuck {
        memory.creep[0] + arm * memory.change(friction, row.value)
    } else {
        0.0
    };
    let creep_by_position = if memory.stuck {
        arm * row.jacobian
    } else {
        Local::zeros()
    };
    let coefficient = friction.law.evaluate(&[velocity], &[creep]);
    let r = resultant(&coefficient, load.value, friction.preload, friction.maximum);
    let force = r.force[0];
    // The friction coefficient acts along the displacement the equation measures, so the virtual
    // work of the force is force · δ(value).
    let (by_load, by_velocity, by_creep) = (r.by_load[0], r.by_velocity[0][0], r.by_creep[0][0]);
    let mut by_reaction = SMatrix::<f64, 12, 6>::zeros();
    for k in 0..3 {
        by_reaction.set_column(k, &(row.jacobian * (by_load * load.by_force[k])));
        by_reaction.set_column(3 + k, &(row.jacobian * (by_load * load.by_moment[k])));
    }
    let change = by_velocity * velocity_by_position
        + by_creep * creep_by_position
        + by_load * load.by_displacement * row.jacobian;
    Element {
        values: Values {
            force: [force, 0.0, 0.0],
            mu: [coefficient.mu[0], 0.0, 0.0],
            mu1: coefficient.mu1,
            velocity: [velocity, 0.0, 0.0],
            creep: [visible(coefficient.regime, creep), 0.0, 0.0],
            beta: coefficient.beta,
            regime: coefficient.regime,
            load,
            clipped: r.clipped,
            anchor: Matrix3::identity(),
        },
        force: force * row.jacobian,
        by_reaction,
        by_velocity: row.jacobian * (by_velocity * arm * row.jacobian).transpose(),
        by_position: force * stiffness + row.jacobian * change.transpose(),
    }
}

/// Creep exists only while the joint is stuck.
fn visible(regime: Regime, creep: f64) -> f64 {
    if regime == Regime::Stuck { creep } else { 0.0 }
}

/// A torque against the relative rotation of a spherical joint.
///
/// The law works in axes fixed to J: its vectors are those of `friction::SphericalLoad`.
fn spherical(
    friction: &Friction,
    memory: &Memory,
    load: Load,
    i: &MarkerFrame,
    j: &MarkerFrame,
) -> Element {
    let arm = friction.load.arm();
    let omega = i.omega - j.omega;
    let to_j = j.axes.transpose();
    let velocity = arm * (to_j * omega);
    let (creep, turn) = if memory.stuck {
        let theta = log(&(to_j * i.axes * memory.rotation.transpose()));
        // The rotation of I comes in from the left, hence the Jacobian at −θ.
        (
            Vector3::from(memory.creep) + arm * theta,
            arm * log_jacobian(&-theta),
        )
    } else {
        (Vector3::zeros(), Matrix3::zeros())
    };
    let coefficient = friction.law.evaluate(&velocity.into(), &creep.into());
    let r: Resultant<3> = resultant(&coefficient, load.value, friction.preload, friction.maximum);
    let matrix = |m: [[f64; 3]; 3]| Matrix3::from_fn(|row, column| m[row][column]);
    let torque = j.axes * Vector3::from(r.force);
    // Derivatives of the torque along ground axes by the relative velocity and rotation.
    let by_omega = j.axes * matrix(r.by_velocity) * arm * to_j;
    let by_theta_i = j.axes * matrix(r.by_creep) * turn * to_j;
    // δ(A_J T) = δθ_J × (A_J T) + A_J δT, and δ(A_Jᵀ ω) = −A_Jᵀ (δθ_J × ω).
    let by_theta_j = -skew(&torque) - by_theta_i + by_omega * skew(&omega);
    let stuck = memory.stuck && coefficient.regime == Regime::Stuck;
    let mut element = Element {
        values: Values {
            force: r.force,
            mu: coefficient.mu,
            mu1: coefficient.mu1,
            velocity: velocity.into(),
            creep: [0, 1, 2].map(|k| visible(coefficient.regime, creep[k])),
            beta: coefficient.beta,
            regime: coefficient.regime,
            load,
            clipped: r.clipped,
            anchor: if stuck { memory.anchor } else { to_j * i.axes },
        },
        force: Local::zeros(),
        by_reaction: SMatrix::zeros(),
        by_velocity: LocalMatrix::zeros(),
        by_position: LocalMatrix::zeros(),
    };
    // Torque on I at 3, the opposite on J at 9.
    for (place, sign) in [(3, 1.0), (9, -1.0)] {
        element
            .force
            .fixed_rows_mut::<3>(place)
            .copy_from(&(sign * torque));
        let along = j.axes * Vector3::from(r.by_load);
        for k in 0..3 {
            let column = sign * load.by_force[k] * along;
            element
                .by_reaction
                .fixed_view_mut::<3, 1>(place, k)
                .copy_from(&column);
        }
        element
            .by_velocity
            .fixed_view_mut::<3, 3>(place, 3)
            .copy_from(&(sign * by_omega));
        element
            .by_velocity
            .fixed_view_mut::<3, 3>(place, 9)
            .copy_from(&(-sign * by_omega));
        element
            .by_position
            .fixed_view_mut::<3, 3>(place, 3)
            .copy_from(&(sign * by_theta_i));
        element
            .by_position
            .fixed_view_mut::<3, 3>(place, 9)
            .copy_from(&(sign * by_theta_j));
    }
    element
}
