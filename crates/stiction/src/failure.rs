//! What stops a run, with the place of the element that it is about.

use dataset::{Code, Dataset, Severity, Source};
use mechanics::model::Label;
use mechanics::{AssemblyError, RunError};

use crate::about::about;
use crate::message::Message;

/// An error about an element, with help.
fn message(
    dataset: &Dataset,
    source: &Source,
    code: Code,
    text: String,
    element: Option<&Label>,
    help: &str,
) -> Message {
    let mut diagnostic = about(dataset, source, Severity::Error, code, element, text);
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

/// The code of an error of a run: a jam has its own.
fn code_of(error: &RunError, otherwise: Code) -> Code {
    if error.jammed { Code::Jam } else { otherwise }
}

/// Accelerations and reactions that cannot be found at the start.
pub(crate) fn of_start(dataset: &Dataset, source: &Source, error: &RunError) -> Message {
    let help = "look at the functions, masses and joints of this element at the start";
    let element = error.element.as_ref();
    let text = error.to_string();
    message(
        dataset,
        source,
        code_of(error, Code::Assembly),
        text,
        element,
        help,
    )
}

/// An equilibrium that was not found.
pub(crate) fn of_equilibrium(dataset: &Dataset, source: &Source, error: &RunError) -> Message {
    let text = format!("the static solution stopped {error}");
    let help = "the results up to then are kept";
    let element = error.element.as_ref();
    message(
        dataset,
        source,
        code_of(error, Code::Equilibrium),
        text,
        element,
        help,
    )
}

/// A model that could not be linearised.
pub(crate) fn of_linearization(dataset: &Dataset, source: &Source, error: &RunError) -> Message {
    let text = format!("LINEAR failed {error}");
    let help = "linearise where the model is at rest, after a SIMULATE/STATIC";
    let element = error.element.as_ref();
    message(dataset, source, Code::Integration, text, element, help)
}

/// An integration that stopped.
pub(crate) fn of_run(dataset: &Dataset, source: &Source, error: &RunError) -> Message {
    let text = format!("the integration stopped {error}");
    let help = "the results up to then are kept";
    let element = error.element.as_ref();
    message(
        dataset,
        source,
        code_of(error, Code::Integration),
        text,
        element,
        help,
    )
}
