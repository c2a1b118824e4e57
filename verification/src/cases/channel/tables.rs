//! Tables of measures, with those of the volume-of-fluid runs beside.

use super::measure::LEFT;
use super::outside;
use super::results::value;
use crate::record::RunRecord;
use crate::reference::channel::VofTotal;
use crate::report::table::{Cell, Table};

/// A column: quantity, norm, heading.
type Column = (&'static str, &'static str, &'static str);

const MASS: [Column; 12] = [
    ("mass", "slope", "dm/dt over flux"),
    ("grid-mass", "slope", "of grid mass"),
    ("mass", "deviation", "off the line"),
    ("grid-mass", "deviation", "grid mass"),
    ("mass", "mass@2", "m(2 s), kg"),
    ("mass", "mass@3", "m(3 s)"),
    ("mass", "mass@4", "m(4 s)"),
    ("grid-mass", "mass@2", "grid mass at 2 s"),
    ("grid-mass", "mass@4", "at 4 s"),
    ("mass", "vof@2", "m over VOF at 2 s"),
    ("mass", "vof@3", "3 s"),
    ("mass", "vof@4", "4 s"),
];

const RUNS: [Column; 12] = [
    ("run", "end", "end, s"),
    ("run", "steps", "steps"),
    ("run", "mach", "largest Ma"),
    ("front", "outlet", "first point out, s"),
    ("front", "left", "0.1 kg out, s"),
    ("steady", "growth@2", "m(3)/m(2) − 1"),
    ("steady", "variation", "change in the last second"),
    ("steady", "since", "below 1 % since, s"),
    ("energy", "most", "most energy, J"),
    ("energy", "over-head", "per mass over head"),
    ("depth", "vof@4", "depth off VOF at 4 s, m"),
    ("ledger", "step", "imbalance in a step"),
];

/// Measures of the mass.
pub(super) fn mass(records: &[RunRecord], policy: &str) -> Table {
    let note = format!(
        "Flux: ρ₀ v₀ h_in. dm/dt by least squares until the first point reaches the end; off the line: \
         largest distance from m(0) + ρ₀ v₀ h_in t until then over the mass at that time. Grid mass: on the \
         nodes, less that of the inlet's column. What comes in is compressed by its hydrostatic pressure, \
         ½ g h_in/c₀², which is 0.12 % at 100 mm. With `columns` the first h = 20 mm behind the plane are full at \
         the start (2 kg at 100 mm). VOF over its own run on 5 mm cells. {policy}"
    );
    table(records, &MASS, note, &|spacing| {
        let mass = outside::curve(spacing, VofTotal::Mass);
        let at = |instant: f64| crate::cases::series::at(&mass, instant.min(3.996));
        MASS.map(|(quantity, norm, _)| match (quantity, norm.strip_prefix("mass@")) {
            ("mass", Some(instant)) => instant.parse().map_or(f64::NAN, at),
            _ => f64::NAN,
        })
        .to_vec()
    })
}

/// Front, steadiness, energy and balance.
pub(super) fn runs(records: &[RunRecord], policy: &str) -> Table {
    let note = format!(
        "Ma: largest speed of a point over c₀. Change in the last second: largest minus least mass over the mass. \
         Below 1 % since: first time from which on no second up to the end of the run has a larger change. Energy: \
         kinetic and potential; over head: largest energy per mass over ½ v₀² + g h_in. Depth: root mean square over \
         the columns of cells. Imbalance: largest relative change of the mass in a step beyond what came in \
         and went out, its decade. {policy}"
    );
    table(records, &RUNS, note, &|spacing| {
        RUNS.map(|(_, norm, _)| match norm {
            "left" => outside::left(spacing, LEFT),
            "growth@2" => {
                let mass = outside::curve(spacing, VofTotal::Mass);
                let at = |instant| crate::cases::series::at(&mass, instant);
                at(3.0) / at(2.0) - 1.0
            }
            _ => f64::NAN,
        })
        .to_vec()
    })
}

fn table(
    records: &[RunRecord],
    columns: &[Column],
    note: String,
    outside: &dyn Fn(crate::reference::channel::VofSpacing) -> Vec<f64>,
) -> Table {
    let named = |names: [&str; 4], values: Vec<f64>| -> Vec<Cell> {
        let cells = columns.iter().zip(values).map(|((_, norm, _), value)| cell(norm, value));
        names.map(Cell::from).into_iter().chain(cells).collect()
    };
    let of_run = |record: &RunRecord| {
        let spec = &record.spec;
        let values =
            columns.iter().map(|(quantity, norm, _)| value(record, quantity, norm)).collect();
        named([&spec.layout, &spec.variant, spec.label("run"), spec.label("v0")], values)
    };
    let mut rows: Vec<Vec<Cell>> = records.iter().map(of_run).collect();
    for (spacing, name) in outside::RUNS {
        rows.push(named(["100mm", name, "", "0.4"], outside(spacing)));
    }
    let headings = ["inlet", "method", "run", "v₀, m/s"].into_iter();
    let columns = headings.chain(columns.iter().map(|column| column.2));
    Table { columns: columns.map(str::to_owned).collect(), rows, note }
}

fn cell(norm: &str, value: f64) -> Cell {
    match norm {
        "steps" if value.is_finite() => Cell::Count(value as u64),
        // Differences of a percent matter.
        "slope" | "deviation" | "variation" | "growth@2" | "over-head" | "mach" | "step" => {
            Cell::Text(number(value))
        }
        norm if norm.starts_with("vof@") => Cell::Text(number(value)),
        _ => Cell::Decimal(value),
    }
}

/// Four decimals, or the decade of what is smaller.
fn number(value: f64) -> String {
    if !value.is_finite() {
        "–".to_owned()
    } else if value != 0.0 && value.abs() < 1e-4 {
        format!("{value:.0e}")
    } else {
        format!("{value:.4}")
    }
}
