//! Case `operators`: reproduction and gradient errors of every operator between points, nodes and
//! cells. Nothing moves.
//!
//! A smooth field on the unit square is handed through one operator at a time, and its error is
//! taken over the `interior` (cells and nodes at least two cells away from all walls) and over the
//! cells or nodes at a `wall`, as root mean square (`l2`) and largest error (`max`):
//!
//! - shape functions \[Steffen2008\], \[Bardenhagen2004\]: the field at the nodes' coordinates (Greville
//!   abscissae) as coefficients, `value` and `gradient` at the points. Splines of any degree are then
//!   of second order: values are not the coefficients of an interpolant;
//! - transfer: from the points to the nodes by mass-weighted means and back, `value` at the points:
//!   PIC \[Harlow1964\], and APIC \[Jiang2015\] with the exact gradient as affine field;
//! - reconstruction by moving least squares, of which the constant one is \[Shepard1968\]: the field
//!   at the points, its value at the cell `center` and at the `node`, and the `gradient` at the centre
//!   by the one-point rule from the node values;
//! - point divergence: the divergence of each cell by the one-point rule from exact node velocities,
//!   brought to the points.
//!
//! Quantities are named `quantity@region`. The rows `exact-constant` and `exact-linear` are the
//! largest errors on a constant and on a linear field where the fit is regular, by their decade if they are round-off.

mod apply;
mod cloud;
mod families;
mod results;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;
use std::time::Instant;

use serde::{Deserialize, Serialize};

use crate::case::{Case, Findings, Outcome, Row, RunSpec, Tier};
use crate::convergence::{self, Order};
use crate::exact::smooth_field;
use crate::judge::Check;
use crate::measure::norms::L2;
use crate::number::decade_above;
use crate::progress::Progress;
use crate::record::RunRecord;
use crate::report::Artifact;
use cloud::{JITTER, Region};
use families::{FAMILIES, missing_rows, quantities};

/// Cells per axis, coarsest first.
const CELLS: [usize; 5] = [8, 16, 32, 64, 128];
/// Levels of the smallest tier: 8 cells do not resolve the field well enough for three levels alone
/// to show an order.
const SMOKE_LEVELS: std::ops::Range<usize> = 1..4;
/// Layouts of the points.
const LAYOUTS: [&str; 3] = ["regular", "jittered", "random"];
/// Seed of a layout is this plus the level.
const SEED: u64 = 20_260_502;

/// A field with what follows from it.
struct Field {
    value: fn([f64; 2]) -> f64,
    gradient: fn([f64; 2]) -> [f64; 2],
    velocity: fn([f64; 2]) -> [f64; 2],
    divergence: fn([f64; 2]) -> f64,
}

const SMOOTH: Field = Field {
    value: smooth_field::value,
    gradient: smooth_field::gradient,
    velocity: smooth_field::velocity,
    divergence: smooth_field::divergence,
};
/// Constant value; constant divergence.
const CONSTANT: Field = Field {
    value: |_| 1.0,
    gradient: |_| [0.0; 2],
    velocity: |x| [0.75 * x[0], 0.25 * x[1] - x[0]],
    divergence: |_| 1.0,
};
/// Linear value; linear divergence.
const LINEAR: Field = Field {
    value: |x| 0.25 + x[0] - 0.5 * x[1],
    gradient: |_| [1.0, -0.5],
    velocity: |x| [x[0] * x[1], -0.25 * x[1] * x[1] + x[0]],
    divergence: |x| 0.5 * x[1],
};

/// One comparison of an operator's result with the exact one.
struct Sample {
    quantity: &'static str,
    region: Region,
    error: f64,
    exact: f64,
    /// Whether a fit fell back to the constant basis.
    fell_back: bool,
}

impl Sample {
    fn scalar(quantity: &'static str, region: Region, found: f64, exact: f64) -> Self {
        Self {
            quantity,
            region,
            error: (found - exact).abs(),
            exact: exact.abs(),
            fell_back: false,
        }
    }

    fn vector(quantity: &'static str, region: Region, found: [f64; 2], exact: [f64; 2]) -> Self {
        let error = (found[0] - exact[0]).hypot(found[1] - exact[1]);
        Self { quantity, region, error, exact: exact[0].hypot(exact[1]), fell_back: false }
    }
}

/// Everything that a run of this case depends on.
#[derive(Clone, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// Cells per axis.
    cells: usize,
    /// Seed of the layout.
    seed: u64,
}

/// The case `operators`.
#[derive(Clone, Copy, Debug)]
pub struct Operators;

