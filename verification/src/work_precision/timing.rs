//! Seconds per step, of this machine.
//!
//! All methods of a problem at one resolution are timed together, in turns: a few steps of one, of the next, and so on,
//! several rounds, so that what the machine does meanwhile falls on all of them. The least of the rounds counts. Steps
//! cost the same along a run, whatever their length, so that a run costs its number of steps times that.

use std::sync::LazyLock;
use std::time::Instant;

use serde::{Deserialize, Serialize};
use transpoint::{Simulation, Variant};

use crate::benchmark::{
    self, AnyProblem, Benchmark, Build, Courant, POINTS_PER_AXIS, Runner, VARIANTS,
};
use crate::case::{Case, Findings, Outcome, Row, RunSpec, Tier};
use crate::convergence::Order;
use crate::judge::Check;
use crate::problems::{Problem, Resolution};
use crate::progress::Progress;
use crate::record::RunRecord;
use crate::report::Artifact;

/// Steps left out at the start.
const WARM_UP: u64 = 3;
/// Rounds, the least of which counts.
const ROUNDS: usize = 5;
/// Least seconds of a round of one method.
const ROUND_SECONDS: f64 = 0.02;
/// Name of the methods together.
const EVERY: &str = "every";
/// Quantity of the rows is a method, and this is their norm.
pub(crate) const NORM: &str = "seconds-per-step";

/// The timing of a problem, as a case.
pub struct Timing(&'static Benchmark);

/// The timings of all problems.
pub fn all() -> &'static [Timing] {
    static ALL: LazyLock<Vec<Timing>> =
        LazyLock::new(|| benchmark::ALL.iter().map(Timing).collect());
    &ALL
}

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    resolution: Resolution,
    variants: Vec<Variant>,
}

/// Seconds per step of a run's method at its resolution; not a number without a timing.
pub(super) fn seconds_per_step(timings: &[RunRecord], spec: &RunSpec) -> f64 {
    let same = |record: &&RunRecord| {
        record.spec.level == spec.level && record.spec.label("points") == spec.label("points")
    };
    let row = timings.iter().find(same).and_then(|record| record.row(&spec.variant, NORM));
    row.map_or(f64::NAN, |row| row.value)
}

impl Timing {
    fn spec(&self, level: usize, points_per_axis: usize) -> RunSpec {
        let parameters = Parameters {
            resolution: self.0.resolution(level, points_per_axis),
            variants: VARIANTS.to_vec(),
        };
        let mut spec = self.0.spec(VARIANTS[0], level, points_per_axis, Courant::Common);
        EVERY.clone_into(&mut spec.variant);
        spec.labels.insert("courant".to_owned(), "timing".to_owned());
        // Plain data of numbers and names always has a JSON form.
        spec.parameters = serde_json::to_value(parameters).unwrap_or_default();
        spec
    }
}

impl Case for Timing {
    fn name(&self) -> &'static str {
        self.0.name()
    }

    fn about(&self) -> &'static str {
        self.0.about()
    }

    fn variants(&self) -> Vec<&'static str> {
        vec![EVERY]
    }

    fn levels(&self) -> usize {
        self.0.levels()
    }

    fn policy(&self) -> String {
        format!("One thread; the least of {ROUNDS} rounds in turns, {WARM_UP} steps before them.")
    }

    fn runs(&self, _tier: Tier) -> Vec<RunSpec> {
        let level = |level| POINTS_PER_AXIS.map(|points| self.spec(level, points));
        (0..self.levels()).flat_map(level).collect()
    }

    fn execute(&self, spec: &RunSpec, progress: &Progress) -> Findings {
        match self.0.0 {
            AnyProblem::Line(problem) => execute(problem, spec, progress),
            AnyProblem::Plane(problem) => execute(problem, spec, progress),
        }
    }

    fn checks(&self, _records: &[RunRecord]) -> Vec<Check> {
        Vec::new()
    }

    fn orders(&self, _records: &[RunRecord]) -> Vec<Order> {
        Vec::new()
    }

    fn artifacts(&self, _records: &[RunRecord]) -> Vec<Artifact> {
        Vec::new()
    }
}

fn execute<const D: usize>(
    problem: &dyn Problem<D>,
    spec: &RunSpec,
    progress: &Progress,
) -> Findings
where
    Variant: Build<D>,
{
    let parameters = match serde_json::from_value::<Parameters>(spec.parameters.clone()) {
        Ok(parameters) => parameters,
        Err(error) => return Findings::not_built(&error, Vec::new()),
    };
    let entrant = |&variant: &Variant| {
        let runner = Runner::new(problem, variant, &parameters.resolution).ok()?;
        Some((variant.name().to_owned(), runner.simulation))
    };
    race(parameters.variants.iter().filter_map(entrant).collect(), progress)
}

/// One simulation on the track.
struct Racer<const D: usize> {
    name: String,
    simulation: Box<dyn Simulation<D>>,
    dt: f64,
    steps: u64,
    least: f64,
}

/// Seconds per step of each simulation, in turns; rows named after them. One that bursts in its first steps is left
/// out.
pub(crate) fn race<const D: usize>(
    entrants: Vec<(String, Box<dyn Simulation<D>>)>,
    progress: &Progress,
) -> Findings {
    let start = Instant::now();
    let mut racers: Vec<Racer<D>> = entrants.into_iter().filter_map(prepare).collect();
    for round in 0..ROUNDS {
        for racer in &mut racers {
            racer.least = racer.least.min(timed(racer.simulation.as_mut(), racer.dt, racer.steps));
        }
        progress.advance(round as u64 + 1, ROUNDS as u64);
    }
    let row =
        |racer: &Racer<D>| Row { value: racer.least, ..Row::missing(racer.name.as_str(), NORM) };
    Findings {
        outcome: Outcome::Completed,
        rows: racers.iter().map(row).collect(),
        profiles: Vec::new(),
        rasters: Vec::new(),
        counters: std::collections::BTreeMap::new(),
        seconds: start.elapsed().as_secs_f64(),
    }
}

/// A simulation past its first steps, with the steps of a round.
fn prepare<const D: usize>(
    (name, mut simulation): (String, Box<dyn Simulation<D>>),
) -> Option<Racer<D>> {
    // Half the common step: timing is about steps, not about their length, and the points stay near their start.
    let dt = simulation.stable_dt(0.5 * benchmark::COURANT).dt;
    let first = timed(simulation.as_mut(), dt, WARM_UP);
    let steps = (ROUND_SECONDS / first).ceil().clamp(1.0, 500.0) as u64;
    first.is_finite().then_some(Racer { name, simulation, dt, steps, least: f64::INFINITY })
}

/// Seconds per step over some steps; infinite if one of them fails.
fn timed<const D: usize>(simulation: &mut dyn Simulation<D>, dt: f64, steps: u64) -> f64 {
    let start = Instant::now();
    for _ in 0..steps {
        if simulation.step(dt).is_err() {
            return f64::INFINITY;
        }
    }
    start.elapsed().as_secs_f64() / steps as f64
}
