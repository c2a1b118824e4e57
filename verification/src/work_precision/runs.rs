//! The runs one by one: what they measured, and those that did not complete.

use super::artifacts::Problems;
use super::measured::Measured;
use crate::benchmark::Benchmark;
use crate::case::Case;
use crate::number;
use crate::report::table::{Cell, Table};
use crate::report::{Area, Artifact, Content};

/// A column of the file: its heading and its number of a run.
type Column = (&'static str, fn(&Measured) -> f64);

/// What a run measured on any machine.
const NUMBERS: [Column; 9] = [
    ("courant_number", |run| run.courant_number),
    ("steps", |run| run.steps),
    ("n_points", |run| run.n_points),
    ("bytes_per_point", |run| run.bytes_per_point),
    ("touches", |run| run.touches),
    ("point_steps", |run| run.point_steps),
    ("instructions", |run| run.instructions),
    ("bytes", |run| run.bytes),
    ("error", |run| run.error),
];

/// Runs that did not complete.
pub(super) fn gaps(problems: &Problems) -> Artifact {
    let mut rows = Vec::new();
    for (benchmark, points) in problems {
        for point in points.iter().filter(|point| !point.reason.is_empty()) {
            rows.push(vec![
                Cell::Text(benchmark.name().to_owned()),
                Cell::Text(point.variant.clone()),
                Cell::Count(benchmark.resolution(point.level, 2).cells as u64),
                Cell::Text(point.points.clone()),
                Cell::Decimal(point.courant_number),
                Cell::Text(point.reason.clone()),
            ]);
        }
    }
    let columns = ["problem", "variant", "cells", "points per cell", "Courant number", "reason"];
    let table = Table { columns: columns.map(str::to_owned).to_vec(), rows, note: String::new() };
    accuracy("wp_gaps", "Runs that did not complete", Content::Table(table))
}

/// All points, to compute with; without seconds, which are of this machine.
pub(super) fn every_point(problems: &Problems) -> Artifact {
    let mut columns = ["case", "variant", "points", "courant", "level", "cells", "spacing"]
        .map(str::to_owned)
        .to_vec();
    columns.extend(NUMBERS.map(|(name, _)| name.to_owned()));
    let row = |benchmark: &Benchmark, run: &Measured| {
        let mut row = vec![
            Cell::Text(benchmark.name().to_owned()),
            Cell::Text(run.variant.clone()),
            Cell::Text(run.points.clone()),
            Cell::Text(run.courant.clone()),
            Cell::Count(run.level as u64),
            Cell::Count(benchmark.resolution(run.level, 2).cells as u64),
            Cell::Text(number::significant(run.spacing)),
        ];
        row.extend(NUMBERS.map(|(_, number)| Cell::Value(number(run))));
        row
    };
    let mut rows = Vec::new();
    for (benchmark, runs) in problems {
        rows.extend(runs.iter().map(|run| row(benchmark, run)));
    }
    let table = Table { columns, rows, note: String::new() };
    accuracy("wp_points", "Every run", Content::Profiles(table))
}

fn accuracy(stem: &str, title: &str, content: Content) -> Artifact {
    Artifact { stem: stem.to_owned(), title: title.to_owned(), area: Area::Accuracy, content }
}
