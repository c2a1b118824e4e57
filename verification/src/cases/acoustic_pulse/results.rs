//! From the records of this case to figures and tables.

use super::scene::{CENTER, SOUND_SPEED};
use super::{CELLS_2D, PATHS, PROFILE_LEVEL, measure};
use crate::cases::errors::{self, NORMS, Shown, artifact, style};
use crate::convergence::{Series, series};
use crate::record::RunRecord;
use crate::report::axis::Axis;
use crate::report::plot::{Curve, Figure, Look, Panel};
use crate::report::table::{Cell, Table};
use crate::report::{Artifact, Content};

const LINE: [Shown; 4] = [
    shown("pressure@1d", "point-l2", "pressure at points", "Pa·√m"),
    shown("pressure@1d", "gauss-l2", "pressure at cell centers", "Pa·√m"),
    shown("velocity@1d", "point-l2", "velocity at points", "m√m/s"),
    shown("velocity@1d", "gauss-l2", "velocity at cell centers", "m√m/s"),
];
const PLANE: [Shown; 4] = [
    shown("pressure@2d", "point-l2", "pressure at points", "Pa·m"),
    shown("pressure@2d", "gauss-l2", "pressure at cell centers", "Pa·m"),
    shown("velocity@2d", "point-l2", "velocity at points", "m²/s"),
    shown("velocity@2d", "gauss-l2", "velocity at cell centers", "m²/s"),
];

/// Variant and layout of each panel of pressure over radius.
const PANELS: [(&str, &str); 6] = [
    ("tpm", "regular"),
    ("tpm", "jittered"),
    ("tpm-vp", "jittered"),
    ("mpm", "jittered"),
    ("bspline3", "jittered"),
    ("apic", "jittered"),
];

const fn shown(
    quantity: &'static str,
    norm: &'static str,
    title: &'static str,
    unit: &'static str,
) -> Shown {
    Shown { quantity, norm, title, unit }
}

/// Figures and tables.
pub(super) fn artifacts(records: &[RunRecord], policy: &str) -> Vec<Artifact> {
    let of_study = |study: &str| -> Vec<Series> {
        let mut all = series(records.iter().filter(|record| record.spec.label("study") == study));
        all.retain(|series| NORMS.contains(&series.norm.as_str()));
        all
    };
    let mut artifacts = Vec::new();
    for (study, shown, what) in [("1d", LINE, "Pulse in 1D"), ("2d", PLANE, "Pulse in 2D")] {
        let all = of_study(study);
        if all.is_empty() {
            continue;
        }
        let title = format!("{what}: errors");
        let figure = errors::figure(&all, &title, &shown);
        artifacts.push(artifact(
            &format!("acoustic_pulse_{study}"),
            &title,
            Content::Figure(figure),
        ));
        let [pressure, velocity] = [shown[0].unit, shown[2].unit];
        let note =
            format!("Errors √(Σ e² V): pressure in {pressure}, velocity in {velocity}. {policy}");
        let table = errors::table(&all, &note);
        let stem = format!("acoustic_pulse_{study}_convergence");
        artifacts.push(artifact(
            &stem,
            &format!("{what}: errors and orders"),
            Content::Table(table),
        ));
    }
    artifacts.push(artifact(
        "acoustic_pulse_dispersion",
        "Pulse in 1D: dispersion",
        Content::Table(dispersion(records)),
    ));
    artifacts.push(artifact(
        "acoustic_pulse_isotropy",
        "Pulse in 2D: isotropy",
        Content::Table(isotropy(records)),
    ));
    let figure = radial_figure(records);
    if !figure.panels.is_empty() {
        let title = "Pulse in 2D: pressure over radius";
        artifacts.push(artifact("acoustic_pulse_radial", title, Content::Figure(figure)));
    }
    artifacts
}

/// Records of one study, by layout, variant and level.
fn sorted<'a>(records: &'a [RunRecord], study: &str) -> Vec<&'a RunRecord> {
    let mut found: Vec<_> =
        records.iter().filter(|record| record.spec.label("study") == study).collect();
    found.sort_by_key(|record| {
        let spec = &record.spec;
        (std::cmp::Reverse(spec.layout.clone()), style(&spec.variant), spec.level)
    });
    found
}

