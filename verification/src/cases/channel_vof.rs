//! Case `channel-vof`: the outline of viscous water that flows into a short channel, Fig. 22 of
//! \[Song2020\], beside volume-of-fluid computations \[Roenby2016\].
//!
//! The channel is 0.06 m × 0.01 m, water comes in on the left with 0.05 m/s, Re = 500 on the height, and leaves
//! through a free face on the right. The paper prints neither the height of the inlet nor gravity nor what
//! holds on the bed. The label `flow` says what was assumed: `full-noslip` (inlet over the full height, gravity,
//! no-slip bed) is what fits its figure; the others are shown beside. The inlet plane is x = 0, as in `channel`.
//!
//! Layouts name the size of the cells; the label `supply` where points come from. A place is wet where the
//! fluid's share of the cells, bilinear between their centers, is at least ½, and where it is enclosed by such
//! places; the same for every method. Rows `outline@t`: `difference`, the area that is wet in exactly one of the
//! run and the volume-of-fluid run of the same flow on cells of 0.25 mm, over that wet in the latter; `front`, the
//! largest x that is wet over that of the volume-of-fluid run; `area`, the wet areas likewise; `reach`, the front in
//! m; with `-fine` against the volume-of-fluid run on 0.125 mm, where there is one.

mod outline;
mod policy;
mod results;
mod run;
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
use policy::{RUNS, Run, VARIANTS};
use scene::Flow;

/// Everything that a run of this case depends on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// The library's variant.
    variant: Variant,
    /// Where the points of the inlet come from.
    supply: Supply,
    /// What is assumed of inlet, gravity and bed.
    flow: Flow,
    /// Cell size, m.
    spacing: f64,
    /// Points per cell and axis.
    points_per_axis: usize,
    /// Time at the end, s.
    end: f64,
    /// Settings of the solver.
    settings: Settings,
}

impl Parameters {
    fn new(run: &Run) -> Self {
        Self {
            variant: run.variant,
            supply: run.supply,
            flow: run.flow,
            spacing: run.spacing,
            points_per_axis: policy::POINTS_PER_AXIS,
            end: run.end,
            settings: policy::settings(run),
        }
    }
}

/// The case `channel-vof`.
#[derive(Clone, Copy, Debug)]
pub struct ChannelVof;

impl Case for ChannelVof {
    fn name(&self) -> &'static str {
        "channel-vof"
    }

    fn about(&self) -> &'static str {
        "outline of viscous water that flows into a short channel, beside volume-of-fluid runs (Fig. 22 of \
         [Song2020])"
    }

    fn variants(&self) -> Vec<&'static str> {
        VARIANTS.map(Variant::name).to_vec()
    }

    fn levels(&self) -> usize {
        1
    }

    fn policy(&self) -> String {
        policy::text()
    }

    fn runs(&self, tier: Tier) -> Vec<RunSpec> {
        RUNS.iter().filter(|run| run.tier <= tier).map(spec).collect()
    }

    fn execute(&self, spec: &RunSpec, progress: &Progress) -> Findings {
        match serde_json::from_value::<Parameters>(spec.parameters.clone()) {
            Ok(parameters) => run::execute(&parameters, progress),
            Err(error) => Findings::not_built(&error, Vec::new()),
        }
    }

    fn checks(&self, records: &[RunRecord]) -> Vec<Check> {
        results::checks(records)
    }

    fn misses(&self) -> &'static [Miss] {
        &results::MISSES
    }

    fn orders(&self, _records: &[RunRecord]) -> Vec<Order> {
        Vec::new()
    }

    fn artifacts(&self, records: &[RunRecord]) -> Vec<Artifact> {
        results::artifacts(records, &self.policy())
    }
}

fn spec(run: &Run) -> RunSpec {
    let supply = if run.supply == Supply::Flux { "flux" } else { "columns" };
    RunSpec {
        case: "channel-vof".to_owned(),
        variant: run.variant.name().to_owned(),
        layout: run.layout.to_owned(),
        labels: BTreeMap::from([
            ("flow".to_owned(), run.flow.name().to_owned()),
            ("supply".to_owned(), supply.to_owned()),
        ]),
        level: 0,
        spacing: run.spacing,
        // Plain data of numbers and names always has a JSON form.
        parameters: serde_json::to_value(Parameters::new(run)).unwrap_or_default(),
    }
}
