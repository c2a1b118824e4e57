//! Pressure on the plate, errors over cell size, force over time, and pictures.

use super::results::{find, orders};
use super::runs::{CELLS, VARIANTS};
use super::scene::JET;
use crate::case::Profile;
use crate::cases::series::running_mean;
use crate::convergence::series;
use crate::number;
use crate::record::RunRecord;
use crate::report::axis::Axis;
use crate::report::map::{Key, MapFigure, MapPanel, Overlay};
use crate::report::plot::{Curve, Figure, Look, Panel};

/// Colour of what is exact: black.
const EXACT: usize = 2;
/// Intervals of the exact profile, and its reach, b.
const SAMPLES: usize = 400;
const REACH: f64 = 3.0;
/// Markers along a curve.
const MARKERS: usize = 12;
/// Width of the running mean that is shown, T.
const SHOWN: f64 = 0.2;

/// Runs of the same flow: layout and what a reader calls it.
const LAYOUTS: [(&str, &str); 8] = [
    ("half", "tpm-vp2"),
    ("columns", "two columns"),
    ("shift", "pushed apart"),
    ("unfilled", "not filled"),
    ("blow", "start with a blow"),
    ("whole", "whole jet"),
    ("near", "inlet at 1.5 b"),
    ("far", "inlet at 4.5 b"),
];

/// A colour per curve, black left out.
fn color(index: usize) -> usize {
    if index < EXACT { index } else { index + 1 }
}

/// A run and its label.
type Shown<'a> = (&'a RunRecord, String, usize);

/// The methods on the same layout, and the layouts of the same method.
fn groups(records: &[RunRecord], level: usize) -> [(&'static str, Vec<Shown<'_>>); 2] {
    let methods = VARIANTS.iter().enumerate().filter_map(|(index, variant)| {
        let record = find(records, variant.name(), "half", level)?;
        Some((record, variant.name().to_owned(), color(index)))
    });
    let layouts = LAYOUTS.iter().enumerate().filter_map(|(index, (layout, label))| {
        let record = find(records, "tpm-vp2", layout, level)?;
        Some((record, (*label).to_owned(), color(index)))
    });
    [("methods", methods.collect()), ("tpm-vp2", layouts.collect())]
}

fn levels(records: &[RunRecord]) -> impl Iterator<Item = usize> + '_ {
    (0..CELLS.len()).filter(|&level| records.iter().any(|record| record.spec.level == level))
}

/// Mean pressure on the plate, one row of panels per level.
pub(super) fn pressure(records: &[RunRecord]) -> Figure {
    let mut panels = Vec::new();
    for level in levels(records) {
        for (name, group) in groups(records, level) {
            let exact = (0..=SAMPLES).map(|k| {
                let x = REACH * k as f64 / SAMPLES as f64;
                (x, JET.pressure(x * JET.width) / JET.stagnation_pressure())
            });
            let exact = Curve {
                label: "exact".to_owned(),
                style: EXACT,
                points: exact.collect(),
                look: Look::Line,
            };
            let curve = |(record, label, style): Shown<'_>| {
                let mut points = pairs(record, "wall-pressure");
                points.retain(|point| (0.0..REACH).contains(&point.0));
                Curve { label, style, points, look: Look::Sparse(MARKERS) }
            };
            panels.push(Panel {
                title: format!("{name}, {} cells across the jet", CELLS[level]),
                x: Axis::linear("distance from the axis x/b"),
                y: Axis::linear("mean pressure on the plate p/(½ ρ U²)"),
                legend: "run".to_owned(),
                curves: std::iter::once(exact).chain(group.into_iter().map(curve)).collect(),
                slopes: Vec::new(),
            });
        }
    }
    Figure { title: "Jet on a plate: pressure".to_owned(), panels, columns: 2 }
}

