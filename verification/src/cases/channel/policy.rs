//! The runs and their policy, which is that of all cases with a free surface.

use transpoint::scene::Supply;
use transpoint::variants::{Fields, Rearrangement, StressUpdate};
use transpoint::{Settings, Variant};

use super::scene::{Outlet, SOUND_SPEED};
use crate::case::Tier;
use crate::cases::free_surface::{self, COURANT, FILL, INFLOW_RELAXATION, LEVERAGE, POSITIVITY};

/// Points per cell and axis.
pub(super) const POINTS_PER_AXIS: usize = 2;
/// c₀ τ/h of the dam break: its viscosity, 6 % of h_in √(g h_in), holds the flow up.
const DAMPED: f64 = 12.0;
/// Energy per mass over that of what comes in at which a run counts as blown up.
pub(super) const MOST_ENERGY: f64 = 4.0;

/// A run as the case lists it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub(super) variant: Variant,
    /// Height of the inlet, the layout of the record.
    pub(super) layout: &'static str,
    pub(super) supply: Supply,
    pub(super) outlet: Outlet,
    /// h_in, m.
    pub(super) inlet_height: f64,
    /// v₀, m/s.
    pub(super) speed: f64,
    /// Cell size, m.
    pub(super) spacing: f64,
    /// Time at the end, s.
    pub(super) end: f64,
    /// Whether the relaxation is that of the dam break.
    pub(super) damped: bool,
    /// The first tier that has it.
    pub(super) tier: Tier,
}

impl Run {
    /// The value of the label `run`.
    pub(super) fn name(&self) -> String {
        let supply = match self.supply {
            Supply::Columns => "columns",
            Supply::Flux => "flux",
        };
        let outlet = if self.outlet == Outlet::Free { "" } else { "-outflow" };
        let damped = if self.damped { "-damped" } else { "" };
        format!("{supply}{outlet}{damped}")
    }
}

const fn base(variant: Variant, supply: Supply) -> Run {
    Run {
        variant,
        layout: "100mm",
        supply,
        outlet: Outlet::Free,
        inlet_height: 0.1,
        speed: 0.4,
        spacing: 0.02,
        end: 4.0,
        damped: false,
        tier: Tier::Paper,
    }
}

const fn at_speed(run: Run, speed: f64, end: f64) -> Run {
    Run { speed, end, ..run }
}

const fn low(supply: Supply) -> Run {
    Run {
        layout: "50mm",
        inlet_height: 0.05,
        spacing: 0.0125,
        ..base(Variant::TpmVpQuadratic, supply)
    }
}

const fn smoke(variant: Variant, supply: Supply) -> Run {
    Run { layout: "coarse", spacing: 0.05, end: 2.0, tier: Tier::Smoke, ..base(variant, supply) }
}

/// The run of a variant in the case `rivals`.
pub(super) const fn rival(variant: Variant) -> Run {
    smoke(variant, Supply::Flux)
}

const TPM: Variant = Variant::TpmVpQuadratic;

/// Every run, the longest first.
pub(super) static RUNS: [Run; 22] = [
    Run { end: 12.0, ..base(TPM, Supply::Flux) },
    Run { end: 8.0, ..base(TPM, Supply::Columns) },
    base(Variant::Apic, Supply::Flux),
    base(Variant::TpmVpConstant, Supply::Flux),
    base(Variant::TpmVpConstant, Supply::Columns),
    Run { outlet: Outlet::ZeroGradient, ..base(TPM, Supply::Flux) },
    Run { damped: true, ..base(TPM, Supply::Flux) },
    Run { damped: true, ..base(TPM, Supply::Columns) },
    base(Variant::GimpVp, Supply::Flux),
    base(Variant::MpmVp, Supply::Flux),
    low(Supply::Flux),
    low(Supply::Columns),
    at_speed(base(TPM, Supply::Flux), 0.2, 2.5),
    at_speed(base(TPM, Supply::Columns), 0.2, 2.5),
    at_speed(base(TPM, Supply::Flux), 0.6, 2.0),
    at_speed(base(TPM, Supply::Columns), 0.6, 2.0),
    at_speed(base(TPM, Supply::Flux), 0.8, 2.0),
    at_speed(base(TPM, Supply::Columns), 0.8, 2.0),
    smoke(TPM, Supply::Flux),
    smoke(TPM, Supply::Columns),
    smoke(Variant::MpmVp, Supply::Flux),
    smoke(Variant::Apic, Supply::Flux),
];

/// Every method, in the order of legends.
pub(super) const VARIANTS: [Variant; 5] = [
    Variant::TpmVpQuadratic,
    Variant::TpmVpConstant,
    Variant::MpmVp,
    Variant::GimpVp,
    Variant::Apic,
];

/// Settings of a run. MPM updates its stress modified-last, which it needs here, and TPM last, since it grows
/// otherwise (`spectral`). Fractures are filled where a method can: where points carry no mass.
pub(super) fn settings(run: &Run) -> Settings {
    let filled = Rearrangement { fill: Some(FILL), ..Rearrangement::default() };
    let relaxation = if run.damped { DAMPED } else { INFLOW_RELAXATION };
    let fields = run.variant.parts().fields;
    let carried = fields == Fields::Carried;
    Settings {
        stress_update: if carried { StressUpdate::ModifiedLast } else { StressUpdate::Last },
        rearrangement: (fields == Fields::TransportPoints).then_some(filled),
        ..free_surface::settings(POINTS_PER_AXIS, run.spacing, SOUND_SPEED, relaxation)
    }
}

/// One line of settings for the notes of tables.
pub(super) fn text() -> String {
    format!(
        "All runs: FLIP with the share 1 − Δt/τ, τ = {INFLOW_RELAXATION} h/c₀ (`damped`: {DAMPED}; `apic`: affine); stress \
         updated modified-last in MPM and last in TPM; Δt = {COURANT} of the stable one; {POINTS_PER_AXIS} points per \
         cell and axis; c₀ = {SOUND_SPEED} m/s, p ≥ −5000 Pa; hydrostatic pressure in the inlet's first column. \
         TPM: moving least squares over 1 cell, positivity θ = {POSITIVITY}, leverage Λ = {LEVERAGE}; one sample \
         per cut cell that carries all of its points; fractures are filled, {FILL:?}. A run whose kinetic and \
         potential energy exceeds {MOST_ENERGY} (½ v₀² + g h_in) per mass has blown up."
    )
}
