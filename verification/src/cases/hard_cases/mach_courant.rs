//! Hard case 13, `mach-courant`: how large a step, and how small a Mach number.
//!
//! The limit of the time step is that of full cells for every method; not every method keeps it. And what departs
//! from an incompressible flow has to fall with the square of the Mach number; where noise rules it falls with the
//! first power or not at all.
//!
//! - Courant numbers 0.3, 0.6, 0.9 and 1.05: a sound wave of 10⁻⁴ c in a periodic box of 12 by 4 cells that moves
//!   with 0.1 c, points displaced by up to 0.3 of their spacing, 400 steps. It counts as stable if the velocity
//!   about the mean never exceeds twice that at the start.
//! - Mach numbers 0.05, 0.1, 0.2 and 0.3: the vortex of `fracture` without viscosity on 12 by 12 cells to t U/L =
//!   0.5; slope of the root mean square of ρ/ρ₀ − 1 against the Mach number, both as logarithms.

use std::f64::consts::TAU;

use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::{Scene, Simulation};

use super::list::{Goal, HardCase, Run};
use super::trial::{COURANT, Measured, Trial, march, slope, worse};
use super::vortex;
use crate::case::{Outcome, Tier};
use crate::cases::lattice::{self, JITTER};

/// Courant numbers.
const COURANTS: [f64; 4] = [0.3, 0.6, 0.9, 1.05];
/// Cells of the box with the wave, of size 1; ρ₀ and c are 1.
const CELLS: [usize; 2] = [12, 4];
/// Velocity of the wave and of the box over c.
const WAVE: (f64, f64) = (1e-4, 0.1);
/// Steps.
const STEPS: u64 = 400;
/// Velocity over that at the start at which a wave is not stable.
const MOST_GROWTH: f64 = 2.0;
/// Seed of the displacements.
const SEED: u64 = 20_261_113;
/// Mach numbers of the vortex.
const MACHS: [f64; 4] = [0.05, 0.1, 0.2, 0.3];
/// Cells of the box with the vortex along each axis.
const VORTEX_CELLS: usize = 12;
/// t U/L at the end.
const END: f64 = 0.5;

/// The run.
pub(super) const RUN: Run = Run {
    name: "mach-courant",
    spacing: 1.0,
    tier: Tier::Paper,
    quantities: &["growth@0.3", "growth@0.6", "slope", "growth@0.9", "growth@1.05", "density@0.1"],
    execute,
};

/// The hard case.
pub(super) const CASE: HardCase = HardCase {
    name: "mach-courant",
    run: RUN.name,
    criterion: "moving sound wave stable at the Courant numbers 0.3 and 0.6; changes of density in a vortex fall with the \
                Mach number to the power 1.7 to 2.3",
    goals: &[
        Goal { quantity: "slope", lower: 1.7, upper: 2.3 },
        Goal::below("growth@0.3", MOST_GROWTH),
        Goal::below("growth@0.6", MOST_GROWTH),
    ],
};

fn wave() -> Scene<2> {
    let point = |position: [f64; 2]| {
        let k = TAU / CELLS[0] as f64;
        let (sine, cosine) = (k * position[0]).sin_cos();
        let spec = PointSpec::new(position, [WAVE.1 + WAVE.0 * sine, 0.0], 1.0, 0.25);
        PointSpec { velocity_gradient: [[WAVE.0 * k * cosine, 0.0], [0.0; 2]], ..spec }
    };
    Scene::new(
        GridSpec { origin: [0.0; 2], spacing: [1.0; 2], cells: CELLS },
        [[Boundary::Periodic; 2]; 2],
        EquationOfStateSpec::WeaklyCompressible { reference_density: 1.0, sound_speed: 1.0 },
        lattice::positions(1.0, CELLS, JITTER, SEED).into_iter().map(point).collect(),
    )
}

/// Root mean square of the velocity about that of the box.
fn disturbance(simulation: &dyn Simulation<2>) -> f64 {
    let (mut sum, mut n) = (0.0, 0.0);
    simulation.visit_points(&mut |point| {
        let [u, v] = point.velocity;
        sum += (u - WAVE.1).powi(2) + v * v;
        n += 1.0;
    });
    (sum / n).sqrt()
}

/// Largest disturbance over that at the start; infinite where the run bursts.
fn growth(trial: &Trial<'_>, courant: f64) -> Result<f64, Outcome> {
    let mut simulation = trial.plane(&wave(), &Trial::closed())?;
    let dt = simulation.stable_dt(courant).dt;
    let (start, mut most) = (disturbance(simulation.as_ref()), 0.0);
    let outcome = march(simulation.as_mut(), dt, STEPS, |step, state| {
        if step % 10 == 0 {
            most = worse(most, disturbance(state) / start);
        }
    });
    Ok(if outcome.is_ok() { most } else { f64::INFINITY })
}

/// Root mean square of ρ/ρ₀ − 1 in the vortex at a Mach number.
fn density(trial: &Trial<'_>, mach: f64) -> Result<f64, Outcome> {
    let scene = vortex::scene(VORTEX_CELLS, 1.0 / mach, None);
    let mut simulation = trial.plane(&scene, &Trial::flow())?;
    let dt = simulation.stable_dt(COURANT).dt;
    march(simulation.as_mut(), dt, (END / dt).ceil() as u64, |_, _| ())?;
    let (mut sum, mut n) = (0.0, 0.0);
    simulation.visit_points(&mut |point| {
        sum += (point.density - 1.0).powi(2);
        n += 1.0;
    });
    Ok((sum / n).sqrt())
}

fn execute(trial: &Trial<'_>) -> Measured {
    let mut growths = Vec::new();
    for courant in COURANTS {
        growths.push(growth(trial, courant)?);
    }
    let mut densities = Vec::new();
    for mach in MACHS {
        densities.push((mach.ln(), density(trial, mach)?.ln()));
    }
    let at_tenth = densities[1].1.exp();
    Ok(vec![growths[0], growths[1], slope(&densities), growths[2], growths[3], at_tenth])
}
