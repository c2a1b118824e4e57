//! Hard case 10, `locking`: more points per cell that do not help.
//!
//! Each point of a cell asks for its own volume to stay; a linear hat has one divergence to give. Where the points
//! of a cell lock each other, the flow depends on how many there are. The dam break of case `dam-break` on cells of
//! 75 mm with 1, 2 x 2, 3 x 3 and 4 x 4 points per cell, to T = 0.8, before the water reaches the far wall. The
//! front is half a point spacing ahead of the foremost point. `spread-without-1` leaves out the run with a single
//! point per cell, which is the one that lags.

use super::list::{Goal, HardCase, Run};
use super::trial::{Measured, Trial, march_until};
use crate::case::Tier;
use crate::cases::dam_break::{SOUND_SPEED, scaled_time, tank};
use crate::cases::free_surface::RELAXATION;

/// Cell size, m.
const SPACING: f64 = 0.075;
/// T at the end.
const END: f64 = 0.8;

/// The run.
pub(super) const RUN: Run = Run {
    name: "locking",
    spacing: SPACING,
    tier: Tier::Full,
    quantities: &["spread", "spread-without-1", "front-1", "front-2", "front-3", "front-4"],
    execute,
};

/// The hard case.
pub(super) const CASE: HardCase = HardCase {
    name: "locking",
    run: RUN.name,
    criterion: "dam break with 1, 4, 9 and 16 points per cell: fronts at T = 0.8 within 2 % of their mean",
    goals: &[Goal::below("spread", 0.02)],
};

/// Range of some numbers over their mean.
pub(super) fn spread(values: &[f64]) -> f64 {
    let mean = values.iter().sum::<f64>() / values.len() as f64;
    let most = values.iter().copied().fold(f64::NEG_INFINITY, f64::max);
    let least = values.iter().copied().fold(f64::INFINITY, f64::min);
    (most - least) / mean
}

fn execute(trial: &Trial<'_>) -> Measured {
    let mut fronts = Vec::new();
    for points_per_axis in 1..=4 {
        let settings = trial.surface(points_per_axis, SPACING, SOUND_SPEED, RELAXATION);
        let mut simulation = trial.plane(&tank(SPACING, points_per_axis), &settings)?;
        march_until(simulation.as_mut(), END / scaled_time(1.0), |_| ())?;
        let mut front = 0.5 * SPACING / points_per_axis as f64;
        let half = front;
        simulation.visit_points(&mut |point| front = front.max(point.position[0] + half));
        fronts.push(front);
    }
    Ok([spread(&fronts), spread(&fronts[1..])].into_iter().chain(fronts).collect())
}
