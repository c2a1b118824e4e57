//! Growth per step of one method at all Courant numbers.

use std::collections::BTreeMap;
use std::time::Instant;

use nalgebra::DVector;
use transpoint::{Scene, Settings, Variant};

use super::step::{Built, Step, scene};
use super::{DEFECTIVE, LINEAR, NEUTRAL, Parameters, SEED};
use crate::case::{Findings, Outcome, Row};
use crate::measure::spectral::{Spectrum, jacobian, spectrum};
use crate::number::decade_above;
use crate::progress::Progress;

/// What is measured at each Courant number: ρ(A) − 1, and log₂ ‖A^(2N)‖/‖Aᴺ‖ at N = 2¹⁶.
const MEASURES: [&str; 2] = ["growth", "doubling"];

/// Name of a measured number.
pub(super) fn quantity(measure: &str, courant: f64) -> String {
    format!("{measure}@{courant}")
}

/// The rows of a run that has no values.
pub(super) fn missing_rows(parameters: &Parameters) -> Vec<Row> {
    let mut rows = Vec::new();
    for &courant in &parameters.courants {
        rows.extend(MEASURES.map(|name| Row::missing(quantity(name, courant), "max")));
    }
    rows.push(Row::missing("translation", "max"));
    rows
}

/// Growth of all layouts at all Courant numbers; the largest over the layouts is reported.
pub(super) fn measure<const D: usize>(
    variant: Variant,
    parameters: &Parameters,
    build: fn(Variant, &Scene<D>, &Settings) -> Built<D>,
    progress: &Progress,
) -> Result<Findings, String> {
    let start = Instant::now();
    let total = parameters.courants.len() as u64 * parameters.seeds;
    let mut rows = Vec::new();
    let mut translation = 0.0_f64;
    for (c, &courant) in parameters.courants.iter().enumerate() {
        let (mut growth, mut doubling) = (0.0_f64, 0.0_f64);
        for seed in 0..parameters.seeds {
            let step = Step {
                variant,
                settings: &parameters.settings,
                build: &|scene, settings| build(variant, scene, settings),
                scene: scene::<D>(parameters.cells, parameters.jitter, SEED + seed),
                dt: courant / (D as f64).sqrt(),
                period: 1,
            };
            let (found, drift) = of_one_period(step, 1.0)?;
            growth = growth.max(found.growth());
            doubling = doubling.max(found.doubling);
            translation = translation.max(drift);
            progress.advance(c as u64 * parameters.seeds + seed + 1, total);
        }
        let growth = reported(growth, doubling);
        for (name, value) in MEASURES.into_iter().zip([growth, (100.0 * doubling).round() / 100.0])
        {
            let (quantity, norm) = (quantity(name, courant), "max".to_owned());
            rows.push(Row { quantity, norm, value, scale: 1.0 });
        }
    }
    let value = decade_above(translation);
    rows.push(Row {
        quantity: "translation".to_owned(),
        norm: "max".to_owned(),
        value,
        scale: 1.0,
    });
    let counters = BTreeMap::from([("n_matrices".to_owned(), total)]);
    let seconds = start.elapsed().as_secs_f64();
    Ok(Findings {
        outcome: Outcome::Completed,
        rows,
        profiles: Vec::new(),
        rasters: Vec::new(),
        counters,
        seconds,
    })
}

/// What is round-off, or the root of round-off in a defective eigenvalue, is reported by its
/// decade, as it depends on the machine.
fn reported(growth: f64, doubling: f64) -> f64 {
    let defective = growth < DEFECTIVE && doubling < 3.0 * LINEAR;
    if growth <= NEUTRAL || defective { decade_above(growth.max(1e-15)) } else { growth }
}

/// The spectrum of one period of steps, and the largest change of a uniform velocity by it. Differences are taken at
/// `share` of their usual distance, a power of two.
pub(in crate::cases) fn of_one_period<const D: usize>(
    mut step: Step<'_, D>,
    share: f64,
) -> Result<(Spectrum, f64), String> {
    let base = step.base();
    let width = step.width();
    let mut near = base.clone();
    let matrix = jacobian(&base, |state, after| {
        for ((near, base), state) in near.iter_mut().zip(&base).zip(state) {
            *near = base + share * (state - base);
        }
        step.advance(&near, after)?;
        for value in after.iter_mut() {
            *value /= share;
        }
        Ok::<(), String>(())
    })?;
    let uniform = DVector::from_fn(base.len(), |k, _| if k % width == 0 { 1.0 } else { 0.0 });
    let drift = (&matrix * &uniform - &uniform).amax();
    Ok((spectrum(&matrix), drift))
}
