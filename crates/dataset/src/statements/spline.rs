//! SPLINE.

use super::{Builder, add};
use crate::diagnostic::Code;
use crate::keywords::{INTERFACE, Keyword, Kind, ROUTINE, abbreviated, keyword};
use crate::model::{Spline, SplineCurve};
use crate::reading::Reading;
use crate::source::Span;

const FILE: &str = "time histories of other programs are not read; give X and Y";

pub(super) const KEYWORDS: &[Keyword] = &[
    keyword("X", Kind::Reals(1, usize::MAX)),
    keyword("Y", Kind::RealsEach),
    keyword("Z", Kind::Reals(1, usize::MAX)),
    abbreviated("LINEAR_EXTRAPOLATE", "L", Kind::Flag),
    abbreviated("FILE", "F", Kind::Unsupported(FILE)),
    abbreviated("BLOCK", "B", Kind::Unsupported(FILE)),
    abbreviated("CHANNEL", "C", Kind::Unsupported(FILE)),
    ROUTINE,
    INTERFACE,
];

/// SPLINE.
pub(super) fn spline(reading: &mut Reading, builder: &mut Builder) {
    if !reading.has("FILE") {
        reading.require("X");
        reading.require("Y");
    }
    let x = reading.reals("X").to_vec();
    rising(reading, "X", &x);
    if reading.has("X") && x.len() < Spline::FEWEST && !x.is_empty() {
        let message = format!(
            "X needs at least {} numbers, found {}",
            Spline::FEWEST,
            x.len()
        );
        let span = reading.place("X");
        reading.diagnostics.error(Code::InvalidValue, span, message);
    }
    let curves = curves(reading, x.len());
    let spline = Spline {
        header: reading.header(),
        x: x.into_iter().map(|(x, _)| x).collect(),
        curves,
        linear_extrapolate: reading.has("LINEAR_EXTRAPOLATE"),
    };
    let list = &mut builder.dataset.splines;
    add(list, spline, reading.name, reading.diagnostics);
}

/// The curves. One alone has a `y` for every `x`; of several each has its `z` in front of them,
/// or all have it in Z.
fn curves(reading: &mut Reading, points: usize) -> Vec<SplineCurve> {
    let rows = reading.reals_each("Y");
    let heights = reading.reals("Z").to_vec();
    let with_z = heights.is_empty()
        && (rows.len() > 1 || rows.first().is_some_and(|row| row.len() == points + 1));
    if !heights.is_empty() && heights.len() != rows.len() {
        let message = format!(
            "Z takes one number for each Y, of which there are {}, found {}",
            rows.len(),
            heights.len()
        );
        let span = reading.place("Z");
        reading.diagnostics.error(Code::InvalidValue, span, message);
    }
    let mut z = Vec::new();
    let mut curves = Vec::new();
    for (place, row) in rows.iter().enumerate() {
        let first = row.first().copied().unwrap_or_default();
        let (height, y) = if with_z {
            (first, row.get(1..).unwrap_or_default())
        } else {
            (
                heights.get(place).copied().unwrap_or((0.0, first.1)),
                &row[..],
            )
        };
        if y.len() != points && points > 0 {
            let number = |count| if count == 1 { "number" } else { "numbers" };
            let message = format!(
                "Y takes {}one number for each X, {} {} in all, found {}",
                if with_z { "its z and then " } else { "" },
                points + usize::from(with_z),
                number(points + usize::from(with_z)),
                row.len()
            );
            reading
                .diagnostics
                .error(Code::InvalidValue, first.1, message);
        }
        z.push(height);
        let y = y.iter().map(|(y, _)| *y).collect();
        curves.push(SplineCurve { z: height.0, y });
    }
    if heights.is_empty() || heights.len() == rows.len() {
        rising(reading, "the z of Y", &z);
    }
    curves
}

/// Reports the first number that is not greater than the one before it.
fn rising(reading: &mut Reading, what: &str, values: &[(f64, Span)]) {
    let falls = values.windows(2).find(|pair| pair[1].0 <= pair[0].0);
    if let Some([(before, _), (value, span)]) = falls {
        let message = format!("{what} must increase, but {value} comes after {before}");
        reading
            .diagnostics
            .error(Code::OutOfRange, *span, message)
            .help("sort the points, and give a jump two points a little apart");
    }
}
