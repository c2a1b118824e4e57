//! One run: steps, samples of the force, and maps at the end.

use std::time::Instant;

use transpoint::rearrangement::EventKind;
use transpoint::{InvalidInput, Scene, Simulation};

use super::cells::Cells;
use super::policy::{COURANT, MOST_ENERGY, STEPS_PER_TIME_STEP};
use super::scene::{coefficient, scaled_time, scene};
use super::{Parameters, measure};
use crate::case::{Findings, Outcome, Profile, Raster};
use crate::cases::march::counters;
use crate::progress::Progress;

/// T between samples; the force of a sample is the mean since the last one.
const INTERVAL: f64 = 0.05;

/// What is known at an instant.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub(super) struct Sample {
    /// T = t U/D.
    pub(super) time: f64,
    /// C_D and C_L, means since the last sample.
    pub(super) force: [f64; 2],
    /// Σ ½ m v², J/m.
    pub(super) kinetic_energy: f64,
    /// Mass that the ledger does not explain, over that at the start.
    pub(super) ledger_error: f64,
    /// Largest speed of a point, m/s.
    pub(super) largest_speed: f64,
    /// Cells of the fluid without points.
    pub(super) n_voids: u32,
    /// Most points in a cell.
    pub(super) most_points: u32,
    /// Points in cells of the cylinder.
    pub(super) n_inside: u32,
}

/// What was sampled of a run.
#[derive(Clone, Debug, Default)]
pub(super) struct Recording {
    /// T at the end.
    pub(super) end: Option<f64>,
    /// T from which on forces are measured.
    pub(super) measured_from: f64,
    /// Kinetic energy at the start, J/m.
    pub(super) start_energy: f64,
    /// The samples, [`INTERVAL`] apart.
    pub(super) samples: Vec<Sample>,
    rasters: Vec<Raster>,
}

impl Recording {
    fn profiles(&self) -> Vec<Profile> {
        let curve = |name: &str, of: &dyn Fn(&Sample) -> f64| {
            Profile::new(name, self.samples.iter().map(|sample| (sample.time, of(sample))))
        };
        vec![
            curve("drag", &|sample| sample.force[0]),
            curve("lift", &|sample| sample.force[1]),
            curve("kinetic", &|sample| sample.kinetic_energy / self.start_energy),
            curve("voids", &|sample| f64::from(sample.n_voids)),
        ]
    }
}

/// Builds, steps and measures.
pub(super) fn execute(parameters: &Parameters, progress: &Progress) -> Findings {
    let run = scene(parameters).and_then(|scene| {
        let simulation = parameters.variant.build_2d(&scene, &parameters.settings)?;
        let mut run = Run::start(parameters, &scene, simulation);
        let outcome = run.go(progress)?;
        Ok((run, outcome))
    });
    let (run, outcome) = match run {
        Ok(found) => found,
        Err(error) => {
            return Findings::not_built(&error, measure::rows(&Recording::default()));
        }
    };
    Findings {
        outcome,
        rows: measure::rows(&run.recording),
        profiles: run.recording.profiles(),
        rasters: run.recording.rasters,
        counters: counters(run.simulation.as_ref()),
        seconds: run.seconds,
    }
}

/// A run in progress.
struct Run<'a> {
    parameters: &'a Parameters,
    cells: Cells,
    simulation: Box<dyn Simulation<2>>,
    recording: Recording,
    start_mass: f64,
    /// ∫ F dt since the last sample, N s/m, and its time, s.
    impulse: [f64; 2],
    sampled: f64,
    seconds: f64,
}

impl<'a> Run<'a> {
    fn start(
        parameters: &'a Parameters,
        scene: &Scene<2>,
        simulation: Box<dyn Simulation<2>>,
    ) -> Self {
        let totals = simulation.conserved();
        let recording = Recording {
            measured_from: parameters.measured_from,
            start_energy: totals.kinetic_energy,
            ..Recording::default()
        };
        Self {
            parameters,
            cells: Cells::new(scene.grid.clone(), parameters.shape()),
            simulation,
            recording,
            start_mass: totals.mass,
            impulse: [0.0; 2],
            sampled: 0.0,
            seconds: 0.0,
        }
    }

    /// Steps to the end and samples on the way.
    fn go(&mut self, progress: &Progress) -> Result<Outcome, InvalidInput> {
        let mut dt = self.simulation.stable_dt(COURANT).dt;
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
            for (sum, force) in self.impulse.iter_mut().zip(self.simulation.body_forces()[0]) {
                *sum += force * dt;
            }
            if scaled_time(self.simulation.time() - self.sampled) >= INTERVAL && !self.sample() {
                let reason = format!("kinetic energy above {MOST_ENERGY} times that at the start");
                outcome = self.blown_up(step, reason);
                break;
            }
        }
        self.recording.end = Some(scaled_time(self.simulation.time()));
        self.cells.look(self.simulation.as_ref());
        self.recording.rasters = self.cells.rasters()?;
        Ok(outcome)
    }

    fn blown_up(&self, step: u64, reason: String) -> Outcome {
        Outcome::BlownUp { step, time: self.simulation.time(), reason }
    }

    /// Takes a sample; returns whether the energy is within its bound.
    fn sample(&mut self) -> bool {
        let (time, simulation) = (self.simulation.time(), self.simulation.as_ref());
        let totals = simulation.conserved();
        let ledger = simulation.ledger();
        let rearranged: f64 =
            EventKind::ALL.iter().map(|&kind| ledger.sum(kind).change.conserved.mass).sum();
        let expected = self.start_mass + ledger.entered().conserved.mass
            - ledger.left().conserved.mass
            + rearranged;
        self.cells.look(simulation);
        let seen = self.cells.count();
        self.recording.samples.push(Sample {
            time: scaled_time(time),
            force: self.impulse.map(|impulse| coefficient(impulse / (time - self.sampled))),
            kinetic_energy: totals.kinetic_energy,
            ledger_error: (totals.mass - expected).abs() / self.start_mass,
            largest_speed: self.cells.largest_speed,
            n_voids: seen.voids,
            most_points: seen.most,
            n_inside: seen.inside,
        });
        self.impulse = [0.0; 2];
        self.sampled = time;
        totals.kinetic_energy <= MOST_ENERGY * self.recording.start_energy
    }
}
