//! Models written down in ground axes: bodies where they stand, markers where they are. Lengths,
//! masses and forces are in consistent units.

use mechanics::expression::{Binary, Input, Operation, Program};
use mechanics::measure::{Measure, Quantity};
use mechanics::model::{
    Body, ForceAndTorque, ForceKind, Friction, FrictionJoint, Joint, JointKind, JointStart, Label,
    Law, Level, Marker, Model, Motion, MotionFreedom, SingleForce,
};
use mechanics::rotation::Quaternion;
use nalgebra::{Matrix3, Vector3};

/// The vector with these components.
#[must_use]
pub fn v(x: f64, y: f64, z: f64) -> Vector3<f64> {
    Vector3::new(x, y, z)
}

/// Axes with z along `z`; x is the ground axis most perpendicular to it, made perpendicular.
#[must_use]
pub fn axes_with_z(z: Vector3<f64>) -> Matrix3<f64> {
    let z = z.normalize();
    let least = (0..3).fold(0, |b, k| if z[k].abs() < z[b].abs() { k } else { b });
    let mut x = Vector3::zeros();
    x[least] = 1.0;
    let x = (x - x.dot(&z) * z).normalize();
    Matrix3::from_columns(&[x, z.cross(&x), z])
}

/// A body by its place in the model, or ground.
pub type On = Option<usize>;

/// A model that is being written down.
#[derive(Clone, Debug, Default)]
pub struct Builder {
    /// What there is so far.
    pub model: Model,
}

impl Builder {
    /// An empty model with this acceleration of gravity.
    #[must_use]
    pub fn new(gravity: Vector3<f64>) -> Self {
        Self {
            model: Model {
                gravity,
                ..Model::default()
            },
        }
    }

    fn label(statement: &'static str, count: usize) -> Label {
        Label {
            statement,
            id: count as u32 + 1,
            name: String::new(),
        }
    }

    /// A body at rest with its centre of mass at `centre`, part axes `orientation`.
    pub fn turned_body(
        &mut self,
        mass: f64,
        inertia: Matrix3<f64>,
        centre: Vector3<f64>,
        orientation: Quaternion,
    ) -> usize {
        self.model.bodies.push(Body {
            label: Self::label("PART", self.model.bodies.len()),
            mass,
            inertia,
            centre: Vector3::zeros(),
            origin: centre,
            orientation,
            velocity: Vector3::zeros(),
            angular_velocity: Vector3::zeros(),
            exact: [false; 6],
            given_velocity: [false; 6],
            rotates: true,
        });
        self.model.bodies.len() - 1
    }

    /// A body at rest with principal inertia along ground axes.
    pub fn body(&mut self, mass: f64, inertia: [f64; 3], centre: Vector3<f64>) -> usize {
        let inertia = Matrix3::from_diagonal(&Vector3::from(inertia));
        self.turned_body(mass, inertia, centre, Quaternion::IDENTITY)
    }

    /// A uniform thin rod from `a` to `b`, without inertia about its own axis.
    pub fn rod(&mut self, mass: f64, a: Vector3<f64>, b: Vector3<f64>) -> usize {
        self.rod_with_axial_inertia(mass, 0.0, a, b)
    }

    /// A uniform thin rod from `a` to `b` with this inertia about its own axis.
    pub fn rod_with_axial_inertia(
        &mut self,
        mass: f64,
        axial: f64,
        a: Vector3<f64>,
        b: Vector3<f64>,
    ) -> usize {
        let d = b - a;
        let along = d * d.transpose();
        let across = mass / 12.0 * (d.norm_squared() * Matrix3::identity() - along);
        let inertia = across + axial / d.norm_squared() * along;
        self.turned_body(mass, inertia, 0.5 * (a + b), Quaternion::IDENTITY)
    }

    /// Gives a body the velocities of a rotation `omega` about the point `about`.
    pub fn spin(&mut self, body: usize, omega: Vector3<f64>, about: Vector3<f64>) {
        let body = &mut self.model.bodies[body];
        body.velocity = omega.cross(&(body.origin - about));
        body.angular_velocity = omega;
        body.given_velocity = [true; 6];
    }

    /// A marker at `at` with the given axes, both in ground as the bodies stand.
    pub fn marker(&mut self, on: On, at: Vector3<f64>, axes: Matrix3<f64>) -> usize {
        let (offset, axes) = match on {
            None => (at, axes),
            Some(body) => {
                let body = &self.model.bodies[body];
                let to_part = body.orientation.matrix().transpose();
                (to_part * (at - body.origin), to_part * axes)
            }
        };
        let id = self.model.markers.len() as u32 + 1;
        self.model.markers.push(Marker {
            id,
            body: on,
            offset,
            axes,
        });
        self.model.markers.len() - 1
    }

