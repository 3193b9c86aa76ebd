//! The statements of the language: one table, and one reader for each that is simulated.

mod array;
mod contact;
mod coupler;
mod curve;
mod differential;
mod elastic;
mod force;
mod friction;
mod joint;
mod linear_system;
mod motion;
mod multiple_request;
mod part;
mod request;
mod sensor;
mod settings;
mod spline;
mod table;
mod units;
mod variable;
mod vector_force;

pub(crate) use friction::KEYWORDS as FRICTION_KEYWORDS;
pub(crate) use friction::arguments as friction_arguments;
pub(crate) use motion::name_freedoms;
pub(crate) use request::STANDARD as STANDARD_REQUESTS;
pub(crate) use settings::{
    EQUILIBRIUM_KEYWORDS, INTEGRATOR_KEYWORDS, PREFERENCES_KEYWORDS, equilibrium, integrator,
    preferences,
};
pub(crate) use table::{Action, Rule, STATEMENTS};
pub(crate) use units::{GRAVITY_KEYWORDS, gravity};

use crate::diagnostic::{Code, Diagnostics};
use crate::model::{Dataset, Element, Elements, FrictionArguments};
use crate::reading::Reading;
use crate::source::{Source, Span};
use crate::syntax::{Item, TokenKind};

/// What an identifier names.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Hash)]
pub(crate) enum Target {
    Part,
    PointMass,
    /// A marker with a place of its own.
    Marker,
    /// A marker that stands where marker I of its force stands.
    FloatingMarker,
    /// A marker of either sort.
    AnyMarker,
    Joint,
    Variable,
    Array,
    Matrix,
    Curve,
}

impl Target {
    pub(crate) const fn statement(self) -> &'static str {
        match self {
            Self::Part => "PART",
            Self::PointMass => "POINT_MASS",
            Self::Marker | Self::FloatingMarker | Self::AnyMarker => "MARKER",
            Self::Joint => "JOINT",
            Self::Variable => "VARIABLE",
            Self::Array => "ARRAY",
            Self::Matrix => "MATRIX",
            Self::Curve => "CURVE",
        }
    }
}

/// An identifier in an argument, to be looked up when the whole file is read.
pub(crate) struct Reference {
    pub(crate) target: Target,
    pub(crate) id: u32,
    pub(crate) span: Span,
}

/// The places of a FRICTION and its arguments.
pub(crate) struct FrictionPlaces {
    /// Its name and identifier.
    pub(crate) head: Span,
    /// JOINT.
    pub(crate) joint: Span,
    /// `I_YOKE` or `J_YOKE`.
    pub(crate) yoke: Option<Span>,
    pub(crate) arguments: FrictionArguments,
}

/// A dataset while it is read.
#[derive(Default)]
pub(crate) struct Builder {
    pub(crate) dataset: Dataset,
    pub(crate) references: Vec<Reference>,
    /// Numbers in what is not read, any of which may name a marker.
    pub(crate) mentioned: Vec<u32>,
    /// What checks need of every FRICTION, in the order of `dataset.frictions`.
    pub(crate) frictions: Vec<FrictionPlaces>,
    /// The place of ACCGRAV.
    pub(crate) gravity: Option<Span>,
    /// The last `PART` or `POINT_MASS`, which owns markers that name no body.
    pub(crate) last_body: Option<(Target, u32)>,
    /// Motions of joints that do not say whether they turn or slide: identifier and head.
    pub(crate) unnamed_freedoms: Vec<(u32, Span)>,
    /// Statements without identifier seen so far.
    pub(crate) singles: Vec<&'static str>,
}

impl Builder {
    /// Takes the whole numbers in items that are not read for identifiers of markers.
    pub(crate) fn mention(&mut self, source: &Source, items: &[Item]) {
        let numbers = items.iter().filter(|item| item.kind() == TokenKind::Number);
        let ids = numbers.filter_map(|item| source.slice(item.span()).parse::<u32>().ok());
        self.mentioned.extend(ids);
    }

    /// The identifier in an argument, which must name an element; 0, where an argument takes it,
    /// stands for the ground and names none.
    pub(crate) fn refer(
        &mut self,
        reading: &Reading,
        keyword: &'static str,
        target: Target,
    ) -> Option<u32> {
        let (id, span) = *reading.ids(keyword).first().filter(|(id, _)| *id > 0)?;
        self.references.push(Reference { target, id, span });
        Some(id)
    }

    /// Like [`Builder::refer`] for an argument that must be given; 0 where it is not, which has
    /// been reported.
    pub(crate) fn require(
        &mut self,
        reading: &mut Reading,
        keyword: &'static str,
        target: Target,
    ) -> u32 {
        reading.require(keyword);
        self.refer(reading, keyword, target).unwrap_or(0)
    }
}

/// Adds an element to its list and reports an identifier that is there already.
fn add<T: Element>(list: &mut Elements<T>, element: T, name: &str, diagnostics: &mut Diagnostics) {
    let header = element.header();
    let id = header.id;
    if let Some(first) = list.by_id(id).filter(|_| id > 0) {
        let (line, _) = diagnostics.source.line_column(first.header().span.start);
        let start = header.span.start;
        let end = start + name.len().min(header.span.end - start);
        let span = Span::new(start, diagnostics.source.text().floor_char_boundary(end));
        diagnostics
            .error(
                Code::DuplicateId,
                span,
                format!("{name}/{id} is there already"),
            )
            .note(format!("the first one is on line {line}"))
            .help("give one of the two another number, and correct what refers to it");
    }
    list.push(element);
}
