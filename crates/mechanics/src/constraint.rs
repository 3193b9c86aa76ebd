//! The list of scalar constraint equations that a model's joints, motions and functions make.

use crate::equation::{Axis, Equation, Local};
use crate::expression::Input;
use crate::model::{Element, JointKind, Level, Marker, Model, MotionFreedom};
use serde::{Deserialize, Serialize};

/// The element that a constraint equation belongs to, by its place in the model's lists.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash, Serialize, Deserialize)]
pub enum Owner {
    /// A joint or joint primitive.
    Joint(usize),
    /// A motion.
    Motion(usize),
    /// A general constraint.
    General(usize),
}

impl Owner {
    /// The element.
    #[must_use]
    pub fn element(self) -> Element {
        match self {
            Self::Joint(place) => Element::Joint(place),
            Self::Motion(place) => Element::Motion(place),
            Self::General(place) => Element::Constraint(place),
        }
    }
}

/// What a constraint equation is about.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(crate) enum Form {
    /// An equation between two markers, minus the owner's function of time for a motion.
    Pair {
        equation: Equation,
        i: usize,
        j: usize,
    },
    /// The owner's function.
    Function,
}

/// One scalar constraint equation.
#[derive(Clone, Debug)]
pub(crate) struct Constraint {
    pub(crate) owner: Owner,
    pub(crate) form: Form,
    pub(crate) level: Level,
    /// Its place among the equations in force; `None` where it was found redundant.
    pub(crate) row: Option<usize>,
    /// Bodies whose motion it restricts.
    pub(crate) bodies: Vec<usize>,
}

/// A constraint equation at an instant.
#[derive(Clone, Debug, Serialize, Deserialize)]
pub(crate) struct Evaluated {
    /// How far it is from being met, as a displacement; zero for velocity constraints.
    pub(crate) error: f64,
    /// Rate that it prescribes for `G u`.
    pub(crate) rate: f64,
    /// Value that it prescribes for `G u̇`, for a pair without the part `Ġ u` of its markers: see
    /// [`crate::system::System::prescribe_accelerations`].
    pub(crate) unbiased_acceleration: f64,
    /// Bodies of the two markers of a pair; [`GROUND`] is none.
    sides: [u32; 2],
    /// `G` over the local motions of its two markers, for a pair.
    pub(crate) local: Local,
    /// `G` of a function by body, in the order of [`Constraint::bodies`].
    pub(crate) jacobian: Box<[[f64; 6]]>,
}

/// No body, where bodies are told by their places.
const GROUND: u32 = u32::MAX;

impl Evaluated {
    /// Of a constraint on bodies that are yet to be evaluated.
    pub(crate) fn new(constraint: &Constraint, markers: &[Marker]) -> Self {
        let (sides, blocks) = match constraint.form {
            Form::Pair { i, j, .. } => {
                let body = |marker: usize| markers[marker].body.map_or(GROUND, |b| b as u32);
                ([i, j].map(body), 0)
            }
            Form::Function => ([GROUND; 2], constraint.bodies.len()),
        };
        Self {
            error: 0.0,
            rate: 0.0,
            unbiased_acceleration: 0.0,
            sides,
            local: Local::zeros(),
            jacobian: vec![[0.0; 6]; blocks].into(),
        }
    }

    /// `G` by body, in the order of [`Constraint::bodies`].
    pub(crate) fn blocks<'a>(
        &'a self,
        constraint: &'a Constraint,
    ) -> impl Iterator<Item = (usize, &'a [f64; 6])> {
        let local = self.sides.iter().zip(self.local.as_slice().as_chunks().0);
        let pair = local.filter(|(body, _)| **body != GROUND);
        let pair = pair.map(|(body, block)| (*body as usize, block));
        let function = self.jacobian.iter().enumerate();
        pair.chain(function.map(|(k, block)| (constraint.bodies[k], block)))
    }

    /// `G u`.
    pub(crate) fn rate_of(&self, constraint: &Constraint, velocities: &[f64]) -> f64 {
        self.blocks(constraint)
            .map(|(body, row)| {
                row.iter()
                    .zip(&velocities[6 * body..])
                    .map(|(g, u)| g * u)
                    .sum::<f64>()
            })
            .sum()
    }
}

const ORIENTATION: [Equation; 3] = [
    Equation::Axes(2, 0),
    Equation::Axes(2, 1),
    Equation::Axes(0, 1),
];
const POINT: [Equation; 3] = [Equation::Along(0), Equation::Along(1), Equation::Along(2)];

