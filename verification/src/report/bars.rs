//! Bars about a line of no change, on a logarithmic axis.

use anyhow::Result;
use plotters::element::Polygon;
use plotters::prelude::{IntoDrawingArea, SVGBackend, WHITE};
use plotters::style::Color;

use super::axis::{Axis, Ruler};
use super::style::{self, Anchor, Canvas, GRID, INK, LARGE, NORMAL, SMALL};

/// The bars of one thing compared.
#[derive(Clone, Debug, PartialEq)]
pub struct BarGroup {
    /// Text on the left.
    pub label: String,
    /// One value per series; one that is not positive and finite has no bar.
    pub values: Vec<f64>,
    /// Text in place of missing bars.
    pub note: String,
}

/// Groups of horizontal bars from a line of no change on.
#[derive(Clone, Debug, PartialEq)]
pub struct BarFigure {
    /// Title.
    pub title: String,
    /// Label of the axis.
    pub axis: String,
    /// Names of the series, in the order of the values.
    pub series: Vec<String>,
    /// The groups, from top to bottom.
    pub groups: Vec<BarGroup>,
    /// Where the bars begin.
    pub reference: f64,
}

const WIDTH: i32 = 1100;
const LEFT: i32 = 280;
const RIGHT: i32 = 1060;
const TOP: i32 = 120;
const BAR: i32 = 14;
const GAP: i32 = 12;
const BOTTOM: i32 = 90;

/// Draws a figure as SVG text.
///
/// # Errors
/// When the backend fails.
pub fn svg(figure: &BarFigure) -> Result<String> {
    style::prepare_font()?;
    let count = |n: usize| i32::try_from(n).unwrap_or(i32::MAX);
    let row = count(figure.series.len()) * BAR + GAP;
    let bottom = TOP + count(figure.groups.len()) * row + GAP;
    let values = figure.groups.iter().flat_map(|group| group.values.iter().copied());
    let ruler = Ruler::fit(
        &Axis::log(figure.axis.clone()),
        values.chain([figure.reference]),
        (0.05, 0.05),
        (LEFT, RIGHT),
    );
    let mut text = String::new();
    {
        let size = (WIDTH as u32, (bottom + BOTTOM) as u32);
        let canvas = SVGBackend::with_string(&mut text, size).into_drawing_area();
        canvas.fill(&WHITE).map_err(style::drawing_error)?;
        style::text(&canvas, &figure.title, (WIDTH / 2, 35), LARGE, Anchor::Middle)?;
        draw_axis(&canvas, figure, &ruler, bottom)?;
        for (index, group) in figure.groups.iter().enumerate() {
            let top = TOP + GAP + count(index) * row;
            draw_group(&canvas, group, (&ruler, figure.reference), top, row - GAP)?;
        }
        canvas.present().map_err(style::drawing_error)?;
    }
    Ok(text)
}

fn draw_axis(canvas: &Canvas<'_>, figure: &BarFigure, ruler: &Ruler, bottom: i32) -> Result<()> {
    for (place, label) in ruler.labels() {
        style::line(canvas, vec![(place, TOP), (place, bottom)], GRID.stroke_width(1))?;
        style::text(canvas, &label, (place, bottom + 20), SMALL, Anchor::Middle)?;
    }
    for place in ruler.minor_ticks() {
        style::line(canvas, vec![(place, bottom), (place, bottom - 5)], INK.stroke_width(1))?;
    }
    let corners = vec![(LEFT, TOP), (RIGHT, TOP), (RIGHT, bottom), (LEFT, bottom), (LEFT, TOP)];
    style::line(canvas, corners, INK.stroke_width(2))?;
    if let Some(place) = ruler.pixel(figure.reference) {
        style::line(canvas, vec![(place, TOP), (place, bottom)], INK.stroke_width(2))?;
    }
    style::text(
        canvas,
        &figure.axis,
        (i32::midpoint(LEFT, RIGHT), bottom + 58),
        NORMAL,
        Anchor::Middle,
    )?;
    let mut left = LEFT;
    for (index, name) in figure.series.iter().enumerate() {
        fill(canvas, (left, 85), (left + 30, 85 + BAR), index)?;
        style::text(canvas, name, (left + 40, 85 + BAR / 2), SMALL, Anchor::Start)?;
        left += 240;
    }
    Ok(())
}

fn draw_group(
    canvas: &Canvas<'_>,
    group: &BarGroup,
    (ruler, reference): (&Ruler, f64),
    top: i32,
    height: i32,
) -> Result<()> {
    let middle = top + height / 2;
    style::text(canvas, &group.label, (LEFT - 12, middle), SMALL, Anchor::End)?;
    let Some(start) = ruler.pixel(reference) else { return Ok(()) };
    let mut y = top;
    for (index, &value) in group.values.iter().enumerate() {
        if let Some(end) = ruler.pixel(value) {
            let (low, high) = (start.min(end), start.max(end).max(start.min(end) + 2));
            fill(canvas, (low, y), (high, y + BAR), index)?;
        }
        y += BAR;
    }
    style::text(canvas, &group.note, (start + 12, middle), SMALL, Anchor::Start)
}

fn fill(
    canvas: &Canvas<'_>,
    (x0, y0): (i32, i32),
    (x1, y1): (i32, i32),
    index: usize,
) -> Result<()> {
    let corners = vec![(x0, y0), (x1, y0), (x1, y1), (x0, y1)];
    canvas.draw(&Polygon::new(corners, style::color(index))).map_err(style::drawing_error)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn a_missing_value_has_no_bar_and_its_note_is_shown() {
        let group = |label: &str, values: &[f64], note: &str| BarGroup {
            label: label.to_owned(),
            values: values.to_vec(),
            note: note.to_owned(),
        };
        let figure = BarFigure {
            title: "title".to_owned(),
            axis: "ratio".to_owned(),
            series: vec!["a".to_owned(), "b".to_owned()],
            groups: vec![
                group("first", &[2.0, 0.5], ""),
                group("second", &[f64::NAN, 3.0], "burst"),
            ],
            reference: 1.0,
        };
        let text = svg(&figure).unwrap();
        // Two keys and three bars.
        assert_eq!(text.matches("<polygon").count(), 5);
        assert!(text.contains("burst"));
    }
}
