//! Hard cases 2 and 4, `disorder` and `long-time`: a standing wave on points out of order.
//!
//! On a lattice errors of neighbouring points cancel. Where points are out of order they do not, and an order of
//! convergence shows what a method owes to the lattice; in time, what little grows per step comes to light. Both
//! runs are the wave of case `sine-wave` in one dimension, its amplitude 10⁻⁶ of its length, so that the points
//! stay where they are.
//!
//! `disorder`: points displaced by up to 0.45 of their spacing, 3 seeds, 32, 64 and 128 cells, to T/4.
//!
//! `long-time`: points displaced by up to 0.3 of their spacing, 3 seeds, 20 cells, 100 periods. The energy is that
//! which a leapfrog step keeps, with the product of the velocities before and after the instant of the pressure,
//!
//! ```text
//! E = Σ ½ m v⁻ · v⁺ + Σ p²/(2 ρ c²) m/ρ
//! ```
//!
//! and its mean over each period counts, since the nodes' kinetic energy, which a step exchanges with that of
//! compression, differs from the points' by (k h)²/6 and more within a period.

use transpoint::Scene;
use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::simulation::PointState;
use transpoint::variants::StressUpdate;

use super::list::{Goal, HardCase, Run};
use super::trial::{COURANT, Measured, Trial, march, slope, worse};
use crate::case::{Outcome, Tier};
use crate::cases::lattice;
use crate::exact::sine_wave::StandingWave;
use crate::measure::norms::L2;

/// The wave of case `sine-wave`.
const WAVE: StandingWave =
    StandingWave { amplitude: 1e-6, length: 1.0, density: 1000.0, sound_speed: 50.0 };
/// Seeds are this plus a number.
const SEED: u64 = 20_261_101;
/// Number of seeds of both runs.
const SEEDS: u64 = 3;
/// Displacement in `disorder`, point spacings.
const STRONG: f64 = 0.45;
/// Cells in `disorder`.
const CELLS: [usize; 3] = [32, 64, 128];
/// Cells in `long-time`.
const LONG_CELLS: usize = 20;
/// Periods of `long-time`.
const PERIODS: usize = 100;

/// The run of `disorder`.
pub(super) const DISORDER_RUN: Run = Run {
    name: "disorder",
    spacing: 1.0 / 128.0,
    tier: Tier::Smoke,
    quantities: &["order", "over-regular", "error-128"],
    execute: disorder,
};

/// Hard case 2.
pub(super) const DISORDER: HardCase = HardCase {
    name: "disorder",
    run: DISORDER_RUN.name,
    criterion: "wave on points displaced by 0.45 spacings: order of the points' pressure at least 1.5, error on 128 \
                cells at most twice that of the lattice",
    goals: &[Goal::above("order", 1.5), Goal::below("over-regular", 2.0)],
};

/// The run of `long-time`.
pub(super) const LONG_TIME_RUN: Run = Run {
    name: "long-time",
    spacing: 1.0 / LONG_CELLS as f64,
    tier: Tier::Smoke,
    quantities: &["loss-per-period", "excess", "growth-per-period"],
    execute: long_time,
};

/// Hard case 4.
pub(super) const LONG_TIME: HardCase = HardCase {
    name: "long-time",
    run: LONG_TIME_RUN.name,
    criterion: "wave on displaced points, 100 periods of 20 cells: energy at most 0.1 % above the start, loss at most \
                2 % per period, no growth above 10⁻³ per period",
    goals: &[
        Goal::below("loss-per-period", 0.02),
        Goal::below("excess", 1e-3),
        Goal::below("growth-per-period", 1e-3),
    ],
};

fn scene(cells: usize, jitter: f64, seed: u64) -> Scene<1> {
    let h = WAVE.length / cells as f64;
    let point = |position: [f64; 1]| {
        let velocity = [WAVE.velocity(position[0], 0.0)];
        let spec = PointSpec::new(position, velocity, WAVE.density, WAVE.density * 0.5 * h);
        PointSpec { velocity_gradient: [[WAVE.velocity_gradient(position[0], 0.0)]], ..spec }
    };
    Scene::new(
        GridSpec { origin: [0.0], spacing: [h], cells: [cells] },
        [[Boundary::Slip; 2]],
        EquationOfStateSpec::WeaklyCompressible {
            reference_density: WAVE.density,
            sound_speed: WAVE.sound_speed,
        },
        lattice::positions(h, [cells], jitter, seed).into_iter().map(point).collect(),
    )
}

