//! Maps: panels of rasters with axes, a key and lines on top. They know no physics.

mod key;

use std::fmt::Write;

use anyhow::Result;
use base64::Engine;
use base64::engine::general_purpose::STANDARD;
use plotters::prelude::{IntoDrawingArea, SVGBackend, WHITE};
use plotters::style::Color;

use super::axis::{Axis, Ruler};
use super::palette::{self, Palette};
use super::style::{self, Anchor, Canvas, INK, LARGE, NORMAL, SMALL};
use crate::case::Raster;

/// What the colours of a panel mean.
#[derive(Clone, Debug, PartialEq)]
pub enum Key {
    /// A bar from the lower to the upper end of the raster.
    Field {
        /// Quantity and unit.
        label: String,
    },
    /// A list of classes.
    Classes {
        /// Their names in the order of their numbers, at most [`palette::MOST_CLASSES`].
        names: Vec<String>,
    },
}

impl Key {
    /// The palette that goes with it.
    pub fn palette(&self) -> Palette {
        match self {
            Self::Field { .. } => Palette::Sequential,
            Self::Classes { .. } => Palette::Categorical,
        }
    }
}

/// Lines on top of a panel, such as a free surface.
#[derive(Clone, Debug, PartialEq)]
pub struct Overlay {
    /// Text of the key.
    pub label: String,
    /// Which colour of the curves.
    pub style: usize,
    /// Places along each line, m; what lies outside the panel is left out.
    pub lines: Vec<Vec<[f64; 2]>>,
}

/// One raster with its key.
#[derive(Clone, Debug, PartialEq)]
pub struct MapPanel {
    /// Title above it.
    pub title: String,
    /// What is shown.
    pub raster: Raster,
    /// What the colours mean.
    pub key: Key,
    /// Lines on top.
    pub overlays: Vec<Overlay>,
}

/// Panels in rows from left to right, each to scale: a metre is as long along x as along y.
#[derive(Clone, Debug, PartialEq)]
pub struct MapFigure {
    /// Title above all panels.
    pub title: String,
    /// The panels.
    pub panels: Vec<MapPanel>,
    /// Panels per row.
    pub columns: usize,
}

/// Most pixels of a raster along either axis.
const MOST: f64 = 720.0;
const TITLE: i32 = 70;
/// Room beside a raster: for the labels on the left and for the key on the right.
const LEFT: i32 = 110;
const KEY: i32 = 250;
/// Room for its title above and its axis below.
const ABOVE: i32 = 45;
const BELOW: i32 = 95;

/// Place of a raster on the canvas.
struct Frame {
    left: i32,
    right: i32,
    top: i32,
    bottom: i32,
}

/// Draws a figure as SVG text; each raster is a picture of a pixel per cell within it.
///
/// # Errors
/// When a raster is damaged or has classes without a name, or the backend fails.
pub fn svg(figure: &MapFigure) -> Result<String> {
    style::prepare_font()?;
    for panel in &figure.panels {
        let raster = panel.raster.clone().checked()?;
        if let Key::Classes { names } = &panel.key {
            palette::check_classes(&raster, names.len())?;
        }
    }
    let (frames, size) = layout(figure);
    let (mut text, mut pictures) = (String::new(), String::new());
    {
        let canvas =
            SVGBackend::with_string(&mut text, (size.0 as u32, size.1 as u32)).into_drawing_area();
        style::text(&canvas, &figure.title, (size.0 / 2, TITLE / 2), LARGE, Anchor::Middle)?;
        for (panel, frame) in figure.panels.iter().zip(&frames) {
            draw_panel(&canvas, &mut pictures, panel, frame)?;
        }
        canvas.present().map_err(style::drawing_error)?;
    }
    // The backend has no pictures; they go below all that it has drawn.
    let end = text.find('>').map_or(0, |place| place + 1);
    let (head, drawn) = text.split_at(end);
    let (width, height) = size;
    let ground = format!("<rect width=\"{width}\" height=\"{height}\" fill=\"#FFFFFF\"/>");
    Ok(format!("{head}\n{ground}\n{pictures}{}", drawn.trim_start()))
}

/// Places of the rasters and the size of the canvas: columns as wide and rows as tall as what is in
/// them.
fn layout(figure: &MapFigure) -> (Vec<Frame>, (i32, i32)) {
    let columns = figure.columns.clamp(1, figure.panels.len().max(1));
    let rows = figure.panels.len().div_ceil(columns);
    let sizes: Vec<_> = figure.panels.iter().map(|panel| pixels(&panel.raster)).collect();
    let (mut lefts, mut tops) = (vec![LEFT], vec![TITLE + ABOVE]);
    for column in 0..columns {
        let widest = sizes.iter().skip(column).step_by(columns).map(|size| size.0).max();
        lefts.push(lefts[column] + widest.unwrap_or(0) + KEY + LEFT);
    }
    for row in 0..rows {
        let tallest = sizes.chunks(columns).nth(row).into_iter().flatten().map(|size| size.1).max();
        tops.push(tops[row] + tallest.unwrap_or(0) + BELOW + ABOVE);
    }
    let frame = |(index, (width, height)): (usize, (i32, i32))| {
        let (left, top) = (lefts[index % columns], tops[index / columns]);
        Frame { left, right: left + width, top, bottom: top + height }
    };
    let size = (lefts[columns] - LEFT, tops[rows] - ABOVE);
    (sizes.into_iter().enumerate().map(frame).collect(), size)
}

