//! One run: steps, samples, and what is kept of them.

use std::time::Instant;

use transpoint::{InvalidInput, Simulation};

use super::policy::MOST_ENERGY;
use super::scene::{DOMAIN, GRAVITY, SOUND_SPEED, scene};
use super::state::{COLUMNS, State};
use super::{Parameters, measure};
use crate::case::{Findings, Outcome, Profile, Raster};
use crate::cases::fluid_cells::FluidCells;
use crate::cases::free_surface::{COURANT, STEPS_PER_TIME_STEP};
use crate::cases::march::counters;
use crate::progress::Progress;

/// Time between samples, about, s.
const INTERVAL: f64 = 0.01;
/// Instants of pictures and surfaces, s.
pub(super) const INSTANTS: [f64; 5] = [0.5, 1.0, 2.0, 3.0, 4.0];

/// What was sampled of a run.
#[derive(Clone, Debug, Default)]
pub(super) struct Recording {
    /// Time at the end, s, and steps taken.
    pub(super) end: Option<(f64, u64)>,
    /// States over time; the first is the start.
    pub(super) states: Vec<State>,
    /// When the first point left, s.
    pub(super) outlet: Option<f64>,
    /// Largest relative imbalance of mass in a step, and over the run up to any step.
    pub(super) imbalance: Option<[f64; 2]>,
    /// Depths of the columns of cells at the instants.
    pub(super) depths: Vec<(f64, Vec<(f64, f64)>)>,
    /// Highest water in them.
    tops: Vec<(f64, Vec<(f64, f64)>)>,
    rasters: Vec<Raster>,
}

impl Recording {
    fn profiles(&self) -> Vec<Profile> {
        let column = |(column, name): (usize, &&str)| {
            Profile::new(
                *name,
                self.states.iter().map(|state| (state.time, state.values()[column])),
            )
        };
        let at = |what: &str, lines: &[(f64, Vec<(f64, f64)>)]| -> Vec<Profile> {
            let line = |(instant, line): &(f64, Vec<(f64, f64)>)| {
                Profile::new(picture(what, *instant), line.iter().copied())
            };
            lines.iter().map(line).collect()
        };
        let columns: Vec<_> = COLUMNS.iter().enumerate().map(column).collect();
        [columns, at("depth", &self.depths), at("top", &self.tops)].concat()
    }
}

/// Name of a picture or line at an instant.
pub(super) fn picture(what: &str, instant: f64) -> String {
    format!("{what}@{instant}")
}

/// Builds, steps and measures.
pub(super) fn execute(parameters: &Parameters, progress: &Progress) -> Findings {
    let scene = scene(parameters);
    let built = parameters.variant.build_2d(&scene, &parameters.settings);
    let run = built.and_then(|simulation| {
        let mut run = Run::start(parameters, simulation);
        let outcome = run.go(&scene.grid, progress)?;
        Ok((run, outcome))
    });
    let (run, outcome) = match run {
        Ok(found) => found,
        Err(error) => {
            return Findings::not_built(&error, measure::rows(parameters, &Recording::default()));
        }
    };
    Findings {
        outcome,
        rows: measure::rows(parameters, &run.recording),
        profiles: run.recording.profiles(),
        rasters: run.recording.rasters.clone(),
        counters: counters(run.simulation.as_ref()),
        seconds: run.seconds,
    }
}

/// A run in progress.
struct Run<'a> {
    parameters: &'a Parameters,
    simulation: Box<dyn Simulation<2>>,
    recording: Recording,
    ledger: Balance,
    /// Instants of pictures to come, the next one last.
    instants: Vec<f64>,
    seconds: f64,
}

impl<'a> Run<'a> {
    fn start(parameters: &'a Parameters, simulation: Box<dyn Simulation<2>>) -> Self {
        let mut recording = Recording::default();
        recording.states.push(State::of(simulation.as_ref(), parameters));
        let ledger = Balance::of(simulation.as_ref());
        let instants = INSTANTS.into_iter().filter(|&instant| instant <= parameters.end);
        let instants = instants.rev().collect();
        Self { parameters, simulation, recording, ledger, instants, seconds: 0.0 }
    }

