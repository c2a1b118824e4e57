//! Case `spectral`: growth per step of the linearised solver at frozen, disordered points.
//!
//! A step uses the positions at its start and moves the points only at its end. One step from a
//! perturbed state of rest is therefore a map of velocities, densities and affine fields at frozen
//! positions, and its Jacobian A is found by differences of the actual solver. If the spectral
//! radius ρ(A) exceeds 1, some disturbance of a fluid at rest grows in every step, at whatever
//! resolution. The points of a flow do move, so growth slower than their rearrangement may stay
//! unseen; but what is neutral here cannot blow up by itself.
//!
//! All is without units: cell size, reference density and speed of sound are 1. All boxes are
//! periodic. `1d` and `1d-mild` have 16 cells and 2 points per cell, displaced by up to 0.9 or 0.45
//! of their spacing; `2d` and `2d-strong` have 4 by 4 cells and 4 points per cell, displaced by up
//! to 0.5 or 0.9 of their spacing along each axis. Layouts with an empty cell are drawn again. The
//! Courant number is c Δt √D / h, 1 being the limit of full cells.
//!
//! The label `setting` names when density is updated (`usf` first, `usl` last, `musl` modified
//! last, \[Bardenhagen2002\]) and, for the velocity-pressure formulation, how the divergence
//! reaches the points.
//!
//! The force of that formulation is the adjoint of the *cell* divergence, not of the divergence
//! interpolated to the points. The work of pressure would balance exactly with the adjoint of the
//! whole chain nodes → cells → points, but then constant pressure would push disordered points; the
//! plain gradient of cell pressures is what keeps a fluid at rest. The price is that the points'
//! densities enter the force by a fit at the cell centres that is not the transpose of the
//! interpolation. Fit after interpolation acts on the pressure increment as a filter; where it is
//! not symmetric, squared frequencies can be complex and disturbances grow at a rate per time,
//! whatever the step; where it filters an oscillation of the cells out altogether (the vertex mean
//! does), a pressure of that form drives a velocity that nothing opposes, and grows linearly.
//! Stress updated last damps by (ω Δt)² per step, which outweighs the former but for small steps.

mod growth;
mod results;
mod step;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use transpoint::formulation::PointDivergence;
use transpoint::variants::StressUpdate;
use transpoint::{Settings, Variant};

use crate::case::{Case, Findings, RunSpec, Tier};
use crate::convergence::Order;
use crate::judge::Check;
use crate::progress::Progress;
use crate::record::RunRecord;
use crate::report::Artifact;
pub(super) use growth::of_one_period;
use growth::{measure, missing_rows};
pub(super) use step::{Step, scene as full_box};

/// Courant numbers c Δt √D / h.
const COURANTS: [f64; 7] = [0.03, 0.1, 0.3, 0.5, 0.7, 0.9, 1.0];
/// Largest growth per step that counts as neutral.
const NEUTRAL: f64 = 1e-10;
/// Least doubling of the powers that counts as growth: half way between bounded and linear.
const LINEAR: f64 = 0.5;
/// Growth up to this with linearly growing powers is a defective eigenvalue 1, moved by round-off.
const DEFECTIVE: f64 = 1e-6;
/// Seed of the layout is this plus its number.
const SEED: u64 = 20_260_501;
/// Layouts: name, dimension, cells per axis, jitter.
const LAYOUTS: [(&str, usize, usize, f64); 4] =
    [("1d", 1, 16, 0.9), ("1d-mild", 1, 16, 0.45), ("2d", 2, 4, 0.5), ("2d-strong", 2, 4, 0.9)];

/// Everything that a run of this case depends on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// 1 or 2.
    dimension: usize,
    /// Cells per axis.
    cells: usize,
    /// Largest displacement of a point along each axis, point spacings.
    jitter: f64,
    /// Number of layouts.
    seeds: u64,
    /// Courant numbers.
    courants: Vec<f64>,
    /// Settings of the solver.
    settings: Settings,
}

/// The case `spectral`.
#[derive(Clone, Copy, Debug)]
pub struct Spectral;

