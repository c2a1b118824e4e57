//! The runs, and the settings of each.

use transpoint::variants::{Rearrangement, StressUpdate};
use transpoint::{Settings, Variant};

use super::scene::{CRITICAL_DEPTH, POINTS_PER_AXIS, sound_speed};
use crate::case::Tier;
use crate::cases::free_surface::{self, FILL, RELAXATION};

/// Cells in the critical depth, by level.
pub(super) const CELLS: [usize; 3] = [8, 12, 16];

/// A run as the case lists it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub(super) variant: Variant,
    /// Name of the inflow: its Froude number.
    pub(super) layout: &'static str,
    /// Depth of the inflow, quarters of the critical depth.
    pub(super) quarters: usize,
    /// T at the end.
    pub(super) end: f64,
    /// Index into [`CELLS`].
    pub(super) level: usize,
    /// The first tier that has it.
    pub(super) tier: Tier,
}

const fn critical(variant: Variant, level: usize, tier: Tier) -> Run {
    Run { variant, layout: "fr1.00", quarters: 4, end: 24.0, level, tier }
}

const TPM: Variant = Variant::TpmVpQuadratic;

/// Every run, the longest first.
pub(super) static RUNS: [Run; 13] = [
    critical(TPM, 2, Tier::Full),
    critical(Variant::GimpVp, 2, Tier::Full),
    critical(Variant::MpmVp, 2, Tier::Full),
    critical(Variant::Apic, 2, Tier::Full),
    critical(TPM, 1, Tier::Paper),
    critical(Variant::GimpVp, 1, Tier::Paper),
    critical(Variant::MpmVp, 1, Tier::Paper),
    Run { layout: "fr0.72", quarters: 5, end: 60.0, ..critical(TPM, 0, Tier::Paper) },
    Run { layout: "fr0.54", quarters: 6, end: 60.0, ..critical(TPM, 0, Tier::Paper) },
    critical(Variant::MpmVp, 0, Tier::Paper),
    critical(Variant::Apic, 0, Tier::Paper),
    critical(TPM, 0, Tier::Smoke),
    critical(Variant::GimpVp, 0, Tier::Paper),
];

/// Every method, in the order of legends.
pub(super) const VARIANTS: [Variant; 4] = [TPM, Variant::GimpVp, Variant::MpmVp, Variant::Apic];

/// Cell size of a level, m.
pub(super) fn spacing(level: usize) -> f64 {
    CRITICAL_DEPTH / CELLS[level] as f64
}

/// Settings of a run.
pub(super) fn settings(run: &Run) -> Settings {
    let modified = free_surface::is_modified_last(run.variant);
    let filled = Rearrangement { fill: Some(FILL), ..Rearrangement::default() };
    Settings {
        stress_update: if modified { StressUpdate::ModifiedLast } else { StressUpdate::Last },
        rearrangement: (run.variant == TPM).then_some(filled),
        ..free_surface::settings(POINTS_PER_AXIS, spacing(run.level), sound_speed(), RELAXATION)
    }
}

/// One line of settings for the notes of tables.
pub(super) fn text() -> String {
    format!(
        "{} tpm-vp2: {FILL:?}. p ≥ −ρ₀ g y_c. y_c = 0.1 m, g = 9.81 m/s², ρ₀ = 1000 kg/m³, \
         c₀ = 10 √(g y_c), 2 × 2 points per cell; the bed ends 6 y_c behind the inlet.",
        free_surface::text("mpm-vp, gimp-vp")
    )
}
