//! Problem `gravity-wave`: the first standing gravity wave in a closed tank, two periods from a flat surface.
//!
//! L = 1 m, half a wavelength; H = 0.5 m, a k = 0.02, c₀ = 10 √(gH). The points fill whole cells at the start, at the
//! density of the liquid at rest, with the velocity of the wave as it passes the flat surface. The answer is that of
//! [`GravityWave`], linear and exact in g H/c₀²: without compressibility the frequency would be 0.04 % higher. What it
//! leaves out is of order (a k)² = 4·10⁻⁴.
//!
//! With the velocity u of the mode at t = 0 as the shape, the amplitude found and the numerical viscosity are
//!
//! ```text
//! A(t) = Σ m v·u / Σ m |u|²   against cos(ωt),   ν = ln(C₁/C₂)/(2 k² T),   C_n = |∫ A e^{iωt} dt| over period n
//! ```
//!
//! A viscosity ν takes energy like e^{−4νk²t} and amplitude like e^{−2νk²t}, at any depth, where the walls slip
//! (\[Lamb1932\]). It is given over √(g/k)/k. A surface is not needed to find any of the three errors.

use std::f64::consts::PI;

use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::{Scene, Simulation};

use super::{End, ErrorKind, Gauge, Problem, Resolution, SetUp};
use crate::cases::{free_surface, lattice};
use crate::exact::gravity_wave::{GravityWave, Shape};
use crate::exact::hydrostatic_column::HydrostaticColumn;

/// L, m.
const LENGTH: f64 = 1.0;
/// H, m.
const DEPTH: f64 = 0.5;
/// a k.
const STEEPNESS: f64 = 0.02;
/// g, m/s².
const GRAVITY: f64 = 9.81;
/// ρ₀, kg/m³.
const DENSITY: f64 = 1000.0;
/// c₀/√(gH).
const STIFFNESS: f64 = 10.0;
/// Periods of the exact wave.
const PERIODS: usize = 2;
/// Cells of air above the surface at rest.
const AIR: usize = 2;
/// Steps from one look to the next.
const STRIDE: u64 = 4;

/// The problem `gravity-wave`.
#[derive(Clone, Copy, Debug)]
pub struct StandingGravityWave;

fn sound_speed() -> f64 {
    STIFFNESS * (GRAVITY * DEPTH).sqrt()
}

fn wave() -> GravityWave {
    GravityWave {
        amplitude: STEEPNESS * LENGTH / PI,
        wave_number: PI / LENGTH,
        depth: DEPTH,
        gravity: GRAVITY,
        sound_speed: sound_speed(),
    }
}

impl Problem<2> for StandingGravityWave {
    fn name(&self) -> &'static str {
        "gravity-wave"
    }

    fn about(&self) -> &'static str {
        "standing gravity wave in a closed tank, half a wavelength, two periods (exact linear theory of a weakly \
         compressible liquid [Lamb1932])"
    }

    fn levels(&self) -> &'static [usize] {
        &[12, 16, 24, 32]
    }

    fn spacing(&self, cells: usize) -> f64 {
        LENGTH / cells as f64
    }

    fn errors(&self) -> &'static [ErrorKind] {
        &[
            ErrorKind { quantity: "amplitude", norm: "relative-l2-over-time" },
            ErrorKind { quantity: "period", norm: "relative" },
            ErrorKind { quantity: "viscosity", norm: "over-sqrt(g/k)/k" },
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
        let spacing = h / per_axis as f64;
        let deep = (DEPTH / h).round() as usize;
        let at_rest = HydrostaticColumn {
            height: DEPTH,
            gravity: GRAVITY,
            density: DENSITY,
            sound_speed: sound_speed(),
        };
        let shape = wave().shape();
        let counts = [cells * per_axis, deep * per_axis];
        let points = lattice::lattice(counts, spacing, resolution.jitter, resolution.seed)
            .into_iter()
            .map(|position| {
                let density = at_rest.density(position[1]);
                let velocity = shape.velocity(position);
                PointSpec {
                    velocity_gradient: shape.velocity_gradient(position),
                    ..PointSpec::new(position, velocity, density, density * spacing * spacing)
                }
            })
            .collect();
        let mut scene = Scene::new(
            GridSpec { origin: [0.0; 2], spacing: [h; 2], cells: [cells, deep + AIR] },
            [[Boundary::Slip; 2]; 2],
            EquationOfStateSpec::WeaklyCompressible {
                reference_density: DENSITY,
                sound_speed: sound_speed(),
            },
            points,
        );
        scene.body_force = [0.0, -GRAVITY];
        let settings =
            free_surface::settings(per_axis, h, sound_speed(), free_surface::INFLOW_RELAXATION);
        let period = 2.0 * PI / shape.frequency();
        SetUp { scene, settings, end: PERIODS as f64 * period }
    }

    fn gauge(&self, _resolution: &Resolution) -> Box<dyn Gauge<2>> {
        Box::new(Mode { shape: wave().shape(), steps: 0, history: Vec::new() })
    }
}

