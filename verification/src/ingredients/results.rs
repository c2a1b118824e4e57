//! From the records to a chart and a table.

use super::{INGREDIENTS, SCENES};
use crate::cases::errors;
use crate::record::RunRecord;
use crate::report::table::{Cell, Table};
use crate::report::{Area, Artifact, Content};
use crate::work_precision::timing::NORM;

/// Error, over that without the ingredient, and seconds per step, likewise; not numbers where they are not known.
struct Change {
    error: f64,
    relative_error: f64,
    relative_time: f64,
    reason: String,
}

fn change(records: &[RunRecord], timings: &[RunRecord], scene: &str, ingredient: &str) -> Change {
    let record = |name: &str| {
        records.iter().find(|record| {
            record.spec.label("scene") == scene && record.spec.label("ingredient") == name
        })
    };
    let error = |name: &str| {
        record(name).and_then(|record| record.rows.first()).map_or(f64::NAN, |row| row.value)
    };
    let timing = timings.iter().find(|record| record.spec.label("scene") == scene);
    let seconds = |name: &str| {
        timing.and_then(|record| record.row(name, NORM)).map_or(f64::NAN, |row| row.value)
    };
    let reason = record(ingredient).map_or("no record", |record| match &record.outcome {
        crate::case::Outcome::Completed => "",
        crate::case::Outcome::BlownUp { .. } => "burst",
        crate::case::Outcome::NotBuilt { .. } => "refused",
    });
    Change {
        error: error(ingredient),
        relative_error: error(ingredient) / error("none"),
        relative_time: seconds(ingredient) / seconds("none"),
        reason: reason.to_owned(),
    }
}

/// The table, and with timings the chart of both.
pub(super) fn artifacts(
    records: &[RunRecord],
    timings: &[RunRecord],
    policy: &str,
) -> Vec<Artifact> {
    let scenes: Vec<&str> = SCENES
        .into_iter()
        .filter(|scene| records.iter().any(|record| record.spec.label("scene") == *scene))
        .collect();
    let timed = !timings.is_empty();
    let mut columns = vec!["ingredient".to_owned(), "what".to_owned()];
    for scene in &scenes {
        columns.push(format!("{scene}: error"));
        columns.push(format!("{scene}: over that without"));
        if timed {
            columns.push(format!("{scene}: time over that without"));
        }
    }
    let row = |ingredient: &super::Ingredient| {
        let mut cells =
            vec![Cell::Text(ingredient.name.to_owned()), Cell::Text(ingredient.about.to_owned())];
        for scene in &scenes {
            let change = change(records, timings, scene, ingredient.name);
            if change.reason.is_empty() {
                cells.extend([Cell::Value(change.error), Cell::Decimal(change.relative_error)]);
            } else {
                cells.extend([Cell::Text(change.reason), Cell::Text("–".to_owned())]);
            }
            if timed {
                cells.push(Cell::Decimal(change.relative_time));
            }
        }
        cells
    };
    let table = Table {
        columns,
        rows: INGREDIENTS.iter().map(row).collect(),
        note: format!("{policy} Errors are the first of each problem."),
    };
    let title = "What each ingredient changes";
    let mut artifacts = vec![if timed {
        Artifact {
            area: Area::Timing,
            ..errors::artifact("ingredients_timed", title, Content::Table(table))
        }
    } else {
        errors::artifact("ingredients", title, Content::Table(table))
    }];
    if timed {
        artifacts.extend(scenes.iter().map(|scene| chart(records, timings, scene)));
    }
    artifacts
}

/// Bars of error and time over those without, one pair per ingredient.
fn chart(records: &[RunRecord], timings: &[RunRecord], scene: &str) -> Artifact {
    use crate::report::bars::{BarFigure, BarGroup};
    let groups = INGREDIENTS
        .iter()
        .skip(1)
        .map(|ingredient| {
            let change = change(records, timings, scene, ingredient.name);
            let note = if change.reason.is_empty() { String::new() } else { change.reason };
            BarGroup {
                label: ingredient.name.to_owned(),
                values: vec![change.relative_error, change.relative_time],
                note,
            }
        })
        .collect();
    let figure = BarFigure {
        title: format!("{scene}: what an ingredient changes"),
        axis: "over tpm-vp2 as it is (1: no change)".to_owned(),
        series: vec!["error".to_owned(), "time per step".to_owned()],
        groups,
        reference: 1.0,
    };
    let stem = format!("ingredients_{}", scene.replace('-', "_"));
    Artifact {
        stem,
        title: format!("{scene}: error and time with each ingredient"),
        area: Area::Timing,
        content: Content::Bars(figure),
    }
}
