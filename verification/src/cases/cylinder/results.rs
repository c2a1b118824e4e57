//! From the records of this case to checks, figures and tables.

use super::figures;
use super::policy::{Body, MOST_ENERGY};
use crate::judge::Check;
use crate::record::RunRecord;
use crate::reference::cylinder::{Quantity, band};
use crate::report::table::{Cell, Table};
use crate::report::{Area, Artifact, Content};

/// The method that is judged; others stand beside it.
const JUDGED: &str = "tpm-vp2";

/// A measure beside published bounds: name, layout, quantity, norm, what is given, and by how much it may lie
/// beyond, relative.
type Goal = (&'static str, &'static str, &'static str, &'static str, Quantity, f64);

/// Set beforehand.
const GOALS: [Goal; 3] = [
    ("strouhal", "shedding-re100", "strouhal", "crossings", Quantity::Strouhal, 0.05),
    ("largest-drag", "shedding-re100", "drag", "max", Quantity::LargestDrag, 0.1),
    ("drag", "steady-re20", "drag", "mean", Quantity::SteadyDrag, 0.1),
];

/// A measure of a run, not a number if it has none.
fn value(record: &RunRecord, quantity: &str, norm: &str) -> f64 {
    record.row(quantity, norm).map_or(f64::NAN, |row| row.value)
}

fn is_judged(record: &RunRecord) -> bool {
    record.spec.variant == JUDGED && record.spec.label("body") == Body::Matched.name()
}

/// The judged run of a layout with the smallest cells.
fn finest<'a>(records: &'a [RunRecord], layout: &str) -> Option<&'a RunRecord> {
    records
        .iter()
        .filter(|record| record.spec.layout == layout && is_judged(record))
        .max_by_key(|record| record.spec.level)
}

fn check(
    record: &RunRecord,
    name: &str,
    measured: f64,
    (lower, upper): (Option<f64>, Option<f64>),
) -> Check {
    let spec = &record.spec;
    Check {
        case: spec.case.clone(),
        variant: spec.variant.clone(),
        layout: format!("{} level {}", spec.layout, spec.level),
        check: name.to_owned(),
        measured,
        lower,
        upper,
        miss: None,
    }
}

/// Published bounds for the finest run of each flow; ledger, energy and body for every judged run.
pub(super) fn checks(records: &[RunRecord]) -> Vec<Check> {
    let mut checks = Vec::new();
    for (name, layout, quantity, norm, given, slack) in GOALS {
        let Some(record) = finest(records, layout) else { continue };
        // Damaged bounds are not numbers, within which nothing lies.
        let [lower, upper] = band(given).unwrap_or([f64::NAN; 2]);
        let bounds = (Some(lower * (1.0 - slack)), Some(upper * (1.0 + slack)));
        checks.push(check(record, name, value(record, quantity, norm), bounds));
    }
    for record in records.iter().filter(|record| is_judged(record)) {
        let of = |quantity, norm| value(record, quantity, norm);
        checks.extend([
            check(record, "mass-ledger", of("ledger", "error"), (None, Some(1e-12))),
            check(record, "kinetic-energy", of("energy", "largest"), (None, Some(MOST_ENERGY))),
            check(record, "points-in-the-body", of("points", "in-the-body"), (None, Some(0.0))),
        ]);
        if record.spec.layout == "small-re20" {
            checks.push(check(record, "drag", of("drag", "mean"), (Some(0.1), None)));
        }
    }
    checks
}

/// Figures and tables, in the order of the page.
pub(super) fn artifacts(records: &[RunRecord], policy: &str) -> Vec<Artifact> {
    let artifact = |stem: &str, title: &str, content| Artifact {
        stem: stem.to_owned(),
        title: title.to_owned(),
        area: Area::Accuracy,
        content,
    };
    let mut artifacts = vec![
        artifact("cylinder_forces", "Drag and lift", Content::Figure(figures::forces(records))),
        artifact("cylinder", "Flow past a cylinder", Content::Table(table(records, policy))),
    ];
    artifacts.extend(records.iter().filter_map(figures::maps).map(|(stem, title, maps)| {
        Artifact { stem, title, area: Area::Accuracy, content: Content::Maps(maps) }
    }));
    artifacts
}

