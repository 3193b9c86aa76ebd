//! FRICTION that acts in part, on nothing, or on a motion that it cannot change.

use crate::diagnostic::{Code, Diagnostics};
use crate::model::{
    Dataset, Effect, Friction, FrictionInputs, FrictionQuantity, Joint, JointKind, Motion,
    MotionDirection, MotionTarget,
};
use crate::statements::{Builder, FrictionPlaces};

/// Warns of what the frictions of joints leave out, and of friction that changes nothing.
pub(super) fn check(builder: &Builder, diagnostics: &mut Diagnostics) {
    let dataset = &builder.dataset;
    for (friction, places) in dataset.frictions.iter().zip(&builder.frictions) {
        let Some(joint) = dataset.joints.by_id(friction.joint) else {
            continue;
        };
        inputs(friction, joint, places, diagnostics);
        effect(friction, places, diagnostics);
        prescribed(dataset, friction, joint, places, diagnostics);
    }
}

/// The loads of INPUTS that friction in a joint of this kind can have beside a preload, with
/// whether they are on.
fn loads(inputs: &FrictionInputs, joint: JointKind) -> Vec<(&'static str, bool)> {
    let mut loads = vec![("REACTION_FORCE", inputs.reaction_force)];
    if joint != JointKind::Spherical {
        loads.push(("BENDING_MOMENT", inputs.bending_moment));
    }
    if joint == JointKind::Translational {
        loads.push(("TORSIONAL_MOMENT", inputs.torsional_moment));
    }
    loads
}

/// Loads that INPUTS leaves out, or all of them.
fn inputs(
    friction: &Friction,
    joint: &Joint,
    places: &FrictionPlaces,
    diagnostics: &mut Diagnostics,
) {
    let Some((inputs, span)) = places.arguments.inputs else {
        return;
    };
    let id = friction.header.id;
    let loads = loads(&inputs, joint.kind);
    let preload = [
        FrictionQuantity::FrictionForcePreload,
        FrictionQuantity::FrictionTorquePreload,
    ];
    let preloaded = inputs.preload && preload.iter().any(|q| friction.value(*q) > 0.0);
    if !preloaded && loads.iter().all(|(_, on)| !on) {
        let message = format!(
            "FRICTION/{id} is zero: nothing in its INPUTS loads JOINT/{}",
            joint.header.id
        );
        diagnostics
            .warning(Code::NoFriction, span, message)
            .help("name the loads that make friction, or leave INPUTS out for all of them");
        return;
    }
    let off: Vec<&str> = loads
        .iter()
        .filter(|(_, on)| !on)
        .map(|(name, _)| *name)
        .collect();
    if off.is_empty() {
        return;
    }
    let message = format!("INPUTS of FRICTION/{id} leaves out {}", off.join(" and "));
    diagnostics
        .warning(Code::SwitchedOff, span, message)
        .note(format!(
            "that part of the load of JOINT/{} makes no friction",
            joint.header.id
        ))
        .help("leave INPUTS out for all loads");
}

/// A regime that EFFECT leaves out.
fn effect(friction: &Friction, places: &FrictionPlaces, diagnostics: &mut Diagnostics) {
    let Some((effect, span)) = places.arguments.effect else {
        return;
    };
    let (regime, consequence) = match effect {
        Effect::All => return,
        Effect::Stiction => (
            "sliding",
            "a joint that slides has MU_STATIC as its coefficient",
        ),
        Effect::Sliding => ("stiction", "a joint at rest creeps under any load"),
    };
    let message = format!(
        "EFFECT of FRICTION/{} leaves out {regime}",
        friction.header.id
    );
    diagnostics
        .warning(Code::SwitchedOff, span, message)
        .note(consequence)
        .help("leave EFFECT out for stiction and sliding");
}

/// Motions that prescribe all that the friction resists.
fn prescribed(
    dataset: &Dataset,
    friction: &Friction,
    joint: &Joint,
    places: &FrictionPlaces,
    diagnostics: &mut Diagnostics,
) {
    let driver = |rotation| {
        let mut motions = dataset.motions.iter();
        motions.find(|motion| drives(motion, joint, rotation))
    };
    let freedoms: &[bool] = match joint.kind {
        JointKind::Revolute => &[true],
        JointKind::Translational => &[false],
        JointKind::Cylindrical => &[true, false],
        _ => return,
    };
    let Some(motions) = freedoms
        .iter()
        .map(|rotation| driver(*rotation))
        .collect::<Option<Vec<&Motion>>>()
    else {
        return;
    };
    let names: Vec<String> = motions
        .iter()
        .map(|motion| format!("MOTION/{}", motion.header.id))
        .collect();
    let names = names.join(" and ");
    let message = format!(
        "FRICTION/{} cannot change the motion of JOINT/{}, which {names} prescribes",
        friction.header.id, joint.header.id
    );
    diagnostics
        .warning(Code::PrescribedFriction, places.head, message)
        .note(format!("it is part of the load of {names}"))
        .help("drive the joint by a force where friction should resist it");
}

/// Whether a motion prescribes the rotation, or the displacement, of a joint about z of J.
fn drives(motion: &Motion, joint: &Joint, rotation: bool) -> bool {
    let id = joint.header.id;
    match motion.target {
        MotionTarget::JointRotation(of) => rotation && of == id,
        MotionTarget::JointTranslation(of) => !rotation && of == id,
        MotionTarget::Markers { i, j, direction } => {
            let along = match rotation {
                true => MotionDirection::B3,
                false => MotionDirection::Z,
            };
            let same = (i, j) == (joint.i, joint.j) || (j, i) == (joint.i, joint.j);
            same && direction == along
        }
    }
}
