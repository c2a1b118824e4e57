//! Case `elastic-bar`: a standing longitudinal wave in an elastic bar between fixed ends, \[Graff1975\].
//!
//! A linear elastic solid in uniaxial strain (ρ₀ = 1000 kg/m³, K = ρ₀c₀² with c₀ = 50 m/s, G = ¾ K,
//! so that the wave speed is √2 c₀) fills 0 ≤ x ≤ 1 m between slip walls in 1D and starts with
//! v = V sin(2πx/L) without stress; the strain is at most 10⁻⁷.
//!
//! Errors of pressure, axial deviatoric stress and velocity, named `quantity@instant`: at `T/4` the
//! stress is largest and the velocity zero, at `T` the reverse. Courant number cΔt/h = 0.2. The
//! velocity stands half a step back (ADR 0006). `phase` and `loss` at T: by how much the frequency is
//! too high and the amplitude too low, from the shares of the exact mode in the points' values. At T an
//! error of the frequency enters the velocity only times ωΔt/2, so that its order there may be 3; at
//! T/4 it enters in full.

mod results;
mod scene;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use transpoint::{Settings, Variant};

use super::errors::{LowerBound, NORMS, order_checks};
use super::lattice::{self, JITTER, LAYOUTS};
use crate::case::{Case, Findings, RunSpec, Tier};
use crate::convergence::{self, Order};
use crate::judge::Check;
use crate::progress::Progress;
use crate::record::RunRecord;
use crate::report::Artifact;

/// Cells along the bar, coarsest first.
const CELLS: [usize; 5] = [16, 32, 64, 128, 256];
/// Courant number cΔt/h.
const COURANT: f64 = 0.2;
/// Seed of the jitter is this plus the level.
const SEED: u64 = 20_260_103;

/// On a regular lattice the velocity and all fields at cell centers are of second order; stresses at
/// points are of first order, since linear functions have one gradient per cell. Set beforehand.
const ORDER_CHECKS: [LowerBound; 7] = [
    bound("velocity@T/4", "point-l2", 1.8),
    bound("velocity@T", "point-l2", 1.8),
    bound("velocity@T", "gauss-l2", 1.8),
    bound("pressure@T/4", "gauss-l2", 1.8),
    bound("deviatoric@T/4", "gauss-l2", 1.8),
    bound("pressure@T/4", "point-l2", 0.9),
    bound("deviatoric@T/4", "point-l2", 0.9),
];

const fn bound(quantity: &'static str, norm: &'static str, least: f64) -> LowerBound {
    LowerBound { variant: "tpm", layout: "regular", quantity, norm, least }
}

/// Everything that a run of this case depends on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// Cells along the bar.
    cells: usize,
    /// Time step, s.
    dt: f64,
    /// Steps of a quarter of a period.
    quarter: u64,
    /// Largest displacement of a point, point spacings.
    jitter: f64,
    /// Seed of the displacements.
    seed: u64,
    /// Settings of the solver.
    settings: Settings,
}

/// The case `elastic-bar`.
#[derive(Clone, Copy, Debug)]
pub struct ElasticBarWave;

impl Case for ElasticBarWave {
    fn name(&self) -> &'static str {
        "elastic-bar"
    }

    fn about(&self) -> &'static str {
        "standing longitudinal wave in an elastic bar, orders and frequency [Graff1975]"
    }

    fn levels(&self) -> usize {
        CELLS.len()
    }

    fn policy(&self) -> String {
        format!(
            "All variants: {:?}. Courant number {COURANT}; 2 points per cell; jitter ±{JITTER} of \
             the point spacing, Pcg64 seeded with {SEED} + level.",
            Settings::default()
        )
    }

    /// Smoke: `tpm` on regular points, whose orders are checked, and all else on the coarsest level.
    fn runs(&self, tier: Tier) -> Vec<RunSpec> {
        let mut runs = Vec::new();
        for variant in Variant::CORE {
            for layout in LAYOUTS {
                let checked = variant == Variant::Tpm && layout == LAYOUTS[0];
                let levels = if tier == Tier::Smoke && !checked { 1 } else { CELLS.len() };
                runs.extend((0..levels).map(|level| spec(variant, layout, level)));
            }
        }
        runs
    }

    fn execute(&self, spec: &RunSpec, progress: &Progress) -> Findings {
        let variant = match Variant::parse(&spec.variant) {
            Ok(variant) => variant,
            Err(error) => return Findings::not_built(&error, scene::missing_rows()),
        };
        match serde_json::from_value::<Parameters>(spec.parameters.clone()) {
            Ok(parameters) => scene::execute(&parameters, progress, |scene| {
                variant.build_1d(scene, &parameters.settings)
            }),
            Err(error) => Findings::not_built(&error, scene::missing_rows()),
        }
    }

    fn checks(&self, records: &[RunRecord]) -> Vec<Check> {
        order_checks(&self.orders(records), &ORDER_CHECKS)
    }

    fn orders(&self, records: &[RunRecord]) -> Vec<Order> {
        let mut orders = convergence::orders(records);
        orders.retain(|order| NORMS.contains(&order.norm.as_str()));
        orders
    }

    fn artifacts(&self, records: &[RunRecord]) -> Vec<Artifact> {
        results::artifacts(records, &self.policy())
    }
}

fn spec(variant: Variant, layout: &str, level: usize) -> RunSpec {
    let cells = CELLS[level];
    let bar = scene::BAR;
    let spacing = bar.length / cells as f64;
    let quarter_period = 0.25 * bar.period();
    // A whole number of steps at all levels.
    let quarter = (quarter_period * bar.wave_speed() / (COURANT * spacing)).round() as u64;
    let parameters = Parameters {
        cells,
        dt: quarter_period / quarter as f64,
        quarter,
        jitter: lattice::jitter(layout),
        seed: SEED + level as u64,
        settings: Settings::default(),
    };
    RunSpec {
        case: "elastic-bar".to_owned(),
        variant: variant.name().to_owned(),
        layout: layout.to_owned(),
        labels: BTreeMap::new(),
        level,
        spacing,
        // Plain data of numbers and names always has a JSON form.
        parameters: serde_json::to_value(parameters).unwrap_or_default(),
    }
}
