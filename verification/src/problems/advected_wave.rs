//! Problem `advected-wave`: a standing acoustic wave carried through the grid at a tenth of the speed of sound.
//!
//! One wavelength of 1 m in a periodic line, 2.25 periods: then the pressure is at its largest and has crossed a
//! quarter of the line. Every point crosses faces of cells all the time, which is what a wave between walls spares
//! a method. In the frame that moves along, the answer is that of [`StandingWave`], whose wave is periodic.

use std::f64::consts::TAU;

use transpoint::Scene;
use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};

use super::{End, ErrorKind, Gauge, Problem, Resolution, SetUp};
use crate::cases::{free_surface, lattice};
use crate::exact::sine_wave::StandingWave;
use crate::measure::norms::L2;

/// The wave: A k = 6·10⁻⁵, so that what the exact answer leaves out is far below every error here.
const WAVE: StandingWave =
    StandingWave { amplitude: 1e-5, length: 1.0, density: 1000.0, sound_speed: 50.0 };
/// Speed at which it is carried, m/s.
const CARRIED: f64 = 5.0;
/// Periods to the end.
const PERIODS: f64 = 2.25;

/// The problem `advected-wave`.
#[derive(Clone, Copy, Debug)]
pub struct AdvectedWave;

impl Problem<1> for AdvectedWave {
    fn name(&self) -> &'static str {
        "advected-wave"
    }

    fn about(&self) -> &'static str {
        "standing acoustic wave carried through a periodic line at 0.1 c₀, 2.25 periods (exact, second order in \
         the amplitude)"
    }

    fn levels(&self) -> &'static [usize] {
        &[16, 32, 64, 128]
    }

    fn spacing(&self, cells: usize) -> f64 {
        WAVE.length / cells as f64
    }

    fn errors(&self) -> &'static [ErrorKind] {
        &[
            ErrorKind { quantity: "pressure", norm: "relative-l2" },
            ErrorKind { quantity: "velocity", norm: "l2-over-amplitude" },
        ]
    }

    fn expected_order(&self) -> Option<(f64, f64)> {
        Some((1.5, 2.5))
    }

    fn set_up(&self, resolution: &Resolution) -> SetUp<1> {
        let (cells, per_axis) = (resolution.cells, resolution.points_per_axis);
        let h = self.spacing(cells);
        let (jitter, spacing) = (resolution.jitter, h / per_axis as f64);
        let points = lattice::lattice([cells * per_axis], spacing, jitter, resolution.seed)
            .into_iter()
            .map(|[x]| PointSpec {
                velocity_gradient: [[WAVE.velocity_gradient(x, 0.0)]],
                ..PointSpec::new(
                    [x],
                    [CARRIED + WAVE.velocity(x, 0.0)],
                    WAVE.density,
                    WAVE.density * spacing,
                )
            })
            .collect();
        let scene = Scene::new(
            GridSpec { origin: [0.0], spacing: [h], cells: [cells] },
            [[Boundary::Periodic; 2]],
            EquationOfStateSpec::WeaklyCompressible {
                reference_density: WAVE.density,
                sound_speed: WAVE.sound_speed,
            },
            points,
        );
        let settings = free_surface::printed(per_axis);
        SetUp { scene, settings, end: PERIODS * WAVE.period() }
    }

    fn gauge(&self, _resolution: &Resolution) -> Box<dyn Gauge<1>> {
        Box::new(Errors)
    }
}

struct Errors;

impl Gauge<1> for Errors {
    fn errors(&mut self, end: &End<'_, 1>) -> Vec<f64> {
        let (time, velocity_time) = (end.simulation.time(), end.velocity_time());
        let mut pressure = L2::default();
        let mut velocity = L2::default();
        let amplitude = WAVE.amplitude * TAU / WAVE.period();
        for point in end.simulation.observe().points {
            let x = (point.position[0] - CARRIED * time).rem_euclid(WAVE.length);
            let material = WAVE.material(x, time);
            let exact = WAVE.pressure(material, time);
            pressure.add((point.pressure - exact).powi(2), exact * exact, point.volume());
            let error = point.velocity[0] - CARRIED - WAVE.velocity(material, velocity_time);
            velocity.add(error * error, amplitude * amplitude, point.volume());
        }
        vec![pressure.error() / pressure.exact(), velocity.error() / velocity.exact()]
    }
}
