//! Case `riemann`: 1000 Pa against 100 Pa in water, §4.2 and Fig. 10-11 of \[Song2020\].
//!
//! A rarefaction runs to the left and a shock to the right; at 5 ms they stand near x = 0.25 and
//! 0.75 m with 549.96 Pa between them. The paper shows 5 m; the waves need 1 m. The strip is three
//! cells wide and periodic across.
//!
//! The claim is that MPM in the velocity-pressure formulation without a slope limiter oscillates
//! severely and TPM does not. The paper states neither the blend of PIC and FLIP nor any viscosity,
//! so every method runs with each of the same three dissipations (label `dissipation`):
//!
//! ```text
//! flip      pure FLIP, nothing else (`affine` for APIC, whose transfer has no blend)
//! relaxed   FLIP share 1 − Δt/τ with τ = 2 h/c₀
//! viscous   pure FLIP (APIC: its own transfer) and bulk viscosity C₁ = 0.25, C₂ = 1.5, the linear
//!           term in expansion too
//! ```
//!
//! Rows of `pressure`, over the points unless said otherwise: `l1` and `l2` are means against the
//! exact isothermal solution; `overshoot` and `undershoot` are the largest excess beyond the initial
//! pressures, Pa; `plateau-min` and `plateau-max` are the extremes for |x − 0.5| < 0.2 m; `tv-cells`
//! and `tv-points` are total variations of the means over columns of cells and of the points;
//! `front-width-left` and `-right` are the distances from 90 % to 10 % of a jump in cells;
//! `n-outside` counts points outside 100…1000 Pa. Excesses up to 10⁻⁶ Pa are round-off and do not
//! count.

mod claims;
mod figures;
mod methods;
mod results;
mod scene;
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
use methods::{Dissipation, METHODS, Method};

/// Cell size, m; §4.2 of \[Song2020\].
const SPACING: f64 = 1e-3;
/// Cells across the strip.
const WIDTH_CELLS: usize = 3;
/// Time of measurement, s; Fig. 11 of \[Song2020\].
const TIME: f64 = 5e-3;
/// c₀ Δt / h.
const COURANT: f64 = 0.2;
/// c₀, m/s.
const SOUND_SPEED: f64 = 50.0;
/// ρ₀, kg/m³.
const DENSITY: f64 = 1000.0;
/// Place of the interface, m.
const INTERFACE: f64 = 0.5;
/// Pressures left and right of it, Pa.
const PRESSURES: [f64; 2] = [1000.0, 100.0];
/// Excess of pressure that is put down to round-off, Pa.
const ROUND_OFF: f64 = 1e-6;
/// Layouts of the points.
const LAYOUTS: [&str; 2] = ["regular", "jittered"];
/// Largest displacement of a jittered point along each axis, point spacings.
const JITTER: f64 = 0.3;
/// Seed of the jitter.
const SEED: u64 = 20_200_905;

/// Everything that a run of this case depends on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// The library's variant behind the method.
    variant: Variant,
    /// Cells along x in 0 ≤ x ≤ 1 m.
    cells: usize,
    /// Time step, s.
    dt: f64,
    /// Steps.
    steps: u64,
    /// Largest displacement of a point, point spacings.
    jitter: f64,
    /// Seed of the displacements.
    seed: u64,
    /// Settings of the solver.
    settings: Settings,
}

impl Parameters {
    fn new(method: &Method, layout: &str, dissipation: Dissipation, cells: usize) -> Self {
        let longest = COURANT / (cells as f64 * SOUND_SPEED);
        // Rounded, so that 1250 steps do not become 1251 by a last bit.
        let steps = (TIME / longest).round().max(1.0);
        Self {
            variant: method.variant,
            cells,
            dt: TIME / steps,
            steps: steps as u64,
            jitter: if layout == "jittered" { JITTER } else { 0.0 },
            seed: SEED,
            settings: method.settings(dissipation),
        }
    }
}

/// The case `riemann`.
#[derive(Clone, Copy, Debug)]
pub struct Riemann;

impl Case for Riemann {
    fn name(&self) -> &'static str {
        "riemann"
    }

    fn about(&self) -> &'static str {
        "a pressure jump in water, 1000 Pa against 100 Pa: who rings, and what cures it (Fig. 11 of \
         [Song2020])"
    }

    fn variants(&self) -> Vec<&'static str> {
        METHODS.iter().map(|method| method.name).collect()
    }

    fn levels(&self) -> usize {
        1
    }

    fn policy(&self) -> String {
        format!(
            "Cells of {SPACING} m, 2 by 2 points each, jitter ±{JITTER} of the point spacing (Pcg64, \
             seed {SEED}), Courant number {COURANT}, t = 5 ms. flip, affine: the pure transfer. \
             relaxed: blend with τ = {:e} s = 2 h/c₀. viscous: the pure transfer with {:?}. Names in \
             -bj and -mc have a limiter of the pressure's slope in the cell (Barth-Jespersen, per \
             axis), names in -musl update the stress modified-last. All else: {:?}.",
            methods::RELAXATION_TIME,
            methods::BULK_VISCOSITY,
            Settings::default()
        )
    }

    fn runs(&self, tier: Tier) -> Vec<RunSpec> {
        let mut runs = Vec::new();
        for method in &METHODS {
            for &dissipation in method.dissipations {
                if tier != Tier::Smoke || method.in_smoke(dissipation) {
                    runs.extend(LAYOUTS.map(|layout| spec(method, layout, dissipation)));
                }
            }
        }
        runs
    }

    fn execute(&self, spec: &RunSpec, progress: &Progress) -> Findings {
        match serde_json::from_value::<Parameters>(spec.parameters.clone()) {
            Ok(parameters) => scene::execute(&parameters, progress),
            Err(error) => Findings::not_built(&error, scene::missing_rows()),
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

/// The run of a variant in the case `rivals`, on cells twice as large.
pub(super) fn rival(variant: Variant) -> RunSpec {
    let method = Method::of(variant);
    let cells = (0.5 / SPACING).round() as usize;
    let parameters = Parameters::new(&method, LAYOUTS[1], Dissipation::Viscous, cells);
    RunSpec {
        spacing: 2.0 * SPACING,
        parameters: serde_json::to_value(parameters).unwrap_or_default(),
        ..spec(&method, LAYOUTS[1], Dissipation::Viscous)
    }
}

fn spec(method: &Method, layout: &str, dissipation: Dissipation) -> RunSpec {
    let cells = (1.0 / SPACING).round() as usize;
    let parameters = Parameters::new(method, layout, dissipation, cells);
    RunSpec {
        case: "riemann".to_owned(),
        variant: method.name.to_owned(),
        layout: layout.to_owned(),
        labels: BTreeMap::from([("dissipation".to_owned(), dissipation.name().to_owned())]),
        level: 0,
        spacing: SPACING,
        // Plain data of numbers and names always has a JSON form.
        parameters: serde_json::to_value(parameters).unwrap_or_default(),
    }
}
