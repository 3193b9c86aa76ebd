//! Elements that apply a force and a torque between two markers, and how functions ask for them.

use crate::constraint::Owner;
use crate::model::{JointKind, Model};
use serde::{Deserialize, Serialize};

/// An element that applies a force and a torque between two markers.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum ForceElement {
    /// A joint, primitive, motion or general constraint.
    Constraint(Owner),
    /// An applied force, by the places of its components among the model's forces.
    Applied {
        /// The first one.
        first: usize,
        /// How many follow one another.
        count: usize,
    },
    /// Friction, by its place among the model's frictions.
    Friction(usize),
}

impl ForceElement {
    /// The applied force whose components have these places.
    #[must_use]
    pub fn applied(places: std::ops::Range<usize>) -> Self {
        Self::Applied {
            first: places.start,
            count: places.len(),
        }
    }
}

/// On which of its two markers an element's force is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Side {
    /// On the part of I, about the origin of I.
    I,
    /// On the part of J, about the origin of J.
    J,
}

/// Whose force is asked for.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub enum Acting {
    /// That of one element.
    Element(ForceElement, Side),
    /// That of everything which acts at marker `i` between it and marker `j`; with `j` the ground's
    /// own marker (its id is 0) that of the elements which act on `i` alone.
    Between {
        /// Marker on which the forces act.
        i: usize,
        /// The other marker.
        j: usize,
    },
}

/// One component of a force or torque.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash, Serialize, Deserialize)]
pub struct ForceComponent {
    /// Whose.
    pub acting: Acting,
    /// Whether it is a torque.
    pub torque: bool,
    /// Which axis: 0, 1 or 2.
    pub axis: usize,
    /// Marker whose axes resolve.
    pub frame: usize,
}

/// The markers between which an element acts.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Ends {
    /// Marker I; a general constraint may have none.
    pub i: Option<usize>,
    /// Marker J.
    pub j: Option<usize>,
    /// Whether it acts on both.
    pub on_both: bool,
    /// Whether J stands where I stands.
    pub floating: bool,
}

impl Model {
    /// Where an element acts.
    #[must_use]
    pub fn ends(&self, element: ForceElement) -> Ends {
        let fixed = |i: Option<usize>, j: Option<usize>| Ends {
            i,
            j,
            on_both: true,
            floating: false,
        };
        match element {
            ForceElement::Constraint(Owner::Joint(place)) => {
                let joint = &self.joints[place];
                Ends {
                    floating: matches!(joint.kind, JointKind::PointOnCurve { .. }),
                    ..fixed(Some(joint.i), Some(joint.j))
                }
            }
            ForceElement::Constraint(Owner::Motion(place)) => {
                fixed(Some(self.motions[place].i), Some(self.motions[place].j))
            }
            ForceElement::Constraint(Owner::General(place)) => {
                fixed(self.constraints[place].i, self.constraints[place].j)
            }
            ForceElement::Applied { first, .. } => {
                let force = &self.forces[first];
                Ends {
                    on_both: force.kind.acts_on_both(),
                    floating: force.j_floats(),
                    ..fixed(Some(force.i), Some(force.j))
                }
            }
            ForceElement::Friction(place) => {
                let joint = &self.joints[self.frictions[place].joint];
                fixed(Some(joint.i), Some(joint.j))
            }
        }
    }

    /// The elements whose force is asked for, and on which side of each.
    #[must_use]
    pub fn acting(&self, acting: Acting) -> Vec<(ForceElement, Side)> {
        let (i, j) = match acting {
            Acting::Element(element, side) => return vec![(element, side)],
            Acting::Between { i, j } => (i, j),
        };
        let alone = self.markers[j].id == 0;
        let constraints = (0..self.joints.len()).map(Owner::Joint);
        let constraints = constraints
            .chain((0..self.motions.len()).map(Owner::Motion))
            .chain((0..self.constraints.len()).map(Owner::General));
        let elements = constraints
            .map(ForceElement::Constraint)
            .chain((0..self.forces.len()).map(|first| ForceElement::Applied { first, count: 1 }))
            .chain((0..self.frictions.len()).map(ForceElement::Friction));
        let of = |element: ForceElement| {
            let ends = self.ends(element);
            if ends.i == Some(i) && (ends.j == Some(j) || alone && !ends.on_both) {
                Some((element, Side::I))
            } else if ends.i == Some(j) && ends.j == Some(i) {
                Some((element, Side::J))
            } else {
                None
            }
        };
        elements.filter_map(of).collect()
    }
}
