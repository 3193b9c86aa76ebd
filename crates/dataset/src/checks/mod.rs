//! What must hold for a whole model, checked when every statement is read.

pub(crate) mod angles;
mod connections;
mod curves;
mod expressions;
mod friction;
pub(crate) mod inertia;
mod linear_systems;
mod multiple_requests;
pub(crate) mod references;

pub(crate) use expressions::named_markers;
pub(crate) use friction::unused_arguments;

use crate::diagnostic::{Code, Diagnostics};
use crate::model::Dataset;
use crate::source::Span;
use crate::statements::Builder;

/// Reports everything that is wrong with the model as a whole.
pub(crate) fn model(builder: &Builder, diagnostics: &mut Diagnostics) {
    let dataset = &builder.dataset;
    ground(builder, diagnostics);
    references::check(builder, diagnostics);
    elements(dataset, diagnostics);
    friction::check(builder, diagnostics);
}

/// Reports what is wrong with connections and expressions.
pub(crate) fn elements(dataset: &Dataset, diagnostics: &mut Diagnostics) {
    connections::check(dataset, diagnostics);
    curves::check(dataset, diagnostics);
    expressions::check_all(dataset, diagnostics);
    linear_systems::check(dataset, diagnostics);
    multiple_requests::check(dataset, diagnostics);
}

/// Exactly one part is the ground.
fn ground(builder: &Builder, diagnostics: &mut Diagnostics) {
    let mut grounds = builder.dataset.parts.iter().filter(|part| part.ground);
    let Some(first) = grounds.next() else {
        diagnostics
            .error(
                Code::Ground,
                Span::default(),
                "no part of the model is the ground",
            )
            .help("add PART/1, GROUND");
        return;
    };
    let (line, _) = diagnostics.source.line_column(first.header.span.start);
    for other in grounds {
        let message = format!("PART/{} is the ground as well", other.header.id);
        diagnostics
            .error(Code::Ground, other.header.span, message)
            .note(format!(
                "PART/{} on line {line} is the ground",
                first.header.id
            ));
    }
}
