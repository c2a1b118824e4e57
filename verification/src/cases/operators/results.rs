//! From the records of this case to checks, figures and tables.

use super::families::{FAMILIES, Family};
use super::{CELLS, LAYOUTS};
use crate::convergence::{Order, Series, series};
use crate::judge::Check;
use crate::number;
use crate::record::RunRecord;
use crate::report::axis::Axis;
use crate::report::plot::{Curve, Figure, Look, Panel};
use crate::report::table::{Cell, Table};
use crate::report::{Area, Artifact, Content};

/// Largest error on a field that is to be reproduced exactly: values of order 1, gradients per cell.
const EXACT: f64 = 1e-12;

/// Operator, layout (empty: all), quantity, lower and upper bound of the order in `l2`.
type OrderCheck = (&'static str, &'static str, &'static str, Option<f64>, Option<f64>);

/// What the theory of each operator promises, with a margin for few levels. Set beforehand.
///
/// A support of half width 1 is too small for random points: at a wall some fits are singular and
/// fall back to the constant basis, and the order is lost (1.37 at walls). It is checked where points
/// are at most jittered.
const ORDER_CHECKS: [OrderCheck; 15] = [
    ("mls1-r1", "regular", "center@interior", Some(1.9), None),
    ("mls1-r1", "regular", "center@wall", Some(1.9), None),
    ("mls1-r1", "jittered", "center@interior", Some(1.9), None),
    ("mls1-r1", "jittered", "center@wall", Some(1.9), None),
    ("mls1-r1.5", "", "center@interior", Some(1.9), None),
    ("mls1-r1.5", "", "center@wall", Some(1.9), None),
    ("mls1-r2", "", "center@interior", Some(1.9), None),
    ("mls1-r2", "", "center@wall", Some(1.9), None),
    ("shepard", "random", "center@interior", None, Some(1.3)),
    ("shepard", "random", "center@wall", None, Some(1.3)),
    ("linear", "", "value@interior", Some(1.9), Some(2.1)),
    ("linear", "", "gradient@interior", Some(0.9), Some(1.1)),
    ("bspline2", "", "value@interior", Some(1.9), Some(2.1)),
    ("bspline3", "", "value@interior", Some(1.9), Some(2.1)),
    ("div-constant", "random", "divergence@interior", Some(0.9), Some(1.1)),
];

/// Operators that reproduce linear fields everywhere; the rest of those that keep constants.
const LINEAR_OPERATORS: [&str; 9] = [
    "linear",
    "gimp",
    "bspline2",
    "bspline3",
    "mls1-r1",
    "mls1-r1.5",
    "mls1-r2",
    "mls2-r1.5",
    "mls2-r2",
];

/// The records with their errors of the smooth field alone.
pub(super) fn errors(records: &[RunRecord]) -> Vec<RunRecord> {
    let mut errors = records.to_vec();
    for record in &mut errors {
        record.rows.retain(|row| !row.quantity.starts_with("exact"));
    }
    errors
}

/// All verdicts.
pub(super) fn checks(records: &[RunRecord], orders: &[Order]) -> Vec<Check> {
    let mut checks = Vec::new();
    for (operator, layout, quantity, lower, upper) in ORDER_CHECKS {
        let wanted = |order: &&Order| {
            (order.variant == operator)
                && (layout.is_empty() || order.layout == layout)
                && (order.quantity == quantity)
                && (order.norm == "l2")
        };
        checks.extend(orders.iter().filter(wanted).map(|order| Check {
            case: order.case.clone(),
            variant: order.variant.clone(),
            layout: order.layout.clone(),
            check: format!("order-{quantity}-l2"),
            measured: order.order,
            lower,
            upper,
            miss: None,
        }));
    }
    checks.extend(exactness_checks(records));
    checks
}

/// Constant and linear fields on the coarsest level on record.
fn exactness_checks(records: &[RunRecord]) -> Vec<Check> {
    let mut checks = Vec::new();
    let coarsest = records.iter().map(|record| record.spec.level).min();
    for record in records.iter().filter(|record| Some(record.spec.level) == coarsest) {
        let spec = &record.spec;
        let linear = LINEAR_OPERATORS.contains(&spec.variant.as_str());
        for (name, applies) in [("exact-constant", true), ("exact-linear", linear)] {
            let measured = record.row(name, "max").filter(|_| applies);
            checks.extend(measured.map(|row| Check {
                case: spec.case.clone(),
                variant: spec.variant.clone(),
                layout: spec.layout.clone(),
                check: name.to_owned(),
                measured: row.value,
                lower: None,
                upper: Some(EXACT),
                miss: None,
            }));
        }
    }
    checks
}

/// Figures and tables.
pub(super) fn artifacts(records: &[RunRecord], policy: &str) -> Vec<Artifact> {
    let all = series(errors(records).iter());
    let [shapes, transfers, _, fits, divergences] = &FAMILIES;
    let accuracy = |stem: &str, title: &str, content| Artifact {
        stem: stem.to_owned(),
        title: title.to_owned(),
        area: Area::Accuracy,
        content,
    };
    vec![
        accuracy(
            "operators_reconstruction",
            "Reconstruction from points",
            Content::Figure(figure(
                &all,
                "Reconstruction",
                &[(fits, "center"), (fits, "gradient")],
            )),
        ),
        accuracy(
            "operators_shape_functions",
            "Shape functions",
            Content::Figure(figure(
                &all,
                "Shape functions",
                &[(shapes, "value"), (shapes, "gradient")],
            )),
        ),
        accuracy(
            "operators_transfer",
            "Transfer and point divergence",
            Content::Figure(figure(
                &all,
                "Transfer to the nodes and back; divergence at points",
                &[(transfers, "value"), (divergences, "divergence")],
            )),
        ),
        accuracy(
            "operators_orders",
            "Errors and orders",
            Content::Table(table(&all, &format!("{policy} {}", fallbacks(records)))),
        ),
    ]
}

/// One row of panels per family and quantity, columns for interior and wall, on random points.
fn figure(all: &[Series], title: &str, rows: &[(&Family, &str)]) -> Figure {
    let layout = "random";
    let mut panels = Vec::new();
    for (family, quantity) in rows {
        for region in ["interior", "wall"] {
            let name = format!("{quantity}@{region}");
            let find = |operator: &str| {
                all.iter().find(|series| {
                    (series.variant == operator)
                        && (series.layout == layout)
                        && (series.quantity == name)
                        && (series.norm == "l2")
                })
            };
            let curves = family.operators.iter().enumerate().filter_map(|(style, operator)| {
                let series = find(operator)?;
                let order = number::order(series.order().order);
                let name = operator.replace("bspline", "bs").replace("div-", "");
                let label = format!("{} ({order})", name.replace("vertex-mean", "vertex"));
                Some(Curve { label, style, points: series.points.clone(), look: Look::Marked })
            });
            panels.push(Panel {
                title: format!("{quantity}, {region}"),
                x: Axis::log("cell size h / box length"),
                y: Axis::log(format!("root-mean-square error of {quantity}")),
                legend: "operator (order)".to_owned(),
                curves: curves.collect(),
                slopes: vec![1.0, 2.0],
            });
        }
    }
    Figure { title: format!("{title}: errors on {layout} points"), panels, columns: 2 }
}

/// How often a fit fell back to the constant basis; one such cell can decide the order at walls.
fn fallbacks(records: &[RunRecord]) -> String {
    let count = |record: &RunRecord| {
        let n = *record.counters.get("n_singular_fallbacks")?;
        let n_cells = (1.0 / record.spec.spacing).round();
        (n > 0)
            .then(|| format!("{} {} h=1/{n_cells}: {n}", record.spec.variant, record.spec.layout))
    };
    let found: Vec<String> = records.iter().filter_map(count).collect();
    let found = if found.is_empty() { "none".to_owned() } else { found.join(", ") };
    format!("Fits with too few points about the centre or node, given the weighted mean: {found}.")
}

fn table(all: &[Series], policy: &str) -> Table {
    let cells: Vec<usize> = CELLS
        .into_iter()
        .filter(|&n| all.iter().any(|series| series.points.iter().any(|p| p.0 == 1.0 / n as f64)))
        .collect();
    let mut columns: Vec<String> =
        ["operator", "layout", "quantity", "norm"].map(str::to_owned).to_vec();
    columns.extend(cells.iter().map(|n| format!("h=1/{n}")));
    columns.extend(["order", "order_last"].map(str::to_owned));
    let operators: Vec<&str> = FAMILIES.iter().flat_map(|f| f.operators).copied().collect();
    let rank = |series: &Series| {
        let layout = LAYOUTS.iter().position(|layout| *layout == series.layout);
        let operator = operators.iter().position(|operator| *operator == series.variant);
        (operator, series.quantity.clone(), series.norm.clone(), layout)
    };
    let mut sorted: Vec<&Series> = all.iter().collect();
    sorted.sort_by_key(|series| rank(series));
    let row = |series: &Series| {
        let mut row: Vec<Cell> = [&series.variant, &series.layout, &series.quantity, &series.norm]
            .map(|text| Cell::from(text.as_str()))
            .to_vec();
        row.extend(cells.iter().map(|&n| {
            let point = series.points.iter().find(|point| point.0 == 1.0 / n as f64);
            Cell::Value(point.map_or(f64::NAN, |point| point.1))
        }));
        let order = series.order();
        row.extend([Cell::Order(order.order), Cell::Order(order.order_last)]);
        row
    };
    let note = format!(
        "Errors against the exact field: values without unit, gradients and divergences per box \
         length. Order: least-squares slope over all levels; order_last: from the two finest. {policy}"
    );
    Table { columns, rows: sorted.into_iter().map(row).collect(), note }
}
