//! Tables over all problems: who reaches what at which cost.

use super::artifacts::{Problems, TARGETS, artifact, pairs};
use super::cost::Cost;
use super::front::{cost_at_error, error_at_cost, front};
use super::measured::Measured;
use crate::benchmark::{Benchmark, VARIANTS};
use crate::case::Case;
use crate::number;
use crate::report::table::{Cell, Table};
use crate::report::{Artifact, Content};

/// Which method reaches an error at the least cost, and at what.
pub(super) fn cheapest(problems: &Problems, cost: Cost) -> Artifact {
    let best = |points: &[Measured], error: f64| {
        let at = |variant: &transpoint::Variant| {
            let pairs = pairs(points, Some(variant.name()), cost);
            cost_at_error(&pairs, error).map(|cost| (variant.name(), cost))
        };
        let least = VARIANTS.iter().filter_map(at).min_by(|a, b| a.1.total_cmp(&b.1));
        least.map_or("–".to_owned(), |(name, cost)| {
            format!("{name} ({})", number::scientific(cost))
        })
    };
    let row = |(benchmark, points): &(&'static Benchmark, Vec<Measured>)| {
        let mut row = vec![Cell::Text(benchmark.name().to_owned())];
        row.extend(TARGETS.iter().map(|&(error, _)| Cell::Text(best(points, error))));
        row
    };
    let mut columns = vec!["problem".to_owned()];
    columns.extend(TARGETS.iter().map(|(error, _)| format!("error of {} %", 100.0 * error)));
    let table = Table {
        columns,
        rows: problems.iter().map(row).collect(),
        note: format!(
            "The method that reaches the error with the fewest {}, in brackets.",
            cost.label()
        ),
    };
    artifact(cost, "wp_cheapest", "The cheapest method".to_owned(), Content::Table(table))
}

/// Who lies on the fronts, and how often.
pub(super) fn ranking(problems: &Problems, cost: Cost) -> Artifact {
    let on_front: Vec<Vec<&str>> = problems
        .iter()
        .map(|(_, points)| {
            let all = pairs(points, None, cost);
            front(&all).into_iter().map(|i| points[i].variant.as_str()).collect()
        })
        .collect();
    let mut rows: Vec<(usize, Vec<Cell>)> = VARIANTS
        .iter()
        .map(|variant| {
            let named: Vec<&str> = problems
                .iter()
                .zip(&on_front)
                .filter(|(_, names)| names.contains(&variant.name()))
                .map(|((benchmark, _), _)| benchmark.name())
                .collect();
            let completed = problems
                .iter()
                .flat_map(|(_, points)| points)
                .filter(|p| p.variant == variant.name());
            let (runs, failed) = completed.fold((0, 0), |(runs, failed), point| {
                (runs + 1, failed + u64::from(!point.reason.is_empty()))
            });
            let cells = vec![
                Cell::Text(variant.name().to_owned()),
                Cell::Count(named.len() as u64),
                Cell::Text(named.join(", ")),
                Cell::Count(runs),
                Cell::Count(failed),
            ];
            (named.len(), cells)
        })
        .collect();
    // The sort is stable: ties stay in the order of legends.
    rows.sort_by_key(|(count, _)| std::cmp::Reverse(*count));
    let columns =
        ["variant", "problems on whose front it lies", "which", "runs", "did not complete"];
    let table = Table {
        columns: columns.map(str::to_owned).to_vec(),
        rows: rows.into_iter().map(|(_, cells)| cells).collect(),
        note: format!(
            "Of {} problems. A method lies on the front where no cheaper run of any method has a smaller \
                       error than one of its own.",
            problems.len()
        ),
    };
    artifact(cost, "wp_ranking", "Who lies on the front".to_owned(), Content::Table(table))
}

/// One row per method, one column per problem.
fn matrix(problems: &Problems, cell: impl Fn(&[Measured], &str) -> Cell, note: String) -> Table {
    let mut columns = vec!["variant".to_owned()];
    columns.extend(problems.iter().map(|(benchmark, _)| benchmark.name().to_owned()));
    let row = |name: &str| {
        let mut cells = vec![Cell::Text(name.to_owned())];
        cells.extend(problems.iter().map(|(_, points)| cell(points, name)));
        cells
    };
    Table { columns, rows: VARIANTS.iter().map(|variant| row(variant.name())).collect(), note }
}

/// Cost of an error, one row per method, one column per problem.
pub(super) fn reached(problems: &Problems, cost: Cost, error: f64, name: &str) -> Artifact {
    let note = format!(
        "Least {} at which a method reaches a relative error of {error}, between its own runs by straight lines in \
         logarithms; the cheapest run where that is good enough. –: not reached at the finest resolution.",
        cost.label()
    );
    let cell = |points: &[Measured], variant: &str| {
        let pairs = pairs(points, Some(variant), cost);
        Cell::Value(cost_at_error(&pairs, error).unwrap_or(f64::NAN))
    };
    let title = format!("Cost of an error of {} %", 100.0 * error);
    artifact(
        cost,
        &format!("wp_cost_of_{name}"),
        title,
        Content::Table(matrix(problems, cell, note)),
    )
}

/// Error at a cost, likewise.
pub(super) fn within_budget(problems: &Problems, cost: Cost) -> Artifact {
    let (budget, words) = cost.budget();
    let cell = |points: &[Measured], variant: &str| {
        let pairs = pairs(points, Some(variant), cost);
        Cell::Value(error_at_cost(&pairs, budget).unwrap_or(f64::NAN))
    };
    let note = format!(
        "Relative error that a method reaches with {words}; the least measured where its finest run is cheaper. –: its \
         coarsest run is dearer, or none completed."
    );
    let title = format!("Error within {words}");
    artifact(cost, "wp_error_in_budget", title, Content::Table(matrix(problems, cell, note)))
}
