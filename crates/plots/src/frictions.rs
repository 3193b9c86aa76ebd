//! Panels of one friction: over time, against what the surfaces do, by cause; and regimes of several.

use plotters::coord::Shift;
use plotters::prelude::*;
use plotters::style::text_anchor::{HPos, Pos, VPos};
use stiction::explain::{CAUSES, FrictionSeries, REGIMES};

use crate::Along;
use crate::axes::{Chart, DOT, Entry, Frame, Mark, curve, framed, range, with_unit, zero};
use crate::canvas::Drawn;
use crate::style::{BLUE, CAUSE_COLOURS, FAMILY, GREY, REGIME_COLOURS, TEXT, VERMILION, px};
use crate::thinning::needed;

/// Width of a column that a curve over time is thinned to: half a pixel of a chart of 600 pixels.
const COLUMNS: usize = 1200;

/// What a friction is called: a force or a torque, with its unit.
fn quantity(series: &FrictionSeries) -> String {
    let name = if series.slides() {
        "friction force"
    } else {
        "friction torque"
    };
    with_unit(name, &series.units.load)
}

fn time(series: &FrictionSeries) -> String {
    with_unit("time", &series.units.time)
}

fn regimes() -> Vec<Entry> {
    let regimes = REGIMES.into_iter().zip(REGIME_COLOURS);
    regimes
        .map(|(name, colour)| Entry::new(name, Mark::Area, colour))
        .collect()
}

/// The regimes as bars from output to output, between two heights.
fn ribbon<B: DrawingBackend>(
    chart: &mut Chart<'_, B>,
    series: &FrictionSeries,
    [low, high]: [f64; 2],
) -> Drawn<B> {
    let mut bars = Vec::new();
    let mut start = 0;
    for stretch in series.regime.chunk_by(|a, b| a == b) {
        let end = (start + stretch.len()).min(series.time.len() - 1);
        let corners = [(series.time[start], low), (series.time[end], high)];
        bars.push(Rectangle::new(corners, REGIME_COLOURS[stretch[0]].filled()));
        start = end;
    }
    chart.draw_series(bars)?;
    Ok(())
}

/// The friction over time, with its regimes below.
pub(crate) fn over_time<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    title: &str,
    series: &FrictionSeries,
) -> Drawn<B> {
    let mut y = range(series.friction.iter().copied().chain([0.0]), 0.05);
    // A ribbon of 4 % of the height, below the lowest value.
    let height = 0.04 * (y.end - y.start);
    y.start -= 1.5 * height;
    let foot = y.start;
    let frame = Frame {
        title,
        axes: [time(series), quantity(series)],
        legend: regimes(),
        x: range(series.time.iter().copied(), 0.0),
        y,
        numbers: true,
    };
    framed(area, &frame, |chart| {
        ribbon(chart, series, [foot, foot + height])?;
        zero(chart)?;
        let places = needed(&series.time, &series.friction, COLUMNS);
        let points = places.iter().map(|&k| (series.time[k], series.friction[k]));
        curve(chart, points, BLACK, px(3) / 2)
    })
}

/// The friction against the velocity of its surfaces, or how far they have moved.
pub(crate) fn against<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    title: &str,
    series: &FrictionSeries,
    along: Along,
) -> Drawn<B> {
    let (name, x, unit) = match along {
        Along::Velocity => ("velocity", series.velocity.clone(), &series.units.velocity),
        Along::Displacement => ("displacement", series.displacement(), &series.units.length),
    };
    let ends = [
        Entry::new("start", Mark::Dot, BLUE),
        Entry::new("end", Mark::Square, VERMILION),
    ];
    let frame = Frame {
        title,
        axes: [
            with_unit(&format!("{name} of the surfaces"), unit),
            quantity(series),
        ],
        legend: ends.into(),
        x: range(x.iter().copied().chain([0.0]), 0.05),
        y: range(series.friction.iter().copied().chain([0.0]), 0.05),
        numbers: true,
    };
    let points: Vec<(f64, f64)> = x.into_iter().zip(series.friction.iter().copied()).collect();
    framed(area, &frame, |chart| {
        zero(chart)?;
        let y = chart.y_range();
        curve(chart, [(0.0, y.start), (0.0, y.end)], GREY, px(1))?;
        curve(chart, points.iter().copied(), BLUE, px(3) / 2)?;
        let full = |colour: RGBColor| colour.filled();
        let start = points
            .first()
            .map(|&point| Circle::new(point, DOT, full(BLUE)));
        chart.draw_series(start)?;
        let square = [(-DOT, -DOT), (DOT, DOT)];
        let end = points
            .last()
            .map(|&point| EmptyElement::at(point) + Rectangle::new(square, full(VERMILION)));
        chart.draw_series(end)?;
        Ok(())
    })
}