impl Case for Operators {
    fn name(&self) -> &'static str {
        "operators"
    }

    fn about(&self) -> &'static str {
        "reproduction and gradient errors of shape functions, transfers and reconstructions"
    }

    fn variants(&self) -> Vec<&'static str> {
        FAMILIES.iter().flat_map(|family| family.operators).copied().collect()
    }

    fn levels(&self) -> usize {
        CELLS.len()
    }

    fn policy(&self) -> String {
        format!(
            "sin(2πx + 0.3) cos(2πy − 0.5) on the unit square, 4 points per cell on average; jitter \
             ±{JITTER} of the point spacing; random: uniform with at least one point per cell; Pcg64 \
             seeded with {SEED} + level. uGIMP length 0.5 cells; -r: half width of the support in \
             cells (Shepard: 1)."
        )
    }

    fn runs(&self, tier: Tier) -> Vec<RunSpec> {
        let levels = if tier == Tier::Smoke { SMOKE_LEVELS } else { 0..CELLS.len() };
        let mut runs = Vec::new();
        for operator in self.variants() {
            for layout in LAYOUTS {
                runs.extend(levels.clone().map(|level| spec(operator, layout, level)));
            }
        }
        runs
    }

    fn execute(&self, spec: &RunSpec, _progress: &Progress) -> Findings {
        let start = Instant::now();
        let missing = missing_rows(&spec.variant);
        let parameters = match serde_json::from_value::<Parameters>(spec.parameters.clone()) {
            Ok(parameters) => parameters,
            Err(error) => return Findings::not_built(&error, missing),
        };
        let n = parameters.cells;
        let positions = cloud::positions(&spec.layout, n, parameters.seed);
        let samples = |field| apply::apply(&spec.variant, n, &positions, field);
        let (Some(smooth), Some(constant), Some(linear)) =
            (samples(&SMOOTH), samples(&CONSTANT), samples(&LINEAR))
        else {
            return Findings::not_built(&format!("operator {}", spec.variant), missing);
        };
        let mut rows: Vec<Row> =
            quantities(&spec.variant).flat_map(|(q, r, name)| rows(&smooth, q, r, &name)).collect();
        let n_fallbacks = smooth.iter().filter(|sample| sample.fell_back).count() as u64;
        rows.push(exactness("exact-constant", &constant, spec.spacing));
        rows.push(exactness("exact-linear", &linear, spec.spacing));
        Findings {
            outcome: Outcome::Completed,
            rows,
            profiles: Vec::new(),
            rasters: Vec::new(),
            counters: BTreeMap::from([
                ("n_samples".to_owned(), smooth.len() as u64),
                ("n_singular_fallbacks".to_owned(), n_fallbacks),
            ]),
            seconds: start.elapsed().as_secs_f64(),
        }
    }

    fn checks(&self, records: &[RunRecord]) -> Vec<Check> {
        results::checks(records, &self.orders(records))
    }

    fn orders(&self, records: &[RunRecord]) -> Vec<Order> {
        convergence::orders(results::errors(records).iter())
    }

    fn artifacts(&self, records: &[RunRecord]) -> Vec<Artifact> {
        results::artifacts(records, &self.policy())
    }
}

fn spec(operator: &str, layout: &str, level: usize) -> RunSpec {
    let parameters = Parameters { cells: CELLS[level], seed: SEED + level as u64 };
    RunSpec {
        case: "operators".to_owned(),
        variant: operator.to_owned(),
        layout: layout.to_owned(),
        labels: BTreeMap::new(),
        level,
        spacing: 1.0 / CELLS[level] as f64,
        // Plain data of numbers always has a JSON form.
        parameters: serde_json::to_value(parameters).unwrap_or_default(),
    }
}

/// Root mean square and largest error of one quantity in one region.
fn rows(samples: &[Sample], quantity: &str, region: Region, name: &str) -> [Row; 2] {
    let of_region = || samples.iter().filter(|s| s.quantity == quantity && s.region == region);
    let volume = 1.0 / of_region().count() as f64;
    let mut norm = L2::default();
    of_region().for_each(|s| norm.add(s.error.powi(2), s.exact.powi(2), volume));
    let largest = |values: &mut dyn Iterator<Item = f64>| values.fold(0.0, greater);
    let row = |norm: &str, value, scale| Row {
        quantity: name.to_owned(),
        norm: norm.to_owned(),
        value,
        scale,
    };
    [
        row("l2", norm.error(), norm.exact()),
        row(
            "max",
            largest(&mut of_region().map(|s| s.error)),
            largest(&mut of_region().map(|s| s.exact)),
        ),
    ]
}

/// The greater of two values; not a number if one is not.
fn greater(a: f64, b: f64) -> f64 {
    if b > a || b.is_nan() { b } else { a }
}

/// Largest error of all samples, derivatives per cell as they are formed; round-off is reported by
/// its decade, as it depends on the machine.
///
/// Samples whose fit is singular are left out: there the constant basis takes over by definition. They
/// are counted in `n_singular_fallbacks`.
fn exactness(quantity: &str, samples: &[Sample], spacing: f64) -> Row {
    let error_of = |sample: &Sample| match sample.quantity {
        "gradient" | "divergence" => sample.error * spacing,
        _ => sample.error,
    };
    let error = samples.iter().filter(|sample| !sample.fell_back).map(error_of).fold(0.0, greater);
    let value = if error < 1e-10 { decade_above(error) } else { error };
    Row { quantity: quantity.to_owned(), norm: "max".to_owned(), value, scale: 1.0 }
}
