//! Axes with their ticks, titles and legends: what all panels have.

use std::ops::Range;

use plotters::coord::Shift;
use plotters::coord::types::RangedCoordf64;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};

use crate::canvas::Drawn;
use crate::style::{FAMILY, GREY, HEADING, PALE, TEXT, px};

/// A chart of two numbers.
pub(crate) type Chart<'a, B> = ChartContext<'a, B, Cartesian2d<RangedCoordf64, RangedCoordf64>>;

/// How an entry of a legend looks.
#[derive(Clone, Copy)]
pub(crate) enum Mark {
    /// A filled area.
    Area,
    /// A line.
    Line,
    /// A dot.
    Dot,
    /// A square.
    Square,
}

/// An entry of a legend.
pub(crate) struct Entry {
    pub(crate) text: String,
    pub(crate) mark: Mark,
    pub(crate) colour: RGBColor,
}

impl Entry {
    pub(crate) fn new(text: impl Into<String>, mark: Mark, colour: RGBColor) -> Self {
        Self {
            text: text.into(),
            mark,
            colour,
        }
    }
}

/// What stands around a chart.
pub(crate) struct Frame<'a> {
    pub(crate) title: &'a str,
    /// What the axes are of, with units.
    pub(crate) axes: [String; 2],
    pub(crate) legend: Vec<Entry>,
    /// Ranges of both axes.
    pub(crate) x: Range<f64>,
    pub(crate) y: Range<f64>,
    /// Whether the vertical axis has numbers and a grid.
    pub(crate) numbers: bool,
}

/// `time (sec)`, and without a unit the quantity alone.
pub(crate) fn with_unit(quantity: &str, unit: &str) -> String {
    if unit.is_empty() {
        quantity.to_owned()
    } else {
        format!("{quantity} ({unit})")
    }
}

/// A range around values that is not empty, with so much of it left free at both ends.
pub(crate) fn range(values: impl IntoIterator<Item = f64>, free: f64) -> Range<f64> {
    let (mut low, mut high) = (f64::INFINITY, f64::NEG_INFINITY);
    for value in values {
        (low, high) = (low.min(value), high.max(value));
    }
    let size = low.abs().max(high.abs());
    // Ticks of a narrower range would not differ in their digits.
    let least = if size > 0.0 { 1e-6 * size } else { 1.0 };
    if high - low < least {
        (low, high) = (low - 0.5 * least, high + 0.5 * least);
    }
    let free = free * (high - low);
    low - free..high + free
}

/// The text of a tick of an axis of this range.
fn tick(value: f64, range: &Range<f64>) -> String {
    let size = range.start.abs().max(range.end.abs());
    let width = range.end - range.start;
    // Two digits below the width tell ticks apart.
    let digits = 2 - width.log10().floor() as i32;
    let rounded = format!("{value:.*}", digits.max(0) as usize);
    let plain = match rounded.contains('.') {
        true => rounded.trim_end_matches('0').trim_end_matches('.'),
        false => &rounded,
    };
    match plain {
        "-0" => "0".to_owned(),
        _ if (1e-3..1e5).contains(&size) || value == 0.0 => plain.to_owned(),
        _ => {
            let significant = (size.log10().floor() as i32 + digits).clamp(0, 15);
            let text = format!("{value:.*e}", significant as usize);
            let (mantissa, exponent) = text.split_once('e').unwrap_or((&text, "0"));
            let mantissa = match mantissa.contains('.') {
                true => mantissa.trim_end_matches('0').trim_end_matches('.'),
                false => mantissa,
            };
            match mantissa {
                "0" | "-0" => "0".to_owned(),
                _ => format!("{mantissa}e{exponent}"),
            }
        }
    }
}

fn letters(size: u32) -> TextStyle<'static> {
    (FAMILY, size).into_font().color(&BLACK)
}

