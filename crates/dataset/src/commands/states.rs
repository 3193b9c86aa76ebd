//! SAVE and RELOAD.

use crate::diagnostic::Code;
use crate::keywords::{Keyword, Kind, abbreviated};
use crate::model::{CommandKind, Reload, SavedIn};
use crate::reading::Reading;

/// The arguments of SAVE.
pub(super) const SAVE_KEYWORDS: &[Keyword] = &[
    abbreviated("SYSTEM", "SY", Kind::Flag),
    abbreviated("STATES", "ST", Kind::Flag),
    abbreviated("FILE", "FI", Kind::Text),
    abbreviated("BUFFER", "BU", Kind::Text),
];

/// The arguments of RELOAD.
pub(super) const RELOAD_KEYWORDS: &[Keyword] = &[
    abbreviated("SYSTEM", "SY", Kind::Flag),
    abbreviated("STATES", "ST", Kind::Flag),
    abbreviated("FILE", "FI", Kind::Text),
    abbreviated("BUFFER", "BU", Kind::Text),
    abbreviated("OUTPUT_PREFIX", "OUT", Kind::Text),
    abbreviated("TITLE", "TI", Kind::Text),
];

/// SAVE.
pub(super) fn save(reading: &mut Reading) -> Option<CommandKind> {
    saved_in(reading).map(CommandKind::Save)
}

/// RELOAD.
pub(super) fn reload(reading: &mut Reading) -> Option<CommandKind> {
    for keyword in ["OUTPUT_PREFIX", "TITLE"] {
        if reading.has("STATES") && reading.has(keyword) {
            let span = reading.place(keyword);
            let message = format!("{keyword} is for RELOAD/SYSTEM");
            reading
                .diagnostics
                .error(Code::ConflictingArguments, span, message);
        }
    }
    if reading.has("TITLE") && !reading.has("OUTPUT_PREFIX") {
        let span = reading.place("TITLE");
        let message = "TITLE has no effect without OUTPUT_PREFIX: open files have their title";
        reading.diagnostics.warning(Code::Ignored, span, message);
    }
    Some(CommandKind::Reload(Reload {
        from: saved_in(reading)?,
        output_prefix: reading.text("OUTPUT_PREFIX"),
        title: reading.text("TITLE"),
    }))
}

/// Where SYSTEM or STATES are kept.
fn saved_in(reading: &mut Reading) -> Option<SavedIn> {
    let kinds = [
        ("SYSTEM", ("FILE", "BUFFER")),
        ("STATES", ("BUFFER", "FILE")),
    ];
    let (place, other) = reading.required_flag("what is kept", &kinds)?;
    if reading.has(other) {
        let span = reading.place(other);
        let message = format!("{} has no {other} here", reading.label());
        reading
            .diagnostics
            .error(Code::ConflictingArguments, span, message)
            .help("write SYSTEM with FILE, STATES with BUFFER");
        return None;
    }
    reading.require(place);
    let name = reading.text(place)?;
    if name.is_empty() {
        let span = reading.place(place);
        let message = format!("{place} gives no name");
        reading.diagnostics.error(Code::InvalidValue, span, message);
        return None;
    }
    Some(match place {
        "FILE" => SavedIn::File(name),
        _ => SavedIn::Buffer(name),
    })
}
