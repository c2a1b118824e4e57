//! Stepping a simulation through a fixed number of equal steps.

use transpoint::Simulation;

use crate::case::Outcome;
use crate::progress::Progress;

/// Takes `steps` steps of `dt` seconds, calls `after` each of them, and says how it ended.
pub(super) fn march<const D: usize>(
    simulation: &mut dyn Simulation<D>,
    dt: f64,
    steps: u64,
    progress: &Progress,
    mut after: impl FnMut(&dyn Simulation<D>),
) -> Outcome {
    for step in 0..steps {
        if let Err(error) = simulation.step(dt) {
            let (time, reason) = (simulation.time(), error.to_string());
            return Outcome::BlownUp { step, time, reason };
        }
        after(simulation);
        progress.advance(step + 1, steps);
    }
    Outcome::Completed
}
