//! Every identifier in an argument names an element.

use crate::diagnostic::{Code, Diagnostics};
use crate::model::{Dataset, Element, Elements};
use crate::source::Span;
use crate::statements::{Builder, Reference, Target};
use std::collections::HashMap;

/// Reports the identifiers that name nothing.
pub(super) fn check(builder: &Builder, diagnostics: &mut Diagnostics) {
    let dataset = &builder.dataset;
    // Sorted identifiers, made for the kinds of elements that are missed.
    let mut known: HashMap<Target, Vec<u32>> = HashMap::new();
    for reference in &builder.references {
        if exists(dataset, reference.target, reference.id) {
            floating(dataset, reference, diagnostics);
            continue;
        }
        let ids = known
            .entry(reference.target)
            .or_insert_with(|| sorted_ids(dataset, reference.target));
        let name = reference.target.statement();
        report(
            diagnostics,
            name,
            reference.id,
            reference.span,
            nearest(ids, reference.id),
        );
    }
}

/// Reports a floating marker where one with a place of its own is needed, and the other way round.
fn floating(dataset: &Dataset, reference: &Reference, diagnostics: &mut Diagnostics) {
    let Some(marker) = dataset.markers.by_id(reference.id) else {
        return;
    };
    let (id, span) = (reference.id, reference.span);
    match reference.target {
        Target::Marker if marker.floating => report_floating(id, span, diagnostics),
        Target::FloatingMarker if !marker.floating => {
            let message = format!("JFLOAT needs a floating marker, which MARKER/{id} is not");
            diagnostics
                .error(Code::InvalidConnection, span, message)
                .help(format!("add FLOATING to MARKER/{id}, or name another"));
        }
        _ => {}
    }
}

/// Reports a floating marker where one with a place of its own is needed.
pub(super) fn report_floating(id: u32, span: Span, diagnostics: &mut Diagnostics) {
    let message = format!("MARKER/{id} is FLOATING, so it has no place of its own");
    diagnostics
        .error(Code::InvalidConnection, span, message)
        .help("name marker I of its force, where it stands, or one on the same part");
}

/// Reports one identifier that names nothing.
pub(crate) fn report(
    diagnostics: &mut Diagnostics,
    name: &str,
    id: u32,
    span: Span,
    near: Option<u32>,
) {
    let message = format!("there is no {name}/{id}");
    let error = diagnostics.error(Code::MissingElement, span, message);
    error.help = near.map(|near| format!("the nearest is {name}/{near}"));
}

pub(crate) fn exists(dataset: &Dataset, target: Target, id: u32) -> bool {
    match target {
        Target::Part => dataset.parts.position(id).is_some(),
        Target::PointMass => dataset.point_masses.position(id).is_some(),
        Target::Marker | Target::FloatingMarker | Target::AnyMarker => {
            dataset.markers.position(id).is_some()
        }
        Target::Joint => dataset.joints.position(id).is_some(),
        Target::Variable => dataset.variables.position(id).is_some(),
        Target::Array => dataset.arrays.position(id).is_some(),
        Target::Matrix => dataset.matrices.position(id).is_some(),
        Target::Curve => dataset.curves.position(id).is_some(),
    }
}

fn sorted_ids(dataset: &Dataset, target: Target) -> Vec<u32> {
    match target {
        Target::Part => sorted(&dataset.parts),
        Target::PointMass => sorted(&dataset.point_masses),
        Target::Marker | Target::FloatingMarker | Target::AnyMarker => sorted(&dataset.markers),
        Target::Joint => sorted(&dataset.joints),
        Target::Variable => sorted(&dataset.variables),
        Target::Array => sorted(&dataset.arrays),
        Target::Matrix => sorted(&dataset.matrices),
        Target::Curve => sorted(&dataset.curves),
    }
}

/// The identifiers of a list in rising order.
pub(crate) fn sorted<T: Element>(list: &Elements<T>) -> Vec<u32> {
    let ids = list.iter().map(|element| element.header().id);
    let mut ids: Vec<u32> = ids.filter(|id| *id > 0).collect();
    ids.sort_unstable();
    ids
}

/// The identifier in a sorted list that is nearest to `id`.
pub(crate) fn nearest(ids: &[u32], id: u32) -> Option<u32> {
    let above = ids.partition_point(|known| *known < id);
    let candidates = [above.checked_sub(1), Some(above)];
    candidates
        .into_iter()
        .filter_map(|index| ids.get(index?).copied())
        .min_by_key(|known| known.abs_diff(id))
}
