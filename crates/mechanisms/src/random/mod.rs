//! Random mechanisms: trees with loops, of 2 to 30 bodies, all kinds of joints, friction in every
//! second mechanism, parameters over four decades; the same from the same seed.
//!
//! A mechanism has a typical length and mass, each over four decades, and weight, or in one of eight
//! none. Bodies are random bricks, masses again over four decades. Each hangs on one before it or on
//! ground; some come three at a time as a planar four-bar or a rack with its pinion. Then come joints
//! that close loops, springs, dampers, torques, motions and velocities. Nothing is made to fit: joints
//! may lock the mechanism, contradict one another further on, or jam.

mod friction;
mod joints;
mod numbers;

use mechanics::expression::Program;
use mechanics::model::{ForceKind, JointKind, Level, Model, MotionFreedom};
use mechanics::rotation::Quaternion;
use nalgebra::{Matrix3, Vector3};

use crate::builder::{Builder, On, axes_with_z};
use numbers::Numbers;

/// Gravity, where there is any.
const GRAVITY: f64 = 9.81;

/// A random mechanism and how long to run it.
#[derive(Clone, Debug)]
pub struct RandomMechanism {
    /// The mechanism.
    pub model: Model,
    /// End of the run, some swings of a pendulum of its length.
    pub end: f64,
}

/// The typical quantities of a mechanism.
#[derive(Clone, Copy, Debug)]
struct Units {
    length: f64,
    mass: f64,
    /// Of a swing.
    time: f64,
}

impl Units {
    fn force(self) -> f64 {
        self.mass * self.length / self.time.powi(2)
    }
}

/// What is being drawn up.
struct Draft {
    numbers: Numbers,
    units: Units,
    b: Builder,
    /// A point far from the joint that each body hangs on, where others may hang.
    ends: Vec<Vector3<f64>>,
}

/// The mechanism of a seed. Seeds of odd number have friction.
///
/// ```
/// let mechanism = mechanisms::random(7);
/// assert!((2..=30).contains(&mechanism.model.bodies.len()));
/// assert!(!mechanism.model.frictions.is_empty());
/// assert_eq!(mechanism.end, mechanisms::random(7).end);
/// ```
#[must_use]
pub fn random(seed: u64) -> RandomMechanism {
    let mut numbers = Numbers::new(seed);
    let (length, mass) = (numbers.decades(-2.0, 2.0), numbers.decades(-2.0, 2.0));
    let time = (length / GRAVITY).sqrt();
    let units = Units { length, mass, time };
    let weight = if numbers.chance(0.125) { 0.0 } else { GRAVITY };
    let down = numbers.direction();
    let mut draft = Draft {
        numbers,
        units,
        b: Builder::new(weight * down),
        ends: Vec::new(),
    };
    let count = draft.numbers.decades(2f64.log10(), 30.99f64.log10()) as usize;
    while draft.ends.len() < count {
        let left = count - draft.ends.len();
        match draft.numbers.between(0.0, 1.0) {
            p if p < 0.08 && left >= 3 => draft.four_bar(),
            p if p < 0.12 && left >= 3 => draft.rack(),
            _ => draft.branch(),
        }
    }
    let tree = draft.b.model.joints.len();
    for _ in 0..draft.numbers.below(2 + count / 4) {
        draft.close_loop();
    }
    for _ in 0..draft.numbers.below(2 + count / 2) {
        draft.spring();
    }
    if draft.numbers.chance(0.3) {
        draft.torque();
    }
    if draft.numbers.chance(0.3) {
        draft.motion(tree);
    }
    if draft.numbers.chance(0.6) {
        draft.velocities();
    }
    if seed % 2 == 1 {
        draft.frictions();
    }
    let end = time * draft.numbers.decades(-0.5, 0.5);
    RandomMechanism {
        model: draft.b.model,
        end,
    }
}

impl Draft {
    /// A body or ground to hang something on, and where.
    fn place(&mut self) -> (On, Vector3<f64>) {
        if self.ends.is_empty() || self.numbers.chance(0.15) {
            let far = self.units.length * self.numbers.between(0.0, 2.0);
            return (None, far * self.numbers.direction());
        }
        let body = self.numbers.below(self.ends.len());
        (Some(body), self.ends[body])
    }

    /// A brick in a random orientation, from a joint at `from` on.
    fn brick(&mut self, from: Vector3<f64>, along: Vector3<f64>, length: f64) -> usize {
        let mass = self.units.mass * self.numbers.decades(-2.0, 2.0);
        let sides = [0; 3].map(|_| length * self.numbers.decades(-1.0, 0.0));
        let square = sides.map(|side| side * side);
        let moments = [1, 2, 0].map(|k| mass / 12.0 * (square[k] + square[(k + 1) % 3]));
        let turn = self.numbers.between(0.0, 3.0) * self.numbers.direction();
        let body = self.b.turned_body(
            mass,
            Matrix3::from_diagonal(&Vector3::from(moments)),
            from + 0.5 * length * along,
            Quaternion::exp(&turn),
        );
        self.ends.push(from + length * along);
        body
    }

    fn length(&mut self) -> f64 {
        self.units.length * self.numbers.decades(-0.5, 0.5)
    }

    /// One more body on a joint.
    fn branch(&mut self) {
        let (parent, at) = self.place();
        let (along, length) = (self.numbers.direction(), self.length());
        let body = self.brick(at, along, length);
        let kind = self.numbers.choose(&joints::OF_TREES);
        self.add_joint(kind, body, parent, at);
    }

