//! One run of a problem.

use std::collections::BTreeMap;
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
pub(crate) fn set_up<const D: usize>(
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
pub(super) struct Marched {
    pub(super) outcome: Outcome,
    /// Relative errors; not numbers where the run did not complete.
    pub(super) errors: Vec<f64>,
    steps: f64,
    n_points: usize,
    bytes_per_point: usize,
    counters: BTreeMap<String, u64>,
    seconds: f64,
}

/// Builds, steps and measures with a Courant number.
pub(super) fn march<const D: usize>(
    problem: &dyn Problem<D>,
    variant: Variant,
    resolution: &Resolution,
    courant: f64,
    progress: &Progress,
) -> Result<Marched, InvalidInput>
where
    Variant: Build<D>,
{
    let set_up = set_up(problem, variant, resolution);
    let mut simulation = variant.build(&set_up.scene, &set_up.settings)?;
    let steps = (set_up.end / simulation.stable_dt(courant).dt).ceil().max(1.0);
    let dt = set_up.end / steps;
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
        gauge.watch(simulation.as_ref());
        progress.advance(step + 1, steps as u64);
    }
    let errors = if outcome == Outcome::Completed {
        let stress_update = variant.settings(&set_up.settings).stress_update;
        gauge.errors(&End { simulation: simulation.as_ref(), dt, stress_update })
    } else {
        vec![f64::NAN; problem.errors().len()]
    };
    Ok(Marched {
        outcome,
        errors,
        steps,
        n_points: simulation.n_points(),
        bytes_per_point: simulation.bytes_per_point(),
        counters: counters(simulation.as_ref()),
        seconds,
    })
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
    let rows = |errors: &[f64]| -> Vec<Row> {
        let row = |(kind, &value): (&super::ErrorKind, &f64)| Row {
            value,
            scale: 1.0,
            ..Row::missing(kind.quantity, kind.norm)
        };
        problem.errors().iter().zip(errors).map(row).collect()
    };
    let missing = || rows(&vec![f64::NAN; problem.errors().len()]);
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
    let marched = match march(problem, variant, resolution, courant, progress) {
        Ok(marched) => marched,
        Err(error) => return Findings::not_built(&error, missing()),
    };
    let given = problem.set_up(resolution).settings;
    let touches = touches(variant, &given, &marched.counters, resolution, D);
    let fact = |quantity: &str, value: f64| Row { value, ..Row::missing(quantity, OF_THE_RUN) };
    let mut rows = rows(&marched.errors);
    rows.extend([
        fact("courant", courant),
        fact("steps", marched.steps),
        fact("points", marched.n_points as f64),
        fact("bytes-per-point", marched.bytes_per_point as f64),
        fact("touches", touches),
    ]);
    Findings {
        outcome: marched.outcome,
        rows,
        profiles: Vec::new(),
        rasters: Vec::new(),
        counters: marched.counters,
        seconds: marched.seconds,
    }
}
