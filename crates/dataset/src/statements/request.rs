//! REQUEST, GRAPHICS, OUTPUT and RESULTS: what is reported and drawn.

use super::{Builder, Target, add};
use crate::arguments::free;
use crate::diagnostic::Code;
use crate::expression::{Expr, Expression, Function};
use crate::keywords::{INTERFACE, Keyword, Kind, SUBROUTINE, abbreviated, keyword};
use crate::model::{Graphics, Request, RequestKind};
use crate::reading::Reading;
use crate::syntax::{TokenKind, join};

pub(super) const KEYWORDS: &[Keyword] = &[
    abbreviated("DISPLACEMENT", "D", Kind::Flag),
    abbreviated("VELOCITY", "V", Kind::Flag),
    abbreviated("ACCELERATION", "A", Kind::Flag),
    abbreviated("FORCE", "F", Kind::Flag),
    keyword("I", Kind::Id),
    // 0 stands for the ground.
    keyword("J", Kind::Integer),
    keyword("RM", Kind::Integer),
    keyword("F1", Kind::Expression),
    keyword("F2", Kind::Expression),
    keyword("F3", Kind::Expression),
    keyword("F4", Kind::Expression),
    keyword("F5", Kind::Expression),
    keyword("F6", Kind::Expression),
    keyword("F7", Kind::Expression),
    keyword("F8", Kind::Expression),
    keyword("VARIABLES", Kind::Ids),
    abbreviated("FUNCTION", "FU", Kind::Ignored(SUBROUTINE)),
    abbreviated("ROUTINE", "RO", Kind::Ignored(SUBROUTINE)),
    INTERFACE,
    abbreviated("COMMENT", "C", Kind::Text),
    keyword("COMMENTS", Kind::Text),
    abbreviated("TITLE", "T", Kind::Text),
    keyword("CNAMES", Kind::Strings),
    keyword("CLABELS", Kind::Strings),
    keyword("CUNITS", Kind::Strings),
    abbreviated("RESULTS_NAME", "RESULTS", Kind::Text),
];

const FUNCTIONS: [&str; 8] = ["F1", "F2", "F3", "F4", "F5", "F6", "F7", "F8"];

