//! Hard case 7, `tension`: a square patch of fluid that turns.
//!
//! Within the patch the pressure is negative. A method whose points push with a kernel of their own falls apart
//! under tension; one that only looks at cells does not. A square of side L turns with ω about its middle, free all
//! around \[LeTouze2013\], with the pressure of an incompressible fluid,
//!
//! ```text
//! v = ω (y, −x),   x* = x + L/2,   y* = y + L/2
//! p = −ρ Σ_{m,n odd} 32 ω²/(m n π² [(mπ/L)² + (nπ/L)²]) sin(mπx*/L) sin(nπy*/L)
//! ```
//!
//! to ω t = 2, with c = 12 ω L, 16 cells along L, 2 x 2 points per cell. The policy is that of free surfaces with the
//! relaxation of the inflow cases: the other one would damp a flow of this size in a few turns. Pieces are occupied
//! cells that are joined by sides or corners.

use std::f64::consts::PI;

use transpoint::Scene;
use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::simulation::PointState;

use super::list::{Goal, HardCase, Run};
use super::trial::{Measured, Trial, march_until};
use super::vortex::counts;
use crate::case::Tier;
use crate::cases::free_surface::INFLOW_RELAXATION;
use crate::cases::lattice;
use crate::measure::fragments::fragments;

/// Cells along the patch; L, ω and ρ₀ are 1.
const CELLS: usize = 16;
/// Side of the box over that of the patch.
const BOX: usize = 4;
/// c/(ω L).
const SOUND_SPEED: f64 = 12.0;
/// ω t at the end.
const END: f64 = 2.0;
/// Largest m and n of the series.
const TERMS: usize = 59;

/// The run.
pub(super) const RUN: Run = Run {
    name: "tension",
    spacing: 1.0 / CELLS as f64,
    tier: Tier::Paper,
    quantities: &["fragments", "angular-momentum", "area"],
    execute,
};

/// The hard case.
pub(super) const CASE: HardCase = HardCase {
    name: "tension",
    run: RUN.name,
    criterion: "turning square patch, ω t = 2: one piece, angular momentum and area within 1 %",
    goals: &[
        Goal::below("fragments", 1.0),
        Goal::below("angular-momentum", 0.01),
        Goal::below("area", 0.01),
    ],
};

/// p/(ρ ω² L²) at a place of the patch, measured from its lower corner over L.
pub(super) fn pressure([x, y]: [f64; 2]) -> f64 {
    let mut sum = 0.0;
    for m in (1..=TERMS).step_by(2).map(|m| m as f64) {
        for n in (1..=TERMS).step_by(2).map(|n| n as f64) {
            let factor = 32.0 / (m * n * PI.powi(4) * (m * m + n * n));
            sum -= factor * (m * PI * x).sin() * (n * PI * y).sin();
        }
    }
    sum
}

fn scene() -> Scene<2> {
    let h = 1.0 / CELLS as f64;
    let point = |place: [f64; 2]| {
        let [x, y] = place.map(|along| along - 0.5);
        let density = 1.0 + pressure(place) / SOUND_SPEED.powi(2);
        let spec = PointSpec::new([x, y], [y, -x], density, density * 0.25 * h * h);
        PointSpec { velocity_gradient: [[0.0, 1.0], [-1.0, 0.0]], ..spec }
    };
    Scene::new(
        GridSpec { origin: [-0.5 * BOX as f64; 2], spacing: [h; 2], cells: [BOX * CELLS; 2] },
        [[Boundary::Free; 2]; 2],
        EquationOfStateSpec::WeaklyCompressible {
            reference_density: 1.0,
            sound_speed: SOUND_SPEED,
        },
        lattice::positions(h, [CELLS; 2], 0.0, 0).into_iter().map(point).collect(),
    )
}

fn execute(trial: &Trial<'_>) -> Measured {
    let scene = scene();
    let h = scene.grid.spacing[0];
    let settings = trial.surface(2, h, SOUND_SPEED, INFLOW_RELAXATION);
    let mut simulation = trial.plane(&scene, &settings)?;
    let start = simulation.conserved().angular_momentum[2];
    march_until(simulation.as_mut(), END, |_| ())?;
    let points = simulation.observe().points;
    let occupied: Vec<bool> = counts(&scene.grid, &points).iter().map(|&n| n > 0).collect();
    let area: f64 = points.iter().map(PointState::volume).sum();
    Ok(vec![
        fragments(scene.grid.cells, &occupied) as f64,
        (simulation.conserved().angular_momentum[2] / start - 1.0).abs(),
        (area - 1.0).abs(),
    ])
}
