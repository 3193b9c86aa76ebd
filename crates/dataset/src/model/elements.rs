//! Identified statements and lists of them with look-up by identifier.

use crate::source::Span;
use foldhash::fast::RandomState;
use std::collections::HashMap;
use std::fmt;
use std::ops::Deref;

/// What every identified statement has.
#[derive(Clone, Debug, PartialEq)]
pub struct Header {
    /// The number behind the slash, unique among the statements of one type.
    pub id: u32,
    /// The full name from the last `adams_view_name='...'` comment before the statement. Results
    /// are named after the part behind its last dot.
    pub name: Option<String>,
    /// The place of the whole statement.
    pub span: Span,
}

/// A statement with an identifier.
pub trait Element {
    /// Identifier, name and place.
    fn header(&self) -> &Header;
    /// The same, to be changed.
    fn header_mut(&mut self) -> &mut Header;
}

/// The statements of one type, in the order of the file, with look-up by identifier.
///
/// It reads like a slice. Where an identifier occurs twice (an error of the dataset) the first
/// one is found.
#[derive(Clone, PartialEq)]
pub struct Elements<T> {
    list: Vec<T>,
    index: HashMap<u32, usize, RandomState>,
}

impl<T: fmt::Debug> fmt::Debug for Elements<T> {
    fn fmt(&self, f: &mut fmt::Formatter<'_>) -> fmt::Result {
        f.debug_list().entries(&self.list).finish()
    }
}

impl<T> Default for Elements<T> {
    fn default() -> Self {
        Self {
            list: Vec::new(),
            index: HashMap::default(),
        }
    }
}

impl<T: Element> Elements<T> {
    /// Appends a statement.
    pub fn push(&mut self, element: T) {
        self.index
            .entry(element.header().id)
            .or_insert(self.list.len());
        self.list.push(element);
    }

    /// The position in the list of the statement with this identifier.
    #[must_use]
    pub fn position(&self, id: u32) -> Option<usize> {
        self.index.get(&id).copied()
    }

    /// The statement with this identifier.
    #[must_use]
    pub fn by_id(&self, id: u32) -> Option<&T> {
        self.position(id).map(|position| &self.list[position])
    }

    /// The statement with this identifier, to be changed; its identifier must stay.
    pub fn by_id_mut(&mut self, id: u32) -> Option<&mut T> {
        self.position(id).map(|position| &mut self.list[position])
    }
}

impl<T> Deref for Elements<T> {
    type Target = [T];

    fn deref(&self) -> &[T] {
        &self.list
    }
}

impl<'a, T> IntoIterator for &'a Elements<T> {
    type Item = &'a T;
    type IntoIter = std::slice::Iter<'a, T>;

    fn into_iter(self) -> Self::IntoIter {
        self.list.iter()
    }
}

macro_rules! elements {
    ($($type:ty),* $(,)?) => {
        $(impl Element for $type {
            fn header(&self) -> &Header {
                &self.header
            }

            fn header_mut(&mut self) -> &mut Header {
                &mut self.header
            }
        })*
    };
}

elements!(
    super::Part,
    super::PointMass,
    super::Marker,
    super::Joint,
    super::JointPrimitive,
    super::GeneralConstraint,
    super::Coupler,
    super::Gear,
    super::Motion,
    super::SingleForce,
    super::SpringDamper,
    super::VectorForce,
    super::Bushing,
    super::Field,
    super::Beam,
    super::Contact,
    super::Variable,
    super::DifferentialEquation,
    super::Array,
    super::Matrix,
    super::Text,
    super::LinearStateEquations,
    super::TransferFunction,
    super::PlantPort,
    super::Request,
    super::MultipleRequest,
    super::Sensor,
    super::Graphics,
    super::Friction,
    super::Curve,
    super::PointCurve,
    super::Spline,
);
