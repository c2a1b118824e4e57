//! One run of a problem.

use std::time::Instant;

use transpoint::variants::StressUpdate;
use transpoint::{InvalidInput, Scene, Settings, Simulation, Variant};

use super::own_courant::largest_courant;
use super::touches::touches;
use super::{Courant, Parameters};
use crate::case::{Findings, Outcome, Row, RunSpec};
use crate::cases::free_surface;
use crate::cases::march::counters;
use crate::problems::{End, Problem, Resolution, SetUp};
use crate::progress::Progress;

/// Norm of rows that are no errors: facts of the run that its cost follows from.
pub(crate) const OF_THE_RUN: &str = "of-the-run";

/// Dimensions in which variants can be built.
pub(crate) trait Build<const D: usize> {
    /// A simulation of this variant.
    fn build(
        self,
        scene: &Scene<D>,
        settings: &Settings,
    ) -> Result<Box<dyn Simulation<D>>, InvalidInput>;
}

impl Build<1> for Variant {
    fn build(
        self,
        scene: &Scene<1>,
        settings: &Settings,
    ) -> Result<Box<dyn Simulation<1>>, InvalidInput> {
        self.build_1d(scene, settings)
    }
}

impl Build<2> for Variant {
    fn build(
        self,
        scene: &Scene<2>,
        settings: &Settings,
    ) -> Result<Box<dyn Simulation<2>>, InvalidInput> {
        self.build_2d(scene, settings)
    }
}

/// Scene and settings of a method on a problem.
fn set_up<const D: usize>(
    problem: &dyn Problem<D>,
    variant: Variant,
    resolution: &Resolution,
) -> SetUp<D> {
    let mut set_up = problem.set_up(resolution);
    if problem.has_free_surface() && free_surface::is_modified_last(variant) {
        set_up.settings.stress_update = StressUpdate::ModifiedLast;
    }
    set_up
}

/// What a run left.
pub(crate) struct Marched {
    pub(crate) outcome: Outcome,
    /// Relative errors; not numbers where the run did not complete.
    pub(crate) errors: Vec<f64>,
    pub(crate) steps: f64,
    pub(crate) seconds: f64,
}

/// A simulation with what its run needs.
pub(crate) struct Runner<const D: usize> {
    pub(crate) simulation: Box<dyn Simulation<D>>,
    /// End time, s.
    pub(crate) end: f64,
    pub(crate) stress_update: StressUpdate,
}

impl<const D: usize> Runner<D> {
    /// A method on a problem.
    pub(crate) fn new(
        problem: &dyn Problem<D>,
        variant: Variant,
        resolution: &Resolution,
    ) -> Result<Self, InvalidInput>
    where
        Variant: Build<D>,
    {
        let SetUp { scene, settings, end } = set_up(problem, variant, resolution);
        let simulation = variant.build(&scene, &settings)?;
        Ok(Self { simulation, end, stress_update: variant.settings(&settings).stress_update })
    }

    /// Steps with a Courant number, above 0, and measures.
    pub(crate) fn march(
        &mut self,
        problem: &dyn Problem<D>,
        resolution: &Resolution,
        courant: f64,
        progress: &Progress,
    ) -> Marched {
        let simulation = self.simulation.as_mut();
        let steps = (self.end / simulation.stable_dt(courant).dt).ceil().max(1.0);
        let dt = self.end / steps;
        let mut gauge = problem.gauge(resolution);
        let mut outcome = Outcome::Completed;
        let mut seconds = 0.0;
        for step in 0..steps as u64 {
            let start = Instant::now();
            let stepped = simulation.step(dt);
            seconds += start.elapsed().as_secs_f64();
            if let Err(error) = stepped {
                let (time, reason) = (simulation.time(), error.to_string());
                outcome = Outcome::BlownUp { step, time, reason };
                break;
            }
            gauge.watch(simulation);
            progress.advance(step + 1, steps as u64);
        }
        let errors = if outcome == Outcome::Completed {
            gauge.errors(&End { simulation, dt, stress_update: self.stress_update })
        } else {
            vec![f64::NAN; problem.errors().len()]
        };
        Marched { outcome, errors, steps, seconds }
    }
}

/// Rows of errors in the order of the problem.
pub(crate) fn error_rows<const D: usize>(problem: &dyn Problem<D>, errors: &[f64]) -> Vec<Row> {
    let row = |(kind, &value): (&super::ErrorKind, &f64)| Row {
        value,
        scale: 1.0,
        ..Row::missing(kind.quantity, kind.norm)
    };
    problem.errors().iter().zip(errors).map(row).collect()
}

/// The run of a specification.
pub(super) fn execute<const D: usize>(
    problem: &dyn Problem<D>,
    spec: &RunSpec,
    progress: &Progress,
) -> Findings
where
    Variant: Build<D>,
{
    let missing = || error_rows(problem, &vec![f64::NAN; problem.errors().len()]);
    let variant = match Variant::parse(&spec.variant) {
        Ok(variant) => variant,
        Err(error) => return Findings::not_built(&error, missing()),
    };
    let parameters = match serde_json::from_value::<Parameters>(spec.parameters.clone()) {
        Ok(parameters) => parameters,
        Err(error) => return Findings::not_built(&error, missing()),
    };
    let resolution = &parameters.resolution;
    let courant = match parameters.courant {
        Courant::Common => parameters.share,
        Courant::Own => parameters.share * largest_courant(problem, variant),
    };
    if courant == 0.0 {
        let reason = "no Courant number from 0.1 on keeps its error at the coarsest level bounded";
        return Findings::not_built(&reason, missing());
    }
    let mut runner = match Runner::new(problem, variant, resolution) {
        Ok(runner) => runner,
        Err(error) => return Findings::not_built(&error, missing()),
    };
    let marched = runner.march(problem, resolution, courant, progress);
    let simulation = runner.simulation.as_ref();
    let counters = counters(simulation);
    let given = problem.set_up(resolution).settings;
    let fact = |quantity: &str, value: f64| Row { value, ..Row::missing(quantity, OF_THE_RUN) };
    let mut rows = error_rows(problem, &marched.errors);
    rows.extend([
        fact("courant", courant),
        fact("steps", marched.steps),
        fact("points", simulation.n_points() as f64),
        fact("bytes-per-point", simulation.bytes_per_point() as f64),
        fact("touches", touches(variant, &given, &counters, resolution, D)),
    ]);
    Findings {
        outcome: marched.outcome,
        rows,
        profiles: Vec::new(),
        rasters: Vec::new(),
        counters,
        seconds: marched.seconds,
    }
}
