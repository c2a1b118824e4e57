//! Problem `hydrostatic-tank`: water at rest in a closed tank, its surface in the middle of a row of cells.
//!
//! H = 1 m in (n + ½) cells, as wide as n of them, slip walls, c₀ = 10 √(gH), 20 H/c₀. The start is the equilibrium
//! of [`HydrostaticColumn`] at the points, so that nothing should move. What moves is the error of the method: the
//! forces on the nodes do not cancel where points are disordered or the cell is partly full.

use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::{Scene, Simulation};

use super::{End, ErrorKind, Gauge, Problem, Resolution, SetUp};
use crate::cases::{free_surface, lattice};
use crate::exact::hydrostatic_column::HydrostaticColumn;

/// H, m.
const HEIGHT: f64 = 1.0;
/// g, m/s².
const GRAVITY: f64 = 9.81;
/// ρ₀, kg/m³.
const DENSITY: f64 = 1000.0;
/// c₀/√(gH).
const STIFFNESS: f64 = 10.0;
/// Share of the cells of the surface that is wet.
const THETA: f64 = 0.5;
/// Cells of air above those.
const AIR: usize = 1;
/// Duration, H/c₀.
const DURATION: f64 = 20.0;

/// The problem `hydrostatic-tank`.
#[derive(Clone, Copy, Debug)]
pub struct Tank;

/// √(gH), m/s.
fn speed() -> f64 {
    (GRAVITY * HEIGHT).sqrt()
}

fn at_rest() -> HydrostaticColumn {
    HydrostaticColumn {
        height: HEIGHT,
        gravity: GRAVITY,
        density: DENSITY,
        sound_speed: STIFFNESS * speed(),
    }
}

impl Problem<2> for Tank {
    fn name(&self) -> &'static str {
        "hydrostatic-tank"
    }

    fn about(&self) -> &'static str {
        "water at rest in a closed tank, surface in the middle of a cell, 20 H/c₀ (exact)"
    }

    fn levels(&self) -> &'static [usize] {
        &[8, 12, 16, 24]
    }

    fn spacing(&self, cells: usize) -> f64 {
        HEIGHT / (cells as f64 + THETA)
    }

    fn errors(&self) -> &'static [ErrorKind] {
        &[
            ErrorKind { quantity: "pressure", norm: "rms-over-base" },
            ErrorKind { quantity: "velocity", norm: "rms-over-sqrt(gH)" },
            ErrorKind { quantity: "largest-velocity", norm: "over-sqrt(gH)" },
        ]
    }

    fn has_free_surface(&self) -> bool {
        true
    }

    fn expected_order(&self) -> Option<(f64, f64)> {
        Some((0.8, 2.5))
    }

    fn set_up(&self, resolution: &Resolution) -> SetUp<2> {
        let (cells, per_axis) = (resolution.cells, resolution.points_per_axis);
        let h = self.spacing(cells);
        let rows = (HEIGHT / h * per_axis as f64).round() as usize;
        let [across, along] = [h / per_axis as f64, HEIGHT / rows as f64];
        let column = at_rest();
        let counts = [cells * per_axis, rows];
        let points = lattice::lattice(counts, 1.0, resolution.jitter, resolution.seed)
            .into_iter()
            .map(|[x, y]| {
                let position = [x * across, y * along];
                let density = column.density(position[1]);
                PointSpec::new(position, [0.0; 2], density, density * across * along)
            })
            .collect();
        let mut scene = Scene::new(
            GridSpec { origin: [0.0; 2], spacing: [h; 2], cells: [cells, cells + 1 + AIR] },
            [[Boundary::Slip; 2]; 2],
            EquationOfStateSpec::WeaklyCompressible {
                reference_density: DENSITY,
                sound_speed: column.sound_speed,
            },
            points,
        );
        scene.body_force = [0.0, -GRAVITY];
        let relaxation = free_surface::INFLOW_RELAXATION;
        let settings = free_surface::settings(per_axis, h, column.sound_speed, relaxation);
        SetUp { scene, settings, end: DURATION * HEIGHT / column.sound_speed }
    }

    fn gauge(&self, _resolution: &Resolution) -> Box<dyn Gauge<2>> {
        Box::new(Rest { largest: 0.0 })
    }
}

struct Rest {
    /// Largest |v|² of any point so far, m²/s².
    largest: f64,
}

impl Gauge<2> for Rest {
    fn watch(&mut self, simulation: &dyn Simulation<2>) {
        simulation.visit_points(&mut |point| {
            self.largest = self.largest.max(point.velocity.iter().map(|v| v * v).sum());
        });
    }

    fn errors(&mut self, end: &End<'_, 2>) -> Vec<f64> {
        let column = at_rest();
        let (mut volume, mut pressure, mut velocity) = (0.0, 0.0, 0.0);
        for point in end.simulation.observe().points {
            let error = point.pressure - column.pressure(point.position[1]);
            volume += point.volume();
            pressure += point.volume() * error * error;
            velocity += point.volume() * point.velocity.iter().map(|v| v * v).sum::<f64>();
        }
        vec![
            (pressure / volume).sqrt() / (DENSITY * GRAVITY * HEIGHT),
            (velocity / volume).sqrt() / speed(),
            self.largest.sqrt() / speed(),
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_water_weighs_what_it_should() {
        for points_per_axis in [2, 3] {
            let resolution = Resolution { cells: 8, points_per_axis, jitter: 0.0, seed: 1 };
            let scene = Tank.set_up(&resolution).scene;
            let mass: f64 = scene.points.iter().map(|point| point.mass).sum();
            let width = 8.0 * scene.grid.spacing[0];
            let exact = width * at_rest().mass(0.0, HEIGHT);
            assert!((mass / exact - 1.0).abs() < 1e-6, "{mass} {exact}");
        }
    }
}