/// Draws title, axes and legend, and gives the chart to `fill`.
pub(crate) fn framed<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    frame: &Frame<'_>,
    fill: impl FnOnce(&mut Chart<'_, B>) -> Drawn<B>,
) -> Drawn<B> {
    let middle = Pos::new(HPos::Left, VPos::Center);
    let (head, body) = area.split_vertically(px(30));
    let heading = letters(HEADING).pos(middle);
    let edge = px(14) as i32;
    head.draw(&Text::new(frame.title, (edge, px(17) as i32), heading))?;
    let text = letters(TEXT).pos(middle);
    let mut widest = 0;
    for entry in &frame.legend {
        widest = widest.max(body.estimate_text_size(&entry.text, &text)?.0);
    }
    let beside = widest + px(50);
    let (left, right) = body.split_horizontally(body.dim_in_pixel().0 - beside);
    for (row, entry) in frame.legend.iter().enumerate() {
        let y = (px(18) + row as u32 * px(22)) as i32;
        // Letters without descenders have their middle a little above that of their line.
        swatch(&right, entry, y - px(2) as i32)?;
        right.draw(&Text::new(
            entry.text.as_str(),
            (px(36) as i32, y),
            text.clone(),
        ))?;
    }
    let (x, y) = (frame.x.clone(), frame.y.clone());
    let labels = if frame.numbers { px(84) } else { edge as u32 };
    let mut chart = ChartBuilder::on(&left)
        .margin_left(px(6))
        .margin_right(px(10))
        .margin_bottom(px(6))
        .x_label_area_size(px(44))
        .y_label_area_size(labels)
        .build_cartesian_2d(x.clone(), y.clone())?;
    let [across, up] = &frame.axes;
    let mut mesh = chart.configure_mesh();
    if !frame.numbers {
        mesh.disable_y_mesh().disable_y_axis();
    }
    mesh.x_desc(across.as_str())
        .y_desc(up.as_str())
        .x_labels(7)
        .y_labels(6)
        .x_label_formatter(&|value| tick(*value, &x))
        .y_label_formatter(&|value| tick(*value, &y))
        .axis_style(BLACK.stroke_width(px(1)))
        .bold_line_style(PALE.stroke_width(px(1)))
        .light_line_style(TRANSPARENT)
        .label_style(letters(TEXT))
        .axis_desc_style(letters(TEXT))
        .set_all_tick_mark_size(px(4))
        .draw()?;
    fill(&mut chart)
}

fn swatch<B: DrawingBackend>(area: &DrawingArea<B, Shift>, entry: &Entry, y: i32) -> Drawn<B> {
    let (left, right) = (px(8) as i32, px(28) as i32);
    let half = px(6) as i32;
    let middle = (left + right) / 2;
    let full = entry.colour.filled();
    match entry.mark {
        Mark::Area => area.draw(&Rectangle::new([(left, y - half), (right, y + half)], full)),
        Mark::Line => {
            let line = entry.colour.stroke_width(px(2));
            area.draw(&PathElement::new([(left, y), (right, y)], line))
        }
        Mark::Dot => area.draw(&Circle::new((middle, y), DOT, full)),
        Mark::Square => {
            let corners = [(middle - DOT, y - DOT), (middle + DOT, y + DOT)];
            area.draw(&Rectangle::new(corners, full))
        }
    }
}

/// Half the width of a dot or square.
pub(crate) const DOT: i32 = px(4) as i32;

/// A curve.
pub(crate) fn curve<B: DrawingBackend>(
    chart: &mut Chart<'_, B>,
    points: impl IntoIterator<Item = (f64, f64)>,
    colour: RGBColor,
    width: u32,
) -> Drawn<B> {
    let line = LineSeries::new(points, colour.stroke_width(width));
    chart.draw_series(line)?;
    Ok(())
}

/// A line across the chart at the height zero.
pub(crate) fn zero<B: DrawingBackend>(chart: &mut Chart<'_, B>) -> Drawn<B> {
    let x = chart.x_range();
    curve(chart, [(x.start, 0.0), (x.end, 0.0)], GREY, px(1))
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn ticks_have_the_digits_that_tell_them_apart() {
        for (value, range, text) in [
            (0.25, -1.0..1.0, "0.25"),
            (-0.0, -1.0..1.0, "0"),
            (-1e-17, -1.0..1.0, "0"),
            (0.30000000000000004, 0.0..1.0, "0.3"),
            (20.0, 0.0..50.0, "20"),
            (150_000.0, 0.0..200_000.0, "1.5e5"),
            (2.5e-6, 0.0..1e-5, "2.5e-6"),
            (0.0, 0.0..1e-5, "0"),
            (100.002, 100.0..100.01, "100.002"),
        ] {
            assert_eq!(tick(value, &range), text, "{value} in {range:?}");
        }
    }

    #[test]
    fn ranges_are_never_empty() {
        assert_eq!(range([0.0, 0.0], 0.0), -0.5..0.5);
        let narrow = range([5.0], 0.1);
        assert!(narrow.start < 5.0 && narrow.end > 5.0);
        assert_eq!(range([1.0, 3.0], 0.5), 0.0..4.0);
    }
}
