//! Hard case 8, `checkerboard`: velocities that alternate from node to node.
//!
//! The mean of such a field over a cell has no divergence, so that a method that takes its strain at the centre
//! does not see it, and nothing turns it into pressure or takes it away. A periodic box of 12 by 12 cells at rest,
//! 2 x 2 points per cell, once a lattice and once displaced by up to 0.3 of their spacing; velocity of the points
//!
//! ```text
//! v = 10⁻³ c (1, 1)/√2 φ(x),   φ(x) = Σ_I (−1)^{i+j} N_I(x)
//! ```
//!
//! with multilinear N. The amplitude is Σ m v·(1, 1)/√2 φ / Σ m φ², at its largest over the last 20 of 200 steps.

use std::f64::consts::FRAC_1_SQRT_2;

use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::{Scene, Simulation};

use super::list::{Goal, HardCase, Run};
use super::trial::{COURANT, Measured, Trial, march, worse};
use crate::case::{Outcome, Tier};
use crate::cases::lattice::{self, JITTER};

/// Cells along each axis, of size 1; ρ₀ and c are 1. An even number, so that the field is periodic.
const CELLS: usize = 12;
/// Velocity over c.
const AMPLITUDE: f64 = 1e-3;
/// Steps.
const STEPS: u64 = 200;
/// Last steps over which the amplitude is taken at its largest.
const LAST: u64 = 20;
/// Seed of the displacements.
const SEED: u64 = 20_261_108;

/// The run.
pub(super) const RUN: Run = Run {
    name: "checkerboard",
    spacing: 1.0,
    tier: Tier::Smoke,
    quantities: &["amplitude", "energy-excess", "amplitude-regular", "amplitude-jittered"],
    execute,
};

/// The hard case.
pub(super) const CASE: HardCase = HardCase {
    name: "checkerboard",
    run: RUN.name,
    criterion: "velocities that alternate from node to node, 200 steps: kinetic energy at most 1 % above the start, \
                amplitude at most 1/√10 of the start",
    // 1/√10.
    goals: &[Goal::below("amplitude", 0.316_227_766_016_838), Goal::below("energy-excess", 0.01)],
};

/// The alternating field at a place.
pub(super) fn field(place: [f64; 2]) -> f64 {
    // Along each axis (−1)^i at node i and linear between.
    place
        .map(|x| {
            let sign = if (x.floor() as i64).rem_euclid(2) == 0 { 1.0 } else { -1.0 };
            sign * (1.0 - 2.0 * (x - x.floor()))
        })
        .iter()
        .product()
}

/// Share of the field in the velocities, over that at the start.
pub(super) fn amplitude(simulation: &dyn Simulation<2>) -> f64 {
    let (mut above, mut below) = (0.0, 0.0);
    simulation.visit_points(&mut |point| {
        let phi = field(point.position);
        let [u, v] = point.velocity;
        above += point.mass * FRAC_1_SQRT_2 * (u + v) * phi;
        below += point.mass * phi * phi;
    });
    above / below / AMPLITUDE
}

pub(super) fn scene(jitter: f64) -> Scene<2> {
    let point = |position: [f64; 2]| {
        let speed = AMPLITUDE * FRAC_1_SQRT_2 * field(position);
        PointSpec::new(position, [speed; 2], 1.0, 0.25)
    };
    Scene::new(
        GridSpec { origin: [0.0; 2], spacing: [1.0; 2], cells: [CELLS; 2] },
        [[Boundary::Periodic; 2]; 2],
        EquationOfStateSpec::WeaklyCompressible { reference_density: 1.0, sound_speed: 1.0 },
        lattice::positions(1.0, [CELLS; 2], jitter, SEED).into_iter().map(point).collect(),
    )
}

/// Largest amplitude over the last steps, and excess of kinetic energy over all.
fn on(trial: &Trial<'_>, jitter: f64) -> Result<[f64; 2], Outcome> {
    let mut simulation = trial.plane(&scene(jitter), &Trial::closed())?;
    let dt = simulation.stable_dt(COURANT).dt;
    let start = simulation.conserved().kinetic_energy;
    let (mut last, mut most) = (0.0, f64::NEG_INFINITY);
    march(simulation.as_mut(), dt, STEPS, |step, state| {
        most = worse(most, state.conserved().kinetic_energy / start - 1.0);
        if step > STEPS - LAST {
            last = worse(last, amplitude(state).abs());
        }
    })?;
    Ok([last, most])
}

fn execute(trial: &Trial<'_>) -> Measured {
    let [regular, jittered] = [on(trial, 0.0)?, on(trial, JITTER)?];
    let worst = [0, 1].map(|k| worse(regular[k], jittered[k]));
    Ok(vec![worst[0], worst[1], regular[0], jittered[0]])
}
