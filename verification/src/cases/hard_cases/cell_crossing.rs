//! Hard case 1, `cell-crossing`: points that cross cells in a fluid under uniform pressure.
//!
//! Nothing should happen: a uniform pressure has no gradient. Where each point pushes with its own volume, the
//! forces on a node are those of the points that happen to be about it, and a point that crosses a face of the
//! linear hat changes sides at once \[Steffen2008\]. A periodic box of 8 by 8 cells with a regular lattice of 17 by
//! 17 points, off the cells by 0.13 and 0.29 of the points' spacing; p₀ = 10⁻³ ρ c²; all points move with U = 0.1 c
//! along (1, 0.37) through 50 cells.
//!
//! A lattice with a whole number of points per cell shows nothing: as many points leave a cell through one face as
//! enter through the other at the same instant, and every method is exact to round-off.

use transpoint::Scene;
use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};

use super::list::{Goal, HardCase, Run};
use super::trial::{COURANT, Measured, Trial, march, worse};
use crate::case::Tier;
use crate::cases::lattice::lattice;

/// Cells along each axis, of size 1; ρ₀ and c are 1.
const CELLS: usize = 8;
/// Points along each axis: two per cell and one more.
const POINTS: usize = 17;
/// Spacing of the points.
const SPACING: f64 = CELLS as f64 / POINTS as f64;
/// Offset of the lattice, point spacings.
const OFFSET: [f64; 2] = [0.13, 0.29];
/// U/c.
const SPEED: f64 = 0.1;
/// Direction of the motion before it is normalized.
const DIRECTION: [f64; 2] = [1.0, 0.37];
/// p₀/(ρ₀ c²).
const PRESSURE: f64 = 1e-3;
/// Cells that are crossed.
const DISTANCE: f64 = 50.0;
/// Steps between two measurements: a point takes at least 28 of them through a cell.
const STRIDE: u64 = 4;

/// The run.
pub(super) const RUN: Run = Run {
    name: "cell-crossing",
    spacing: 1.0,
    tier: Tier::Smoke,
    quantities: &["velocity-error", "pressure-noise"],
    execute,
};

/// The hard case.
pub(super) const CASE: HardCase = HardCase {
    name: "cell-crossing",
    run: RUN.name,
    criterion: "uniform pressure carried through 50 cells: |v − U| < 10⁻³ U, rms of p − p₀ < 1 % of p₀",
    goals: &[Goal::below("velocity-error", 1e-3), Goal::below("pressure-noise", 1e-2)],
};

fn velocity() -> [f64; 2] {
    let [x, y] = DIRECTION;
    DIRECTION.map(|component| SPEED * component / x.hypot(y))
}

fn scene() -> Scene<2> {
    let density = 1.0 + PRESSURE;
    let point = |place: [f64; 2]| {
        let position = [0, 1].map(|axis| place[axis] + SPACING * OFFSET[axis]);
        PointSpec::new(position, velocity(), density, density * SPACING * SPACING)
    };
    Scene::new(
        GridSpec { origin: [0.0; 2], spacing: [1.0; 2], cells: [CELLS; 2] },
        [[Boundary::Periodic; 2]; 2],
        EquationOfStateSpec::WeaklyCompressible { reference_density: 1.0, sound_speed: 1.0 },
        lattice([POINTS; 2], SPACING, 0.0, 0).into_iter().map(point).collect(),
    )
}

fn execute(trial: &Trial<'_>) -> Measured {
    let mut simulation = trial.plane(&scene(), &Trial::closed())?;
    let dt = simulation.stable_dt(COURANT).dt;
    let steps = (DISTANCE / SPEED / dt).ceil() as u64;
    let (mut error, mut noise) = (0.0, 0.0);
    march(simulation.as_mut(), dt, steps, |step, state| {
        if step % STRIDE != 0 {
            return;
        }
        let [u, v] = velocity();
        let (mut squares, mut n) = (0.0, 0.0);
        state.visit_points(&mut |point| {
            let off = (point.velocity[0] - u).hypot(point.velocity[1] - v);
            error = worse(error, off / SPEED);
            squares += (point.pressure / PRESSURE - 1.0).powi(2);
            n += 1.0;
        });
        noise = worse(noise, (squares / n).sqrt());
    })?;
    Ok(vec![error, noise])
}
