//! VARIABLE, PINPUT and POUTPUT.

use super::{Builder, Reference, Target, add};
use crate::keywords::{INTERFACE, Keyword, Kind, ROUTINE, abbreviated, keyword};
use crate::model::{PlantPort, Variable};
use crate::reading::Reading;

pub(crate) const KEYWORDS: &[Keyword] = &[
    keyword("IC", Kind::Real),
    abbreviated("FUNCTION", "FU", Kind::Expression),
    ROUTINE,
    INTERFACE,
];

/// VARIABLE.
pub(super) fn variable(reading: &mut Reading, builder: &mut Builder) {
    let variable = Variable {
        header: reading.header(),
        ic: reading.real("IC"),
        function: reading.required_expression("FUNCTION"),
    };
    let list = &mut builder.dataset.variables;
    add(list, variable, reading.name, reading.diagnostics);
}

pub(super) const PORT_KEYWORDS: &[Keyword] = &[abbreviated("VARIABLES", "V", Kind::Ids)];

/// PINPUT.
pub(super) fn plant_input(reading: &mut Reading, builder: &mut Builder) {
    let port = port(reading, builder);
    let list = &mut builder.dataset.plant_inputs;
    add(list, port, reading.name, reading.diagnostics);
}

/// POUTPUT.
pub(super) fn plant_output(reading: &mut Reading, builder: &mut Builder) {
    let port = port(reading, builder);
    let list = &mut builder.dataset.plant_outputs;
    add(list, port, reading.name, reading.diagnostics);
}

fn port(reading: &mut Reading, builder: &mut Builder) -> PlantPort {
    reading.require("VARIABLES");
    let ids = reading.ids("VARIABLES");
    let references = ids.iter().map(|(id, span)| Reference {
        target: Target::Variable,
        id: *id,
        span: *span,
    });
    builder.references.extend(references);
    PlantPort {
        header: reading.header(),
        variables: ids.iter().map(|(id, _)| *id).collect(),
    }
}
