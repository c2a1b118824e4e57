//! Problems with a known answer, at any resolution: what a study of speed against error needs.
//!
//! A problem knows its scene, its end and its error; it knows no method and no cost. The study in
//! [`crate::benchmark`] runs methods on it, the one in [`crate::work_precision`] adds what they cost.

pub mod advected_wave;
pub mod cavity;
pub mod drop;
pub mod generalized_vortex;
pub mod gravity_wave;
pub mod gresho;
pub mod hydrostatic_tank;
pub mod loaded_column;
pub mod poiseuille;
pub mod pressure_pulse;
pub mod riemann_tube;
pub mod solitary_wave;
pub mod taylor_green;

use serde::{Deserialize, Serialize};
use transpoint::variants::StressUpdate;
use transpoint::{Scene, Settings, Simulation};

/// How finely and how evenly a problem is resolved.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Resolution {
    /// Cells along the length that the problem names.
    pub cells: usize,
    /// Points per cell and axis.
    pub points_per_axis: usize,
    /// Largest displacement of a point from its lattice along each axis, point spacings.
    pub jitter: f64,
    /// Seed of the displacements.
    pub seed: u64,
}

/// What a simulation is built from, and how long it runs.
#[derive(Clone, Debug, PartialEq)]
pub struct SetUp<const D: usize> {
    /// The scene.
    pub scene: Scene<D>,
    /// The settings that all methods share here.
    pub settings: Settings,
    /// End time, s.
    pub end: f64,
}

/// The end of a run, as a gauge sees it.
#[derive(Clone, Copy)]
pub struct End<'a, const D: usize> {
    /// The simulation after its last step.
    pub simulation: &'a dyn Simulation<D>,
    /// The time step of the run, s.
    pub dt: f64,
    /// When the stress was updated within a step.
    pub stress_update: StressUpdate,
}

impl<const D: usize> End<'_, D> {
    /// The time whose velocity the points carry, s: half a step before that of their density with the stress
    /// updated last, half a step after it with the stress updated first (ADR 0006).
    pub fn velocity_time(&self) -> f64 {
        let half = 0.5 * self.dt;
        match self.stress_update {
            StressUpdate::First => self.simulation.time() + half,
            StressUpdate::Last | StressUpdate::ModifiedLast => self.simulation.time() - half,
        }
    }
}

/// Measures one run.
pub trait Gauge<const D: usize> {
    /// Looks at the simulation after each step.
    fn watch(&mut self, _simulation: &dyn Simulation<D>) {}

    /// The errors at the end, one for each of [`Problem::errors`], relative to a scale of the exact answer.
    fn errors(&mut self, end: &End<'_, D>) -> Vec<f64>;
}

/// One relative error of a problem.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct ErrorKind {
    /// The quantity, as in tables: `pressure`, `velocity`, `period`.
    pub quantity: &'static str,
    /// How the error is taken, e.g. `relative-l2`.
    pub norm: &'static str,
}

/// A problem with a known answer.
///
/// To add one: a file here, an entry in [`crate::benchmark::ALL`], and its exact answer with a test of its own.
pub trait Problem<const D: usize>: Sync {
    /// Identifier on command lines, in tables and in file names.
    fn name(&self) -> &'static str;

    /// One line: what it is, what is hard about it, where the answer comes from.
    fn about(&self) -> &'static str;

    /// Cells of the levels, coarsest first, at least four.
    fn levels(&self) -> &'static [usize];

    /// Cell size at a number of cells, m.
    fn spacing(&self, cells: usize) -> f64;

    /// The errors that are measured; the first one ranks.
    fn errors(&self) -> &'static [ErrorKind];

    /// Whether fluid ends within the grid: then the policy of [`free_surface`](crate::cases::free_surface) holds.
    fn has_free_surface(&self) -> bool {
        false
    }

    /// Orders that theory and the smoothness of the answer let one expect of a consistent method, for the first
    /// error; `None` where the answer allows none.
    fn expected_order(&self) -> Option<(f64, f64)> {
        None
    }

    /// Scene, settings and end.
    fn set_up(&self, resolution: &Resolution) -> SetUp<D>;

    /// What measures a run.
    fn gauge(&self, resolution: &Resolution) -> Box<dyn Gauge<D>>;
}
