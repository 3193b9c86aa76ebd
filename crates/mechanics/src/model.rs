//! The mechanical model: what is given, before any equations are numbered.
//!
//! Quantities are in the dataset's units, except that masses and inertias are divided by the unit
//! consistency factor (`Force · UCF = Mass · Acceleration`), so that force = mass · acceleration.
//! Angles are radians. Elements refer to one another by their place in the model's lists.

use serde::{Deserialize, Deserializer, Serialize, Serializer};
use std::collections::BTreeSet;

use nalgebra::{Matrix3, Vector3};

use crate::curve::Curve;
pub use crate::equation::Pin;
use crate::expression::Program;
use crate::measure::Measure;
use crate::rotation::Quaternion;
pub use crate::system_elements::{AlgebraicVariable, Definition, DifferentialState, Form};
pub use friction::{ForceAndTorque, Law};

/// How an element is called in messages: its statement, id and name.
#[derive(Clone, Debug, PartialEq, Eq, Hash)]
pub struct Label {
    /// Statement name, such as `JOINT`.
    pub statement: &'static str,
    /// Id in the dataset.
    pub id: u32,
    /// Name of the object in Adams View, or empty.
    pub name: String,
}

impl<'de> Deserialize<'de> for Label {
    fn deserialize<D: Deserializer<'de>>(deserializer: D) -> Result<Self, D::Error> {
        let (statement, id, name) = Deserialize::deserialize(deserializer)?;
        let statement: String = statement;
        Ok(Self {
            // Kept for good, as the names of the program itself are.
            statement: statement.leak(),
            id,
            name,
        })
    }
}

impl Serialize for Label {
    fn serialize<S: Serializer>(&self, serializer: S) -> Result<S::Ok, S::Error> {
        (self.statement, self.id, &self.name).serialize(serializer)
    }
}

impl std::fmt::Display for Label {
    fn fmt(&self, f: &mut std::fmt::Formatter<'_>) -> std::fmt::Result {
        write!(f, "{}/{}", self.statement, self.id)?;
        if !self.name.is_empty() {
            write!(f, " ({})", self.name)?;
        }
        Ok(())
    }
}

/// A rigid body, or a point mass.
#[derive(Clone, Debug, PartialEq)]
pub struct Body {
    /// How it is called.
    pub label: Label,
    /// Mass divided by the unit consistency factor; zero where the motion is determined.
    pub mass: f64,
    /// Inertia about the centre of mass along part axes, divided by the unit consistency factor.
    pub inertia: Matrix3<f64>,
    /// Centre of mass from the part's origin, part axes.
    pub centre: Vector3<f64>,
    /// Position of the part's origin in ground, as given.
    pub origin: Vector3<f64>,
    /// Orientation of the part, part axes to ground axes, as given.
    pub orientation: Quaternion,
    /// Velocity of the centre of mass, ground axes, as given.
    pub velocity: Vector3<f64>,
    /// Angular velocity, ground axes, as given.
    pub angular_velocity: Vector3<f64>,
    /// Position and rotation components that assembly must not change (x, y, z, then rotation
    /// about the ground axes).
    pub exact: [bool; 6],
    /// Velocity components that were given, and so weigh more than free ones at assembly.
    pub given_velocity: [bool; 6],
    /// False for a point mass, which has a position only.
    pub rotates: bool,
}

/// A frame fixed to a body or to ground.
#[derive(Clone, Debug, PartialEq)]
pub struct Marker {
    /// Id in the dataset.
    pub id: u32,
    /// The body it is fixed to; `None` is ground.
    pub body: Option<usize>,
    /// Origin: from the body's centre of mass along part axes, or in ground.
    pub offset: Vector3<f64>,
    /// Axes: columns along part axes, or ground axes.
    pub axes: Matrix3<f64>,
}

