//! Long runs beside hard case 4: a drop that oscillates for 100 periods, and a tank at rest for 5 s.
//!
//! What the wave of `long-time` cannot show is what a free surface adds in thousands of steps. Both runs are problems of
//! the study of speed against error on cells that keep them cheap, with jittered points and the policy of free
//! surfaces with the relaxation of the inflow cases; the other one takes the motion of a drop of this size within a
//! few periods. They are no hard cases of their own: their numbers and marks stand in a table, and no verdict on record
//! depends on them.
//!
//! `long-drop`: `oscillating-drop`, 12 cells across, c = 5 ΩR, 100 periods. The energy is that of the oscillation: the
//! sum of kinetic energy, ½ m Ω² R² and compression over its value at the start, when the drop is round, less the kinetic
//! energy of then.
//!
//! `long-tank`: `hydrostatic-tank`, 12 by 12½ cells, H = 1 m, c = 10 √(gH). A period is that of the slowest standing
//! sound, 4 H/c: 100 H/c are 25 periods, 5 s are 39. The energy is the sum of kinetic energy, weight over the floor and
//! compression.
//!
//! Means over each period count. The drift per period is that of the exponential from the first to the last one. Growth
//! is the least-squares slope of the logarithm of the kinetic energy over the later half; kinetic energy of noise
//! fluctuates, so that twice the standard error of the slope is taken off before it is judged.

#[cfg(test)]
mod tests;

use transpoint::simulation::PointState;
use transpoint::{Scene, Simulation};

use super::list::{Goal, HardCase, Run};
use super::trial::{Measured, Trial, march_until, slope};
use crate::case::{Outcome, Tier};
use crate::cases::free_surface::INFLOW_RELAXATION;
use crate::cases::lattice::JITTER;
use crate::problems::drop::{Drop, oscillating};
use crate::problems::hydrostatic_tank::LEVEL;
use crate::problems::{Problem, Resolution};

/// Cells along the radius of the drop, and c/(ΩR).
const DROP: (usize, f64) = (6, 5.0);
/// Periods of the drop.
const DROP_PERIODS: usize = 100;
/// Cells along the width of the tank.
const TANK_CELLS: usize = 12;
/// End of the tank, s.
const TANK_END: f64 = 5.0;
/// Periods of the tank after 100 H/c.
const TANK_PERIODS_100: usize = 25;
/// Seed of the displacements.
const SEED: u64 = 20_261_401;

/// Bounds of both runs: drift per period, and growth per period beyond twice its standard error.
const GOALS: &[Goal] =
    &[Goal::within("drift-per-period", -0.02, 1e-3), Goal::below("sure-growth-per-period", 1e-3)];
/// What both runs measure, in order.
const QUANTITIES: &[&str] = &[
    "drift-per-period",
    "sure-growth-per-period",
    "growth-per-period",
    "energy-change",
    "rms-velocity-100",
    "rms-velocity-end",
    "largest-velocity",
];

/// The run of the drop.
pub(super) const DROP_RUN: Run = Run {
    name: "long-drop",
    spacing: 1.0 / DROP.0 as f64,
    tier: Tier::Full,
    quantities: QUANTITIES,
    execute: long_drop,
};

/// The run of the tank.
pub(super) const TANK_RUN: Run = Run {
    name: "long-tank",
    spacing: 1.0 / (TANK_CELLS as f64 + 0.5),
    tier: Tier::Full,
    quantities: QUANTITIES,
    execute: long_tank,
};

/// What both are judged by, beside the sixteen.
pub(super) static CASES: [HardCase; 2] = [
    HardCase {
        name: DROP_RUN.name,
        run: DROP_RUN.name,
        criterion: "oscillating drop, 100 periods: energy within −2 % and +0.1 % per period, no growth above 10⁻³ per \
                    period",
        goals: GOALS,
    },
    HardCase {
        name: TANK_RUN.name,
        run: TANK_RUN.name,
        criterion: "tank at rest, 5 s, a period being 4 H/c: energy within −2 % and +0.1 % per period, no growth above \
                    10⁻³ per period",
        goals: GOALS,
    },
];

/// Length of a period of one of the runs, s.
pub(super) fn period(run: &str) -> f64 {
    if run == DROP_RUN.name { drop().period() } else { 4.0 / LEVEL.at_rest().column.sound_speed }
}

/// Periods of a run that does not burst.
pub(super) fn periods(run: &str) -> f64 {
    if run == DROP_RUN.name { DROP_PERIODS as f64 } else { TANK_END / period(run) }
}

fn drop() -> Drop {
    oscillating(DROP.1)
}

fn resolution(cells: usize) -> Resolution {
    Resolution { cells, points_per_axis: 2, jitter: JITTER, seed: SEED }
}

/// Energies of the points and the largest velocity at one instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct State {
    /// Σ ½ m v², J.
    kinetic: f64,
    /// Σ m (Φ + c² (ln ρ/ρ₀ + ρ₀/ρ − 1)), with the potential Φ of the force, J.
    stored: f64,
    /// Σ m, kg.
    mass: f64,
    /// m/s.
    largest_velocity: f64,
}

impl State {
    /// The state with a potential, J/kg, a reference density, kg/m³, and a speed of sound, m/s.
    fn of(
        simulation: &dyn Simulation<2>,
        potential: &dyn Fn(&PointState<2>) -> f64,
        (density, sound_speed): (f64, f64),
    ) -> Self {
        let mut state = Self::default();
        simulation.visit_points(&mut |point| {
            let [u, v] = point.velocity;
            let ratio = point.density / density;
            let compression = sound_speed.powi(2) * (ratio.ln() + 1.0 / ratio - 1.0);
            state.kinetic += 0.5 * point.mass * (u * u + v * v);
            state.stored += point.mass * (potential(point) + compression);
            state.mass += point.mass;
            state.largest_velocity = state.largest_velocity.max(u.hypot(v));
        });
        state
    }
}

