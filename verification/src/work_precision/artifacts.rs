//! Figures, tables and the page of the study, on one scale of cost.

use super::cost::Cost;
use super::front::front;
use super::measured::Measured;
use super::tables::{cheapest, ranking, reached, within_budget};
use super::{instructions, runs};
use crate::benchmark::{Benchmark, COURANT, OWN_SHARE, VARIANTS};
use crate::case::Case;
use crate::report::axis::Axis;
use crate::report::plot::{Curve, Figure, Look, Panel};
use crate::report::table::{Cell, Table};
use crate::report::{Artifact, Content, page};

/// Errors whose cost is tabled.
pub(super) const TARGETS: [(f64, &str); 3] = [(0.1, "10pct"), (0.03, "3pct"), (0.01, "1pct")];
pub(super) type Problems = [(&'static Benchmark, Vec<Measured>)];

/// Every figure and table on that scale.
pub(super) fn all(problems: &Problems, cost: Cost) -> Vec<Artifact> {
    let mut artifacts = vec![cheapest(problems, cost), ranking(problems, cost)];
    artifacts.extend(TARGETS.iter().map(|&(error, name)| reached(problems, cost, error, name)));
    artifacts.push(within_budget(problems, cost));
    for (benchmark, points) in problems.iter().filter(|_| cost.shows_problems()) {
        artifacts.push(figure(benchmark, points, cost));
        artifacts.push(front_table(benchmark, points, cost));
    }
    if cost == Cost::Touches {
        artifacts.push(runs::gaps(problems));
        artifacts.push(runs::every_point(problems));
    }
    artifacts
}

/// The page that shows the artifacts of a scale.
pub(super) fn page(artifacts: &[Artifact], cost: Cost) -> String {
    let mut text = format!(
        "# Speed against error\n\nWritten by `verify work-precision`; do not edit. Errors are relative, those that each \
         problem names first; costs are {}. Each method runs on every problem at four cell sizes with 2 and with 3 \
         points per axis at {COURANT} of the common stable time step, and with 2 points at {OWN_SHARE} of the largest \
         Courant number with which the method ends the coarsest run with at most twice its error at the common one. All \
         points are jittered.\n\n{}",
        cost.label(),
        cost.about()
    );
    if cost == Cost::Instructions {
        text.extend([" Counted with ", instructions::holds_for(), "."]);
    }
    text.push('\n');
    text.push_str(&other_scales(cost));
    let part =
        |artifact: &Artifact| format!("\n## {}\n\n{}", artifact.title, page::embed(artifact));
    text.extend(artifacts.iter().map(part));
    text
}

/// Links to the pages of the other scales in the same folder.
fn other_scales(cost: Cost) -> String {
    let others = Cost::ALL.into_iter().filter(|other| other.area() == cost.area());
    let links: Vec<String> = others
        .filter(|&other| other != cost)
        .map(|other| format!("[{}]({})", other.label(), other.page()))
        .collect();
    if links.is_empty() {
        String::new()
    } else {
        format!("\nThe same against other costs: {}.\n", links.join(", "))
    }
}

pub(super) fn artifact(cost: Cost, stem: &str, title: String, content: Content) -> Artifact {
    Artifact { stem: format!("{stem}_{}", cost.name()), title, area: cost.area(), content }
}

/// (cost, error) of the points of one method, or of all.
pub(super) fn pairs(points: &[Measured], variant: Option<&str>, cost: Cost) -> Vec<(f64, f64)> {
    points
        .iter()
        .filter(|point| variant.is_none_or(|variant| point.variant == variant))
        .map(|point| (point.cost(cost), point.error))
        .collect()
}

fn figure(benchmark: &Benchmark, points: &[Measured], cost: Cost) -> Artifact {
    let along = |variant: Option<&str>| {
        let all = pairs(points, variant, cost);
        front(&all).into_iter().map(|i| all[i]).collect::<Vec<_>>()
    };
    // Colours by the place among the methods compared, so that few come back.
    let mut curves: Vec<Curve> = VARIANTS
        .iter()
        .enumerate()
        .map(|(style, variant)| Curve {
            label: variant.name().to_owned(),
            style,
            points: along(Some(variant.name())),
            look: Look::Marked,
        })
        .filter(|curve| !curve.points.is_empty())
        .collect();
    let best = along(None);
    curves.extend(guides(&best, benchmark.dimension()));
    curves.push(Curve {
        label: "front of all".to_owned(),
        style: 0,
        points: best,
        look: Look::Band,
    });
    let kind = benchmark.errors()[0];
    let panel = Panel {
        title: format!("{}: error of {} ({})", benchmark.name(), kind.quantity, kind.norm),
        x: Axis::log(format!("cost ({})", cost.label())),
        y: Axis::log("relative error"),
        legend: "own front of each".to_owned(),
        curves,
        slopes: Vec::new(),
    };
    let title = format!("{}: error against cost", benchmark.name());
    let figure = Figure { title: title.clone(), panels: vec![panel], columns: 1 };
    let stem = format!("wp_{}", benchmark.name().replace('-', "_"));
    artifact(cost, &stem, title, Content::Figure(figure))
}

/// Where an error falls as h and h², if the cost grows as 1/h^(D+1): straight lines from the cheapest point.
fn guides(best: &[(f64, f64)], dimension: usize) -> Vec<Curve> {
    let (Some(&(start, error)), Some(&(end, _))) = (best.first(), best.last()) else {
        return Vec::new();
    };
    let guide = |order: f64| {
        let last = error * (end / start).powf(-order / (dimension as f64 + 1.0));
        Curve {
            label: format!("order {order} in h"),
            style: 0,
            points: vec![(start, error), (end, last)],
            look: Look::Guide,
        }
    };
    vec![guide(1.0), guide(2.0)]
}

/// The points of the front of all methods.
fn front_table(benchmark: &Benchmark, points: &[Measured], cost: Cost) -> Artifact {
    let all = pairs(points, None, cost);
    let row = |i: usize| {
        let point = &points[i];
        vec![
            Cell::Text(point.variant.clone()),
            Cell::Count(benchmark.resolution(point.level, 2).cells as u64),
            Cell::Text(point.points.clone()),
            Cell::Decimal(point.courant_number),
            Cell::Value(all[i].0),
            Cell::Value(point.error),
        ]
    };
    let columns = ["variant", "cells", "points per cell", "Courant number", cost.label(), "error"];
    let table = Table {
        columns: columns.map(str::to_owned).to_vec(),
        rows: front(&all).into_iter().map(row).collect(),
        note: benchmark.policy(),
    };
    let stem = format!("wp_front_{}", benchmark.name().replace('-', "_"));
    artifact(cost, &stem, format!("{}: the front", benchmark.name()), Content::Table(table))
}
