//! The largest stable Courant number of one variant on one lattice.

use std::collections::BTreeMap;
use std::time::Instant;

use rand_core::{Rng, SeedableRng};
use rand_pcg::Pcg64;
use transpoint::Scene;
use transpoint::scene::{Boundary, EquationOfStateSpec, GridSpec, PointSpec};

use super::{Parameters, STEPS, largest, theory};
use crate::case::{Findings, Outcome, Row};
use crate::cases::noise;

/// Seed of the velocities.
const SEED: u64 = 20_261_128;
/// The rows of a run that gives no number.
pub(super) fn missing_rows() -> Vec<Row> {
    ["largest-stable", "theory"].map(|norm| Row::missing("courant", norm)).to_vec()
}

/// Measures and computes; rows `courant`, `largest-stable` and `theory`.
pub(super) fn execute(parameters: &Parameters) -> Findings {
    let Parameters { variant, n_points, cells, .. } = *parameters;
    let scene = scene(parameters);
    let start = Instant::now();
    let mut failure = None;
    let measured = largest(|courant| match variant.build_1d(&scene, &parameters.settings) {
        Ok(mut simulation) => noise::stays_small(simulation.as_mut(), courant, parameters.steps),
        Err(error) => {
            failure = Some(error);
            false
        }
    });
    if let Some(error) = failure {
        return Findings::not_built(&error, missing_rows());
    }
    let by_theory = if theory::reason(variant).is_none() {
        let most = noise::MOST_GROWTH.powf(1.0 / STEPS as f64);
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
            let velocity = noise::AMPLITUDE * noise::signed(random.next_u64());
            PointSpec::new([(k as f64 + 0.5) * spacing], [velocity], 1.0, spacing)
        })
        .collect();
    Scene::new(
        GridSpec { origin: [0.0], spacing: [1.0], cells: [parameters.cells] },
        [[Boundary::Periodic; 2]],
        EquationOfStateSpec::WeaklyCompressible { reference_density: 1.0, sound_speed: 1.0 },
        points,
    )
}
