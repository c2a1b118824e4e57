//! One run: steps, samples, and what is kept of them.

use std::time::Instant;

use transpoint::rearrangement::{EventKind, EventSum};
use transpoint::{InvalidInput, Scene, Simulation};

use super::occupancy::Occupancy;
use super::policy::MOST_ENERGY;
use super::probe::{PLACES, Wall};
use super::scene::{scaled_time, scene};
use super::state::{COLUMNS, State};
use super::{Parameters, measure};
use crate::case::{Findings, Outcome, Profile, Raster};
use crate::cases::free_surface::{COURANT, STEPS_PER_TIME_STEP};
use crate::cases::march::counters;
use crate::progress::Progress;

/// T between samples of the pressure on the wall, about.
const INTERVAL: f64 = 1.5e-3;
/// Samples of the wall to one of the state of the water.
const SAMPLES_PER_STATE: u64 = 7;
/// T between written instants.
const WRITTEN: f64 = 0.05;
/// Instants of the figures, T \[Song2020\].
pub(super) const INSTANTS: [f64; 4] = [0.02, 1.0, 2.8, 3.4];

/// What is known of the cells at a written instant.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Written {
    /// T.
    pub(super) time: f64,
    /// Numerical fractures.
    pub(super) fractures: usize,
    /// How many of them are there after one more step: fills are made at its start.
    pub(super) lasting: usize,
    /// Most points in a cell.
    pub(super) most_points: u32,
}

/// What was sampled of a run.
#[derive(Clone, Debug, Default)]
pub(super) struct Recording {
    /// T at the end.
    pub(super) end: Option<f64>,
    /// T and P at the [`PLACES`].
    pub(super) pressures: Vec<(f64, [f64; PLACES.len()])>,
    /// T at which a point was first at Q.
    pub(super) wetting: Option<f64>,
    /// States of the water; the first is the start.
    pub(super) states: Vec<State>,
    /// Cells at written instants.
    pub(super) written: Vec<Written>,
    /// Changes by rearrangement, J and kg, where there is any.
    pub(super) ledger: Vec<(&'static str, Entry)>,
    rasters: Vec<Raster>,
}

/// What one kind of rearrangement did.
#[derive(Clone, Copy, Debug, Default)]
pub(super) struct Entry {
    /// Cells, new points, points gone.
    pub(super) counts: [u64; 3],
    /// Change of the mass, kg, of the momentum along x, kg m/s, and of the kinetic, potential and
    /// compression energy, J.
    pub(super) changes: [f64; 5],
}

impl Entry {
    fn of<const D: usize>(sum: &EventSum<D>) -> Self {
        let change = &sum.change;
        Self {
            counts: [sum.n_cells, sum.n_added, sum.n_removed],
            changes: [
                change.conserved.mass,
                change.conserved.momentum[0],
                change.conserved.kinetic_energy,
                change.potential_energy,
                change.compression_energy,
            ],
        }
    }
}

impl Recording {
    /// A recording without samples; its measures are not numbers.
    pub(super) fn empty(parameters: &Parameters) -> Self {
        let mut recording = Self::default();
        if parameters.settings.rearrangement.is_some() {
            recording.ledger =
                EventKind::ALL.iter().map(|&kind| (name(kind), Entry::default())).collect();
        }
        recording
    }

    fn profiles(&self) -> Vec<Profile> {
        let pressure = |(place, name): (usize, &str)| {
            let points = self.pressures.iter().map(|(time, values)| (*time, values[place]));
            Profile::new(name, points)
        };
        let column = |(column, name): (usize, &str)| {
            Profile::new(name, self.states.iter().map(|state| (state.time, state.values()[column])))
        };
        let fractures = self.written.iter().map(|written| (written.time, written.fractures as f64));
        PLACES
            .into_iter()
            .enumerate()
            .map(pressure)
            .chain(COLUMNS.into_iter().enumerate().map(column))
            .chain([Profile::new("fractures", fractures)])
            .collect()
    }
}

const fn name(kind: EventKind) -> &'static str {
    match kind {
        EventKind::Fill => "fill",
        EventKind::Reduce => "reduce",
        EventKind::Shift => "shift",
        EventKind::Split => "split",
    }
}

/// Builds with `build`, steps and measures.
pub(super) fn execute<const D: usize>(
    parameters: &Parameters,
    progress: &Progress,
    build: impl FnOnce(&Scene<D>) -> Result<Box<dyn Simulation<D>>, InvalidInput>,
) -> Findings {
    let scene = scene(parameters);
    let not_built = |error: &InvalidInput| {
        Findings::not_built(error, measure::rows(&Recording::empty(parameters)))
    };
    let run = build(&scene).and_then(|simulation| {
        let mut run = Run::start(parameters, &scene, simulation);
        let outcome = run.go(progress)?;
        Ok((run, outcome))
    });
    let (run, outcome) = match run {
        Ok(found) => found,
        Err(error) => return not_built(&error),
    };
    let recording = &run.recording;
    Findings {
        outcome,
        rows: measure::rows(recording),
        profiles: recording.profiles(),
        rasters: recording.rasters.clone(),
        counters: counters(run.simulation.as_ref()),
        seconds: run.seconds,
    }
}

