//! Case `cylinder`: flow past a circular cylinder in a channel, the benchmarks 2D-1 (Re = 20, steady) and
//! 2D-2 (Re = 100, vortices are shed) of \[SchaeferTurek1996\].
//!
//! The channel is 4.1 D high with walls at rest; fluid enters with a parabolic profile of mean velocity U and
//! leaves through an outflow that lets sound out. The cylinder, 2 D behind the inlet and a little below the
//! axis, is the union of the cells whose centers it contains, with the radius of `radius.rs`; the label `body`
//! says which. The benchmark's channel is 22 D long; here
//! it ends 6 or 8 D behind the cylinder. Times are T = t U/D, forces C = F/(½ ρ₀ U² D).
//!
//! Layouts: `shedding-re100`, `steady-re20` (full tier), and `small-re20`, a short run on 6 cells per D.
//!
//! The force is the momentum that the nodes of the cylinder take from the fluid. Rows `drag` and `lift`: of the
//! running mean over 0.2 T from `measured-from` on, the `mean`, the root mean square `deviation` about it,
//! `noise`, that of what the running mean takes away, and where at least eight periods of the lift are there,
//! `max` and `min`, means over the periods of the largest and smallest value in each. `strouhal`: from the
//! first to the last upward crossing of the lift through its mean. `voids`: cells of the fluid without points.

mod cells;
mod figures;
mod march;
mod measure;
mod policy;
mod radius;
mod results;
mod scene;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use transpoint::scene::BodyShape;
use transpoint::{Settings, Variant};

use crate::case::{Case, Findings, RunSpec, Tier};
use crate::convergence::Order;
use crate::judge::Check;
use crate::progress::Progress;
use crate::record::RunRecord;
use crate::report::Artifact;
use march::Recording;
use policy::{RUNS, Run, VARIANTS};

/// Points per cell and axis.
const POINTS_PER_AXIS: usize = 2;

/// Everything that a run of this case depends on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// The library's variant.
    variant: Variant,
    /// U D/ν.
    reynolds: f64,
    /// Cells across the channel.
    cells_across: usize,
    /// Radius of the cylinder on the grid, m.
    radius: f64,
    /// Points per cell and axis.
    points_per_axis: usize,
    /// Length of the channel, D.
    length: f64,
    /// T at the end.
    end: f64,
    /// T from which on forces are measured.
    measured_from: f64,
    /// Settings of the solver.
    settings: Settings,
}

impl Parameters {
    fn new(run: &Run) -> Self {
        Self {
            variant: run.variant,
            reynolds: run.reynolds,
            cells_across: run.cells_across,
            radius: run.body.radius(scene::spacing(run.cells_across)),
            points_per_axis: POINTS_PER_AXIS,
            length: run.length,
            end: run.end,
            measured_from: run.measured_from,
            settings: policy::settings(run),
        }
    }

    /// The cylinder on the grid.
    fn shape(&self) -> BodyShape<2> {
        BodyShape::Ball { center: scene::CENTER, radius: self.radius }
    }
}

/// The case `cylinder`.
#[derive(Clone, Copy, Debug)]
pub struct Cylinder;

impl Case for Cylinder {
    fn name(&self) -> &'static str {
        "cylinder"
    }

    fn about(&self) -> &'static str {
        "flow past a cylinder in a channel with inlet and outflow: drag, lift and Strouhal number \
         [SchaeferTurek1996]"
    }

    fn variants(&self) -> Vec<&'static str> {
        VARIANTS.map(Variant::name).to_vec()
    }

    fn levels(&self) -> usize {
        2
    }

    fn policy(&self) -> String {
        policy::text()
    }

    fn runs(&self, tier: Tier) -> Vec<RunSpec> {
        RUNS.iter().filter(|run| run.tier <= tier).map(spec).collect()
    }

    fn execute(&self, spec: &RunSpec, progress: &Progress) -> Findings {
        match serde_json::from_value::<Parameters>(spec.parameters.clone()) {
            Ok(parameters) => march::execute(&parameters, progress),
            Err(error) => Findings::not_built(&error, measure::rows(&Recording::default())),
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
        case: "cylinder".to_owned(),
        variant: run.variant.name().to_owned(),
        layout: run.layout.to_owned(),
        labels: BTreeMap::from([("body".to_owned(), run.body.name().to_owned())]),
        level: run.level,
        spacing: scene::spacing(run.cells_across),
        // Plain data of numbers and names always has a JSON form.
        parameters: serde_json::to_value(Parameters::new(run)).unwrap_or_default(),
    }
}
