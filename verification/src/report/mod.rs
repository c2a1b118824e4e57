//! The report: a pure function of the record files.
//!
//! `accuracy/` holds what any machine reproduces (no times, no machine facts) and is committed;
//! `timing/` holds what belongs to this machine and is not.

pub mod animation;
pub mod axis;
pub mod bars;
pub mod map;
pub mod page;
pub mod palette;
pub mod plot;
pub mod raster;
pub mod style;
pub mod table;

use std::path::Path;

use anyhow::Result;
use serde::Serialize;

use crate::case::Case;
use crate::case::Outcome;
use crate::convergence::Order;
use crate::judge::Check;
use crate::number::{bound, significant};
use crate::plan::Plan;
use crate::record::{RunRecord, tidy_csv, write_whole};
use animation::Animation;
use bars::BarFigure;
use map::MapFigure;
use plot::Figure;
use table::Table;

/// Where an artifact belongs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Area {
    /// Reproducible anywhere.
    Accuracy,
    /// Of this machine.
    Timing,
}

/// What an artifact is.
#[derive(Clone, Debug, PartialEq)]
pub enum Content {
    /// Written as SVG and PNG to `figures/`.
    Figure(Figure),
    /// Written as SVG and PNG to `figures/`.
    Maps(MapFigure),
    /// Written as SVG and PNG to `figures/`.
    Bars(BarFigure),
    /// Written as a PNG file with several frames to `animations/`.
    Animation(Animation),
    /// Written as CSV and Markdown to `tables/`.
    Table(Table),
    /// Written as CSV to `profiles/`: sampled curves side by side, too long for a page.
    Profiles(Table),
}

/// A figure, animation or table of a case.
#[derive(Clone, Debug, PartialEq)]
pub struct Artifact {
    /// File name without its ending.
    pub stem: String,
    /// Heading on the page.
    pub title: String,
    /// Where it belongs.
    pub area: Area,
    /// What it is.
    pub content: Content,
}

/// Columns of `accuracy/checks.csv`.
pub const CHECK_COLUMNS: [&str; 8] =
    ["case", "variant", "layout", "check", "measured", "lower", "upper", "verdict"];
/// Columns of `accuracy/orders.csv`.
pub const ORDER_COLUMNS: [&str; 8] =
    ["case", "variant", "layout", "quantity", "norm", "order", "order_last", "levels"];
/// Columns of `accuracy/events.csv`.
pub const EVENT_COLUMNS: [&str; 7] =
    ["case", "variant", "layout", "run", "event", "step", "reason"];
/// Columns of `timing/runs.csv`.
const TIMING_COLUMNS: [&str; 9] = [
    "case",
    "variant",
    "layout",
    "run",
    "seconds",
    "seconds_per_point_step",
    "workers",
    "threads_per_run",
    "cpu",
];

/// The verdicts of all cases of a plan.
pub fn checks(plan: &Plan, records: &[RunRecord]) -> Vec<Check> {
    plan.cases.iter().flat_map(|&case| checks_of(case, &of_case(records, case.name()))).collect()
}

/// The verdicts of a case on its own records, with what is known to miss.
fn checks_of(case: &dyn Case, records: &[RunRecord]) -> Vec<Check> {
    let mut checks = case.checks(records);
    for check in &mut checks {
        let miss = case.misses().iter().find(|miss| miss.is_of(check));
        check.miss = miss.map(|miss| miss.reason);
    }
    checks
}

/// A check with its verdict spelt out, for JSON.
#[derive(Debug, Serialize)]
pub struct Judged<'a> {
    #[serde(flatten)]
    check: &'a Check,
    verdict: &'static str,
}

/// Adds the verdicts.
pub fn judged(checks: &[Check]) -> Vec<Judged<'_>> {
    checks.iter().map(|check| Judged { check, verdict: check.verdict() }).collect()
}

/// Writes everything below the output folder of the plan.
///
/// # Errors
/// When a file cannot be drawn or written.
pub fn write(plan: &Plan, records: &[RunRecord]) -> Result<()> {
    let accuracy = plan.out.join("accuracy");
    let timing = plan.out.join("timing");
    let mut orders = Vec::new();
    let mut chapters = Vec::new();
    for case in &plan.cases {
        let own = of_case(records, case.name());
        if own.is_empty() {
            continue;
        }
        orders.extend(case.orders(&own));
        let artifacts = case.artifacts(&own);
        for artifact in &artifacts {
            let folder = if artifact.area == Area::Accuracy { &accuracy } else { &timing };
            write_artifact(folder, artifact)?;
        }
        let checks = checks_of(*case, &own);
        write_whole(
            &accuracy.join("errors").join(format!("{}.csv", case.name())),
            &tidy_csv(&own)?,
        )?;
        chapters.push(page::Chapter { name: case.name(), about: case.about(), artifacts, checks });
    }
    let checks = checks(plan, records);
    write_rows(&accuracy.join("checks.csv"), &CHECK_COLUMNS, check_rows(&checks))?;
    write_rows(&accuracy.join("orders.csv"), &ORDER_COLUMNS, order_rows(&orders))?;
    let events = event_rows(records);
    write_rows(&accuracy.join("events.csv"), &EVENT_COLUMNS, events.clone())?;
    write_rows(&timing.join("runs.csv"), &TIMING_COLUMNS, timing_rows(records))?;
    write_whole(&accuracy.join("README.md"), page::render(&chapters, &events).as_bytes())
}

