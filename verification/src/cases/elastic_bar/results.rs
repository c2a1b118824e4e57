//! From the records of this case to figures and tables.

use crate::cases::errors::{self, NORMS, Shown, artifact, style};
use crate::convergence::{Series, series};
use crate::record::RunRecord;
use crate::report::table::{Cell, Table};
use crate::report::{Artifact, Content};

const QUARTER: [Shown; 4] = [
    shown("pressure@T/4", "point-l2", "pressure at points", "Pa·√m"),
    shown("pressure@T/4", "gauss-l2", "pressure at cell centers", "Pa·√m"),
    shown("deviatoric@T/4", "point-l2", "deviatoric stress at points", "Pa·√m"),
    shown("deviatoric@T/4", "gauss-l2", "deviatoric stress at cell centers", "Pa·√m"),
];
const PERIOD: [Shown; 2] = [
    shown("velocity@T", "point-l2", "velocity at points", "m√m/s"),
    shown("velocity@T", "gauss-l2", "velocity at cell centers", "m√m/s"),
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
    let mut all: Vec<Series> = series(records);
    all.retain(|series| NORMS.contains(&series.norm.as_str()));
    let stresses = errors::figure(&all, "Elastic bar: stress errors at t = T/4", &QUARTER);
    let velocity = errors::figure(&all, "Elastic bar: velocity error at t = T", &PERIOD);
    let note = format!("Errors √(Σ e² V): stresses in Pa·√m, velocity in m√m/s. {policy}");
    let table = errors::table(&all, &note);
    vec![
        artifact(
            "elastic_bar_stress",
            "Elastic bar: stress errors at t = T/4",
            Content::Figure(stresses),
        ),
        artifact(
            "elastic_bar_velocity",
            "Elastic bar: velocity error at t = T",
            Content::Figure(velocity),
        ),
        artifact(
            "elastic_bar_convergence",
            "Elastic bar: errors and orders",
            Content::Table(table),
        ),
        artifact(
            "elastic_bar_frequency",
            "Elastic bar: frequency and amplitude after a period",
            Content::Table(frequency(records)),
        ),
    ]
}

fn frequency(records: &[RunRecord]) -> Table {
    let mut sorted: Vec<&RunRecord> = records.iter().collect();
    sorted.sort_by_key(|record| {
        let spec = &record.spec;
        (std::cmp::Reverse(spec.layout.clone()), style(&spec.variant), spec.level)
    });
    let row = |record: &&RunRecord| {
        let spec = &record.spec;
        let value = |quantity| {
            Cell::Value(record.row(quantity, "relative").map_or(f64::NAN, |row| row.value))
        };
        vec![
            Cell::from(spec.layout.as_str()),
            Cell::from(spec.variant.as_str()),
            Cell::Count((1.0 / spec.spacing).round() as u64),
            value("phase@T"),
            value("loss@T"),
        ]
    };
    Table {
        columns: ["layout", "variant", "cells", "frequency", "loss"].map(str::to_owned).to_vec(),
        rows: sorted.iter().map(row).collect(),
        note:
            "After one period, from the share of the exact mode in the velocity and in the axial \
               stress of the points: relative error of the frequency, relative loss of amplitude."
                .to_owned(),
    }
}