/// Errors of the pressure and of the force over cell size.
pub(super) fn convergence(records: &[RunRecord]) -> Figure {
    let all = series(records);
    let orders = orders(records);
    let mut panels = Vec::new();
    for (quantity, norm, label) in [
        ("wall-pressure", "relative-l2", "L2 error of the wall pressure, relative"),
        ("force", "error", "error of the force |F/(ρ U² b) − 1|"),
    ] {
        let methods = VARIANTS.iter().map(|variant| (variant.name(), "half", variant.name()));
        let layouts = LAYOUTS[1..4].iter().map(|&(layout, label)| ("tpm-vp2", layout, label));
        let shown = methods.chain(layouts).enumerate();
        let curves = shown.filter_map(|(index, (variant, layout, label))| {
            let series = all.iter().find(|series| {
                (series.variant == variant && series.layout == layout)
                    && (series.quantity == quantity && series.norm == norm)
            })?;
            let order = orders.iter().find(|order| {
                (order.variant == variant && order.layout == layout) && order.quantity == quantity
            });
            let order = number::order(order.map_or(f64::NAN, |order| order.order));
            Some(Curve {
                label: format!("{label} ({order})"),
                style: color(index),
                points: series.points.clone(),
                look: Look::Marked,
            })
        });
        panels.push(Panel {
            title: "means over 6 < T < 12".to_owned(),
            x: Axis::log("cell size h, m").with_ticks([0.003_125, 0.006_25, 0.012_5, 0.025]),
            y: Axis::log(label),
            legend: "run (order)".to_owned(),
            curves: curves.collect(),
            slopes: vec![1.0, 2.0],
        });
    }
    Figure { title: "Jet on a plate: errors".to_owned(), panels, columns: 2 }
}

/// Running means of the force on the plate, one row of panels per level.
pub(super) fn force(records: &[RunRecord]) -> Figure {
    let mut panels = Vec::new();
    for level in levels(records) {
        for (name, group) in groups(records, level) {
            let curve = |(record, label, style): Shown<'_>| {
                let points = running_mean(&pairs(record, "force"), SHOWN);
                // The blow at the start is far out of the range of the rest.
                let points = points.into_iter().filter(|point| point.0 > 1.0).collect();
                Curve { label, style, points, look: Look::Sparse(MARKERS) }
            };
            panels.push(Panel {
                title: format!("{name}, {} cells across the jet", CELLS[level]),
                x: Axis::linear("T = t U/b"),
                y: Axis::linear("force on the plate F/(ρ U² b)"),
                legend: "run".to_owned(),
                curves: group.into_iter().map(curve).collect(),
                slopes: Vec::new(),
            });
        }
    }
    let title = format!("Jet on a plate: running means of the force over {SHOWN} T");
    Figure { title, panels, columns: 2 }
}

fn pairs(record: &RunRecord, name: &str) -> Vec<(f64, f64)> {
    record.profile(name).map(Profile::pairs).unwrap_or_default()
}

/// Pictures of the pressure at the end, with the exact free surface.
pub(super) fn maps(records: &[RunRecord]) -> MapFigure {
    // The level at which most runs are.
    let level = levels(records).find(|&level| level == 1).or(levels(records).max()).unwrap_or(0);
    let [(_, methods), (_, layouts)] = groups(records, level);
    let others = layouts.into_iter().filter(|(record, ..)| record.spec.layout != "half");
    let mut panels = Vec::new();
    for (record, label, _) in methods.into_iter().chain(others) {
        let Some(raster) = record.raster("pressure") else { continue };
        panels.push(MapPanel {
            title: label,
            raster: raster.clone(),
            key: Key::Field { label: "p/(½ ρ U²)".to_owned() },
            overlays: vec![surface(raster.origin[0] < 0.0)],
        });
    }
    let title = format!("Jet on a plate: pressure at the end, {} cells across", CELLS[level]);
    MapFigure { title, panels, columns: 2 }
}

/// The exact free surface.
fn surface(whole: bool) -> Overlay {
    let right = (1..SAMPLES).map(|k| {
        // Angles crowd where the surface is almost straight.
        let s = k as f64 / SAMPLES as f64;
        let alpha = 0.5 * std::f64::consts::PI * s * s * s * (10.0 - 15.0 * s + 6.0 * s * s);
        JET.surface(alpha)
    });
    let right: Vec<[f64; 2]> = right.collect();
    let left = right.iter().map(|[x, y]| [-x, *y]).collect();
    let lines = if whole { vec![right, left] } else { vec![right] };
    Overlay { label: "exact surface".to_owned(), style: 0, lines }
}
