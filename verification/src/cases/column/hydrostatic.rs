//! What moves in a column that should be at rest.

use transpoint::Observation;

use super::scene::{Setup, base};

/// Quantities of one offset, each the largest over time: |v|/√(gH) over the points; error of the mean
/// pressure of the lowest cells; root mean square error of the pressure over the points. Both over ρgH.
pub(super) const QUANTITIES: [&str; 3] = ["velocity", "base-pressure", "pressure"];

/// Steps between two measurements: shorter than the shortest wave, which takes 2h/c.
pub(super) const STRIDE: u64 = 3;

/// The largest values so far.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Watch {
    /// In the order of [`QUANTITIES`].
    pub(super) largest: [f64; 3],
}

impl Watch {
    /// Takes account of a state; what is not a number counts as infinite.
    pub(super) fn see(&mut self, setup: &Setup, state: &Observation<2>) {
        let exact = setup.at_rest();
        let (mut speed, mut squares) = (0.0_f64, 0.0);
        for point in &state.points {
            let [u, v] = point.velocity;
            speed = speed.max(u.hypot(v));
            squares += (point.pressure - exact.pressure(point.position[1])).powi(2);
        }
        let [found, expected] = base(state, |y| exact.pressure(y));
        let rms = (squares / state.points.len() as f64).sqrt();
        let pressure = setup.static_pressure();
        let values = [speed / setup.speed(), (found - expected).abs() / pressure, rms / pressure];
        for (largest, value) in self.largest.iter_mut().zip(values) {
            *largest = if value.is_nan() { f64::INFINITY } else { largest.max(value) };
        }
    }

    /// Whether a point has reached √(gH): a column that flies apart is no better than one that stops the
    /// solver.
    pub(super) fn is_lost(&self) -> bool {
        self.largest[0] >= 1.0
    }
}
