//! MREQUEST: one request for each of several elements.

use super::request::STANDARD;
use super::{Builder, Target, add};
use crate::diagnostic::Code;
use crate::keywords::{Keyword, Kind, abbreviated, keyword};
use crate::model::{MultipleRequest, Reported, RequestKind};
use crate::reading::Reading;

pub(super) const KEYWORDS: &[Keyword] = &[
    abbreviated("PARTS", "P", Kind::IdsOrAll),
    abbreviated("JOINTS", "J", Kind::IdsOrAll),
    abbreviated("JPRIMS", "JP", Kind::IdsOrAll),
    abbreviated("APPFORS", "AP", Kind::IdsOrAll),
    abbreviated("DISPLACEMENT", "D", Kind::Flag),
    abbreviated("VELOCITY", "V", Kind::Flag),
    abbreviated("ACCELERATION", "A", Kind::Flag),
    abbreviated("FORCE", "F", Kind::Flag),
    keyword("RM", Kind::Integer),
    abbreviated("COMMENT", "C", Kind::Text),
];

/// MREQUEST.
pub(super) fn multiple_request(reading: &mut Reading, builder: &mut Builder) {
    let Some(kind) = reading.required_flag("what is reported", &STANDARD) else {
        return;
    };
    let kind = kind();
    let lists = [
        ("PARTS", Reported::Parts),
        ("JOINTS", Reported::Joints),
        ("JPRIMS", Reported::Primitives),
        ("APPFORS", Reported::Forces),
    ];
    let names = lists.map(|(name, _)| name);
    let Some((name, reported)) = lists.into_iter().find(|(name, _)| reading.has(name)) else {
        let (span, message) = (reading.head, format!("{} reports nothing", reading.label()));
        reading
            .diagnostics
            .error(Code::MissingArgument, span, message)
            .help("add PARTS, JOINTS, JPRIMS or APPFORS with identifiers, or = ALL");
        return;
    };
    let others: Vec<&'static str> = names.into_iter().filter(|other| *other != name).collect();
    reading.exclude(name, &others);
    if reported == Reported::Parts && kind == RequestKind::Force {
        let span = reading.place("FORCE");
        let message = "a part has no force of its own";
        reading
            .diagnostics
            .error(Code::ConflictingArguments, span, message)
            .help("ask for the FORCE of JOINTS, JPRIMS or APPFORS");
        return;
    }
    let ids = reading.ids(name).to_vec();
    let request = MultipleRequest {
        header: reading.header(),
        kind,
        reported,
        ids: Some(ids).filter(|ids| !ids.is_empty()),
        rm: builder.refer(reading, "RM", Target::Marker),
        comment: reading.text("COMMENT"),
    };
    let list = &mut builder.dataset.multiple_requests;
    add(list, request, reading.name, reading.diagnostics);
}
