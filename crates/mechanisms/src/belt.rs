//! Stick and slip: a block held by a spring on a belt, and one drawn by a spring over a table.

use mechanics::expression::{Binary, Input, Operation, Program};
use mechanics::measure::Quantity;
use mechanics::model::{ForceKind, FrictionJoint, JointKind, Law, Level, Model, MotionFreedom};
use nalgebra::{Matrix3, Vector3};

use crate::builder::{Builder, axes_with_z, v};
use crate::law;
use crate::sliding::Block;

/// A block on a belt that runs along x, held by a spring to ground; it starts with the belt.
#[derive(Clone, Copy, Debug)]
pub struct Belt {
    /// Mass of the block.
    pub mass: f64,
    /// Acceleration of gravity.
    pub gravity: f64,
    /// Stiffness of the spring.
    pub stiffness: f64,
    /// Velocity of the belt.
    pub speed: f64,
    /// Velocity of the block at the start.
    pub start: f64,
}

impl Belt {
    /// Block 0 and belt 1, with friction by `law` between them.
    pub fn model(&self, law: impl Into<Law>) -> Model {
        let mut b = Builder::new(v(0.0, -self.gravity, 0.0));
        let block = b.body(self.mass, [0.02; 3], Vector3::zeros());
        let belt = b.body(1.0, [0.02; 3], Vector3::zeros());
        let x = Vector3::x();
        let slides =
            |b: &mut Builder, i, j| b.joint(JointKind::Translational, i, j, Vector3::zeros(), x);
        let contact = slides(&mut b, Some(block), Some(belt));
        let guide = slides(&mut b, Some(belt), None);
        b.drive(guide, MotionFreedom::Along(2), Level::Position, self.speed);
        for (body, velocity) in [(block, self.start), (belt, self.speed)] {
            b.model.bodies[body].velocity = v(velocity, 0.0, 0.0);
            b.model.bodies[body].given_velocity = [true; 6];
        }
        let i = b.marker(Some(block), Vector3::zeros(), Matrix3::identity());
        let j = b.marker(None, v(-10.0, 0.0, 0.0), Matrix3::identity());
        b.spring(i, j, self.stiffness, 10.0);
        b.friction(contact, law, sliding());
        b.model
    }
}

/// The load of a guide by its reaction force alone.
fn sliding() -> FrictionJoint {
    FrictionJoint::Translational(Block::new(law(1.0, 1.0, 1.0, 1.0)).load)
}

/// A block of 1 kg that weighs 1 N on a table, drawn along x by a spring of 2 N/m whose other end moves
/// at 0.1 m/s (Canudas de Wit, Olsson, Åström & Lischinsky, *A new model for control of systems with
/// friction*, IEEE Transactions on Automatic Control 40(3), 1995, section IV-B). With the weight of one
/// the coefficients of friction are the forces of that paper.
#[must_use]
pub fn drawn_block(law: impl Into<Law>) -> Model {
    let mut b = Builder::new(v(0.0, -1.0, 0.0));
    let block = b.body(1.0, [0.02; 3], Vector3::zeros());
    let x = Vector3::x();
    let guide = b.joint(
        JointKind::Translational,
        Some(block),
        None,
        Vector3::zeros(),
        x,
    );
    b.friction(guide, law, sliding());
    let [i, j] = [Some(block), None].map(|on| b.marker(on, Vector3::zeros(), axes_with_z(x)));
    let place = b.measure(Quantity::Displacement(2), i, j);
    let mut force = Program::default();
    let time = force.push(Operation::Input(Input::Time));
    let speed = force.push(Operation::Constant(0.1));
    let end = force.push(Operation::Binary(Binary::Multiply, speed, time));
    let now = force.push(Operation::Input(Input::Measure(place)));
    let stretch = force.push(Operation::Binary(Binary::Subtract, end, now));
    let stiffness = force.push(Operation::Constant(2.0));
    force.push(Operation::Binary(Binary::Multiply, stiffness, stretch));
    b.force(ForceKind::AlongZ, i, j, force);
    b.model
}