    /// A planar four-bar, three of whose equations are redundant.
    fn four_bar(&mut self) {
        let (parent, at) = self.place();
        let normal = self.numbers.direction();
        let axes = axes_with_z(normal);
        let length = self.length();
        let corner = |x: f64, y: f64| at + length * (x * axes.column(0) + y * axes.column(1));
        let corners = [
            at,
            corner(0.0, self.numbers.between(0.3, 1.0)),
            corner(
                self.numbers.between(0.5, 2.0),
                self.numbers.between(0.5, 1.5),
            ),
            corner(self.numbers.between(0.8, 1.8), 0.0),
        ];
        let mut before = parent;
        for pair in corners.windows(2) {
            let rod = pair[1] - pair[0];
            let body = self.brick(pair[0], rod.normalize(), rod.norm());
            self.b
                .joint(JointKind::Revolute, Some(body), before, pair[0], normal);
            before = Some(body);
        }
        self.b
            .joint(JointKind::Revolute, before, parent, corners[3], normal);
    }

    /// A rack and a pinion on one more body.
    fn rack(&mut self) {
        let (parent, at) = self.place();
        let (along, length) = (self.numbers.direction(), self.length());
        let carrier = Some(self.brick(at, along, length));
        let hinge = self.numbers.direction();
        self.b
            .joint(JointKind::Revolute, carrier, parent, at, hinge);
        let axes = axes_with_z(self.numbers.direction());
        let (slide, axle) = (axes.column(0).into_owned(), axes.column(2).into_owned());
        let (rack, pinion) = (
            Some(self.brick(at, slide, length)),
            Some(self.brick(at, axle, 0.3 * length)),
        );
        self.b
            .joint(JointKind::Translational, rack, carrier, at, slide);
        self.b.joint(JointKind::Revolute, pinion, carrier, at, axle);
        // x of the pinion along z of the rack is where the displacement of both is zero.
        let i = Matrix3::from_columns(&[slide, axle.cross(&slide), axle]);
        let i = self.b.marker(pinion, at, i);
        let j = self.b.marker(rack, at, axes_with_z(slide));
        let pitch = length * self.numbers.between(0.3, 1.0);
        let kind = JointKind::RackPinion { pitch, start: 0.0 };
        self.b.joint_of_markers(kind, i, j);
    }

    /// A joint between two bodies, or one body and ground, that may have other ways between them.
    fn close_loop(&mut self) {
        let body = self.numbers.below(self.ends.len());
        let (other, place) = self.place();
        if other == Some(body) {
            return;
        }
        let at = 0.5 * (place + self.ends[body]);
        let kind = self.numbers.choose(&joints::OF_LOOPS);
        self.add_joint(kind, body, other, at);
    }

    /// A spring, half of them with a damper.
    fn spring(&mut self) {
        let body = self.numbers.below(self.ends.len());
        let (other, place) = self.place();
        let from = self.b.model.bodies[body].origin;
        let length = (place - from).norm();
        if other == Some(body) || length < 0.1 * self.units.length {
            return;
        }
        let (mass, time) = (self.units.mass, self.units.time);
        let stiffness = mass / time.powi(2) * self.numbers.decades(-2.0, 2.0);
        let damping = if self.numbers.chance(0.5) {
            (stiffness * mass).sqrt() * self.numbers.decades(-2.0, 0.0)
        } else {
            0.0
        };
        let i = self.b.marker(Some(body), from, Matrix3::identity());
        let j = self.b.marker(other, place, Matrix3::identity());
        let free = length * self.numbers.between(0.7, 1.3);
        self.b.spring_damper(i, j, stiffness, damping, free);
    }

    /// A constant torque between a body and another one.
    fn torque(&mut self) {
        let body = self.numbers.below(self.ends.len());
        let (other, place) = self.place();
        let axes = axes_with_z(self.numbers.direction());
        let i = self.b.marker(Some(body), place, axes);
        let j = self.b.marker(other, place, axes);
        let (force, length) = (self.units.force(), self.units.length);
        let torque = Program::constant(force * length * self.numbers.decades(-2.0, 0.0));
        self.b.force(ForceKind::AboutZ, i, j, torque);
    }

    /// A motion in one of the first `tree` joints.
    fn motion(&mut self, tree: usize) {
        let joint = self.numbers.below(tree);
        let (time, length) = (self.units.time, self.units.length);
        let rate = self.numbers.decades(-1.0, 0.5) / time;
        let (freedom, rate) = match self.b.model.joints[joint].kind {
            JointKind::Revolute | JointKind::Cylindrical => (MotionFreedom::AboutZ, rate),
            JointKind::Translational => (MotionFreedom::Along(2), length * rate),
            _ => return,
        };
        let (level, rate) = self.numbers.choose(&[
            (2.0, (Level::Position, rate)),
            (1.0, (Level::Velocity, rate)),
            (1.0, (Level::Acceleration, rate / time)),
        ]);
        self.b.drive(joint, freedom, level, rate);
    }

    /// Velocities of all bodies, of which assembly leaves what the joints allow.
    fn velocities(&mut self) {
        let (time, length) = (self.units.time, self.units.length);
        let rate = self.numbers.decades(-1.0, 0.7) / time;
        for body in 0..self.ends.len() {
            let turn = rate * self.numbers.between(0.0, 1.0);
            let speed = length * rate * self.numbers.between(0.0, 1.0);
            let (omega, velocity) = (self.numbers.direction(), self.numbers.direction());
            let body = &mut self.b.model.bodies[body];
            body.angular_velocity = turn * omega;
            body.velocity = speed * velocity;
            body.given_velocity = [true; 6];
        }
    }
}
