//! Work-precision pictures: error against time, one line an integrator or peer.

use std::path::Path;

use plots::{COLOURS, prepare_letters};
use plotters::prelude::*;

use super::tables::names;
use super::work_precision::{Measured, Row};

/// Width and height, pixels.
const SIZE: (u32, u32) = (760, 460);

/// File of the picture of a case, as seen from the page.
pub(crate) fn file(case: &str) -> String {
    format!("pictures/performance-{case}.svg")
}

/// Errors and times of the rows of one name that came to an end with an error above zero.
fn points(rows: &[Row], name: &str) -> Vec<(f64, f64)> {
    let of_name = rows.iter().filter(|row| row.name == name);
    let ended = of_name.filter_map(|row| row.outcome.as_ref().ok());
    let points = ended.map(|outcome| (outcome.error, 1e3 * outcome.times.processor));
    points.filter(|(error, _)| *error > 0.0).collect()
}

/// A power of ten a little below the least and above the greatest of some numbers.
fn decades(values: impl Iterator<Item = f64>) -> std::ops::Range<f64> {
    let (least, greatest) = values.fold((f64::INFINITY, 0.0_f64), |(least, greatest), value| {
        (least.min(value), greatest.max(value))
    });
    10f64.powf(least.log10().floor())..10f64.powf(greatest.log10().ceil())
}

/// Draws a case as an SVG file.
///
/// # Errors
/// When nothing was measured, or the file cannot be written.
pub(crate) fn draw(measured: &Measured, path: &Path) -> Result<(), String> {
    let said = |error: DrawingAreaErrorKind<_>| format!("{}: {error}", path.display());
    let rows = &measured.rows;
    let series: Vec<_> = names(rows)
        .into_iter()
        .map(|name| (name, points(rows, name)))
        .filter(|(_, points)| !points.is_empty())
        .collect();
    let all = || series.iter().flat_map(|(_, points)| points.iter().copied());
    if all().next().is_none() {
        return Err(format!("{}: nothing was measured", measured.case.name));
    }
    prepare_letters();
    let area = SVGBackend::new(path, SIZE).into_drawing_area();
    area.fill(&WHITE).map_err(said)?;
    let mut chart = ChartBuilder::on(&area)
        .caption(measured.case.title, ("sans-serif", 20))
        .margin(12)
        .x_label_area_size(46)
        .y_label_area_size(62)
        .build_cartesian_2d(
            decades(all().map(|(error, _)| error)).log_scale(),
            decades(all().map(|(_, time)| time)).log_scale(),
        )
        .map_err(said)?;
    let power = |value: &f64| format!("{value:.0e}");
    chart
        .configure_mesh()
        .x_desc(format!("error: {}", measured.case.quantity))
        .y_desc("processor time, ms")
        .x_label_formatter(&power)
        .y_label_formatter(&|value| format!("{value}"))
        .light_line_style(WHITE)
        .label_style(("sans-serif", 14))
        .draw()
        .map_err(said)?;
    for (k, (name, points)) in series.iter().enumerate() {
        let colour = COLOURS[k % COLOURS.len()];
        // Ours are filled, peers are open.
        let filled = rows.iter().any(|row| row.name == *name && row.is_ours());
        let style = |filled: bool| match filled {
            true => colour.filled(),
            false => colour.stroke_width(2),
        };
        let line = LineSeries::new(points.iter().copied(), colour.stroke_width(2));
        chart
            .draw_series(line)
            .map_err(said)?
            .label(*name)
            .legend(move |(x, y)| PathElement::new([(x, y), (x + 22, y)], colour.stroke_width(2)));
        let marks = points
            .iter()
            .map(|&point| Circle::new(point, 4, style(filled)));
        chart.draw_series(marks).map_err(said)?;
    }
    chart
        .configure_series_labels()
        .position(SeriesLabelPosition::UpperRight)
        .background_style(WHITE.mix(0.85))
        .border_style(BLACK.mix(0.3))
        .label_font(("sans-serif", 14))
        .draw()
        .map_err(said)?;
    area.present().map_err(said)
}
