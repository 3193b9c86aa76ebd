//! Markers that nothing uses.

use crate::checks::named_markers;
use crate::diagnostic::{Code, Diagnostics};
use crate::statements::{Builder, Target};

/// So many are named.
const MOST_NAMES: usize = 12;

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
    let names = unused.iter().take(MOST_NAMES);
    let mut names: Vec<String> = names.map(|header| header.id.to_string()).collect();
    if unused.len() > MOST_NAMES {
        names.push("...".to_string());
    }
    let message = match unused.len() {
        1 => format!("nothing uses MARKER/{}", first.id),
        count => format!("nothing uses {count} markers: {}", names.join(", ")),
    };
    diagnostics
        .note(Code::UnusedMarker, first.span, message)
        .help("a reference may name another marker by mistake; else they can go");
}
