//! CONTACT.

use super::{Builder, add};
use crate::diagnostic::Code;
use crate::keywords::{Keyword, Kind, ROUTINE, abbreviated, keyword};
use crate::model::{Contact, ContactFriction, ContactLaw};
use crate::reading::Reading;

const FORCES: &str = "contacts are given by IMPACT or POISSON";

pub(super) const KEYWORDS: &[Keyword] = &[
    abbreviated("IGEOM", "IG", Kind::Ids),
    abbreviated("JGEOM", "JG", Kind::Ids),
    abbreviated("TYPE", "T", Kind::Word),
    abbreviated("IMPACT", "IM", Kind::Flag),
    abbreviated("POISSON", "PO", Kind::Flag),
    abbreviated("STIFFNESS", "STIF", Kind::Real),
    abbreviated("DAMPING", "DA", Kind::Real),
    abbreviated("DMAX", "DM", Kind::Real),
    abbreviated("EXPONENT", "E", Kind::Real),
    abbreviated("PENALTY", "PE", Kind::Real),
    abbreviated("RESTITUTION_COEFFICIENT", "RE", Kind::Real),
    abbreviated("COULOMB_FRICTION", "COU", Kind::Word),
    abbreviated("MU_STATIC", "MU_S", Kind::Real),
    abbreviated("MU_DYNAMIC", "MU_D", Kind::Real),
    abbreviated("STICTION_TRANSITION_VELOCITY", "STICTION_T", Kind::Real),
    abbreviated("FRICTION_TRANSITION_VELOCITY", "FR", Kind::Real),
    keyword("STICTION", Kind::Word),
    abbreviated("MAX_STICTION_DEFORMATION", "MAX", Kind::Real),
    abbreviated("IFLEX", "IF", Kind::Ignored("parts are rigid")),
    abbreviated("JFLEX", "JF", Kind::Ignored("parts are rigid")),
    abbreviated("NO_FRICTION", "NO", Kind::Flag),
    abbreviated("FUNCTION", "FU", Kind::Unsupported(FORCES)),
    abbreviated(
        "AUGMENTED_LAGRANGIAN_FORMULATION",
        "AU",
        Kind::Ignored("it is about how contacts are solved"),
    ),
    ROUTINE,
];

/// `COULOMB_FRICTION`.
const FRICTION: [(&str, Option<bool>); 3] = [
    ("OFF", None),
    ("ON", Some(false)),
    ("DYNAMICS_ONLY", Some(true)),
];

/// CONTACT.
pub(super) fn contact(reading: &mut Reading, builder: &mut Builder) {
    for side in ["IGEOM", "JGEOM"] {
        reading.require(side);
    }
    let laws = [("IMPACT", true), ("POISSON", false)];
    let law = if reading.has("FUNCTION") {
        // This has been reported.
        Some(true)
    } else {
        reading.required_flag("a law", &laws)
    };
    let law = match law {
        Some(false) => {
            reading.require("PENALTY");
            let restitution = reading.real("RESTITUTION_COEFFICIENT");
            if restitution.is_some_and(|e| !(0.0..=1.0).contains(&e)) {
                let span = reading.place("RESTITUTION_COEFFICIENT");
                let message = "RESTITUTION_COEFFICIENT must be from 0 to 1";
                reading.diagnostics.error(Code::OutOfRange, span, message);
            }
            ContactLaw::Poisson {
                penalty: reading.positive("PENALTY").unwrap_or(0.0),
                restitution: restitution.unwrap_or(0.0),
            }
        }
        _ => {
            if reading.has("IMPACT") {
                reading.require("STIFFNESS");
            }
            ContactLaw::Impact {
                stiffness: reading.positive("STIFFNESS").unwrap_or(0.0),
                damping: reading.not_negative("DAMPING").unwrap_or(0.0),
                exponent: reading.positive("EXPONENT").unwrap_or(1.0),
                full_damping: reading.not_negative("DMAX").unwrap_or(0.0),
            }
        }
    };
    let dynamics_only = reading.choice("COULOMB_FRICTION", &FRICTION).flatten();
    let sticks = reading.switch("STICTION").unwrap_or(false);
    let deformation = reading.positive("MAX_STICTION_DEFORMATION");
    let friction = ContactFriction {
        dynamics_only: dynamics_only.unwrap_or(false),
        mu_static: reading.not_negative("MU_STATIC"),
        mu_dynamic: reading.not_negative("MU_DYNAMIC"),
        stiction_velocity: reading.positive("STICTION_TRANSITION_VELOCITY"),
        friction_velocity: reading.positive("FRICTION_TRANSITION_VELOCITY"),
        max_deformation: deformation.filter(|_| sticks),
    };
    let ids = |keyword: &str| reading.ids(keyword).iter().map(|(id, _)| *id).collect();
    let contact = Contact {
        header: reading.header(),
        kind: word(reading, "TYPE"),
        i_geometry: ids("IGEOM"),
        j_geometry: ids("JGEOM"),
        law,
        friction: dynamics_only.map(|_| friction),
    };
    let list = &mut builder.dataset.contacts;
    add(list, contact, reading.name, reading.diagnostics);
}

/// A name as it is written, in capitals.
fn word(reading: &Reading, keyword: &str) -> Option<String> {
    let argument = reading.argument(keyword)?;
    let text = reading.diagnostics.source.slice(argument.value_span);
    Some(text.trim().to_ascii_uppercase())
}