fn start_of_row(record: &RunRecord) -> Vec<Cell> {
    let spec = &record.spec;
    let cells = (1.0 / spec.spacing).round() as u64;
    vec![Cell::from(spec.layout.as_str()), Cell::from(spec.variant.as_str()), Cell::Count(cells)]
}

fn value(record: &RunRecord, quantity: &str, norm: &str) -> f64 {
    record.row(quantity, norm).map_or(f64::NAN, |row| row.value)
}

fn dispersion(records: &[RunRecord]) -> Table {
    let path = PATHS[0];
    let row = |record: &&RunRecord| {
        let lag = value(record, "lag@1d", "cells");
        let mut row = start_of_row(record);
        row.extend([
            Cell::Value(lag),
            Cell::Value(-lag * record.spec.spacing / path),
            Cell::Value(value(record, "loss@1d", "relative")),
        ]);
        row
    };
    let note = format!(
        "After c₀t = {path} m, by least squares of P, shifted and scaled, to the pressures of the \
         points around the pulse that moves to the right. Lag in cells, late is positive; speed: \
         relative error; loss: share of the amplitude."
    );
    table(
        ["layout", "variant", "cells", "lag_cells", "speed", "loss"],
        sorted(records, "1d").iter().map(row).collect(),
        note,
    )
}

fn isotropy(records: &[RunRecord]) -> Table {
    let row = |record: &&RunRecord| {
        let mut row = start_of_row(record);
        for place in ["crest", "trough"] {
            for what in ["anisotropy", "axis-less-diagonal", "scatter"] {
                row.push(Cell::Value(value(record, &format!("{what}@{place}"), "relative")));
            }
        }
        row
    };
    let note = format!(
        "At c₀t = {} m, pressure errors of the points within 20 mm of the radius of the crest and \
         of the trough, as shares of the exact pressure there, in 16 sectors. anisotropy: root mean \
         square of the sector means about their mean; axis-less-diagonal: mean over the 4 sectors \
         of the axes less that of the diagonals; scatter: root mean square of the points about \
         their sector mean.",
        PATHS[1]
    );
    let columns = [
        "layout",
        "variant",
        "cells",
        "anisotropy_crest",
        "axis-less-diagonal_crest",
        "scatter_crest",
        "anisotropy_trough",
        "axis-less-diagonal_trough",
        "scatter_trough",
    ];
    table(columns, sorted(records, "2d").iter().map(row).collect(), note)
}

fn table<const N: usize>(columns: [&str; N], rows: Vec<Vec<Cell>>, note: String) -> Table {
    Table { columns: columns.map(str::to_owned).to_vec(), rows, note }
}

/// Pressures of some points over their distance from the center, beside the exact solution.
fn radial_figure(records: &[RunRecord]) -> Figure {
    let time = PATHS[1] / SOUND_SPEED;
    let exact = measure::Radial::new(time, time);
    let line: Vec<(f64, f64)> = (0..=280)
        .map(|i| 0.0025 * f64::from(i))
        .filter(|r| *r <= CENTER * std::f64::consts::SQRT_2)
        .map(|r| (r, exact.along(r)[0]))
        .collect();
    let panels = PANELS.into_iter().filter_map(|(variant, layout)| {
        let profile = records
            .iter()
            .filter(|record| record.spec.variant == variant && record.spec.layout == layout)
            .find_map(|record| record.profile("pressure"))?;
        let curve = |label: &str, style, points, look| Curve {
            label: label.to_owned(),
            style,
            points,
            look,
        };
        Some(Panel {
            title: format!("{variant}, {layout} points, {} cells across", CELLS_2D[PROFILE_LEVEL]),
            x: Axis::linear("distance r from the center, m"),
            y: Axis::linear("pressure p, Pa"),
            legend: "pressure".to_owned(),
            curves: vec![
                curve("exact", 2, line.clone(), Look::Line),
                curve("some points", 0, profile.pairs(), Look::Dots),
            ],
            slopes: Vec::new(),
        })
    });
    Figure {
        title: format!("Pulse in 2D at c₀t = {} m", PATHS[1]),
        panels: panels.collect(),
        columns: 3,
    }
}
