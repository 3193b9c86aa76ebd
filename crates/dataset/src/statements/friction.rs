//! FRICTION.

use super::{Builder, FrictionPlaces, Target, add};
use crate::diagnostic::Code;
use crate::keywords::{Keyword, Kind, abbreviated, keyword};
use crate::model::{
    Effect, Formulation, Friction, FrictionArguments, FrictionInputs, FrictionQuantity, Least,
    OverlapDelta, Yoke,
};
use crate::reading::Reading;

const NUMBERS: usize = FrictionQuantity::ALL.len();

/// The keywords that are not numbers with a default.
const OTHERS: [Keyword; 11] = [
    keyword("JOINT", Kind::Id),
    keyword("MU_STATIC", Kind::Real),
    keyword("MU_DYNAMIC", Kind::Real),
    abbreviated("I_YOKE", "I_YOKE", Kind::Flag),
    abbreviated("J_YOKE", "J_YOKE", Kind::Flag),
    keyword("FORMULATION", Kind::Word),
    keyword("EFFECT", Kind::Word),
    keyword("INPUTS", Kind::Words),
    keyword("OVERLAP_DELTA", Kind::Word),
    abbreviated("INACTIVE", "INACTIVE", Kind::Word),
    keyword("INACTIVE_DURING", Kind::Word),
];

/// The keywords of FRICTION: those above and one for every [`FrictionQuantity`].
pub(crate) const KEYWORDS: &[Keyword] = &{
    let mut keywords = [OTHERS[0]; OTHERS.len() + NUMBERS];
    let mut index = 0;
    while index < OTHERS.len() {
        keywords[index] = OTHERS[index];
        index += 1;
    }
    let mut number = 0;
    while number < NUMBERS {
        let name = FrictionQuantity::ALL[number].keyword();
        keywords[OTHERS.len() + number] = keyword(name, Kind::Real);
        number += 1;
    }
    keywords
};

/// The arguments that a statement and a command have in common, each within its range.
pub(crate) fn arguments(reading: &mut Reading) -> FrictionArguments {
    let mut quantities = Vec::new();
    for quantity in FrictionQuantity::ALL {
        let keyword = quantity.keyword();
        let Some(value) = reading.real(keyword) else {
            continue;
        };
        if !quantity.least().allows(value) {
            let range = match quantity.least() {
                Least::Above(least) => format!("greater than {least}"),
                Least::From(least) => format!("{least} or greater"),
            };
            let span = reading
                .argument(keyword)
                .map_or(reading.head, |found| found.value_span);
            let message = format!("{keyword} must be {range}");
            reading.diagnostics.error(Code::OutOfRange, span, message);
        }
        quantities.push((quantity, value, reading.place(keyword)));
    }
    let effects =
        [Effect::All, Effect::Stiction, Effect::Sliding].map(|effect| (effect.keyword(), effect));
    let overlaps = [
        OverlapDelta::Constant,
        OverlapDelta::Increase,
        OverlapDelta::Decrease,
    ]
    .map(|delta| (delta.keyword(), delta));
    reading.exclude("INACTIVE", &["INACTIVE_DURING"]);
    let during_static = [("STATIC", true)];
    let inactive = reading.choice("INACTIVE", &during_static);
    let inactive_during = reading.choice("INACTIVE_DURING", &during_static);
    let mu_static = reading.positive("MU_STATIC");
    let mu_dynamic = reading.positive("MU_DYNAMIC");
    let effect = reading.choice("EFFECT", &effects);
    let inputs = inputs(reading);
    let overlap_delta = reading.choice("OVERLAP_DELTA", &overlaps);
    FrictionArguments {
        mu_static: mu_static.map(|value| (value, reading.place("MU_STATIC"))),
        mu_dynamic: mu_dynamic.map(|value| (value, reading.place("MU_DYNAMIC"))),
        effect: effect.map(|value| (value, reading.place("EFFECT"))),
        inputs: inputs.map(|value| (value, reading.place("INPUTS"))),
        overlap_delta: overlap_delta.map(|value| (value, reading.place("OVERLAP_DELTA"))),
        inactive_static: inactive.or(inactive_during).is_some(),
        quantities,
    }
}

/// INPUTS: ALL, NONE or a list.
fn inputs(reading: &mut Reading) -> Option<FrictionInputs> {
    let names = [
        ("ALL", 0),
        ("NONE", 1),
        ("PRELOAD", 2),
        ("REACTION_FORCE", 3),
        ("BENDING_MOMENT", 4),
        ("TORSIONAL_MOMENT", 5),
    ];
    let given = reading.choices("INPUTS", &names)?;
    if given.len() > 1 && given.iter().any(|input| *input < 2) {
        let span = reading.place("INPUTS");
        reading.diagnostics.error(
            Code::ConflictingArguments,
            span,
            "ALL and NONE of INPUTS stand alone",
        );
    }
    if given.contains(&0) {
        return Some(FrictionInputs::ALL);
    }
    Some(FrictionInputs {
        preload: given.contains(&2),
        reaction_force: given.contains(&3),
        bending_moment: given.contains(&4),
        torsional_moment: given.contains(&5),
    })
}

/// FRICTION.
pub(super) fn friction(reading: &mut Reading, builder: &mut Builder) {
    let joint = builder.require(reading, "JOINT", Target::Joint);
    reading.require("MU_STATIC");
    reading.require("MU_DYNAMIC");
    let given = arguments(reading);
    // A coefficient that is missing, which has been reported, is taken as equal to the other one.
    let either = given.mu_static.or(given.mu_dynamic);
    let mu = either.map_or(1.0, |(value, _)| value);
    let mut friction = Friction::new(reading.header(), joint, mu, mu);
    let yokes = [Yoke::I, Yoke::J].map(|yoke| (yoke.keyword(), yoke));
    friction.yoke = reading.one_flag(&yokes);
    let formulations = [Formulation::Original, Formulation::LuGre]
        .map(|formulation| (formulation.keyword(), formulation));
    friction.formulation = reading
        .choice("FORMULATION", &formulations)
        .unwrap_or_default();
    friction.take(&given);
    builder.frictions.push(FrictionPlaces {
        head: reading.head,
        joint: reading.place("JOINT"),
        yoke: friction.yoke.map(|yoke| reading.place(yoke.keyword())),
        arguments: given,
    });
    let list = &mut builder.dataset.frictions;
    add(list, friction, reading.name, reading.diagnostics);
}