    /// A joint between markers that coincide at `at` with z along `z`.
    pub fn joint(
        &mut self,
        kind: JointKind,
        i: On,
        j: On,
        at: Vector3<f64>,
        z: Vector3<f64>,
    ) -> usize {
        let axes = axes_with_z(z);
        let i = self.marker(i, at, axes);
        let j = self.marker(j, at, axes);
        self.joint_of_markers(kind, i, j)
    }

    /// A joint between markers as they are.
    pub fn joint_of_markers(&mut self, kind: JointKind, i: usize, j: usize) -> usize {
        self.model.joints.push(Joint {
            label: Self::label("JOINT", self.model.joints.len()),
            kind,
            i,
            j,
            translation_start: JointStart::default(),
            rotation_start: JointStart::default(),
        });
        self.model.joints.len() - 1
    }

    /// A revolute joint about z through `at`.
    pub fn pin(&mut self, i: On, j: On, at: Vector3<f64>) -> usize {
        self.joint(JointKind::Revolute, i, j, at, Vector3::z())
    }

    /// Starts a joint with an angular velocity of I against J about z of J.
    pub fn start_turning(&mut self, joint: usize, omega: f64) {
        self.model.joints[joint].rotation_start.velocity = Some(omega);
    }

    /// A quantity for functions to read, along the axes of J.
    pub fn measure(&mut self, quantity: Quantity, i: usize, j: usize) -> usize {
        self.model.measures.push(Measure {
            quantity,
            i,
            j,
            k: j,
            l: j,
        });
        self.model.measures.len() - 1
    }

    /// A force or torque with one component.
    pub fn force(&mut self, kind: ForceKind, i: usize, j: usize, function: Program) {
        let label = Self::label("SFORCE", self.model.forces.len());
        self.model.forces.push(SingleForce {
            label,
            i,
            j,
            kind,
            function,
        });
    }

    /// A constant torque about `axis` on a body alone.
    pub fn torque(&mut self, body: usize, axis: Vector3<f64>, torque: f64) {
        let at = self.model.bodies[body].origin;
        let i = self.marker(Some(body), at, axes_with_z(axis));
        let j = self.marker(None, at, axes_with_z(axis));
        self.force(ForceKind::AboutZActionOnly, i, j, Program::constant(torque));
    }

    /// A spring between two points that pushes them to the distance `length`.
    pub fn spring(&mut self, i: usize, j: usize, stiffness: f64, length: f64) {
        self.spring_damper(i, j, stiffness, 0.0, length);
    }

    /// A spring and a damper between two points; without damping it reads no rate.
    pub fn spring_damper(&mut self, i: usize, j: usize, stiffness: f64, damping: f64, length: f64) {
        let distance = self.measure(Quantity::Distance, i, j);
        let mut force = Program::default();
        let free = force.push(Operation::Constant(length));
        let now = force.push(Operation::Input(Input::Measure(distance)));
        let short = force.push(Operation::Binary(Binary::Subtract, free, now));
        let stiffness = force.push(Operation::Constant(stiffness));
        let push = force.push(Operation::Binary(Binary::Multiply, stiffness, short));
        if damping != 0.0 {
            let rate = self.measure(Quantity::SeparationRate, i, j);
            let rate = force.push(Operation::Input(Input::Measure(rate)));
            let damping = force.push(Operation::Constant(damping));
            let damped = force.push(Operation::Binary(Binary::Multiply, damping, rate));
            force.push(Operation::Binary(Binary::Subtract, push, damped));
        }
        self.force(ForceKind::LineOfSight, i, j, force);
    }

    /// A motion at a joint's markers whose function is `rate · time` (position), or `rate`.
    pub fn drive(&mut self, joint: usize, freedom: MotionFreedom, level: Level, rate: f64) {
        let mut function = Program::constant(rate);
        if level == Level::Position {
            let time = function.push(Operation::Input(Input::Time));
            function.push(Operation::Binary(Binary::Multiply, 0, time));
        }
        let joint = &self.model.joints[joint];
        self.model.motions.push(Motion {
            label: Self::label("MOTION", self.model.motions.len()),
            i: joint.i,
            j: joint.j,
            freedom,
            level,
            function,
            start: JointStart::default(),
        });
    }

    /// Friction in a joint, without preload and limit.
    pub fn friction(&mut self, joint: usize, law: impl Into<Law>, load: FrictionJoint) {
        let label = Self::label("FRICTION", self.model.frictions.len());
        self.model.frictions.push(Friction {
            label,
            joint,
            law: law.into(),
            load,
            preload: ForceAndTorque::both(0.0),
            maximum: ForceAndTorque::both(1e40),
            inactive_static: false,
        });
    }
}
