//! The sixteen hard cases and the runs that they are judged by, and two long runs that judge none of them.

use super::trial::{Measured, Trial};
use super::{
    cell_crossing, checkerboard, frozen_spectrum, impact, ledger, locking, long_runs, mach_courant,
    single_points, slender_cells, small_cut, tension, vortex, waves,
};
use crate::case::Tier;

/// A bound of a measured number, set before the first run.
#[derive(Clone, Copy, Debug)]
pub(super) struct Goal {
    /// Which number.
    pub(super) quantity: &'static str,
    /// Smallest value that passes.
    pub(super) lower: f64,
    /// Largest value that passes.
    pub(super) upper: f64,
}

impl Goal {
    /// At most a number.
    pub(super) const fn below(quantity: &'static str, upper: f64) -> Self {
        Self { quantity, lower: f64::NEG_INFINITY, upper }
    }

    /// Between two numbers.
    pub(super) const fn within(quantity: &'static str, [lower, upper]: [f64; 2]) -> Self {
        Self { quantity, lower, upper }
    }

    /// At least a number.
    pub(super) const fn above(quantity: &'static str, lower: f64) -> Self {
        Self { quantity, lower, upper: f64::INFINITY }
    }

    /// Whether a value is within the bounds, which belong to the range; what is not a number is not.
    pub(super) fn is_met(&self, value: f64) -> bool {
        value >= self.lower && value <= self.upper
    }
}

/// What is known to fail, and what has to hold for a method to pass.
#[derive(Clone, Copy, Debug)]
pub(super) struct HardCase {
    /// Its name.
    pub(super) name: &'static str,
    /// Name of the run that it is judged by.
    pub(super) run: &'static str,
    /// The criterion in words.
    pub(super) criterion: &'static str,
    /// The criterion in numbers; the first is shown. All have to be met.
    pub(super) goals: &'static [Goal],
}

/// A set-up that every variant runs.
#[derive(Clone, Copy)]
pub(super) struct Run {
    /// The layout of its records.
    pub(super) name: &'static str,
    /// Cell size, m.
    pub(super) spacing: f64,
    /// The first tier that has it.
    pub(super) tier: Tier,
    /// What it measures, in order.
    pub(super) quantities: &'static [&'static str],
    /// Builds, steps and measures.
    pub(super) execute: fn(&Trial<'_>) -> Measured,
}

/// Every run.
pub(super) static RUNS: [Run; 16] = [
    cell_crossing::RUN,
    waves::DISORDER_RUN,
    frozen_spectrum::RUN,
    waves::LONG_TIME_RUN,
    vortex::RUN,
    tension::RUN,
    checkerboard::RUN,
    locking::RUN,
    single_points::RUN,
    small_cut::RUN,
    mach_courant::RUN,
    slender_cells::RUN,
    impact::RUN,
    ledger::RUN,
    long_runs::DROP_RUN,
    long_runs::TANK_RUN,
];

/// Every hard case, in the order of the atlas.
pub(super) static CASES: [HardCase; 16] = [
    cell_crossing::CASE,
    waves::DISORDER,
    frozen_spectrum::CASE,
    waves::LONG_TIME,
    vortex::FRACTURE,
    vortex::CLUMPING,
    tension::CASE,
    checkerboard::CASE,
    vortex::NULL_SPACE,
    locking::CASE,
    single_points::CASE,
    small_cut::CASE,
    mach_courant::CASE,
    slender_cells::CASE,
    impact::CASE,
    ledger::CASE,
];