/// The kinds of joints and joint primitives.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum JointKind {
    /// Origins coincide, z axes parallel: turns about z.
    Revolute,
    /// Same orientation, I's origin on the z axis of J: slides along z.
    Translational,
    /// I's origin on the z axis of J, z axes parallel: turns about and slides along z.
    Cylindrical,
    /// Origins coincide.
    Spherical,
    /// I's origin in the xy plane of J, z axes parallel.
    Planar,
    /// Origins and axes coincide.
    Fixed,
    /// As cylindrical, and a thread: I moves along z by `pitch` while it turns about z once.
    Screw {
        /// Length a turn, positive for a right-hand thread.
        pitch: f64,
        /// Displacement of I along z at the angle zero.
        start: f64,
    },
    /// Origins coincide, x of I perpendicular to y of J.
    Hooke,
    /// Origins coincide, z of I perpendicular to z of J.
    Universal,
    /// Origins coincide, and shafts along z of I and z of J turn evenly however they are bent.
    ConstantVelocity {
        /// Whether z of I and z of J point away from one another, so that they turn by opposite
        /// angles.
        away: bool,
    },
    /// A pinion I on a rack J: I moves along z of J by `pitch` while it turns about its own z once
    /// against J. Their other displacements are free.
    RackPinion {
        /// Length a turn.
        pitch: f64,
        /// Displacement of I along z of J where x of I is along z of J.
        start: f64,
    },
    /// I's origin on a curve that is fixed to J; J acts on the point of the curve where I stands.
    PointOnCurve {
        /// Place of the curve in [`Model::curves`].
        curve: usize,
    },
    /// Primitive: origins coincide.
    AtPoint,
    /// Primitive: I's origin on the z axis of J.
    Inline,
    /// Primitive: I's origin in the xy plane of J.
    Inplane,
    /// Primitive: same orientation.
    Orientation,
    /// Primitive: z axes parallel.
    ParallelAxes,
    /// Primitive: z axes perpendicular.
    Perpendicular,
}

/// A displacement and a velocity that assembly has to meet.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct JointStart {
    /// Displacement (length or radians), where given.
    pub displacement: Option<f64>,
    /// Velocity, where given.
    pub velocity: Option<f64>,
}

/// A joint or joint primitive between two markers.
#[derive(Clone, Debug, PartialEq)]
pub struct Joint {
    /// How it is called.
    pub label: Label,
    /// What it locks.
    pub kind: JointKind,
    /// Marker I.
    pub i: usize,
    /// Marker J.
    pub j: usize,
    /// Initial displacement along z of J.
    pub translation_start: JointStart,
    /// Initial rotation about z of J.
    pub rotation_start: JointStart,
}

/// What a motion prescribes.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum MotionFreedom {
    /// Displacement of I from J along an axis of J (0, 1, 2).
    Along(usize),
    /// Rotation of I against J about z of J, from x of J to x of I.
    AboutZ,
}

/// The level at which a motion or constraint is prescribed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Level {
    /// The displacement itself.
    Position,
    /// Its rate.
    Velocity,
    /// Its second derivative.
    Acceleration,
}

/// A displacement, velocity or acceleration prescribed as a function of time.
#[derive(Clone, Debug)]
pub struct Motion {
    /// How it is called.
    pub label: Label,
    /// Marker I.
    pub i: usize,
    /// Marker J.
    pub j: usize,
    /// What is prescribed.
    pub freedom: MotionFreedom,
    /// At which level.
    pub level: Level,
    /// The function; it reads time only.
    pub function: Program,
    /// Displacement and velocity to start from, for the levels that need them.
    pub start: JointStart,
}

/// A constraint `function = 0` on displacements and time.
#[derive(Clone, Debug, PartialEq)]
pub struct GeneralConstraint {
    /// How it is called.
    pub label: Label,
    /// Marker I, at which its reaction acts.
    pub i: Option<usize>,
    /// The other marker that it acts at, where there is just one.
    pub j: Option<usize>,
    /// The function of displacement measures and time.
    pub function: Program,
}

