//! ACTIVATE and DEACTIVATE: how they are read and what they do to a [`Dataset`].

use crate::change::change;
use crate::checks::references::{nearest, report, sorted};
use crate::diagnostic::{Code, Diagnostics};
use crate::keywords::{Keyword, Kind, abbreviated, keyword};
use crate::model::{Activity, ChangeKind, CommandKind, Dataset, Selection, Switchable};
use crate::reading::Reading;
use crate::source::Span;
use std::collections::BTreeSet;

const NOT_HERE: &str = "it is read but not simulated, so that there is nothing to switch";
const NO_SWITCH: &str = "what stops with it is not documented";
const NEVER_READ: &str = "no dataset that stiction reads has one";

/// The types of elements and which of them are meant.
pub(crate) const KEYWORDS: &[Keyword] = &[
    abbreviated("JOINT", "J", Kind::Flag),
    abbreviated("JPRIM", "JP", Kind::Flag),
    abbreviated("MOTION", "MO", Kind::Flag),
    abbreviated("GCON", "GC", Kind::Flag),
    abbreviated("COUPLER", "COU", Kind::Flag),
    abbreviated("GEAR", "GE", Kind::Flag),
    abbreviated("SFORCE", "SF", Kind::Flag),
    abbreviated("SPRINGDAMPER", "SPR", Kind::Flag),
    abbreviated("VFORCE", "VF", Kind::Flag),
    abbreviated("VTORQUE", "VT", Kind::Flag),
    abbreviated("GFORCE", "GF", Kind::Flag),
    abbreviated("BUSHING", "BU", Kind::Flag),
    abbreviated("FIELD", "FI", Kind::Flag),
    abbreviated("BEAM", "BE", Kind::Flag),
    abbreviated("FRICTION", "FRI", Kind::Flag),
    abbreviated("SENSOR", "SE", Kind::Flag),
    abbreviated("CONTACT", "CON", Kind::Flag),
    abbreviated("VARIABLE", "VAR", Kind::Unsupported(NOT_HERE)),
    abbreviated("REQUEST", "REQ", Kind::Unsupported(NOT_HERE)),
    abbreviated("CLEARANCE", "CL", Kind::Unsupported(NOT_HERE)),
    keyword("ADAMS_BUSHING", Kind::Unsupported(NEVER_READ)),
    keyword("CVCV", Kind::Unsupported(NEVER_READ)),
    abbreviated("DIFF", "DI", Kind::Unsupported(NO_SWITCH)),
    abbreviated("FLEX_BODY", "FL", Kind::Unsupported(NEVER_READ)),
    abbreviated("GSE", "GS", Kind::Unsupported(NEVER_READ)),
    keyword("LSE", Kind::Unsupported(NO_SWITCH)),
    abbreviated("MFORCE", "MF", Kind::Unsupported(NEVER_READ)),
    abbreviated("NFORCE", "NF", Kind::Unsupported(NEVER_READ)),
    keyword("PTCV", Kind::Unsupported(NEVER_READ)),
    abbreviated("TFSISO", "TF", Kind::Unsupported(NO_SWITCH)),
    keyword("TIRE", Kind::Unsupported(NEVER_READ)),
    abbreviated("UCON", "UC", Kind::Unsupported(NEVER_READ)),
    keyword("ID", Kind::Ids),
    abbreviated("RANGE", "RA", Kind::Ids),
];

/// ACTIVATE.
pub(crate) fn activate(reading: &mut Reading) -> Option<CommandKind> {
    activity(reading, true)
}

/// DEACTIVATE.
pub(crate) fn deactivate(reading: &mut Reading) -> Option<CommandKind> {
    activity(reading, false)
}

fn activity(reading: &mut Reading, active: bool) -> Option<CommandKind> {
    if KEYWORDS.iter().any(|keyword| {
        matches!(keyword.kind, Kind::Unsupported(_)) && reading.has(keyword.name.full)
    }) {
        // This has been reported.
        return None;
    }
    let kinds = Switchable::ALL.map(|kind| (kind.statement(), kind));
    let kind = reading.required_flag("a type of element", &kinds);
    reading.exclude("ID", &["RANGE"]);
    if !reading.has("ID") && !reading.has("RANGE") {
        let message = format!("{} needs ID or RANGE", reading.label());
        let span = reading.head;
        reading
            .diagnostics
            .error(Code::MissingArgument, span, message)
            .help("write ID = 1, 2 or RANGE = 1, 9");
        return None;
    }
    let selection = match *reading.ids("RANGE") {
        [] => Selection::Ids(reading.ids("ID").to_vec()),
        [(first, start), (last, end)] if first <= last => Selection::Range {
            first,
            last,
            span: start.to(end),
        },
        [..] => {
            let span = reading.place("RANGE");
            reading
                .diagnostics
                .error(
                    Code::InvalidValue,
                    span,
                    "RANGE takes the least and the greatest number",
                )
                .help("write RANGE = 1, 9");
            return None;
        }
    };
    let activity = Activity {
        active,
        kind: kind?,
        selection,
    };
    Some(change(reading, ChangeKind::Activity(activity)))
}

