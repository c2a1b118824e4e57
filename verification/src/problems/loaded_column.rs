//! Problem `loaded-column`: a column on which gravity is switched on, with its surface in the middle of a cell.
//!
//! H = 1 m in (n + ½) cells, g H/c₀² = 10⁻⁴, two periods 4H/c₀. The pressure at the base is a triangle wave between
//! 0 and 2 ρ₀ g H, [`LoadedColumn`]. It is read as the mean over the points of the lowest cell beside the mean of the
//! exact pressure at their places, after each step. The wave has corners, so that no method keeps its full order.

use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::{Scene, Simulation};

use super::{End, ErrorKind, Gauge, Problem, Resolution, SetUp};
use crate::cases::{free_surface, lattice};
use crate::exact::loaded_column::LoadedColumn;

/// H, m.
const HEIGHT: f64 = 1.0;
/// g, m/s².
const GRAVITY: f64 = 9.81;
/// ρ₀, kg/m³.
const DENSITY: f64 = 1000.0;
/// g H/c₀².
const COMPRESSION: f64 = 1e-4;
/// Share of the cell of the surface that is wet.
const THETA: f64 = 0.5;
/// Cells of air above that cell.
const AIR: usize = 1;
/// Periods 4H/c₀.
const PERIODS: f64 = 2.0;

/// The problem `loaded-column`.
#[derive(Clone, Copy, Debug)]
pub struct SuddenLoad;

fn column() -> LoadedColumn {
    LoadedColumn {
        height: HEIGHT,
        gravity: GRAVITY,
        density: DENSITY,
        sound_speed: (GRAVITY * HEIGHT / COMPRESSION).sqrt(),
    }
}

impl Problem<1> for SuddenLoad {
    fn name(&self) -> &'static str {
        "loaded-column"
    }

    fn about(&self) -> &'static str {
        "column on which gravity is switched on, surface in the middle of a cell, base pressure over two periods \
         (exact, linear [MorseIngard1968])"
    }

    fn levels(&self) -> &'static [usize] {
        &[16, 32, 64, 128]
    }

    fn spacing(&self, cells: usize) -> f64 {
        HEIGHT / (cells as f64 + THETA)
    }

    fn errors(&self) -> &'static [ErrorKind] {
        &[ErrorKind { quantity: "base-pressure", norm: "rms-over-static" }]
    }

    fn has_free_surface(&self) -> bool {
        true
    }

    fn set_up(&self, resolution: &Resolution) -> SetUp<1> {
        let (cells, per_axis) = (resolution.cells, resolution.points_per_axis);
        let h = self.spacing(cells);
        let count = (HEIGHT / h * per_axis as f64).round() as usize;
        let spacing = HEIGHT / count as f64;
        let points = lattice::lattice([count], spacing, resolution.jitter, resolution.seed)
            .into_iter()
            .map(|position| PointSpec::new(position, [0.0], DENSITY, DENSITY * spacing))
            .collect();
        let sound_speed = column().sound_speed;
        let mut scene = Scene::new(
            GridSpec { origin: [0.0], spacing: [h], cells: [cells + 1 + AIR] },
            [[Boundary::Slip, Boundary::Free]],
            EquationOfStateSpec::WeaklyCompressible { reference_density: DENSITY, sound_speed },
            points,
        );
        scene.body_force = [-GRAVITY];
        let relaxation = free_surface::INFLOW_RELAXATION;
        let settings = free_surface::settings(per_axis, h, sound_speed, relaxation);
        SetUp { scene, settings, end: PERIODS * column().period() }
    }

    fn gauge(&self, resolution: &Resolution) -> Box<dyn Gauge<1>> {
        let lowest = self.spacing(resolution.cells);
        Box::new(Base { lowest, last: 0.0, count: 0.0, squares: 0.0 })
    }
}

/// The base pressure over time.
struct Base {
    /// Upper face of the lowest cell, m.
    lowest: f64,
    /// Time of the step before, s.
    last: f64,
    count: f64,
    squares: f64,
}

impl Gauge<1> for Base {
    /// Velocities stand half a step back, the stress being updated last (ADR 0006). They are zero at the start, so
    /// that gravity was switched on half a step before.
    fn watch(&mut self, simulation: &dyn Simulation<1>) {
        let exact = column();
        let time = simulation.time() + 0.5 * (simulation.time() - self.last);
        self.last = simulation.time();
        let (mut count, mut difference) = (0.0, 0.0);
        simulation.visit_points(&mut |point| {
            if point.position[0] < self.lowest {
                count += 1.0;
                difference += point.pressure - exact.pressure(point.position[0], time);
            }
        });
        self.count += 1.0;
        self.squares += (difference / count / exact.static_pressure()).powi(2);
    }

    fn errors(&mut self, _end: &End<'_, 1>) -> Vec<f64> {
        vec![(self.squares / self.count).sqrt()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_surface_lies_within_a_cell_for_any_number_of_points() {
        for points_per_axis in [2, 3] {
            let resolution = Resolution { cells: 16, points_per_axis, jitter: 0.0, seed: 1 };
            let scene = SuddenLoad.set_up(&resolution).scene;
            let mass: f64 = scene.points.iter().map(|point| point.mass).sum();
            assert!((mass - 1000.0).abs() < 1e-9, "{mass}");
            let surface = HEIGHT / scene.grid.spacing[0];
            assert!((surface.fract() - 0.5).abs() < 1e-12, "{surface}");
        }
    }
}
