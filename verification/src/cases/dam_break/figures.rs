//! Curves over T: the probe, the energies, the number of points, front and heights.

use super::measure::SMOOTH;
use super::outside;
use super::policy::Difference;
use crate::case::Profile;
use crate::cases::series::running_mean;
use crate::number::significant;
use crate::record::RunRecord;
use crate::report::axis::Axis;
use crate::report::plot::{Curve, Figure, Look, Panel};
use crate::report::table::{Cell, Table};

/// Colours of the experiment and of the two volume-of-fluid runs; no method has them.
const EXPERIMENT: usize = 2;
const VOF: [usize; 2] = [7, 8];
/// Markers along a curve.
const MARKERS: usize = 10;
/// T between the values shown.
const INTERVAL: f64 = 0.01;
/// Values beyond are those of a run that is about to blow up.
const MOST: f64 = 4.0;

/// Curves of one row of panels: title, layout, and runs with their colours.
type Group = (&'static str, &'static str, &'static [(&'static str, Difference, usize)]);

/// What is done to the values of a curve.
type Change<'a> = &'a dyn Fn(Vec<(f64, f64)>) -> Vec<(f64, f64)>;

/// Groups of runs, in the order of rows.
const GROUPS: [Group; 3] = [
    (
        "28,800 points",
        "dense",
        &[
            ("tpm-vp2", Difference::None, 0),
            ("tpm-vp0", Difference::None, 6),
            ("gimp-vp", Difference::ModifiedLast, 3),
            ("gimp-vp", Difference::None, 4),
            ("tpm", Difference::Printed, 5),
        ],
    ),
    (
        "1,800 points, TPM",
        "coarse",
        &[
            ("tpm-vp2", Difference::None, 6),
            ("tpm-vp2", Difference::Fill, 0),
            ("tpm-vp2", Difference::FillReduce, 3),
        ],
    ),
    (
        "1,800 points, MPM",
        "coarse",
        &[
            ("mpm-vp", Difference::None, 5),
            ("mpm-vp", Difference::ModifiedLast, 1),
            ("mpm-vp", Difference::SplitVolume, 4),
            ("mpm-vp", Difference::SplitStretch, 6),
        ],
    ),
];

/// The same for runs of other tiers.
const OTHERS: [Group; 2] = [
    (
        "cells of 60 mm",
        "small",
        &[("tpm-vp2", Difference::None, 0), ("gimp-vp", Difference::ModifiedLast, 3)],
    ),
    ("three dimensions", "tank-3d", &[("tpm-vp2", Difference::None, 0)]),
];

fn groups(records: &[RunRecord]) -> impl Iterator<Item = &'static Group> {
    let layouts: Vec<String> = records.iter().map(|record| record.spec.layout.clone()).collect();
    GROUPS.iter().chain(&OTHERS).filter(move |group| layouts.iter().any(|name| *name == group.1))
}

/// Pressures on the wall: running means, the experiment and the volume-of-fluid runs.
pub(super) fn probe(records: &[RunRecord]) -> Figure {
    let mut panels = Vec::new();
    for group in groups(records) {
        for (place, title) in
            [("160mm", "160 mm"), ("120mm", "120 mm"), ("disc", "disc of 90 mm at 160 mm")]
        {
            let measured = Curve {
                label: if place == "disc" { "experiment" } else { "experiment, disc" }.to_owned(),
                style: EXPERIMENT,
                points: outside::experiment(),
                look: Look::Dots,
            };
            let smooth = |points: Vec<(f64, f64)>| running_mean(&points, SMOOTH);
            let mut curves = vec![measured];
            curves.extend(own(records, group, place, &smooth));
            curves.extend(others(place, &smooth));
            panels.push(panel(format!("{title}: {}", group.0), "P, mean over 0.05 T", curves));
        }
    }
    Figure { title: "Pressure on the far wall (Fig. 13)".to_owned(), panels, columns: 3 }
}

/// Energies over the total at the start.
pub(super) fn energy(records: &[RunRecord]) -> Figure {
    let mut panels = Vec::new();
    let parts: [(&str, &[&str]); 3] = [
        ("kinetic", &["kinetic"]),
        ("potential", &["potential"]),
        ("total", &["kinetic", "potential", "compression"]),
    ];
    for group in groups(records) {
        for (name, columns) in parts {
            let mut curves: Vec<Curve> = group
                .2
                .iter()
                .filter_map(|run| {
                    let record = find(records, group.1, run)?;
                    let start: f64 = sum(record, parts[2].1).first()?.1;
                    let points = sum(record, columns).into_iter().map(|(t, e)| (t, e / start));
                    Some(curve(run, points.collect()))
                })
                .collect();
            for ((spacing, label), style) in outside::RUNS.into_iter().zip(VOF) {
                let parts: Vec<_> =
                    columns.iter().map(|column| outside::curve(spacing, column)).collect();
                let start: f64 = outside::curve(spacing, "potential").first().map_or(1.0, |p| p.1);
                let value = |index: usize| {
                    parts.iter().filter_map(|part| part.get(index)).map(|p| p.1).sum::<f64>()
                };
                let times = parts[0].iter().enumerate();
                let points = times.map(|(index, point)| (point.0, value(index) / start)).collect();
                curves.push(line(label, style, points));
            }
            panels.push(panel(format!("{name} energy: {}", group.0), "E / E at the start", curves));
        }
    }
    Figure { title: "Energies of the water".to_owned(), panels, columns: 3 }
}

