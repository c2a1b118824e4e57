//! Problems `taylor-green`, `taylor-green-1000` and `taylor-green-inviscid`: the array of vortices of \[TaylorGreen1937\]
//! in a periodic box, at Re = U L/ν = 100 and 1000 and without viscosity.
//!
//! ```text
//! u = −U cos(2πx/L) sin(2πy/L) e^{bt},  v = U sin(2πx/L) cos(2πy/L) e^{bt},  b = −8π² ν/L²
//! p = −¼ ρ₀ U² (cos(4πx/L) + cos(4πy/L)) e^{2bt}
//! ```
//!
//! L = 1 m, U = 1 m/s, c₀ = 20 m/s, to t = 0.5 L/U in all three, in which a point at U goes the width of a vortex; the
//! speed falls to e^{bt} = 0.67 at Re = 100 and to 0.96 at Re = 1000. The answer is that of an incompressible fluid; a weakly
//! compressible one is off by about (U/c₀)² = 0.25 %. Points part along the lines between the vortices and gather
//! in others: disorder grows from any start.

use transpoint::Scene;
use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::simulation::PointState;

use super::{End, ErrorKind, Gauge, Problem, Resolution, SetUp};
use crate::cases::{free_surface, lattice};
use crate::exact::taylor_green::TaylorGreen;
use crate::measure::norms::L2;

/// L, m.
const LENGTH: f64 = 1.0;
/// U, m/s.
const SPEED: f64 = 1.0;
/// ρ₀, kg/m³.
const DENSITY: f64 = 1000.0;
/// c₀, m/s.
const SOUND_SPEED: f64 = 20.0;
/// End, L/U.
const END: f64 = 0.5;

/// The vortices at a Reynolds number, or without viscosity.
#[derive(Clone, Copy, Debug)]
pub struct Vortices {
    name: &'static str,
    about: &'static str,
    /// Re = U L/ν; absent: inviscid.
    reynolds: Option<f64>,
}

/// The problem `taylor-green`.
pub const RE_100: Vortices = Vortices {
    name: "taylor-green",
    about: "Taylor-Green vortices at Re = 100 to t = 0.5 L/U (exact for an incompressible fluid)",
    reynolds: Some(100.0),
};

/// The problem `taylor-green-1000`.
pub const RE_1000: Vortices = Vortices {
    name: "taylor-green-1000",
    about: "Taylor-Green vortices at Re = 1000 to t = 0.5 L/U (exact for an incompressible fluid)",
    reynolds: Some(1000.0),
};

/// The problem `taylor-green-inviscid`.
pub const INVISCID: Vortices = Vortices {
    name: "taylor-green-inviscid",
    about: "Taylor-Green vortices without viscosity to t = 0.5 L/U (exact for an incompressible fluid)",
    reynolds: None,
};

impl Vortices {
    /// ν = U L/Re, m²/s.
    fn viscosity(self) -> Option<f64> {
        self.reynolds.map(|reynolds| SPEED * LENGTH / reynolds)
    }

    fn flow(self) -> TaylorGreen {
        TaylorGreen {
            speed: SPEED,
            length: LENGTH,
            density: DENSITY,
            viscosity: self.viscosity().unwrap_or(0.0),
        }
    }
}

impl Problem<2> for Vortices {
    fn name(&self) -> &'static str {
        self.name
    }

    fn about(&self) -> &'static str {
        self.about
    }

    fn levels(&self) -> &'static [usize] {
        &[12, 16, 24, 32]
    }

    fn spacing(&self, cells: usize) -> f64 {
        LENGTH / cells as f64
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
        scene.viscosity = self.viscosity();
        SetUp { scene, settings: free_surface::printed(per_axis), end: END * LENGTH / SPEED }
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
        for (problem, viscosity) in [(RE_100, Some(0.01)), (RE_1000, Some(0.001)), (INVISCID, None)]
        {
            let set_up = problem.set_up(&resolution);
            assert_eq!(set_up.scene.points.len(), 24 * 24);
            assert_eq!(set_up.scene.viscosity, viscosity);
            let momentum: f64 = set_up.scene.points.iter().map(|p| p.mass * p.velocity[0]).sum();
            assert!(momentum.abs() < 0.02 * 1000.0, "{momentum}");
        }
    }

    /// ½ ρ₀ Σ v² ΔA over a lattice, which is exact for so few waves, J/m.
    fn kinetic_energy(flow: &TaylorGreen, time: f64) -> f64 {
        sum_over_box(|at| {
            0.5 * DENSITY * flow.velocity(at, time).map(|v| v * v).iter().sum::<f64>()
        })
    }

    fn sum_over_box(density: impl Fn([f64; 2]) -> f64) -> f64 {
        let n = 16;
        let width = LENGTH / n as f64;
        let place = |i: usize| (i as f64 + 0.5) * width;
        let places = (0..n * n).map(|i| [place(i / n), place(i % n)]);
        places.map(density).sum::<f64>() * width * width
    }

    /// What the energy loses is what viscosity takes, dE/dt = −ρ₀ ν ∫ |∇v|² dA, by finite differences in time and
    /// space: neither side knows the rate of decay.
    #[test]
    fn the_answer_loses_the_energy_that_its_viscosity_takes() {
        for problem in [RE_100, RE_1000, INVISCID] {
            let (flow, time, step) = (problem.flow(), 0.3, 1e-4);
            let rate = (kinetic_energy(&flow, time + step) - kinetic_energy(&flow, time - step))
                / (2.0 * step);
            let slope = |at: [f64; 2], axis: usize| {
                let at = |by: f64| {
                    let mut there = at;
                    there[axis] += by;
                    flow.velocity(there, time)
                };
                let (after, before) = (at(step), at(-step));
                [0, 1].map(|i| (after[i] - before[i]) / (2.0 * step))
            };
            let taken = sum_over_box(|at| {
                let square = |axis| slope(at, axis).map(|s| s * s).iter().sum::<f64>();
                DENSITY * flow.viscosity * (square(0) + square(1))
            });
            // Differences of second order over 1e-4 of a length and of a time of one.
            assert!((rate + taken).abs() < 1e-5 * DENSITY, "{}: {rate} {taken}", problem.name);
            let divergence = |at| slope(at, 0)[0] + slope(at, 1)[1];
            assert!(sum_over_box(|at| divergence(at).abs()) < 1e-9);
        }
    }
}
