//! Case `ingredients`: what each ingredient adds to the error and to the time of a scene.
//!
//! On four problems `tpm-vp2` runs as it is, and then with one ingredient changed at a time: another field, another
//! order of the fits, no velocity-pressure formulation, a limiter, a viscosity, the energy equation, rearrangement,
//! single precision, room around the fluid. A scene should list what lowers its error, and nothing else. Labels name
//! the ingredient; `none` is the method as it is.

mod recipes;
mod results;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use transpoint::Variant;

use crate::benchmark::{self, AnyProblem, Benchmark, COURANT, Runner, error_rows, resolution_of};
use crate::case::{Case, Findings, RunSpec, Tier};
use crate::cases::lattice::LAYOUTS;
use crate::cases::march::counters;
use crate::convergence::Order;
use crate::judge::Check;
use crate::problems::{Problem, Resolution};
use crate::progress::Progress;
use crate::record::RunRecord;
use crate::report::Artifact;
use crate::work_precision::timing::race;
pub use recipes::{INGREDIENTS, Ingredient};

/// The scenes, by the names of the problems.
const SCENES: [&str; 4] =
    ["taylor-green-inviscid", "pressure-pulse", "gravity-wave", "elliptical-drop"];
/// The method to which the ingredients are added.
const BASE: Variant = Variant::TpmVpQuadratic;
/// Level of the problem at which they are compared.
const LEVEL: usize = 1;
/// Points per cell and axis.
const POINTS: usize = 2;
/// Name of the ingredients together, in timings.
const EVERY: &str = "every";

/// The case `ingredients`.
#[derive(Clone, Copy, Debug)]
pub struct Ingredients;

/// Its timings, which run alone.
#[derive(Clone, Copy, Debug)]
pub struct IngredientTimings;

#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    problem: String,
    resolution: Resolution,
    ingredient: String,
    courant: f64,
}

/// A scene's problem, which is plane.
fn scene(name: &str) -> Option<(&'static Benchmark, &'static dyn Problem<2>)> {
    let benchmark = benchmark::ALL.iter().find(|benchmark| benchmark.name() == name)?;
    match benchmark.0 {
        AnyProblem::Plane(problem) => Some((benchmark, problem)),
        AnyProblem::Line(_) => None,
    }
}

fn spec(problem: &dyn Problem<2>, ingredient: &str) -> RunSpec {
    let resolution = resolution_of(problem.levels()[LEVEL], POINTS);
    let parameters = Parameters {
        problem: problem.name().to_owned(),
        resolution,
        ingredient: ingredient.to_owned(),
        courant: COURANT,
    };
    RunSpec {
        case: "ingredients".to_owned(),
        variant: BASE.name().to_owned(),
        layout: LAYOUTS[1].to_owned(),
        labels: BTreeMap::from([
            ("ingredient".to_owned(), ingredient.to_owned()),
            ("scene".to_owned(), problem.name().to_owned()),
        ]),
        level: LEVEL,
        spacing: problem.spacing(resolution.cells),
        // Plain data of numbers and names always has a JSON form.
        parameters: serde_json::to_value(parameters).unwrap_or_default(),
    }
}

/// A simulation with an ingredient; why it cannot be built, if so.
fn runner(
    problem: &dyn Problem<2>,
    resolution: &Resolution,
    ingredient: &Ingredient,
) -> Result<Runner<2>, String> {
    let mut set_up = problem.set_up(resolution);
    let simulation = (ingredient.build)(&mut set_up).map_err(|error| error.to_string())?;
    Ok(Runner { simulation, end: set_up.end, stress_update: set_up.settings.stress_update })
}

impl Case for Ingredients {
    fn name(&self) -> &'static str {
        "ingredients"
    }

    fn about(&self) -> &'static str {
        "what each ingredient adds to the error and to the time of a scene"
    }

    fn variants(&self) -> Vec<&'static str> {
        vec![BASE.name()]
    }

    fn levels(&self) -> usize {
        LEVEL + 1
    }

    fn policy(&self) -> String {
        format!(
            "`{}` with 2 points per cell and axis, jittered, Δt = {COURANT} of the stable one; one thing changed at a \
             time.",
            BASE.name()
        )
    }

    fn runs(&self, tier: Tier) -> Vec<RunSpec> {
        let scenes = if tier == Tier::Smoke { &SCENES[..1] } else { &SCENES[..] };
        let problems = scenes.iter().filter_map(|name| scene(name));
        problems
            .flat_map(|(_, problem)| {
                INGREDIENTS.iter().map(move |ingredient| spec(problem, ingredient.name))
            })
            .collect()
    }

    fn execute(&self, spec: &RunSpec, progress: &Progress) -> Findings {
        let parameters = match serde_json::from_value::<Parameters>(spec.parameters.clone()) {
            Ok(parameters) => parameters,
            Err(error) => return Findings::not_built(&error, Vec::new()),
        };
        let ingredient = INGREDIENTS.iter().find(|other| other.name == parameters.ingredient);
        let (Some((_, problem)), Some(ingredient)) = (scene(&parameters.problem), ingredient)
        else {
            return Findings::not_built(&"no such scene or ingredient", Vec::new());
        };
        let missing = || error_rows(problem, &vec![f64::NAN; problem.errors().len()]);
        let mut runner = match runner(problem, &parameters.resolution, ingredient) {
            Ok(runner) => runner,
            Err(error) => return Findings::not_built(&error, missing()),
        };
        let marched = runner.march(problem, &parameters.resolution, parameters.courant, progress);
        Findings {
            outcome: marched.outcome,
            rows: error_rows(problem, &marched.errors),
            profiles: Vec::new(),
            rasters: Vec::new(),
            counters: counters(runner.simulation.as_ref()),
            seconds: marched.seconds,
        }
    }

    fn checks(&self, _records: &[RunRecord]) -> Vec<Check> {
        Vec::new()
    }

    fn orders(&self, _records: &[RunRecord]) -> Vec<Order> {
        Vec::new()
    }

    fn artifacts(&self, records: &[RunRecord]) -> Vec<Artifact> {
        results::artifacts(records, &[], &self.policy())
    }
}

impl Case for IngredientTimings {
    fn name(&self) -> &'static str {
        "ingredients"
    }

    fn about(&self) -> &'static str {
        "seconds per step with each ingredient"
    }

    fn variants(&self) -> Vec<&'static str> {
        vec![BASE.name()]
    }

    fn levels(&self) -> usize {
        LEVEL + 1
    }

    fn policy(&self) -> String {
        Ingredients.policy()
    }

    fn runs(&self, _tier: Tier) -> Vec<RunSpec> {
        SCENES
            .iter()
            .filter_map(|name| scene(name))
            .map(|(_, problem)| spec(problem, EVERY))
            .collect()
    }

    fn execute(&self, spec: &RunSpec, progress: &Progress) -> Findings {
        let Some((_, problem)) = scene(spec.label("scene")) else {
            return Findings::not_built(&"no such scene", Vec::new());
        };
        let resolution = resolution_of(problem.levels()[LEVEL], POINTS);
        let entrant = |ingredient: &Ingredient| {
            let runner = runner(problem, &resolution, ingredient).ok()?;
            Some((ingredient.name.to_owned(), runner.simulation))
        };
        race(INGREDIENTS.iter().filter_map(entrant).collect(), progress)
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

/// The figure and table of the errors beside the seconds of this machine.
pub fn timed_artifacts(records: &[RunRecord], timings: &[RunRecord]) -> Vec<Artifact> {
    results::artifacts(records, timings, &Ingredients.policy())
}
