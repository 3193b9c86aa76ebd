//! From drawing to the bytes of a file.

use plotters::coord::Shift;
use plotters::prelude::*;

use crate::dots::Dots;
use crate::style::{SCALE, prepare_letters, px};
use crate::{Format, PlotError};

/// Dots for a pixel in each direction: sharp on screens and in print.
const DOTS: u32 = 2;
/// Units of drawing that a dot is the mean of, in each direction.
const MEAN: u32 = SCALE / DOTS;

/// What drawing into a backend gives.
pub(crate) type Drawn<B> = Result<(), DrawingAreaErrorKind<<B as DrawingBackend>::ErrorType>>;

/// Something that can be drawn into any backend.
pub(crate) trait Drawing {
    /// Width and height, pixels.
    fn size(&self) -> (u32, u32);
    /// Draws it into an area of that size.
    fn draw<B: DrawingBackend>(&self, area: &DrawingArea<B, Shift>) -> Drawn<B>;
}

/// The bytes of a picture.
pub(crate) fn render(drawing: &impl Drawing, format: Format) -> Result<Vec<u8>, PlotError> {
    prepare_letters();
    match format {
        Format::Svg => svg(drawing),
        Format::Png => png(drawing),
    }
}

fn failed(error: &impl ToString) -> PlotError {
    PlotError::Drawing(error.to_string())
}

fn filled<B: DrawingBackend>(drawing: &impl Drawing, backend: B) -> Result<(), PlotError> {
    let area = backend.into_drawing_area();
    area.fill(&WHITE).map_err(|error| failed(&error))?;
    drawing.draw(&area).map_err(|error| failed(&error))?;
    area.present().map_err(|error| failed(&error))
}

fn svg(drawing: &impl Drawing) -> Result<Vec<u8>, PlotError> {
    let (width, height) = drawing.size();
    let mut text = String::new();
    filled(
        drawing,
        SVGBackend::with_string(&mut text, (px(width), px(height))),
    )?;
    // The view box keeps the units of drawing; the picture is as large as its pixels.
    let fine = format!("width=\"{}\" height=\"{}\"", px(width), px(height));
    let shown = format!("width=\"{width}\" height=\"{height}\"");
    Ok(text.replacen(&fine, &shown, 1).into_bytes())
}

fn png(drawing: &impl Drawing) -> Result<Vec<u8>, PlotError> {
    let (width, height) = drawing.size();
    let (fine_width, fine_height) = (px(width), px(height));
    let mut fine = vec![0; 3 * fine_width as usize * fine_height as usize];
    filled(
        drawing,
        Dots(BitMapBackend::with_buffer(
            &mut fine,
            (fine_width, fine_height),
        )),
    )?;
    let dots = means(&fine, fine_width as usize);
    let mut bytes = Vec::new();
    let mut encoder = png::Encoder::new(&mut bytes, DOTS * width, DOTS * height);
    encoder.set_color(png::ColorType::Rgb);
    encoder.set_depth(png::BitDepth::Eight);
    let mut writer = encoder.write_header().map_err(|error| failed(&error))?;
    let written = writer.write_image_data(&dots);
    written.map_err(|error| failed(&error))?;
    writer.finish().map_err(|error| failed(&error))?;
    Ok(bytes)
}

/// Means over squares, which make smooth edges.
fn means(fine: &[u8], fine_width: usize) -> Vec<u8> {
    let mean = MEAN as usize;
    let mut dots = Vec::with_capacity(fine.len() / (mean * mean));
    for rows in fine.chunks_exact(3 * fine_width * mean) {
        for x in 0..fine_width / mean {
            for colour in 0..3 {
                let mut sum = 0;
                for row in rows.chunks_exact(3 * fine_width) {
                    for k in 0..mean {
                        sum += u32::from(row[3 * (x * mean + k) + colour]);
                    }
                }
                let count = MEAN * MEAN;
                // A mean of bytes is one.
                dots.push(((sum + count / 2) / count) as u8);
            }
        }
    }
    dots
}
