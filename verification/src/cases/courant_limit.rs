//! Case `courant-limit`: the largest stable Courant number, by runs and by von Neumann's analysis.
//!
//! Noise of 10⁻⁹ c in a periodic line of 48 cells with 1, 2 and 3 points in each, on a lattice, where they stay: the
//! largest multiple of 0.01 with which the velocity is at most doubled after 1000 steps, by bisection. Theory asks the same
//! of the spectral radius of the step on each of the waves that fit into the line.

mod run;
mod symbols;
mod theory;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use transpoint::{Settings, Variant};

use super::errors::artifact;
use super::free_surface;
use crate::case::{Case, Findings, RunSpec, Tier};
use crate::convergence::Order;
use crate::judge::Check;
use crate::progress::Progress;
use crate::record::RunRecord;
use crate::report::table::{Cell, Table};
use crate::report::{Artifact, Content};

/// Points in a cell.
const POINTS: [usize; 3] = [1, 2, 3];
/// Cells of the line.
const CELLS: usize = 48;
/// Steps of a trial.
const STEPS: u64 = 1000;
/// Courant numbers tried are multiples of this.
const INCREMENT: f64 = 0.01;
/// Most multiples and one.
const END: u64 = 400;
/// Measured over theory that counts as agreement, and its inverse. Set beforehand.
const AGREEMENT: f64 = 1.1;

/// Everything that a run of this case depends on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    variant: Variant,
    n_points: usize,
    cells: usize,
    steps: u64,
    settings: Settings,
}

/// The settings of all variants, for a number of points in each cell.
fn policy(n_points: usize) -> Settings {
    free_surface::printed(n_points)
}

/// The largest stable multiple of [`INCREMENT`], stable ones being taken to lie below all others.
fn largest(mut is_stable: impl FnMut(f64) -> bool) -> f64 {
    let (mut stable, mut unstable) = (0, END);
    while stable + 1 < unstable {
        let trial = u64::midpoint(stable, unstable);
        if is_stable(INCREMENT * trial as f64) { stable = trial } else { unstable = trial }
    }
    INCREMENT * stable as f64
}

/// The case `courant-limit`.
#[derive(Clone, Copy, Debug)]
pub struct CourantLimit;

impl Case for CourantLimit {
    fn name(&self) -> &'static str {
        "courant-limit"
    }

    fn about(&self) -> &'static str {
        "largest stable Courant number on a lattice in 1D, beside von Neumann's analysis of the step"
    }

    fn variants(&self) -> Vec<&'static str> {
        Variant::ALL.map(Variant::name).to_vec()
    }

    fn levels(&self) -> usize {
        1
    }

    fn policy(&self) -> String {
        format!(
            "All variants: {:?}, with what each fixes; the support is 1.5 with one point per cell, the length of a \
             point in uGIMP one over their number.",
            policy(2)
        )
    }

    /// Smoke: what every study compares.
    fn runs(&self, tier: Tier) -> Vec<RunSpec> {
        let variants = if tier == Tier::Smoke { &Variant::CORE[..] } else { &Variant::ALL[..] };
        let points = |&variant| POINTS.map(move |n| spec(variant, n));
        variants.iter().flat_map(points).collect()
    }

    fn execute(&self, spec: &RunSpec, _progress: &Progress) -> Findings {
        match serde_json::from_value::<Parameters>(spec.parameters.clone()) {
            Ok(parameters) => run::execute(&parameters),
            Err(error) => Findings::not_built(&error, run::missing_rows()),
        }
    }

    /// Where there is a theory, the measured number is within a tenth of it.
    fn checks(&self, records: &[RunRecord]) -> Vec<Check> {
        let check = |record: &RunRecord| {
            let theory = number(record, "theory").filter(|theory| theory.is_finite())?;
            Some(Check {
                case: self.name().to_owned(),
                variant: record.spec.variant.clone(),
                layout: record.spec.layout.clone(),
                check: "measured-over-theory".to_owned(),
                measured: number(record, "largest-stable").unwrap_or(f64::NAN) / theory,
                lower: Some(1.0 / AGREEMENT),
                upper: Some(AGREEMENT),
                miss: None,
            })
        };
        records.iter().filter_map(check).collect()
    }

    fn orders(&self, _records: &[RunRecord]) -> Vec<Order> {
        Vec::new()
    }

    fn artifacts(&self, records: &[RunRecord]) -> Vec<Artifact> {
        let title = "Largest stable Courant number, measured and by theory";
        vec![artifact("courant_limit", title, Content::Table(table(records, &self.policy())))]
    }
}

fn spec(variant: Variant, n_points: usize) -> RunSpec {
    let parameters =
        Parameters { variant, n_points, cells: CELLS, steps: STEPS, settings: policy(n_points) };
    RunSpec {
        case: "courant-limit".to_owned(),
        variant: variant.name().to_owned(),
        layout: layout(n_points),
        labels: BTreeMap::new(),
        level: 0,
        spacing: 1.0,
        // Plain data of numbers and names always has a JSON form.
        parameters: serde_json::to_value(parameters).unwrap_or_default(),
    }
}

fn layout(n_points: usize) -> String {
    format!("{n_points}-per-cell")
}

fn number(record: &RunRecord, norm: &str) -> Option<f64> {
    Some(record.row("courant", norm)?.value)
}

fn table(records: &[RunRecord], policy: &str) -> Table {
    let mut columns = vec!["variant".to_owned()];
    for n in POINTS {
        columns.extend(["measured", "theory"].map(|what| format!("{what}, {n} per cell")));
    }
    columns.push("no theory because it".to_owned());
    let row = |variant: Variant| {
        let mut cells = vec![Cell::from(variant.name())];
        for n in POINTS {
            let of = |record: &&RunRecord| {
                record.spec.variant == variant.name() && record.spec.layout == layout(n)
            };
            let record = records.iter().find(of)?;
            for norm in ["largest-stable", "theory"] {
                let value = number(record, norm).unwrap_or(f64::NAN);
                cells.push(if value.is_finite() {
                    Cell::Decimal(value)
                } else {
                    Cell::from("–")
                });
            }
        }
        cells.push(Cell::from(theory::reason(variant).unwrap_or_default()));
        Some(cells)
    };
    Table {
        columns,
        rows: Variant::ALL.into_iter().filter_map(row).collect(),
        note: format!(
            "Δt c/h in one dimension, to {INCREMENT}: noise of 10⁻⁹ c on a lattice in a periodic line of {CELLS} cells, \
             velocities at most doubled in {STEPS} steps. Theory: spectral radius of the step on each wave of the line, \
             docs/methods/README.md. {policy}"
        ),
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    #[test]
    fn bisection_finds_the_last_stable_multiple() {
        assert!((largest(|courant| courant < 0.705) - 0.70).abs() < 1e-12);
        assert_eq!(largest(|_| false), 0.0);
    }

    #[test]
    fn run_and_theory_agree_on_a_method_of_each_kind() {
        use Variant::{Apic, Bspline2, Fmpm2, MpmMusl, MpmVp, Pic, TpmVpQuadratic, Xpic2};
        for variant in [Bspline2, MpmMusl, MpmVp, Pic, Apic, Xpic2, Fmpm2, TpmVpQuadratic] {
            let record = CourantLimit.execute(&spec(variant, 2), &Progress::silent());
            let value = |norm| record.rows.iter().find(|row| row.norm == norm).unwrap().value;
            let ratio = value("largest-stable") / value("theory");
            assert!((1.0 / AGREEMENT..=AGREEMENT).contains(&ratio), "{variant:?} {ratio}");
        }
    }
}
