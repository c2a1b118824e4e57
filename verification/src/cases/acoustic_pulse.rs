//! Case `acoustic-pulse`: a Gaussian pressure pulse released from rest, in 1D and in 2D.
//!
//! Water (ρ₀ = 1000 kg/m³, c₀ = 50 m/s) fills a periodic box of 1 m with the bump
//! p = A exp(−a r²), a = 200/m² (standard deviation 50 mm), A = 10⁻⁶ ρ₀c₀², at its center.
//!
//! - `1d`: c₀t = 1.25 m, so that each half of the pulse has crossed the box once and stands a quarter
//!   aside; d'Alembert's solution, \[MorseIngard1968\].
//! - `2d`: c₀t = 0.25 m, before the ring meets its image: there the exact pressure is 4·10⁻⁶ A;
//!   Hankel's integral, \[MorseIngard1968\].
//!
//! Courant number c₀Δt/h = 0.2. The velocity stands half a step back (ADR 0006), at the start too:
//! v(−Δt/2) = (Δt/2ρ₀) ∇p up to a relative (ωΔt)²/24. Quantities are named `quantity@study`.
//!
//! Besides errors: the lag and the loss of the pulse in 1D, and in 2D how much the error on the
//! crest and in the trough of the ring depends on the angle.

mod measure;
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

/// Cells across the box in 1D, coarsest first.
const CELLS_1D: [usize; 5] = [32, 64, 128, 256, 512];
/// Cells across the box in 2D, coarsest first.
const CELLS_2D: [usize; 5] = [24, 32, 48, 64, 96];
/// Path c₀t of the sound in 1D and 2D, m.
const PATHS: [f64; 2] = [1.25, 0.25];
/// Courant number c₀Δt/h.
const COURANT: f64 = 0.2;
/// Seed of the jitter is this plus the level.
const SEED: u64 = 20_260_101;
/// Level in 2D whose pressures are kept as a profile.
const PROFILE_LEVEL: usize = 2;

/// On a regular lattice cell centers see central differences: second order. Set beforehand.
const ORDER_CHECKS: [LowerBound; 6] = [
    at_centers("pressure@1d"),
    at_centers("velocity@1d"),
    at_centers("pressure@2d"),
    at_centers("velocity@2d"),
    at_centers("pressure-on-axes@2d"),
    at_centers("pressure-on-diagonals@2d"),
];

const fn at_centers(quantity: &'static str) -> LowerBound {
    LowerBound { variant: "tpm", layout: "regular", quantity, norm: "gauss-l2", least: 1.8 }
}

/// Everything that a run of this case depends on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// 1 or 2.
    dimension: usize,
    /// Cells across the box.
    cells: usize,
    /// Time step, s.
    dt: f64,
    /// Steps.
    steps: u64,
    /// Largest displacement of a point, point spacings.
    jitter: f64,
    /// Seed of the displacements.
    seed: u64,
    /// Whether the pressures are kept as a profile.
    profile: bool,
    /// Settings of the solver.
    settings: Settings,
}

/// The case `acoustic-pulse`.
#[derive(Clone, Copy, Debug)]
pub struct AcousticPulse;

impl Case for AcousticPulse {
    fn name(&self) -> &'static str {
        "acoustic-pulse"
    }

    fn about(&self) -> &'static str {
        "Gaussian pressure pulse from rest in 1D and 2D: order, dispersion, isotropy [MorseIngard1968]"
    }

    fn levels(&self) -> usize {
        CELLS_1D.len()
    }

    fn policy(&self) -> String {
        format!(
            "All variants: {:?}. Courant number {COURANT}; 2 points per cell and axis; jitter \
             ±{JITTER} of the point spacing, Pcg64 seeded with {SEED} + level.",
            Settings::default()
        )
    }

    /// Smoke: `tpm` on regular points, whose orders are checked, and all else on the coarsest level.
    fn runs(&self, tier: Tier) -> Vec<RunSpec> {
        let mut runs = Vec::new();
        for variant in Variant::CORE {
            for layout in LAYOUTS {
                for dimension in [1, 2] {
                    let checked = variant == Variant::Tpm && layout == LAYOUTS[0];
                    let all = tier != Tier::Smoke || checked;
                    for level in 0..if all { self.levels() } else { 1 } {
                        runs.push(spec(variant, layout, dimension, level));
                    }
                }
            }
        }
        runs
    }

    fn execute(&self, spec: &RunSpec, progress: &Progress) -> Findings {
        let rows = measure::missing_rows(spec.label("study"));
        let variant = match Variant::parse(&spec.variant) {
            Ok(variant) => variant,
            Err(error) => return Findings::not_built(&error, rows),
        };
        let parameters = match serde_json::from_value::<Parameters>(spec.parameters.clone()) {
            Ok(parameters) => parameters,
            Err(error) => return Findings::not_built(&error, rows),
        };
        let settings = &parameters.settings;
        match parameters.dimension {
            1 => scene::execute(&parameters, progress, measure::line, |scene| {
                variant.build_1d(scene, settings)
            }),
            2 => scene::execute(&parameters, progress, measure::plane, |scene| {
                variant.build_2d(scene, settings)
            }),
            other => Findings::not_built(&format!("dimension {other}"), rows),
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

fn study(dimension: usize) -> &'static str {
    if dimension == 1 { "1d" } else { "2d" }
}

fn spec(variant: Variant, layout: &str, dimension: usize, level: usize) -> RunSpec {
    let cells = if dimension == 1 { CELLS_1D[level] } else { CELLS_2D[level] };
    let spacing = 1.0 / cells as f64;
    // All paths are whole numbers of steps.
    let steps = (PATHS[dimension - 1] / (COURANT * spacing)).round() as u64;
    let parameters = Parameters {
        dimension,
        cells,
        dt: COURANT * spacing / scene::SOUND_SPEED,
        steps,
        jitter: lattice::jitter(layout),
        seed: SEED + level as u64,
        profile: dimension == 2 && level == PROFILE_LEVEL,
        settings: Settings::default(),
    };
    RunSpec {
        case: "acoustic-pulse".to_owned(),
        variant: variant.name().to_owned(),
        layout: layout.to_owned(),
        labels: BTreeMap::from([("study".to_owned(), study(dimension).to_owned())]),
        level,
        spacing,
        // Plain data of numbers and names always has a JSON form.
        parameters: serde_json::to_value(parameters).unwrap_or_default(),
    }
}