/// The friction by its causes over time, one upon the other.
pub(crate) fn shares<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    title: &str,
    series: &FrictionSeries,
) -> Drawn<B> {
    let largest = |cause: usize| {
        let values = series.causes[cause].iter();
        values.fold(0.0_f64, |most, value| most.max(value.abs()))
    };
    // Rounding is no cause.
    let least = 1e-9 * (0..CAUSES.len()).map(largest).fold(0.0, f64::max);
    let present: Vec<usize> = (0..CAUSES.len())
        .filter(|&cause| largest(cause) > least)
        .collect();
    let count = series.time.len();
    let total: Vec<f64> = (0..count)
        .map(|k| {
            present
                .iter()
                .map(|&cause| series.causes[cause][k].abs())
                .sum()
        })
        .collect();
    let legend = present
        .iter()
        .map(|&cause| Entry::new(CAUSES[cause], Mark::Area, CAUSE_COLOURS[cause]));
    let frame = Frame {
        title,
        axes: [
            time(series),
            with_unit("friction by cause", &series.units.load),
        ],
        legend: legend.collect(),
        x: range(series.time.iter().copied(), 0.0),
        y: 0.0..range(total.iter().copied().chain([0.0]), 0.05).end,
        numbers: true,
    };
    framed(area, &frame, |chart| {
        let places = needed(&series.time, &total, COLUMNS);
        let mut below = vec![0.0; places.len()];
        for &cause in &present {
            let values = places.iter().map(|&k| series.causes[cause][k].abs());
            let above: Vec<f64> = below.iter().zip(values).map(|(a, b)| a + b).collect();
            let at = |heights: &[f64]| -> Vec<(f64, f64)> {
                let pairs = places.iter().zip(heights);
                pairs
                    .map(|(&k, &height)| (series.time[k], height))
                    .collect()
            };
            let mut outline = at(&above);
            outline.extend(at(&below).into_iter().rev());
            let area = Polygon::new(outline, CAUSE_COLOURS[cause].filled());
            chart.draw_series([area])?;
            below = above;
        }
        Ok(())
    })
}

/// When each of several frictions is stuck, in transition or sliding, with their titles.
pub(crate) fn when<B: DrawingBackend>(
    area: &DrawingArea<B, Shift>,
    frictions: &[(String, FrictionSeries)],
) -> Drawn<B> {
    let Some((_, first)) = frictions.first() else {
        return Ok(());
    };
    let times = frictions.iter().flat_map(|(_, series)| &series.time);
    let rows = frictions.len() as f64;
    let frame = Frame {
        title: "regimes of friction",
        axes: [time(first), String::new()],
        legend: regimes(),
        x: range(times.copied(), 0.0),
        y: 0.0..rows,
        numbers: false,
    };
    framed(area, &frame, |chart| {
        let left = chart.x_range().start;
        let name = (FAMILY, TEXT).into_font().color(&BLACK);
        let name = name.pos(Pos::new(HPos::Left, VPos::Center));
        for (row, (title, series)) in frictions.iter().enumerate() {
            // The first on top; its title above its bar.
            let foot = rows - 1.0 - row as f64;
            ribbon(chart, series, [foot + 0.05, foot + 0.5])?;
            let title = Text::new(title.clone(), (left, foot + 0.72), name.clone());
            chart.draw_series([title])?;
        }
        Ok(())
    })
}
