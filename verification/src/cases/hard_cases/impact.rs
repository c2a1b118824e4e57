//! Hard case 15, `impact`: the blow of water on a wall.
//!
//! A peak of pressure is a matter of chance and of the time step; the impulse is what moves a wall. The dam break of
//! case `dam-break` on cells of 60 mm with 2 x 2 points, pressure on the far wall at 60 mm, integrated over 1 of T
//! from the instant at which the water has reached that height at the wall,
//!
//! ```text
//! ∫ p/(ρ g h₀) dT
//! ```
//!
//! beside that of the volume-of-fluid run on cells of 10 mm \[Roenby2016\], which begins where its own run-up does.
//! The experiment \[Zhou1999\] has no probe at this height, and at 160 mm no inviscid computation in two dimensions
//! lies on its plateau.

use transpoint::Simulation;

use super::list::{Goal, HardCase, Run};
use super::trial::{Measured, Trial, march_until, refused};
use crate::case::Tier;
use crate::cases::dam_break::{PLACES, SOUND_SPEED, Wall, scaled_time, tank};
use crate::cases::free_surface::RELAXATION;
use crate::reference::dam_break::{VofQuantity, VofSpacing, vof};

/// Cell size, m.
const SPACING: f64 = 0.06;
/// Points per cell and axis.
const POINTS_PER_AXIS: usize = 2;
/// Height of the probe, m, and its name.
const PROBE: (f64, &str) = (0.06, "60mm");
/// T at the end, at which the water has been at the wall for long.
const END: f64 = 2.6;
/// T over which the pressure is integrated.
const DURATION: f64 = 1.0;

/// The run.
pub(super) const RUN: Run = Run {
    name: "impact",
    spacing: SPACING,
    tier: Tier::Paper,
    quantities: &["impulse-error", "impulse", "impulse-vof", "wetting", "wetting-vof"],
    execute,
};

/// The hard case.
pub(super) const CASE: HardCase = HardCase {
    name: "impact",
    run: RUN.name,
    criterion: "dam break: impulse at 60 mm on the far wall, over 1 of T from first wetting, within 5 % of that of a \
                volume-of-fluid run",
    goals: &[Goal::below("impulse-error", 0.05)],
};

/// First T at which a height is reached, in pairs of T and height.
fn first_above(heights: &[(f64, f64)], least: f64) -> Option<f64> {
    heights.iter().find(|(_, height)| *height >= least).map(|(time, _)| *time)
}

/// ∫ p dT by the trapezium rule from `start` over [`DURATION`]; not a number where the record ends before.
pub(super) fn impulse(pressures: &[(f64, f64)], start: f64) -> f64 {
    let end = start + DURATION;
    // Also where there is no start.
    if !pressures.last().is_some_and(|(time, _)| *time >= end) {
        return f64::NAN;
    }
    let mut sum = 0.0;
    for pair in pressures.windows(2) {
        let [(t0, p0), (t1, p1)] = [pair[0], pair[1]];
        let (from, to) = (t0.max(start), t1.min(end));
        if from < to {
            let at = |t: f64| p0 + (p1 - p0) * (t - t0) / (t1 - t0);
            sum += 0.5 * (at(from) + at(to)) * (to - from);
        }
    }
    sum
}

fn execute(trial: &Trial<'_>) -> Measured {
    let read = |quantity| vof(VofSpacing::Millimeters10, quantity).map_err(|error| refused(&error));
    let (run_up, pressure) = (read(VofQuantity::RunUp)?, read(VofQuantity::Pressure60)?);
    let scene = tank(SPACING, POINTS_PER_AXIS);
    let settings = trial.surface(POINTS_PER_AXIS, SPACING, SOUND_SPEED, RELAXATION);
    let mut simulation = trial.plane(&scene, &settings)?;
    let place = PLACES.iter().position(|name| *name == PROBE.1).unwrap_or(0);
    let begin = (scene.grid.cells[0] - 1) as f64 * SPACING;
    let (mut heights, mut pressures) = (Vec::new(), Vec::new());
    march_until(simulation.as_mut(), END / scaled_time(1.0), |state: &dyn Simulation<2>| {
        let (mut wall, mut height) = (Wall::new(&scene.grid), 0.0_f64);
        state.visit_points(&mut |point| {
            wall.add(point);
            if point.position[0] >= begin {
                height = height.max(point.position[1] + 0.5 * SPACING / POINTS_PER_AXIS as f64);
            }
        });
        let time = scaled_time(state.time());
        heights.push((time, height));
        pressures.push((time, wall.pressures()[place]));
    })?;
    let starts = [&heights, &run_up.points].map(|heights| first_above(heights, PROBE.0));
    let starts = starts.map(|start| start.unwrap_or(f64::NAN));
    let found = impulse(&pressures, starts[0]);
    let expected = impulse(&pressure.points, starts[1]);
    Ok(vec![(found / expected - 1.0).abs(), found, expected, starts[0], starts[1]])
}
