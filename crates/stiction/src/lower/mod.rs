//! From the typed dataset to the mechanical model.
//!
//! Elements keep their order: bodies are the moving parts and then the point masses, joints the
//! joints and then the primitives, forces the single-component forces and then the spring-dampers.
//! Markers keep their places, and a marker at the origin of ground follows them.

mod bodies;
mod composite;
mod expression;
mod forces;
mod frame;
mod friction;
mod joints;
mod measures;
mod motions;
mod outputs;
mod results;

use std::collections::HashSet;

use ::dataset::{Code, Dataset, Diagnostic, Header, Severity, Span};
use mechanics::Owner;
use mechanics::model::{Label, Model};
use nalgebra::Vector3;

pub(crate) use measures::Measures;
pub(crate) use outputs::{Column, Outputs, Unit};
pub(crate) use results::{ForceElement, Side};

/// A dataset lowered to mechanics.
#[derive(Clone, Debug)]
pub(crate) struct Lowered {
    /// The mechanical model.
    pub(crate) model: Model,
    /// What outputs need beside it.
    pub(crate) outputs: Outputs,
    /// What each motion of the dataset has become: a motion, or a general constraint.
    pub(crate) motions: Vec<Option<Owner>>,
    /// Warnings.
    pub(crate) warnings: Vec<Diagnostic>,
}

/// Lowers a dataset that was read without errors from the source of that name.
///
/// `measures` keeps its measures and takes on the new ones, so that models that are lowered with
/// the same list number them alike.
///
/// # Errors
/// Everything that is not simulated, each with its place.
pub(crate) fn lower(
    dataset: &Dataset,
    source: &str,
    measures: &mut Measures,
) -> Result<Lowered, Vec<Diagnostic>> {
    let mut lowering = Lowering {
        dataset,
        source,
        ucf: dataset.units.as_ref().map_or(1.0, |units| units.ucf),
        ground: dataset.markers.len(),
        measures,
        motions: Vec::new(),
        results: Vec::new(),
        diagnostics: Vec::new(),
        told: HashSet::new(),
    };
    let gravity = Vector3::from(dataset.gravity.unwrap_or_default());
    let mut model = Model {
        gravity,
        ..Model::default()
    };
    lowering.bodies(&mut model);
    lowering.joints(&mut model);
    lowering.frictions(&mut model);
    lowering.constraints(&mut model);
    lowering.motions(&mut model);
    lowering.forces(&mut model);
    let outputs = lowering.outputs();
    let Lowering {
        motions,
        diagnostics,
        ..
    } = lowering;
    model.measures = measures.list().to_vec();
    if diagnostics.iter().any(|d| d.severity == Severity::Error) {
        return Err(diagnostics);
    }
    Ok(Lowered {
        model,
        outputs,
        motions,
        warnings: diagnostics,
    })
}

/// The state of a lowering.
struct Lowering<'a> {
    dataset: &'a Dataset,
    /// Name of the file that the dataset came from.
    source: &'a str,
    /// Unit consistency factor: masses are divided by it.
    ucf: f64,
    /// Place of the implicit marker at the origin of ground.
    ground: usize,
    measures: &'a mut Measures,
    motions: Vec<Option<Owner>>,
    /// Results that output functions read, by number.
    results: Vec<results::ResultSource>,
    diagnostics: Vec<Diagnostic>,
    /// Places and texts of the diagnostics.
    told: HashSet<(usize, usize, String)>,
}

impl Lowering<'_> {
    /// Place of a marker; 0 is the ground.
    fn marker_place(&self, id: u32) -> usize {
        self.dataset.markers.position(id).unwrap_or(self.ground)
    }

    fn error(&mut self, code: Code, span: Span, message: String, help: Option<&str>) {
        self.add(Severity::Error, code, span, message, help);
    }

    fn warn(&mut self, code: Code, span: Span, message: String) {
        self.add(Severity::Warning, code, span, message, None);
    }

    fn add(
        &mut self,
        severity: Severity,
        code: Code,
        span: Span,
        message: String,
        help: Option<&str>,
    ) {
        // A variable that several functions read is gone through for each of them.
        if self.told.insert((span.start, span.end, message.clone())) {
            self.diagnostics.push(Diagnostic {
                code,
                severity,
                message,
                source: self.source.to_owned(),
                span,
                notes: Vec::new(),
                help: help.map(str::to_owned),
            });
        }
    }
}

/// How an element is called in messages.
fn label(statement: &'static str, header: &Header) -> Label {
    Label {
        statement,
        id: header.id,
        name: view_name(header).unwrap_or_default().to_owned(),
    }
}

/// The last component of the name of an element in Adams View.
pub(crate) fn view_name(header: &Header) -> Option<&str> {
    let name = header.name.as_deref()?;
    Some(name.rsplit('.').next().unwrap_or(name)).filter(|name| !name.is_empty())
}
