//! Problems `hydrostatic-tank` and `tilted-tank`: water at rest in a closed tank, its surface within cells.
//!
//! H = 1 m, slip walls, c₀ = 10 √(gH), 20 H/c₀. The start is the equilibrium of [`HydrostaticTank`] at the points, so
//! that nothing should move. What moves is the error of the method: the forces on the nodes do not cancel where
//! points are disordered or the cell is partly full.
//!
//! `hydrostatic-tank`: H in (n + ½) cells, as wide as n of them; the surface halves all of its cells.
//!
//! `tilted-tank`: gravity is turned by 30° towards +x, so that the deepest place is the lower right corner and the
//! surface cuts cells obliquely, from 0.58 m at the left wall to 1.15 m at the right one, every cell at another height
//! since its slope is irrational. 1 m wide in n cells.
//!
//! The columns of the jittered lattice are stretched to end at the surface, each by less than a row, so that the boxes of
//! the points fill the water. Points of a lattice that is cut off at the surface would make up half a percent more or
//! less water than there is, and that would be the error of the pressure.

use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::{Scene, Simulation};

use super::{End, ErrorKind, Gauge, Problem, Resolution, SetUp};
use crate::cases::{free_surface, lattice};
use crate::exact::hydrostatic_column::HydrostaticColumn;
use crate::exact::hydrostatic_tank::HydrostaticTank;

/// H, m; the width of the tilted tank too.
const HEIGHT: f64 = 1.0;
/// g, m/s².
const GRAVITY: f64 = 9.81;
/// ρ₀, kg/m³.
const DENSITY: f64 = 1000.0;
/// c₀/√(gH).
const STIFFNESS: f64 = 10.0;
/// Share of the cells of the surface that is wet in the level tank.
const THETA: f64 = 0.5;
/// Cells of air above those.
const AIR: usize = 1;
/// Duration, H/c₀.
const DURATION: f64 = 20.0;

/// A tank, by the direction of gravity.
#[derive(Clone, Copy, Debug)]
pub struct Tank {
    /// Angle of gravity from −y towards +x, degrees, from 0 to 45.
    degrees: f64,
}

/// The problem `hydrostatic-tank`.
pub const LEVEL: Tank = Tank { degrees: 0.0 };

/// The problem `tilted-tank`.
pub const TILTED: Tank = Tank { degrees: 30.0 };

/// √(gH), m/s.
fn speed() -> f64 {
    (GRAVITY * HEIGHT).sqrt()
}

impl Tank {
    /// The exact answer.
    pub fn at_rest(self) -> HydrostaticTank {
        let (sine, cosine) = self.degrees.to_radians().sin_cos();
        HydrostaticTank {
            column: HydrostaticColumn {
                height: HEIGHT,
                gravity: GRAVITY,
                density: DENSITY,
                sound_speed: STIFFNESS * speed(),
            },
            down: [sine, -cosine],
            // The lower right corner, which is the deepest place of the tilted tank.
            floor: [HEIGHT, 0.0],
        }
    }

    fn is_tilted(self) -> bool {
        self.degrees > 0.0
    }

    fn points(self, resolution: &Resolution) -> Vec<PointSpec<2>> {
        let per_axis = resolution.points_per_axis;
        let h = self.spacing(resolution.cells);
        let across = h / per_axis as f64;
        let tank = self.at_rest();
        let column = |k: usize| tank.surface((k as f64 + 0.5) * across);
        let heights: Vec<f64> = (0..resolution.cells * per_axis).map(column).collect();
        let rows_of = |height: f64| (height / h * per_axis as f64).round() as usize;
        let rows = heights.iter().copied().map(rows_of).max().unwrap_or(0);
        lattice::lattice([heights.len(), rows], 1.0, resolution.jitter, resolution.seed)
            .into_iter()
            .enumerate()
            .map(|(k, place)| (heights[k / rows], k % rows, place))
            .filter(|&(height, row, _)| row < rows_of(height))
            .map(|(height, _, [x, y])| {
                let along = height / rows_of(height) as f64;
                let position = [x * across, y * along];
                let density = tank.density(position);
                PointSpec::new(position, [0.0; 2], density, density * across * along)
            })
            .collect()
    }
}

