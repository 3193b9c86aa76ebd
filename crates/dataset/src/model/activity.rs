//! ACTIVATE and DEACTIVATE: which elements take part in simulations.

use super::Dataset;
use crate::source::Span;

/// A type of element that can be deactivated and activated again.
#[derive(Clone, Copy, Debug, PartialEq, Eq, PartialOrd, Ord, Hash)]
pub enum Switchable {
    /// JOINT.
    Joint,
    /// JPRIM.
    Primitive,
    /// MOTION.
    Motion,
    /// GCON.
    Constraint,
    /// COUPLER.
    Coupler,
    /// GEAR.
    Gear,
    /// PTCV.
    PointCurve,
    /// SFORCE.
    SingleForce,
    /// SPRINGDAMPER.
    SpringDamper,
    /// VFORCE.
    VectorForce,
    /// VTORQUE.
    VectorTorque,
    /// GFORCE.
    GeneralForce,
    /// BUSHING.
    Bushing,
    /// FIELD.
    Field,
    /// BEAM.
    Beam,
    /// FRICTION.
    Friction,
    /// SENSOR.
    Sensor,
    /// CONTACT.
    Contact,
}

impl Switchable {
    /// Every type.
    pub const ALL: [Self; 18] = [
        Self::Joint,
        Self::Primitive,
        Self::Motion,
        Self::Constraint,
        Self::Coupler,
        Self::Gear,
        Self::PointCurve,
        Self::SingleForce,
        Self::SpringDamper,
        Self::VectorForce,
        Self::VectorTorque,
        Self::GeneralForce,
        Self::Bushing,
        Self::Field,
        Self::Beam,
        Self::Friction,
        Self::Sensor,
        Self::Contact,
    ];

    /// The name of its statement.
    #[must_use]
    pub const fn statement(self) -> &'static str {
        match self {
            Self::Joint => "JOINT",
            Self::Primitive => "JPRIM",
            Self::Motion => "MOTION",
            Self::Constraint => "GCON",
            Self::Coupler => "COUPLER",
            Self::Gear => "GEAR",
            Self::PointCurve => "PTCV",
            Self::SingleForce => "SFORCE",
            Self::SpringDamper => "SPRINGDAMPER",
            Self::VectorForce => "VFORCE",
            Self::VectorTorque => "VTORQUE",
            Self::GeneralForce => "GFORCE",
            Self::Bushing => "BUSHING",
            Self::Field => "FIELD",
            Self::Beam => "BEAM",
            Self::Friction => "FRICTION",
            Self::Sensor => "SENSOR",
            Self::Contact => "CONTACT",
        }
    }
}

/// The elements of one type that an ACTIVATE or DEACTIVATE names.
#[derive(Clone, Debug, PartialEq)]
pub enum Selection {
    /// ID: identifiers with their places.
    Ids(Vec<(u32, Span)>),
    /// RANGE: every element whose identifier is in it.
    Range {
        /// The least identifier.
        first: u32,
        /// The greatest identifier.
        last: u32,
        /// The place of the two.
        span: Span,
    },
}

/// ACTIVATE or DEACTIVATE.
#[derive(Clone, Debug, PartialEq)]
pub struct Activity {
    /// Whether the elements are activated.
    pub active: bool,
    /// Their type.
    pub kind: Switchable,
    /// Which of them.
    pub selection: Selection,
}

impl Dataset {
    /// Whether an element takes part in simulations: neither it is deactivated nor the joint that
    /// it is on (FRICTION, and MOTION of a joint).
    ///
    /// ```
    /// use dataset::{parse_change, read_dataset, Source, Switchable};
    /// let text = "title
    /// UNITS/FORCE=NEWTON, MASS=KILOGRAM, LENGTH=MILLIMETER, TIME=SECOND
    /// PART/1, GROUND
    /// MARKER/1, PART=1
    /// PART/2
    /// MARKER/2, PART=2
    /// JOINT/1, REVOLUTE, I=2, J=1
    /// FRICTION/1, JOINT=1, MU_STATIC=0.3, MU_DYNAMIC=0.2";
    /// let (mut dataset, _) = read_dataset(&Source::from_text("m.adm", text.to_string()));
    /// let source = Source::from_text("--set", "DEACTIVATE/JOINT, ID=1".to_string());
    /// dataset.apply(&parse_change(&source).0.unwrap());
    /// assert!(!dataset.is_active(Switchable::Joint, 1));
    /// assert!(!dataset.is_active(Switchable::Friction, 1));
    /// ```
    #[must_use]
    pub fn is_active(&self, kind: Switchable, id: u32) -> bool {
        let joint = self.joint_under(kind, id);
        let joint = joint.map(|joint| (Switchable::Joint, joint));
        let rests = |element: &(Switchable, u32)| self.inactive.contains(element);
        !rests(&(kind, id)) && !joint.is_some_and(|joint| rests(&joint))
    }
}
