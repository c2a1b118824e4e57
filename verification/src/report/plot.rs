//! Figures: panels of curves with measured labels. They know no physics.

use anyhow::Result;
use plotters::prelude::{IntoDrawingArea, SVGBackend, WHITE};
use plotters::style::{Color, ShapeStyle};

use super::axis::{Axis, Ruler, Scale};
use super::style::{self, Anchor, Canvas, GRID, GUIDE, INK, LARGE, NORMAL, PALE, SMALL};

/// One curve.
#[derive(Clone, Debug, PartialEq)]
pub struct Curve {
    /// Text of the legend.
    pub label: String,
    /// Which colour and marker.
    pub style: usize,
    /// Values; one that is not finite is a gap.
    pub points: Vec<(f64, f64)>,
    /// How the values are shown.
    pub look: Look,
}

/// How the values of a curve are shown.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Look {
    /// A line with a marker at every value.
    Marked,
    /// A line with about this many markers along it, staggered between curves.
    Sparse(usize),
    /// A line alone, for what is exact.
    Line,
    /// A wide pale line, for what encloses the others.
    Band,
    /// A thin grey line, to compare slopes with.
    Guide,
    /// Markers alone, for what was measured elsewhere.
    Dots,
}

impl Look {
    /// Its line on the curve of a style.
    fn stroke(self, style: usize) -> ShapeStyle {
        match self {
            Self::Band => PALE.stroke_width(12),
            Self::Guide => GUIDE.stroke_width(1),
            _ => style::stroke(style),
        }
    }

    /// Whether value `index` of `count` gets a marker on the curve of a style.
    fn marks(self, index: usize, count: usize, style: usize) -> bool {
        match self {
            Self::Marked | Self::Dots => true,
            Self::Line | Self::Band | Self::Guide => false,
            Self::Sparse(markers) => {
                let stride = (count / markers.max(1)).max(1);
                index % stride == (style * stride / 9 + stride / 2) % stride
            }
        }
    }
}

/// One pair of axes with curves and a legend on its right.
#[derive(Clone, Debug, PartialEq)]
pub struct Panel {
    /// Title above it.
    pub title: String,
    /// Horizontal axis.
    pub x: Axis,
    /// Vertical axis.
    pub y: Axis,
    /// Heading of the legend.
    pub legend: String,
    /// Curves in the order of the legend.
    pub curves: Vec<Curve>,
    /// Slopes to show as triangles; only on two logarithmic axes.
    pub slopes: Vec<f64>,
}

/// Panels in rows from left to right.
#[derive(Clone, Debug, PartialEq)]
pub struct Figure {
    /// Title above all panels.
    pub title: String,
    /// The panels.
    pub panels: Vec<Panel>,
    /// Panels per row.
    pub columns: usize,
}

const PANEL: (i32, i32) = (900, 620);
const TITLE: i32 = 70;
const LEGEND: i32 = 230;

/// Draws a figure as SVG text.
///
/// # Errors
/// When the backend fails.
pub fn svg(figure: &Figure) -> Result<String> {
    style::prepare_font()?;
    let columns = figure.columns.clamp(1, figure.panels.len().max(1));
    let rows = figure.panels.len().div_ceil(columns);
    let size = corner(columns, rows);
    let mut text = String::new();
    {
        let canvas =
            SVGBackend::with_string(&mut text, (size.0 as u32, size.1 as u32)).into_drawing_area();
        canvas.fill(&WHITE).map_err(style::drawing_error)?;
        style::text(&canvas, &figure.title, (size.0 / 2, TITLE / 2), LARGE, Anchor::Middle)?;
        for (index, panel) in figure.panels.iter().enumerate() {
            let origin = corner(index % columns, index / columns);
            draw_panel(&canvas, panel, &shared_ordinates(figure, columns, index), origin)?;
        }
        canvas.present().map_err(style::drawing_error)?;
    }
    Ok(text)
}

/// Upper left corner of a panel.
fn corner(column: usize, row: usize) -> (i32, i32) {
    let count = |n: usize| i32::try_from(n).unwrap_or(i32::MAX);
    (PANEL.0.saturating_mul(count(column)), TITLE + PANEL.1.saturating_mul(count(row)))
}

/// Pixel box of the plotted area.
struct Frame {
    left: i32,
    right: i32,
    top: i32,
    bottom: i32,
}

/// Ordinates of all panels in the same row whose vertical axis is the same: such panels share their
/// range, so that they can be compared.
fn shared_ordinates(figure: &Figure, columns: usize, index: usize) -> Vec<f64> {
    let row = figure.panels.chunks(columns).nth(index / columns).unwrap_or_default();
    row.iter()
        .filter(|panel| panel.y == figure.panels[index].y)
        .flat_map(|panel| panel.curves.iter().flat_map(|curve| &curve.points))
        .map(|point| point.1)
        .collect()
}

