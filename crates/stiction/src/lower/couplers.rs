//! COUPLER and GEAR to general constraints.

use dataset::{Code, Gear, Joint};
use mechanics::expression::{Binary, Input, Operation, Program};
use mechanics::model::{GeneralConstraint, Label, Model};
use nalgebra::{Rotation3, Vector3};

use super::pose::Pose;
use super::{Lowering, label};

/// Cosine of the angle to CV above which a motion counts as along it.
const ACROSS: f64 = 1e-9;

/// A coordinate of a joint (its rotation, else its displacement) and its factor in a sum.
struct Term<'a> {
    joint: &'a Joint,
    rotation: bool,
    scale: f64,
}

impl<'a> Lowering<'a> {
    /// Couplers and then gears in the order of the dataset. The reaction is that on I of the first
    /// joint.
    pub(super) fn couplers(&mut self, model: &mut Model) {
        let dataset = self.dataset;
        for coupler in &dataset.couplers {
            // The checks of the dataset have reported joints without the coordinate.
            let terms = coupler.freedoms.iter().filter_map(|freedom| {
                let joint = dataset.joints.by_id(freedom.joint)?;
                let rotation = joint.kind.coordinate(freedom.rotation)?;
                let scale = freedom.scale;
                Some(Term {
                    joint,
                    rotation,
                    scale,
                })
            });
            self.coupling(
                model,
                label("COUPLER", &coupler.header),
                &terms.collect::<Vec<_>>(),
            );
        }
        for gear in &dataset.gears {
            let terms = self.gear_terms(model, gear);
            self.coupling(model, label("GEAR", &gear.header), &terms);
        }
    }

    /// The velocity along z of CV at its origin of the part that the first joint moves, less that
    /// of the other, both as seen from the carrier: it is linear in the rates of the coordinates,
    /// with factors that do not change.
    fn gear_terms(&mut self, model: &Model, gear: &Gear) -> Vec<Term<'a>> {
        let dataset = self.dataset;
        let cv = Pose::of(model, self.marker_place(gear.cv));
        let along = cv.axes.column(2).into_owned();
        let owner = |id| dataset.markers.by_id(id).map(|marker| marker.owner);
        let mut terms = Vec::new();
        for (id, side) in gear.joints.iter().zip([1.0, -1.0]) {
            let Some(joint) = dataset.joints.by_id(*id) else {
                continue;
            };
            let axis = Pose::of(model, self.marker_place(joint.j));
            let z = axis.axes.column(2).into_owned();
            // Where I is on the carrier, J moves the other way.
            let sign = if owner(joint.j) == owner(gear.cv) {
                side
            } else {
                -side
            };
            let arm = cv.origin - axis.origin;
            let velocity = z.cross(&arm).dot(&along);
            let coordinates = [
                (true, joint.kind.rotates(), velocity, arm.norm()),
                (false, joint.kind.translates(), z.dot(&along), 1.0),
            ];
            let mut moves = false;
            for (rotation, has, factor, largest) in coordinates {
                if has && factor.abs() > ACROSS * largest {
                    moves = true;
                    let scale = sign * factor;
                    terms.push(Term {
                        joint,
                        rotation,
                        scale,
                    });
                }
            }
            if !moves {
                let message = format!(
                    "GEAR/{}: JOINT/{id} moves nothing along z of CV, MARKER/{}",
                    gear.header.id, gear.cv
                );
                let help = "z of CV is along the velocity of the teeth";
                self.error(
                    Code::InvalidConnection,
                    gear.header.span,
                    message,
                    Some(help),
                );
            }
        }
        terms
    }

    /// `Σ s q = 0`, where each coordinate `q` is zero as the dataset places the parts.
    fn coupling(&mut self, model: &mut Model, label: Label, terms: &[Term]) {
        let mut program = Program::default();
        let mut sum = program.push(Operation::Constant(0.0));
        for term in terms {
            let measure = self.coordinate(model, term.joint, term.rotation);
            let value = program.push(Operation::Input(Input::Measure(measure)));
            let scale = program.push(Operation::Constant(term.scale));
            let product = program.push(Operation::Binary(Binary::Multiply, scale, value));
            sum = program.push(Operation::Binary(Binary::Add, sum, product));
        }
        let i = terms.first().map(|term| self.marker_place(term.joint.i));
        model.constraints.push(GeneralConstraint {
            label,
            i,
            j: None,
            function: program,
        });
    }

    /// A coordinate of a joint, from a marker on the part of J that stands where the coordinate is
    /// zero: where I is as the dataset places the parts. So an angle starts far from the ends of
    /// its range and is continuous over many turns.
    fn coordinate(&mut self, model: &mut Model, joint: &Joint, rotation: bool) -> usize {
        let [i, j] = [joint.i, joint.j].map(|id| self.marker_place(id));
        let [at_i, at_j] = [i, j].map(|marker| Pose::of(model, marker));
        let mut zero = model.markers[j].clone();
        if rotation {
            let angle = at_i.angle_about_z(&at_j);
            zero.axes *= Rotation3::from_axis_angle(&Vector3::z_axis(), angle).matrix();
        } else {
            let distance = at_i.distance_along_z(&at_j);
            zero.offset += distance * zero.axes.column(2);
        }
        model.markers.push(zero);
        let zero = model.markers.len() - 1;
        self.measures
            .about_or_along_z(rotation, i, zero, self.ground)
    }
}
