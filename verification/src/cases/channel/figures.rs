//! Pressures, masses, energies and surfaces.

use super::march::{INSTANTS, picture};
use super::measure::SURFACES;
use super::outside;
use super::results::{find, value};
use crate::case::Profile;
use crate::cases::series::running_mean;
use crate::record::RunRecord;
use crate::reference::channel::{VofSpacing, VofTotal, WaterColumn};
use crate::report::axis::Axis;
use crate::report::map::{Key, MapFigure, MapPanel, Overlay};
use crate::report::plot::{Curve, Figure, Look, Panel};
use crate::report::{Area, Artifact, Content};

/// Colours of the two volume-of-fluid runs.
const VOF: [usize; 2] = [7, 2];
/// Colour of the surface in maps: red, which no cell has.
const OUTLINE: usize = 0;
/// Markers along a curve.
const MARKERS: usize = 10;

/// Width of the running mean of depths, m.
const SMOOTH: f64 = 0.1;

/// A curve of a group: variant, run, label and colour.
type Shown = (&'static str, &'static str, &'static str, usize);

/// A measure of a column of water.
type OfColumn = fn(&WaterColumn) -> f64;

/// Groups of runs at 0.4 m/s: TPM by supply and end, and every method.
const GROUPS: [(&str, &[Shown]); 2] = [
    (
        "tpm-vp2",
        &[
            ("tpm-vp2", "columns", "columns", 0),
            ("tpm-vp2", "flux", "flux", 1),
            ("tpm-vp2", "flux-outflow", "outflow", 8),
            ("tpm-vp2", "flux-damped", "flux, damped", 5),
        ],
    ),
    (
        "flux",
        &[
            ("tpm-vp2", "flux", "tpm-vp2", 1),
            ("tpm-vp0", "flux", "tpm-vp0", 6),
            ("mpm-vp", "flux", "mpm-vp", 3),
            ("gimp-vp", "flux", "gimp-vp", 4),
            ("apic", "flux", "apic", 0),
        ],
    ),
];
/// Inlets, with those of the volume-of-fluid runs.
const LAYOUTS: [(&str, &str, bool); 3] = [
    ("100mm", "h_in = 100 mm", true),
    ("50mm", "h_in = 50 mm", false),
    ("coarse", "cells of 50 mm", true),
];
const SPEEDS: [(&str, usize); 4] = [("0.2", 0), ("0.4", 1), ("0.6", 3), ("0.8", 4)];

/// Maps of the pressure of the runs that are shown.
pub(super) fn pressures(records: &[RunRecord]) -> Vec<Artifact> {
    let shown = [
        ("fig20_channel", "TPM, columns (Fig. 20)", "tpm-vp2", "columns", "100mm"),
        ("fig20_channel_flux", "TPM, flux", "tpm-vp2", "flux", "100mm"),
        ("fig20_channel_gimp", "uGIMP", "gimp-vp", "flux", "100mm"),
        ("fig20_channel_50mm", "TPM, h_in = 50 mm", "tpm-vp2", "columns", "50mm"),
        ("channel_coarse", "TPM on cells of 50 mm", "tpm-vp2", "columns", "coarse"),
    ];
    let mut artifacts = Vec::new();
    for (stem, title, variant, run, layout) in shown {
        let Some(record) = find(records, variant, layout, run, "0.4") else { continue };
        let maps = map(record, title);
        if !maps.panels.is_empty() {
            artifacts.push(Artifact {
                stem: stem.to_owned(),
                title: format!("Pressure in the channel: {title}"),
                area: Area::Accuracy,
                content: Content::Maps(maps),
            });
        }
    }
    artifacts
}

fn map(record: &RunRecord, title: &str) -> MapFigure {
    let panel = |instant: f64| {
        let raster = record.raster(&picture("pressure", instant))?.clone();
        let columns = outside::surface(VofSpacing::Millimeters5, instant);
        let line = columns.iter().map(|column| [column.x, column.top]).collect();
        let is_beside = record.spec.layout != "50mm" && !columns.is_empty();
        let overlay = Overlay { label: "VOF 5 mm".to_owned(), style: OUTLINE, lines: vec![line] };
        Some(MapPanel {
            title: format!("pressure, t = {instant} s"),
            raster,
            key: Key::Field { label: "p, Pa".to_owned() },
            overlays: if is_beside { vec![overlay] } else { Vec::new() },
        })
    };
    MapFigure {
        title: format!("Channel: {title}"),
        panels: INSTANTS.into_iter().filter_map(panel).collect(),
        columns: 1,
    }
}

/// Mass over time, by the points and on the nodes (Fig. 21a).
pub(super) fn masses(records: &[RunRecord]) -> Figure {
    let shown = [
        ("mass", "mass of the points, kg", VofTotal::Mass),
        ("grid-mass", "mass on the nodes, kg", VofTotal::Mass),
    ];
    over_time(records, "Mass in the channel, v₀ = 0.4 m/s (Fig. 21a)", shown)
}

/// Kinetic and potential energy over time.
pub(super) fn energy(records: &[RunRecord]) -> Figure {
    let shown = [
        ("kinetic", "kinetic energy, J", VofTotal::KineticEnergy),
        ("potential", "potential energy, J", VofTotal::PotentialEnergy),
    ];
    over_time(records, "Energy of the water in the channel, v₀ = 0.4 m/s", shown)
}

fn over_time(records: &[RunRecord], title: &str, shown: [(&str, &str, VofTotal); 2]) -> Figure {
    let mut panels = Vec::new();
    for (layout, inlet, is_that_of_vof) in LAYOUTS {
        for (group, runs) in GROUPS {
            for (name, label, quantity) in shown {
                let mut curves = own(records, layout, runs, name);
                // One run alone stands in the other group.
                if curves.is_empty() || (group == "flux" && curves.len() < 2) {
                    continue;
                }
                for ((spacing, run), style) in outside::RUNS.into_iter().zip(VOF) {
                    if is_that_of_vof {
                        curves.push(line(run, style, outside::curve(spacing, quantity)));
                    }
                }
                panels.push(panel(&format!("{inlet}, {group}"), label, curves));
            }
        }
    }
    Figure { title: title.to_owned(), panels, columns: 2 }
}

/// Mass until the front reaches the end, for every speed (Fig. 21b).
pub(super) fn inflow(records: &[RunRecord]) -> Figure {
    let mut panels = Vec::new();
    for run in ["columns", "flux"] {
        let mut curves = Vec::new();
        let mut lines = Vec::new();
        for (speed, style) in SPEEDS {
            let Some(record) = find(records, "tpm-vp2", "100mm", run, speed) else { continue };
            let until = value(record, "front", "outlet");
            let mut points = pairs(record, "grid-mass");
            points.retain(|point| point.0 <= until);
            let flux = 100.0 * speed.parse::<f64>().unwrap_or(f64::NAN);
            // With two columns the first cells behind the plane are full at the start.
            let start = pairs(record, "mass").first().map_or(f64::NAN, |point| point.1);
            lines.extend([0.0, until].map(|time| (time, start + flux * time)));
            lines.push((until, f64::NAN));
            let label = format!("v₀ = {speed} m/s");
            curves.push(Curve { label, style, points, look: Look::Sparse(MARKERS) });
        }
        if !curves.is_empty() {
            curves.push(line("ρ v₀ h_in t", VOF[1], lines));
            panels.push(panel(&format!("tpm-vp2, {run}"), "mass on the nodes, kg", curves));
        }
    }
    let title = "Mass before it flows out, h_in = 100 mm (Fig. 21b)".to_owned();
    Figure { title, panels, columns: 2 }
}

/// Depth and highest water along the channel.
pub(super) fn surface(records: &[RunRecord]) -> Figure {
    let mut panels = Vec::new();
    let depth = |column: &WaterColumn| column.depth;
    let top = |column: &WaterColumn| column.top;
    let shown: [(&str, &str, OfColumn); 2] =
        [("depth", "depth, m", depth), ("top", "highest water, m", top)];
    for (layout, inlet, is_that_of_vof) in LAYOUTS {
        for (instant, (group, runs)) in
            SURFACES.into_iter().flat_map(|instant| GROUPS.map(|group| (instant, group)))
        {
            for (name, label, of) in shown {
                let mut curves = own(records, layout, runs, &picture(name, instant));
                // One run alone stands in the other group.
                if curves.is_empty() || (group == "flux" && curves.len() < 2) {
                    continue;
                }
                for curve in &mut curves {
                    curve.points = running_mean(&curve.points, SMOOTH);
                }
                for ((spacing, run), style) in outside::RUNS.into_iter().zip(VOF) {
                    let columns = outside::surface(spacing, instant);
                    let points = columns.iter().map(|column| (column.x, of(column))).collect();
                    if is_that_of_vof {
                        curves.push(line(run, style, points));
                    }
                }
                let title = format!("{inlet}, {group}, t = {instant} s");
                panels.push(Panel { x: Axis::linear("x, m"), ..panel(&title, label, curves) });
            }
        }
    }
    let title = "Surface of the water, v₀ = 0.4 m/s; points: mean over 0.1 m".to_owned();
    Figure { title, panels, columns: 2 }
}

fn pairs(record: &RunRecord, name: &str) -> Vec<(f64, f64)> {
    record.profile(name).map(Profile::pairs).unwrap_or_default()
}

/// A profile of every run of a group at 0.4 m/s.
fn own(records: &[RunRecord], layout: &str, runs: &[Shown], name: &str) -> Vec<Curve> {
    let of_run = |&(variant, run, label, style): &Shown| {
        let points = pairs(find(records, variant, layout, run, "0.4")?, name);
        let label = label.to_owned();
        (!points.is_empty()).then_some(Curve { label, style, points, look: Look::Sparse(MARKERS) })
    };
    runs.iter().filter_map(of_run).collect()
}

fn line(label: &str, style: usize, points: Vec<(f64, f64)>) -> Curve {
    Curve { label: label.to_owned(), style, points, look: Look::Line }
}

fn panel(title: &str, ordinate: &str, curves: Vec<Curve>) -> Panel {
    Panel {
        title: title.to_owned(),
        x: Axis::linear("t, s"),
        y: Axis::linear(ordinate),
        legend: "run".to_owned(),
        curves,
        slopes: Vec::new(),
    }
}
