//! Depth along the stream, depth at the brink over time, and pictures.

use super::results::RATIO;
use super::runs::{CELLS, VARIANTS};
use super::scene::LENGTH;
use crate::case::Profile;
use crate::cases::series::running_mean;
use crate::record::RunRecord;
use crate::report::axis::Axis;
use crate::report::map::{Key, MapFigure, MapPanel};
use crate::report::plot::{Curve, Figure, Look, Panel};

/// Colours of the critical depth and of the measured ratio: grey and black.
const CRITICAL: usize = 7;
const REFERENCE: usize = 2;
/// Markers along a curve.
const MARKERS: usize = 12;
/// Width of the running mean that is shown, T.
const SHOWN: f64 = 0.5;
/// How far beyond the brink profiles are shown, y_c.
const BEYOND: f64 = 1.5;

/// A colour per curve, black left out.
fn color(index: usize) -> usize {
    if index < REFERENCE { index } else { index + 1 }
}

/// A run, its label and its colour.
type Shown<'a> = (&'a RunRecord, String, usize);

/// The methods on a critical inflow at each level, and the inflows of one method.
fn groups(records: &[RunRecord]) -> Vec<(String, Vec<Shown<'_>>)> {
    let mut groups: Vec<(String, Vec<Shown<'_>>)> = Vec::new();
    for (level, cells) in CELLS.iter().enumerate() {
        let shown = VARIANTS.iter().enumerate().filter_map(|(index, variant)| {
            let record = records.iter().find(|record| {
                let spec = &record.spec;
                (spec.variant == variant.name() && spec.layout == "fr1.00") && spec.level == level
            })?;
            Some((record, variant.name().to_owned(), color(index)))
        });
        groups.push((format!("critical inflow, {cells} cells per y_c"), shown.collect()));
    }
    let inflows = ["fr1.00", "fr0.72", "fr0.54"].into_iter().enumerate();
    let shown = inflows.filter_map(|(index, layout)| {
        let record = records.iter().find(|record| {
            let spec = &record.spec;
            (spec.variant == "tpm-vp2" && spec.layout == layout) && spec.level == 0
        })?;
        Some((record, layout.replace("fr", "Fr = "), color(index)))
    });
    groups.push((format!("tpm-vp2, {} cells per y_c", CELLS[0]), shown.collect()));
    groups.retain(|(_, shown)| !shown.is_empty());
    groups
}

fn pairs(record: &RunRecord, name: &str) -> Vec<(f64, f64)> {
    record.profile(name).map(Profile::pairs).unwrap_or_default()
}

fn line(label: &str, style: usize, points: Vec<(f64, f64)>, look: Look) -> Curve {
    Curve { label: label.to_owned(), style, points, look }
}

/// Mean depth along the stream.
pub(super) fn surface(records: &[RunRecord]) -> Figure {
    let mut panels = Vec::new();
    for (title, shown) in groups(records) {
        let start = -(LENGTH as f64);
        let mut curves = vec![
            line("Rouse, 0.715", REFERENCE, vec![(0.0, RATIO)], Look::Dots),
            line("y_c", CRITICAL, vec![(start, 1.0), (BEYOND, 1.0)], Look::Line),
        ];
        curves.extend(shown.into_iter().map(|(record, label, style)| {
            let mut points = pairs(record, "depth");
            points.retain(|point| point.0 > start && point.0 < BEYOND);
            Curve { label, style, points, look: Look::Sparse(MARKERS) }
        }));
        panels.push(Panel {
            title,
            x: Axis::linear("distance from the brink x/y_c"),
            y: Axis::linear("mean depth y/y_c"),
            legend: "run".to_owned(),
            curves,
            slopes: Vec::new(),
        });
    }
    Figure { title: "Free overfall: depth of the stream".to_owned(), panels, columns: 2 }
}

/// Running means of the depth at the brink.
pub(super) fn ratio(records: &[RunRecord]) -> Figure {
    let mut panels = Vec::new();
    for (title, shown) in groups(records) {
        let histories: Vec<_> = shown
            .into_iter()
            .map(|(record, label, style)| Curve {
                label,
                style,
                points: running_mean(&pairs(record, "brink-depth"), SHOWN),
                look: Look::Sparse(MARKERS),
            })
            .collect();
        let ends = histories.iter().filter_map(|curve| curve.points.last());
        let end = ends.map(|point| point.0).reduce(f64::max).unwrap_or(1.0);
        let mut curves =
            vec![line("Rouse, 0.715", REFERENCE, vec![(0.0, RATIO), (end, RATIO)], Look::Line)];
        curves.extend(histories);
        panels.push(Panel {
            title,
            x: Axis::linear("T = t √(g/y_c)"),
            y: Axis::linear("depth at the brink y/y_c"),
            legend: "run".to_owned(),
            curves,
            slopes: Vec::new(),
        });
    }
    let title = format!("Free overfall: running means of the depth at the brink over {SHOWN} T");
    Figure { title, panels, columns: 2 }
}

/// Pictures of the pressure at the end, of the finest run of every method and of every inflow.
pub(super) fn maps(records: &[RunRecord]) -> MapFigure {
    let mut shown: Vec<(&RunRecord, String)> = Vec::new();
    for (title, group) in groups(records) {
        for (record, label, _) in group {
            let title = format!("{label}: {title}");
            if !shown.iter().any(|(other, _)| other.spec == record.spec) {
                shown.push((record, title));
            }
        }
    }
    let panel = |(record, title): (&RunRecord, String)| {
        Some(MapPanel {
            title,
            raster: record.raster("pressure")?.clone(),
            key: Key::Field { label: "p/(ρ₀ g y_c)".to_owned() },
            overlays: Vec::new(),
        })
    };
    MapFigure {
        title: "Free overfall: mean pressure of the points of each cell at the end".to_owned(),
        panels: shown.into_iter().filter_map(panel).collect(),
        columns: 2,
    }
}
