//! Angles that look like degrees, where the language takes radians.

use crate::diagnostic::Code;
use crate::reading::Reading;
use crate::source::Span;
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
    let suspect = |value: f64, span: Span| looks(value, source.slice(span));
    let mut angles = values.iter().take(count);
    let Some((value, _)) = angles.find(|(value, span)| suspect(*value, *span)) else {
        return;
    };
    let all = values[0].1.to(values[values.len() - 1].1);
    let written = values.iter().enumerate().map(|(place, (value, span))| {
        let suffix = match place < count && suspect(*value, *span) {
            true => "D",
            false => "",
        };
        format!("{}{suffix}", source.slice(*span))
    });
    let written = written.collect::<Vec<_>>().join(", ");
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
