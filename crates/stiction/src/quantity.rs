//! Numbers with units, turned into the units of a model.

use dataset::{Dimension, ForceUnit, LengthUnit, TimeUnit};
use results::UnitNames;

use crate::argument::ArgumentError;

/// Symbols of units beside their names, with the name that each stands for.
const SYMBOLS: &[(&str, &str)] = &[
    ("N", "newton"),
    ("mN", "millinewton"),
    ("kN", "knewton"),
    ("MN", "meganewton"),
    ("cN", "centinewton"),
    ("uN", "micronewton"),
    ("nN", "nanonewton"),
    ("dyn", "dyne"),
    ("kgf", "kilogram_force"),
    ("lbf", "pound_force"),
    ("ozf", "ounce_force"),
    ("m", "meter"),
    ("cm", "centimeter"),
    ("mm", "millimeter"),
    ("um", "micrometer"),
    ("nm", "nanometer"),
    ("in", "inch"),
    ("ft", "foot"),
    ("yd", "yard"),
    ("s", "second"),
    ("ms", "millisecond"),
    ("us", "microsecond"),
    ("ns", "nanosecond"),
    ("min", "minute"),
    ("h", "hour"),
    ("hr", "hour"),
];

/// Powers of force, length and time, and the size in the SI.
#[derive(Clone, Copy)]
struct Unit {
    powers: [i32; 3],
    size: f64,
}

/// Units by the names of the UNITS statement in lower case and by those of result files.
fn names() -> Vec<(String, Unit)> {
    let mut names = Vec::new();
    let mut add = |keyword: &str, result: &str, powers, size| {
        let unit = Unit { powers, size };
        names.extend([keyword.to_ascii_lowercase(), result.to_owned()].map(|name| (name, unit)));
    };
    for unit in ForceUnit::ALL {
        add(unit.keyword(), unit.result_name(), [1, 0, 0], unit.si());
    }
    for unit in LengthUnit::ALL {
        add(unit.keyword(), unit.result_name(), [0, 1, 0], unit.si());
    }
    for unit in TimeUnit::ALL {
        add(unit.keyword(), unit.result_name(), [0, 0, 1], unit.si());
    }
    names
}

/// The number by which a number in one unit is multiplied to be in another.
///
/// Names are those of the UNITS statement in lower case, those of result files and the usual symbols;
/// `*`, `/` and powers (`**2` or `^2`) join them. The empty unit is that of plain numbers.
///
/// # Errors
/// Names that are no units, and units of different kinds.
///
/// ```
/// assert_eq!(stiction::conversion("mm/s", "meter/sec")?, 1e-3);
/// assert!(stiction::conversion("mm", "meter/sec").is_err());
/// # Ok::<(), stiction::ArgumentError>(())
/// ```
pub fn conversion(from: &str, into: &str) -> Result<f64, ArgumentError> {
    let (given, wanted) = (read(from)?, read(into)?);
    if given.powers != wanted.powers {
        let shown = match into {
            "" => "a plain number".to_owned(),
            unit => format!("in {unit}"),
        };
        return Err(ArgumentError::Value(format!(
            "a number in {from} cannot be given {shown}"
        )));
    }
    Ok(given.size / wanted.size)
}

fn read(text: &str) -> Result<Unit, ArgumentError> {
    let no_unit = || ArgumentError::Value(format!("{text:?} is no unit; write it as mm/s or N*m"));
    let mut unit = Unit {
        powers: [0; 3],
        size: 1.0,
    };
    let mut rest = text.trim();
    let mut sign = 1;
    while !text.trim().is_empty() {
        let end = rest.find(|c: char| !c.is_ascii_alphabetic() && c != '_');
        let (name, behind) = rest.split_at(end.unwrap_or(rest.len()));
        if name.is_empty() {
            return Err(no_unit());
        }
        let (power, behind) = power(behind).ok_or_else(no_unit)?;
        let part = part(name)?;
        for (sum, power_of_part) in unit.powers.iter_mut().zip(part.powers) {
            *sum += sign * power * power_of_part;
        }
        unit.size *= part.size.powi(sign * power);
        let mut behind = behind.trim_start().chars();
        sign = match behind.next() {
            None => break,
            Some('*') => 1,
            Some('/') => -1,
            Some(_) => return Err(no_unit()),
        };
        rest = behind.as_str().trim_start();
    }
    Ok(unit)
}

/// The power behind a name, one without it, and what follows.
fn power(text: &str) -> Option<(i32, &str)> {
    let Some(digits) = text.strip_prefix("**").or_else(|| text.strip_prefix('^')) else {
        return Some((1, text));
    };
    let signs = usize::from(digits.starts_with('-'));
    let end = digits[signs..].find(|c: char| !c.is_ascii_digit());
    let (number, rest) = digits.split_at(end.map_or(digits.len(), |end| end + signs));
    let power: i8 = number.parse().ok()?;
    Some((power.into(), rest))
}

fn part(name: &str) -> Result<Unit, ArgumentError> {
    let symbol = SYMBOLS.iter().find(|(symbol, _)| *symbol == name);
    let full = symbol.map_or(name, |(_, full)| full);
    let names = names();
    let found = names.iter().find(|(known, _)| known == full);
    found.map(|(_, unit)| *unit).ok_or_else(|| {
        let names = names.into_iter().map(|(name, _)| name);
        let symbols = SYMBOLS.iter().map(|(symbol, _)| (*symbol).to_owned());
        let unknown = ArgumentError::Unknown {
            what: "unit",
            name: name.to_owned(),
            known: symbols.chain(names).collect(),
        };
        // A number in a unit that does not exist is a wrong value.
        ArgumentError::Value(unknown.to_string())
    })
}

/// The unit that a dimension has in a model; empty for plain numbers.
#[must_use]
pub fn unit_of(dimension: Dimension, units: &UnitNames) -> String {
    let UnitNames {
        length,
        force,
        time,
        ..
    } = units;
    match dimension {
        Dimension::Number => String::new(),
        Dimension::Length => length.clone(),
        Dimension::Velocity => format!("{length}/{time}"),
        Dimension::Force => force.clone(),
        Dimension::Torque => format!("{force}*{length}"),
        Dimension::Stiffness => format!("{force}/{length}"),
        Dimension::Damping => format!("{force}*{time}/{length}"),
    }
}

#[cfg(test)]
mod tests {
    use super::conversion;

    #[test]
    fn units_are_read_with_operators_and_powers() {
        for (from, into, expected) in [
            ("N*m", "newton*meter", 1.0),
            ("kN * mm", "N*m", 1.0),
            ("mm/s**2", "meter/sec^2", 1e-3),
            ("m**-1", "m/m^2", 1.0),
            ("", "", 1.0),
            ("in", "mm", 25.4),
            ("min", "s", 60.0),
        ] {
            let found = conversion(from, into).expect(from);
            assert!((found / expected - 1.0).abs() < 1e-15, "{from}: {found}");
        }
        for wrong in [
            "2", "m/", "m//s", "m s", "m**", "m***2", "m^999", "/s", "m*",
        ] {
            assert!(conversion(wrong, "m").is_err(), "{wrong}");
        }
        let message = conversion("m/ss", "m").unwrap_err().to_string();
        assert!(message.contains("no unit \"ss\""), "{message}");
    }
}