/// A flag and what it asks for.
type Standard = (&'static str, fn() -> RequestKind);

/// What is reported of two markers, by the flags of REQUEST, MREQUEST and INFO.
pub(crate) const STANDARD: [Standard; 4] = [
    ("DISPLACEMENT", || RequestKind::Displacement),
    ("VELOCITY", || RequestKind::Velocity),
    ("ACCELERATION", || RequestKind::Acceleration),
    ("FORCE", || RequestKind::Force),
];

/// REQUEST. One that only calls a subroutine reports nothing.
pub(super) fn request(reading: &mut Reading, builder: &mut Builder) {
    let standard = reading.one_flag(&STANDARD);
    let kind = match standard {
        Some(kind) => {
            for function in FUNCTIONS.into_iter().chain(["VARIABLES"]) {
                if reading.has(function) {
                    let span = reading.place(function);
                    let message = format!("{} reports one thing only", reading.label());
                    reading
                        .diagnostics
                        .error(Code::ConflictingArguments, span, message)
                        .help("use another REQUEST for the functions");
                }
            }
            reading.require("I");
            kind()
        }
        None => {
            let mut functions = FUNCTIONS.map(|function| reading.expression(function));
            if reading.has("VARIABLES") {
                reading.exclude("VARIABLES", &FUNCTIONS);
                functions = variables(reading);
            }
            RequestKind::Functions(Box::new(functions))
        }
    };
    let calls_subroutine = ["FUNCTION", "ROUTINE"].iter().any(|name| reading.has(name));
    let mut components = FUNCTIONS.iter().chain(&["VARIABLES"]);
    let reports = standard.is_some() || components.any(|component| reading.has(component));
    if !reports {
        if !calls_subroutine {
            let message = format!("{} reports nothing", reading.label());
            let span = reading.head;
            reading
                .diagnostics
                .error(Code::MissingArgument, span, message)
                .help("add DISPLACEMENT, VELOCITY, ACCELERATION, FORCE, VARIABLES or F1 to F8");
        }
        return;
    }
    // Forces act on floating markers, too.
    let ends = match kind {
        RequestKind::Force => Target::AnyMarker,
        _ => Target::Marker,
    };
    let request = Request {
        header: reading.header(),
        kind,
        i: builder.refer(reading, "I", ends),
        j: builder.refer(reading, "J", ends),
        rm: builder.refer(reading, "RM", Target::Marker),
        comment: reading.text("COMMENT").or(reading.text("COMMENTS")),
        title: reading.text("TITLE"),
        component_names: reading.strings("CNAMES"),
        component_labels: reading.strings("CLABELS"),
        component_units: reading.strings("CUNITS"),
        results_name: reading.text("RESULTS_NAME"),
    };
    add(
        &mut builder.dataset.requests,
        request,
        reading.name,
        reading.diagnostics,
    );
}

/// The values of the variables that a request lists, one for each of its components.
fn variables(reading: &mut Reading) -> [Option<Expression>; 8] {
    let ids = reading.ids("VARIABLES").to_vec();
    if let Some((_, ninth)) = ids.get(FUNCTIONS.len()) {
        let message = "a REQUEST has eight components";
        reading
            .diagnostics
            .error(Code::InvalidValue, *ninth, message)
            .help("list the other variables in another REQUEST");
    }
    std::array::from_fn(|place| {
        let (id, span) = *ids.get(place)?;
        let root = Expr::Call {
            function: Function::Varval,
            arguments: vec![Expr::Number(f64::from(id))],
            span,
        };
        let text = format!("VARVAL({id})");
        Some(Expression { span, root, text })
    })
}

/// GRAPHICS: the first flag is the type, everything else is kept as written.
pub(super) fn graphics(reading: &mut Reading, builder: &mut Builder) {
    let source = reading.diagnostics.source;
    builder.mention(source, reading.items);
    let mut kind = String::new();
    let mut arguments = Vec::new();
    for argument in free(source, reading.items) {
        let value = &reading.items[argument.rest()];
        match value.first().map(|item| item.kind()) {
            None if kind.is_empty() => kind = argument.name,
            None => arguments.push((argument.name, String::new())),
            Some(TokenKind::Equals) => arguments.push((argument.name, join(source, &value[1..]))),
            // A picture has no faults that matter.
            Some(_) => arguments.push((argument.name, join(source, value))),
        }
    }
    let graphics = Graphics {
        header: reading.header(),
        kind,
        arguments,
    };
    add(
        &mut builder.dataset.graphics,
        graphics,
        reading.name,
        reading.diagnostics,
    );
}

const NOT_WRITTEN: &str = "stiction does not write this file or table";
const ANGLES: &str = "angles are written as PSI, THETA and PHI";
const FORMAT: &str = "the format of output files is fixed";
const ALL_WRITTEN: &str = "all results are written";

pub(super) const OUTPUT_KEYWORDS: &[Keyword] = &[
    abbreviated("REQSAVE", "REQ", Kind::Flag),
    abbreviated("GRSAVE", "GRS", Kind::Ignored(NOT_WRITTEN)),
    abbreviated("GR521SAV", "GR5", Kind::Ignored(NOT_WRITTEN)),
    abbreviated("CHART", "C", Kind::Ignored(NOT_WRITTEN)),
    abbreviated("DPRINT", "DP", Kind::Ignored(NOT_WRITTEN)),
    abbreviated("FIXED", "FI", Kind::Ignored(FORMAT)),
    abbreviated("NOPRINT", "NOP", Kind::Flag),
    abbreviated("NOSEPARATOR", "NOS", Kind::Ignored(FORMAT)),
    abbreviated("OSFORMAT", "OS", Kind::Ignored(FORMAT)),
    abbreviated("TELETYPE", "TE", Kind::Ignored(FORMAT)),
    keyword("VPRINT", Kind::Ignored(NOT_WRITTEN)),
    keyword("APRINT", Kind::Ignored(NOT_WRITTEN)),
    keyword("FPRINT", Kind::Ignored(NOT_WRITTEN)),
    abbreviated("YPRINT", "Y", Kind::Ignored(NOT_WRITTEN)),
    keyword("YPR", Kind::Ignored(ANGLES)),
    keyword("ICSAVE", Kind::Ignored(NOT_WRITTEN)),
    keyword("DACSAVE", Kind::Ignored(NOT_WRITTEN)),
    keyword("MATSAVE", Kind::Ignored(NOT_WRITTEN)),
    keyword("RPCSAVE", Kind::Ignored(NOT_WRITTEN)),
    keyword("LOADS", Kind::Ignored(NOT_WRITTEN)),
    keyword("MODAL_DEFORMATION", Kind::Ignored(NOT_WRITTEN)),
    keyword("NODAL_DEFORMATION", Kind::Ignored(NOT_WRITTEN)),
    keyword("STRAIN", Kind::Ignored(NOT_WRITTEN)),
    keyword("STRESS", Kind::Ignored(NOT_WRITTEN)),
    abbreviated("DSCALE", "DS", Kind::Ignored(FORMAT)),
    abbreviated("VSCALE", "VS", Kind::Ignored(FORMAT)),
    abbreviated("ASCALE", "AS", Kind::Ignored(FORMAT)),
    abbreviated("FSCALE", "FS", Kind::Ignored(FORMAT)),
    abbreviated("DZERO", "DZ", Kind::Ignored(FORMAT)),
    abbreviated("VZERO", "VZ", Kind::Ignored(FORMAT)),
    abbreviated("AZERO", "AZ", Kind::Ignored(FORMAT)),
    abbreviated("FZERO", "FZ", Kind::Ignored(FORMAT)),
];

/// OUTPUT.
pub(super) fn output(reading: &mut Reading, builder: &mut Builder) {
    builder.dataset.output.requests = reading.has("REQSAVE");
}

pub(super) const RESULTS_KEYWORDS: &[Keyword] = &[
    abbreviated("FORMATTED", "FORM", Kind::Flag),
    keyword("XRF", Kind::Flag),
    keyword("DECIMALPLACES", Kind::Integer),
    keyword("ROUNDOFF", Kind::Ignored(FORMAT)),
    keyword("SCIENTIFIC", Kind::Ignored(FORMAT)),
    keyword("SIGNIFICANTFIGURES", Kind::Ignored(FORMAT)),
    keyword("TRAILINGZEROS", Kind::Ignored(FORMAT)),
    keyword("ZEROTHRESHOLD", Kind::Ignored(FORMAT)),
    keyword("HDF5", Kind::Ignored(FORMAT)),
    abbreviated("COMMENT", "COM", Kind::Text),
    abbreviated("NOACCELERATIONS", "NOACC", Kind::Ignored(ALL_WRITTEN)),
    abbreviated("NOAPPLIEDFORCES", "NOAPP", Kind::Ignored(ALL_WRITTEN)),
    keyword("NOCONTACTS", Kind::Flag),
    abbreviated("NODATASTRUCTURES", "NODAT", Kind::Ignored(ALL_WRITTEN)),
    abbreviated("NODISPLACEMENTS", "NODIS", Kind::Ignored(ALL_WRITTEN)),
    abbreviated("NOFLOATINGMARKERS", "NOFLO", Kind::Flag),
    abbreviated("NOLINEAR", "NOLIN", Kind::Flag),
    abbreviated("NOREACTIONFORCES", "NOREA", Kind::Ignored(ALL_WRITTEN)),
    keyword("NOREQUESTS", Kind::Ignored(ALL_WRITTEN)),
    abbreviated("NOSYSTEMELEMENTS", "NOSYS", Kind::Ignored(ALL_WRITTEN)),
    abbreviated("NOTIRES", "NOTIR", Kind::Flag),
    abbreviated("NOVELOCITIES", "NOVEL", Kind::Ignored(ALL_WRITTEN)),
];

/// RESULTS.
pub(super) fn results(reading: &mut Reading, builder: &mut Builder) {
    let results = &mut builder.dataset.results;
    results.decimal_places = reading.count("DECIMALPLACES");
    results.comment = reading.text("COMMENT");
}
