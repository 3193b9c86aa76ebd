//! Messages about elements of the mechanical model, at the statements that they come from.

use dataset::{Code, Dataset, Diagnostic, Severity, Source, Span};
use mechanics::model::Label;

/// Where the statement of an element stands.
fn span_of(dataset: &Dataset, element: &Label) -> Option<Span> {
    let id = element.id;
    let header = match element.statement {
        "PART" => &dataset.parts.by_id(id)?.header,
        "POINT_MASS" => &dataset.point_masses.by_id(id)?.header,
        "JOINT" => &dataset.joints.by_id(id)?.header,
        "JPRIM" => &dataset.primitives.by_id(id)?.header,
        "MARKER" => &dataset.markers.by_id(id)?.header,
        "PTCV" => &dataset.point_curves.by_id(id)?.header,
        "MOTION" => &dataset.motions.by_id(id)?.header,
        "GCON" => &dataset.constraints.by_id(id)?.header,
        "COUPLER" => &dataset.couplers.by_id(id)?.header,
        "GEAR" => &dataset.gears.by_id(id)?.header,
        "SFORCE" => &dataset.single_forces.by_id(id)?.header,
        "SPRINGDAMPER" => &dataset.spring_dampers.by_id(id)?.header,
        "VFORCE" => &dataset.vector_forces.by_id(id)?.header,
        "VTORQUE" => &dataset.vector_torques.by_id(id)?.header,
        "GFORCE" => &dataset.general_forces.by_id(id)?.header,
        "BUSHING" => &dataset.bushings.by_id(id)?.header,
        "FIELD" => &dataset.fields.by_id(id)?.header,
        "BEAM" => &dataset.beams.by_id(id)?.header,
        "VARIABLE" => &dataset.variables.by_id(id)?.header,
        "DIFF" => &dataset.differentials.by_id(id)?.header,
        "SENSOR" => &dataset.sensors.by_id(id)?.header,
        "REQUEST" => &dataset.requests.by_id(id)?.header,
        "FRICTION" => &dataset.frictions.by_id(id)?.header,
        _ => return None,
    };
    Some(header.span)
}

/// A message about an element, or about the model as a whole at its first line.
pub(crate) fn about(
    dataset: &Dataset,
    source: &Source,
    severity: Severity,
    code: Code,
    element: Option<&Label>,
    text: String,
) -> Diagnostic {
    let span = element.and_then(|element| span_of(dataset, element));
    let span = span.unwrap_or_default();
    Diagnostic::new(severity, code, source.name(), span, text)
}