/// Front and heights beside the volume-of-fluid runs.
pub(super) fn heights(records: &[RunRecord]) -> Figure {
    let shown = [
        ("front", "front, m"),
        ("run-up", "highest point at the far wall, m"),
        ("depth2228", "depth at x = 2.228 m, m"),
        ("depth2725", "depth at x = 2.725 m, m"),
    ];
    let mut panels = Vec::new();
    for group in groups(records) {
        for (name, label) in shown {
            let mut curves = own(records, group, name, &|points| points);
            curves.extend(others(name, &|points| points));
            panels.push(panel(group.0.to_owned(), label, curves));
        }
    }
    Figure { title: "Front and heights of the water".to_owned(), panels, columns: 4 }
}

/// Number of points and fractures of the coarse runs.
pub(super) fn points(records: &[RunRecord]) -> Figure {
    let mut panels = Vec::new();
    for group in GROUPS.iter().filter(|group| group.1 == "coarse") {
        for (name, label) in [("points", "number of points"), ("fractures", "numerical fractures")]
        {
            let curves = own(records, group, name, &|points| points);
            panels.push(panel(group.0.to_owned(), label, curves));
        }
    }
    Figure { title: "Points and fractures (Fig. 17)".to_owned(), panels, columns: 2 }
}

/// The samples of the pressure at Q and its surroundings, without running means.
pub(super) fn samples(records: &[RunRecord], place: &str) -> Table {
    let mut columns = vec!["run".to_owned(), "T".to_owned(), "P".to_owned()];
    columns[2] = format!("P {place}");
    let mut rows = Vec::new();
    for record in records.iter().filter(|record| record.spec.layout != "slab") {
        let spec = &record.spec;
        let name = format!("{} {} {}", spec.layout, spec.variant, spec.label("run"));
        let points = record.profile(place).map(Profile::pairs).unwrap_or_default();
        rows.extend(points.into_iter().map(|(time, value)| {
            vec![Cell::Text(name.clone()), Cell::Text(significant(time)), Cell::Value(value)]
        }));
    }
    Table { columns, rows, note: "Raw samples of P on the far wall.".to_owned() }
}

fn find<'a>(
    records: &'a [RunRecord],
    layout: &str,
    run: &(&str, Difference, usize),
) -> Option<&'a RunRecord> {
    super::results::find(records, run.0, layout, run.1)
}

fn own(records: &[RunRecord], group: &Group, name: &str, change: Change<'_>) -> Vec<Curve> {
    let of_run = |run| {
        let profile = find(records, group.1, run)?.profile(name)?;
        Some(curve(run, change(profile.pairs())))
    };
    group.2.iter().filter_map(of_run).collect()
}

fn others(name: &str, change: Change<'_>) -> Vec<Curve> {
    let of_run =
        |((spacing, label), style)| line(label, style, change(outside::curve(spacing, name)));
    outside::RUNS.into_iter().zip(VOF).map(of_run).collect()
}

fn curve(run: &(&str, Difference, usize), points: Vec<(f64, f64)>) -> Curve {
    let label = match run.1 {
        Difference::None => run.0.to_owned(),
        // The title names the method; both do not fit.
        Difference::FillReduce | Difference::SplitVolume | Difference::SplitStretch => {
            run.1.name().to_owned()
        }
        difference => format!("{} {}", run.0, difference.name()),
    };
    Curve { label, style: run.2, points: thinned(points), look: Look::Sparse(MARKERS) }
}

fn line(label: &str, style: usize, points: Vec<(f64, f64)>) -> Curve {
    Curve { label: label.to_owned(), style, points: thinned(points), look: Look::Line }
}

/// A value every [`INTERVAL`], and a gap for what is out of all bounds.
fn thinned(points: Vec<(f64, f64)>) -> Vec<(f64, f64)> {
    let mut next = f64::NEG_INFINITY;
    let mut kept = Vec::new();
    for (time, value) in points {
        if time >= next {
            next = time + INTERVAL - 1e-9;
            kept.push((time, value));
        }
    }
    kept
}

fn panel(title: String, ordinate: &str, mut curves: Vec<Curve>) -> Panel {
    if ordinate.starts_with('P') || ordinate.starts_with('E') {
        for point in curves.iter_mut().flat_map(|curve| &mut curve.points) {
            if point.1.abs() > MOST {
                point.1 = f64::NAN;
            }
        }
    }
    Panel {
        title,
        x: Axis::linear("T = t √(h₀ g)/l₀"),
        y: Axis::linear(ordinate),
        legend: "run".to_owned(),
        curves,
        slopes: Vec::new(),
    }
}

/// Sum of profiles of a run.
fn sum(record: &RunRecord, names: &[&str]) -> Vec<(f64, f64)> {
    let mut sum: Vec<(f64, f64)> = Vec::new();
    for name in names {
        let pairs = record.profile(name).map(Profile::pairs).unwrap_or_default();
        sum.resize(pairs.len(), (0.0, 0.0));
        for (sum, (time, value)) in sum.iter_mut().zip(pairs) {
            *sum = (time, sum.1 + value);
        }
    }
    sum
}