/// How a single-component force acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum ForceKind {
    /// Along the line from J to I, on both, positive apart.
    LineOfSight,
    /// Along z of J, on I only.
    AlongZ,
    /// Torque about z of J on I, the opposite on J.
    AboutZ,
    /// Torque about z of J on I only.
    AboutZActionOnly,
    /// Force along an axis (0, 1, 2) of the marker `frame` on I at its origin, the opposite on the
    /// body of J at the same point.
    AlongAxis {
        /// Marker whose axes give the direction; it may be on any body.
        frame: usize,
        /// Which axis.
        axis: usize,
    },
    /// Torque about an axis (0, 1, 2) of the marker `frame` on I, the opposite on the body of J.
    AboutAxis {
        /// Marker whose axes give the direction; it may be on any body.
        frame: usize,
        /// Which axis.
        axis: usize,
    },
}

impl ForceKind {
    /// Whether the opposite acts on J.
    #[must_use]
    pub fn acts_on_both(self) -> bool {
        !matches!(self, Self::AlongZ | Self::AboutZActionOnly)
    }
}

/// A force or torque with one component given by a function.
#[derive(Clone, Debug)]
pub struct SingleForce {
    /// How it is called.
    pub label: Label,
    /// Marker I.
    pub i: usize,
    /// Marker J.
    pub j: usize,
    /// How it acts.
    pub kind: ForceKind,
    /// Its value: a function of time, displacements and velocities.
    pub function: Program,
}

impl SingleForce {
    /// The marker whose axes give its direction: `frame` of its kind, else J.
    #[must_use]
    pub fn frame(&self) -> usize {
        match self.kind {
            ForceKind::AlongAxis { frame, .. } | ForceKind::AboutAxis { frame, .. } => frame,
            _ => self.j,
        }
    }

    /// Whether J floats, that is stands where I stands: so it does for a component along the axes of
    /// another marker than J.
    #[must_use]
    pub fn j_floats(&self) -> bool {
        self.frame() != self.j
    }
}

/// Which joint geometry turns a reaction into a friction load.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum FrictionJoint {
    /// Sliding along z.
    Translational(friction::TranslationalLoad),
    /// Turning about z.
    Revolute(friction::RevoluteLoad),
    /// Sliding along and turning about z.
    Cylindrical(friction::CylindricalLoad),
    /// Turning about any axis.
    Spherical(friction::SphericalLoad),
    /// Turning about one pin of a hooke or universal joint.
    Pin(Pin, friction::RevoluteLoad),
}

impl FrictionJoint {
    /// Arm that turns an angle into a displacement of the sliding surfaces; one for sliding alone.
    #[must_use]
    pub fn arm(&self) -> f64 {
        match self {
            Self::Translational(_) => 1.0,
            Self::Revolute(load) | Self::Pin(_, load) => load.pin_radius,
            Self::Cylindrical(load) => load.pin_radius,
            Self::Spherical(load) => load.ball_radius,
        }
    }

    /// Whether the load is a force, not a torque.
    #[must_use]
    pub fn has_force_load(&self) -> bool {
        matches!(self, Self::Translational(_) | Self::Cylindrical(_))
    }

    /// Number of components of surface velocity, creep and bristle deflection.
    #[must_use]
    pub fn components(&self) -> usize {
        match self {
            Self::Translational(_) | Self::Revolute(_) | Self::Pin(..) => 1,
            Self::Cylindrical(_) => 2,
            Self::Spherical(_) => 3,
        }
    }
}

/// Friction in a joint.
#[derive(Clone, Debug, PartialEq)]
pub struct Friction {
    /// How it is called.
    pub label: Label,
    /// The joint, by its place in [`Model::joints`].
    pub joint: usize,
    /// The law.
    pub law: Law,
    /// The load on the sliding surfaces.
    pub load: FrictionJoint,
    /// Friction that acts without load, zero where switched off.
    pub preload: ForceAndTorque,
    /// Limit of the part of the friction that the load causes.
    pub maximum: ForceAndTorque,
    /// Whether it is left out of static solutions.
    pub inactive_static: bool,
}

