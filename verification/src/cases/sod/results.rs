//! From the records of this case to checks and tables.

use super::scene::FIELDS;
use super::{CELLS, LAYOUTS, METHODS, figures};
use crate::convergence::{Order, Series, series};
use crate::judge::Check;
use crate::record::RunRecord;
use crate::report::table::{Cell, Table};
use crate::report::{Area, Artifact, Content};

/// Least order of the L1 error that the best method must reach in each field, set beforehand.
const ORDER: f64 = 0.8;
/// Largest relative drift of the total energy where it is kept by construction, set beforehand.
const DRIFT: f64 = 1e-10;

/// All verdicts: the best order per field, and the drift of every method that keeps the energy.
///
/// The order is asked for on the lattice. On jittered points no method reached it in every field when the
/// bound was tried there; those orders are reported without a bound.
///
/// The best of some methods or levels says nothing about the best of all: a part has no such check.
pub(super) fn checks(records: &[RunRecord], orders: &[Order]) -> Vec<Check> {
    let mut checks = Vec::new();
    for field in &FIELDS {
        let whole: Vec<&Order> = orders
            .iter()
            .filter(|order| order.layout == "regular" && order.quantity == field.name)
            .filter(|order| order.levels == CELLS.len())
            .collect();
        if whole.len() < METHODS.len() {
            continue;
        }
        let best = whole.into_iter().max_by(|a, b| rank(a.order).total_cmp(&rank(b.order)));
        checks.extend(best.map(|order| Check {
            case: order.case.clone(),
            variant: order.variant.clone(),
            layout: order.layout.clone(),
            check: format!("best-order-{}-l1", field.name),
            measured: order.order,
            lower: Some(ORDER),
            upper: None,
            miss: None,
        }));
    }
    for method in METHODS.iter().filter(|method| method.name.ends_with("-work")) {
        for layout in LAYOUTS {
            checks.extend(largest_drift(records, method.name, layout).map(|measured| Check {
                case: "sod".to_owned(),
                variant: method.name.to_owned(),
                layout: layout.to_owned(),
                check: "total-energy-drift".to_owned(),
                measured,
                lower: None,
                upper: Some(DRIFT),
                miss: None,
            }));
        }
    }
    checks
}

/// An order that is not a number comes last.
fn rank(order: f64) -> f64 {
    if order.is_nan() { f64::NEG_INFINITY } else { order }
}

/// Over all levels; not a number if a run blew up, `None` without runs.
fn largest_drift(records: &[RunRecord], method: &str, layout: &str) -> Option<f64> {
    let of_method =
        |record: &&RunRecord| record.spec.variant == method && record.spec.layout == layout;
    records
        .iter()
        .filter(of_method)
        .map(|record| record.row("total-energy", "drift").map_or(f64::NAN, |row| row.value))
        .reduce(|a, b| if a.is_nan() || a > b { a } else { b })
}

/// Figures and tables.
pub(super) fn artifacts(records: &[RunRecord], policy: &str) -> Vec<Artifact> {
    let accuracy = |stem: &str, title: &str, content| Artifact {
        stem: stem.to_owned(),
        title: title.to_owned(),
        area: Area::Accuracy,
        content,
    };
    let all = series(records);
    let mut artifacts = Vec::new();
    if let Some((level, figure)) = figures::profiles(records) {
        let title = format!("The tube at t = 0.2 s with {} cells", CELLS[level]);
        artifacts.push(accuracy("sod_profiles", &title, Content::Figure(figure)));
    }
    artifacts.extend([
        accuracy(
            "sod_convergence",
            "L1 errors over cell size",
            Content::Figure(figures::convergence(&all)),
        ),
        accuracy("sod_errors", "L1 errors and orders", Content::Table(errors(&all, policy))),
        accuracy("sod_drift", "Drift of the totals", Content::Table(drifts(&all, policy))),
    ]);
    artifacts
}

/// Levels that have runs.
fn cells_of(all: &[Series]) -> Vec<usize> {
    let has = |cells: usize| {
        all.iter().flat_map(|series| &series.points).any(|point| point.0 == 1.0 / cells as f64)
    };
    CELLS.into_iter().filter(|&cells| has(cells)).collect()
}

fn table(
    all: &[Series],
    norm: &str,
    last: &[&str],
    of_series: impl Fn(&Series) -> Vec<Cell>,
    note: String,
) -> Table {
    let levels = cells_of(all);
    let mut columns: Vec<String> = ["quantity", "layout", "method"].map(str::to_owned).to_vec();
    columns.extend(levels.iter().map(|cells| format!("{cells} cells")));
    columns.extend(last.iter().map(|&heading| heading.to_owned()));
    let mut chosen: Vec<&Series> = all.iter().filter(|series| series.norm == norm).collect();
    let place = |series: &Series| {
        let quantity = FIELDS.iter().position(|field| field.name == series.quantity);
        let layout = LAYOUTS.iter().position(|layout| *layout == series.layout);
        let method = METHODS.iter().position(|method| method.name == series.variant);
        (quantity, series.quantity.clone(), layout, method)
    };
    chosen.sort_by_key(|series| place(series));
    let row = |series: &&Series| {
        let names = [&series.quantity, &series.layout, &series.variant];
        let mut row: Vec<Cell> = names.map(|text| Cell::from(text.as_str())).to_vec();
        row.extend(levels.iter().map(|&cells| {
            let found = series.points.iter().find(|point| point.0 == 1.0 / cells as f64);
            Cell::Value(found.map_or(f64::NAN, |point| point.1))
        }));
        row.extend(of_series(series));
        row
    };
    Table { rows: chosen.iter().map(row).collect(), columns, note }
}

fn errors(all: &[Series], policy: &str) -> Table {
    let note = format!(
        "Error Σ |q − q_exact(x)| V / Σ V times the length of 1 m, over the points: density in kg/m³·m, \
         velocity in m²/s, pressure in Pa·m, specific internal energy in J/kg·m. Order: least-squares \
         slope over all levels; order_last: from the two finest. In 1D the divergence of linear \
         functions is constant in a cell anyway, so that tpm and tpm-vp0 are one method, and so are mpm \
         and mpm-vp. {policy}"
    );
    let orders = |series: &Series| {
        let order = series.order();
        vec![Cell::Order(order.order), Cell::Order(order.order_last)]
    };
    table(all, "l1", &["order", "order_last"], orders, note)
}

fn drifts(all: &[Series], policy: &str) -> Table {
    let note = format!(
        "Largest relative change during the run of the total energy Σ m (½ v² + e) and of the mass Σ m, \
         and that of the volume Σ m/ρ at the end. What is below 10⁻⁹ is given by its decade. Points \
         carry their mass, so that it cannot change; the masses of tpm and tpm-vp0 are nominal: the \
         scheme itself knows densities and volumes only. {policy}"
    );
    table(all, "drift", &[], |_| Vec::new(), note)
}
