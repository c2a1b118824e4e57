//! The plane in three dimensions, step by step beside itself in two.

use std::time::Instant;

use transpoint::simulation::PointState;
use transpoint::{InvalidInput, Scene, Simulation};

use super::Parameters;
use super::scene::{COLUMN, DENSITY, GRAVITY, scene};
use crate::case::{Findings, Outcome, Row};
use crate::cases::free_surface::COURANT;
use crate::cases::march::counters;
use crate::number::decade_above;
use crate::progress::Progress;

/// What is compared, each over its scale: h₀, √(g h₀) and ρ₀.
const QUANTITIES: [&str; 3] = ["position", "velocity", "density"];

/// Builds both, takes the steps, and compares.
pub(super) fn execute(parameters: &Parameters, progress: &Progress) -> Findings {
    let (plane, slab) = (scene::<2>(parameters), scene::<3>(parameters));
    match pair(parameters, &plane, &slab) {
        Ok((plane, slab)) => run(parameters, plane, slab, progress),
        Err(error) => Findings::not_built(&error, rows([f64::NAN; QUANTITIES.len()])),
    }
}

type Pair = (Box<dyn Simulation<2>>, Box<dyn Simulation<3>>);

fn pair(parameters: &Parameters, plane: &Scene<2>, slab: &Scene<3>) -> Result<Pair, InvalidInput> {
    let Parameters { variant, settings, .. } = parameters;
    Ok((variant.build_2d(plane, settings)?, variant.build_3d(slab, settings)?))
}

fn run(
    parameters: &Parameters,
    mut plane: Box<dyn Simulation<2>>,
    mut slab: Box<dyn Simulation<3>>,
    progress: &Progress,
) -> Findings {
    let steps = parameters.end as u64;
    let dt = slab.stable_dt(COURANT).dt;
    let mut outcome = Outcome::Completed;
    let start = Instant::now();
    for step in 0..steps {
        if let Err(error) = plane.step(dt).and_then(|()| slab.step(dt)) {
            outcome = Outcome::BlownUp { step, time: slab.time(), reason: error.to_string() };
            break;
        }
        progress.advance(step + 1, steps);
    }
    let seconds = start.elapsed().as_secs_f64();
    let differences = if outcome == Outcome::Completed {
        differences(&plane.observe().points, &slab.observe().points).map(decade_above)
    } else {
        [f64::NAN; QUANTITIES.len()]
    };
    Findings {
        outcome,
        rows: rows(differences),
        profiles: Vec::new(),
        rasters: Vec::new(),
        counters: counters(slab.as_ref()),
        seconds,
    }
}

/// Largest differences over all points; points above each other follow one another.
fn differences(plane: &[PointState<2>], slab: &[PointState<3>]) -> [f64; QUANTITIES.len()] {
    let layers = slab.len() / plane.len().max(1);
    let mut largest = [0.0_f64; QUANTITIES.len()];
    if slab.len() != layers * plane.len() {
        return [f64::NAN; QUANTITIES.len()];
    }
    for (flat, stack) in plane.iter().zip(slab.chunks(layers.max(1))) {
        for point in stack {
            let distance = |a: [f64; 2], b: [f64; 3]| (a[0] - b[0]).hypot(a[1] - b[1]);
            let found = [
                distance(flat.position, point.position) / COLUMN[1],
                distance(flat.velocity, point.velocity).hypot(point.velocity[2])
                    / (GRAVITY * COLUMN[1]).sqrt(),
                (flat.density - point.density).abs() / DENSITY,
            ];
            for (largest, found) in largest.iter_mut().zip(found) {
                *largest = largest.max(found);
            }
        }
    }
    largest
}

fn rows(differences: [f64; QUANTITIES.len()]) -> Vec<Row> {
    let row = |(quantity, value): (&str, f64)| Row {
        quantity: quantity.to_owned(),
        norm: "slab-difference".to_owned(),
        value,
        scale: f64::NAN,
    };
    QUANTITIES.into_iter().zip(differences).map(row).collect()
}