/// Sums of a run by period.
#[derive(Clone, Debug, PartialEq)]
struct Periods {
    /// Length of one, s.
    length: f64,
    /// Σ of energies, Σ of kinetic energies, and states of each.
    sums: Vec<[f64; 3]>,
    /// Of any state so far, m/s.
    largest_velocity: f64,
}

impl Periods {
    fn new(length: f64, end: f64) -> Self {
        // What is left at the end belongs to the last whole period.
        let n = (end / length).floor().max(1.0) as usize;
        Self { length, sums: vec![[0.0; 3]; n], largest_velocity: 0.0 }
    }

    fn add(&mut self, time: f64, energy: f64, state: &State) {
        let last = self.sums.len() - 1;
        let [energies, kinetic, states] = &mut self.sums[((time / self.length) as usize).min(last)];
        *energies += energy;
        *kinetic += state.kinetic;
        *states += 1.0;
        self.largest_velocity = self.largest_velocity.max(state.largest_velocity);
    }

    /// Mean energy of a period, J.
    fn energy(&self, period: usize) -> f64 {
        let [energies, _, states] = self.sums[period];
        energies / states
    }

    /// Mean kinetic energy of a period, J.
    fn kinetic(&self, period: usize) -> f64 {
        let [_, kinetic, states] = self.sums[period];
        kinetic / states
    }

    /// In the order of [`QUANTITIES`]: velocities over a scale in m/s, for a mass in kg; the fifth number is that of
    /// `period`.
    fn measure(&self, mass: f64, scale: f64, period: usize) -> Vec<f64> {
        let last = self.sums.len() - 1;
        let (first, end) = (self.energy(0), self.energy(last));
        let later = (self.sums.len() / 2..self.sums.len())
            .map(|period| (period as f64, self.kinetic(period).ln()));
        let (growth, error) = slope_with_error(&later.collect::<Vec<_>>());
        let velocity = |period: usize| (2.0 * self.kinetic(period) / mass).sqrt() / scale;
        vec![
            drift(first, end, last),
            growth - 2.0 * error,
            growth,
            end / first - 1.0,
            velocity(period.min(last)),
            velocity(last),
            self.largest_velocity / scale,
        ]
    }
}

/// Relative change per period of an exponential from `first` to `last`; −1 where nothing is left.
fn drift(first: f64, last: f64, periods: usize) -> f64 {
    // Not a number stays what it is, and fails.
    if last <= 0.0 { -1.0 } else { (last / first).powf(1.0 / periods as f64) - 1.0 }
}

/// Slope of the least-squares line, and its standard error; of at least three pairs.
fn slope_with_error(pairs: &[(f64, f64)]) -> (f64, f64) {
    let (n, slope) = (pairs.len() as f64, slope(pairs));
    let [x, y] = pairs.iter().fold([0.0; 2], |[a, b], (x, y)| [a + x / n, b + y / n]);
    let rest: f64 = pairs.iter().map(|pair| (pair.1 - y - slope * (pair.0 - x)).powi(2)).sum();
    let spread: f64 = pairs.iter().map(|pair| (pair.0 - x).powi(2)).sum();
    (slope, (rest / (n - 2.0) / spread).sqrt())
}

fn long_drop(trial: &Trial<'_>) -> Measured {
    let drop = drop();
    let scene = drop.set_up(&resolution(DROP.0)).scene;
    let [x, y] = drop.center();
    let potential = |point: &PointState<2>| {
        0.5 * ((point.position[0] - x).powi(2) + (point.position[1] - y).powi(2))
    };
    let end = DROP_PERIODS as f64 * drop.period();
    let (periods, start) =
        follow(trial, &scene, DROP.1, &potential, (drop.period(), end), |start| start.stored)?;
    Ok(periods.measure(start.mass, 1.0, DROP_PERIODS - 1))
}

fn long_tank(trial: &Trial<'_>) -> Measured {
    let scene = LEVEL.set_up(&resolution(TANK_CELLS)).scene;
    let column = LEVEL.at_rest().column;
    let potential = |point: &PointState<2>| column.gravity * point.position[1];
    let length = period(TANK_RUN.name);
    let (periods, start) =
        follow(trial, &scene, column.sound_speed, &potential, (length, TANK_END), |_| 0.0)?;
    let scale = (column.gravity * column.height).sqrt();
    Ok(periods.measure(start.mass, scale, TANK_PERIODS_100 - 1))
}

/// Steps a scene to an end, s, with periods of a length, s; its energy is that over the one `at_rest` of its start, J.
fn follow(
    trial: &Trial<'_>,
    scene: &Scene<2>,
    sound_speed: f64,
    potential: &dyn Fn(&PointState<2>) -> f64,
    (length, end): (f64, f64),
    at_rest: impl Fn(&State) -> f64,
) -> Result<(Periods, State), Outcome> {
    let settings = trial.surface(2, scene.grid.spacing[0], sound_speed, INFLOW_RELAXATION);
    let mut simulation = trial.plane(scene, &settings)?;
    // Both fluids have the density of water.
    let law = (1000.0, sound_speed);
    let start = State::of(simulation.as_ref(), potential, law);
    let at_rest = at_rest(&start);
    let mut periods = Periods::new(length, end);
    march_until(simulation.as_mut(), end, |simulation| {
        let state = State::of(simulation, potential, law);
        periods.add(simulation.time(), state.kinetic + state.stored - at_rest, &state);
    })?;
    Ok((periods, start))
}
