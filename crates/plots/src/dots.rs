//! Dots with round joins: plotters joins wide lines by mitres, which grow without limit where a curve
//! turns back.

use plotters::prelude::*;
use plotters_backend::{BackendColor, BackendCoord, BackendStyle, DrawingErrorKind};

/// A bitmap whose wide lines have round joins.
pub(crate) struct Dots<'a>(pub(crate) BitMapBackend<'a>);

type Refused<'a> = DrawingErrorKind<<BitMapBackend<'a> as DrawingBackend>::ErrorType>;

impl<'a> DrawingBackend for Dots<'a> {
    type ErrorType = <BitMapBackend<'a> as DrawingBackend>::ErrorType;

    fn get_size(&self) -> (u32, u32) {
        self.0.get_size()
    }

    fn ensure_prepared(&mut self) -> Result<(), Refused<'a>> {
        self.0.ensure_prepared()
    }

    fn present(&mut self) -> Result<(), Refused<'a>> {
        self.0.present()
    }

    fn draw_pixel(&mut self, point: BackendCoord, color: BackendColor) -> Result<(), Refused<'a>> {
        self.0.draw_pixel(point, color)
    }

    fn draw_line<S: BackendStyle>(
        &mut self,
        from: BackendCoord,
        to: BackendCoord,
        style: &S,
    ) -> Result<(), Refused<'a>> {
        self.0.draw_line(from, to, style)
    }

    fn draw_rect<S: BackendStyle>(
        &mut self,
        upper_left: BackendCoord,
        bottom_right: BackendCoord,
        style: &S,
        fill: bool,
    ) -> Result<(), Refused<'a>> {
        self.0.draw_rect(upper_left, bottom_right, style, fill)
    }

    fn draw_path<S: BackendStyle, I: IntoIterator<Item = BackendCoord>>(
        &mut self,
        path: I,
        style: &S,
    ) -> Result<(), Refused<'a>> {
        let mut last = None;
        for point in path {
            match last {
                Some(last) if last == point => continue,
                Some(last) => self.draw_line(last, point, style)?,
                None => {}
            }
            if style.stroke_width() > 2 {
                self.draw_circle(point, style.stroke_width() / 2, style, true)?;
            }
            last = Some(point);
        }
        Ok(())
    }
}
