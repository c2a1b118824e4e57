//! The largest Courant number at which sound in a periodic box stays bounded, by trial.

use std::collections::BTreeMap;
use std::time::Instant;

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use serde::{Deserialize, Serialize};
use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::{Scene, Settings, Simulation, Variant};

use crate::case::{Findings, Outcome, Row, RunSpec};
use crate::cases::lattice::{self, JITTER, LAYOUTS};
use crate::cases::{free_surface, noise};
use crate::progress::Progress;

/// Cells along each axis.
const CELLS: usize = 12;
/// Steps of a trial.
const STEPS: u64 = 1000;
/// Courant numbers tried are multiples of this.
const INCREMENT: f64 = 0.1;
/// Most multiples and one.
const END: u64 = 32;
/// Seed of places and velocities.
const SEED: u64 = 20_200_911;

/// Everything that a run of this scene depends on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    variant: Variant,
    points_per_axis: usize,
    jitter: f64,
    steps: u64,
    settings: Settings,
}

/// Points per cell and axis, and displacements in point spacings, of the map of stability.
pub(super) const MAP: ([usize; 3], [f64; 3]) = ([1, 2, 3], [0.0, JITTER, 0.45]);

/// Name of a layout of the map, in labels.
pub(super) fn layout(points_per_axis: usize, jitter: f64) -> String {
    format!("{points_per_axis}x{points_per_axis} ±{jitter}")
}

/// The run of a variant.
pub(super) fn spec(variant: Variant) -> RunSpec {
    of_layout(variant, 2, JITTER, LAYOUTS[1])
}

/// The runs of a variant for the map of stability, in order of points and then of displacements.
pub(super) fn map(variant: Variant) -> Vec<RunSpec> {
    let (points, jitters) = MAP;
    let row = |points| {
        jitters.map(move |jitter| of_layout(variant, points, jitter, &layout(points, jitter)))
    };
    points.into_iter().flat_map(row).collect()
}

fn of_layout(variant: Variant, points_per_axis: usize, jitter: f64, label: &str) -> RunSpec {
    let settings = free_surface::printed(points_per_axis);
    let parameters = Parameters { variant, points_per_axis, jitter, steps: STEPS, settings };
    RunSpec {
        case: "rivals".to_owned(),
        variant: variant.name().to_owned(),
        layout: super::COURANT.to_owned(),
        labels: BTreeMap::from([("points".to_owned(), label.to_owned())]),
        level: 0,
        spacing: 1.0,
        // Plain data of numbers and names always has a JSON form.
        parameters: serde_json::to_value(parameters).unwrap_or_default(),
    }
}

/// Bisects the Courant numbers, stable ones being taken to lie below all others; row `courant`, `largest-stable`.
pub(super) fn execute(spec: &RunSpec, progress: &Progress) -> Findings {
    let missing = vec![Row::missing("courant", "largest-stable")];
    let parameters = match serde_json::from_value::<Parameters>(spec.parameters.clone()) {
        Ok(parameters) => parameters,
        Err(error) => return Findings::not_built(&error, missing),
    };
    let scene = scene(&parameters);
    let start = Instant::now();
    let (mut stable, mut unstable) = (0, END);
    while stable + 1 < unstable {
        let trial = u64::midpoint(stable, unstable);
        let courant = INCREMENT * trial as f64;
        let mut simulation = match parameters.variant.build_2d(&scene, &parameters.settings) {
            Ok(simulation) => simulation,
            Err(error) => return Findings::not_built(&error, missing),
        };
        if is_stable(simulation.as_mut(), courant, parameters.steps) {
            stable = trial;
        } else {
            unstable = trial;
        }
        progress.advance(END - (unstable - stable), END);
    }
    let largest = INCREMENT * stable as f64;
    let row = Row { value: largest, scale: f64::NAN, ..Row::missing("courant", "largest-stable") };
    Findings {
        outcome: Outcome::Completed,
        rows: vec![row],
        profiles: Vec::new(),
        rasters: Vec::new(),
        counters: BTreeMap::new(),
        seconds: start.elapsed().as_secs_f64(),
    }
}

fn scene(parameters: &Parameters) -> Scene<2> {
    let mut random = Pcg64::seed_from_u64(SEED);
    let mut velocity = || noise::AMPLITUDE * noise::signed(random.next_u64());
    let (count, spacing) = (parameters.points_per_axis, 1.0 / parameters.points_per_axis as f64);
    let points = lattice::lattice([CELLS * count; 2], spacing, parameters.jitter, SEED)
        .into_iter()
        .map(|position| PointSpec::new(position, [velocity(), velocity()], 1.0, spacing * spacing))
        .collect();
    Scene::new(
        GridSpec { origin: [0.0; 2], spacing: [1.0; 2], cells: [CELLS; 2] },
        [[Boundary::Periodic; 2]; 2],
        EquationOfStateSpec::WeaklyCompressible { reference_density: 1.0, sound_speed: 1.0 },
        points,
    )
}

fn is_stable(simulation: &mut dyn Simulation<2>, courant: f64, steps: u64) -> bool {
    let dt = simulation.stable_dt(courant).dt;
    noise::stays_small(simulation, dt, steps)
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn small_steps_are_stable_and_large_ones_are_not() {
        let parameters = Parameters {
            variant: Variant::Bspline2,
            points_per_axis: 2,
            jitter: JITTER,
            steps: 200,
            settings: Settings::default(),
        };
        let at = |courant| {
            let mut simulation =
                Variant::Bspline2.build_2d(&scene(&parameters), &parameters.settings).unwrap();
            is_stable(simulation.as_mut(), courant, parameters.steps)
        };
        assert!(at(0.2));
        assert!(!at(2.5));
    }
}
