//! From the records of a problem to verdicts, a figure and a table.

use super::{Benchmark, VARIANTS};
use crate::case::Case;
use crate::cases::errors;
use crate::convergence::{Order, Series, series};
use crate::judge::{Check, Miss};
use crate::record::RunRecord;
use crate::report::axis::Axis;
use crate::report::plot::{Curve, Figure, Look, Panel};
use crate::report::table::{Cell, Table};
use crate::report::{Artifact, Content};

/// The method whose orders are gated.
const GATED: &str = "tpm-vp2-even";
/// Most by which the order between the two finest grids may differ from that over all: beyond it the errors are not
/// yet, or no longer, those of the asymptotic range.
const ASYMPTOTIC: f64 = 0.5;

/// Goals that are known not to be met, by the name of the problem.
pub(super) fn misses(problem: &str) -> &'static [Miss] {
    match problem {
        "advected-wave" => &[Miss {
            variant: GATED,
            layout: "jittered",
            check: "order-pressure",
            reason: "The error of a wave that is carried through the grid falls faster than expected, with order 3.5 down \
                     to 7·10⁻⁵ of the wave: points kept even are nearly a lattice that the wave has smoothed, and what is \
                     left of second order has not shown. The bound for being too good stays.",
        }],
        "gravity-wave" => &[Miss {
            variant: GATED,
            layout: "jittered",
            check: "asymptotic-range",
            reason: "A wave of a tenth of a cell decides which cells of the surface count as cut, and the error of its \
                     amplitude follows that more than the cell size.",
        }],
        "tilted-tank" => &[Miss {
            variant: GATED,
            layout: "jittered",
            check: "asymptotic-range",
            reason: "The surface cuts other cells at other heights on each grid, and which of them count as cut decides on \
                     the noise that starts there: the error falls with order one over three levels, but not from each to \
                     the next.",
        }],
        "taylor-green-1000" => &[Miss {
            variant: GATED,
            layout: "jittered",
            check: "asymptotic-range",
            reason: "With four levels the finest error, 0.6 %, is what a weakly compressible fluid leaves, the waves of its \
                     start included: with twice the speed of sound it is less than half of that, and the order between the \
                     two finest grids 2.2.",
        }],
        "taylor-green-inviscid" => &[Miss {
            variant: GATED,
            layout: "jittered",
            check: "asymptotic-range",
            reason: "With four levels the finest error comes near what a weakly compressible fluid leaves, the waves of \
                     its start included.",
        }],
        _ => &[],
    }
}

/// Order of the first error within what theory lets expect, too high as bad as too low, and in the asymptotic
/// range; for one method, where the answer is smooth.
pub(super) fn checks(benchmark: &Benchmark, orders: &[Order]) -> Vec<Check> {
    let Some((lower, upper)) = benchmark.expected_order() else { return Vec::new() };
    let kind = benchmark.errors()[0];
    let found = orders.iter().find(|order| {
        order.variant == GATED && order.quantity == kind.quantity && order.norm == kind.norm
    });
    let Some(order) = found else { return Vec::new() };
    let check = |name: &str, measured, lower, upper| Check {
        case: order.case.clone(),
        variant: order.variant.clone(),
        layout: order.layout.clone(),
        check: format!("{name}-{}", kind.quantity),
        measured,
        lower,
        upper: Some(upper),
        miss: None,
    };
    vec![
        check("order", order.order, Some(lower), upper),
        check("asymptotic-range", (order.order_last - order.order).abs(), None, ASYMPTOTIC),
    ]
}

/// Errors against cell size, as figure and table.
pub(super) fn artifacts(benchmark: &Benchmark, records: &[RunRecord]) -> Vec<Artifact> {
    let all = series(benchmark.plain(records));
    let name = benchmark.name();
    let stem = name.replace('-', "_");
    vec![
        errors::artifact(
            &format!("{stem}_errors"),
            &format!("{name}: error against cell size"),
            Content::Figure(figure(benchmark, &all)),
        ),
        errors::artifact(
            &format!("{stem}_errors"),
            &format!("{name}: errors and orders"),
            Content::Table(table(benchmark, &all)),
        ),
    ]
}

/// The series of an error and a method.
fn find<'a>(all: &'a [Series], variant: &str, quantity: &str) -> Option<&'a Series> {
    all.iter().find(|series| series.variant == variant && series.quantity == quantity)
}

fn figure(benchmark: &Benchmark, all: &[Series]) -> Figure {
    let panel = |kind: &super::ErrorKind| {
        let curve = |(style, variant): (usize, &transpoint::Variant)| {
            let series = find(all, variant.name(), kind.quantity)?;
            Some(Curve {
                label: series.variant.clone(),
                style,
                points: series.points.clone(),
                look: Look::Marked,
            })
        };
        Panel {
            title: format!("{} ({})", kind.quantity, kind.norm),
            x: Axis::log("cell size h (m)"),
            y: Axis::log("relative error"),
            legend: "jittered points".to_owned(),
            curves: VARIANTS.iter().enumerate().filter_map(curve).collect(),
            slopes: vec![1.0, 2.0],
        }
    };
    Figure {
        title: format!("{}: error against cell size", benchmark.name()),
        panels: benchmark.errors().iter().map(panel).collect(),
        columns: 2,
    }
}

fn table(benchmark: &Benchmark, all: &[Series]) -> Table {
    let first = benchmark.errors()[0];
    let levels: Vec<usize> = (0..benchmark.levels()).collect();
    let mut columns = vec!["variant".to_owned()];
    columns.extend(levels.iter().map(|&level| {
        format!("{} at {} cells", first.quantity, benchmark.resolution(level, 2).cells)
    }));
    columns.extend(benchmark.errors().iter().map(|kind| format!("order {}", kind.quantity)));
    let row = |variant: &transpoint::Variant| {
        let series = find(all, variant.name(), first.quantity)?;
        let at = |&level: &usize| {
            Cell::Value(series.points.get(level).map_or(f64::NAN, |point| point.1))
        };
        let order = |kind: &super::ErrorKind| {
            let found = find(all, variant.name(), kind.quantity);
            Cell::Order(found.map_or(f64::NAN, |series| series.order().order))
        };
        let mut cells = vec![Cell::Text(variant.name().to_owned())];
        cells.extend(levels.iter().map(at));
        cells.extend(benchmark.errors().iter().map(order));
        Some(cells)
    };
    Table {
        columns,
        rows: VARIANTS.iter().filter_map(row).collect(),
        note: format!("Relative errors, {}. {}", first.norm, benchmark.policy()),
    }
}
