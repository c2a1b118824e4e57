//! Problem `poiseuille`: flow between two walls at rest that a body force sets going, \[Schlichting2017\].
//!
//! Walls 1 m apart, ν = 0.02 m²/s, a force that would drive 1 m/s in the end, c₀ = 10 m/s, to ν t/H² = 0.1. The strip is
//! three cells wide and periodic along the walls. The answer is that of [`Poiseuille`]: no pressure, no convection, so
//! that what is left is the viscous stress, the wall and the noise that disordered points make.

use transpoint::Scene;
use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};

use super::{End, ErrorKind, Gauge, Problem, Resolution, SetUp};
use crate::cases::{free_surface, lattice};
use crate::exact::shear::Poiseuille;
use crate::measure::norms::L2;

/// The flow; the steady one has 1 m/s in the middle.
const FLOW: Poiseuille = Poiseuille { height: 1.0, viscosity: 0.02, acceleration: 0.16 };
const DENSITY: f64 = 1000.0;
const SOUND_SPEED: f64 = 10.0;
/// End, H²/ν.
const END: f64 = 0.1;
/// Cells along the walls.
const WIDTH_CELLS: usize = 3;

/// The problem `poiseuille`.
#[derive(Clone, Copy, Debug)]
pub struct PoiseuilleStart;

impl Problem<2> for PoiseuilleStart {
    fn name(&self) -> &'static str {
        "poiseuille"
    }

    fn about(&self) -> &'static str {
        "flow between walls under a body force from rest to 0.1 H²/ν (exact)"
    }

    fn levels(&self) -> &'static [usize] {
        &[8, 16, 24, 32]
    }

    fn spacing(&self, cells: usize) -> f64 {
        FLOW.height / cells as f64
    }

    fn errors(&self) -> &'static [ErrorKind] {
        &[
            ErrorKind { quantity: "velocity", norm: "relative-l2" },
            ErrorKind { quantity: "pressure", norm: "l2-over-dynamic" },
        ]
    }

    fn expected_order(&self) -> Option<(f64, f64)> {
        Some((1.3, 2.5))
    }

    fn set_up(&self, resolution: &Resolution) -> SetUp<2> {
        let (cells, per_axis) = (resolution.cells, resolution.points_per_axis);
        let h = self.spacing(cells);
        let spacing = h / per_axis as f64;
        let counts = [WIDTH_CELLS * per_axis, cells * per_axis];
        let points = lattice::lattice(counts, spacing, resolution.jitter, resolution.seed)
            .into_iter()
            .map(|position| {
                PointSpec::new(position, [0.0; 2], DENSITY, DENSITY * spacing * spacing)
            })
            .collect();
        let mut scene = Scene::new(
            GridSpec { origin: [0.0; 2], spacing: [h; 2], cells: [WIDTH_CELLS, cells] },
            [[Boundary::Periodic; 2], [Boundary::NoSlip; 2]],
            EquationOfStateSpec::WeaklyCompressible {
                reference_density: DENSITY,
                sound_speed: SOUND_SPEED,
            },
            points,
        );
        scene.viscosity = Some(FLOW.viscosity);
        scene.body_force = [FLOW.acceleration, 0.0];
        let end = END * FLOW.height.powi(2) / FLOW.viscosity;
        SetUp { scene, settings: free_surface::printed(per_axis), end }
    }

    fn gauge(&self, _resolution: &Resolution) -> Box<dyn Gauge<2>> {
        Box::new(Errors)
    }
}

struct Errors;

impl Gauge<2> for Errors {
    fn errors(&mut self, end: &End<'_, 2>) -> Vec<f64> {
        let time = end.velocity_time();
        let (mut velocity, mut pressure) = (L2::default(), L2::default());
        for point in end.simulation.observe().points {
            let exact = FLOW.velocity(point.position[1], time);
            let error = (point.velocity[0] - exact).powi(2) + point.velocity[1].powi(2);
            velocity.add(error, exact * exact, point.volume());
            let dynamic = 0.5 * DENSITY * exact * exact;
            pressure.add(point.pressure.powi(2), dynamic * dynamic, point.volume());
        }
        vec![velocity.error() / velocity.exact(), pressure.error() / pressure.exact()]
    }
}