/// The equations of a joint: how many degrees of freedom it removes, and which.
pub(crate) fn equations_of(kind: JointKind) -> Vec<Equation> {
    let parallel = &ORIENTATION[..2];
    let on_axis = &POINT[..2];
    let point = &POINT[..];
    match kind {
        JointKind::Revolute => [point, parallel].concat(),
        JointKind::Translational => [on_axis, &ORIENTATION[..]].concat(),
        JointKind::Cylindrical => [on_axis, parallel].concat(),
        JointKind::Screw { pitch, start } => {
            let about = Axis::Z;
            let thread = Equation::Thread {
                about,
                pitch,
                start,
            };
            [on_axis, parallel, &[thread]].concat()
        }
        JointKind::RackPinion { pitch, start } => vec![Equation::Thread {
            about: Axis::PINION,
            pitch,
            start,
        }],
        JointKind::PointOnCurve { curve } => [0, 1]
            .map(|component| Equation::OnCurve { curve, component })
            .to_vec(),
        JointKind::ConstantVelocity { away } => [point, &[Equation::EvenTurns { away }]].concat(),
        JointKind::Spherical | JointKind::AtPoint => point.to_vec(),
        JointKind::Planar => [parallel, &POINT[2..]].concat(),
        JointKind::Fixed => [point, &ORIENTATION[..]].concat(),
        JointKind::Hooke => [point, &[Equation::Axes(0, 1)]].concat(),
        JointKind::Universal => [point, &[Equation::Axes(2, 2)]].concat(),
        JointKind::Inline => on_axis.to_vec(),
        JointKind::Inplane => vec![Equation::Along(2)],
        JointKind::Orientation => ORIENTATION.to_vec(),
        JointKind::ParallelAxes => parallel.to_vec(),
        JointKind::Perpendicular => vec![Equation::Axes(2, 2)],
    }
}

/// How many pairs of axes a joint keeps co-directed; the equations alone also allow opposite ones.
pub(crate) fn codirected_axes(kind: JointKind) -> &'static [usize] {
    match kind {
        JointKind::Revolute
        | JointKind::Cylindrical
        | JointKind::Screw { .. }
        | JointKind::Planar
        | JointKind::ParallelAxes => &[2],
        JointKind::Translational | JointKind::Fixed | JointKind::Orientation => &[0, 2],
        JointKind::Spherical
        | JointKind::AtPoint
        | JointKind::Hooke
        | JointKind::Universal
        | JointKind::ConstantVelocity { .. }
        | JointKind::RackPinion { .. }
        | JointKind::PointOnCurve { .. }
        | JointKind::Inline
        | JointKind::Inplane
        | JointKind::Perpendicular => &[],
    }
}

/// All equations of a model, in the order of its lists, which is that of their owners.
pub(crate) fn list(model: &Model) -> Vec<Constraint> {
    let mut constraints = Vec::new();
    let body_of = |marker: usize| model.markers[marker].body;
    let mut pair = |owner, level, equation, i, j| {
        let bodies = [body_of(i), body_of(j)].into_iter().flatten().collect();
        let form = Form::Pair { equation, i, j };
        constraints.push(Constraint {
            owner,
            form,
            level,
            row: None,
            bodies,
        });
    };
    for (place, joint) in model.joints.iter().enumerate() {
        for equation in equations_of(joint.kind) {
            pair(
                Owner::Joint(place),
                Level::Position,
                equation,
                joint.i,
                joint.j,
            );
        }
    }
    for (place, motion) in model.motions.iter().enumerate() {
        let equation = match motion.freedom {
            MotionFreedom::Along(axis) => Equation::Along(axis),
            MotionFreedom::AboutZ => Equation::About(Axis::Z),
        };
        pair(
            Owner::Motion(place),
            motion.level,
            equation,
            motion.i,
            motion.j,
        );
    }
    for (place, constraint) in model.constraints.iter().enumerate() {
        let mut bodies: Vec<usize> = constraint
            .function
            .inputs()
            .filter_map(|input| match input {
                Input::Measure(measure) => Some(model.measures[measure]),
                _ => None,
            })
            .flat_map(|measure| measure.markers())
            .filter_map(body_of)
            .collect();
        bodies.sort_unstable();
        bodies.dedup();
        let (owner, form) = (Owner::General(place), Form::Function);
        constraints.push(Constraint {
            owner,
            form,
            level: Level::Position,
            row: None,
            bodies,
        });
    }
    constraints
}

/// The places of an element's equations in such a list.
pub(crate) fn places_of(constraints: &[Constraint], owner: Owner) -> std::ops::Range<usize> {
    let first = constraints.partition_point(|constraint| constraint.owner < owner);
    first..constraints.partition_point(|constraint| constraint.owner <= owner)
}

/// Name of an equation as messages give it: axes of I and J, `Rij` from J's origin to I's.
pub(crate) fn name(form: Form) -> String {
    let axis = |k: usize| ["X", "Y", "Z"][k];
    match form {
        Form::Pair {
            equation: Equation::Along(k),
            ..
        } => format!("Rij.{}j", axis(k)),
        Form::Pair {
            equation: Equation::Axes(k, l),
            ..
        } => format!("{}i.{}j", axis(k), axis(l)),
        Form::Pair {
            equation: Equation::About(_),
            ..
        } => "angle about Zj".to_owned(),
        Form::Pair {
            equation: Equation::Thread { .. },
            ..
        } => "thread along Zj".to_owned(),
        Form::Pair {
            equation: Equation::OnCurve { .. },
            ..
        } => "across the curve".to_owned(),
        Form::Pair {
            equation: Equation::EvenTurns { .. },
            ..
        } => "even turns of Zi and Zj".to_owned(),
        Form::Function => "function".to_owned(),
    }
}
