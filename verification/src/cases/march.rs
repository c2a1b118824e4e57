//! Steps a simulation with its progress and its blow-up.

use std::collections::BTreeMap;
use std::ops::Range;
use std::time::Instant;

use transpoint::Simulation;

use super::free_surface::{COURANT, STEPS_PER_TIME_STEP};
use crate::case::Outcome;
use crate::progress::Progress;

/// Takes the steps of a range with a fixed `dt` in s; `total` is the number of steps of the run.
pub fn march<const D: usize>(
    simulation: &mut dyn Simulation<D>,
    dt: f64,
    steps: Range<u64>,
    progress: (&Progress, u64),
) -> Outcome {
    march_watching(simulation, dt, steps, progress, |_| ())
}

/// The same, and calls `watch` after each step.
pub fn march_watching<const D: usize>(
    simulation: &mut dyn Simulation<D>,
    dt: f64,
    steps: Range<u64>,
    (progress, total): (&Progress, u64),
    mut watch: impl FnMut(&dyn Simulation<D>),
) -> Outcome {
    for step in steps {
        if let Err(error) = simulation.step(dt) {
            let (time, reason) = (simulation.time(), error.to_string());
            return Outcome::BlownUp { step, time, reason };
        }
        watch(simulation);
        progress.advance(step + 1, total);
    }
    Outcome::Completed
}

/// Steps to the time `end` (s) with the share of the stable time step of [`free_surface`](super::free_surface)
/// and calls `watch` after each step; the run has blown up where it returns a reason. Also returns the wall
/// time of the steps, s.
pub fn march_until<const D: usize>(
    simulation: &mut dyn Simulation<D>,
    end: f64,
    progress: &Progress,
    mut watch: impl FnMut(&dyn Simulation<D>) -> Option<String>,
) -> (Outcome, f64) {
    let (mut step, mut seconds) = (0, 0.0);
    let mut dt = f64::NAN;
    while simulation.time() < end {
        let start = Instant::now();
        if step % STEPS_PER_TIME_STEP == 0 {
            dt = simulation.stable_dt(COURANT).dt;
        }
        let stepped = simulation.step(dt);
        seconds += start.elapsed().as_secs_f64();
        let reason = match stepped {
            Ok(()) => watch(simulation),
            Err(error) => Some(error.to_string()),
        };
        if let Some(reason) = reason {
            return (Outcome::BlownUp { step, time: simulation.time(), reason }, seconds);
        }
        step += 1;
        let left = ((end - simulation.time()) / dt).max(0.0) as u64;
        progress.advance(step, step + left);
    }
    (Outcome::Completed, seconds)
}

/// Work and event counters of a simulation by name.
pub fn counters<const D: usize>(simulation: &dyn Simulation<D>) -> BTreeMap<String, u64> {
    let entries = simulation.counters().entries();
    entries.into_iter().map(|(name, count)| (name.to_owned(), count)).collect()
}
