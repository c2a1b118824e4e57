//! The pressure at the base of a column on which gravity is switched on.

use std::f64::consts::TAU;

use transpoint::Observation;

use super::scene::{Setup, base};

/// Quantities of one offset: root mean square error of the base pressure over ρgH; by how much the height
/// that the period stands for is too high, in cells; relative loss of the first harmonic per period.
pub(super) const QUANTITIES: [&str; 3] = ["base-pressure", "height", "damping"];

/// Periods of the exact wave in a run.
pub(super) const PERIODS: usize = 5;

/// Base pressures, found and exact, over ρgH.
#[derive(Clone, Debug, Default)]
pub(super) struct Watch {
    /// One entry per step.
    pub(super) history: Vec<[f64; 2]>,
}

impl Watch {
    /// Takes account of a state.
    ///
    /// Velocities stand half a step back (ADR 0006). They are zero at the start, so gravity was switched
    /// on half a step before.
    pub(super) fn see(&mut self, setup: &Setup, state: &Observation<2>) {
        let (exact, time) = (setup.loaded(), state.time + 0.5 * setup.dt);
        let values = base(state, |y| exact.pressure(y, time));
        self.history.push(values.map(|value| value / setup.static_pressure()));
    }

    /// In the order of [`QUANTITIES`].
    pub(super) fn values(&self, height: f64) -> [f64; 3] {
        let squares: f64 = self.history.iter().map(|[found, exact]| (found - exact).powi(2)).sum();
        let rms = (squares / self.history.len() as f64).sqrt();
        let [faster, loss] = frequency_and_loss(&self.history);
        [rms, -faster / (1.0 + faster) * height, loss]
    }
}

/// Relative error of the frequency and relative loss of amplitude per period.
///
/// The first harmonic of each period, beside that of the exact wave, has a phase and a logarithm of its
/// amplitude; straight lines through them. Phases are unwrapped from period to period.
pub(super) fn frequency_and_loss(history: &[[f64; 2]]) -> [f64; 2] {
    let steps = history.len() / PERIODS;
    let (mut phases, mut logarithms) = ([0.0; PERIODS], [0.0; PERIODS]);
    let mut phase = 0.0;
    for (period, values) in history.chunks_exact(steps.max(1)).take(PERIODS).enumerate() {
        let harmonic = |which: usize| {
            let mut sums = [0.0; 2];
            for (k, value) in values.iter().enumerate() {
                let (sine, cosine) = (TAU * k as f64 / steps as f64).sin_cos();
                sums[0] += value[which] * cosine;
                sums[1] += value[which] * sine;
            }
            (sums[0].hypot(sums[1]), sums[1].atan2(sums[0]))
        };
        let (found, exact) = (harmonic(0), harmonic(1));
        // −cos(ωt + φ) has the angle π − φ here.
        let turn = (exact.1 - found.1 - phase) / TAU;
        phase += TAU * (turn - turn.round());
        phases[period] = phase;
        logarithms[period] = (found.0 / exact.0).ln();
    }
    [slope(phases) / TAU, 1.0 - slope(logarithms).exp()]
}

/// Slope of the least-squares line through values at the periods.
fn slope(values: [f64; PERIODS]) -> f64 {
    let middle = 0.5 * (PERIODS - 1) as f64;
    let (mut product, mut square) = (0.0, 0.0);
    for (period, value) in values.into_iter().enumerate() {
        let from_middle = period as f64 - middle;
        product += from_middle * value;
        square += from_middle * from_middle;
    }
    product / square
}
