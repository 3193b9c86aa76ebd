//! MOTION and GCON to motions and general constraints.

use dataset::{Code, Motion, MotionDirection, MotionLevel, MotionTarget};
use mechanics::Owner;
use mechanics::expression::{Binary, Input, Operation, Program};
use mechanics::model::{self, GeneralConstraint, JointKind, JointStart, Level, MotionFreedom};

use super::expression::{Compiler, Reads};
use super::{Lowering, label};

/// Sine of the angle below which two axes count as parallel: datasets carry six digits or more.
const PARALLEL: f64 = 1e-5;

impl Lowering<'_> {
    /// General constraints in the order of the dataset.
    pub(super) fn constraints(&mut self, model: &mut model::Model) {
        let dataset = self.dataset;
        for constraint in &dataset.constraints {
            let function = self.function(
                constraint,
                "GCON",
                Reads::Displacements,
                &constraint.function,
            );
            if let Some(function) = function {
                let i = constraint.i.map(|i| self.marker_place(i));
                let j = self.other_marker(&function, i);
                let label = label("GCON", &constraint.header);
                model.constraints.push(GeneralConstraint {
                    label,
                    i,
                    j,
                    function,
                });
            }
        }
    }

    /// Motions. A body-fixed angle that is prescribed becomes a general constraint.
    pub(super) fn motions(&mut self, model: &mut model::Model) {
        let dataset = self.dataset;
        for motion in &dataset.motions {
            let place = self.motion(model, motion);
            self.motions.push(place);
        }
    }

    /// Adds a motion; returns what it has become.
    fn motion(&mut self, model: &mut model::Model, motion: &Motion) -> Option<Owner> {
        let (i, j, freedom) = match motion.target {
            MotionTarget::JointRotation(joint) => {
                let joint = self.dataset.joints.by_id(joint)?;
                (joint.i, joint.j, MotionFreedom::AboutZ)
            }
            MotionTarget::JointTranslation(joint) => {
                let joint = self.dataset.joints.by_id(joint)?;
                (joint.i, joint.j, MotionFreedom::Along(2))
            }
            MotionTarget::Markers { i, j, direction } => {
                let freedom = match direction {
                    MotionDirection::X => MotionFreedom::Along(0),
                    MotionDirection::Y => MotionFreedom::Along(1),
                    MotionDirection::Z => MotionFreedom::Along(2),
                    MotionDirection::B1 => return self.body_angle(model, motion, 0, i, j),
                    MotionDirection::B2 => return self.body_angle(model, motion, 1, i, j),
                    MotionDirection::B3 => return self.body_angle(model, motion, 2, i, j),
                };
                (i, j, freedom)
            }
        };
        self.along_or_about(model, motion, i, j, freedom)
    }

    fn along_or_about(
        &mut self,
        model: &mut model::Model,
        motion: &Motion,
        i: u32,
        j: u32,
        freedom: MotionFreedom,
    ) -> Option<Owner> {
        let function = self.function(motion, "MOTION", Reads::Time, &motion.function)?;
        model.motions.push(model::Motion {
            label: label("MOTION", &motion.header),
            i: self.marker_place(i),
            j: self.marker_place(j),
            freedom,
            level: level(motion.level),
            function,
            start: JointStart {
                displacement: motion.ic_displacement,
                velocity: motion.ic_velocity,
            },
        });
        Some(Owner::Motion(model.motions.len() - 1))
    }

    /// A motion of the body-fixed 1-2-3 angle `n`.
    fn body_angle(
        &mut self,
        model: &mut model::Model,
        motion: &Motion,
        n: usize,
        i: u32,
        j: u32,
    ) -> Option<Owner> {
        let name = format!("MOTION/{}", motion.header.id);
        if n == 2 && self.turns_about_z(model, i, j) {
            // The third angle is then the rotation about z itself.
            return self.along_or_about(model, motion, i, j, MotionFreedom::AboutZ);
        }
        if motion.level != MotionLevel::Displacement {
            self.error(
                Code::UnsupportedArgument,
                motion.header.span,
                format!(
                    "{name}: velocities and accelerations of body-fixed angles are\
                     not simulated"
                ),
                Some(
                    "B3 is simulated where a joint between the same parts keeps the z axes of I \
                     and J parallel; else give the angle itself (DISPLACEMENT)",
                ),
            );
            return None;
        }
        let mut compiler = Compiler::new(Reads::Time);
        let wanted = compiler.add(self, &name, &motion.function).ok()?;
        let (i, j) = (self.marker_place(i), self.marker_place(j));
        let measure = self.measures.body_123(n, i, j, self.ground);
        let angle = compiler
            .program
            .push(Operation::Input(Input::Measure(measure)));
        compiler
            .program
            .push(Operation::Binary(Binary::Subtract, angle, wanted));
        let function: Program = compiler.program;
        let label = label("MOTION", &motion.header);
        model.constraints.push(GeneralConstraint {
            label,
            i: Some(i),
            j: Some(j),
            function,
        });
        Some(Owner::General(model.constraints.len() - 1))
    }

    /// The marker that a function reads beside `i` and the ground's, where it is just one.
    fn other_marker(&self, function: &Program, i: Option<usize>) -> Option<usize> {
        let mut others: Vec<usize> = function
            .inputs()
            .filter_map(|input| match input {
                Input::Measure(measure) => Some(self.measures.get(measure)),
                _ => None,
            })
            .flat_map(|measure| [measure.i, measure.j])
            .filter(|&marker| Some(marker) != i && marker != self.ground)
            .collect();
        others.sort_unstable();
        others.dedup();
        match others[..] {
            [j] => Some(j),
            _ => None,
        }
    }

    /// Whether a joint between the same parts keeps the z axes of two markers parallel, so that
    /// the third body-fixed angle is the rotation about z.
    fn turns_about_z(&self, model: &model::Model, i: u32, j: u32) -> bool {
        let (i, j) = (self.marker_place(i), self.marker_place(j));
        let z = |marker: usize| model.markers[marker].axes.column(2).into_owned();
        let body = |marker: usize| model.markers[marker].body;
        let parallel = |a: usize, b: usize| z(a).cross(&z(b)).norm() < PARALLEL;
        model.joints.iter().any(|joint| {
            use JointKind as K;
            let aligned = matches!(
                joint.kind,
                K::Revolute | K::Cylindrical | K::Planar | K::ParallelAxes
            );
            let ends = if body(joint.i) == body(i) {
                [joint.i, joint.j]
            } else {
                [joint.j, joint.i]
            };
            aligned
                && body(ends[0]) == body(i)
                && body(ends[1]) == body(j)
                && parallel(ends[0], i)
                && parallel(ends[1], j)
        })
    }
}

fn level(level: MotionLevel) -> Level {
    match level {
        MotionLevel::Displacement => Level::Position,
        MotionLevel::Velocity => Level::Velocity,
        MotionLevel::Acceleration => Level::Acceleration,
    }
}
