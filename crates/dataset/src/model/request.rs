//! REQUEST and GRAPHICS: what to report and to draw.

use super::Header;
use crate::expression::Expression;

/// What a request reports.
#[derive(Clone, Debug, PartialEq)]
pub enum RequestKind {
    /// Displacement of I relative to J.
    Displacement,
    /// Velocity of I relative to J.
    Velocity,
    /// Acceleration of I relative to J.
    Acceleration,
    /// Force on I of the elements between I and J.
    Force,
    /// F1 to F8; F1 and F5 take the columns of magnitudes.
    Functions(Box<[Option<Expression>; 8]>),
}

/// REQUEST.
#[derive(Clone, Debug, PartialEq)]
pub struct Request {
    /// Identifier, name and place.
    pub header: Header,
    /// What is reported.
    pub kind: RequestKind,
    /// The I marker.
    pub i: Option<u32>,
    /// The J marker; default the ground.
    pub j: Option<u32>,
    /// RM: the marker in whose axes components are given; default the ground.
    pub rm: Option<u32>,
    /// COMMENT.
    pub comment: Option<String>,
    /// TITLE.
    pub title: Option<String>,
    /// CNAMES: names of the components; an empty one drops its component.
    pub component_names: Vec<String>,
    /// CLABELS: plot labels of the components.
    pub component_labels: Vec<String>,
    /// CUNITS: units of the components.
    pub component_units: Vec<String>,
    /// `RESULTS_NAME`: name of the entity in result files.
    pub results_name: Option<String>,
}

/// GRAPHICS: kept as written, for pictures.
#[derive(Clone, Debug, PartialEq)]
pub struct Graphics {
    /// Identifier, name and place.
    pub header: Header,
    /// The type: CYLINDER, BOX, ...
    pub kind: String,
    /// The other arguments: name in capitals and text of the value, empty for a flag.
    pub arguments: Vec<(String, String)>,
}
