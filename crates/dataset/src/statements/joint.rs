//! JOINT, JPRIM and GCON.

use super::{Builder, Target, add};
use crate::checks::angles;
use crate::diagnostic::Code;
use crate::keywords::{Keyword, Kind, abbreviated, keyword};
use crate::model::{
    GeneralConstraint, InitialCondition, Joint, JointKind, JointPrimitive, PrimitiveKind,
};
use crate::reading::Reading;

const LEGACY: &str = "friction inside JOINT is that of the old Fortran solver; use FRICTION";

pub(super) const JOINT_KEYWORDS: &[Keyword] = &[
    keyword("CONVEL", Kind::Flag),
    abbreviated("CYLINDRICAL", "C", Kind::Flag),
    abbreviated("FIXED", "FIX", Kind::Flag),
    abbreviated("HOOKE", "HO", Kind::Flag),
    abbreviated("PLANAR", "PL", Kind::Flag),
    abbreviated("RACKPIN", "RA", Kind::Flag),
    abbreviated("REVOLUTE", "RE", Kind::Flag),
    abbreviated("SCREW", "SC", Kind::Flag),
    abbreviated("SPHERICAL", "SP", Kind::Flag),
    abbreviated("TRANSLATIONAL", "T", Kind::Flag),
    abbreviated("UNIVERSAL", "U", Kind::Flag),
    keyword("I", Kind::Id),
    keyword("J", Kind::Id),
    keyword("IC", Kind::Reals(1, 2)),
    abbreviated("ICTRAN", "ICT", Kind::Reals(1, 2)),
    abbreviated("ICROT", "ICR", Kind::Reals(1, 2)),
    abbreviated("PITCH", "PI", Kind::Real),
    keyword("PD", Kind::Real),
    keyword("FRICTION", Kind::Unsupported(LEGACY)),
    keyword("DELTA_V", Kind::Unsupported(LEGACY)),
    keyword("HEIGHT", Kind::Unsupported(LEGACY)),
    keyword("INNER_RADIUS", Kind::Unsupported(LEGACY)),
    keyword("MAXIMUM_DEFORMATION", Kind::Unsupported(LEGACY)),
    keyword("MAX_FRIC_ROT", Kind::Unsupported(LEGACY)),
    keyword("MAX_FRIC_TRANS", Kind::Unsupported(LEGACY)),
    keyword("MU_DYN_ROT", Kind::Unsupported(LEGACY)),
    keyword("MU_DYN_TRANS", Kind::Unsupported(LEGACY)),
    keyword("MU_STAT_ROT", Kind::Unsupported(LEGACY)),
    keyword("MU_STAT_TRANS", Kind::Unsupported(LEGACY)),
    keyword("OUTER_RADIUS", Kind::Unsupported(LEGACY)),
    keyword("PRELOAD_AXIAL", Kind::Unsupported(LEGACY)),
    keyword("PRELOAD_RADIAL", Kind::Unsupported(LEGACY)),
    keyword("PRELOAD_X", Kind::Unsupported(LEGACY)),
    keyword("PRELOAD_Y", Kind::Unsupported(LEGACY)),
    keyword("WIDTH", Kind::Unsupported(LEGACY)),
];

const KINDS: [(&str, JointKind); 11] = [
    ("CONVEL", JointKind::ConstantVelocity),
    ("CYLINDRICAL", JointKind::Cylindrical),
    ("FIXED", JointKind::Fixed),
    ("HOOKE", JointKind::Hooke),
    ("PLANAR", JointKind::Planar),
    ("RACKPIN", JointKind::RackPinion),
    ("REVOLUTE", JointKind::Revolute),
    ("SCREW", JointKind::Screw),
    ("SPHERICAL", JointKind::Spherical),
    ("TRANSLATIONAL", JointKind::Translational),
    ("UNIVERSAL", JointKind::Universal),
];

