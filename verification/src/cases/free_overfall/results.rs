//! From the records of this case to checks and tables.

use super::figures;
use super::march::{STATIONS, WINDOW};
use super::runs::CELLS;
use crate::cases::errors::{artifact, style};
use crate::judge::Check;
use crate::record::RunRecord;
use crate::report::table::{Cell, Table};
use crate::report::{Artifact, Content};

/// Depth at the brink over the critical depth, measured by \[Rouse1936\]: a reference.
pub(super) const RATIO: f64 = 0.715;
/// Set beforehand: within 5 % of the reference.
const ALLOWED: f64 = 0.05;
/// The method that the goal is for.
const METHOD: &str = "tpm-vp2";

/// A measure of a run, not a number if it has none.
pub(super) fn value(record: &RunRecord, quantity: &str, norm: &str) -> f64 {
    record.row(quantity, norm).map_or(f64::NAN, |row| row.value)
}

/// All verdicts: the ratio, at every inflow and resolution on record.
pub(super) fn checks(records: &[RunRecord]) -> Vec<Check> {
    let of_method = records.iter().filter(|record| record.spec.variant == METHOD);
    let check = |record: &RunRecord| Check {
        case: "free-overfall".to_owned(),
        variant: METHOD.to_owned(),
        layout: record.spec.layout.clone(),
        check: format!("brink-depth-{}-cells", CELLS.get(record.spec.level).unwrap_or(&0)),
        measured: value(record, "brink", "depth"),
        lower: Some(RATIO * (1.0 - ALLOWED)),
        upper: Some(RATIO * (1.0 + ALLOWED)),
        miss: None,
    };
    of_method.map(check).collect()
}

/// Figures and tables.
pub(super) fn artifacts(records: &[RunRecord], policy: &str) -> Vec<Artifact> {
    let mut artifacts = vec![
        artifact(
            "free_overfall_surface",
            "Mean depth along the stream",
            Content::Figure(figures::surface(records)),
        ),
        artifact(
            "free_overfall_ratio",
            "Depth at the brink over time",
            Content::Figure(figures::ratio(records)),
        ),
        artifact(
            "free_overfall_measures",
            "Measures of the free overfall",
            Content::Table(measures(records, policy)),
        ),
    ];
    let maps = figures::maps(records);
    if !maps.panels.is_empty() {
        artifacts.push(artifact("free_overfall_map", "Pressure at the end", Content::Maps(maps)));
    }
    artifacts
}

/// A column: quantity, norm, heading.
const COLUMNS: [(&str, &str, &str); 11] = [
    ("brink", "depth", "brink depth"),
    ("brink", "top", "highest point"),
    ("brink", "discharge", "discharge"),
    ("brink", "noise", "noise"),
    ("brink", "drift", "drift"),
    ("bed-pressure", "mean", "bed pressure"),
    ("bed-pressure", "noise", "noise"),
    ("flow", "inflow", "inflow"),
    ("flow", "mass", "mass"),
    ("flow", "steady-since", "steady since T"),
    ("run", "end", "end T"),
];

const COUNTERS: [&str; 2] = ["n_points_filled", "n_pressure_cutoffs"];

fn measures(records: &[RunRecord], policy: &str) -> Table {
    let mut sorted: Vec<&RunRecord> = records.iter().collect();
    sorted.sort_by_key(|record| {
        let spec = &record.spec;
        // Froude numbers descending: the critical stream first.
        (std::cmp::Reverse(spec.layout.clone()), style(&spec.variant), spec.level)
    });
    let row = |record: &RunRecord| {
        let spec = &record.spec;
        let cells = CELLS.get(spec.level).map_or(0, |&cells| cells as u64);
        let mut row = vec![
            Cell::from(spec.layout.as_str()),
            Cell::from(spec.variant.as_str()),
            Cell::Count(cells),
        ];
        row.extend(COLUMNS.map(|(quantity, norm, _)| Cell::Value(value(record, quantity, norm))));
        row.extend(
            STATIONS.map(|station| {
                Cell::Decimal(value(record, &format!("upstream-{station}"), "depth"))
            }),
        );
        row.extend(
            COUNTERS.map(|name| Cell::Count(record.counters.get(name).copied().unwrap_or(0))),
        );
        row
    };
    let mut columns: Vec<String> =
        ["inflow Fr", "method", "cells per y_c"].map(str::to_owned).to_vec();
    columns.extend(COLUMNS.map(|column| column.2.to_owned()));
    columns.extend(STATIONS.map(|station| format!("depth at −{station} y_c")));
    columns.extend(["points filled", "pressure raised"].map(str::to_owned));
    let note = format!(
        "Means over the last {WINDOW} T. Depths over y_c: volume of the points in the columns of cells \
         beside the place over their width. Highest point over the bed at the brink over y_c. Bed pressure \
         3 y_c upstream over ρ₀ g y_c. Discharge at the brink over q, inflow over ρ₀ q (water under its own \
         weight is denser than ρ₀ by half a percent), mass over ρ₀ y_c². Noise: root mean square of raw \
         minus running mean over 1 T; drift: second half of the window minus first. Reference: brink \
         depth {RATIO} y_c [Rouse1936]. {policy}"
    );
    Table { columns, rows: sorted.into_iter().map(row).collect(), note }
}