/// Columns: quantity, norm, heading.
const COLUMNS: [(&str, &str, &str); 17] = [
    ("run", "end", "T at the end"),
    ("strouhal", "crossings", "St"),
    ("strouhal", "periods", "periods"),
    ("drag", "mean", "C_D mean"),
    ("drag", "max", "C_D max"),
    ("drag", "deviation", "deviation"),
    ("drag", "noise", "noise"),
    ("lift", "mean", "C_L mean"),
    ("lift", "max", "C_L max"),
    ("lift", "deviation", "deviation"),
    ("lift", "noise", "noise"),
    ("voids", "mean", "voids"),
    ("voids", "most", "most"),
    ("points", "most-in-a-cell", "points in a cell"),
    ("speed", "largest", "speed, m/s"),
    ("energy", "largest", "energy"),
    ("ledger", "error", "ledger"),
];

/// Counters of events, and their headings.
const EVENTS: [(&str, &str); 4] = [
    ("n_points_filled", "filled"),
    ("n_points_shifted", "pushed"),
    ("n_pressure_limited", "limited slopes"),
    ("n_fills_refused", "fills refused"),
];

/// What is published for a measure.
fn given(layout: &str, quantity: &str, norm: &str) -> Option<Quantity> {
    match (layout, quantity, norm) {
        ("shedding-re100", "strouhal", "crossings") => Some(Quantity::Strouhal),
        ("shedding-re100", "drag", "max") => Some(Quantity::LargestDrag),
        ("shedding-re100", "lift", "max") => Some(Quantity::LargestLift),
        ("steady-re20", "drag", "mean") => Some(Quantity::SteadyDrag),
        ("steady-re20", "lift", "mean") => Some(Quantity::SteadyLift),
        _ => None,
    }
}

/// The row of published bounds of a flow.
fn published(layout: &str) -> Vec<Cell> {
    let names = [layout, "[SchaeferTurek1996]", "", ""].into_iter().map(Cell::from);
    let bounds = COLUMNS.iter().map(|(quantity, norm, _)| {
        let bounds = given(layout, quantity, norm).and_then(|quantity| band(quantity).ok());
        bounds.map_or(Cell::from(""), |[lower, upper]| Cell::Text(format!("{lower}-{upper}")))
    });
    names.chain(bounds).chain(EVENTS.iter().map(|_| Cell::from(""))).collect()
}

/// Measures of every run with the published bounds below.
fn table(records: &[RunRecord], policy: &str) -> Table {
    let mut rows: Vec<Vec<Cell>> = records.iter().map(row).collect();
    for layout in ["shedding-re100", "steady-re20"] {
        if records.iter().any(|record| record.spec.layout == layout) {
            rows.push(published(layout));
        }
    }
    let columns = ["layout", "method", "body", "cells per D"].into_iter();
    let columns = columns.chain(COLUMNS.map(|column| column.2)).chain(EVENTS.map(|event| event.1));
    let note = format!(
        "T = t U/D. C = F/(½ ρ₀ U² D), U the mean velocity of the inflow; the force is the momentum that the \
         nodes of the cylinder take, by its running mean over 0.2 T; noise: root mean square of what that \
         takes away. Maxima: means over the periods of the largest value in each. Body: `plain` has the \
         radius of the circle, `matched` one with which the convex hull of the nodes that it holds has the \
         area of the circle. Voids: cells of the fluid without points, mean and most. Energy: largest \
         kinetic energy over that at the start. Ledger: largest share of the mass that neither inlet nor outflow nor rearrangement explains. {policy}"
    );
    Table { columns: columns.map(str::to_owned).collect(), rows, note }
}

fn row(record: &RunRecord) -> Vec<Cell> {
    let spec = &record.spec;
    let mut cells = vec![
        Cell::from(spec.layout.as_str()),
        Cell::from(spec.variant.as_str()),
        Cell::from(spec.label("body")),
        Cell::Decimal(super::scene::DIAMETER / spec.spacing),
    ];
    cells.extend(COLUMNS.iter().map(|&(quantity, norm, _)| {
        let value = value(record, quantity, norm);
        match (quantity, norm) {
            ("ledger", _) | (_, "noise") | ("lift", "mean") => Cell::Value(value),
            _ => Cell::Decimal(value),
        }
    }));
    let count = |name: &str| record.counters.get(name).copied().unwrap_or(0);
    cells.extend(EVENTS.iter().map(|(name, _)| Cell::Count(count(name))));
    cells
}
