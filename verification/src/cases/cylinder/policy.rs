//! The one policy of all runs, and the runs: every constant that could be chosen otherwise.

use transpoint::variants::{
    Blend, Fill, FillMass, FillPoints, PointVolume, PressureLimiter, Rearrangement, Shift,
};
use transpoint::{Settings, Variant};

use super::radius::matched_radius;
use super::scene::{DIAMETER, OUTFLOW_TIME, SOUND_SPEED, spacing, viscosity};
use crate::case::Tier;

/// Viscosity that the share of PIC adds, over that of the fluid: hats with linear interpolation spread a
/// velocity by h²/6 each way, so that ε ν = h²/(6 τ).
const SPREAD: f64 = 0.05;
/// θ of the positivity limiter.
const POSITIVITY: f64 = 0.8;
/// Λ of the limiter of the leverage.
const LEVERAGE: f64 = 16.0;
/// What is put into a numerical fracture: four points, with mass from their neighbours.
const FILL: Fill = Fill { points: FillPoints::Quarters, mass: FillMass::Donated };
/// Pushing points apart.
const SHIFT: Shift = Shift { strength: 0.1, interval: 20 };
/// Share of the stable time step.
pub(super) const COURANT: f64 = 0.5;
/// Steps after which the stable time step is found anew.
pub(super) const STEPS_PER_TIME_STEP: u64 = 20;
/// Kinetic energy over that at the start at which a run counts as blown up.
pub(super) const MOST_ENERGY: f64 = 2.0;

/// What radius the cylinder is given on the grid.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub(super) enum Body {
    /// That with which the hull of its nodes is as large as the circle.
    Matched,
    /// That of the circle.
    Plain,
}

impl Body {
    /// The value of the label `body`.
    pub(super) const fn name(self) -> &'static str {
        match self {
            Self::Matched => "matched",
            Self::Plain => "plain",
        }
    }

    /// Radius on a grid, m.
    pub(super) fn radius(self, spacing: f64) -> f64 {
        match self {
            Self::Matched => matched_radius(spacing),
            Self::Plain => 0.5 * DIAMETER,
        }
    }
}

/// A run as the case lists it.
#[derive(Clone, Copy, Debug)]
pub(super) struct Run {
    pub(super) variant: Variant,
    /// Name of the flow, the layout of the record.
    pub(super) layout: &'static str,
    /// U D/ν.
    pub(super) reynolds: f64,
    /// Cells across the channel, 4.1 D high.
    pub(super) cells_across: usize,
    /// Radius of the cylinder on the grid.
    pub(super) body: Body,
    /// Length of the channel, D.
    pub(super) length: f64,
    /// T at the end.
    pub(super) end: f64,
    /// T from which on forces are measured.
    pub(super) measured_from: f64,
    /// Resolution step of the layout.
    pub(super) level: usize,
    /// The first tier that has it.
    pub(super) tier: Tier,
}

const fn steady(variant: Variant, cells_across: usize, level: usize) -> Run {
    Run {
        variant,
        layout: "steady-re20",
        reynolds: 20.0,
        cells_across,
        body: Body::Matched,
        length: 8.0,
        end: 10.0,
        measured_from: 5.0,
        level,
        tier: Tier::Full,
    }
}

const fn shedding(cells_across: usize, level: usize) -> Run {
    Run {
        variant: Variant::TpmVpQuadratic,
        layout: "shedding-re100",
        reynolds: 100.0,
        cells_across,
        body: Body::Matched,
        length: 10.0,
        end: 50.0,
        measured_from: 15.0,
        level,
        tier: Tier::Full,
    }
}

/// Every run, the longest first.
pub(super) static RUNS: [Run; 7] = [
    shedding(62, 1),
    shedding(41, 0),
    steady(Variant::TpmVpQuadratic, 62, 1),
    steady(Variant::TpmVpQuadratic, 41, 0),
    Run { body: Body::Plain, ..steady(Variant::TpmVpQuadratic, 41, 0) },
    steady(Variant::MpmVp, 41, 0),
    Run {
        layout: "small-re20",
        cells_across: 25,
        length: 6.0,
        end: 1.0,
        measured_from: 0.5,
        tier: Tier::Smoke,
        ..steady(Variant::TpmVpQuadratic, 25, 0)
    },
];

/// Every method, in the order of legends.
pub(super) const VARIANTS: [Variant; 2] = [Variant::TpmVpQuadratic, Variant::MpmVp];

/// Relaxation time towards PIC, s.
fn relaxation(run: &Run) -> f64 {
    spacing(run.cells_across).powi(2) / (6.0 * SPREAD * viscosity(run.reynolds))
}

/// Settings of a run.
pub(super) fn settings(run: &Run) -> Settings {
    let rebuilds = run.variant == Variant::TpmVpQuadratic;
    let rearrangement =
        Rearrangement { fill: Some(FILL), shift: Some(SHIFT), ..Rearrangement::default() };
    Settings {
        blend: Blend::RelaxationTime(relaxation(run)),
        positivity: Some(POSITIVITY),
        leverage: Some(LEVERAGE),
        point_volume: PointVolume::CellCenter,
        pressure_limiter: Some(PressureLimiter::BarthJespersen),
        // Methods with carried values neither fill nor shift.
        rearrangement: rebuilds.then_some(rearrangement),
        ..Settings::default()
    }
}

/// One line of settings for the notes of tables.
pub(super) fn text() -> String {
    format!(
        "All runs: FLIP with the share 1 − Δt/τ, τ = h²/(6 ε ν), ε = {SPREAD}; stress updated last; Δt = \
         {COURANT} of the stable one; pressure slopes in cells limited after Barth and Jespersen; \
         moving least squares over 1 cell, positivity θ = {POSITIVITY}, leverage Λ = {LEVERAGE}; methods \
         that rebuild fields: fractures filled with {FILL:?}, points pushed apart with {SHIFT:?}. c₀ = \
         {SOUND_SPEED} m/s, 4 points per cell on a lattice at the start; the outflow relaxes the last D of the \
         channel in {OUTFLOW_TIME} s. A run whose kinetic energy exceeds \
         {MOST_ENERGY} times that at the start has blown up."
    )
}
