//! FRICTION fits its joint.

use crate::diagnostic::{Code, Diagnostics};
use crate::model::{
    Effect, Formulation, Friction, FrictionArguments, FrictionInputs, FrictionQuantity, JointKind,
    LengthUnit, OverlapDelta, Yoke,
};
use crate::source::Span;
use crate::statements::Builder;
use std::collections::HashMap;

/// Reports friction that cannot act, and what a reader should know about that which can.
pub(super) fn check(builder: &Builder, diagnostics: &mut Diagnostics) {
    let dataset = &builder.dataset;
    let mut first: HashMap<(u32, Option<Yoke>), u32> = HashMap::new();
    for (friction, given) in dataset.frictions.iter().zip(&builder.friction_arguments) {
        let span = friction.header.span;
        let id = friction.header.id;
        let Some(joint) = dataset.joints.by_id(friction.joint) else {
            continue;
        };
        if !joint_fits(friction, joint.kind, diagnostics) {
            continue;
        }
        let axis = (friction.joint, friction.yoke);
        if let Some(other) = first.insert(axis, id) {
            let message = format!("JOINT/{} has FRICTION/{other} already", friction.joint);
            diagnostics.error(Code::FrictionJoint, span, message);
        }
        unused_arguments(friction, joint.kind, given, span, diagnostics);
        dimensional_defaults(builder, friction, joint.kind, diagnostics);
    }
}

/// The joint has friction, and a yoke if and only if it needs one.
fn joint_fits(friction: &Friction, joint: JointKind, diagnostics: &mut Diagnostics) -> bool {
    use JointKind as J;
    let span = friction.header.span;
    let name = format!("FRICTION/{}", friction.header.id);
    let keyword = joint.keyword();
    match joint {
        J::Hooke | J::Universal if friction.yoke.is_none() => {
            let message = format!("{name} does not say which axis of the {keyword} joint it is on");
            diagnostics
                .error(Code::FrictionJoint, span, message)
                .help("add I_YOKE or J_YOKE; friction on both axes takes two FRICTIONs");
        }
        J::Hooke | J::Universal => return true,
        J::Revolute | J::Translational | J::Cylindrical | J::Spherical => {
            if friction.yoke.is_none() {
                return true;
            }
            let message = format!("{name}: a {keyword} joint has no yokes");
            diagnostics
                .error(Code::FrictionJoint, span, message)
                .help("remove I_YOKE or J_YOKE");
        }
        _ => {
            let message = format!("{name}: joint type {keyword} has no friction");
            diagnostics
                .error(Code::FrictionJoint, span, message)
                .note(format!("it is on JOINT/{}", friction.joint));
        }
    }
    false
}

/// Warns of the arguments in `given` that friction of this kind does not use, and of a friction
/// that is weaker at rest than in motion; `statement` is the place of what gives them.
pub(crate) fn unused_arguments(
    friction: &Friction,
    joint: JointKind,
    given: &FrictionArguments,
    statement: Span,
    diagnostics: &mut Diagnostics,
) {
    use FrictionQuantity as Q;
    let name = format!("FRICTION/{}", friction.header.id);
    let mut unused = |keyword: &str, span, by: &str| {
        let message = format!("{keyword} of {name} is not used by {by}");
        diagnostics.warning(Code::UnusedArgument, span, message);
    };
    let by_joint = format!("a {} joint", joint.keyword());
    let by_formulation = match friction.formulation {
        Formulation::Original => "FORMULATION = ORIGINAL",
        Formulation::LuGre => "FORMULATION = LUGRE",
    };
    for (quantity, _, span) in &given.quantities {
        if !quantity.used_in(friction.formulation) {
            unused(quantity.keyword(), *span, by_formulation);
        } else if !quantity.used_by(joint) {
            unused(quantity.keyword(), *span, &by_joint);
        } else if matches!(quantity, Q::FrictionForcePreload | Q::FrictionTorquePreload)
            && !friction.inputs.preload
        {
            unused(quantity.keyword(), *span, "INPUTS without PRELOAD");
        }
    }
    if given.effect.is_some_and(|effect| effect != Effect::All)
        && friction.formulation == Formulation::LuGre
    {
        unused("EFFECT", statement, by_formulation);
    }
    let slides = joint.translates();
    if !slides
        && given
            .overlap_delta
            .is_some_and(|delta| delta != OverlapDelta::Constant)
    {
        unused("OVERLAP_DELTA", statement, &by_joint);
    }
    if let Some(inputs) = given.inputs.filter(|inputs| *inputs != FrictionInputs::ALL) {
        if inputs.torsional_moment && joint != JointKind::Translational {
            unused("INPUTS = TORSIONAL_MOMENT", statement, &by_joint);
        }
        if inputs.bending_moment && joint == JointKind::Spherical {
            unused("INPUTS = BENDING_MOMENT", statement, &by_joint);
        }
    }
    if friction.mu_static < friction.mu_dynamic {
        let message = format!("MU_STATIC of {name} is less than its MU_DYNAMIC");
        diagnostics.warning(Code::StaticBelowDynamic, statement, message);
    }
}

/// Defaults are plain numbers, meant for millimetres.
fn dimensional_defaults(
    builder: &Builder,
    friction: &Friction,
    joint: JointKind,
    diagnostics: &mut Diagnostics,
) {
    let length = builder
        .dataset
        .units
        .as_ref()
        .and_then(|units| units.length);
    if length == Some(LengthUnit::Millimeter) {
        return;
    }
    let defaults: Vec<String> = friction
        .defaults_in_use(joint)
        .into_iter()
        .filter(|default| default.depends_on_length_unit())
        .map(|default| {
            let dimension = default.quantity.dimension().as_str();
            let keyword = default.quantity.keyword();
            format!("{keyword} = {} {dimension}", default.value)
        })
        .collect();
    if defaults.is_empty() {
        return;
    }
    let unit = length.map_or("not given", LengthUnit::keyword);
    let message = format!(
        "FRICTION/{} uses defaults that depend on the length unit, which is {unit}: {}",
        friction.header.id,
        defaults.join(", ")
    );
    diagnostics
        .warning(Code::DimensionalDefault, friction.header.span, message)
        .help("give these arguments in the units of the model");
}