fn draw_panel(
    canvas: &Canvas<'_>,
    panel: &Panel,
    ordinates: &[f64],
    (x0, y0): (i32, i32),
) -> Result<()> {
    let frame = Frame {
        left: x0 + 120,
        right: x0 + PANEL.0 - LEGEND - 10,
        top: y0 + 45,
        bottom: y0 + PANEL.1 - 85,
    };
    let abscissae = panel.curves.iter().flat_map(|curve| &curve.points).map(|point| point.0);
    let shows_slopes =
        !panel.slopes.is_empty() && panel.x.scale == Scale::Log && panel.y.scale == Scale::Log;
    // Room for the slope triangles below all curves.
    let below = if shows_slopes { 0.3 } else { 0.06 };
    let x = Ruler::fit(&panel.x, abscissae, (0.06, 0.06), (frame.left, frame.right));
    let y =
        Ruler::fit(&panel.y, ordinates.iter().copied(), (below, 0.08), (frame.bottom, frame.top));
    draw_axes(canvas, panel, &frame, &x, &y)?;
    if shows_slopes {
        draw_slopes(canvas, &panel.slopes, &x, &y)?;
    }
    // The first of the legend lies on top.
    for curve in panel.curves.iter().rev() {
        draw_curve(canvas, curve, &x, &y)?;
    }
    draw_legend(canvas, panel, &frame)
}

fn draw_axes(
    canvas: &Canvas<'_>,
    panel: &Panel,
    frame: &Frame,
    x: &Ruler,
    y: &Ruler,
) -> Result<()> {
    let Frame { left, right, top, bottom } = *frame;
    let (grid, ink) = (GRID.stroke_width(1), INK.stroke_width(2));
    for (place, label) in x.labels() {
        style::line(canvas, vec![(place, top), (place, bottom)], grid)?;
        style::line(canvas, vec![(place, bottom), (place, bottom - 9)], ink)?;
        style::text(canvas, &label, (place, bottom + 20), SMALL, Anchor::Middle)?;
    }
    for (place, label) in y.labels() {
        style::line(canvas, vec![(left, place), (right, place)], grid)?;
        style::line(canvas, vec![(left, place), (left + 9, place)], ink)?;
        style::text(canvas, &label, (left - 10, place), SMALL, Anchor::End)?;
    }
    for place in x.minor_ticks() {
        style::line(canvas, vec![(place, bottom), (place, bottom - 5)], INK.stroke_width(1))?;
    }
    for place in y.minor_ticks() {
        style::line(canvas, vec![(left, place), (left + 5, place)], INK.stroke_width(1))?;
    }
    let corners = vec![(left, top), (right, top), (right, bottom), (left, bottom), (left, top)];
    style::line(canvas, corners, ink)?;
    let middle = i32::midpoint(left, right);
    style::text(canvas, &panel.title, (middle, top - 22), NORMAL, Anchor::Middle)?;
    style::text(canvas, &panel.x.label, (middle, bottom + 55), NORMAL, Anchor::Middle)?;
    let place = (left - 98, i32::midpoint(top, bottom));
    style::upright_text(canvas, &panel.y.label, place, NORMAL)
}

fn draw_curve(canvas: &Canvas<'_>, curve: &Curve, x: &Ruler, y: &Ruler) -> Result<()> {
    let places: Vec<Option<(i32, i32)>> = curve
        .points
        .iter()
        .map(|&(abscissa, ordinate)| Some((x.pixel(abscissa)?, y.pixel(ordinate)?)))
        .collect();
    for piece in places.split(Option::is_none) {
        let piece: Vec<_> = piece.iter().copied().flatten().collect();
        if piece.len() > 1 && curve.look != Look::Dots {
            style::line(canvas, piece, curve.look.stroke(curve.style))?;
        }
    }
    let count = places.len();
    places
        .into_iter()
        .enumerate()
        .filter(|&(index, _)| curve.look.marks(index, count, curve.style))
        .filter_map(|(_, place)| place)
        .try_for_each(|place| style::marker(canvas, curve.style, place))
}

/// Right triangles, side by side in the free strip at the lower right.
fn draw_slopes(canvas: &Canvas<'_>, slopes: &[f64], x: &Ruler, y: &Ruler) -> Result<()> {
    let (x_low, x_high) = x.range();
    let (y_low, y_high) = y.range();
    let base = 0.16 * (x_high - x_low);
    let floor = y_low + 0.05 * (y_high - y_low);
    for (index, slope) in slopes.iter().enumerate() {
        let right = x_high - (0.08 + 0.26 * (slopes.len() - 1 - index) as f64) * (x_high - x_low);
        let (left, ceiling) = (right - base, floor + slope * base);
        let [a, b, c] = [(left, floor), (right, floor), (right, ceiling)]
            .map(|(along, up)| (x.place(along), y.place(up)));
        style::line(canvas, vec![a, b, c, a], GUIDE.stroke_width(2))?;
        let label = (b.0 + 8, i32::midpoint(b.1, c.1).min(b.1 - 8));
        style::text(canvas, &slope.to_string(), label, SMALL, Anchor::Start)?;
    }
    Ok(())
}

fn draw_legend(canvas: &Canvas<'_>, panel: &Panel, frame: &Frame) -> Result<()> {
    let left = frame.right + 18;
    let mut y = frame.top + 12;
    style::text(canvas, &panel.legend, (left, y), SMALL, Anchor::Start)?;
    // Many curves stand closer.
    let room = (frame.bottom - y) / i32::try_from(panel.curves.len().max(1)).unwrap_or(i32::MAX);
    for curve in &panel.curves {
        y += room.clamp(18, 36);
        if curve.look != Look::Dots {
            let stroke = curve.look.stroke(curve.style);
            style::line(canvas, vec![(left, y), (left + 44, y)], stroke)?;
        }
        if !matches!(curve.look, Look::Line | Look::Band | Look::Guide) {
            style::marker(canvas, curve.style, (left + 22, y))?;
        }
        style::text(canvas, &curve.label, (left + 56, y), SMALL, Anchor::Start)?;
    }
    Ok(())
}
