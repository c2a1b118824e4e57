//! Problems `taylor-green` and `taylor-green-inviscid`: the array of vortices of \[TaylorGreen1937\] in a periodic box.
//!
//! ```text
//! u = −U cos(2πx/L) sin(2πy/L) e^{bt},  v = U sin(2πx/L) cos(2πy/L) e^{bt},  b = −8π² ν/L²
//! p = −¼ ρ₀ U² (cos(4πx/L) + cos(4πy/L)) e^{2bt}
//! ```
//!
//! L = 1 m, U = 1 m/s, c₀ = 20 m/s, to t = 0.5 L/U. The answer is that of an incompressible fluid; a weakly
//! compressible one is off by about (U/c₀)² = 0.25 %. Points part along the lines between the vortices and gather
//! in others: disorder grows from any start.

use transpoint::Scene;
use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::simulation::PointState;

use super::{End, ErrorKind, Gauge, Problem, Resolution, SetUp};
use crate::cases::{free_surface, lattice};
use crate::exact::taylor_green::TaylorGreen;
use crate::measure::norms::L2;

const DENSITY: f64 = 1000.0;
const SOUND_SPEED: f64 = 20.0;
/// End, L/U.
const END: f64 = 0.5;

/// The vortices at a Reynolds number U L/ν, or without viscosity.
#[derive(Clone, Copy, Debug)]
pub struct Vortices {
    /// Re; absent: inviscid.
    pub reynolds: Option<f64>,
}

impl Vortices {
    fn flow(self) -> TaylorGreen {
        TaylorGreen {
            speed: 1.0,
            length: 1.0,
            density: DENSITY,
            viscosity: self.reynolds.map_or(0.0, |reynolds| 1.0 / reynolds),
        }
    }
}

impl Problem<2> for Vortices {
    fn name(&self) -> &'static str {
        if self.reynolds.is_some() { "taylor-green" } else { "taylor-green-inviscid" }
    }

    fn about(&self) -> &'static str {
        if self.reynolds.is_some() {
            "Taylor-Green vortices at Re = 100 to t = 0.5 L/U (exact for an incompressible fluid)"
        } else {
            "Taylor-Green vortices without viscosity to t = 0.5 L/U (exact for an incompressible fluid)"
        }
    }

    fn levels(&self) -> &'static [usize] {
        &[12, 16, 24, 32]
    }

    fn spacing(&self, cells: usize) -> f64 {
        1.0 / cells as f64
    }

    fn errors(&self) -> &'static [ErrorKind] {
        &[
            ErrorKind { quantity: "velocity", norm: "relative-l2" },
            ErrorKind { quantity: "pressure", norm: "relative-l2" },
            ErrorKind { quantity: "kinetic-energy", norm: "relative" },
        ]
    }

    fn expected_order(&self) -> Option<(f64, f64)> {
        Some((0.8, 2.5))
    }

    fn set_up(&self, resolution: &Resolution) -> SetUp<2> {
        let (cells, per_axis) = (resolution.cells, resolution.points_per_axis);
        let h = self.spacing(cells);
        let spacing = h / per_axis as f64;
        let flow = self.flow();
        let counts = [cells * per_axis; 2];
        let points = lattice::lattice(counts, spacing, resolution.jitter, resolution.seed)
            .into_iter()
            .map(|position| {
                let density = DENSITY + flow.pressure(position, 0.0) / SOUND_SPEED.powi(2);
                let velocity = flow.velocity(position, 0.0);
                PointSpec {
                    velocity_gradient: flow.velocity_gradient(position, 0.0),
                    ..PointSpec::new(position, velocity, density, density * spacing * spacing)
                }
            })
            .collect();
        let mut scene = Scene::new(
            GridSpec { origin: [0.0; 2], spacing: [h; 2], cells: [cells; 2] },
            [[Boundary::Periodic; 2]; 2],
            EquationOfStateSpec::WeaklyCompressible {
                reference_density: DENSITY,
                sound_speed: SOUND_SPEED,
            },
            points,
        );
        scene.viscosity = self.reynolds.map(|reynolds| 1.0 / reynolds);
        SetUp { scene, settings: free_surface::printed(per_axis), end: END }
    }

    fn gauge(&self, _resolution: &Resolution) -> Box<dyn Gauge<2>> {
        Box::new(Errors { flow: self.flow() })
    }
}

struct Errors {
    flow: TaylorGreen,
}

impl Gauge<2> for Errors {
    fn errors(&mut self, end: &End<'_, 2>) -> Vec<f64> {
        let (time, velocity_time) = (end.simulation.time(), end.velocity_time());
        let (mut velocity, mut pressure) = (L2::default(), L2::default());
        let (mut energy, mut exact_energy) = (0.0, 0.0);
        let points = end.simulation.observe().points;
        // The pressure of the exact flow has no level of its own: that of its mean is taken out of both.
        let volume: f64 = points.iter().map(PointState::volume).sum();
        let mean = points.iter().map(|point| point.pressure * point.volume()).sum::<f64>() / volume;
        for point in &points {
            let exact = self.flow.velocity(point.position, velocity_time);
            let error: f64 =
                point.velocity.iter().zip(exact).map(|(v, exact)| (v - exact).powi(2)).sum();
            let square: f64 = exact.iter().map(|v| v * v).sum();
            velocity.add(error, square, point.volume());
            energy += point.mass * point.velocity.iter().map(|v| v * v).sum::<f64>();
            exact_energy += point.mass * square;
            let exact = self.flow.pressure(point.position, time);
            pressure.add((point.pressure - mean - exact).powi(2), exact * exact, point.volume());
        }
        vec![
            velocity.error() / velocity.exact(),
            pressure.error() / pressure.exact(),
            (energy - exact_energy).abs() / exact_energy,
        ]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_box_is_one_period_of_the_flow() {
        let resolution = Resolution { cells: 12, points_per_axis: 2, jitter: 0.3, seed: 1 };
        let set_up = Vortices { reynolds: Some(100.0) }.set_up(&resolution);
        assert_eq!(set_up.scene.points.len(), 24 * 24);
        assert_eq!(set_up.scene.viscosity, Some(0.01));
        let momentum: f64 = set_up.scene.points.iter().map(|p| p.mass * p.velocity[0]).sum();
        assert!(momentum.abs() < 0.02 * 1000.0, "{momentum}");
    }
}
