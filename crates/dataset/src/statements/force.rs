//! SFORCE and SPRINGDAMPER.

use super::{Builder, Target, add};
use crate::checks::angles;
use crate::diagnostic::Code;
use crate::keywords::{INTERFACE, Keyword, Kind, ROUTINE, abbreviated, keyword};
use crate::model::{ForceDirection, SingleForce, SpringDamper};
use crate::reading::Reading;

pub(crate) const SINGLE_KEYWORDS: &[Keyword] = &[
    abbreviated("TRANSLATIONAL", "TR", Kind::Flag),
    abbreviated("ROTATIONAL", "ROT", Kind::Flag),
    keyword("I", Kind::Id),
    keyword("J", Kind::Id),
    abbreviated("ACTIONONLY", "A", Kind::Flag),
    abbreviated("FUNCTION", "FU", Kind::Expression),
    ROUTINE,
    INTERFACE,
];

const DIRECTIONS: [(&str, ForceDirection); 2] = [
    ("TRANSLATIONAL", ForceDirection::Translational),
    ("ROTATIONAL", ForceDirection::Rotational),
];

/// SFORCE.
pub(super) fn single_force(reading: &mut Reading, builder: &mut Builder) {
    let direction = reading.required_flag("TRANSLATIONAL or ROTATIONAL", &DIRECTIONS);
    let force = SingleForce {
        header: reading.header(),
        direction: direction.unwrap_or(ForceDirection::Translational),
        i: builder.require(reading, "I", Target::Marker),
        j: builder.require(reading, "J", Target::Marker),
        action_only: reading.has("ACTIONONLY"),
        function: reading.required_expression("FUNCTION"),
    };
    let list = &mut builder.dataset.single_forces;
    add(list, force, reading.name, reading.diagnostics);
}

pub(super) const SPRING_KEYWORDS: &[Keyword] = &[
    abbreviated("TRANSLATIONAL", "TR", Kind::Flag),
    abbreviated("ROTATIONAL", "RO", Kind::Flag),
    keyword("I", Kind::Id),
    keyword("J", Kind::Id),
    keyword("C", Kind::Real),
    keyword("K", Kind::Real),
    keyword("CT", Kind::Real),
    keyword("KT", Kind::Real),
    abbreviated("FORCE", "F", Kind::Real),
    abbreviated("LENGTH", "L", Kind::Real),
    abbreviated("TORQUE", "TO", Kind::Real),
    abbreviated("ANGLE", "A", Kind::Real),
];

/// SPRINGDAMPER.
pub(super) fn spring_damper(reading: &mut Reading, builder: &mut Builder) {
    const TRANSLATIONAL: [&str; 4] = ["K", "C", "LENGTH", "FORCE"];
    const ROTATIONAL: [&str; 4] = ["KT", "CT", "ANGLE", "TORQUE"];
    let direction = reading.required_flag("TRANSLATIONAL or ROTATIONAL", &DIRECTIONS);
    let (used, unused) = match direction {
        Some(ForceDirection::Rotational) => (ROTATIONAL, TRANSLATIONAL),
        _ => (TRANSLATIONAL, ROTATIONAL),
    };
    if direction.is_some() {
        for (wrong, right) in unused.into_iter().zip(used) {
            if reading.has(wrong) {
                let span = reading.place(wrong);
                let kind = if used == ROTATIONAL {
                    "rotational"
                } else {
                    "translational"
                };
                reading
                    .diagnostics
                    .error(
                        Code::ConflictingArguments,
                        span,
                        format!("a {kind} SPRINGDAMPER has no {wrong}"),
                    )
                    .help(format!("write {right}"));
            }
        }
    }
    angles::check(reading, "ANGLE", 1);
    let [stiffness, damping, free_length, preload] =
        used.map(|keyword| reading.real(keyword).unwrap_or(0.0));
    let spring = SpringDamper {
        header: reading.header(),
        direction: direction.unwrap_or(ForceDirection::Translational),
        i: builder.require(reading, "I", Target::Marker),
        j: builder.require(reading, "J", Target::Marker),
        stiffness,
        damping,
        free_length,
        preload,
    };
    let list = &mut builder.dataset.spring_dampers;
    add(list, spring, reading.name, reading.diagnostics);
}
