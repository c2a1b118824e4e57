//! Case `channel`: water flows into an empty channel and out at its end, §4.4 and Fig. 19-21 of
//! \[Song2020\], beside a volume-of-fluid computation \[Roenby2016\].
//!
//! The channel is 2 m × 0.2 m. Water comes in on the left over the height h_in with the speed v₀ and leaves
//! on the right through a free face; the bed slips. The inlet plane is x = 0: the grid begins one column of
//! cells to the left of it, and that column belongs to the inlet. With the supply `columns` the second column,
//! from x = 0 on, is full at the start, so that the mass begins at ρ h_in h and not at zero.
//!
//! Layouts: `100mm` and `50mm` are the heights of the inlet, on cells of 20 and 12.5 mm; `coarse` (smoke tier) is
//! 100 mm on cells of 50 mm. The label `run` names the supply of points (and `outflow`, where the end face has the
//! velocity of the nodes next to it in place of no traction; `damped`, where points relax to PIC as fast as in the
//! dam break), `v0` the speed.
//!
//! Mass in the domain x ≥ 0, `mass`: Σ m of the points, each counted with the part of its square that lies
//! beyond the inlet plane. `grid-mass`: mass on the nodes by the quadrature, minus that of the inlet's column. Rows of both: `slope`, the least-squares dm/dt until the first point reaches the end of the channel,
//! over ρ₀ v₀ h_in; `deviation`, the largest distance from m(0) + ρ₀ v₀ h_in t in the same time over the mass at
//! its end; `mass@t`, and `vof@t` over that of the volume-of-fluid run on 5 mm cells. `front`: `outlet` is when
//! the first point leaves, `left` when 0.1 kg has left. `steady`: `since`, the first t from which on the mass
//! varies by less than 1 % within a second (up to the end of the run); `variation`, how much it does in the last
//! second; `growth@2`, m(3 s)/m(2 s) − 1. `energy`: `most`, the largest kinetic and potential energy, and
//! `over-head`, the largest of it per mass, over ½ v₀² + g h_in. `ledger`: largest imbalance of mass against
//! what came in and went out, in a `step` and over the `run`, relative.

mod claims;
mod figures;
mod march;
mod measure;
mod outside;
mod policy;
mod results;
mod scene;
mod state;
mod tables;
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
use scene::Outlet;

/// Everything that a run of this case depends on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// The library's variant.
    variant: Variant,
    /// Where the points of the inlet come from.
    supply: Supply,
    /// What holds at the end of the channel.
    outlet: Outlet,
    /// h_in, m.
    inlet_height: f64,
    /// v₀, m/s.
    speed: f64,
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
            outlet: run.outlet,
            inlet_height: run.inlet_height,
            speed: run.speed,
            spacing: run.spacing,
            points_per_axis: policy::POINTS_PER_AXIS,
            end: run.end,
            settings: policy::settings(run),
        }
    }

    /// Edge of a point's square, m.
    const fn edge(&self) -> f64 {
        self.spacing / self.points_per_axis as f64
    }

    /// ρ₀ v₀ h_in, kg/s per metre of depth.
    const fn flux(&self) -> f64 {
        scene::DENSITY * self.speed * self.inlet_height
    }

    /// ½ v₀² + g h_in: energy per mass of what comes in under hydrostatic pressure, J/kg.
    const fn head(&self) -> f64 {
        0.5 * self.speed * self.speed + scene::GRAVITY * self.inlet_height
    }

    /// Whether the volume-of-fluid run has the same inlet.
    fn is_that_of_vof(&self) -> bool {
        (self.inlet_height, self.speed) == (0.1, 0.4)
    }
}

/// The case `channel`.
#[derive(Clone, Copy, Debug)]
pub struct Channel;

impl Case for Channel {
    fn name(&self) -> &'static str {
        "channel"
    }

    fn about(&self) -> &'static str {
        "water flows into an empty channel and out at its end: mass, pressure and surface (Fig. 19-21 of \
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
            Ok(parameters) => march::execute(&parameters, progress),
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

/// The run of a variant in the case `rivals`.
pub(super) fn rival(variant: Variant) -> RunSpec {
    spec(&policy::rival(variant))
}

fn spec(run: &Run) -> RunSpec {
    RunSpec {
        case: "channel".to_owned(),
        variant: run.variant.name().to_owned(),
        layout: run.layout.to_owned(),
        labels: BTreeMap::from([
            ("run".to_owned(), run.name()),
            ("v0".to_owned(), run.speed.to_string()),
        ]),
        level: 0,
        spacing: run.spacing,
        // Plain data of numbers and names always has a JSON form.
        parameters: serde_json::to_value(Parameters::new(run)).unwrap_or_default(),
    }
}
