//! From the records of this case to checks, orders and tables.

use super::figures;
use super::runs::CELLS;
use crate::cases::errors::{artifact, style};
use crate::convergence::{Order, Series, series};
use crate::judge::{Check, Miss};
use crate::record::RunRecord;
use crate::report::Artifact;
use crate::report::Content;
use crate::report::table::{Cell, Table};

/// A measure with its bounds: name, quantity, norm, lower, upper.
type Goal = (&'static str, &'static str, &'static str, Option<f64>, Option<f64>);

/// Set beforehand: force within 2 %, both by the pressure on the plate and by the momentum of the jet, pressure
/// on the plate within 5 % in L2.
const GOALS: [Goal; 3] = [
    ("force", "force", "mean", Some(0.98), Some(1.02)),
    ("force-by-momentum", "force-by-momentum", "mean", Some(0.98), Some(1.02)),
    ("wall-pressure-l2", "wall-pressure", "relative-l2", None, Some(0.05)),
];
/// Least order of the pressure on the plate over all levels: it converges.
const ORDER: f64 = 0.0;
/// The first level that the goals are for: 16 cells across the jet.
const FROM_LEVEL: usize = 2;
/// What the goals are for.
const CHECKED: [&str; 3] = ["half", "columns", "shift"];
const METHOD: &str = "tpm-vp2";

/// Found at 16 cells: 0.974.
pub(super) const MISSES: [Miss; 1] = [Miss {
    variant: METHOD,
    layout: "half",
    check: "force-16-cells",
    reason: "`half`, force by the pressure at 16 cells: points part at the stagnation point and a void opens there; \
             it is filled a hundred times from T = 8 on, when the force is 0.96 to 0.97 in place of 0.99. With \
             points that are pushed apart (`shift`) no void opens and the goal is met.",
}];

/// Errors whose orders are observed.
const CONVERGING: [(&str, &str); 2] = [("wall-pressure", "relative-l2"), ("force", "error")];

/// The run of that method, layout and level.
pub(super) fn find<'a>(
    records: &'a [RunRecord],
    variant: &str,
    layout: &str,
    level: usize,
) -> Option<&'a RunRecord> {
    records.iter().find(|record| {
        let spec = &record.spec;
        spec.variant == variant && spec.layout == layout && spec.level == level
    })
}

/// A measure of a run, not a number if it has none.
pub(super) fn value(record: &RunRecord, quantity: &str, norm: &str) -> f64 {
    record.row(quantity, norm).map_or(f64::NAN, |row| row.value)
}

/// All verdicts, from 16 cells across the jet on.
pub(super) fn checks(records: &[RunRecord]) -> Vec<Check> {
    let check = |layout: &str, check: String, measured, lower, upper| Check {
        case: "jet-on-plate".to_owned(),
        variant: METHOD.to_owned(),
        layout: layout.to_owned(),
        check,
        measured,
        lower,
        upper,
        miss: None,
    };
    let mut checks = Vec::new();
    for layout in CHECKED {
        for (level, cells) in CELLS.iter().enumerate().skip(FROM_LEVEL) {
            let Some(record) = find(records, METHOD, layout, level) else { continue };
            checks.extend(GOALS.iter().map(|&(name, quantity, norm, lower, upper)| {
                let name = format!("{name}-{cells}-cells");
                check(layout, name, value(record, quantity, norm), lower, upper)
            }));
        }
    }
    let converging = orders(records).into_iter().filter(|order| {
        order.levels > 1
            && order.variant == METHOD
            && CHECKED.contains(&order.layout.as_str())
            && order.quantity == CONVERGING[0].0
    });
    checks.extend(converging.map(|order| {
        check(&order.layout, "wall-pressure-order".to_owned(), order.order, Some(ORDER), None)
    }));
    checks
}

