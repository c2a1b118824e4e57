//! Hard case 12, `small-cut`: a surface anywhere in a cell.
//!
//! Where the surface cuts off a sliver of a cell, mass and force enter its nodes by different rules, and a ratio of
//! two small numbers moves what should be at rest. The column of case `column`, 32 cells and θ of another high, in
//! equilibrium at the start, at 50 offsets θ over 10 H/c, with the policy of free surfaces.
//!
//! Sound sets the scale of what an imbalance at the surface moves, g h/c times a number of each method: 0.06 to 0.15
//! for the best. With c = 31.6 √(gH) the criterion asks for 0.1 on 32 cells; on 4 cells no method meets it.

use transpoint::Simulation;

use super::list::{Goal, HardCase, Run};
use super::trial::{COURANT, Measured, Trial, march, worse};
use crate::case::Tier;
use crate::cases::column::at_rest;
use crate::cases::free_surface::RELAXATION;

/// Full cells of the column.
const CELLS: usize = 32;
/// Offsets.
const OFFSETS: usize = 50;
/// Duration, H/c.
const DURATION: f64 = 10.0;
/// Steps between two measurements: shorter than the shortest wave.
const STRIDE: u64 = 3;

/// The run.
pub(super) const RUN: Run = Run {
    name: "small-cut",
    spacing: 1.0,
    tier: Tier::Full,
    quantities: &["velocity", "velocity-median", "worst-theta"],
    execute,
};

/// The hard case.
pub(super) const CASE: HardCase = HardCase {
    name: "small-cut",
    run: RUN.name,
    criterion: "column at rest, its surface at 50 places within a cell: |v| below 10⁻⁴ √(gH) over 10 H/c",
    goals: &[Goal::below("velocity", 1e-4)],
};

fn execute(trial: &Trial<'_>) -> Measured {
    let mut found = Vec::new();
    for offset in 0..OFFSETS {
        let theta = (offset as f64 + 0.5) / OFFSETS as f64;
        let (scene, height, sound_speed) = at_rest(CELLS, theta);
        let settings = trial.surface(2, scene.grid.spacing[0], sound_speed, RELAXATION);
        let mut simulation = trial.plane(&scene, &settings)?;
        let dt = simulation.stable_dt(COURANT).dt;
        let steps = (DURATION * height / sound_speed / dt).ceil() as u64;
        let scale = (-scene.body_force[1] * height).sqrt();
        let mut fastest = 0.0;
        march(simulation.as_mut(), dt, steps, |step, state: &dyn Simulation<2>| {
            if step % STRIDE == 0 {
                state.visit_points(&mut |point| {
                    let [u, v] = point.velocity;
                    fastest = worse(fastest, u.hypot(v) / scale);
                });
            }
        })?;
        found.push((fastest, theta));
    }
    found.sort_by(|a, b| a.0.total_cmp(&b.0));
    let (worst, theta) = found[OFFSETS - 1];
    Ok(vec![worst, found[OFFSETS / 2].0, theta])
}
