//! Forces and torques of every element at a solved instant.

use friction::Regime;
use mechanics::state::MarkerFrame;
use mechanics::{Acting, ForceElement, FrictionValues, Owner, Side, Snapshot, Wrench};
use nalgebra::Vector3;

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
    fn of(&self, element: ForceElement, side: Side) -> Wrench {
        let wrench = self.on_i(element);
        let Side::J = side else { return wrench };
        let ends = self.snapshot.model().ends(element);
        if !ends.on_both {
            return Wrench::default();
        }
        let arm = match (ends.i, ends.j) {
            (Some(i), Some(j)) if !ends.floating => self.marker(i).origin - self.marker(j).origin,
            _ => Vector3::zeros(),
        };
        Wrench {
            force: -wrench.force,
            torque: -(wrench.torque + arm.cross(&wrench.force)),
        }
    }

    /// The sum of what is asked for.
    pub(crate) fn acting(&self, acting: Acting) -> Wrench {
        let mut sum = Wrench::default();
        for (element, side) in self.snapshot.model().acting(acting) {
            let wrench = self.of(element, side);
            sum.force += wrench.force;
            sum.torque += wrench.torque;
        }
        sum
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
