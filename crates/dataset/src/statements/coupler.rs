//! COUPLER and GEAR.

use super::{Builder, Reference, Target, add};
use crate::diagnostic::Code;
use crate::keywords::{INTERFACE, Keyword, Kind, ROUTINE, SUBROUTINE, abbreviated, keyword};
use crate::model::{CoupledFreedom, Coupler, Gear};
use crate::reading::Reading;
use crate::source::Span;

pub(super) const KEYWORDS: &[Keyword] = &[
    abbreviated("JOINTS", "J", Kind::Ids),
    abbreviated("TYPE", "T", Kind::Words),
    abbreviated("SCALES", "S", Kind::Reals(1, 3)),
    abbreviated("FUNCTION", "FU", Kind::Unsupported(SUBROUTINE)),
    ROUTINE,
    INTERFACE,
];

/// COUPLER.
pub(super) fn coupler(reading: &mut Reading, builder: &mut Builder) {
    reading.require("JOINTS");
    if !reading.has("FUNCTION") {
        reading.require("SCALES");
    }
    let joints = joints(reading, builder);
    if !joints.is_empty() && !(2..=3).contains(&joints.len()) {
        let found = joints.len();
        refuse(
            reading,
            "JOINTS",
            format!("a coupler has two or three joints, found {found}"),
        );
    }
    let types = [("ROTATIONAL", true), ("TRANSLATIONAL", false)];
    let rotations = reading.choices("TYPE", &types);
    if let Some(rotations) = &rotations
        && rotations.len() != joints.len()
    {
        let message = format!("TYPE takes one letter a joint, found {}", rotations.len());
        refuse(reading, "TYPE", message);
    }
    let mut scales: Vec<f64> = reading.reals("SCALES").iter().map(|(r, _)| *r).collect();
    if scales.len() + 1 == joints.len() {
        // The first scale is one where it is left out.
        scales.insert(0, 1.0);
    }
    if reading.has("SCALES") && scales.len() != joints.len() {
        let message = format!(
            "SCALES takes one number a joint, of which the first may be left out, found {}",
            scales.len()
        );
        refuse(reading, "SCALES", message);
    }
    let freedom = |(place, (joint, _)): (usize, (u32, _))| CoupledFreedom {
        joint,
        rotation: rotations.as_ref().and_then(|list| list.get(place).copied()),
        scale: scales.get(place).copied().unwrap_or(0.0),
    };
    let coupler = Coupler {
        header: reading.header(),
        freedoms: joints.into_iter().enumerate().map(freedom).collect(),
    };
    let list = &mut builder.dataset.couplers;
    add(list, coupler, reading.name, reading.diagnostics);
}

pub(super) const GEAR_KEYWORDS: &[Keyword] = &[
    abbreviated("JOINTS", "J", Kind::Ids),
    keyword("CV", Kind::Id),
];

/// GEAR.
pub(super) fn gear(reading: &mut Reading, builder: &mut Builder) {
    reading.require("JOINTS");
    let joints = joints(reading, builder);
    if !joints.is_empty() && joints.len() != 2 {
        let message = format!("a gear has two joints, found {}", joints.len());
        refuse(reading, "JOINTS", message);
    }
    let gear = Gear {
        header: reading.header(),
        joints: joints.into_iter().map(|(id, _)| id).collect(),
        cv: builder.require(reading, "CV", Target::Marker),
    };
    let list = &mut builder.dataset.gears;
    add(list, gear, reading.name, reading.diagnostics);
}

/// The joints that JOINTS names.
fn joints(reading: &Reading, builder: &mut Builder) -> Vec<(u32, Span)> {
    let joints = reading.ids("JOINTS").to_vec();
    for &(id, span) in &joints {
        let target = Target::Joint;
        builder.references.push(Reference { target, id, span });
    }
    joints
}

fn refuse(reading: &mut Reading, keyword: &'static str, message: String) {
    let span = reading.place(keyword);
    reading.diagnostics.error(Code::InvalidValue, span, message);
}
