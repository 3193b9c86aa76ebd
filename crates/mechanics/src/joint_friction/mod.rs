//! Friction of a joint at an instant: from reaction, velocity and creep to force and derivatives.
//!
//! The reaction of the joint's own equations is known along the axes of marker J: an equation
//! `along` an axis contributes its multiplier to the force along that axis, an equation between
//! axes contributes its multiplier times `a_I × b_J` to the moment. So the load on the sliding
//! surfaces is a function of multipliers of the same instant, and the derivatives by them go into
//! the Newton matrix: friction and reactions are solved together.
//!
//! | step | file |
//! |---|---|
//! | what the last accepted step left: creep, turns, tally | `memory.rs` |
//! | how the surfaces move within a step, where stick begins | `course.rs` |
//! | law, load, preload and limit to a force in surface variables | `response.rs` |
//! | joints whose freedoms are displacements and angles | `freedoms.rs` |
//! | spherical joints | `spherical.rs` |
//! | what results read | `values.rs` |
//!
//! # Creep and bristles
//! Creep is history: between accepted steps it is the creep at the last one plus the displacement
//! since, or since the speed has fallen below the transition velocity (spec of the law, "Creep:
//! definition, integration, reset"). The bristle deflection of LuGre
//! is a differential state. As its equation reads the velocity and load of its own joint alone and
//! is linear in it, the integrator's formula `z = past + γ z'` is solved for it in closed form
//! (`friction::LuGre::evaluate`), and no unknown of the Newton matrix is spent on it.

mod course;
mod freedoms;
mod memory;
mod response;
mod spherical;
mod values;

use friction::{Load, Regime};
use nalgebra::{ArrayStorage, Matrix3, SMatrix, Vector3};
use serde::{Deserialize, Serialize};

pub(crate) use memory::StepEnd;
pub use memory::{Memory, Tally};
pub use values::{SurfaceVector, Values};

use crate::equation::{Axis, Equation, Local, LocalMatrix, Pair, Pin, Reach};
use crate::model::{Friction, FrictionJoint};
use crate::rotation::skew;
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

/// What the integrator's formula says of the bristle deflection: `z = past + gamma z'`. At an instant
/// `gamma` is zero and `past` the deflection itself.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub(crate) struct BristlePast {
    pub(crate) past: [f64; 3],
    pub(crate) gamma: f64,
}

/// What friction at an instant has from before it.
#[derive(Clone, Copy, Debug)]
pub(crate) struct Past<'a> {
    /// The last accepted step.
    pub(crate) memory: &'a Memory,
    /// The integrator's formula for the bristles.
    pub(crate) bristles: &'a BristlePast,
    /// The time of the instant.
    pub(crate) time: f64,
}

/// Friction over the local motions of the joint's markers.
pub(crate) struct Element {
    /// Generalised force on both bodies.
    pub(crate) force: Local,
    /// Velocity of the sliding surfaces, I against J, by component.
    pub(crate) velocity: [f64; 3],
    /// Creep by component as the law had it; zero where the surfaces do not stick.
    pub(crate) creep: [f64; 3],
    pub(crate) load: Load,
    pub(crate) regime: Regime,
    /// Rate at which the friction takes energy out of the motion.
    pub(crate) power: f64,
    /// Generalised force by unit of load in steady motion: what decides whether the joint jams.
    pub(crate) by_load: Local,
    /// Magnitude of the coefficient in it; zero at rest without creep, and where a limit is reached.
    pub(crate) steady_coefficient: f64,
    /// Derivative of the load by force and moment of the reaction along the axes of J.
    pub(crate) load_by_reaction: [f64; 6],
    /// Bristle deflection and its rate, by component.
    pub(crate) deflection: [f64; 3],
    pub(crate) deflection_rate: [f64; 3],
}

impl Element {
    /// Friction that does not act.
    pub(crate) const AT_REST: Self = Self {
        force: Local::from_array_storage(ArrayStorage([[0.0; 12]])),
        velocity: [0.0; 3],
        creep: [0.0; 3],
        load: Load::NONE,
        regime: Regime::Stuck,
        power: 0.0,
        by_load: Local::from_array_storage(ArrayStorage([[0.0; 12]])),
        steady_coefficient: 0.0,
        load_by_reaction: [0.0; 6],
        deflection: [0.0; 3],
        deflection_rate: [0.0; 3],
    };
}

