//! The largest stable Courant number of one variant on one lattice.

use std::collections::BTreeMap;
use std::time::Instant;

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};
use transpoint::{Scene, Simulation};

use super::{MOST_GROWTH, Parameters, STEPS, largest, theory};
use crate::case::{Findings, Outcome, Row};
use crate::progress::Progress;

/// Velocities at the start over the speed of sound: the points do not leave their places.
const AMPLITUDE: f64 = 1e-9;
/// Seed of the velocities.
const SEED: u64 = 20_261_128;
/// Points over those at the start at which a trial counts as unstable: what is stretched without bound is split without
/// bound.
const MOST_POINTS: usize = 4;
/// Steps between two measurements.
const STRIDE: u64 = 50;

/// The rows of a run that gives no number.
pub(super) fn missing_rows() -> Vec<Row> {
    ["largest-stable", "theory"].map(|norm| Row::missing("courant", norm)).to_vec()
}

/// Measures and computes; rows `courant`, `largest-stable` and `theory`.
pub(super) fn execute(parameters: &Parameters, progress: &Progress) -> Findings {
    let Parameters { variant, n_points, cells, .. } = *parameters;
    let scene = scene(parameters);
    let start = Instant::now();
    let mut failure = None;
    let mut trials = 0;
    let measured = largest(|courant| {
        trials += 1;
        progress.advance(trials, trials + 1);
        match variant.build_1d(&scene, &parameters.settings) {
            Ok(mut simulation) => is_stable(simulation.as_mut(), courant, parameters.steps),
            Err(error) => {
                failure = Some(error);
                false
            }
        }
    });
    if let Some(error) = failure {
        return Findings::not_built(&error, missing_rows());
    }
    let by_theory = if theory::reason(variant).is_none() {
        let most = MOST_GROWTH.powf(1.0 / STEPS as f64);
        largest(|courant| theory::amplification(variant, n_points, cells, courant) <= most)
    } else {
        f64::NAN
    };
    let row = |norm, value| Row { value, scale: f64::NAN, ..Row::missing("courant", norm) };
    Findings {
        outcome: Outcome::Completed,
        rows: vec![row("largest-stable", measured), row("theory", by_theory)],
        profiles: Vec::new(),
        rasters: Vec::new(),
        counters: BTreeMap::new(),
        seconds: start.elapsed().as_secs_f64(),
    }
}

fn scene(parameters: &Parameters) -> Scene<1> {
    let mut random = Pcg64::seed_from_u64(SEED);
    let spacing = 1.0 / parameters.n_points as f64;
    let points = (0..parameters.cells * parameters.n_points)
        .map(|k| {
            let noise = ((random.next_u64() >> 11) as f64 * 2f64.powi(-52)) - 1.0;
            PointSpec::new([(k as f64 + 0.5) * spacing], [AMPLITUDE * noise], 1.0, spacing)
        })
        .collect();
    Scene::new(
        GridSpec { origin: [0.0], spacing: [1.0], cells: [parameters.cells] },
        [[Boundary::Periodic; 2]],
        EquationOfStateSpec::WeaklyCompressible { reference_density: 1.0, sound_speed: 1.0 },
        points,
    )
}

fn is_stable(simulation: &mut dyn Simulation<1>, courant: f64, steps: u64) -> bool {
    let start = speed(simulation);
    let mut most: f64 = 0.0;
    let most_points = MOST_POINTS * simulation.n_points();
    for step in 1..=steps {
        if simulation.step(courant).is_err() || simulation.n_points() > most_points {
            return false;
        }
        // Growth shows now and then; asking after each step would cost as much as a step.
        if step % STRIDE == 0 {
            most = most.max(speed(simulation) / start);
        }
    }
    most <= MOST_GROWTH
}

/// Root mean square velocity.
fn speed(simulation: &dyn Simulation<1>) -> f64 {
    let (mut sum, mut n) = (0.0, 0.0);
    simulation.visit_points(&mut |point| {
        sum += point.velocity[0] * point.velocity[0];
        n += 1.0;
    });
    (sum / n).sqrt()
}