/// A run in progress.
struct Run<'a, const D: usize> {
    parameters: &'a Parameters,
    scene: &'a Scene<D>,
    simulation: Box<dyn Simulation<D>>,
    recording: Recording,
    /// Written instants to come, the next one last.
    instants: Vec<f64>,
    /// Fractures at the instant written in the step before.
    fractures: Option<Vec<u32>>,
    seconds: f64,
}

impl<'a, const D: usize> Run<'a, D> {
    fn start(
        parameters: &'a Parameters,
        scene: &'a Scene<D>,
        simulation: Box<dyn Simulation<D>>,
    ) -> Self {
        let count = (parameters.end / WRITTEN).round() as usize;
        let mut instants: Vec<f64> = (1..=count).map(|k| k as f64 / (1.0 / WRITTEN)).collect();
        instants.extend(INSTANTS.into_iter().filter(|&instant| instant <= parameters.end));
        instants.sort_by(|a, b| b.total_cmp(a));
        instants.dedup();
        let mut recording = Recording::empty(parameters);
        recording.states.push(State::of(&scene.grid, simulation.as_ref()));
        Self { parameters, scene, simulation, recording, instants, fractures: None, seconds: 0.0 }
    }

    /// Steps to the end and samples on the way.
    fn go(&mut self, progress: &Progress) -> Result<Outcome, InvalidInput> {
        let mut dt = self.simulation.stable_dt(COURANT).dt;
        let stride = (INTERVAL / scaled_time(dt)).round().max(1.0) as u64;
        let steps = (self.parameters.end / scaled_time(dt)).ceil() as u64;
        let mut step = 0;
        let mut outcome = Outcome::Completed;
        while scaled_time(self.simulation.time()) < self.parameters.end {
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
            if step % stride == 0 && !self.sample(step / stride) {
                outcome = self.blown_up(step, format!("total energy above {MOST_ENERGY} E₀"));
                break;
            }
            self.write()?;
        }
        self.recording.end = Some(scaled_time(self.simulation.time()));
        let ledger = self.simulation.ledger();
        for (kind, entry) in EventKind::ALL.iter().zip(&mut self.recording.ledger) {
            entry.1 = Entry::of(&ledger.sum(*kind));
        }
        Ok(outcome)
    }

    fn blown_up(&self, step: u64, reason: String) -> Outcome {
        Outcome::BlownUp { step, time: self.simulation.time(), reason }
    }

    /// Takes a sample; returns whether the energy is within its bound.
    fn sample(&mut self, number: u64) -> bool {
        let (time, simulation) = (scaled_time(self.simulation.time()), self.simulation.as_ref());
        let mut wall = Wall::new(&self.scene.grid);
        simulation.visit_points(&mut |point| wall.add(point));
        self.recording.pressures.push((time, wall.pressures()));
        if wall.wet() && self.recording.wetting.is_none() {
            self.recording.wetting = Some(time);
        }
        if number % SAMPLES_PER_STATE != 1 {
            return true;
        }
        let state = State::of(&self.scene.grid, simulation);
        self.recording.states.push(state);
        state.total() <= MOST_ENERGY * self.recording.states[0].total()
    }

    /// Counts the fractures of the instant written in the step before that are there still.
    fn look_again(&mut self) -> Result<(), InvalidInput> {
        let Some(before) = self.fractures.take() else { return Ok(()) };
        if before.is_empty() {
            return Ok(());
        }
        let now = Occupancy::of(self.scene, self.simulation.as_ref())?;
        let lasting = before.iter().filter(|cell| now.fractures().contains(cell)).count();
        if let Some(written) = self.recording.written.last_mut() {
            written.lasting = lasting;
        }
        Ok(())
    }

    /// Looks at the cells if a written instant has come.
    fn write(&mut self) -> Result<(), InvalidInput> {
        let time = scaled_time(self.simulation.time());
        self.look_again()?;
        let Some(&instant) = self.instants.last().filter(|&&instant| time >= instant) else {
            return Ok(());
        };
        self.instants.pop();
        let occupancy = Occupancy::of(self.scene, self.simulation.as_ref())?;
        let recording = &mut self.recording;
        recording.written.push(Written {
            time: instant,
            fractures: occupancy.fractures().len(),
            lasting: 0,
            most_points: occupancy.most_points(),
        });
        self.fractures = Some(occupancy.fractures().to_vec());
        let shown = INSTANTS.contains(&instant);
        if shown || self.parameters.frames {
            recording.rasters.push(occupancy.pressure(picture("pressure", instant))?);
        }
        if shown {
            recording.rasters.push(occupancy.kinds(picture("kind", instant))?);
        }
        Ok(())
    }
}

/// Name of a picture at an instant T.
pub(super) fn picture(what: &str, instant: f64) -> String {
    format!("{what}@{instant:.2}")
}
