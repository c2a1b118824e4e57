//! Long runs beside hard case 4: a drop that oscillates for 100 periods, and a tank at rest for 5 s.
//!
//! What the wave of `long-time` cannot show is what a free surface adds in thousands of steps. Both runs are problems of
//! the study of speed against error on cells that keep them cheap, with jittered points and the policy of free
//! surfaces with the relaxation of the inflow cases; the other one takes the motion of a drop of this size within a
//! few periods. They are no hard cases of their own: their numbers and marks stand in a table, and no verdict on record
//! depends on them.
//!
//! `long-drop`: `oscillating-drop`, 12 cells across, c = 5 ΩR, 100 periods. Besides all energy that of the motion is
//! judged, which is a fifth of it.
//!
//! `long-tank`: `hydrostatic-tank`, 12 by 12½ cells, H = 1 m, c = 10 √(gH). A period is that of the slowest standing
//! sound, 4 H/c: 100 H/c are 25 periods, 5 s are 39.
//!
//! The energy is the sum of kinetic energy, potential energy of the force (from the center of the drop, from the floor of
//! the tank) and compression. Means over each period count. The drift per period is that of the exponential from the
//! first to the last one. Growth is the least-squares slope of the logarithm of the kinetic energy over the later half;
//! kinetic energy of noise fluctuates, so that twice the standard error of the slope is taken off before it is judged.
//! The potential energy of a kilogram, over that at the start, tells whether the fluid has kept its volume: points know
//! their density from its rate, and nothing brings them back to the room that they have.

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