impl Friction {
    /// A load of its joint as a force at the sliding surfaces.
    #[must_use]
    pub fn surface_load(&self, load: &friction::Load) -> f64 {
        if self.load.has_force_load() {
            load.value
        } else {
            load.value / self.load.arm()
        }
    }
}

/// An element by its place in the lists of a [`Model`].
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord)]
pub enum Element {
    /// A joint or joint primitive.
    Joint(usize),
    /// A motion.
    Motion(usize),
    /// A general constraint.
    Constraint(usize),
    /// A single-component force or spring-damper.
    Force(usize),
    /// A friction.
    Friction(usize),
}

/// Which reactions constraints have that depend on one another: the motion leaves them open.
#[derive(Clone, Copy, Debug, Default, PartialEq, Serialize, Deserialize)]
pub enum Reactions {
    /// Those without the equations that are dropped as redundant, whose own are zero. Which are dropped
    /// is arbitrary, and so are the reactions.
    #[default]
    OfKept,
    /// The least of all that give the same motion: the sum of their squares is least, of forces along the
    /// axes of constraints and of torques divided by a length. So share equally stiff joints, in the limit
    /// of large stiffness, whose stiffness against rotation is that against displacement times the square
    /// of the length. (A general constraint counts with the largest force that it applies to a body,
    /// torques about the centre of mass divided by the length.)
    ///
    /// Wojtyra and Frączek, *Comparison of selected methods of handling redundant constraints in multibody
    /// systems simulations*, Journal of Computational and Nonlinear Dynamics 8, 2013.
    LeastSquares {
        /// The length, in the model's unit; where there is none that of the model,
        /// [`System::length_scale`](crate::System::length_scale).
        length: Option<f64>,
    },
}

/// The whole model.
#[derive(Clone, Debug, Default)]
pub struct Model {
    /// Moving bodies.
    pub bodies: Vec<Body>,
    /// Frames on them and on ground.
    pub markers: Vec<Marker>,
    /// Joints and joint primitives.
    pub joints: Vec<Joint>,
    /// Curves that points move along.
    pub curves: Vec<Curve>,
    /// Motions.
    pub motions: Vec<Motion>,
    /// General constraints.
    pub constraints: Vec<GeneralConstraint>,
    /// Single-component forces and spring-dampers.
    pub forces: Vec<SingleForce>,
    /// Friction in joints.
    pub frictions: Vec<Friction>,
    /// Differential equations.
    pub states: Vec<DifferentialState>,
    /// Unknowns that follow from everything else.
    pub algebraics: Vec<AlgebraicVariable>,
    /// Quantities that functions read.
    pub measures: Vec<Measure>,
    /// Reactions of constraints that depend on one another.
    pub reactions: Reactions,
    /// Elements that rest; a friction rests with its joint.
    pub inactive: BTreeSet<Element>,
    /// Acceleration of gravity, ground axes.
    pub gravity: Vector3<f64>,
}

impl Model {
    /// Whether bodies, constraints and frictions are those of another model. Motions may differ in what
    /// they prescribe, and forces and system elements in all.
    pub(crate) fn is_mechanism_of(&self, other: &Self) -> bool {
        fn parts(model: &Model) -> impl PartialEq + '_ {
            (
                (&model.bodies, &model.markers, &model.joints, &model.curves),
                (&model.constraints, &model.frictions),
                (&model.reactions, &model.inactive),
            )
        }
        parts(self) == parts(other)
    }

    /// Whether an element acts.
    #[must_use]
    pub fn is_active(&self, element: Element) -> bool {
        let rests = |element| self.inactive.contains(&element);
        match element {
            Element::Friction(place) => {
                !(rests(element) || rests(Element::Joint(self.frictions[place].joint)))
            }
            _ => !rests(element),
        }
    }
}