    /// Steps to the end and samples on the way.
    fn go(
        &mut self,
        grid: &transpoint::scene::GridSpec<2>,
        progress: &Progress,
    ) -> Result<Outcome, InvalidInput> {
        let mut dt = self.simulation.stable_dt(COURANT).dt;
        let stride = (INTERVAL / dt).round().max(1.0) as u64;
        let steps = (self.parameters.end / dt).ceil() as u64;
        let mut step = 0;
        let mut outcome = Outcome::Completed;
        while self.simulation.time() < self.parameters.end {
            let start = Instant::now();
            if step % STEPS_PER_TIME_STEP == 0 {
                dt = self.simulation.stable_dt(COURANT).dt;
            }
            let stepped = self.simulation.step(dt);
            self.seconds += start.elapsed().as_secs_f64();
            if let Err(error) = stepped {
                outcome = self.blown_up(step, error.to_string());
                break;
            }
            step += 1;
            progress.advance(step, steps.max(step));
            self.ledger.check(self.simulation.as_ref());
            if self.recording.outlet.is_none() && self.simulation.counters().n_points_removed > 0 {
                self.recording.outlet = Some(self.simulation.time());
            }
            if step % stride == 0 && !self.sample() {
                outcome = self.blown_up(step, format!("energy above {MOST_ENERGY} of the head"));
                break;
            }
            self.picture(grid)?;
        }
        if step % stride != 0 && outcome == Outcome::Completed {
            self.sample();
        }
        self.recording.end = Some((self.simulation.time(), step));
        self.recording.imbalance = Some(self.ledger.most);
        Ok(outcome)
    }

    fn blown_up(&self, step: u64, reason: String) -> Outcome {
        Outcome::BlownUp { step, time: self.simulation.time(), reason }
    }

    /// Takes a sample; returns whether the energy is within its bound.
    fn sample(&mut self) -> bool {
        let state = State::of(self.simulation.as_ref(), self.parameters);
        self.recording.states.push(state);
        state.energy() <= MOST_ENERGY * self.parameters.head() * state.mass
    }

    /// Keeps pressures and surface if an instant has come.
    fn picture(&mut self, grid: &transpoint::scene::GridSpec<2>) -> Result<(), InvalidInput> {
        let time = self.simulation.time();
        let Some(&instant) = self.instants.last().filter(|&&instant| time >= instant) else {
            return Ok(());
        };
        self.instants.pop();
        let cells = FluidCells::of(grid, self.parameters.edge(), self.simulation.as_ref());
        let beyond =
            |line: Vec<(f64, f64)>| line.into_iter().filter(|point| point.0 > 0.0).collect();
        let recording = &mut self.recording;
        recording.depths.push((instant, beyond(cells.depths())));
        recording.tops.push((instant, beyond(cells.tops())));
        // Hydrostatic pressure of half the height of the channel.
        let most = 0.5 * super::scene::DENSITY * GRAVITY * DOMAIN[1];
        recording.rasters.push(cells.pressure(picture("pressure", instant), 1, [0.0, most])?);
        Ok(())
    }
}

/// The balance of mass: what there is against what came in and went out.
struct Balance {
    start: f64,
    before: [f64; 2],
    /// Largest relative imbalance in a step and over the run.
    most: [f64; 2],
}

impl Balance {
    fn of(simulation: &dyn Simulation<2>) -> Self {
        let mass = simulation.conserved().mass;
        Self { start: mass, before: [mass, net(simulation)], most: [0.0; 2] }
    }

    fn check(&mut self, simulation: &dyn Simulation<2>) {
        let (mass, net) = (simulation.conserved().mass, net(simulation));
        let step = (mass - self.before[0]) - (net - self.before[1]);
        let run = mass - self.start - net;
        self.before = [mass, net];
        for (most, found) in self.most.iter_mut().zip([step, run]) {
            let relative = (found / mass).abs();
            // A comparison with what is not a number must not hide it.
            *most = if relative.is_nan() { relative } else { most.max(relative) };
        }
    }
}

/// What came in less what went out, kg.
fn net(simulation: &dyn Simulation<2>) -> f64 {
    let ledger = simulation.ledger();
    ledger.entered().conserved.mass - ledger.left().conserved.mass
}

/// Ma: largest speed over that of sound.
pub(super) fn mach(states: &[State]) -> f64 {
    states.iter().map(|state| state.speed / SOUND_SPEED).reduce(f64::max).unwrap_or(f64::NAN)
}
