//! Markers that nothing uses.

use crate::checks::named_markers;
use crate::diagnostic::{Code, Diagnostics, few};
use crate::statements::{Builder, Target};

/// Reports, in one message, the markers that no argument and no function names.
pub(super) fn check(builder: &Builder, diagnostics: &mut Diagnostics) {
    let markers = &builder.dataset.markers;
    let mut used = vec![false; markers.len()];
    let mut mark = |id| {
        if let Some(position) = markers.position(id) {
            used[position] = true;
        }
    };
    for reference in &builder.references {
        if matches!(
            reference.target,
            Target::Marker | Target::FloatingMarker | Target::AnyMarker
        ) {
            mark(reference.id);
        }
    }
    builder.mentioned.iter().copied().for_each(&mut mark);
    named_markers(&builder.dataset, &mut mark);
    let unused = markers.iter().zip(&used).filter(|(_, used)| !**used);
    let unused: Vec<_> = unused.map(|(marker, _)| &marker.header).collect();
    let Some(first) = unused.first() else {
        return;
    };
    let names = unused.iter().map(|header| header.id.to_string());
    let names: Vec<String> = names.collect();
    let message = match unused.len() {
        1 => format!("nothing uses MARKER/{}", first.id),
        count => format!("nothing uses {count} markers: {}", few(&names)),
    };
    diagnostics
        .note(Code::UnusedMarker, first.span, message)
        .help("a reference may name another marker by mistake; else they can go");
}
