//! What stops a run, with the place of the element that it is about.

use dataset::{Code, Dataset, Diagnostic, Severity, Source, Span};
use mechanics::model::Label;
use mechanics::{AssemblyError, RunError};

use crate::message::Message;

/// Where the statement of an element stands.
fn span_of(dataset: &Dataset, element: &Label) -> Option<Span> {
    let id = element.id;
    let header = match element.statement {
        "PART" => &dataset.parts.by_id(id)?.header,
        "POINT_MASS" => &dataset.point_masses.by_id(id)?.header,
        "JOINT" => &dataset.joints.by_id(id)?.header,
        "JPRIM" => &dataset.primitives.by_id(id)?.header,
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
        "FRICTION" => &dataset.frictions.by_id(id)?.header,
        _ => return None,
    };
    Some(header.span)
}

/// An error about an element, or about the model as a whole at its first line.
fn message(
    dataset: &Dataset,
    source: &Source,
    code: Code,
    text: String,
    element: Option<&Label>,
    help: &str,
) -> Message {
    let span = element.and_then(|element| span_of(dataset, element));
    let span = span.unwrap_or_default();
    let mut diagnostic = Diagnostic::new(Severity::Error, code, source.name(), span, text);
    diagnostic.help(help);
    Message::new(diagnostic, source)
}

/// Assembly that failed.
pub(crate) fn of_assembly(dataset: &Dataset, source: &Source, error: &AssemblyError) -> Message {
    let help = match error {
        AssemblyError::Inconsistent { .. } => {
            "give positions and orientations of parts and markers at which all joints hold"
        }
        AssemblyError::Opposite { .. } => "turn one of the markers by 180D",
        AssemblyError::Velocities { .. } => {
            "give velocities, initial conditions and motions that go together"
        }
        AssemblyError::OutOfScale { .. } => "check the units of lengths, masses and functions",
        AssemblyError::NotANumber { .. } => "check the function where the simulation starts",
    };
    let (text, element) = (error.to_string(), error.element());
    message(dataset, source, Code::Assembly, text, element, help)
}

/// Accelerations and reactions that cannot be found at the start.
pub(crate) fn of_start(dataset: &Dataset, source: &Source, error: &RunError) -> Message {
    let help = "look at the functions, masses and joints of this element at the start";
    let element = error.element.as_ref();
    let text = error.to_string();
    message(dataset, source, Code::Assembly, text, element, help)
}

/// An equilibrium that was not found.
pub(crate) fn of_equilibrium(dataset: &Dataset, source: &Source, error: &RunError) -> Message {
    let text = format!("the static solution stopped {error}");
    let help = "the results up to then are kept";
    let element = error.element.as_ref();
    message(dataset, source, Code::Equilibrium, text, element, help)
}

/// An integration that stopped.
pub(crate) fn of_run(dataset: &Dataset, source: &Source, error: &RunError) -> Message {
    let text = format!("the integration stopped {error}");
    let help = "the results up to then are kept";
    let element = error.element.as_ref();
    message(dataset, source, Code::Integration, text, element, help)
}
