//! The ends of joints, motions and forces, and the markers of parts, fit together.

use crate::diagnostic::{Code, Diagnostics};
use crate::model::{Dataset, MarkerOwner, MotionTarget};
use crate::source::Span;
use std::fmt;

/// Reports connections that cannot be made.
pub(super) fn check(dataset: &Dataset, diagnostics: &mut Diagnostics) {
    for joint in &dataset.joints {
        let name = format_args!("JOINT/{}", joint.header.id);
        two_parts(
            dataset,
            name,
            joint.i,
            joint.j,
            joint.header.span,
            diagnostics,
        );
    }
    for primitive in &dataset.primitives {
        let name = format_args!("JPRIM/{}", primitive.header.id);
        let (i, j) = (primitive.i, primitive.j);
        two_parts(dataset, name, i, j, primitive.header.span, diagnostics);
    }
    for force in &dataset.single_forces {
        let name = format_args!("SFORCE/{}", force.header.id);
        two_markers(name, force.i, force.j, force.header.span, diagnostics);
    }
    for spring in &dataset.spring_dampers {
        let name = format_args!("SPRINGDAMPER/{}", spring.header.id);
        two_markers(name, spring.i, spring.j, spring.header.span, diagnostics);
    }
    for (name, list) in [
        ("VFORCE", &dataset.vector_forces),
        ("VTORQUE", &dataset.vector_torques),
        ("GFORCE", &dataset.general_forces),
    ] {
        for force in list {
            let name = format_args!("{name}/{}", force.header.id);
            two_parts(
                dataset,
                name,
                force.i,
                force.j_float,
                force.header.span,
                diagnostics,
            );
        }
    }
    for bushing in &dataset.bushings {
        let name = format_args!("BUSHING/{}", bushing.header.id);
        two_markers(name, bushing.i, bushing.j, bushing.header.span, diagnostics);
    }
    for field in &dataset.fields {
        let name = format_args!("FIELD/{}", field.header.id);
        two_markers(name, field.i, field.j, field.header.span, diagnostics);
    }
    for beam in &dataset.beams {
        let name = format_args!("BEAM/{}", beam.header.id);
        two_markers(name, beam.i, beam.j, beam.header.span, diagnostics);
    }
    for point in &dataset.point_curves {
        let name = format_args!("PTCV/{}", point.header.id);
        two_parts(
            dataset,
            name,
            point.i,
            point.rm,
            point.header.span,
            diagnostics,
        );
    }
    couplers(dataset, diagnostics);
    gears(dataset, diagnostics);
    motions(dataset, diagnostics);
    parts(dataset, diagnostics);
}

/// I and J are two markers. Returns whether they are.
fn two_markers(
    name: fmt::Arguments,
    i: u32,
    j: u32,
    span: Span,
    diagnostics: &mut Diagnostics,
) -> bool {
    if i != j || i == 0 {
        return true;
    }
    let message = format!("I and J of {name} are the same MARKER/{i}");
    diagnostics.error(Code::InvalidConnection, span, message);
    false
}

/// I and J are on two parts.
fn two_parts(
    dataset: &Dataset,
    name: fmt::Arguments,
    i: u32,
    j: u32,
    span: Span,
    diagnostics: &mut Diagnostics,
) {
    if !two_markers(name, i, j, span, diagnostics) {
        return;
    }
    let owner = |id| dataset.markers.by_id(id).map(|marker| marker.owner);
    let (Some(owner_i), Some(owner_j)) = (owner(i), owner(j)) else {
        return;
    };
    let (body, id) = match owner_i {
        MarkerOwner::Part(id) if id > 0 => ("PART", id),
        MarkerOwner::PointMass(id) if id > 0 => ("POINT_MASS", id),
        _ => return,
    };
    if owner_i == owner_j {
        let message = format!("both markers of {name} are on {body}/{id}");
        diagnostics
            .error(Code::InvalidConnection, span, message)
            .note(format!("I = {i} and J = {j}"))
            .help("the two markers belong on different parts");
    }
}

