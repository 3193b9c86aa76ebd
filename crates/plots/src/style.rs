//! Colours, sizes and letters of pictures.

use std::sync::Once;

use plotters::style::{FontFamily, FontStyle, RGBColor, register_font};

/// Eight colours that people with any colour vision tell apart (Okabe and Ito 2008), as on white paper:
/// black and a dark yellow stand for their black and yellow.
pub const COLOURS: [RGBColor; 8] = [
    BLUE,
    VERMILION,
    GREEN,
    PURPLE,
    RGBColor(0, 0, 0),
    ORANGE,
    SKY,
    RGBColor(120, 110, 0),
];

pub(crate) const BLUE: RGBColor = RGBColor(0, 114, 178);
pub(crate) const VERMILION: RGBColor = RGBColor(213, 94, 0);
pub(crate) const GREEN: RGBColor = RGBColor(0, 158, 115);
pub(crate) const PURPLE: RGBColor = RGBColor(204, 121, 167);
pub(crate) const ORANGE: RGBColor = RGBColor(230, 159, 0);
pub(crate) const SKY: RGBColor = RGBColor(86, 180, 233);

/// Stuck dark, transition in between, sliding light, so that they differ in lightness, too.
pub(crate) const REGIME_COLOURS: [RGBColor; 3] = [BLUE, ORANGE, RGBColor(217, 217, 217)];
/// By cause: preload, reaction force, bending, torsion.
pub(crate) const CAUSE_COLOURS: [RGBColor; 4] = [SKY, BLUE, ORANGE, VERMILION];
/// Lines at zero.
pub(crate) const GREY: RGBColor = RGBColor(128, 128, 128);
/// Lines of the grid.
pub(crate) const PALE: RGBColor = RGBColor(232, 232, 232);

/// Units of drawing in a pixel: the backends draw at whole units, which are to be fine enough for curves
/// without steps.
pub(crate) const SCALE: u32 = 4;

/// Pixels in units of drawing.
pub(crate) const fn px(pixels: u32) -> u32 {
    pixels * SCALE
}

/// Heights of letters, in units of drawing.
pub(crate) const TEXT: u32 = px(14);
pub(crate) const HEADING: u32 = px(16);

/// The family of all texts. A picture of vectors has it by name and is shown with the viewer's; for
/// dots, and to know the widths of texts, there is one of our own.
pub const FAMILY: FontFamily<'static> = FontFamily::SansSerif;

/// Makes the letters of [`FAMILY`] known to plotters; needed before anything with a text is drawn.
pub fn prepare_letters() {
    static ONCE: Once = Once::new();
    ONCE.call_once(|| {
        // It is a font, and always the same one.
        let _ = register_font(FAMILY.as_str(), FontStyle::Normal, dejavu::sans::regular());
    });
}
