//! Angles that look like degrees, where the language takes radians.

use crate::diagnostic::Code;
use crate::reading::Reading;
use std::f64::consts::TAU;

/// Angles in degrees are multiples of this as a rule, in degrees.
const ROUND: f64 = 5.0;

/// Warns where one of the first `count` numbers of an argument is an angle of more than a turn and
/// a round number of degrees.
pub(crate) fn check(reading: &mut Reading, keyword: &'static str, count: usize) {
    let source = reading.diagnostics.source;
    let values = reading.reals(keyword);
    let looks = |value: f64, text: &str| {
        let degrees = text.ends_with(['d', 'D']);
        !degrees && value.abs() > TAU && value % ROUND == 0.0
    };
    let texts: Vec<(String, bool)> = values
        .iter()
        .enumerate()
        .map(|(place, (value, span))| {
            let text = source.slice(*span);
            let suspect = place < count && looks(*value, text);
            let suffix = if suspect { "D" } else { "" };
            (format!("{text}{suffix}"), suspect)
        })
        .collect();
    let Some(place) = texts.iter().position(|(_, suspect)| *suspect) else {
        return;
    };
    let (value, _) = values[place];
    let all = values[0].1.to(values[values.len() - 1].1);
    let written: Vec<String> = texts.into_iter().map(|(text, _)| text).collect();
    let written = written.join(", ");
    let message = format!(
        "{keyword} of {} looks like degrees: {value} rad are {:.1} turns",
        reading.label(),
        value / TAU
    );
    reading
        .diagnostics
        .warning(Code::DegreesWithoutD, all, message)
        .help(format!(
            "degrees are written with a D: {keyword} = {written}"
        ))
        .replace(all, written);
}