/// Orders of the errors that have several levels.
pub(super) fn orders(records: &[RunRecord]) -> Vec<Order> {
    let is_error = |order: &Order| {
        order.levels > 1 && CONVERGING.contains(&(order.quantity.as_str(), order.norm.as_str()))
    };
    series(records).iter().map(Series::order).filter(is_error).collect()
}

/// Figures and tables.
pub(super) fn artifacts(records: &[RunRecord], policy: &str) -> Vec<Artifact> {
    let mut artifacts = vec![
        artifact(
            "jet_on_plate_pressure",
            "Mean pressure on the plate",
            Content::Figure(figures::pressure(records)),
        ),
        artifact(
            "jet_on_plate_convergence",
            "Errors over cell size",
            Content::Figure(figures::convergence(records)),
        ),
        artifact(
            "jet_on_plate_force",
            "Force on the plate over time",
            Content::Figure(figures::force(records)),
        ),
        artifact(
            "jet_on_plate_measures",
            "Measures of the jet on a plate",
            Content::Table(measures(records, policy)),
        ),
    ];
    let maps = figures::maps(records);
    if !maps.panels.is_empty() {
        let title = "Pressure at the end";
        artifacts.push(artifact("jet_on_plate_map", title, Content::Maps(maps)));
    }
    artifacts
}

/// A column: quantity, norm, heading.
const COLUMNS: [(&str, &str, &str); 13] = [
    ("force", "mean", "force"),
    ("force", "noise", "noise"),
    ("force", "drift", "drift"),
    ("force-by-momentum", "mean", "force by momentum"),
    ("stagnation", "mean", "stagnation pressure"),
    ("stagnation", "noise", "noise"),
    ("wall-pressure", "relative-l2", "wall pressure L2"),
    ("wall-pressure", "asymmetry", "asymmetry"),
    ("wall-pressure", "dry-share", "dry share"),
    ("flow", "inflow", "inflow"),
    ("flow", "mass", "mass"),
    ("flow", "steady-since", "steady since T"),
    ("run", "end", "end T"),
];

const COUNTERS: [&str; 4] =
    ["n_points_filled", "n_leverage_limited", "n_positivity_limited", "n_pressure_cutoffs"];

fn measures(records: &[RunRecord], policy: &str) -> Table {
    let mut sorted: Vec<&RunRecord> = records.iter().collect();
    sorted.sort_by_key(|record| {
        let spec = &record.spec;
        (spec.layout.clone(), style(&spec.variant), spec.level)
    });
    let row = |record: &RunRecord| {
        let spec = &record.spec;
        let cells = CELLS.get(spec.level).map_or(0, |&cells| cells as u64);
        let counter = |name: &str| Cell::Count(record.counters.get(name).copied().unwrap_or(0));
        let mut row = vec![
            Cell::from(spec.layout.as_str()),
            Cell::from(spec.variant.as_str()),
            Cell::Count(cells),
        ];
        row.extend(COLUMNS.map(|(quantity, norm, _)| Cell::Value(value(record, quantity, norm))));
        row.extend(COUNTERS.map(counter));
        row
    };
    let headings = ["layout", "method", "cells across b"].into_iter();
    let counted = ["points filled", "leverage limited", "positivity limited", "pressure raised"];
    let columns = headings.chain(COLUMNS.map(|column| column.2)).chain(counted);
    let note = format!(
        "Means over 6 < T < 12. Force over ρ U² b: by the pressure in the cells on the plate, and by the \
         momentum through a layer 1.5 b above it; both are checked. Stagnation pressure over ½ ρ U². \
         Inflow over ρ U b, mass of the whole jet over ρ b². Noise: root mean square of raw minus running \
         mean over 1 T; drift: second half of the window minus first. Dry share: samples of cells on the \
         plate within b of the axis that had no points, whose pressure counts as zero. {policy}"
    );
    Table {
        columns: columns.map(str::to_owned).collect(),
        rows: sorted.into_iter().map(row).collect(),
        note,
    }
}