/// JOINT.
pub(super) fn joint(reading: &mut Reading, builder: &mut Builder) {
    let Some(kind) = reading.required_flag("a type", &KINDS) else {
        // The identifier is known, so that references to it are not reported as well.
        return push(reading, builder, JointKind::Fixed);
    };
    for (screw, keyword) in [(JointKind::Screw, "PITCH"), (JointKind::RackPinion, "PD")] {
        if kind == screw {
            reading.require(keyword);
        }
        if kind == screw && reading.real(keyword) == Some(0.0) {
            let span = reading.place(keyword);
            let message = format!("{keyword} must not be 0");
            reading.diagnostics.error(Code::OutOfRange, span, message);
        }
    }
    for (keyword, allowed) in [
        (
            "IC",
            matches!(kind, JointKind::Revolute | JointKind::Translational),
        ),
        ("ICTRAN", matches!(kind, JointKind::Cylindrical)),
        ("ICROT", matches!(kind, JointKind::Cylindrical)),
        ("PITCH", matches!(kind, JointKind::Screw)),
        ("PD", matches!(kind, JointKind::RackPinion)),
    ] {
        if reading.has(keyword) && !allowed {
            let span = reading.place(keyword);
            let message = format!("a joint of type {} has no {keyword}", kind.keyword());
            let error = reading
                .diagnostics
                .error(Code::ConflictingArguments, span, message);
            if matches!(kind, JointKind::Cylindrical) && keyword == "IC" {
                error.help("write ICTRAN for the displacement and ICROT for the angle");
            }
        }
    }
    push(reading, builder, kind);
}

fn push(reading: &mut Reading, builder: &mut Builder, kind: JointKind) {
    match kind {
        JointKind::Revolute => angles::check(reading, "IC", 1),
        JointKind::Cylindrical => angles::check(reading, "ICROT", 1),
        _ => {}
    }
    let initial = |keyword| match reading.reals(keyword) {
        [] => None,
        values => Some(InitialCondition {
            displacement: values.first().map(|(value, _)| *value),
            velocity: values.get(1).map(|(value, _)| *value),
        }),
    };
    let (translation, rotation) = match kind {
        JointKind::Translational => (initial("IC"), None),
        JointKind::Revolute => (None, initial("IC")),
        _ => (initial("ICTRAN"), initial("ICROT")),
    };
    let joint = Joint {
        header: reading.header(),
        kind,
        pitch: reading.real("PITCH"),
        pitch_diameter: reading.real("PD"),
        ic_translation: translation,
        ic_rotation: rotation,
        i: builder.require(reading, "I", Target::Marker),
        j: builder.require(reading, "J", Target::Marker),
    };
    add(
        &mut builder.dataset.joints,
        joint,
        reading.name,
        reading.diagnostics,
    );
}

pub(super) const PRIMITIVE_KEYWORDS: &[Keyword] = &[
    abbreviated("ATPOINT", "AT", Kind::Flag),
    abbreviated("INLINE", "INL", Kind::Flag),
    abbreviated("INPLANE", "INP", Kind::Flag),
    abbreviated("ORIENTATION", "OR", Kind::Flag),
    abbreviated("PARALLEL_AXES", "PAR", Kind::Flag),
    abbreviated("PERPENDICULAR", "PERP", Kind::Flag),
    keyword("I", Kind::Id),
    keyword("J", Kind::Id),
];

/// JPRIM.
pub(super) fn primitive(reading: &mut Reading, builder: &mut Builder) {
    let kinds = [
        PrimitiveKind::AtPoint,
        PrimitiveKind::Inline,
        PrimitiveKind::Inplane,
        PrimitiveKind::Orientation,
        PrimitiveKind::ParallelAxes,
        PrimitiveKind::Perpendicular,
    ]
    .map(|kind| (kind.keyword(), kind));
    let kind = reading.required_flag("a type", &kinds);
    let primitive = JointPrimitive {
        header: reading.header(),
        kind: kind.unwrap_or(PrimitiveKind::AtPoint),
        i: builder.require(reading, "I", Target::Marker),
        j: builder.require(reading, "J", Target::Marker),
    };
    let list = &mut builder.dataset.primitives;
    add(list, primitive, reading.name, reading.diagnostics);
}

pub(super) const CONSTRAINT_KEYWORDS: &[Keyword] = &[
    keyword("I", Kind::Id),
    abbreviated("FUNCTION", "FU", Kind::Expression),
];

/// GCON.
pub(super) fn constraint(reading: &mut Reading, builder: &mut Builder) {
    let constraint = GeneralConstraint {
        header: reading.header(),
        i: builder.refer(reading, "I", Target::Marker),
        function: reading.required_expression("FUNCTION"),
    };
    let list = &mut builder.dataset.constraints;
    add(list, constraint, reading.name, reading.diagnostics);
}
