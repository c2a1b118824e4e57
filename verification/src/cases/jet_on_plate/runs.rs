//! The runs, and the settings of each.

use transpoint::scene::Supply;
use transpoint::variants::{Rearrangement, Shift, StressUpdate};
use transpoint::{Settings, Variant};

use super::scene::{JET, POINTS_PER_AXIS, SOUND_SPEED, Start};
use crate::case::Tier;
use crate::cases::free_surface::{self, FILL, RELAXATION};

/// Cells across the jet, by level.
pub(super) const CELLS: [usize; 4] = [4, 8, 16, 32];
/// How points are pushed apart.
const SHIFT: Shift = Shift { strength: 0.2, interval: 10 };
/// Distance of the inlet from the plate, b, unless it is varied.
const DISTANCE: f64 = 3.0;

/// A run as the case lists it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub(super) variant: Variant,
    /// Name of the arrangement.
    pub(super) layout: &'static str,
    pub(super) supply: Supply,
    /// Whether numerical fractures are filled, where the method can.
    pub(super) fill: bool,
    /// Whether points are pushed apart, where the method can.
    pub(super) shift: bool,
    pub(super) start: Start,
    /// Whether both halves of the jet are there.
    pub(super) whole: bool,
    /// Distance of the inlet from the plate, b.
    pub(super) distance: f64,
    /// Index into [`CELLS`].
    pub(super) level: usize,
    /// The first tier that has it.
    pub(super) tier: Tier,
}

const fn half(variant: Variant, level: usize, tier: Tier) -> Run {
    Run {
        variant,
        layout: "half",
        supply: Supply::Flux,
        fill: true,
        shift: false,
        start: Start::Exact,
        whole: false,
        distance: DISTANCE,
        level,
        tier,
    }
}

const TPM: Variant = Variant::TpmVpQuadratic;

const fn columns(level: usize, tier: Tier) -> Run {
    Run { layout: "columns", supply: Supply::Columns, ..half(TPM, level, tier) }
}

const fn shifted(level: usize) -> Run {
    Run { layout: "shift", shift: true, ..half(TPM, level, Tier::Paper) }
}

const fn unfilled(level: usize) -> Run {
    Run { layout: "unfilled", fill: false, ..half(TPM, level, Tier::Paper) }
}

const fn at_distance(layout: &'static str, distance: f64) -> Run {
    Run { layout, distance, ..half(TPM, 1, Tier::Paper) }
}

/// Every run, the longest first.
pub(super) static RUNS: [Run; 36] = [
    half(TPM, 3, Tier::Full),
    columns(3, Tier::Full),
    half(Variant::TpmVpConstant, 3, Tier::Full),
    half(Variant::GimpVp, 3, Tier::Full),
    half(Variant::MpmVp, 3, Tier::Full),
    half(Variant::Bspline2, 3, Tier::Full),
    half(Variant::Apic, 3, Tier::Full),
    half(TPM, 2, Tier::Paper),
    shifted(2),
    columns(2, Tier::Full),
    half(Variant::TpmVpConstant, 2, Tier::Full),
    half(Variant::GimpVp, 2, Tier::Full),
    half(Variant::MpmVp, 2, Tier::Full),
    half(Variant::Bspline2, 2, Tier::Full),
    half(Variant::Apic, 2, Tier::Full),
    Run { layout: "whole", whole: true, ..half(TPM, 1, Tier::Paper) },
    at_distance("far", 4.5),
    half(TPM, 1, Tier::Paper),
    Run { layout: "blow", start: Start::Blow, ..half(TPM, 1, Tier::Paper) },
    columns(1, Tier::Paper),
    unfilled(1),
    shifted(1),
    half(Variant::TpmVpConstant, 1, Tier::Paper),
    half(Variant::GimpVp, 1, Tier::Paper),
    half(Variant::MpmVp, 1, Tier::Paper),
    half(Variant::Bspline2, 1, Tier::Paper),
    half(Variant::Apic, 1, Tier::Paper),
    at_distance("near", 1.5),
    half(TPM, 0, Tier::Smoke),
    columns(0, Tier::Paper),
    shifted(0),
    half(Variant::TpmVpConstant, 0, Tier::Paper),
    half(Variant::GimpVp, 0, Tier::Smoke),
    half(Variant::MpmVp, 0, Tier::Paper),
    half(Variant::Bspline2, 0, Tier::Paper),
    half(Variant::Apic, 0, Tier::Paper),
];

/// Every method, in the order of legends.
pub(super) const VARIANTS: [Variant; 6] = [
    TPM,
    Variant::TpmVpConstant,
    Variant::GimpVp,
    Variant::MpmVp,
    Variant::Bspline2,
    Variant::Apic,
];

/// Cell size of a level, m.
pub(super) fn spacing(level: usize) -> f64 {
    JET.width / CELLS[level] as f64
}

/// Settings of a run.
pub(super) fn settings(run: &Run) -> Settings {
    let modified = free_surface::is_modified_last(run.variant);
    let reconstructs = matches!(run.variant, TPM | Variant::TpmVpConstant);
    let rearrangement = Rearrangement {
        fill: run.fill.then_some(FILL),
        shift: run.shift.then_some(SHIFT),
        ..Rearrangement::default()
    };
    Settings {
        stress_update: if modified { StressUpdate::ModifiedLast } else { StressUpdate::Last },
        rearrangement: reconstructs.then_some(rearrangement),
        ..free_surface::settings(POINTS_PER_AXIS, spacing(run.level), SOUND_SPEED, RELAXATION)
    }
}

/// One line of settings for the notes of tables.
pub(super) fn text() -> String {
    format!(
        "{} tpm-vp2 and tpm-vp0 but `unfilled`: {FILL:?}; `shift`: {SHIFT:?}. p ≥ −½ ρ U². b = 0.1 m, U = 1 m/s, \
         ρ₀ = 1000 kg/m³, c₀ = 10 U; 4 × 4 points per cell come in at {DISTANCE} b from the plate unless \
         said otherwise.",
        free_surface::text("mpm-vp, gimp-vp, bspline2")
    )
}
