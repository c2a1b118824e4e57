//! Forces over T, and maps of the vorticity and of the pressure at the end.

use super::measure::{SMOOTH, running_mean};
use super::policy::Body;
use super::scene::DIAMETER;
use crate::record::RunRecord;
use crate::reference::cylinder::{Quantity, band};
use crate::report::axis::Axis;
use crate::report::map::{Key, MapFigure, MapPanel};
use crate::report::plot::{Curve, Figure, Look, Panel};

/// Colours of runs in the order of records, and of the published bounds.
const COLORS: [usize; 5] = [0, 1, 3, 6, 4];
const BOUNDS: usize = 2;
const MARKERS: usize = 10;
/// Force coefficients beyond are those of the start or of a run that is about to blow up.
const MOST: f64 = 10.0;

/// Flows, in the order of rows: layout, title, and the bounds of drag and lift.
const FLOWS: [(&str, &str, Option<[Quantity; 2]>); 3] = [
    ("shedding-re100", "Re = 100", Some([Quantity::LargestDrag, Quantity::LargestLift])),
    ("steady-re20", "Re = 20", Some([Quantity::SteadyDrag, Quantity::SteadyLift])),
    ("small-re20", "Re = 20, small", None),
];

/// Drag on the left, lift on the right.
pub(super) fn forces(records: &[RunRecord]) -> Figure {
    let mut panels = Vec::new();
    for (layout, title, bounds) in FLOWS {
        let runs: Vec<&RunRecord> =
            records.iter().filter(|record| record.spec.layout == layout).collect();
        if runs.is_empty() {
            continue;
        }
        for (axis, (name, ordinate)) in [("drag", "C_D"), ("lift", "C_L")].into_iter().enumerate() {
            let mut curves: Vec<Curve> = runs
                .iter()
                .zip(COLORS)
                .filter_map(|(run, style)| curve(run, name, style))
                .collect();
            let end = curves.iter().filter_map(|curve| curve.points.last()).map(|point| point.0);
            let end = end.fold(0.0, f64::max);
            let given = bounds.and_then(|bounds| band(bounds[axis]).ok());
            curves.extend(given.into_iter().flatten().enumerate().map(|(side, bound)| Curve {
                label: if side == 0 { "lower bound" } else { "upper bound" }.to_owned(),
                style: BOUNDS,
                points: vec![(0.0, bound), (end, bound)],
                look: Look::Line,
            }));
            let what = match (layout, axis) {
                ("shedding-re100", 0) => "drag, bounds of its maxima",
                ("shedding-re100", _) => "lift, bounds of its maxima",
                (_, 0) => "drag",
                _ => "lift",
            };
            panels.push(Panel {
                title: format!("{title}: {what}"),
                x: Axis::linear("T = t U/D"),
                y: Axis::linear(format!("{ordinate}, mean over {SMOOTH} T")),
                legend: "cells per D".to_owned(),
                curves,
                slopes: Vec::new(),
            });
        }
    }
    Figure { title: "Forces on the cylinder".to_owned(), panels, columns: 2 }
}

fn curve(record: &RunRecord, name: &str, style: usize) -> Option<Curve> {
    let smooth = running_mean(&record.profile(name)?.pairs(), SMOOTH);
    let shown =
        |&(time, value): &(f64, f64)| (time, if value.abs() <= MOST { value } else { f64::NAN });
    let (spec, plain) = (&record.spec, Body::Plain.name());
    let body = if spec.label("body") == plain { " plain" } else { "" };
    let label = format!("{} {:.0}{body}", spec.variant, DIAMETER / spec.spacing);
    let points = smooth.iter().map(shown).collect();
    Some(Curve { label, style, points, look: Look::Sparse(MARKERS) })
}

/// Stem, title and maps of a run that has them.
pub(super) fn maps(record: &RunRecord) -> Option<(String, String, MapFigure)> {
    let labels = [("vorticity", "ω D/U"), ("pressure", "p/(ρ₀ U²)")];
    let panels: Vec<MapPanel> = labels
        .into_iter()
        .filter_map(|(name, label)| {
            Some(MapPanel {
                title: name.to_owned(),
                raster: record.raster(name)?.clone(),
                key: Key::Field { label: label.to_owned() },
                overlays: Vec::new(),
            })
        })
        .collect();
    let spec = &record.spec;
    let title = format!(
        "{}, {}, {} body, {:.0} cells per D, at the end",
        spec.layout,
        spec.variant,
        spec.label("body"),
        DIAMETER / spec.spacing
    );
    let body = spec.label("body");
    let stem = format!("cylinder_{}_{}_{body}_level{}", spec.layout, spec.variant, spec.level);
    let maps = MapFigure { title: title.clone(), panels, columns: 1 };
    (!maps.panels.is_empty()).then_some((stem, title, maps))
}