/// Derivatives of the generalised force.
pub(crate) struct Slopes {
    /// By force and moment of the reaction along the axes of J (columns).
    pub(crate) by_reaction: SMatrix<f64, 12, 6>,
    /// By velocities and positions, with their weights, in the parts that `reach` connects.
    pub(crate) by_motion: LocalMatrix,
    velocity: f64,
    position: f64,
    reach: Reach,
}

impl Slopes {
    /// None so far, with the weights of velocities and positions.
    pub(crate) fn zero(velocity: f64, position: f64, reach: Reach) -> Self {
        Self {
            by_reaction: SMatrix::zeros(),
            by_motion: LocalMatrix::zeros(),
            velocity,
            position,
            reach,
        }
    }

    /// Adds a block, three rows and columns from `3 row` and `3 column` on.
    fn add(&mut self, [row, column]: [usize; 2], block: &Matrix3<f64>) {
        let mut view = self.by_motion.fixed_view_mut::<3, 3>(3 * row, 3 * column);
        view += block;
    }

    /// Adds what the block in every place that `reach` connects says.
    fn add_blocks(&mut self, block: impl Fn(usize, usize) -> Matrix3<f64>) {
        for row in 0..4 {
            for column in 0..4 {
                if self.reach.connects(row, column) {
                    self.add([row, column], &block(row, column));
                }
            }
        }
    }

    /// Adds what the moment of the reaction makes of the rotation of I by `moment_by_turn`, of that of J by
    /// the opposite.
    pub(crate) fn turn(&mut self, moment_by_turn: &Matrix3<f64>) {
        let turned = self.position * (self.by_reaction.fixed_columns::<3>(3) * moment_by_turn);
        for row in 0..4 {
            for (column, sign) in [(1, 1.0), (3, -1.0)] {
                if self.reach.connects(row, column) {
                    self.add([row, column], &(sign * turned.fixed_rows::<3>(3 * row)));
                }
            }
        }
    }
}

/// The load on the surfaces and its derivatives for a reaction along the axes of J.
struct LoadAt {
    load: Load,
    /// By force and moment along the axes of J.
    by_reaction: [f64; 6],
    /// By the local motions, with those components held.
    by_position: Local,
}

impl FrictionJoint {
    /// Which motions of the bodies its friction depends on, and acts on.
    pub(crate) fn reach(&self) -> Reach {
        let turns = |equation: &Equation| equation.reach() == Reach::Turns;
        if freedoms(self).iter().all(turns) {
            Reach::Turns
        } else {
            Reach::Place
        }
    }
}

/// The equations whose values are the displacements of a joint's freedoms.
fn freedoms(joint: &FrictionJoint) -> &'static [Equation] {
    match joint {
        FrictionJoint::Translational(_) => &[Equation::Along(2)],
        FrictionJoint::Revolute(_) => &[Equation::About(Axis::Z)],
        FrictionJoint::Cylindrical(_) => &[Equation::Along(2), Equation::About(Axis::Z)],
        FrictionJoint::Pin(pin, _) => match pin {
            Pin::HookeI => &[Equation::About(Axis::Pin(Pin::HookeI))],
            Pin::HookeJ => &[Equation::About(Axis::Pin(Pin::HookeJ))],
            Pin::UniversalI => &[Equation::About(Axis::Pin(Pin::UniversalI))],
            Pin::UniversalJ => &[Equation::About(Axis::Pin(Pin::UniversalJ))],
        },
        FrictionJoint::Spherical(_) => &[],
    }
}

/// What is written beside the friction itself, where it is wanted.
#[derive(Default)]
pub(crate) struct Wanted<'a> {
    /// Derivatives, zero so far.
    pub(crate) slopes: Option<&'a mut Slopes>,
    /// What results read.
    pub(crate) values: Option<&'a mut Values>,
}

/// Friction for a reaction along the axes of J.
// Inlined with all that it calls: a caller that wants the force alone must not pay for the derivatives.
#[inline(always)]
pub(crate) fn evaluate(
    friction: &Friction,
    past: &Past<'_>,
    i: &MarkerFrame,
    j: &MarkerFrame,
    force: [f64; 3],
    moment: [f64; 3],
    wanted: Wanted<'_>,
) -> Element {
    let load = load_at(friction, past.memory, i, j, force, moment);
    let equations = freedoms(&friction.load);
    match *equations {
        [equation] => freedoms::one(friction, past, equation, &load, i, j, wanted),
        [along, about] => {
            let equations = [along, about];
            freedoms::cylindrical(friction, past, equations, &load, i, j, wanted)
        }
        _ => spherical::evaluate(friction, past, &load, i, j, wanted),
    }
}

