//! Case `jet-on-plate`: a steady plane jet of width b and speed U hits a flat plate at a right angle.
//!
//! Without viscosity and weight the pressure on the plate and the force ρ U² b are known, see
//! [`crate::exact::jet_on_plate`]. An inlet, a stagnation point, free surfaces and open faces in one flow
//! that has an exact answer. Times are T = t U/b.
//!
//! The box holds the exact flow at the start. Points follow hyperbolas past the stagnation point, so that the
//! corner between axis and plate runs empty, a void as large as the square root of the distance of points times
//! b: TPM fills such fractures. They open about T = 4 to 7, the later the finer the points.
//!
//! Layouts: `half`, one half of the jet beside a plane of symmetry, with points that slide in
//! ([`Supply::Flux`]); `columns`, with the two columns of \[Song2020\] ([`Supply::Columns`]); `shift`, points
//! pushed apart as well; `unfilled`, without filling; `blow`, a start with the jet alone, which hits the plate; `whole`, both halves; `near`
//! and `far`, the inlet at 1.5 b and 4.5 b instead of 3 b from the plate.
//!
//! Rows over 6 < T < 12: `force`, ∫ p dx over the plate by the points in the cells on it, over ρ U² b;
//! `force-by-momentum`, the flux of momentum through the layer of cells at 1.5 b above the plate,
//! which equals it in a steady flow; `stagnation`, the pressure in the cell on the axis; `wall-pressure`,
//! the L2 norm of the mean pressure minus the exact one over |x| ≤ 3 b, relative to that of the exact one;
//! `dry-share`, how often a cell on the plate within b of the axis had no points. `noise` is the root mean
//! square of raw minus running mean over 1 T, `drift` the mean of the second half of the window minus that
//! of the first. `steady-since` is the T from which on the running mean of the force stays within 2 % of the mean.

mod figures;
mod march;
mod plate;
mod results;
mod runs;
mod scene;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use transpoint::scene::Supply;
use transpoint::{Settings, Variant};

use crate::case::{Case, Findings, RunSpec, Tier};
use crate::convergence::Order;
use crate::judge::{Check, Miss};
use crate::progress::Progress;
use crate::record::RunRecord;
use crate::report::Artifact;
use runs::{CELLS, RUNS, Run, VARIANTS};
use scene::Start;

/// Everything that a run of this case depends on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// The library's variant.
    variant: Variant,
    /// Where the points come from.
    supply: Supply,
    /// What fills the box at the start.
    start: Start,
    /// Whether both halves of the jet are there.
    whole: bool,
    /// Cells across the jet.
    cells: usize,
    /// Distance of the inlet from the plate, b.
    distance: f64,
    /// T at the end.
    end: f64,
    /// Settings of the solver.
    settings: Settings,
}

impl Parameters {
    fn new(run: &Run) -> Self {
        Self {
            variant: run.variant,
            supply: run.supply,
            start: run.start,
            whole: run.whole,
            cells: CELLS[run.level],
            distance: run.distance,
            end: march::END,
            settings: runs::settings(run),
        }
    }
}

/// The case `jet-on-plate`.
#[derive(Clone, Copy, Debug)]
pub struct JetOnPlate;

impl Case for JetOnPlate {
    fn name(&self) -> &'static str {
        "jet-on-plate"
    }

    fn about(&self) -> &'static str {
        "a steady plane jet hits a plate: pressure on the plate and force against the exact ones \
         [MilneThomson1968]"
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
            Err(error) => Findings::not_built(&error, march::missing()),
        }
    }

    fn checks(&self, records: &[RunRecord]) -> Vec<Check> {
        results::checks(records)
    }

    fn misses(&self) -> &'static [Miss] {
        &results::MISSES
    }

    fn orders(&self, records: &[RunRecord]) -> Vec<Order> {
        results::orders(records)
    }

    fn artifacts(&self, records: &[RunRecord]) -> Vec<Artifact> {
        results::artifacts(records, &self.policy())
    }
}

fn spec(run: &Run) -> RunSpec {
    RunSpec {
        case: "jet-on-plate".to_owned(),
        variant: run.variant.name().to_owned(),
        layout: run.layout.to_owned(),
        labels: BTreeMap::new(),
        level: run.level,
        spacing: runs::spacing(run.level),
        // Plain data of numbers and names always has a JSON form.
        parameters: serde_json::to_value(Parameters::new(run)).unwrap_or_default(),
    }
}
