//! One style for all pictures.

use std::error::Error;
use std::ops::Range;
use std::path::Path;

use plotters::prelude::*;

/// Colours that differ for everyone (Okabe and Ito).
pub(crate) const BLUE: RGBColor = RGBColor(0, 114, 178);
pub(crate) const ORANGE: RGBColor = RGBColor(213, 94, 0);
pub(crate) const GREEN: RGBColor = RGBColor(0, 158, 115);
pub(crate) const GREY: RGBColor = RGBColor(130, 130, 130);

/// Large, since the backend draws to whole units: the picture is scaled when it is shown.
const SIZE: (u32, u32) = (2880, 1800);
const TEXT: u32 = 60;

/// One curve with its label.
pub(crate) struct Curve<'a> {
    label: &'a str,
    colour: RGBColor,
    points: Vec<(f64, f64)>,
}

impl<'a> Curve<'a> {
    pub(crate) fn new(label: &'a str, colour: RGBColor, points: Vec<(f64, f64)>) -> Self {
        Self {
            label,
            colour,
            points,
        }
    }
}

/// A picture with one pair of axes.
pub(crate) struct Chart<'a> {
    pub(crate) file: &'a str,
    pub(crate) title: &'a str,
    pub(crate) x: &'a str,
    pub(crate) y: &'a str,
    pub(crate) legend: SeriesLabelPosition,
    pub(crate) x_range: Range<f64>,
    pub(crate) y_range: Range<f64>,
    /// Parts of the x axis with a name.
    pub(crate) zones: &'a [(f64, f64, &'a str)],
    pub(crate) curves: Vec<Curve<'a>>,
}

impl Chart<'_> {
    /// Writes the picture into the folder `pictures` of the crate.
    pub(crate) fn draw(self) -> Result<(), Box<dyn Error>> {
        let path = Path::new(env!("CARGO_MANIFEST_DIR"))
            .join("pictures")
            .join(self.file);
        let area = SVGBackend::new(&path, SIZE).into_drawing_area();
        area.fill(&WHITE)?;
        let text = ("sans-serif", TEXT).into_font();
        let (bottom, top) = (self.y_range.start, self.y_range.end);
        let mut chart = ChartBuilder::on(&area)
            .caption(self.title, text.resize(1.25 * f64::from(TEXT)))
            .margin(40)
            .x_label_area_size(170)
            .y_label_area_size(240)
            .build_cartesian_2d(self.x_range, self.y_range)?;
        for (k, (from, to, name)) in self.zones.iter().enumerate() {
            let shade = BLACK.mix(if k % 2 == 0 { 0.05 } else { 0.0 });
            let zone = Rectangle::new([(*from, bottom), (*to, top)], shade.filled());
            let place = (0.5 * (from + to), top - 0.02 * (top - bottom));
            let anchor = plotters::style::text_anchor::Pos::new(
                plotters::style::text_anchor::HPos::Center,
                plotters::style::text_anchor::VPos::Top,
            );
            let style = TextStyle::from(text.clone()).pos(anchor);
            chart.draw_series([zone])?;
            chart.draw_series([Text::new((*name).to_string(), place, style)])?;
        }
        chart
            .configure_mesh()
            .x_desc(self.x)
            .y_desc(self.y)
            .label_style(text.clone())
            .axis_desc_style(text.clone())
            .light_line_style(TRANSPARENT)
            .bold_line_style(BLACK.mix(0.12).stroke_width(3))
            .axis_style(BLACK.mix(0.6).stroke_width(4))
            // Zero has no sign.
            .x_label_formatter(&|x| format!("{}", shortest(*x)))
            .y_label_formatter(&|y| format!("{}", shortest(*y)))
            .x_labels(8)
            .y_labels(8)
            .draw()?;
        for Curve {
            label,
            colour,
            points,
        } in self.curves
        {
            let style = colour.stroke_width(9);
            chart
                .draw_series(LineSeries::new(points, style))?
                .label(label)
                .legend(move |(x, y)| PathElement::new([(x, y), (x + 110, y)], style));
        }
        chart
            .configure_series_labels()
            .position(self.legend)
            .legend_area_size(130)
            .margin(30)
            .label_font(text)
            .background_style(WHITE.mix(0.85))
            .draw()?;
        area.present()?;
        Ok(())
    }
}

/// A number of an axis without the rounding of its computation and the sign of zero.
fn shortest(x: f64) -> f64 {
    (x * 1e6).round() / 1e6 + 0.0
}