impl Dataset {
    /// Carries out an ACTIVATE or DEACTIVATE; an error leaves everything as it is.
    pub(crate) fn switch(
        &mut self,
        activity: &Activity,
        command: Span,
        diagnostics: &mut Diagnostics,
    ) {
        let Some(ids) = self.selected(activity, diagnostics) else {
            return;
        };
        let kind = activity.kind;
        if !activity.active {
            if kind == Switchable::Joint {
                self.warn_of_resting(&ids, command, diagnostics);
            }
            self.inactive.extend(ids.into_iter().map(|id| (kind, id)));
            return;
        }
        let resting: Vec<(u32, u32)> = ids
            .iter()
            .filter_map(|id| Some((*id, self.joint_under(kind, *id)?)))
            .filter(|(_, joint)| self.inactive.contains(&(Switchable::Joint, *joint)))
            .collect();
        for (id, joint) in &resting {
            let name = kind.statement();
            let message =
                format!("{name}/{id} cannot be activated: its JOINT/{joint} is deactivated");
            diagnostics
                .error(Code::Deactivated, command, message)
                .help(format!("write ACTIVATE/JOINT, ID = {joint} before it"));
        }
        if resting.is_empty() {
            for id in ids {
                self.inactive.remove(&(kind, id));
            }
        }
    }

    /// The elements that are selected; `None` after a report of those that do not exist.
    fn selected(
        &self,
        activity: &Activity,
        diagnostics: &mut Diagnostics,
    ) -> Option<BTreeSet<u32>> {
        let known = match activity.kind {
            Switchable::Joint => sorted(&self.joints),
            Switchable::Primitive => sorted(&self.primitives),
            Switchable::Motion => sorted(&self.motions),
            Switchable::Constraint => sorted(&self.constraints),
            Switchable::Coupler => sorted(&self.couplers),
            Switchable::Gear => sorted(&self.gears),
            Switchable::PointCurve => sorted(&self.point_curves),
            Switchable::SingleForce => sorted(&self.single_forces),
            Switchable::SpringDamper => sorted(&self.spring_dampers),
            Switchable::VectorForce => sorted(&self.vector_forces),
            Switchable::VectorTorque => sorted(&self.vector_torques),
            Switchable::GeneralForce => sorted(&self.general_forces),
            Switchable::Bushing => sorted(&self.bushings),
            Switchable::Field => sorted(&self.fields),
            Switchable::Beam => sorted(&self.beams),
            Switchable::Friction => sorted(&self.frictions),
            Switchable::Sensor => sorted(&self.sensors),
            Switchable::Contact => sorted(&self.contacts),
        };
        let name = activity.kind.statement();
        match &activity.selection {
            Selection::Ids(ids) => {
                let mut complete = true;
                for (id, span) in ids {
                    if known.binary_search(id).is_err() {
                        report(diagnostics, name, *id, *span, nearest(&known, *id));
                        complete = false;
                    }
                }
                complete.then(|| ids.iter().map(|(id, _)| *id).collect())
            }
            Selection::Range { first, last, span } => {
                let from = known.partition_point(|id| id < first);
                let to = known.partition_point(|id| id <= last);
                if from == to {
                    let message = format!("there is no {name} from {first} to {last}");
                    diagnostics.error(Code::MissingElement, *span, message);
                    return None;
                }
                Some(known[from..to].iter().copied().collect())
            }
        }
    }

    /// The joint that an element acts on and rests with.
    pub(crate) fn joint_under(&self, kind: Switchable, id: u32) -> Option<u32> {
        match kind {
            Switchable::Friction => self.frictions.by_id(id).map(|friction| friction.joint),
            Switchable::Motion => self.motions.by_id(id)?.target.joint(),
            _ => None,
        }
    }

    /// Warns of what acts on joints that are being deactivated.
    fn warn_of_resting(
        &self,
        joints: &BTreeSet<u32>,
        command: Span,
        diagnostics: &mut Diagnostics,
    ) {
        let frictions = self.frictions.iter().map(|friction| {
            (
                Switchable::Friction,
                friction.header.id,
                Some(friction.joint),
            )
        });
        let motions = self
            .motions
            .iter()
            .map(|motion| (Switchable::Motion, motion.header.id, motion.target.joint()));
        for (kind, id, joint) in frictions.chain(motions) {
            let Some(joint) = joint.filter(|joint| joints.contains(joint)) else {
                continue;
            };
            if self.is_active(kind, id) {
                let name = kind.statement();
                let message = format!("{name}/{id} rests with its JOINT/{joint}");
                diagnostics.warning(Code::Deactivated, command, message);
            }
        }
    }
}
