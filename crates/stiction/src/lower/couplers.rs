//! COUPLER to general constraints.

use dataset::{Coupler, Joint};
use mechanics::expression::{Binary, Input, Operation, Program, Register};
use mechanics::model::{GeneralConstraint, Model};
use nalgebra::{Rotation3, Vector3};

use super::pose::Pose;
use super::{Lowering, label};

impl Lowering<'_> {
    /// Couplers in the order of the dataset. The reaction is that on I of the first joint.
    pub(super) fn couplers(&mut self, model: &mut Model) {
        let dataset = self.dataset;
        for coupler in &dataset.couplers {
            let i = coupler.freedoms.first().and_then(|freedom| {
                let joint = dataset.joints.by_id(freedom.joint)?;
                dataset.markers.position(joint.i)
            });
            let function = self.coupling(model, coupler);
            model.constraints.push(GeneralConstraint {
                label: label("COUPLER", &coupler.header),
                i,
                j: None,
                function,
            });
        }
    }

    /// `Σ s q`, where each coordinate `q` is zero as the dataset places the parts.
    fn coupling(&mut self, model: &mut Model, coupler: &Coupler) -> Program {
        let mut program = Program::default();
        let mut sum: Option<Register> = None;
        for freedom in &coupler.freedoms {
            let joint = self.dataset.joints.by_id(freedom.joint);
            let Some((joint, rotation)) =
                joint.and_then(|joint| Some((joint, joint.kind.coordinate(freedom.rotation)?)))
            else {
                // The checks of the dataset have reported it.
                continue;
            };
            let measure = self.coordinate(model, joint, rotation);
            let value = program.push(Operation::Input(Input::Measure(measure)));
            let scale = program.push(Operation::Constant(freedom.scale));
            let term = program.push(Operation::Binary(Binary::Multiply, scale, value));
            sum = Some(match sum {
                Some(sum) => program.push(Operation::Binary(Binary::Add, sum, term)),
                None => term,
            });
        }
        if sum.is_none() {
            program.push(Operation::Constant(0.0));
        }
        program
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
