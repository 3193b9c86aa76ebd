//! MOTION.

use super::{Builder, Target, add};
use crate::checks::angles;
use crate::diagnostic::{Code, Diagnostics};
use crate::keywords::{INTERFACE, Keyword, Kind, ROUTINE, abbreviated, keyword};
use crate::model::{JointKind, Motion, MotionDirection, MotionLevel, MotionTarget};
use crate::reading::Reading;

pub(super) const KEYWORDS: &[Keyword] = &[
    keyword("JOINT", Kind::Id),
    keyword("I", Kind::Id),
    abbreviated("J", "J", Kind::Id),
    abbreviated("ROTATIONAL", "RO", Kind::Flag),
    abbreviated("TRANSLATIONAL", "TR", Kind::Flag),
    keyword("X", Kind::Flag),
    keyword("Y", Kind::Flag),
    keyword("Z", Kind::Flag),
    keyword("B1", Kind::Flag),
    keyword("B2", Kind::Flag),
    keyword("B3", Kind::Flag),
    abbreviated("DISPLACEMENT", "D", Kind::Flag),
    abbreviated("VELOCITY", "V", Kind::Flag),
    abbreviated("ACCELERATION", "A", Kind::Flag),
    abbreviated("FUNCTION", "FU", Kind::Expression),
    keyword("ICDISP", Kind::Real),
    keyword("ICVEL", Kind::Real),
    ROUTINE,
    INTERFACE,
];

const DIRECTIONS: [(&str, MotionDirection); 6] = [
    ("X", MotionDirection::X),
    ("Y", MotionDirection::Y),
    ("Z", MotionDirection::Z),
    ("B1", MotionDirection::B1),
    ("B2", MotionDirection::B2),
    ("B3", MotionDirection::B3),
];

/// MOTION.
pub(super) fn motion(reading: &mut Reading, builder: &mut Builder) {
    let target = if reading.has("JOINT") {
        reading.exclude("JOINT", &["I", "J", "X", "Y", "Z", "B1", "B2", "B3"]);
        let joint = builder.require(reading, "JOINT", Target::Joint);
        let flags = [("ROTATIONAL", true), ("TRANSLATIONAL", false)];
        match reading.one_flag(&flags) {
            Some(false) => MotionTarget::JointTranslation(joint),
            Some(true) => MotionTarget::JointRotation(joint),
            None => {
                builder.unnamed_freedoms.push((reading.id, reading.head));
                MotionTarget::JointRotation(joint)
            }
        }
    } else {
        for keyword in ["ROTATIONAL", "TRANSLATIONAL"] {
            if reading.has(keyword) {
                let message = format!("{keyword} belongs to a motion of a JOINT");
                let span = reading.place(keyword);
                reading
                    .diagnostics
                    .error(Code::ConflictingArguments, span, message)
                    .help("add JOINT, or give I, J and one of X, Y, Z, B1, B2, B3");
            }
        }
        let direction = reading.required_flag("a direction", &DIRECTIONS);
        MotionTarget::Markers {
            i: builder.require(reading, "I", Target::Marker),
            j: builder.require(reading, "J", Target::Marker),
            direction: direction.unwrap_or(MotionDirection::X),
        }
    };
    let levels = [
        ("DISPLACEMENT", MotionLevel::Displacement),
        ("VELOCITY", MotionLevel::Velocity),
        ("ACCELERATION", MotionLevel::Acceleration),
    ];
    let level = reading.one_flag(&levels).unwrap_or_default();
    for (keyword, used) in [
        ("ICDISP", level != MotionLevel::Displacement),
        ("ICVEL", level == MotionLevel::Acceleration),
    ] {
        if reading.has(keyword) && !used {
            let message = format!("{keyword} has no effect: the function gives it already");
            let span = reading.place(keyword);
            reading.diagnostics.note(Code::Ignored, span, message);
        }
    }
    if turns(target) {
        angles::check(reading, "ICDISP", 1);
    }
    let motion = Motion {
        header: reading.header(),
        target,
        level,
        function: reading.required_expression("FUNCTION"),
        ic_displacement: reading.real("ICDISP"),
        ic_velocity: reading.real("ICVEL"),
    };
    add(
        &mut builder.dataset.motions,
        motion,
        reading.name,
        reading.diagnostics,
    );
}

/// Whether it is an angle that a motion prescribes.
const fn turns(target: MotionTarget) -> bool {
    use MotionDirection as D;
    match target {
        MotionTarget::JointRotation(_) => true,
        MotionTarget::JointTranslation(_) => false,
        MotionTarget::Markers { direction, .. } => matches!(direction, D::B1 | D::B2 | D::B3),
    }
}

/// Gives motions of joints that name no freedom the one that their joint has: only a cylindrical
/// joint has two (Adams Solver, MOTION: ROTATION).
pub(crate) fn name_freedoms(builder: &mut Builder, diagnostics: &mut Diagnostics) {
    for (id, head) in std::mem::take(&mut builder.unnamed_freedoms) {
        let model = &mut builder.dataset;
        let Some(motion) = model.motions.by_id_mut(id) else {
            continue;
        };
        let MotionTarget::JointRotation(joint) = motion.target else {
            continue;
        };
        match model.joints.by_id(joint).map(|joint| joint.kind) {
            Some(JointKind::Translational) => motion.target = MotionTarget::JointTranslation(joint),
            Some(JointKind::Cylindrical) => {
                let message = format!("MOTION/{id} needs ROTATIONAL or TRANSLATIONAL");
                diagnostics
                    .error(Code::MissingArgument, head, message)
                    .help("a CYLINDRICAL joint both turns and slides");
            }
            _ => {}
        }
    }
}
