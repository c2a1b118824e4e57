//! From the records of this case to checks, figures and tables.

use transpoint::Variant;

use super::{INSTANTS, LAYOUTS, SPACINGS};
use crate::case::Row;
use crate::convergence::{Order, Series, series};
use crate::judge::Check;
use crate::number;
use crate::record::RunRecord;
use crate::report::axis::Axis;
use crate::report::plot::{Curve, Figure, Look, Panel};
use crate::report::table::{Cell, Table};
use crate::report::{Area, Artifact, Content};

const NORMS: [&str; 2] = ["point-l2", "gauss-l2"];

/// Variant, layout, norm, lower and upper bound.
type OrderCheck = (&'static str, &'static str, &'static str, Option<f64>, Option<f64>);

/// Order of the pressure error at the instant of the paper. Set beforehand from the claim of \[Song2020\] and the measurements of a prototype.
const ORDER_CHECKS: [OrderCheck; 7] = [
    ("tpm", "regular", "point-l2", Some(0.95), Some(1.05)),
    ("tpm", "regular", "gauss-l2", Some(1.9), Some(2.1)),
    ("tpm", "jittered", "point-l2", Some(0.9), Some(1.1)),
    ("tpm-vp", "jittered", "point-l2", Some(1.8), None),
    ("tpm-vp", "jittered", "gauss-l2", Some(1.8), None),
    ("mpm", "jittered", "point-l2", None, Some(0.3)),
    ("mpm", "jittered", "gauss-l2", None, Some(0.3)),
];

/// Largest relative difference between errors along different axes: round-off.
const ISOTROPY: f64 = 1e-9;

/// Records of one study of this case.
pub(super) fn of_study<'a>(
    records: &'a [RunRecord],
    study: &'a str,
) -> impl Iterator<Item = &'a RunRecord> {
    records.iter().filter(move |record| record.spec.label("study") == study)
}

/// All verdicts.
pub(super) fn checks(records: &[RunRecord], orders: &[Order]) -> Vec<Check> {
    let mut checks = Vec::new();
    for (variant, layout, norm, lower, upper) in ORDER_CHECKS {
        let quantity = "pressure@5us";
        let order = orders.iter().find(|order| {
            (order.variant == variant)
                && (order.layout == layout)
                && (order.quantity == quantity)
                && (order.norm == norm)
        });
        checks.extend(order.map(|order| Check {
            case: order.case.clone(),
            variant: variant.to_owned(),
            layout: layout.to_owned(),
            check: format!("order-{quantity}-{norm}"),
            measured: order.order,
            lower,
            upper,
            miss: None,
        }));
    }
    checks.extend(isotropy_checks(records));
    checks
}

/// Errors along y in 2D and along z in 3D against those along x.
fn isotropy_checks(records: &[RunRecord]) -> Vec<Check> {
    let mut checks = Vec::new();
    for turned in of_study(records, "isotropy").filter(|record| record.spec.label("axis") != "x") {
        let spec = &turned.spec;
        let along_x = records.iter().find(|record| {
            let other = &record.spec;
            (other.variant == spec.variant)
                && (other.layout == spec.layout)
                && (other.spacing == spec.spacing)
                && (other.label("dimension") == spec.label("dimension"))
                && (other.label("instant") == spec.label("instant"))
                && (other.label("axis") == "x")
        });
        checks.extend(along_x.map(|along_x| Check {
            case: spec.case.clone(),
            variant: spec.variant.clone(),
            layout: spec.layout.clone(),
            check: format!(
                "isotropy-{}-{}@{}",
                spec.label("dimension"),
                spec.label("axis"),
                spec.label("instant")
            ),
            measured: number::decade_above(largest_difference(turned, along_x)),
            lower: None,
            upper: Some(ISOTROPY),
            miss: None,
        }));
    }
    checks
}

/// Largest relative difference between the errors of two runs; not a number if one is not.
///
/// The velocity error at points is left out: the points still carry their exact initial velocity at
/// this instant, so that this error is itself no more than the remainder of the time step.
fn largest_difference(a: &RunRecord, b: &RunRecord) -> f64 {
    let compared = |row: &Row| row.quantity.starts_with("pressure") || row.norm == "gauss-l2";
    let pairs = a.rows.iter().zip(&b.rows).filter(|(row, _)| compared(row));
    pairs.fold(0.0, |worst: f64, (a, b)| {
        let difference = ((a.value - b.value) / b.value).abs();
        if difference.is_nan() || difference > worst { difference } else { worst }
    })
}

/// Figures and tables.
pub(super) fn artifacts(records: &[RunRecord], policy: &str) -> Vec<Artifact> {
    let all = series(of_study(records, "convergence"));
    let mut artifacts = Vec::new();
    for (stem, quantity, title) in [
        ("fig09_sine_wave_pressure", "pressure@5us", "Pressure error at t = 5 µs (Fig. 9)"),
        ("sine_wave_pressure_quarter_period", "pressure@T/4", "Pressure error at t = T/4"),
        ("sine_wave_velocity_quarter_period", "velocity@T/4", "Velocity error at t = T/4"),
    ] {
        if all.iter().any(|series| series.quantity == quantity) {
            artifacts.push(Artifact {
                stem: stem.to_owned(),
                title: title.to_owned(),
                area: Area::Accuracy,
                content: Content::Figure(convergence_figure(&all, quantity, title)),
            });
        }
    }
    artifacts.push(Artifact {
        stem: "sine_wave_convergence".to_owned(),
        title: "Errors and orders".to_owned(),
        area: Area::Accuracy,
        content: Content::Table(convergence_table(&all, policy)),
    });
    artifacts.push(Artifact {
        stem: "sine_wave_speed".to_owned(),
        title: "Pressure error against time".to_owned(),
        area: Area::Timing,
        content: Content::Figure(speed_figure(records)),
    });
    artifacts
}

