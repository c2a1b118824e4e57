//! What the colours and lines of a panel mean, at its right.

use anyhow::Result;
use plotters::element::Rectangle;
use plotters::style::Color;

use super::{Frame, Key, MapPanel, outline, picture, ruler, stroke};
use crate::case::Raster;
use crate::number;
use crate::report::palette::Palette;
use crate::report::style::{self, Anchor, Canvas, INK, NORMAL, SMALL};

/// Draws the lines' names, then the bar or the classes, at the right of a raster.
pub(super) fn draw(
    canvas: &Canvas<'_>,
    pictures: &mut String,
    panel: &MapPanel,
    frame: &Frame,
) -> Result<()> {
    let left = frame.right + 26;
    let mut top = frame.top;
    for overlay in &panel.overlays {
        stroke(canvas, overlay.style, vec![(left, top + 10), (left + 34, top + 10)])?;
        style::text(canvas, &overlay.label, (left + 46, top + 10), SMALL, Anchor::Start)?;
        top += 34;
    }
    if !panel.overlays.is_empty() {
        top += 10;
    }
    match &panel.key {
        Key::Classes { names } => {
            for (code, name) in (1..).zip(names) {
                swatch(canvas, Palette::Categorical, code, (left, top), name)?;
                top += 32;
            }
            Ok(())
        }
        Key::Field { label } => {
            let bar = Frame { left, right: left + 26, top, bottom: frame.bottom };
            draw_bar(canvas, pictures, &panel.raster, label, &bar)
        }
    }
}

fn draw_bar(
    canvas: &Canvas<'_>,
    pictures: &mut String,
    raster: &Raster,
    label: &str,
    bar: &Frame,
) -> Result<()> {
    let codes: Vec<u8> = (Raster::LOWER..=u8::MAX).rev().collect();
    picture(pictures, bar, Palette::Sequential, 1, &codes)?;
    outline(canvas, bar)?;
    let range = (raster.lower, raster.upper);
    let labels = ruler(label, range, (bar.bottom, bar.top)).labels();
    let longest = labels.iter().map(|(_, text)| text.chars().count()).max().unwrap_or(0);
    for (place, text) in labels {
        style::line(canvas, vec![(bar.right, place), (bar.right + 7, place)], INK.stroke_width(2))?;
        style::text(canvas, &text, (bar.right + 14, place), SMALL, Anchor::Start)?;
    }
    // A digit is 12 pixels wide.
    let place = (bar.right + 40 + 12 * longest as i32, i32::midpoint(bar.top, bar.bottom));
    style::upright_text(canvas, label, place, NORMAL)?;
    if raster.values.contains(&Raster::BELOW) {
        let text = format!("below {}", number::bound(Some(raster.lower)));
        swatch(canvas, Palette::Sequential, Raster::BELOW, (bar.left, bar.bottom + 30), &text)?;
    }
    Ok(())
}

/// A square of a code's colour with a text beside it.
fn swatch(
    canvas: &Canvas<'_>,
    palette: Palette,
    code: u8,
    (left, top): (i32, i32),
    text: &str,
) -> Result<()> {
    let corners = [(left, top), (left + 26, top + 20)];
    let filled = Rectangle::new(corners, palette.color(code).filled());
    canvas.draw(&filled).map_err(style::drawing_error)?;
    let edge = Rectangle::new(corners, INK.stroke_width(1));
    canvas.draw(&edge).map_err(style::drawing_error)?;
    style::text(canvas, text, (left + 38, top + 10), SMALL, Anchor::Start)
}
