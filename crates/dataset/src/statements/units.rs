//! UNITS and ACCGRAV.

use super::Builder;
use crate::diagnostic::Code;
use crate::keywords::{Keyword, Kind, abbreviated, keyword};
use crate::model::{ForceUnit, LengthUnit, MassUnit, TimeUnit, Units};
use crate::reading::Reading;

pub(crate) const KEYWORDS: &[Keyword] = &[
    abbreviated("FORCE", "FOR", Kind::Word),
    abbreviated("MASS", "MAS", Kind::Word),
    abbreviated("LENGTH", "LEN", Kind::Word),
    abbreviated("TIME", "TIM", Kind::Word),
    abbreviated("SYSTEM", "SYS", Kind::Word),
    keyword("UCF", Kind::Real),
];

/// A system of units by its name.
fn system(name: &str) -> Units {
    let second = TimeUnit::Second;
    match name {
        "CGS" => Units::new(
            ForceUnit::Dyne,
            MassUnit::Gram,
            LengthUnit::Centimeter,
            second,
        ),
        "FPS" => Units::new(
            ForceUnit::PoundForce,
            MassUnit::PoundMass,
            LengthUnit::Foot,
            second,
        ),
        "IPS" => Units::new(
            ForceUnit::PoundForce,
            MassUnit::PoundMass,
            LengthUnit::Inch,
            second,
        ),
        "MKS" => Units::new(
            ForceUnit::Newton,
            MassUnit::Kilogram,
            LengthUnit::Meter,
            second,
        ),
        _ => Units::default(),
    }
}

/// UNITS: the four units, or a system, or the consistency factor.
pub(super) fn units(reading: &mut Reading, builder: &mut Builder) {
    const FOUR: [&str; 4] = ["FORCE", "MASS", "LENGTH", "TIME"];
    reading.exclude("SYSTEM", &["FORCE", "MASS", "LENGTH", "TIME", "UCF"]);
    reading.exclude("UCF", &FOUR);
    let names = ["CGS", "FPS", "IPS", "MKS", "NONE"].map(|name| (name, name));
    let system_name = reading.choice("SYSTEM", &names);
    let ucf = reading.positive("UCF");
    let force = choice(reading, "FORCE", ForceUnit::ALL, ForceUnit::keyword);
    let mass = choice(reading, "MASS", MassUnit::ALL, MassUnit::keyword);
    let length = choice(reading, "LENGTH", LengthUnit::ALL, LengthUnit::keyword);
    let time = choice(reading, "TIME", TimeUnit::ALL, TimeUnit::keyword);
    let mut units = match (force, mass, length, time) {
        (Some(force), Some(mass), Some(length), Some(time)) => {
            Units::new(force, mass, length, time)
        }
        _ => system_name.map_or_else(Units::default, system),
    };
    if let Some(ucf) = ucf {
        units.ucf = ucf;
    }
    if FOUR.iter().any(|name| reading.has(name)) {
        for name in FOUR {
            reading.require(name);
        }
    } else if !reading.has("SYSTEM") && !reading.has("UCF") {
        let span = reading.head;
        reading
            .diagnostics
            .error(Code::MissingArgument, span, "UNITS needs units")
            .help("give FORCE, MASS, LENGTH and TIME, or SYSTEM, or UCF");
    }
    units.span = reading.span;
    builder.dataset.units = Some(units);
}

/// The unit that an argument names.
fn choice<T: Copy>(
    reading: &mut Reading,
    keyword: &'static str,
    units: &[T],
    name: fn(T) -> &'static str,
) -> Option<T> {
    let mut choices: Vec<(&'static str, T)> =
        units.iter().map(|unit| (name(*unit), *unit)).collect();
    if keyword == "TIME" {
        // The plural is in use as well.
        let plural = choices.iter().position(|(name, _)| *name == "MILLISECOND");
        choices.extend(plural.map(|index| ("MILLISECONDS", choices[index].1)));
    }
    reading.choice(keyword, &choices)
}

pub(crate) const GRAVITY_KEYWORDS: &[Keyword] = &[
    abbreviated("IGRAV", "I", Kind::Real),
    abbreviated("JGRAV", "J", Kind::Real),
    abbreviated("KGRAV", "K", Kind::Real),
];

/// The components that an ACCGRAV gives.
pub(crate) fn gravity(reading: &Reading) -> [Option<f64>; 3] {
    ["IGRAV", "JGRAV", "KGRAV"].map(|keyword| reading.real(keyword))
}

/// ACCGRAV.
pub(super) fn accgrav(reading: &mut Reading, builder: &mut Builder) {
    let components = gravity(reading).map(|component| component.unwrap_or(0.0));
    builder.dataset.gravity = Some(components);
    builder.gravity = Some(reading.span);
}