fn style(variant: &str) -> usize {
    Variant::ALL.iter().position(|other| other.name() == variant).unwrap_or(0)
}

fn unit(quantity: &str) -> &'static str {
    if quantity.starts_with("pressure") { "Pa·m" } else { "m²/s" }
}

fn convergence_figure(all: &[Series], quantity: &str, title: &str) -> Figure {
    let mut panels = Vec::new();
    for norm in NORMS {
        for layout in LAYOUTS {
            let curves = all
                .iter()
                .filter(|series| {
                    series.quantity == quantity && series.norm == norm && series.layout == layout
                })
                .map(|series| Curve {
                    label: format!("{} ({})", series.variant, number::order(series.order().order)),
                    style: style(&series.variant),
                    points: series.points.clone(),
                    look: Look::Marked,
                })
                .collect();
            let measure = if norm == "point-l2" { "at points" } else { "at cell centres" };
            panels.push(Panel {
                title: format!("{layout} points, error {measure}"),
                x: Axis::log("cell size h, m").with_ticks(SPACINGS),
                y: Axis::log(format!("{norm} error, {}", unit(quantity))),
                legend: "method (order)".to_owned(),
                curves,
                slopes: vec![1.0, 2.0],
            });
        }
    }
    Figure {
        title: format!("Standing wave: {}", lower_first(title)),
        panels,
        columns: LAYOUTS.len(),
    }
}

fn lower_first(text: &str) -> String {
    let mut letters = text.chars();
    letters.next().map(|first| first.to_lowercase().chain(letters).collect()).unwrap_or_default()
}

fn convergence_table(all: &[Series], policy: &str) -> Table {
    let spacings: Vec<f64> = SPACINGS
        .into_iter()
        .filter(|h| all.iter().any(|series| series.points.iter().any(|point| point.0 == *h)))
        .collect();
    let mut columns: Vec<String> =
        ["variant", "layout", "quantity", "norm"].map(str::to_owned).to_vec();
    columns.extend(spacings.iter().map(|h| format!("h={h}")));
    columns.extend(["order", "order_last"].map(str::to_owned));
    let mut sorted: Vec<&Series> = all.iter().collect();
    let rank = |series: &Series| {
        let norm = NORMS.iter().position(|norm| *norm == series.norm);
        let layout = LAYOUTS.iter().position(|layout| *layout == series.layout);
        (series.quantity.clone(), norm, layout, style(&series.variant))
    };
    sorted.sort_by_key(|series| rank(series));
    let rows = sorted
        .into_iter()
        .map(|series| {
            let mut row: Vec<Cell> =
                [&series.variant, &series.layout, &series.quantity, &series.norm]
                    .map(|text| Cell::from(text.as_str()))
                    .to_vec();
            row.extend(spacings.iter().map(|h| {
                let point = series.points.iter().find(|point| point.0 == *h);
                Cell::Value(point.map_or(f64::NAN, |point| point.1))
            }));
            let order = series.order();
            row.extend([Cell::Order(order.order), Cell::Order(order.order_last)]);
            row
        })
        .collect();
    let note = format!(
        "Errors √(Σ e² V) on an area of 0.1 m²: pressure in Pa·m, velocity in m²/s; cell size h in \
         m. Order: least-squares slope over all levels; order_last: from the two finest. {policy}"
    );
    Table { columns, rows, note }
}

/// Relative pressure error over seconds, one curve per method, for the latest instant on record.
fn speed_figure(records: &[RunRecord]) -> Figure {
    let studied = || of_study(records, "convergence");
    let instant = INSTANTS
        .iter()
        .rev()
        .map(|instant| instant.name)
        .find(|name| studied().any(|record| record.spec.label("instant") == *name))
        .unwrap_or(INSTANTS[0].name);
    let quantity = format!("pressure@{instant}");
    let mut panels = Vec::new();
    for layout in LAYOUTS {
        let mut curves: Vec<Curve> = Vec::new();
        for variant in Variant::CORE.map(Variant::name) {
            let points: Vec<(f64, f64)> = studied()
                .filter(|record| record.spec.variant == variant && record.spec.layout == layout)
                .filter_map(|record| Some((record, record.row(&quantity, "gauss-l2")?)))
                .map(|(record, row)| (record.seconds, row.value / row.scale))
                .collect();
            if !points.is_empty() {
                curves.push(Curve {
                    label: variant.to_owned(),
                    style: style(variant),
                    points,
                    look: Look::Marked,
                });
            }
        }
        panels.push(Panel {
            title: format!("{layout} points"),
            x: Axis::log("wall time of the run, s"),
            y: Axis::log("relative gauss-l2 error of pressure"),
            legend: "method".to_owned(),
            curves,
            slopes: Vec::new(),
        });
    }
    let title = format!("Standing wave at t = {instant}: error against time on this machine");
    Figure { title: title.replace("5us", "5 µs"), panels, columns: LAYOUTS.len() }
}