impl Problem<2> for Tank {
    fn name(&self) -> &'static str {
        if self.is_tilted() { "tilted-tank" } else { "hydrostatic-tank" }
    }

    fn about(&self) -> &'static str {
        if self.is_tilted() {
            "water at rest in a closed tank, gravity turned by 30° against the grid, 20 H/c₀ (exact)"
        } else {
            "water at rest in a closed tank, surface in the middle of a cell, 20 H/c₀ (exact)"
        }
    }

    fn levels(&self) -> &'static [usize] {
        &[8, 12, 16, 24]
    }

    fn spacing(&self, cells: usize) -> f64 {
        if self.is_tilted() { HEIGHT / cells as f64 } else { HEIGHT / (cells as f64 + THETA) }
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
        let h = self.spacing(resolution.cells);
        let tank = self.at_rest();
        let sound_speed = tank.column.sound_speed;
        // The surface is highest at the right wall.
        let high = (tank.surface(HEIGHT) / h).ceil() as usize + AIR;
        let mut scene = Scene::new(
            GridSpec { origin: [0.0; 2], spacing: [h; 2], cells: [resolution.cells, high] },
            [[Boundary::Slip; 2]; 2],
            EquationOfStateSpec::WeaklyCompressible { reference_density: DENSITY, sound_speed },
            self.points(resolution),
        );
        scene.body_force = tank.acceleration();
        let relaxation = free_surface::INFLOW_RELAXATION;
        let settings =
            free_surface::settings(resolution.points_per_axis, h, sound_speed, relaxation);
        SetUp { scene, settings, end: DURATION * HEIGHT / sound_speed }
    }

    fn gauge(&self, _resolution: &Resolution) -> Box<dyn Gauge<2>> {
        Box::new(Rest { tank: self.at_rest(), largest: 0.0 })
    }
}

struct Rest {
    tank: HydrostaticTank,
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
        let (mut volume, mut pressure, mut velocity) = (0.0, 0.0, 0.0);
        for point in end.simulation.observe().points {
            let error = point.pressure - self.tank.pressure(point.position);
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
            let scene = LEVEL.set_up(&resolution).scene;
            let mass: f64 = scene.points.iter().map(|point| point.mass).sum();
            let width = 8.0 * scene.grid.spacing[0];
            let exact = width * LEVEL.at_rest().column.mass(0.0, HEIGHT);
            assert!((mass / exact - 1.0).abs() < 1e-6, "{mass} {exact}");
            assert_eq!(scene.body_force, [0.0, -GRAVITY]);
        }
    }

    /// A trapezoid between 1/√3 and 2/√3 of the height, under water of all depths down to H.
    #[test]
    fn the_tilted_water_fills_a_trapezoid() {
        for cells in TILTED.levels() {
            let resolution = Resolution { cells: *cells, points_per_axis: 2, jitter: 0.3, seed: 1 };
            let scene = TILTED.set_up(&resolution).scene;
            let volume: f64 = scene.points.iter().map(|point| point.mass / point.density).sum();
            assert!((volume - 0.75_f64.sqrt()).abs() < 1e-12, "{volume}");
            let box_height = scene.grid.spacing[1] * scene.grid.cells[1] as f64;
            assert!(box_height > 2.0 / 3.0_f64.sqrt() + scene.grid.spacing[1]);
            let depth = |point: &PointSpec<2>| HEIGHT - TILTED.at_rest().height(point.position);
            let depths = scene.points.iter().map(depth);
            let (least, most) = depths.fold((1.0, 0.0), |(least, most): (f64, f64), depth| {
                (least.min(depth), most.max(depth))
            });
            assert!(least > 0.0 && least < 0.02 && most > 0.9 && most < 1.0, "{least} {most}");
        }
    }
}
