//! What stops a run, with the place of the element that it is about.

use dataset::{Code, Dataset, Severity, Source};
use mechanics::model::Label;
use mechanics::{AssemblyError, Cause, RunError};

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
    match error.cause {
        Cause::Jam => Code::Jam,
        _ => otherwise,
    }
}

/// What may help a run that stopped.
fn cure(cause: Cause) -> &'static str {
    match cause {
        Cause::Jam => {
            "less friction, a longer overlap or a smaller arm of this joint makes the gain smaller"
        }
        Cause::Singular => {
            "look at the last results: a mechanism cannot be driven beyond its reach, and parts that \
             move need mass and inertia"
        }
        Cause::NotConverged => {
            "look at the functions and stiffnesses of this element; a smaller ERROR or HMAX, or a \
             larger MAXIT, may help"
        }
        Cause::NotANumber => {
            "keep the arguments of SQRT, LOG, ASIN, ACOS and powers in their range, and divisors from \
             zero"
        }
        Cause::Inaccurate => {
            "look at the last results; give a smaller HMIN or a larger ERROR, and a width to what \
             jumps, as by STEP"
        }
        Cause::JumpOfPlace => "give the jump a width, as by STEP",
        Cause::NoEquilibrium => "hold what is free by a joint or a spring, or start nearer to rest",
        Cause::NotLinear => "linearise at another position",
    }
}

/// Accelerations and reactions that cannot be found at the start.
pub(crate) fn of_start(dataset: &Dataset, source: &Source, error: &RunError) -> Message {
    let help = match error.cause {
        Cause::Jam | Cause::NotANumber => cure(error.cause),
        _ => "look at the functions, masses and joints of this element at the start",
    };
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
    let help = format!("{}; the results up to then are kept", cure(error.cause));
    let element = error.element.as_ref();
    message(
        dataset,
        source,
        code_of(error, Code::Equilibrium),
        text,
        element,
        &help,
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
    let help = format!("{}; the results up to then are kept", cure(error.cause));
    let element = error.element.as_ref();
    message(
        dataset,
        source,
        code_of(error, Code::Integration),
        text,
        element,
        &help,
    )
}