/// The amplitude over time.
struct Mode {
    shape: Shape,
    steps: u64,
    /// Time of the state, s, and amplitude over that at the start.
    history: Vec<(f64, f64)>,
}

impl Mode {
    fn amplitude(&self, simulation: &dyn Simulation<2>) -> f64 {
        let (mut found, mut square) = (0.0, 0.0);
        simulation.visit_points(&mut |point| {
            let [u, v] = self.shape.velocity(point.position);
            found += point.mass * (u * point.velocity[0] + v * point.velocity[1]);
            square += point.mass * (u * u + v * v);
        });
        found / square
    }
}

impl Gauge<2> for Mode {
    fn watch(&mut self, simulation: &dyn Simulation<2>) {
        self.steps += 1;
        if self.steps.is_multiple_of(STRIDE) {
            self.history.push((simulation.time(), self.amplitude(simulation)));
        }
    }

    fn errors(&mut self, end: &End<'_, 2>) -> Vec<f64> {
        let late = end.velocity_time() - end.simulation.time();
        let history: Vec<_> = self.history.iter().map(|&(time, a)| (time + late, a)).collect();
        let frequency = self.shape.frequency();
        let (mut error, mut exact) = (0.0, 0.0);
        for &(time, amplitude) in &history {
            let cosine = (frequency * time).cos();
            error += (amplitude - cosine).powi(2);
            exact += cosine * cosine;
        }
        let period = 2.0 * PI / frequency;
        let rate = decay(&history, frequency);
        let k = wave().wave_number;
        let viscosity = rate / (2.0 * k * k);
        vec![
            (error / exact).sqrt(),
            (found_period(&history) / period - 1.0).abs(),
            viscosity.abs() * k / (GRAVITY / k).sqrt(),
        ]
    }
}

/// Twice the mean time between zeros, s; infinite with fewer than two.
fn found_period(history: &[(f64, f64)]) -> f64 {
    let zeros: Vec<f64> = history
        .windows(2)
        .filter(|pair| (pair[0].1 > 0.0) != (pair[1].1 > 0.0))
        .map(|pair| {
            let ((before, from), (after, to)) = (pair[0], pair[1]);
            before + (after - before) * from / (from - to)
        })
        .collect();
    match (zeros.first(), zeros.last()) {
        (Some(first), Some(last)) if zeros.len() > 1 => {
            2.0 * (last - first) / (zeros.len() - 1) as f64
        }
        _ => f64::INFINITY,
    }
}

/// Rate at which the amplitude decays, 1/s, from the first harmonics of the two periods.
fn decay(history: &[(f64, f64)], frequency: f64) -> f64 {
    let period = 2.0 * PI / frequency;
    let harmonic = |number: usize| {
        let mut sums = [0.0; 2];
        // The look that is nearest to a period's end may lie on either side of it.
        let of_period = history.len() / PERIODS;
        for &(time, amplitude) in history.iter().skip(number * of_period).take(of_period) {
            let (sine, cosine) = (frequency * time).sin_cos();
            sums[0] += amplitude * cosine;
            sums[1] += amplitude * sine;
        }
        sums[0].hypot(sums[1])
    };
    (harmonic(0) / harmonic(PERIODS - 1)).ln() / (period * (PERIODS - 1) as f64)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn measures_find_a_damped_wave_that_is_too_slow() {
        let frequency = 5.0;
        let history: Vec<(f64, f64)> = (1..=2000)
            .map(|step| {
                let time = f64::from(step) * 2.0 * PI / frequency / 1000.0;
                (time, (-0.05 * time).exp() * (0.99 * frequency * time).cos())
            })
            .collect();
        let ratio = found_period(&history) / (2.0 * PI / frequency);
        assert!((ratio * 0.99 - 1.0).abs() < 1e-4, "{ratio}");
        // The phase that builds up costs the second period a little of its harmonic.
        assert!((decay(&history, frequency) / 0.05 - 1.0).abs() < 0.1);
    }

    #[test]
    fn the_start_is_the_mode_on_whole_cells() {
        let resolution = Resolution { cells: 8, points_per_axis: 2, jitter: 0.0, seed: 1 };
        let points = StandingGravityWave.set_up(&resolution).scene.points;
        assert_eq!(points.len(), 16 * 8);
        let momentum: f64 = points.iter().map(|point| point.mass * point.velocity[0]).sum();
        // Water runs from the side where the surface falls to the other.
        assert!(momentum < 0.0, "{momentum}");
        let mass: f64 = points.iter().map(|point| point.mass).sum();
        // Half of g H/c₀² = 1 % more than without weight.
        assert!((mass / 502.5 - 1.0).abs() < 1e-4, "{mass}");
    }
}