/// Error of the points' pressure at T/4, relative.
fn error(trial: &Trial<'_>, cells: usize, jitter: f64, seed: u64) -> Result<f64, Outcome> {
    let mut simulation = trial.line(&scene(cells, jitter, seed), &Trial::closed())?;
    let end = 0.25 * WAVE.period();
    let steps = (end / simulation.stable_dt(COURANT).dt).ceil();
    march(simulation.as_mut(), end / steps, steps as u64, |_, _| ())?;
    let mut norm = L2::default();
    simulation.visit_points(&mut |point| {
        let exact = WAVE.pressure(WAVE.material(point.position[0], end), end);
        norm.add((point.pressure - exact).powi(2), exact * exact, point.volume());
    });
    Ok(norm.error() / norm.exact())
}

fn disorder(trial: &Trial<'_>) -> Measured {
    let mut errors = Vec::new();
    for cells in CELLS {
        let mut mean = 0.0;
        for seed in 0..SEEDS {
            mean += error(trial, cells, STRONG, SEED + seed)? / SEEDS as f64;
        }
        errors.push((-(cells as f64).ln(), mean));
    }
    let regular = error(trial, CELLS[2], 0.0, SEED)?;
    let order = slope(&errors.iter().map(|&(h, error)| (h, error.ln())).collect::<Vec<_>>());
    Ok(vec![order, errors[2].1 / regular, errors[2].1])
}

/// Velocities in the order of identifiers, and energy of compression.
type State = (Vec<(f64, f64)>, f64);

fn state(points: &[PointState<1>]) -> State {
    let compression = |point: &PointState<1>| {
        point.pressure.powi(2) / (2.0 * point.density * WAVE.sound_speed.powi(2)) * point.volume()
    };
    let velocities = points.iter().map(|point| (point.mass, point.velocity[0])).collect();
    (velocities, points.iter().map(compression).sum())
}

/// Mean energy of each period.
fn energies(trial: &Trial<'_>, seed: u64) -> Result<Vec<f64>, Outcome> {
    let settings = Trial::closed();
    let scene = scene(LONG_CELLS, lattice::JITTER, seed);
    let mut simulation = trial.line(&scene, &settings)?;
    let per_period = (WAVE.period() / simulation.stable_dt(COURANT).dt).ceil() as usize;
    let dt = WAVE.period() / per_period as f64;
    // With the stress updated first the velocity is half a step ahead of the pressure, otherwise behind.
    let is_first = trial.stress_update(&settings) == StressUpdate::First;
    let (mut before, mut sums) = (state(&simulation.observe().points), vec![0.0; PERIODS]);
    march(simulation.as_mut(), dt, (PERIODS * per_period) as u64, |step, simulation| {
        let now = state(&simulation.observe().points);
        let product = |(a, b): (&(f64, f64), &(f64, f64))| 0.5 * a.0 * a.1 * b.1;
        let kinetic: f64 = before.0.iter().zip(&now.0).map(product).sum();
        let compression = if is_first { now.1 } else { before.1 };
        sums[(step as usize - 1) / per_period] += (kinetic + compression) / per_period as f64;
        before = now;
    })?;
    Ok(sums)
}

fn long_time(trial: &Trial<'_>) -> Measured {
    let mut worst = [f64::NEG_INFINITY; 3];
    for seed in 0..SEEDS {
        let energies = energies(trial, SEED + seed)?;
        let (first, last) = (energies[0], energies[PERIODS - 1]);
        let loss = 1.0 - (last / first).powf(1.0 / (PERIODS - 1) as f64);
        let excess =
            energies.iter().fold(f64::NEG_INFINITY, |most, e| worse(most, e / first - 1.0));
        let later = energies.iter().enumerate().skip(PERIODS / 2);
        let growth = slope(&later.map(|(k, energy)| (k as f64, energy.ln())).collect::<Vec<_>>());
        for (worst, value) in worst.iter_mut().zip([loss, excess, growth]) {
            *worst = worse(*worst, value);
        }
    }
    Ok(worst.to_vec())
}
