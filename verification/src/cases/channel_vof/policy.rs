//! The runs and their policy, which is that of `channel`.

use transpoint::scene::Supply;
use transpoint::variants::{Rearrangement, StressUpdate};
use transpoint::{Settings, Variant};

use super::scene::{Flow, SOUND_SPEED};
use crate::case::Tier;
use crate::cases::free_surface::{self, COURANT, FILL, INFLOW_RELAXATION, LEVERAGE, POSITIVITY};

/// Points per cell and axis.
pub(super) const POINTS_PER_AXIS: usize = 2;

/// A run as the case lists it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub(super) variant: Variant,
    /// Size of the cells, the layout of the record.
    pub(super) layout: &'static str,
    pub(super) supply: Supply,
    pub(super) flow: Flow,
    /// Cell size, m.
    pub(super) spacing: f64,
    /// Time at the end, s.
    pub(super) end: f64,
    /// The first tier that has it.
    pub(super) tier: Tier,
}

const fn base(variant: Variant, supply: Supply) -> Run {
    Run {
        variant,
        layout: "0.25mm",
        supply,
        flow: Flow::FullNoslip,
        spacing: 2.5e-4,
        end: 0.17,
        tier: Tier::Paper,
    }
}

const fn smoke(variant: Variant) -> Run {
    Run {
        layout: "1mm",
        spacing: 1e-3,
        end: 0.05,
        tier: Tier::Smoke,
        ..base(variant, Supply::Flux)
    }
}

const TPM: Variant = Variant::TpmVpQuadratic;

/// Every run, the longest first.
pub(super) static RUNS: [Run; 12] = [
    base(TPM, Supply::Columns),
    base(TPM, Supply::Flux),
    base(Variant::TpmVpConstant, Supply::Flux),
    Run { flow: Flow::FullSlip, ..base(TPM, Supply::Flux) },
    Run { flow: Flow::HalfNoslip, ..base(TPM, Supply::Flux) },
    base(Variant::GimpVp, Supply::Flux),
    base(Variant::MpmVp, Supply::Flux),
    base(Variant::Apic, Supply::Flux),
    Run { flow: Flow::FullSlipWeightless, ..base(TPM, Supply::Flux) },
    Run { layout: "0.5mm", spacing: 5e-4, ..base(TPM, Supply::Flux) },
    smoke(TPM),
    smoke(Variant::MpmVp),
];

/// Every method, in the order of legends.
pub(super) const VARIANTS: [Variant; 5] = [
    Variant::TpmVpQuadratic,
    Variant::TpmVpConstant,
    Variant::MpmVp,
    Variant::GimpVp,
    Variant::Apic,
];

/// Settings of a run, chosen as in `channel`.
pub(super) fn settings(run: &Run) -> Settings {
    let filled = Rearrangement { fill: Some(FILL), ..Rearrangement::default() };
    let carries_mass = !matches!(run.variant, Variant::TpmVpQuadratic | Variant::TpmVpConstant);
    Settings {
        stress_update: if carries_mass { StressUpdate::ModifiedLast } else { StressUpdate::Last },
        rearrangement: (!carries_mass).then_some(filled),
        ..free_surface::settings(POINTS_PER_AXIS, run.spacing, SOUND_SPEED, INFLOW_RELAXATION)
    }
}

/// One line of settings for the notes of tables.
pub(super) fn text() -> String {
    format!(
        "All runs: FLIP with the share 1 − Δt/τ, τ = {INFLOW_RELAXATION} h/c₀ (`apic`: affine); stress updated \
         modified-last in MPM and last in TPM; Δt = {COURANT} of the stable one; {POINTS_PER_AXIS} points per cell \
         and axis; c₀ = {SOUND_SPEED} m/s, p ≥ −83 Pa, which is the share of ρ₀ g H that it is in the dam break; \
         hydrostatic pressure in the inlet's first column. TPM: moving least squares over 1 cell, positivity θ = \
         {POSITIVITY}, leverage Λ = {LEVERAGE}; one sample per cut cell that carries all of its points; fractures \
         are filled, {FILL:?}."
    )
}
