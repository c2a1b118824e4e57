//! The one policy of the cases with a free surface: every constant that could be chosen otherwise.

use transpoint::variants::{Blend, Fill, FillMass, FillPoints, PointVolume};
use transpoint::{Settings, Variant};

/// c₀ τ/h of the relaxation towards PIC: a share of 3 % per step at the Courant number here.
pub const RELAXATION: f64 = 12.0;
/// The same where a flow of a few cells' depth must not be held up: its viscosity, about h c₀/1200, is then
/// 0.3 % of h_in √(g h_in) in `channel` and below that of the water in `channel-vof`.
pub const INFLOW_RELAXATION: f64 = 200.0;
/// θ of the positivity limiter.
pub const POSITIVITY: f64 = 0.8;
/// Λ of the limiter of the leverage.
pub const LEVERAGE: f64 = 16.0;
/// Share of the stable time step. At 0.7, just below the 1/√2 that a stress updated last keeps at worst, `gimp-vp`
/// with that update bursts in the dam break at T = 0.88 in place of 2.18, `tpm` at 0.08 in place of 0.27.
pub const COURANT: f64 = 0.5;
/// Steps after which the stable time step is found anew: sound sets it, which does not change.
pub const STEPS_PER_TIME_STEP: u64 = 10;
/// What is put into a numerical fracture: one point, with mass from its neighbours.
pub const FILL: Fill = Fill { points: FillPoints::Center, mass: FillMass::Donated };

/// Settings of the methods as printed, for `points_per_axis` in each cell.
pub fn printed(points_per_axis: usize) -> Settings {
    Settings {
        // The length of a point at the start.
        gimp_length: 1.0 / points_per_axis as f64,
        support: if points_per_axis == 1 { 1.5 } else { 1.0 },
        ..Settings::default()
    }
}

/// Settings of the policy, for cells of a size in m, a speed of sound in m/s, and `relaxation` c₀ τ/h
/// towards PIC.
///
/// The relaxation damps shear like a viscosity of about h²/(6 τ) = h c₀/(6 · `relaxation`), so its time is
/// that of a case and not of a method.
pub fn settings(
    points_per_axis: usize,
    spacing: f64,
    sound_speed: f64,
    relaxation: f64,
) -> Settings {
    Settings {
        blend: Blend::RelaxationTime(relaxation * spacing / sound_speed),
        positivity: Some(POSITIVITY),
        leverage: Some(LEVERAGE),
        point_volume: PointVolume::CellCenter,
        ..printed(points_per_axis)
    }
}

/// Whether the stress of a method is updated modified-last where all are shown side by side: FLIP with
/// carried values is noisy otherwise.
pub fn is_modified_last(variant: Variant) -> bool {
    matches!(variant, Variant::MpmVp | Variant::GimpVp | Variant::Bspline2)
}

/// The policy with [`RELAXATION`] in words, to be followed by what a case adds.
pub fn text(modified: &str) -> String {
    format!(
        "FLIP with the share 1 − Δt/τ, τ = {RELAXATION} h/c₀; stress updated last ({modified}: \
         modified-last); Δt = {COURANT} of the stable one; moving least squares over 1 cell (1.5 with one point \
         per cell), positivity θ = {POSITIVITY}, leverage Λ = {LEVERAGE}; one sample per cut cell that \
         carries all of its points."
    )
}
