//! Forces and torques of every element at a solved instant.

use friction::Regime;
use mechanics::state::MarkerFrame;
use mechanics::{FrictionValues, Owner, Snapshot, Wrench};
use nalgebra::Vector3;

use crate::lower::{ForceElement, Side};

/// Forces and torques on the part of marker I, about its origin, along ground axes, each computed
/// once an instant.
pub(crate) struct Wrenches<'a> {
    snapshot: &'a Snapshot<'a>,
    joints: Vec<Wrench>,
    motions: Vec<Wrench>,
    generals: Vec<Wrench>,
    forces: Vec<Wrench>,
    frictions: Vec<FrictionValues>,
}

impl<'a> Wrenches<'a> {
    /// All of them.
    pub(crate) fn new(snapshot: &'a Snapshot<'a>) -> Self {
        let model = snapshot.model();
        let reaction = |owner: fn(usize) -> Owner, count: usize| {
            (0..count)
                .map(|place| snapshot.reaction(owner(place)))
                .collect()
        };
        Self {
            joints: reaction(Owner::Joint, model.joints.len()),
            motions: reaction(Owner::Motion, model.motions.len()),
            generals: reaction(Owner::General, model.constraints.len()),
            forces: (0..model.forces.len())
                .map(|place| snapshot.applied(place))
                .collect(),
            frictions: (0..model.frictions.len())
                .map(|k| snapshot.friction(k))
                .collect(),
            snapshot,
        }
    }

    /// The instant.
    pub(crate) fn snapshot(&self) -> &'a Snapshot<'a> {
        self.snapshot
    }

    /// Frame of a marker.
    pub(crate) fn marker(&self, place: usize) -> MarkerFrame {
        self.snapshot.marker(place)
    }

    /// On the part of I, about I.
    pub(crate) fn on_i(&self, element: ForceElement) -> Wrench {
        match element {
            ForceElement::Constraint(Owner::Joint(joint)) => self.joints[joint],
            ForceElement::Constraint(Owner::Motion(motion)) => self.motions[motion],
            ForceElement::Constraint(Owner::General(place)) => self.generals[place],
            ForceElement::Applied { first, count } => {
                let mut sum = Wrench::default();
                for component in &self.forces[first..first + count] {
                    sum.force += component.force;
                    sum.torque += component.torque;
                }
                sum
            }
            ForceElement::Friction(friction) => self.friction_on_i(friction),
        }
    }

    /// On the part of one side, about the origin of its marker.
    pub(crate) fn of(&self, element: ForceElement, side: Side) -> Wrench {
        let wrench = self.on_i(element);
        let Side::J = side else { return wrench };
        let (i, j, on_both) = self.markers(element);
        if !on_both {
            return Wrench::default();
        }
        let arm = if self.j_floats(element) {
            Vector3::zeros()
        } else {
            self.marker(i).origin - self.marker(j).origin
        };
        Wrench {
            force: -wrench.force,
            torque: -(wrench.torque + arm.cross(&wrench.force)),
        }
    }

    /// Everything that acts at marker `i` between it and marker `j`; with `j` the implicit ground
    /// marker the forces that act on I alone.
    pub(crate) fn between(&self, i: usize, j: usize) -> Wrench {
        let model = self.snapshot.model();
        let alone = model.markers[j].id == 0;
        let constraints = (0..model.joints.len()).map(Owner::Joint);
        let constraints = constraints
            .chain((0..model.motions.len()).map(Owner::Motion))
            .chain((0..model.constraints.len()).map(Owner::General));
        let elements = constraints
            .map(ForceElement::Constraint)
            .chain((0..model.forces.len()).map(|first| ForceElement::Applied { first, count: 1 }))
            .chain((0..model.frictions.len()).map(ForceElement::Friction));
        let mut sum = Wrench::default();
        for element in elements {
            let (own_i, own_j, on_both) = self.markers(element);
            let side = if own_i == i && (own_j == j || alone && !on_both) {
                Side::I
            } else if own_i == j && own_j == i {
                Side::J
            } else {
                continue;
            };
            let wrench = self.of(element, side);
            sum.force += wrench.force;
            sum.torque += wrench.torque;
        }
        sum
    }

    /// Whether marker J of an element stands where I stands.
    fn j_floats(&self, element: ForceElement) -> bool {
        match element {
            ForceElement::Applied { first, .. } => self.snapshot.model().forces[first].j_floats(),
            ForceElement::Constraint(_) | ForceElement::Friction(_) => false,
        }
    }

    /// Markers I and J of an element, and whether it acts on both.
    fn markers(&self, element: ForceElement) -> (usize, usize, bool) {
        let model = self.snapshot.model();
        match element {
            ForceElement::Constraint(Owner::Joint(place)) => {
                (model.joints[place].i, model.joints[place].j, true)
            }
            ForceElement::Constraint(Owner::Motion(place)) => {
                (model.motions[place].i, model.motions[place].j, true)
            }
            ForceElement::Constraint(Owner::General(place)) => {
                let constraint = &model.constraints[place];
                // A marker that there is not is none of a function's.
                let marker = |marker: Option<usize>| marker.unwrap_or(usize::MAX);
                (marker(constraint.i), marker(constraint.j), true)
            }
            ForceElement::Applied { first, .. } => {
                let force = &model.forces[first];
                (force.i, force.j, force.kind.acts_on_both())
            }
            ForceElement::Friction(place) => {
                let joint = &model.joints[model.frictions[place].joint];
                (joint.i, joint.j, true)
            }
        }
    }

    /// Friction as a force and torque on I, ground axes.
    fn friction_on_i(&self, place: usize) -> Wrench {
        let model = self.snapshot.model();
        let values = &self.frictions[place];
        let j = self.marker(model.joints[model.frictions[place].joint].j);
        Wrench {
            force: j.axes * values.force,
            torque: j.axes * values.torque,
        }
    }

    /// Friction of a joint.
    pub(crate) fn friction(&self, place: usize) -> &FrictionValues {
        &self.frictions[place]
    }

    /// The 26 components of a friction in the order of the `.res`: force and torque along the axes
    /// of J, then coefficient, surface velocity and creep, each of sliding and of turning.
    pub(crate) fn components(&self, place: usize) -> [f64; 26] {
        let values = &self.frictions[place];
        let mut row = [0.0; 26];
        let mut put = |start: usize, vector: &Vector3<f64>| {
            row[start..start + 3].copy_from_slice(vector.as_slice());
        };
        put(0, &values.force);
        put(3, &values.torque);
        for (start, vector) in [(6, &values.mu), (13, &values.velocity), (19, &values.creep)] {
            put(start, &vector.translation);
            put(start + 3, &vector.rotation);
        }
        row[12] = if values.regime == Regime::Stuck {
            values.mu1
        } else {
            0.0
        };
        row[25] = values.beta;
        row
    }
}