#[inline(always)]
fn load_at(
    friction: &Friction,
    memory: &Memory,
    i: &MarkerFrame,
    j: &MarkerFrame,
    force: [f64; 3],
    moment: [f64; 3],
) -> LoadAt {
    let displaced = || {
        let mut jacobian = Local::zeros();
        let value = Equation::Along(2).evaluate(&Pair::new(i, j), &[], &mut jacobian);
        (value - memory.initial_displacement, jacobian)
    };
    match &friction.load {
        FrictionJoint::Translational(load) => {
            let (displacement, row) = displaced();
            let load = load.evaluate(force, moment, displacement);
            LoadAt::along_j(load, load.by_displacement * row)
        }
        FrictionJoint::Cylindrical(load) => {
            let (displacement, row) = displaced();
            let load = load.evaluate(force, moment, displacement);
            LoadAt::along_j(load, load.by_displacement * row)
        }
        FrictionJoint::Revolute(load) => {
            LoadAt::along_j(load.evaluate(force, moment), Local::zeros())
        }
        FrictionJoint::Spherical(load) => LoadAt::along_j(load.evaluate(force), Local::zeros()),
        FrictionJoint::Pin(pin, load) => LoadAt::about_pin(*pin, load, i, j, force, moment),
    }
}

impl LoadAt {
    /// A load whose derivatives are along the axes of J.
    #[inline(always)]
    fn along_j(load: Load, by_position: Local) -> Self {
        let ([fx, fy, fz], [mx, my, mz]) = (load.by_force, load.by_moment);
        Self {
            load,
            by_reaction: [fx, fy, fz, mx, my, mz],
            by_position,
        }
    }

    /// The load on a pin: that of a revolute joint with the reaction along axes whose z is the pin.
    fn about_pin(
        pin: Pin,
        load: &friction::RevoluteLoad,
        i: &MarkerFrame,
        j: &MarkerFrame,
        force: [f64; 3],
        moment: [f64; 3],
    ) -> Self {
        let (on_i, k) = pin.axis();
        let own = if on_i { i } else { j };
        // Ground axes to axes whose z is the pin.
        let turn =
            Matrix3::from_columns(&[own.axis((k + 1) % 3), own.axis((k + 2) % 3), own.axis(k)])
                .transpose();
        let ground = [force, moment].map(|part| j.axes * Vector3::from(part));
        let [along, about] = ground.map(|part| turn * part);
        let load = load.evaluate(along.into(), about.into());
        let slopes =
            [load.by_force, load.by_moment].map(|slope| turn.transpose() * Vector3::from(slope));
        let mut by_position = Local::zeros();
        if on_i {
            // Along axes fixed to I, what is fixed to J changes by −A_Iᵀ a× (δθ_J − δθ_I).
            for (part, slope) in ground.iter().zip(&slopes) {
                let change = skew(part).tr_mul(slope);
                let mut by_i = by_position.fixed_rows_mut::<3>(3);
                by_i += change;
                let mut by_j = by_position.fixed_rows_mut::<3>(9);
                by_j -= change;
            }
        }
        let [by_force, by_moment] = slopes.map(|slope| j.axes.tr_mul(&slope));
        Self {
            load,
            by_reaction: [
                by_force.x,
                by_force.y,
                by_force.z,
                by_moment.x,
                by_moment.y,
                by_moment.z,
            ],
            by_position,
        }
    }
}

/// Velocity of the sliding surfaces, I against J, by component.
fn surface_velocity(friction: &Friction, i: &MarkerFrame, j: &MarkerFrame) -> [f64; 3] {
    let arm = friction.load.arm();
    let equations = freedoms(&friction.load);
    if equations.is_empty() {
        return (arm * (j.axes.transpose() * (i.omega - j.omega))).into();
    }
    let pair = Pair::new(i, j);
    let u = pair.velocities();
    let mut velocity = [0.0; 3];
    let mut jacobian = Local::zeros();
    for (component, equation) in velocity.iter_mut().zip(equations) {
        equation.evaluate(&pair, &[], &mut jacobian);
        *component = equation.arm(arm) * jacobian.dot(&u);
    }
    velocity
}

impl Equation {
    /// Arm from its value to a displacement of surfaces at a distance of `arm` from the axis.
    fn arm(self, arm: f64) -> f64 {
        if matches!(self, Self::About(_)) {
            arm
        } else {
            1.0
        }
    }
}