/// Coupled joints have the coordinates that are coupled.
fn couplers(dataset: &Dataset, diagnostics: &mut Diagnostics) {
    for coupler in &dataset.couplers {
        let name = format_args!("COUPLER/{}", coupler.header.id);
        for freedom in &coupler.freedoms {
            let Some(joint) = dataset.joints.by_id(freedom.joint) else {
                continue;
            };
            if joint.kind.coordinate(freedom.rotation).is_some() {
                continue;
            }
            let (id, kind) = (freedom.joint, joint.kind.keyword());
            let (message, help) = match freedom.rotation {
                None if joint.kind.rotates() => (
                    format!("{name} does not say which coordinate of JOINT/{id} it couples"),
                    "add TYPE, a list of R (rotation) and T (translation), one a joint",
                ),
                _ => (
                    format!("{name} couples a freedom that JOINT/{id} has not: it is {kind}"),
                    "REVOLUTE rotates, TRANSLATIONAL translates, CYLINDRICAL does both",
                ),
            };
            diagnostics
                .error(Code::NoSuchFreedom, coupler.header.span, message)
                .help(help);
        }
    }
}

/// Geared joints move on the part of CV.
fn gears(dataset: &Dataset, diagnostics: &mut Diagnostics) {
    let owner = |id| dataset.markers.by_id(id).map(|marker| marker.owner);
    for gear in &dataset.gears {
        let name = format_args!("GEAR/{}", gear.header.id);
        let span = gear.header.span;
        let Some(carrier) = owner(gear.cv) else {
            continue;
        };
        for joint in gear
            .joints
            .iter()
            .filter_map(|id| dataset.joints.by_id(*id))
        {
            let (id, kind) = (joint.header.id, joint.kind);
            if !kind.rotates() && !kind.translates() {
                let message = format!(
                    "{name} gears JOINT/{id}, which has no coordinate: it is {}",
                    kind.keyword()
                );
                diagnostics
                    .error(Code::NoSuchFreedom, span, message)
                    .help("REVOLUTE, TRANSLATIONAL and CYLINDRICAL joints can be geared");
            }
            let ends = [joint.i, joint.j].map(owner);
            if !ends.contains(&Some(carrier)) && ends.iter().all(Option::is_some) {
                let message = format!(
                    "JOINT/{id} of {name} has no marker on the part of CV, MARKER/{}",
                    gear.cv
                );
                diagnostics
                    .error(Code::InvalidConnection, span, message)
                    .help("CV is on the carrier, which both joints connect to a geared part");
            }
        }
    }
}

fn motions(dataset: &Dataset, diagnostics: &mut Diagnostics) {
    for motion in &dataset.motions {
        let name = format_args!("MOTION/{}", motion.header.id);
        let span = motion.header.span;
        let (id, freedom, rotation) = match motion.target {
            MotionTarget::JointRotation(id) => (id, "rotation", true),
            MotionTarget::JointTranslation(id) => (id, "translation", false),
            MotionTarget::Markers { i, j, .. } => {
                two_parts(dataset, name, i, j, span, diagnostics);
                continue;
            }
        };
        let Some(joint) = dataset.joints.by_id(id) else {
            continue;
        };
        let kind = joint.kind;
        let free = if rotation {
            kind.rotates()
        } else {
            kind.translates()
        };
        if !free {
            let message = format!(
                "{name} drives the {freedom} of JOINT/{id}, which has none: it is {}",
                kind.keyword()
            );
            diagnostics
                .error(Code::NoSuchFreedom, span, message)
                .help("REVOLUTE rotates, TRANSLATIONAL translates, CYLINDRICAL does both");
        }
    }
}

/// CM and IM markers are on their part.
fn parts(dataset: &Dataset, diagnostics: &mut Diagnostics) {
    let owner = |id| dataset.markers.by_id(id).map(|marker| marker.owner);
    for part in &dataset.parts {
        for (keyword, marker) in [("CM", part.cm), ("IM", part.im)] {
            let Some(marker) = marker else { continue };
            let elsewhere = match owner(marker) {
                Some(MarkerOwner::Part(id)) => id != part.header.id && id > 0,
                Some(MarkerOwner::PointMass(_)) => true,
                _ => false,
            };
            if elsewhere {
                let id = part.header.id;
                let message = format!("{keyword} of PART/{id}, MARKER/{marker}, is not on it");
                diagnostics.error(Code::InvalidConnection, part.header.span, message);
            }
        }
    }
    for mass in &dataset.point_masses {
        let Some(marker) = mass.cm else { continue };
        let id = mass.header.id;
        if owner(marker).is_some_and(|owner| owner != MarkerOwner::PointMass(id)) {
            let message = format!("CM of POINT_MASS/{id}, MARKER/{marker}, is not on it");
            diagnostics.error(Code::InvalidConnection, mass.header.span, message);
        }
    }
}
