//! Steps a simulation with its progress and its blow-up.

use std::collections::BTreeMap;
use std::ops::Range;

use transpoint::Simulation;

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

/// Work and event counters of a simulation by name.
pub fn counters<const D: usize>(simulation: &dyn Simulation<D>) -> BTreeMap<String, u64> {
    let entries = simulation.counters().entries();
    entries.into_iter().map(|(name, count)| (name.to_owned(), count)).collect()
}
