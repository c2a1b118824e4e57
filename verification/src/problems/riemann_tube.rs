//! Problem `riemann-tube`: 1000 Pa against 100 Pa in water, the jump of §4.2 of \[Song2020\] in one dimension.
//!
//! Water at rest fills 0 ≤ x ≤ 1 m with the interface at 0.5 m; at 4 ms a rarefaction and a shock have run 0.2 m each
//! way. All methods have the bulk viscosity of the case `riemann`, C₁ = 0.25 and C₂ = 1.5, in expansion too: without
//! it FLIP rings whatever the fields. The answer is that of [`IsothermalRiemann`]; it has jumps, so that an order of
//! one in the mean of the absolute error is the most.

use transpoint::Scene;
use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::variants::BulkViscosity;

use super::{End, ErrorKind, Gauge, Problem, Resolution, SetUp};
use crate::cases::{free_surface, lattice};
use crate::exact::isothermal_riemann::{IsothermalRiemann, State};

const DENSITY: f64 = 1000.0;
const SOUND_SPEED: f64 = 50.0;
const INTERFACE: f64 = 0.5;
/// Pressures left and right, Pa.
const PRESSURES: [f64; 2] = [1000.0, 100.0];
/// End, s.
const END: f64 = 4e-3;
const VISCOSITY: BulkViscosity = BulkViscosity { linear: 0.25, quadratic: 1.5, expansion: true };

/// The problem `riemann-tube`.
#[derive(Clone, Copy, Debug)]
pub struct RiemannTube;

fn density(pressure: f64) -> f64 {
    DENSITY + pressure / SOUND_SPEED.powi(2)
}

impl Problem<1> for RiemannTube {
    fn name(&self) -> &'static str {
        "riemann-tube"
    }

    fn about(&self) -> &'static str {
        "1000 Pa against 100 Pa in water, with bulk viscosity, to 4 ms (exact isothermal solution, §4.2 of [Song2020])"
    }

    fn levels(&self) -> &'static [usize] {
        &[100, 200, 400, 800]
    }

    fn spacing(&self, cells: usize) -> f64 {
        1.0 / cells as f64
    }

    fn errors(&self) -> &'static [ErrorKind] {
        &[
            ErrorKind { quantity: "pressure", norm: "l1-over-jump" },
            ErrorKind { quantity: "velocity", norm: "l1-over-plateau" },
        ]
    }

    fn expected_order(&self) -> Option<(f64, f64)> {
        Some((0.6, 1.1))
    }

    fn set_up(&self, resolution: &Resolution) -> SetUp<1> {
        let (cells, per_axis) = (resolution.cells, resolution.points_per_axis);
        let h = self.spacing(cells);
        let spacing = h / per_axis as f64;
        let points =
            lattice::lattice([cells * per_axis], spacing, resolution.jitter, resolution.seed)
                .into_iter()
                .map(|[x]| {
                    let density = density(PRESSURES[usize::from(x >= INTERFACE)]);
                    PointSpec::new([x], [0.0], density, density * spacing)
                })
                .collect();
        let scene = Scene::new(
            GridSpec { origin: [0.0], spacing: [h], cells: [cells] },
            [[Boundary::Slip; 2]],
            EquationOfStateSpec::WeaklyCompressible {
                reference_density: DENSITY,
                sound_speed: SOUND_SPEED,
            },
            points,
        );
        let mut settings = free_surface::printed(per_axis);
        settings.bulk_viscosity = Some(VISCOSITY);
        SetUp { scene, settings, end: END }
    }

    fn gauge(&self, _resolution: &Resolution) -> Box<dyn Gauge<1>> {
        Box::new(Errors)
    }
}

struct Errors;

impl Gauge<1> for Errors {
    fn errors(&mut self, end: &End<'_, 1>) -> Vec<f64> {
        let at_rest = |pressure| State { density: density(pressure), velocity: 0.0 };
        let [left, right] = PRESSURES.map(at_rest);
        // The pressures above have a solution.
        let Ok(exact) = IsothermalRiemann::new(left, right, SOUND_SPEED, DENSITY) else {
            return vec![f64::NAN; 2];
        };
        let (time, velocity_time) = (end.simulation.time(), end.velocity_time());
        let (mut pressure, mut velocity, mut volume) = (0.0, 0.0, 0.0);
        for point in end.simulation.observe().points {
            let x = point.position[0] - INTERFACE;
            let error = point.pressure - exact.pressure(exact.at(x / time));
            pressure += error.abs() * point.volume();
            velocity +=
                (point.velocity[0] - exact.at(x / velocity_time).velocity).abs() * point.volume();
            volume += point.volume();
        }
        let jump = PRESSURES[0] - PRESSURES[1];
        vec![pressure / (volume * jump), velocity / (volume * exact.star().velocity)]
    }
}
