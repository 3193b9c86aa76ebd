//! What is allowed and seldom meant: suspicions about a whole model, apart from its rules in
//! [`checks`](crate::checks).

mod friction;
mod gravity;
mod unused_markers;

use crate::diagnostic::Diagnostics;
use crate::statements::Builder;

/// Reports what is suspicious about a model that was read.
pub(crate) fn model(builder: &Builder, diagnostics: &mut Diagnostics) {
    friction::check(builder, diagnostics);
    gravity::check(builder, diagnostics);
    // What is refused or wrong may be all that uses a marker.
    if !diagnostics.has_error() {
        unused_markers::check(builder, diagnostics);
    }
}
