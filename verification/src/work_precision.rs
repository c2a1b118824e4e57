//! Speed against error: what each method costs on each problem, and what it gets for it.
//!
//! Two phases. The runs of [`Benchmark::sweep`] give the errors and the counters, which any machine reproduces:
//! touches, points times steps, and what follows from these with the state of a point (bytes) and with a snapshot of
//! counts (instructions). The timing runs of [`timing`] give seconds per step, of this machine: all methods in turns,
//! one thread, warm-up left out, the least of several. A run that blew up is a gap with its reason.

mod advice;
mod artifacts;
mod cost;
mod front;
mod instructions;
mod measured;
mod runs;
mod tables;
#[cfg(test)]
mod tests;
pub mod timing;

use std::path::Path;

use anyhow::{Context, Result};

pub use advice::{Advice, advise};
pub use cost::Cost;
pub use front::{cost_at_error, error_at_cost, front};
pub use measured::Measured;

use crate::benchmark::{self, Benchmark};
use crate::case::Case;
use crate::cli::SelectionArguments;
use crate::ingredients::{self, IngredientTimings, Ingredients};
use crate::plan::{Found, Plan};
use crate::record::RunRecord;
use crate::report::{self, Area};

/// The problems of the study as cases, and what is asked of ingredients.
pub fn cases() -> Vec<&'static dyn Case> {
    let problems = benchmark::ALL.iter().map(|benchmark| benchmark as &dyn Case);
    problems.chain([&Ingredients as &dyn Case]).collect()
}

/// The plan of the runs that give the errors.
///
/// # Errors
/// When a name does not exist.
pub fn error_plan(selection: &SelectionArguments) -> Result<Plan> {
    Plan::new(selection, &cases())
}

/// The plan of the runs that give the seconds; methods are timed together, so that all are.
///
/// # Errors
/// When a name does not exist.
pub fn timing_plan(selection: &SelectionArguments) -> Result<Plan> {
    let problems = timing::all().iter().map(|timing| timing as &dyn Case);
    let registry: Vec<&'static dyn Case> =
        problems.chain([&IngredientTimings as &dyn Case]).collect();
    let selection = SelectionArguments { variant: Vec::new(), ..selection.clone() };
    Plan::new(&selection, &registry)
}

/// What is on record, problem by problem, seconds where they are.
pub struct Study {
    /// Each problem with its measured points, in the order of the list.
    pub problems: Vec<(&'static Benchmark, Vec<Measured>)>,
    /// Records of the case `ingredients` and of its timings.
    pub ingredients: [Vec<RunRecord>; 2],
    /// What is missing, as a sentence.
    pub shortfall: Option<String>,
}

impl Study {
    /// Reads the records of both phases below the output folder.
    ///
    /// # Errors
    /// When there is no record of the first phase, or a file cannot be read.
    pub fn read(selection: &SelectionArguments) -> Result<Self> {
        let plan = error_plan(selection)?;
        let found = plan.find_records().context("no measured errors")?;
        let timings = timing_plan(selection)?.find_records().unwrap_or_default();
        let of_case = |found: &Found, name: &str| -> Vec<RunRecord> {
            found.records.iter().filter(|record| record.spec.case == name).cloned().collect()
        };
        let mut problems = Vec::new();
        for benchmark in &benchmark::ALL {
            let records = of_case(&found, benchmark.name());
            if !records.is_empty() {
                let seconds = of_case(&timings, benchmark.name());
                problems.push((benchmark, measured::collect(benchmark, &records, &seconds)));
            }
        }
        let name = Ingredients.name();
        let ingredients = [of_case(&found, name), of_case(&timings, name)];
        Ok(Self { problems, ingredients, shortfall: found.shortfall(&plan.out) })
    }

    /// Writes figures, tables and a page for each scale of cost: what any machine reproduces below
    /// `accuracy/work-precision/`, seconds below `timing/work-precision/`.
    ///
    /// # Errors
    /// When a file cannot be drawn or written.
    pub fn write(&self, out: &Path) -> Result<()> {
        for cost in Cost::ALL {
            let known = |(_, points): &(&Benchmark, Vec<Measured>)| {
                points.iter().any(|point| point.cost(cost).is_finite())
            };
            if !self.problems.iter().any(known) {
                continue;
            }
            let area = match cost.area() {
                Area::Accuracy => "accuracy",
                Area::Timing => "timing",
            };
            let folder = out.join(area).join("work-precision");
            let mut artifacts = artifacts::all(&self.problems, cost);
            let [records, timings] = &self.ingredients;
            if cost == Cost::Seconds && !timings.is_empty() {
                artifacts.extend(ingredients::timed_artifacts(records, timings));
            }
            let page = artifacts::page(&artifacts, cost);
            for artifact in &artifacts {
                report::write_artifact(&folder, artifact)?;
            }
            crate::record::write_whole(&folder.join(cost.page()), page.as_bytes())?;
        }
        Ok(())
    }
}
