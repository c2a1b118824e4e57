//! One run of a problem, and the timing of steps.

use std::time::Instant;

use transpoint::{InvalidInput, Scene, Settings, Simulation, Variant};

use super::touches::touches;
use super::{Courant, Parameters};
use crate::case::{Findings, Outcome, Row, RunSpec};
use crate::cases::free_surface;
use crate::cases::march::counters;
use crate::cases::rivals::largest_stable_courant;
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
        set_up.settings.stress_update = transpoint::variants::StressUpdate::ModifiedLast;
    }
    set_up
}

/// Builds, steps and measures.
pub(super) fn execute<const D: usize>(
    problem: &dyn Problem<D>,
    spec: &RunSpec,
    progress: &Progress,
) -> Findings
where
    Variant: Build<D>,
{
    let missing = || missing_rows(problem);
    let variant = match Variant::parse(&spec.variant) {
        Ok(variant) => variant,
        Err(error) => return Findings::not_built(&error, missing()),
    };
    let parameters = match serde_json::from_value::<Parameters>(spec.parameters.clone()) {
        Ok(parameters) => parameters,
        Err(error) => return Findings::not_built(&error, missing()),
    };
    let set_up = set_up(problem, variant, &parameters.resolution);
    let mut simulation = match variant.build(&set_up.scene, &set_up.settings) {
        Ok(simulation) => simulation,
        Err(error) => return Findings::not_built(&error, missing()),
    };
    let courant = match parameters.courant {
        Courant::Common => parameters.share,
        Courant::Own => parameters.share * largest_stable_courant(variant),
    };
    let steps = (set_up.end / simulation.stable_dt(courant).dt).ceil().max(1.0);
    let dt = set_up.end / steps;
    let mut gauge = problem.gauge(&parameters.resolution);
    let mut outcome = Outcome::Completed;
    let mut seconds = 0.0;
    for step in 0..steps as u64 {
        let start = Instant::now();
        let stepped = simulation.step(dt);
        seconds += start.elapsed().as_secs_f64();
        if let Err(error) = stepped {
            outcome = Outcome::BlownUp { step, time: simulation.time(), reason: error.to_string() };
            break;
        }
        gauge.watch(simulation.as_ref());
        progress.advance(step + 1, steps as u64);
    }
    let mut rows = if outcome == Outcome::Completed {
        let stress_update = variant.settings(&set_up.settings).stress_update;
        let end = End { simulation: simulation.as_ref(), dt, stress_update };
        problem
            .errors()
            .iter()
            .zip(gauge.errors(&end))
            .map(|(kind, value)| Row {
                value,
                scale: 1.0,
                ..Row::missing(kind.quantity, kind.norm)
            })
            .collect()
    } else {
        missing()
    };
    let counters = counters(simulation.as_ref());
    rows.push(fact("courant", courant));
    rows.push(fact("steps", steps));
    rows.push(fact("points", simulation.n_points() as f64));
    rows.push(fact("bytes-per-point", simulation.bytes_per_point() as f64));
    let touches = touches(variant, &set_up.settings, &counters, &parameters.resolution, D);
    rows.push(fact("touches", touches));
    Findings { outcome, rows, profiles: Vec::new(), rasters: Vec::new(), counters, seconds }
}

/// The rows of a run that has no values.
fn missing_rows<const D: usize>(problem: &dyn Problem<D>) -> Vec<Row> {
    problem.errors().iter().map(|kind| Row::missing(kind.quantity, kind.norm)).collect()
}

fn fact(quantity: &str, value: f64) -> Row {
    Row { value, ..Row::missing(quantity, OF_THE_RUN) }
}