fn of_case(records: &[RunRecord], name: &str) -> Vec<RunRecord> {
    records.iter().filter(|record| record.spec.case == name).cloned().collect()
}

/// Writes one artifact below a folder.
///
/// # Errors
/// When it cannot be drawn or written.
pub fn write_artifact(folder: &Path, artifact: &Artifact) -> Result<()> {
    match &artifact.content {
        Content::Figure(figure) => write_figure(folder, &artifact.stem, &plot::svg(figure)?),
        Content::Maps(figure) => write_figure(folder, &artifact.stem, &map::svg(figure)?),
        Content::Bars(figure) => write_figure(folder, &artifact.stem, &bars::svg(figure)?),
        Content::Animation(animation) => {
            let path = folder.join("animations").join(&artifact.stem);
            write_whole(&path.with_extension("png"), &animation::png(animation)?)
        }
        Content::Profiles(table) => {
            let path = folder.join("profiles").join(&artifact.stem);
            write_whole(&path.with_extension("csv"), &table.csv()?)
        }
        Content::Table(table) => {
            let path = folder.join("tables").join(&artifact.stem);
            write_whole(&path.with_extension("csv"), &table.csv()?)?;
            let text = format!("# {}\n\n{}", artifact.title, table.markdown());
            write_whole(&path.with_extension("md"), text.as_bytes())
        }
    }
}

fn write_figure(folder: &Path, stem: &str, svg: &str) -> Result<()> {
    let path = folder.join("figures").join(stem);
    write_whole(&path.with_extension("svg"), svg.as_bytes())?;
    write_whole(&path.with_extension("png"), &raster::png(svg)?)
}

fn write_rows(path: &Path, columns: &[&str], rows: Vec<Vec<String>>) -> Result<()> {
    write_whole(path, &table::csv(columns, rows.into_iter())?)
}

/// Checks as rows of text.
pub fn check_rows(checks: &[Check]) -> Vec<Vec<String>> {
    let row = |check: &Check| {
        vec![
            check.case.clone(),
            check.variant.clone(),
            check.layout.clone(),
            check.check.clone(),
            significant(check.measured),
            bound(check.lower),
            bound(check.upper),
            check.verdict().to_owned(),
        ]
    };
    checks.iter().map(row).collect()
}

fn order_rows(orders: &[Order]) -> Vec<Vec<String>> {
    let row = |order: &Order| {
        vec![
            order.case.clone(),
            order.variant.clone(),
            order.layout.clone(),
            order.quantity.clone(),
            order.norm.clone(),
            significant(order.order),
            significant(order.order_last),
            order.levels.to_string(),
        ]
    };
    orders.iter().map(row).collect()
}

/// Runs that did not complete.
fn event_rows(records: &[RunRecord]) -> Vec<Vec<String>> {
    let row = |record: &RunRecord| {
        let (event, step, reason) = match &record.outcome {
            Outcome::Completed => return None,
            Outcome::BlownUp { step, reason, .. } => ("blown-up", (step + 1).to_string(), reason),
            Outcome::NotBuilt { reason } => ("not-built", String::new(), reason),
        };
        let spec = &record.spec;
        let names = [&spec.case, &spec.variant, &spec.layout, &spec.slug()].map(String::clone);
        Some([&names[..], &[event.to_owned(), step, reason.clone()]].concat())
    };
    records.iter().filter_map(row).collect()
}

fn timing_rows(records: &[RunRecord]) -> Vec<Vec<String>> {
    let row = |record: &RunRecord| {
        vec![
            record.spec.case.clone(),
            record.spec.variant.clone(),
            record.spec.layout.clone(),
            record.spec.slug(),
            significant(record.seconds),
            significant(record.seconds_per_point_step()),
            record.manifest.workers.to_string(),
            record.manifest.threads_per_run.to_string(),
            record.manifest.cpu.clone(),
        ]
    };
    records.iter().map(row).collect()
}

#[cfg(test)]
mod tests;
