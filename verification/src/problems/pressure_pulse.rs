//! Problem `pressure-pulse`: a Gaussian bump of pressure in a periodic square, released from rest.
//!
//! p(r, 0) = A exp(−a r²) with a standard deviation of 80 mm in the middle of a square of 1 m; at the end the ring has
//! run 0.25 m and touches nothing. The answer is that of linear acoustics, [`RadialPulse`]; A is so small that what
//! that leaves out is no error here.

use transpoint::Scene;
use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};

use super::{End, ErrorKind, Gauge, Problem, Resolution, SetUp};
use crate::cases::{free_surface, lattice};
use crate::exact::acoustic_radial::RadialPulse;
use crate::measure::norms::L2;

/// The pulse.
const PULSE: RadialPulse =
    RadialPulse { amplitude: 1.0, decay: 0.5 / (0.08 * 0.08), density: 1000.0, sound_speed: 50.0 };
/// Path of sound to the end, m.
const PATH: f64 = 0.25;
const CENTER: f64 = 0.5;
/// Steps of the table of the answer over the radius.
const TABLE: usize = 1000;

/// The problem `pressure-pulse`.
#[derive(Clone, Copy, Debug)]
pub struct PressurePulse;

impl Problem<2> for PressurePulse {
    fn name(&self) -> &'static str {
        "pressure-pulse"
    }

    fn about(&self) -> &'static str {
        "Gaussian bump of pressure released in a periodic square, until the ring has run 0.25 m (exact linear acoustics)"
    }

    fn levels(&self) -> &'static [usize] {
        &[24, 32, 48, 64]
    }

    fn spacing(&self, cells: usize) -> f64 {
        2.0 * CENTER / cells as f64
    }

    fn errors(&self) -> &'static [ErrorKind] {
        &[
            ErrorKind { quantity: "pressure", norm: "relative-l2" },
            ErrorKind { quantity: "velocity", norm: "relative-l2" },
        ]
    }

    fn expected_order(&self) -> Option<(f64, f64)> {
        Some((1.3, 2.5))
    }

    fn set_up(&self, resolution: &Resolution) -> SetUp<2> {
        let (cells, per_axis) = (resolution.cells, resolution.points_per_axis);
        let h = self.spacing(cells);
        let spacing = h / per_axis as f64;
        let counts = [cells * per_axis; 2];
        let points = lattice::lattice(counts, spacing, resolution.jitter, resolution.seed)
            .into_iter()
            .map(|[x, y]| {
                let square = (x - CENTER).powi(2) + (y - CENTER).powi(2);
                let pressure = PULSE.amplitude * (-PULSE.decay * square).exp();
                let density = PULSE.density + pressure / PULSE.sound_speed.powi(2);
                PointSpec::new([x, y], [0.0; 2], density, density * spacing * spacing)
            })
            .collect();
        let scene = Scene::new(
            GridSpec { origin: [0.0; 2], spacing: [h; 2], cells: [cells; 2] },
            [[Boundary::Periodic; 2]; 2],
            EquationOfStateSpec::WeaklyCompressible {
                reference_density: PULSE.density,
                sound_speed: PULSE.sound_speed,
            },
            points,
        );
        let settings = free_surface::printed(per_axis);
        SetUp { scene, settings, end: PATH / PULSE.sound_speed }
    }

    fn gauge(&self, _resolution: &Resolution) -> Box<dyn Gauge<2>> {
        Box::new(Errors)
    }
}

struct Errors;

/// Values over 0 ≤ r ≤ √2/2 in equal steps, interpolated by parabolas: each is an integral, and there are many
/// points.
struct Radial(Vec<f64>);

impl Radial {
    const STEP: f64 = std::f64::consts::SQRT_2 * CENTER / TABLE as f64;

    fn new(value: impl Fn(f64) -> f64) -> Self {
        Self((0..TABLE + 3).map(|i| value(i as f64 * Self::STEP)).collect())
    }

    fn at(&self, radius: f64) -> f64 {
        let place = radius / Self::STEP;
        let i = (place.round() as usize).clamp(1, TABLE + 1);
        let s = place - i as f64;
        let [below, here, above] = [self.0[i - 1], self.0[i], self.0[i + 1]];
        here + 0.5 * s * (above - below) + 0.5 * s * s * (above - 2.0 * here + below)
    }
}

impl Gauge<2> for Errors {
    fn errors(&mut self, end: &End<'_, 2>) -> Vec<f64> {
        let (time, velocity_time) = (end.simulation.time(), end.velocity_time());
        let exact_pressure = Radial::new(|radius| PULSE.pressure(radius, time));
        let exact_speed = Radial::new(|radius| PULSE.velocity(radius, velocity_time));
        let (mut pressure, mut velocity) = (L2::default(), L2::default());
        for point in end.simulation.observe().points {
            let offset = point.position.map(|x| x - CENTER);
            let radius = offset[0].hypot(offset[1]);
            let exact = exact_pressure.at(radius);
            pressure.add((point.pressure - exact).powi(2), exact * exact, point.volume());
            let speed = exact_speed.at(radius);
            let error: f64 = (0..2)
                .map(|i| (point.velocity[i] - speed * offset[i] / radius.max(1e-12)).powi(2))
                .sum();
            velocity.add(error, speed * speed, point.volume());
        }
        vec![pressure.error() / pressure.exact(), velocity.error() / velocity.exact()]
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn the_table_follows_the_answer() {
        let time = PATH / PULSE.sound_speed;
        let table = Radial::new(|radius| PULSE.pressure(radius, time));
        for radius in [0.0, 0.0123, 0.25, 0.31, 0.705] {
            let error = table.at(radius) - PULSE.pressure(radius, time);
            assert!(error.abs() < 1e-6, "{radius}: {error}");
        }
    }
}
