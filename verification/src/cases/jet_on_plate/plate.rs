//! Pressure and force on the plate at an instant, from the points.

use transpoint::Simulation;
use transpoint::scene::GridSpec;
use transpoint::simulation::PointState;

use super::scene::JET;

/// Height of the plane through which the momentum is measured, b.
const PLANE: f64 = 1.5;

/// What is measured of an instant.
#[derive(Clone, Debug, PartialEq)]
pub(super) struct Plate {
    /// Mean pressure over the points in each cell on the plate, Pa; zero where there are none: nothing
    /// presses on the plate then.
    pub(super) pressures: Vec<f64>,
    /// Points in each of these cells.
    pub(super) counts: Vec<u32>,
    /// Σ (m v² + p V)/h over the points in the layer of cells at 1.5 b: the flux of momentum through it, N/m.
    pub(super) momentum: f64,
    /// Σ m, kg/m.
    pub(super) mass: f64,
    /// Σ ½ m v² over Σ m, J/kg.
    pub(super) energy: f64,
}

impl Plate {
    /// Sums over the points of a simulation.
    pub(super) fn of(grid: &GridSpec<2>, simulation: &dyn Simulation<2>) -> Self {
        let (h, n) = (grid.spacing[0], grid.cells[0]);
        let layer = (PLANE * JET.width / h).round() as usize;
        let mut plate = Self {
            pressures: vec![0.0; n],
            counts: vec![0; n],
            momentum: 0.0,
            mass: 0.0,
            energy: 0.0,
        };
        simulation.visit_points(&mut |point: &PointState<2>| {
            let row = (point.position[1] / h) as usize;
            if row == 0 {
                let column = ((point.position[0] - grid.origin[0]) / h) as usize;
                plate.pressures[column.min(n - 1)] += point.pressure;
                plate.counts[column.min(n - 1)] += 1;
            } else if row == layer {
                let flux = point.mass * point.velocity[1].powi(2) + point.pressure * point.volume();
                plate.momentum += flux / h;
            }
            plate.mass += point.mass;
            plate.energy += 0.5 * point.mass * point.velocity.iter().map(|v| v * v).sum::<f64>();
        });
        plate.energy /= plate.mass;
        for (pressure, &count) in plate.pressures.iter_mut().zip(&plate.counts) {
            *pressure /= f64::from(count.max(1));
        }
        plate
    }

    /// ∫ p dx, N/m.
    pub(super) fn force(&self, spacing: f64) -> f64 {
        self.pressures.iter().sum::<f64>() * spacing
    }
}

/// Distances of the middles of the cells on the plate from the axis, signed, m.
pub(super) fn places(grid: &GridSpec<2>) -> Vec<f64> {
    (0..grid.cells[0]).map(|k| grid.origin[0] + (k as f64 + 0.5) * grid.spacing[0]).collect()
}

/// L2 norm of p − p_exact over |x| ≤ `reach` (m) over that of p_exact, from the middles of cells.
pub(super) fn relative_l2(places: &[f64], pressures: &[f64], reach: f64) -> f64 {
    let (mut error, mut scale) = (0.0, 0.0);
    for (&x, &pressure) in places.iter().zip(pressures).filter(|(x, _)| x.abs() <= reach) {
        let exact = JET.pressure(x);
        error += (pressure - exact).powi(2);
        scale += exact * exact;
    }
    (error / scale).sqrt()
}

/// L2 norm of p(x) − p(−x) over that of p, of places that lie symmetrically; zero of half a jet.
pub(super) fn asymmetry(places: &[f64], pressures: &[f64]) -> f64 {
    if places.first().is_none_or(|&x| x > 0.0) {
        return 0.0;
    }
    let difference = pressures.iter().zip(pressures.iter().rev()).map(|(a, b)| (a - b).powi(2));
    let scale: f64 = pressures.iter().map(|p| p * p).sum();
    (difference.sum::<f64>() / scale).sqrt()
}
