//! Gravity that does not fit the units, or is missing.

use crate::diagnostic::{Code, Diagnostics};
use crate::model::{FrictionInputs, LengthUnit, TimeUnit, Units};
use crate::source::Span;
use crate::statements::Builder;

/// Standard acceleration of gravity, m/s^2.
const EARTH: f64 = 9.80665;
/// Gravity differs by half a per cent over the earth, and is given with two digits at least.
const NEAR: f64 = 0.02;
/// Units of length that datasets are written in.
const LENGTHS: [LengthUnit; 5] = [
    LengthUnit::Millimeter,
    LengthUnit::Centimeter,
    LengthUnit::Meter,
    LengthUnit::Inch,
    LengthUnit::Foot,
];

/// Warns of gravity that is that of the earth in another unit, and of friction without gravity.
pub(super) fn check(builder: &Builder, diagnostics: &mut Diagnostics) {
    let dataset = &builder.dataset;
    match (dataset.gravity, builder.gravity) {
        (Some(gravity), Some(span)) => unit(gravity, dataset.units.as_ref(), span, diagnostics),
        _ => missing(builder, diagnostics),
    }
}

/// The acceleration of the earth in these units; `None` where they are not known.
fn earth(units: &Units) -> Option<(f64, LengthUnit)> {
    let length = units.length.or_else(|| {
        // UCF is force * time^2 / (mass * length); of the usual systems with a factor each names one
        // length.
        let near = |ucf: f64| (units.ucf / ucf - 1.0).abs() < NEAR;
        let inch = LengthUnit::Inch;
        let known = [
            (1000.0, LengthUnit::Millimeter),
            (9806.65, LengthUnit::Millimeter),
            (EARTH / inch.si(), inch),
            (EARTH / LengthUnit::Foot.si(), LengthUnit::Foot),
        ];
        known
            .into_iter()
            .find(|(ucf, _)| near(*ucf))
            .map(|(_, length)| length)
    })?;
    let time = units.time.map_or(1.0, TimeUnit::si);
    Some((EARTH * time * time / length.si(), length))
}

fn unit(gravity: [f64; 3], units: Option<&Units>, span: Span, diagnostics: &mut Diagnostics) {
    let Some((earth, length)) = units.and_then(earth) else {
        return;
    };
    let given = gravity[0].hypot(gravity[1]).hypot(gravity[2]);
    let near = |expected: f64| (given / expected - 1.0).abs() < NEAR;
    if near(earth) {
        return;
    }
    let Some(other) = LENGTHS.into_iter().find(|other| near(EARTH / other.si())) else {
        return;
    };
    let message = format!(
        "gravity of {given} is that of the earth in {}, but the length unit is {}",
        other.keyword(),
        length.keyword()
    );
    diagnostics
        .warning(Code::GravityUnit, span, message)
        .help(format!(
            "in the units of this model it is {}",
            rounded(earth)
        ));
}

/// Six digits, as gravity is known.
fn rounded(value: f64) -> f64 {
    format!("{value:.5e}").parse().unwrap_or(value)
}

/// Friction that would be loaded by weight.
fn missing(builder: &Builder, diagnostics: &mut Diagnostics) {
    let by_weight = |inputs: &FrictionInputs| {
        inputs.reaction_force || inputs.bending_moment || inputs.torsional_moment
    };
    let frictions = builder.dataset.frictions.iter().zip(&builder.frictions);
    let mut loaded = frictions.filter(|(friction, _)| by_weight(&friction.inputs));
    if let Some((friction, places)) = loaded.next() {
        let message = format!(
            "there is no ACCGRAV: nothing has weight that would load FRICTION/{}",
            friction.header.id
        );
        diagnostics
            .warning(Code::NoGravity, places.head, message)
            .help("add ACCGRAV, with KGRAV=0 where there is no gravity");
    }
}