/// Width and height of a raster in pixels.
fn pixels(raster: &Raster) -> (i32, i32) {
    let [width, height] = raster.extent();
    let scale = MOST / width.max(height);
    let side = |meters: f64| (meters * scale).round().max(40.0) as i32;
    (side(width), side(height))
}

fn draw_panel(
    canvas: &Canvas<'_>,
    pictures: &mut String,
    panel: &MapPanel,
    frame: &Frame,
) -> Result<()> {
    let Frame { left, right, top, bottom } = *frame;
    let raster = &panel.raster;
    let codes = palette::enlarged(raster, 1);
    picture(pictures, frame, panel.key.palette(), raster.columns, &codes)?;
    let [width, height] = raster.extent();
    let [x0, y0] = raster.origin;
    let x = ruler("x, m", (x0, x0 + width), (left, right));
    let y = ruler("y, m", (y0, y0 + height), (bottom, top));
    for overlay in &panel.overlays {
        draw_overlay(canvas, overlay, frame, &x, &y)?;
    }
    outline(canvas, frame)?;
    for (place, label) in x.labels() {
        style::line(canvas, vec![(place, bottom), (place, bottom + 7)], INK.stroke_width(2))?;
        style::text(canvas, &label, (place, bottom + 22), SMALL, Anchor::Middle)?;
    }
    for (place, label) in y.labels() {
        style::line(canvas, vec![(left - 7, place), (left, place)], INK.stroke_width(2))?;
        style::text(canvas, &label, (left - 12, place), SMALL, Anchor::End)?;
    }
    let middle = i32::midpoint(left, right);
    style::text(canvas, &panel.title, (middle, top - 22), NORMAL, Anchor::Middle)?;
    style::text(canvas, "x, m", (middle, bottom + 52), NORMAL, Anchor::Middle)?;
    style::upright_text(canvas, "y, m", (left - 88, i32::midpoint(top, bottom)), NORMAL)?;
    key::draw(canvas, pictures, panel, frame)
}

/// A linear scale that ends where the data ends; a short one is labelled at its ends alone.
fn ruler(label: &str, (low, high): (f64, f64), pixels: (i32, i32)) -> Ruler {
    let axis = Axis::linear(label);
    let short = (pixels.1 - pixels.0).abs() < 160;
    let axis = if short { axis.with_ticks([low, high]) } else { axis };
    Ruler::fit(&axis, [low, high].into_iter(), (0.0, 0.0), pixels)
}

fn outline(canvas: &Canvas<'_>, frame: &Frame) -> Result<()> {
    let Frame { left, right, top, bottom } = *frame;
    let corners = vec![(left, top), (right, top), (right, bottom), (left, bottom), (left, top)];
    style::line(canvas, corners, INK.stroke_width(2))
}

/// A picture with the colours of the codes, stretched over the frame with sharp edges.
fn picture(
    pictures: &mut String,
    frame: &Frame,
    palette: Palette,
    columns: usize,
    codes: &[u8],
) -> Result<()> {
    let Frame { left, right, top, bottom } = *frame;
    let data = STANDARD.encode(palette::png(palette, columns, codes)?);
    writeln!(
        pictures,
        "<image x=\"{left}\" y=\"{top}\" width=\"{}\" height=\"{}\" preserveAspectRatio=\"none\" \
         image-rendering=\"optimizeSpeed\" style=\"image-rendering:pixelated\" \
         href=\"data:image/png;base64,{data}\"/>",
        right - left,
        bottom - top,
    )?;
    Ok(())
}

fn draw_overlay(
    canvas: &Canvas<'_>,
    overlay: &Overlay,
    frame: &Frame,
    x: &Ruler,
    y: &Ruler,
) -> Result<()> {
    let within = |(across, down): &(i32, i32)| {
        (frame.left..=frame.right).contains(across) && (frame.top..=frame.bottom).contains(down)
    };
    for line in &overlay.lines {
        let places: Vec<Option<(i32, i32)>> = line
            .iter()
            .map(|&[along, up]| Some((x.pixel(along)?, y.pixel(up)?)).filter(within))
            .collect();
        for piece in places.split(Option::is_none).filter(|piece| piece.len() > 1) {
            stroke(canvas, overlay.style, piece.iter().copied().flatten().collect())?;
        }
    }
    Ok(())
}

/// A line with white edges, which is seen on any colour.
fn stroke(canvas: &Canvas<'_>, index: usize, places: Vec<(i32, i32)>) -> Result<()> {
    style::line(canvas, places.clone(), WHITE.stroke_width(6))?;
    style::line(canvas, places, style::stroke(index))
}

#[cfg(test)]
mod tests;
