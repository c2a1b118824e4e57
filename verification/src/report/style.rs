//! Colours, markers and fonts, in one place. All drawing goes through plotters' SVG backend.

use std::sync::OnceLock;

use anyhow::{Result, anyhow};
use plotters::coord::Shift;
use plotters::element::{Circle, PathElement, Polygon, Text};
use plotters::prelude::{DrawingArea, SVGBackend};
use plotters::style::text_anchor::{HPos, Pos, VPos};
use plotters::style::{
    Color, FontStyle, FontTransform, RGBColor, ShapeStyle, TextStyle, register_font,
};

/// The font of every figure, vendored so that figures are the same everywhere.
pub const FONT: &[u8] = include_bytes!("../../assets/DejaVuSans.ttf");
/// Its family name.
pub const FONT_FAMILY: &str = "DejaVu Sans";

/// Size of labels and keys, pixels.
pub const SMALL: u32 = 19;
/// Size of titles of panels and axes, pixels.
pub const NORMAL: u32 = 21;
/// Size of the title of a figure, pixels.
pub const LARGE: u32 = 26;

/// Ink of axes and text.
pub const INK: RGBColor = RGBColor(40, 40, 40);
/// Major grid lines.
pub const GRID: RGBColor = RGBColor(222, 222, 222);
/// Wide lines that others are drawn over.
pub const PALE: RGBColor = RGBColor(205, 205, 205);
/// Guides such as slope triangles.
pub const GUIDE: RGBColor = RGBColor(110, 110, 110);

/// Okabe and Ito's palette, told apart with any colour vision; grey stands in for yellow, which
/// does not show on white, and a dark indigo is added.
const PALETTE: [RGBColor; 9] = [
    RGBColor(213, 94, 0),
    RGBColor(0, 114, 178),
    RGBColor(0, 0, 0),
    RGBColor(0, 158, 115),
    RGBColor(86, 180, 233),
    RGBColor(230, 159, 0),
    RGBColor(204, 121, 167),
    RGBColor(140, 140, 140),
    RGBColor(68, 34, 136),
];

/// The canvas.
pub type Canvas<'a> = DrawingArea<SVGBackend<'a>, Shift>;

/// Makes the font known to plotters, once per process.
///
/// # Errors
/// When the vendored font cannot be read.
pub fn prepare_font() -> Result<()> {
    static READY: OnceLock<bool> = OnceLock::new();
    let ready = *READY.get_or_init(|| register_font(FONT_FAMILY, FontStyle::Normal, FONT).is_ok());
    if ready { Ok(()) } else { Err(anyhow!("the vendored font is damaged")) }
}

/// Colour of the curve with that index.
pub fn color(index: usize) -> RGBColor {
    PALETTE[index % PALETTE.len()]
}

/// Stroke of the curve with that index.
pub fn stroke(index: usize) -> ShapeStyle {
    color(index).stroke_width(3)
}

/// Where a text hangs on its place.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Anchor {
    /// Text begins at the place.
    Start,
    /// Text is centred on the place.
    Middle,
    /// Text ends at the place.
    End,
}

/// Draws a text vertically centred on a place.
///
/// # Errors
/// When the backend fails.
pub fn text(
    canvas: &Canvas<'_>,
    content: &str,
    place: (i32, i32),
    size: u32,
    anchor: Anchor,
) -> Result<()> {
    draw_text(canvas, content, place, size, anchor, FontTransform::None)
}

/// Draws a text that reads upwards, centred on a place.
///
/// # Errors
/// When the backend fails.
pub fn upright_text(
    canvas: &Canvas<'_>,
    content: &str,
    place: (i32, i32),
    size: u32,
) -> Result<()> {
    draw_text(canvas, content, place, size, Anchor::Middle, FontTransform::Rotate270)
}

fn draw_text(
    canvas: &Canvas<'_>,
    content: &str,
    place: (i32, i32),
    size: u32,
    anchor: Anchor,
    transform: FontTransform,
) -> Result<()> {
    let horizontal = match anchor {
        Anchor::Start => HPos::Left,
        Anchor::Middle => HPos::Center,
        Anchor::End => HPos::Right,
    };
    // The backend divides the size by 1.24.
    let style = TextStyle::from((FONT_FAMILY, f64::from(size) * 1.24))
        .color(&INK)
        .pos(Pos::new(horizontal, VPos::Center))
        .transform(transform);
    canvas.draw(&Text::new(content.to_owned(), place, style)).map_err(drawing_error)
}

/// Draws a line through several places.
///
/// # Errors
/// When the backend fails.
pub fn line(canvas: &Canvas<'_>, places: Vec<(i32, i32)>, style: ShapeStyle) -> Result<()> {
    canvas.draw(&PathElement::new(places, style)).map_err(drawing_error)
}

/// Draws the marker of the curve with that index.
///
/// Markers are open, so that coinciding curves show all of theirs.
///
/// # Errors
/// When the backend fails.
pub fn marker(canvas: &Canvas<'_>, index: usize, (x, y): (i32, i32)) -> Result<()> {
    let style = stroke(index);
    let at = |offsets: &[(i32, i32)]| -> Vec<(i32, i32)> {
        offsets.iter().map(|(dx, dy)| (x + dx, y + dy)).collect()
    };
    // Beyond the palette a colour comes back with the marker of its neighbour.
    let strokes: &[&[(i32, i32)]] = match (index + index / PALETTE.len()) % PALETTE.len() {
        0 => return canvas.draw(&Circle::new((x, y), 8, style)).map_err(drawing_error),
        1 => &[&[(-8, -8), (8, -8), (8, 8), (-8, 8), (-8, -8)]],
        2 => &[&[(-9, -9), (9, 9)], &[(-9, 9), (9, -9)]],
        3 => &[&[(0, -11), (10, 7), (-10, 7), (0, -11)]],
        4 => &[&[(0, 11), (10, -7), (-10, -7), (0, 11)]],
        5 => &[&[(0, -12), (10, 0), (0, 12), (-10, 0), (0, -12)]],
        6 => &[&[(-11, 0), (11, 0)], &[(0, -11), (0, 11)]],
        7 => {
            let square = at(&[(-5, -5), (5, -5), (5, 5), (-5, 5)]);
            return canvas.draw(&Polygon::new(square, color(index))).map_err(drawing_error);
        }
        _ => &[&[(0, -11), (0, 11)], &[(-9, -6), (9, 6)], &[(-9, 6), (9, -6)]],
    };
    strokes.iter().try_for_each(|offsets| line(canvas, at(offsets), style))
}

/// Drawing into a string does not fail for a reason that the caller could mend.
pub fn drawing_error(error: impl std::fmt::Display) -> anyhow::Error {
    anyhow!("cannot draw: {error}")
}