impl Case for Spectral {
    fn name(&self) -> &'static str {
        "spectral"
    }

    fn about(&self) -> &'static str {
        "growth per step of the linearised solver at frozen, disordered points"
    }

    fn levels(&self) -> usize {
        1
    }

    fn policy(&self) -> String {
        format!(
            "Unless the setting says otherwise: {:?}. Periodic boxes, 2 points per cell and axis; \
             1d, 1d-mild: 16 cells, jitter ±0.9, ±0.45 of the point spacing; 2d, 2d-strong: 4 by 4 \
             cells, jitter ±0.5, ±0.9; no empty cell; Pcg64 seeded with {SEED} + number of the \
             layout. Courant number C = c Δt √D / h.",
            Settings::default()
        )
    }

    fn runs(&self, tier: Tier) -> Vec<RunSpec> {
        let mut runs = Vec::new();
        for (layout, ..) in LAYOUTS {
            // The strongest disorder in 2D is only in the full tier, the mild one in 1D not in smoke.
            if (layout == "2d-strong" && tier != Tier::Full)
                || (layout == "1d-mild" && tier == Tier::Smoke)
            {
                continue;
            }
            for variant in Variant::CORE {
                for settings in settings_of(variant, tier) {
                    runs.push(spec(variant, layout, settings, tier));
                }
            }
        }
        runs
    }

    fn execute(&self, spec: &RunSpec, progress: &Progress) -> Findings {
        let parameters = match serde_json::from_value::<Parameters>(spec.parameters.clone()) {
            Ok(parameters) => parameters,
            Err(error) => return Findings::not_built(&error, Vec::new()),
        };
        let variant = match Variant::parse(&spec.variant) {
            Ok(variant) => variant,
            Err(error) => return Findings::not_built(&error, missing_rows(&parameters)),
        };
        let measured = match parameters.dimension {
            1 => measure::<1>(variant, &parameters, Variant::build_1d, progress),
            2 => measure::<2>(variant, &parameters, Variant::build_2d, progress),
            other => Err(format!("dimension {other}")),
        };
        measured.unwrap_or_else(|reason| Findings::not_built(&reason, missing_rows(&parameters)))
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

/// The settings under study: every order of the stress update and every divergence at the points.
fn settings_of(variant: Variant, tier: Tier) -> Vec<Settings> {
    let usual = Settings::default();
    let mut orders = vec![StressUpdate::Last, StressUpdate::ModifiedLast];
    if tier == Tier::Full {
        orders.push(StressUpdate::First);
    }
    let kinds = [
        PointDivergence::VertexMean,
        PointDivergence::Quadratic,
        PointDivergence::Linear,
        PointDivergence::Constant,
    ];
    let kinds = if variant == Variant::TpmVp { &kinds[..] } else { &[usual.point_divergence] };
    kinds
        .iter()
        .flat_map(|&point_divergence| {
            orders.iter().map(move |&stress_update| Settings {
                stress_update,
                point_divergence,
                ..usual
            })
        })
        .filter(|settings| tier != Tier::Smoke || *settings == usual)
        .collect()
}

/// Name of the settings that differ between runs.
fn setting(variant: Variant, settings: &Settings) -> String {
    let order = match settings.stress_update {
        StressUpdate::First => "usf",
        StressUpdate::Last => "usl",
        StressUpdate::ModifiedLast => "musl",
    };
    let kind = match settings.point_divergence {
        PointDivergence::Constant => "constant",
        PointDivergence::Linear => "linear",
        PointDivergence::Quadratic => "quadratic",
        PointDivergence::VertexMean => "vertex-mean",
    };
    if variant == Variant::TpmVp { format!("{kind}/{order}") } else { order.to_owned() }
}

fn spec(variant: Variant, layout: &str, settings: Settings, tier: Tier) -> RunSpec {
    let (_, dimension, cells, jitter) =
        LAYOUTS.into_iter().find(|known| known.0 == layout).unwrap_or(LAYOUTS[0]);
    let smoke = tier == Tier::Smoke;
    let seeds = if !smoke {
        10
    } else if dimension == 1 {
        3
    } else {
        1
    };
    let courants = if smoke { vec![0.5] } else { COURANTS.to_vec() };
    let parameters = Parameters { dimension, cells, jitter, seeds, courants, settings };
    let usual = if settings == Settings::default() { "yes" } else { "no" };
    RunSpec {
        case: "spectral".to_owned(),
        variant: variant.name().to_owned(),
        layout: layout.to_owned(),
        labels: BTreeMap::from([
            ("default".to_owned(), usual.to_owned()),
            ("setting".to_owned(), setting(variant, &settings)),
        ]),
        level: 0,
        spacing: 1.0,
        // Plain data of numbers and names always has a JSON form.
        parameters: serde_json::to_value(parameters).unwrap_or_default(),
    }
}
