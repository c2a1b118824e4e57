//! Case `free-overfall`: a stream on a bed that ends; the depth at the brink is 0.715 of the critical depth.
//!
//! The ratio is measured \[Rouse1936\]; y_c = (q²/g)^{1/3} is the depth at which a stream of the discharge q
//! per width has the Froude number 1. Inlet, rigid body, free surfaces and open faces in one flow. The bed
//! is a slip body, beyond which the water falls out of the box. Times are T = t √(g/y_c).
//!
//! An inlet with a given velocity and depth asks for more than a subcritical stream can take: its depth
//! follows from the discharge and the brink. Hence the layouts: the same discharge comes in at the
//! critical depth (`fr1.00`), at 1.25 y_c (`fr0.72`) and at 1.5 y_c (`fr0.54`).
//!
//! Rows over the last 12 T: `brink`, the volume of the points in the two columns of cells beside the brink
//! over their width (`depth`), the highest point there (`top`) over y_c, and Σ V u there over q
//! (`discharge`); `upstream-N`, the same at N y_c upstream; `inflow`, mass that came in over ρ₀ q.

mod figures;
mod march;
mod results;
mod runs;
mod scene;
mod stream;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use transpoint::{Settings, Variant};

use crate::case::{Case, Findings, RunSpec, Tier};
use crate::convergence::Order;
use crate::judge::Check;
use crate::progress::Progress;
use crate::record::RunRecord;
use crate::report::Artifact;
use runs::{CELLS, RUNS, Run, VARIANTS};

/// Everything that a run of this case depends on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// The library's variant.
    variant: Variant,
    /// Cells in the critical depth.
    cells: usize,
    /// Cells in the depth of the inflow.
    inlet_cells: usize,
    /// T at the end.
    end: f64,
    /// Settings of the solver.
    settings: Settings,
}

impl Parameters {
    fn new(run: &Run) -> Self {
        let cells = CELLS[run.level];
        Self {
            variant: run.variant,
            cells,
            inlet_cells: cells * run.quarters / 4,
            end: run.end,
            settings: runs::settings(run),
        }
    }
}

/// The case `free-overfall`.
#[derive(Clone, Copy, Debug)]
pub struct FreeOverfall;

impl Case for FreeOverfall {
    fn name(&self) -> &'static str {
        "free-overfall"
    }

    fn about(&self) -> &'static str {
        "a stream falls over the end of its bed: depth at the brink over the critical depth against the \
         measured 0.715 [Rouse1936]"
    }

    fn variants(&self) -> Vec<&'static str> {
        VARIANTS.map(Variant::name).to_vec()
    }

    fn levels(&self) -> usize {
        CELLS.len()
    }

    fn policy(&self) -> String {
        runs::text()
    }

    fn runs(&self, tier: Tier) -> Vec<RunSpec> {
        RUNS.iter().filter(|run| run.tier <= tier).map(spec).collect()
    }

    fn execute(&self, spec: &RunSpec, progress: &Progress) -> Findings {
        match serde_json::from_value::<Parameters>(spec.parameters.clone()) {
            Ok(parameters) => march::execute(&parameters, progress),
            Err(error) => Findings::not_built(&error, march::missing(&Parameters::new(&RUNS[0]))),
        }
    }

    fn checks(&self, records: &[RunRecord]) -> Vec<Check> {
        results::checks(records)
    }

    fn orders(&self, _records: &[RunRecord]) -> Vec<Order> {
        Vec::new()
    }

    fn artifacts(&self, records: &[RunRecord]) -> Vec<Artifact> {
        results::artifacts(records, &self.policy())
    }
}

fn spec(run: &Run) -> RunSpec {
    RunSpec {
        case: "free-overfall".to_owned(),
        variant: run.variant.name().to_owned(),
        layout: run.layout.to_owned(),
        labels: BTreeMap::new(),
        level: run.level,
        spacing: runs::spacing(run.level),
        // Plain data of numbers and names always has a JSON form.
        parameters: serde_json::to_value(Parameters::new(run)).unwrap_or_default(),
    }
}
