//! FRICTION fits its joint.

use crate::diagnostic::{Code, Diagnostics};
use crate::model::{
    Formulation, Friction, FrictionArguments, FrictionInputs, JointKind, LengthUnit, TimeUnit, Yoke,
};
use crate::source::Span;
use crate::statements::{Builder, FrictionPlaces};
use std::collections::HashMap;

/// Reports friction that cannot act, and what a reader should know about that which can.
pub(super) fn check(builder: &Builder, diagnostics: &mut Diagnostics) {
    let dataset = &builder.dataset;
    let mut first: HashMap<(u32, Option<Yoke>), u32> = HashMap::new();
    for (friction, places) in dataset.frictions.iter().zip(&builder.frictions) {
        let id = friction.header.id;
        let Some(joint) = dataset.joints.by_id(friction.joint) else {
            continue;
        };
        if !joint_fits(friction, joint.kind, places, diagnostics) {
            continue;
        }
        let axis = (friction.joint, friction.yoke);
        if let Some(other) = first.insert(axis, id) {
            let of = friction
                .yoke
                .map_or(String::new(), |yoke| format!("{} of ", yoke.keyword()));
            let message = format!("{of}JOINT/{} has FRICTION/{other} already", friction.joint);
            let span = places.yoke.unwrap_or(places.joint);
            diagnostics.error(Code::FrictionJoint, span, message);
        }
        unused_arguments(friction, joint.kind, &places.arguments, diagnostics);
        dimensional_defaults(builder, friction, joint.kind, places.head, diagnostics);
    }
}

/// The joint has friction, and a yoke if and only if it needs one.
fn joint_fits(
    friction: &Friction,
    joint: JointKind,
    places: &FrictionPlaces,
    diagnostics: &mut Diagnostics,
) -> bool {
    use JointKind as J;
    let name = format_args!("FRICTION/{}", friction.header.id);
    let keyword = joint.keyword();
    match joint {
        J::Hooke | J::Universal => {
            if friction.yoke.is_some() {
                return true;
            }
            let message = format!("{name} does not say which axis of the {keyword} joint it is on");
            diagnostics
                .error(Code::FrictionJoint, places.head, message)
                .help("add I_YOKE or J_YOKE; friction on both axes takes two FRICTIONs");
        }
        J::Revolute | J::Translational | J::Cylindrical | J::Spherical => {
            let Some(yoke) = places.yoke else {
                return true;
            };
            let message = format!("{name}: a {keyword} joint has no yokes");
            diagnostics
                .error(Code::FrictionJoint, yoke, message)
                .help("remove I_YOKE or J_YOKE");
        }
        _ => {
            let message = format!("{name}: joint type {keyword} has no friction");
            diagnostics
                .error(Code::FrictionJoint, places.joint, message)
                .note(format!("it is on JOINT/{}", friction.joint));
        }
    }
    false
}

/// Warns of the arguments in `given` that friction of this kind does not use, and of coefficients
/// that make it weaker at rest than in motion.
pub(crate) fn unused_arguments(
    friction: &Friction,
    joint: JointKind,
    given: &FrictionArguments,
    diagnostics: &mut Diagnostics,
) {
    let name = format_args!("FRICTION/{}", friction.header.id);
    let mut unused = |keyword: &str, span: Span, by: &str| {
        let message = format!("{keyword} of {name} is not used by {by}");
        diagnostics.warning(Code::UnusedArgument, span, message);
    };
    for (quantity, _, span) in &given.quantities {
        if let Some(by) = friction.unused(*quantity, joint) {
            unused(quantity.keyword(), *span, &by);
        }
    }
    if let Some((_, span)) = given.effect
        && friction.formulation == Formulation::LuGre
    {
        unused("EFFECT", span, "FORMULATION = LUGRE");
    }
    let by_joint = format!("a {} joint", joint.keyword());
    if let Some((_, span)) = given.overlap_delta {
        if !joint.translates() {
            unused("OVERLAP_DELTA", span, &by_joint);
        } else if !friction.inputs.bending_moment {
            unused("OVERLAP_DELTA", span, "INPUTS without BENDING_MOMENT");
        }
    }
    if let Some((inputs, span)) = given.inputs.filter(|(i, _)| *i != FrictionInputs::ALL) {
        if inputs.torsional_moment && joint != JointKind::Translational {
            unused("INPUTS = TORSIONAL_MOMENT", span, &by_joint);
        }
        if inputs.bending_moment && joint == JointKind::Spherical {
            unused("INPUTS = BENDING_MOMENT", span, &by_joint);
        }
    }
    let coefficient = given.mu_static.or(given.mu_dynamic);
    if let Some((_, span)) = coefficient.filter(|_| friction.mu_static < friction.mu_dynamic) {
        let message = format!("MU_STATIC of {name} is less than its MU_DYNAMIC");
        diagnostics.warning(Code::StaticBelowDynamic, span, message);
    }
}

/// Defaults are plain numbers, meant for millimetres and seconds.
fn dimensional_defaults(
    builder: &Builder,
    friction: &Friction,
    joint: JointKind,
    head: Span,
    diagnostics: &mut Diagnostics,
) {
    let units = builder.dataset.units.as_ref();
    let length = units.and_then(|units| units.length);
    let time = units.and_then(|units| units.time);
    let of_length = length != Some(LengthUnit::Millimeter);
    let of_time = time != Some(TimeUnit::Second);
    if !of_length && !of_time {
        return;
    }
    let defaults: Vec<String> = friction
        .defaults_in_use(joint)
        .into_iter()
        .filter(|default| {
            (of_length && default.depends_on_length_unit())
                || (of_time && default.depends_on_time_unit())
        })
        .map(|default| {
            let dimension = default.quantity.dimension().as_str();
            let keyword = default.quantity.keyword();
            format!("{keyword} = {} {dimension}", default.value)
        })
        .collect();
    if defaults.is_empty() {
        return;
    }
    let length = length.map_or("not given", LengthUnit::keyword);
    let time = time.map_or("not given", TimeUnit::keyword);
    let units = match (of_length, of_time) {
        (true, false) => format!("the length unit, which is {length}"),
        (false, _) => format!("the time unit, which is {time}"),
        (true, true) => format!("the units, length {length} and time {time}"),
    };
    let message = format!(
        "FRICTION/{} uses defaults that depend on {units}: {}",
        friction.header.id,
        defaults.join(", ")
    );
    diagnostics
        .warning(Code::DimensionalDefault, head, message)
        .note("they are plain numbers, meant for millimetres and seconds")
        .help("give these arguments in the units of the model");
}
