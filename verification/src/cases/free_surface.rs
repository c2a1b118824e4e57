//! The one policy of runs with a free surface: every constant that could be chosen otherwise.

use transpoint::variants::{Blend, Fill, FillMass, FillPoints, PointVolume};
use transpoint::{Settings, Variant};

/// c₀ τ/h of the relaxation towards PIC: a share of 3 % per step at the Courant number here.
const RELAXATION: f64 = 12.0;
/// θ of the positivity limiter.
const POSITIVITY: f64 = 0.8;
/// Λ of the limiter of the leverage.
const LEVERAGE: f64 = 16.0;
/// Share of the stable time step. At 0.7, just below the 1/√2 that a stress updated last keeps at worst, `gimp-vp`
/// with that update bursts in the dam break at T = 0.88 in place of 2.18, `tpm` at 0.08 in place of 0.27.
pub const COURANT: f64 = 0.5;
/// Steps after which the stable time step is found anew: sound sets it, which does not change.
pub const STEPS_PER_TIME_STEP: u64 = 10;
/// What is put into a numerical fracture: one point, with mass from its neighbours.
pub const FILL: Fill = Fill { points: FillPoints::Center, mass: FillMass::Donated };

/// Settings without the policy: the length of a uGIMP point is that at the start.
pub fn plain(points_per_axis: usize) -> Settings {
    Settings {
        gimp_length: 1.0 / points_per_axis as f64,
        support: if points_per_axis == 1 { 1.5 } else { 1.0 },
        ..Settings::default()
    }
}

/// Settings of the policy on cells of `spacing` (m) in a fluid with `sound_speed` (m/s).
pub fn settings(points_per_axis: usize, spacing: f64, sound_speed: f64) -> Settings {
    Settings {
        blend: Blend::RelaxationTime(RELAXATION * spacing / sound_speed),
        positivity: Some(POSITIVITY),
        leverage: Some(LEVERAGE),
        point_volume: PointVolume::CellCenter,
        ..plain(points_per_axis)
    }
}

/// Whether the stress of a method is updated modified-last where all are shown side by side: FLIP with
/// carried values is noisy otherwise.
pub fn is_modified_last(variant: Variant) -> bool {
    matches!(variant, Variant::MpmVp | Variant::GimpVp | Variant::Bspline2)
}

/// The policy in words, to be followed by what a case adds.
pub fn text(modified: &str) -> String {
    format!(
        "FLIP with the share 1 − Δt/τ, τ = {RELAXATION} h/c₀; stress updated last ({modified}: \
         modified-last); Δt = {COURANT} of the stable one; moving least squares over 1 cell (1.5 with one point \
         per cell), positivity θ = {POSITIVITY}, leverage Λ = {LEVERAGE}; one sample per cut cell that \
         carries all of its points."
    )
}
