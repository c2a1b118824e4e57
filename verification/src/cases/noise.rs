//! Noise that grows: whether a simulation is stable with a time step, by trial.

use transpoint::Simulation;

/// Velocities at the start over the speed of sound: the points do not leave their places.
pub const AMPLITUDE: f64 = 1e-9;
/// Root mean square velocity over that at the start at which a trial counts as unstable.
pub const MOST_GROWTH: f64 = 2.0;
/// Points over those at the start at which a trial counts as unstable: what is stretched without bound is split without
/// bound.
const MOST_POINTS: usize = 4;
/// Steps between two measurements: growth shows now and then, and asking after each step would cost as much as a step.
const STRIDE: u64 = 50;

/// A number in [−1, 1) from 64 random bits.
pub fn signed(bits: u64) -> f64 {
    (bits >> 11) as f64 * 2f64.powi(-52) - 1.0
}

/// Whether velocities stay within [`MOST_GROWTH`] of those at the start over some steps of `dt` seconds.
pub fn stays_small<const D: usize>(
    simulation: &mut dyn Simulation<D>,
    dt: f64,
    steps: u64,
) -> bool {
    let start = speed(simulation);
    let most_points = MOST_POINTS * simulation.n_points();
    let mut most: f64 = 0.0;
    for step in 1..=steps {
        if simulation.step(dt).is_err() || simulation.n_points() > most_points {
            return false;
        }
        if step % STRIDE == 0 {
            most = most.max(speed(simulation) / start);
        }
    }
    most <= MOST_GROWTH
}

/// Root mean square velocity.
fn speed<const D: usize>(simulation: &dyn Simulation<D>) -> f64 {
    let (mut sum, mut n) = (0.0, 0.0);
    simulation.visit_points(&mut |point| {
        sum += point.velocity.iter().map(|v| v * v).sum::<f64>();
        n += 1.0;
    });
    (sum / n).sqrt()
}
