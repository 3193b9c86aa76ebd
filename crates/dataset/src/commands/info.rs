//! INFO.

use crate::keywords::{Keyword, Kind, abbreviated, keyword};
use crate::model::{CommandKind, Request};
use crate::reading::Reading;
use crate::statements::STANDARD_REQUESTS;

/// The arguments of INFO.
pub(super) const KEYWORDS: &[Keyword] = &[
    abbreviated("DISPLACEMENT", "D", Kind::Flag),
    abbreviated("VELOCITY", "V", Kind::Flag),
    abbreviated("ACCELERATION", "A", Kind::Flag),
    abbreviated("FORCE", "F", Kind::Flag),
    keyword("I", Kind::Id),
    // 0 stands for the ground.
    keyword("J", Kind::Integer),
    keyword("RM", Kind::Integer),
];

/// INFO.
pub(super) fn info(reading: &mut Reading) -> Option<CommandKind> {
    let kind = reading.required_flag("what is listed", &STANDARD_REQUESTS)?;
    reading.require("I");
    let marker = |keyword| reading.integer(keyword).filter(|id| *id > 0);
    Some(CommandKind::Info(Box::new(Request {
        header: reading.header(),
        kind: kind(),
        i: Some(marker("I")?),
        j: marker("J"),
        rm: marker("RM"),
        comment: None,
        title: None,
        component_names: Vec::new(),
        component_labels: Vec::new(),
        component_units: Vec::new(),
        results_name: None,
    })))
}
