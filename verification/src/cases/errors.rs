//! Errors against cell size, as figures and tables.

use transpoint::Variant;

use super::lattice::LAYOUTS;
use crate::convergence::{Order, Series};
use crate::judge::Check;
use crate::number;
use crate::report::axis::Axis;
use crate::report::plot::{Curve, Figure, Look, Panel};
use crate::report::table::{Cell, Table};
use crate::report::{Area, Artifact, Content};

/// Norms of errors, whose orders are observed.
pub const NORMS: [&str; 2] = ["point-l2", "gauss-l2"];

/// An error to be shown over the cell size.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Shown {
    /// Quantity of the rows.
    pub quantity: &'static str,
    /// Norm of the rows.
    pub norm: &'static str,
    /// What a reader calls it.
    pub title: &'static str,
    /// Unit of the error.
    pub unit: &'static str,
}

/// Place of a variant among all: its colour and marker, and its rank in tables.
pub fn style(variant: &str) -> usize {
    Variant::ALL.iter().position(|other| other.name() == variant).unwrap_or(0)
}

/// An artifact that any machine reproduces.
pub fn artifact(stem: &str, title: &str, content: Content) -> Artifact {
    Artifact { stem: stem.to_owned(), title: title.to_owned(), area: Area::Accuracy, content }
}

/// One row of panels per error, one column per layout.
pub fn figure(all: &[Series], title: &str, errors: &[Shown]) -> Figure {
    let mut panels = Vec::new();
    for shown in errors {
        for layout in LAYOUTS {
            let mut of_panel: Vec<&Series> = all
                .iter()
                .filter(|series| {
                    (series.quantity == shown.quantity)
                        && (series.norm == shown.norm)
                        && (series.layout == layout)
                })
                .collect();
            of_panel.sort_by_key(|series| style(&series.variant));
            let curve = |series: &Series| Curve {
                label: format!("{} ({})", series.variant, number::order(series.order().order_last)),
                style: style(&series.variant),
                points: series.points.clone(),
                look: Look::Marked,
            };
            panels.push(Panel {
                title: format!("{}, {layout} points", shown.title),
                x: Axis::log("cell size h, m"),
                y: Axis::log(format!("{} error, {}", shown.norm, shown.unit)),
                legend: "method (last order)".to_owned(),
                curves: of_panel.into_iter().map(curve).collect(),
                slopes: vec![1.0, 2.0],
            });
        }
    }
    Figure { title: title.to_owned(), panels, columns: LAYOUTS.len() }
}

/// Errors at all cell sizes with their orders; the sizes are those found.
pub fn table(all: &[Series], note: &str) -> Table {
    let mut spacings: Vec<f64> =
        all.iter().flat_map(|series| &series.points).map(|point| point.0).collect();
    spacings.sort_by(|a, b| b.total_cmp(a));
    spacings.dedup();
    let mut columns: Vec<String> =
        ["quantity", "norm", "layout", "variant"].map(str::to_owned).to_vec();
    columns.extend(spacings.iter().map(|h| format!("h=1/{}", (1.0 / h).round())));
    columns.extend(["order", "order_last"].map(str::to_owned));
    let mut sorted: Vec<&Series> = all.iter().collect();
    let rank = |series: &Series| {
        let norm = NORMS.iter().position(|norm| *norm == series.norm);
        let layout = LAYOUTS.iter().position(|layout| *layout == series.layout);
        (series.quantity.clone(), norm, layout, style(&series.variant))
    };
    sorted.sort_by_key(|series| rank(series));
    let row = |series: &Series| {
        let mut row: Vec<Cell> = [&series.quantity, &series.norm, &series.layout, &series.variant]
            .map(|text| Cell::from(text.as_str()))
            .to_vec();
        row.extend(spacings.iter().map(|h| {
            let point = series.points.iter().find(|point| point.0 == *h);
            Cell::Value(point.map_or(f64::NAN, |point| point.1))
        }));
        let order = series.order();
        row.extend([Cell::Order(order.order), Cell::Order(order.order_last)]);
        row
    };
    let note = format!(
        "Cell size h in m. Order: least-squares slope over all cell sizes; order_last: from the \
         two finest. {note}"
    );
    Table { columns, rows: sorted.into_iter().map(row).collect(), note }
}

/// A lower bound on an order between the two finest cell sizes.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct LowerBound {
    /// Name of the method.
    pub variant: &'static str,
    /// Arrangement of the points.
    pub layout: &'static str,
    /// Quantity.
    pub quantity: &'static str,
    /// Norm.
    pub norm: &'static str,
    /// Smallest order that passes.
    pub least: f64,
}

/// Verdicts on the orders on record; of a single cell size there is none.
pub fn order_checks(orders: &[Order], bounds: &[LowerBound]) -> Vec<Check> {
    let check = |bound: &LowerBound| {
        let order = orders.iter().find(|order| {
            (order.variant == bound.variant)
                && (order.layout == bound.layout)
                && (order.quantity == bound.quantity)
                && (order.norm == bound.norm)
                && (order.levels > 1)
        })?;
        Some(Check {
            case: order.case.clone(),
            variant: order.variant.clone(),
            layout: order.layout.clone(),
            check: format!("last-order-{}-{}", bound.quantity, bound.norm),
            measured: order.order_last,
            lower: Some(bound.least),
            upper: None,
            miss: None,
        })
    };
    bounds.iter().filter_map(check).collect()
}

#[cfg(test)]
mod tests {
    use super::*;

    const BOUND: LowerBound = LowerBound {
        variant: "tpm",
        layout: "regular",
        quantity: "pressure",
        norm: "gauss-l2",
        least: 1.8,
    };

    fn series(points: &[(f64, f64)]) -> Series {
        let [case, variant, layout, quantity, norm] =
            ["c", "tpm", "regular", "pressure", "gauss-l2"].map(str::to_owned);
        Series { case, variant, layout, quantity, norm, points: points.to_vec() }
    }

    #[test]
    fn a_low_order_and_a_blow_up_fail_and_a_single_level_is_left_out() {
        let verdicts = |points: &[(f64, f64)]| -> Vec<bool> {
            let orders = [series(points).order()];
            order_checks(&orders, &[BOUND]).iter().map(Check::holds).collect()
        };
        assert_eq!(verdicts(&[(0.5, 1.0), (0.25, 0.25)]), [true]);
        assert_eq!(verdicts(&[(0.5, 1.0), (0.25, 0.5)]), [false]);
        assert_eq!(verdicts(&[(0.5, 1.0), (0.25, f64::NAN)]), [false]);
        assert!(verdicts(&[(0.5, 1.0)]).is_empty());
    }

    #[test]
    fn tables_leave_a_gap_where_a_cell_size_is_missing() {
        let mut other = series(&[(0.5, 1.0)]);
        other.variant = "mpm".to_owned();
        let table = table(&[other, series(&[(0.5, 2.0), (0.25, 0.5)])], "");
        assert_eq!(table.columns[4..6], ["h=1/2", "h=1/4"]);
        assert_eq!(table.rows[0][3], Cell::from("tpm"));
        assert!(matches!(table.rows[1][5], Cell::Value(value) if value.is_nan()));
    }
}
