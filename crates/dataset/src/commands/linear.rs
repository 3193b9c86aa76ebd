//! LINEAR.

use crate::diagnostic::Code;
use crate::keywords::{Keyword, Kind, abbreviated, keyword};
use crate::model::{CommandKind, Eigensolution};
use crate::reading::Reading;

const ENERGIES: &str = "energies of modes are not computed";
const STATES: &str = "stiction chooses the independent coordinates itself";
const MATRICES: &str =
    "stiction writes eigenvalues and mode shapes, no matrices; use LINEAR/EIGENSOL";

/// The arguments of LINEAR.
pub(super) const KEYWORDS: &[Keyword] = &[
    abbreviated("EIGENSOL", "EI", Kind::Flag),
    abbreviated("STATEMAT", "STA", Kind::Unsupported(MATRICES)),
    keyword("MKB", Kind::Unsupported(MATRICES)),
    abbreviated("EXPORT", "EX", Kind::Unsupported(MATRICES)),
    abbreviated("NOVECTOR", "NOV", Kind::Flag),
    abbreviated("NODAMPIN", "NOD", Kind::Flag),
    abbreviated("COORDS", "COO", Kind::Ids),
    keyword("RM", Kind::Id),
    keyword("ORIGIN", Kind::Unsupported("give a marker with RM")),
    abbreviated("KINETIC", "KI", Kind::Unsupported(ENERGIES)),
    abbreviated("DISSIPATIVE", "DI", Kind::Unsupported(ENERGIES)),
    abbreviated("STRAIN", "STR", Kind::Unsupported(ENERGIES)),
    keyword("PSTATE", Kind::Unsupported(STATES)),
    keyword("FILE", Kind::Unsupported(MATRICES)),
    keyword("FORMAT", Kind::Unsupported(MATRICES)),
    keyword("TYPE", Kind::Unsupported(MATRICES)),
    keyword("PINPUT", Kind::Unsupported(MATRICES)),
    keyword("POUTPUT", Kind::Unsupported(MATRICES)),
];

/// LINEAR.
pub(super) fn linear(reading: &mut Reading) -> Option<CommandKind> {
    if KEYWORDS.iter().any(|keyword| {
        matches!(keyword.kind, Kind::Unsupported(_)) && reading.has(keyword.name.full)
    }) {
        // This has been reported.
        return None;
    }
    reading.required_flag("an analysis", &[("EIGENSOL", ())])?;
    reading.exclude("NOVECTOR", &["COORDS"]);
    let shapes = match *reading.ids("COORDS") {
        [] => None,
        [(first, _)] => Some((first, first)),
        [(first, _), (last, _)] if first <= last => Some((first, last)),
        [..] => {
            let span = reading.place("COORDS");
            let message = "COORDS takes the numbers of the first and the last mode";
            reading
                .diagnostics
                .error(Code::InvalidValue, span, message)
                .help("write COORDS = 1, 6");
            None
        }
    };
    Some(CommandKind::Eigensolution(Eigensolution {
        damping: !reading.has("NODAMPIN"),
        vectors: !reading.has("NOVECTOR"),
        shapes,
        reference: reading.ids("RM").first().copied(),
    }))
}