/// Most that energy may lose and gain in a period, relative.
const DRIFT: [f64; 2] = [-0.02, 1e-3];
/// Largest rate of growth per period.
const GROWTH: f64 = 1e-3;
/// What both runs measure, in order.
const QUANTITIES: &[&str] = &[
    "energy-drift",
    "motion-drift",
    "sure-growth",
    "growth",
    "mass-over-start",
    "potential-over-start",
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
        criterion: "oscillating drop, 100 periods: energy, and that of the motion, within −2 % and +0.1 % per period, \
                    no growth above 10⁻³ per period",
        goals: &[
            Goal::within("energy-drift", DRIFT),
            Goal::within("motion-drift", DRIFT),
            Goal::below("sure-growth", GROWTH),
        ],
    },
    HardCase {
        name: TANK_RUN.name,
        run: TANK_RUN.name,
        criterion: "tank at rest, 5 s, a period being 4 H/c: energy within −2 % and +0.1 % per period, no growth above \
                    10⁻³ per period",
        goals: &[Goal::within("energy-drift", DRIFT), Goal::below("sure-growth", GROWTH)],
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

/// Sums over the points at one instant, or of several.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
struct State {
    /// Instants.
    count: f64,
    /// Σ m, kg.
    mass: f64,
    /// Σ ½ m v², J.
    kinetic: f64,
    /// Σ m Φ with the potential Φ of the force, J.
    potential: f64,
    /// Σ m c² (ln ρ/ρ₀ + ρ₀/ρ − 1), J.
    compression: f64,
}

impl State {
    /// The state with a potential, J/kg, a reference density, kg/m³, and a speed of sound, m/s; and the largest
    /// velocity of a point, m/s.
    fn of(
        simulation: &dyn Simulation<2>,
        potential: &dyn Fn(&PointState<2>) -> f64,
        (density, sound_speed): (f64, f64),
    ) -> (Self, f64) {
        let (mut state, mut largest) = (Self { count: 1.0, ..Self::default() }, 0.0_f64);
        simulation.visit_points(&mut |point| {
            let [u, v] = point.velocity;
            let ratio = point.density / density;
            let compression = sound_speed.powi(2) * (ratio.ln() + 1.0 / ratio - 1.0);
            state.mass += point.mass;
            state.kinetic += 0.5 * point.mass * (u * u + v * v);
            state.potential += point.mass * potential(point);
            state.compression += point.mass * compression;
            largest = largest.max(u.hypot(v));
        });
        (state, largest)
    }

    fn plus(&self, other: &Self) -> Self {
        Self {
            count: self.count + other.count,
            mass: self.mass + other.mass,
            kinetic: self.kinetic + other.kinetic,
            potential: self.potential + other.potential,
            compression: self.compression + other.compression,
        }
    }

    /// Mean energy, J.
    fn energy(&self) -> f64 {
        (self.kinetic + self.potential + self.compression) / self.count
    }

    /// Mean kinetic energy, J.
    fn motion(&self) -> f64 {
        self.kinetic / self.count
    }

    /// Root mean square of the velocity, m/s.
    fn velocity(&self) -> f64 {
        (2.0 * self.kinetic / self.mass).sqrt()
    }
}

/// Sums of a run by period.
#[derive(Clone, Debug, PartialEq)]
struct Periods {
    /// Length of one, s.
    length: f64,
    sums: Vec<State>,
    /// Of any point so far, m/s.
    largest_velocity: f64,
}

impl Periods {
    fn new(length: f64, end: f64) -> Self {
        // What is left at the end belongs to the last whole period.
        let n = (end / length).floor().max(1.0) as usize;
        Self { length, sums: vec![State::default(); n], largest_velocity: 0.0 }
    }

    fn add(&mut self, time: f64, (state, largest_velocity): (State, f64)) {
        let period = ((time / self.length) as usize).min(self.sums.len() - 1);
        self.sums[period] = self.sums[period].plus(&state);
        self.largest_velocity = self.largest_velocity.max(largest_velocity);
    }

    /// In the order of [`QUANTITIES`], for a start and a scale of velocities, m/s; `rms-velocity-100` is that of
    /// `period`.
    fn measure(&self, start: &State, scale: f64, period: usize) -> Vec<f64> {
        let last = self.sums.len() - 1;
        let (first, end) = (&self.sums[0], &self.sums[last]);
        let later = self.sums.iter().enumerate().skip(self.sums.len() / 2);
        let later: Vec<_> = later.map(|(k, state)| (k as f64, state.motion().ln())).collect();
        let (growth, error) = slope_with_error(&later);
        let drift = |first: f64, end: f64| (end / first).powf(1.0 / last as f64) - 1.0;
        vec![
            drift(first.energy(), end.energy()),
            drift(first.motion(), end.motion()),
            growth - 2.0 * error,
            growth,
            end.mass / end.count / start.mass,
            end.potential / end.mass / (start.potential / start.mass),
            self.sums[period.min(last)].velocity() / scale,
            end.velocity() / scale,
            self.largest_velocity / scale,
        ]
    }
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
    // Ω = 1/s.
    let potential = |point: &PointState<2>| {
        0.5 * ((point.position[0] - x).powi(2) + (point.position[1] - y).powi(2))
    };
    let times = (drop.period(), DROP_PERIODS as f64 * drop.period());
    let (periods, start) = follow(trial, &scene, DROP.1, &potential, times)?;
    Ok(periods.measure(&start, 1.0, DROP_PERIODS - 1))
}

fn long_tank(trial: &Trial<'_>) -> Measured {
    let scene = LEVEL.set_up(&resolution(TANK_CELLS)).scene;
    let column = LEVEL.at_rest().column;
    let potential = |point: &PointState<2>| column.gravity * point.position[1];
    let times = (period(TANK_RUN.name), TANK_END);
    let (periods, start) = follow(trial, &scene, column.sound_speed, &potential, times)?;
    let scale = (column.gravity * column.height).sqrt();
    Ok(periods.measure(&start, scale, TANK_PERIODS_100 - 1))
}

/// Steps a scene to an end, s, with periods of a length, s; what was found, and the start.
fn follow(
    trial: &Trial<'_>,
    scene: &Scene<2>,
    sound_speed: f64,
    potential: &dyn Fn(&PointState<2>) -> f64,
    (length, end): (f64, f64),
) -> Result<(Periods, State), Outcome> {
    let settings = trial.surface(2, scene.grid.spacing[0], sound_speed, INFLOW_RELAXATION);
    let mut simulation = trial.plane(scene, &settings)?;
    // Both fluids have the density of water.
    let law = (1000.0, sound_speed);
    let (start, _) = State::of(simulation.as_ref(), potential, law);
    let mut periods = Periods::new(length, end);
    march_until(simulation.as_mut(), end, |simulation| {
        periods.add(simulation.time(), State::of(simulation, potential, law));
    })?;
    Ok((periods, start))
}
