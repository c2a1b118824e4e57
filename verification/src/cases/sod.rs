//! Case `sod`: the shock tube of \[Sod1978\], an ideal gas with the energy equation, in 1D.
//!
//! γ = 1.4, (ρ, u, p) = (1, 0, 1) for x < 0.5 and (0.125, 0, 0.1) beyond, t = 0.2: a rarefaction to
//! the left, a contact and a shock to the right. All is in SI units of which none matters. It is not
//! in \[Song2020\], which gives the energy equation (34) and shows no gas.
//!
//! Points are equally spaced, so that their masses differ by side. There are 4 per cell: the fan
//! stretches the gas 2.35-fold, which leaves cells without a point where there were 2, and no method
//! here fills cells (with 2 the order of the density error of TPM was found to be 0.06). For TPM, whose
//! points carry no mass, the totals of energy are those of the nominal masses.
//!
//! The label `energy` says how the internal energy is updated: `strain` by Eq. (34), `work` by the
//! work of the nodes' forces, which keeps the total to round-off where a method allows it (names in
//! `-work`).

mod figures;
mod results;
mod scene;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use transpoint::variants::{BulkViscosity, EnergyUpdate};
use transpoint::{Settings, Variant};

use crate::case::{Case, Findings, RunSpec, Tier};
use crate::convergence::{self, Order};
use crate::judge::Check;
use crate::progress::Progress;
use crate::record::RunRecord;
use crate::report::Artifact;

/// Cells of the tube, coarsest first.
const CELLS: [usize; 6] = [16, 32, 64, 128, 200, 400];
/// Levels of the smoke tier.
const SMOKE_LEVELS: usize = 4;
/// Points per cell.
const POINTS_PER_CELL: usize = 4;
/// Ratio of the specific heats.
const RATIO: f64 = 1.4;
/// Time of measurement, s.
const TIME: f64 = 0.2;
/// Place of the interface, m.
const INTERFACE: f64 = 0.5;
/// Δt max(|u| + a) / h.
const COURANT: f64 = 0.2;
/// Bound of |u| + a in the exact solution, m/s: 2.19 behind the shock.
const FASTEST: f64 = 2.2;
/// Layouts of the points.
const LAYOUTS: [&str; 2] = ["regular", "jittered"];
/// Largest displacement of a jittered point, point spacings.
const JITTER: f64 = 0.3;
/// Seed of the jitter is this plus the level.
const SEED: u64 = 20_260_601;

/// A method under its name in this case.
struct Method {
    name: &'static str,
    variant: Variant,
    energy_update: EnergyUpdate,
}

const fn by_strain(variant: Variant) -> Method {
    Method { name: variant.name(), variant, energy_update: EnergyUpdate::Strain }
}

const fn by_work(name: &'static str, variant: Variant) -> Method {
    Method { name, variant, energy_update: EnergyUpdate::Work }
}

/// Every method, in the order of tables.
static METHODS: [Method; 10] = [
    by_strain(Variant::Mpm),
    by_strain(Variant::Gimp),
    by_strain(Variant::Bspline2),
    by_strain(Variant::Apic),
    by_strain(Variant::Tpm),
    by_strain(Variant::TpmVpConstant),
    by_strain(Variant::MpmVp),
    by_work("mpm-work", Variant::Mpm),
    by_work("gimp-work", Variant::Gimp),
    by_work("bspline2-work", Variant::Bspline2),
];

/// Methods of the smoke tier.
const SMOKE: [&str; 2] = ["mpm-work", "tpm-vp0"];

/// Everything that a run of this case depends on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// The library's variant behind the method.
    variant: Variant,
    /// Cells in 0 ≤ x ≤ 1 m.
    cells: usize,
    /// Points per cell.
    points_per_cell: usize,
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

/// The settings of all runs but for the update of the energy.
fn settings(energy_update: EnergyUpdate) -> Settings {
    Settings {
        bulk_viscosity: Some(BulkViscosity { linear: 0.25, quadratic: 1.5, expansion: false }),
        // The length of a point at the start.
        gimp_length: 1.0 / POINTS_PER_CELL as f64,
        energy_update,
        ..Settings::default()
    }
}

/// The case `sod`.
#[derive(Clone, Copy, Debug)]
pub struct Sod;

impl Case for Sod {
    fn name(&self) -> &'static str {
        "sod"
    }

    fn about(&self) -> &'static str {
        "shock tube of an ideal gas: orders of convergence and the balance of energy [Sod1978]"
    }

    fn variants(&self) -> Vec<&'static str> {
        METHODS.iter().map(|method| method.name).collect()
    }

    fn levels(&self) -> usize {
        CELLS.len()
    }

    fn policy(&self) -> String {
        format!(
            "All methods: {:?}; names in -work: energy_update Work. {POINTS_PER_CELL} points per cell, \
             jitter ±{JITTER} of the point spacing, Pcg64 seeded with {SEED} + level; Courant number \
             {COURANT} by |u| + a ≤ {FASTEST} m/s.",
            settings(EnergyUpdate::Strain)
        )
    }

    fn runs(&self, tier: Tier) -> Vec<RunSpec> {
        let smoke = tier == Tier::Smoke;
        let levels = if smoke { SMOKE_LEVELS } else { CELLS.len() };
        let mut runs = Vec::new();
        for method in METHODS.iter().filter(|method| !smoke || SMOKE.contains(&method.name)) {
            for layout in LAYOUTS {
                runs.extend((0..levels).map(|level| spec(method, layout, level)));
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
        results::checks(records, &self.orders(records))
    }

    fn orders(&self, records: &[RunRecord]) -> Vec<Order> {
        convergence::orders(records).into_iter().filter(|order| order.norm == "l1").collect()
    }

    fn artifacts(&self, records: &[RunRecord]) -> Vec<Artifact> {
        results::artifacts(records, &self.policy())
    }
}

fn parameters(method: &Method, layout: &str, level: usize) -> Parameters {
    let cells = CELLS[level];
    // All steps are equal and the last ends at the time of measurement.
    let steps = (TIME * FASTEST * cells as f64 / COURANT).ceil();
    Parameters {
        variant: method.variant,
        cells,
        points_per_cell: POINTS_PER_CELL,
        dt: TIME / steps,
        steps: steps as u64,
        jitter: if layout == "jittered" { JITTER } else { 0.0 },
        seed: SEED + level as u64,
        settings: settings(method.energy_update),
    }
}

fn spec(method: &Method, layout: &str, level: usize) -> RunSpec {
    let energy = match method.energy_update {
        EnergyUpdate::Strain => "strain",
        EnergyUpdate::Work => "work",
    };
    RunSpec {
        case: "sod".to_owned(),
        variant: method.name.to_owned(),
        layout: layout.to_owned(),
        labels: BTreeMap::from([("energy".to_owned(), energy.to_owned())]),
        level,
        spacing: 1.0 / CELLS[level] as f64,
        // Plain data of numbers and names always has a JSON form.
        parameters: serde_json::to_value(parameters(method, layout, level)).unwrap_or_default(),
    }
}
