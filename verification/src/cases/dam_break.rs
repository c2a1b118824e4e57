//! Case `dam-break`: a column of water collapses in a tank, §4.3 and Fig. 12-18 of \[Song2020\], beside
//! the experiment of \[Zhou1999\] and a volume-of-fluid computation \[Roenby2016\].
//!
//! The column, 1.2 m × 0.6 m, stands at the left wall of a tank 3.22 m long. The water runs to the far
//! wall, climbs it, falls back and closes a breaking wave. Times are T = t √(h₀ g)/l₀, pressures P =
//! p/(ρ₀ g h₀).
//!
//! Layouts: `dense` has cells of 20 mm and points 5 mm apart, `coarse` the same cells and one point in
//! each, `small` (smoke tier) cells of 60 mm and points 30 mm apart, `tank-3d` the same column 0.3 m deep
//! (full tier). `slab` steps the plane in two and three dimensions side by side; its rows are their
//! largest differences. The label `run` says how a run differs from the policy of all.
//!
//! The pressure on the far wall is the mean over the points in the last column of cells with a hat two
//! cells wide about the height. Rows `p-HEIGHT` and `p-disc`, the mean over the transducer of 90 mm: its
//! `arrival` (running mean over 0.05 T above 0.1), `mean` over 1.75 < T < 2.5, largest running mean before
//! 1.75 and in 2.5…3.5, `impulse` over 1.2 < T < 3.6, and `noise`, the root mean square of raw minus running
//! mean for T > 1.3. Rows `water`: first `wetting` of the wall at 160 mm, deviations from the
//! volume-of-fluid run on 10 mm cells, run-up, and `rebound`, the largest volume over width at x = 2.725 m
//! for T > 2.5. `fractures`: most cells that are empty although the fluid fills them, over the instants
//! written, one every 0.05 T.

mod claims;
mod figures;
mod maps;
mod march;
mod measure;
mod occupancy;
mod outside;
mod policy;
mod probe;
mod results;
mod scene;
mod slab;
mod state;
mod tables;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use transpoint::variants::Fields;
use transpoint::{Settings, Variant};

use crate::case::{Case, Findings, RunSpec, Tier};
use crate::convergence::Order;
use crate::judge::Check;
use crate::progress::Progress;
use crate::record::RunRecord;
use crate::report::Artifact;
use march::Recording;
use policy::{RUNS, Run, VARIANTS};
pub(super) use probe::{PLACES, Wall};
use scene::Shape;
pub(super) use scene::{SOUND_SPEED, scaled_time};

/// Everything that a run of this case depends on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// The library's variant.
    variant: Variant,
    /// What is simulated.
    shape: Shape,
    /// Cell size, m.
    spacing: f64,
    /// Points per cell and axis.
    points_per_axis: usize,
    /// T at the end; for the slab the number of steps.
    end: f64,
    /// Whether frames of an animation are kept.
    frames: bool,
    /// Settings of the solver.
    settings: Settings,
}

impl Parameters {
    fn new(run: &Run) -> Self {
        Self {
            variant: run.variant,
            shape: run.shape,
            spacing: run.spacing,
            points_per_axis: run.points_per_axis,
            end: run.end,
            frames: run.frames,
            settings: policy::settings(run),
        }
    }
}

/// The case `dam-break`.
#[derive(Clone, Copy, Debug)]
pub struct DamBreak;

impl Case for DamBreak {
    fn name(&self) -> &'static str {
        "dam-break"
    }

    fn about(&self) -> &'static str {
        "a column of water collapses in a tank: pressure on the far wall, fracture and rearrangement \
         (Fig. 13-18 of [Song2020])"
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
        let parameters = match serde_json::from_value::<Parameters>(spec.parameters.clone()) {
            Ok(parameters) => parameters,
            Err(error) => return Findings::not_built(&error, measure::rows(&Recording::default())),
        };
        let Parameters { variant, settings, .. } = parameters;
        match parameters.shape {
            Shape::Plane => march::execute::<2>(&parameters, progress, |scene| {
                variant.build_2d(scene, &settings)
            }),
            Shape::Tank => march::execute::<3>(&parameters, progress, |scene| {
                variant.build_3d(scene, &settings)
            }),
            Shape::Slab => slab::execute(&parameters, progress),
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

/// The run of a variant in the case `rivals`.
pub(super) fn rival(variant: Variant) -> RunSpec {
    spec(&policy::rival(variant, variant.parts().fields == Fields::Carried))
}

/// The tank with its column in the plane, on cells of `spacing` m.
pub(super) fn tank(spacing: f64, points_per_axis: usize) -> transpoint::Scene<2> {
    scene::scene(&Parameters {
        variant: Variant::Tpm,
        shape: Shape::Plane,
        spacing,
        points_per_axis,
        end: 0.0,
        frames: false,
        settings: Settings::default(),
    })
}

fn spec(run: &Run) -> RunSpec {
    RunSpec {
        case: "dam-break".to_owned(),
        variant: run.variant.name().to_owned(),
        layout: run.layout.to_owned(),
        labels: BTreeMap::from([("run".to_owned(), run.difference.name().to_owned())]),
        level: 0,
        spacing: run.spacing,
        // Plain data of numbers and names always has a JSON form.
        parameters: serde_json::to_value(Parameters::new(run)).unwrap_or_default(),
    }
}
