//! What an MREQUEST names is there and can be reported.

use super::references::{nearest, report};
use crate::diagnostic::{Code, Diagnostics};
use crate::model::{Dataset, Reported, RequestKind};

/// Reports elements that are missing, and such that have nothing to report.
pub(super) fn check(dataset: &Dataset, diagnostics: &mut Diagnostics) {
    for request in &dataset.multiple_requests {
        let head = request.header.span;
        let known = dataset.reportable_ids(request.reported);
        for (id, span) in request.ids.iter().flatten() {
            if known.binary_search(id).is_ok() {
                continue;
            }
            let name = match request.reported {
                Reported::Parts => "moving PART",
                Reported::Joints => "JOINT",
                Reported::Primitives => "JPRIM",
                Reported::Forces => "applied force",
            };
            report(diagnostics, name, *id, *span, nearest(&known, *id));
        }
        for element in dataset.reported(request) {
            let name = format!("{}/{}", element.statement, element.id);
            if element.i.is_none() {
                let message = format!("{name} has no centre of mass to report");
                diagnostics
                    .error(Code::MissingElement, head, message)
                    .help(format!("give {name} a CM, or leave it out"));
            } else if element.floating && request.kind != RequestKind::Force {
                let message = format!("the J marker of {name} floats with I: nothing moves there");
                diagnostics
                    .error(Code::InvalidConnection, head, message)
                    .help("write a REQUEST with I and a J of your own");
            }
        }
    }
}
