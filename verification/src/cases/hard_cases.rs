//! Case `hard-cases`: what is known to break particle methods on a grid, and which variant breaks where.
//!
//! Sixteen hard cases, each with a criterion that was set before its first run; every variant of the library runs
//! all of them. A hard case has a file below `hard_cases/`, where its set-up, its criterion and its reasons stand,
//! and a paragraph in `docs/hard-cases.md`. The layout of a record is the name of its run, that of the hard case,
//! but for `vortex`, by which `fracture`, `clumping` and `null-space` are judged.
//!
//! One policy for all: closed scenes with `Settings::default()`, scenes with a free surface with that of
//! [`free_surface`], carried fields then with the stress updated modified-last; what a variant
//! fixes comes before that. Rearrangement is on in `vortex` and `ledger` alone. A run that bursts is a result.
//!
//! Two long runs of flows with a free surface stand beside hard case 4 in a table of their own, `long_runs.rs`.
//!
//! A hard case that a method fails is data and fails no check. What is checked is that the verdicts are those on
//! record in `hard_cases/verdicts.csv`, a snapshot. The artifact `hard_cases_verdicts` of the full tier has the same
//! form: where a verdict is meant to change, copy it there.

mod cell_crossing;
mod checkerboard;
mod frozen_spectrum;
mod impact;
mod ledger;
mod list;
mod locking;
mod long_runs;
mod long_table;
mod mach_courant;
mod results;
mod single_points;
mod slender_cells;
mod small_cut;
mod tension;
#[cfg(test)]
mod tests;
mod trial;
mod verdict;
mod vortex;
mod waves;

use std::collections::BTreeMap;
use std::time::Instant;

use transpoint::{Settings, Variant};

use super::free_surface::{self, INFLOW_RELAXATION};
use crate::case::{Case, Findings, Outcome, Row, RunSpec, Tier};
use crate::convergence::Order;
use crate::judge::Check;
use crate::progress::Progress;
use crate::record::RunRecord;
use crate::report::Artifact;
use list::{RUNS, Run};
use trial::{Measured, Trial};

/// Name of the case.
const NAME: &str = "hard-cases";
/// Norm of all rows.
const NORM: &str = "measure";
/// The variants of the smaller tiers.
const FEW: [Variant; 5] =
    [Variant::Mpm, Variant::Bspline2, Variant::Apic, Variant::TpmVpQuadratic, Variant::CellAdjoint];

/// The case `hard-cases`.
#[derive(Clone, Copy, Debug)]
pub struct HardCases;

impl Case for HardCases {
    fn name(&self) -> &'static str {
        NAME
    }

    fn about(&self) -> &'static str {
        "sixteen hard cases, every variant: what is known to break particle methods on a grid"
    }

    fn variants(&self) -> Vec<&'static str> {
        Variant::ALL.map(Variant::name).to_vec()
    }

    fn levels(&self) -> usize {
        1
    }

    fn policy(&self) -> String {
        format!(
            "Closed scenes: {:?}. Free surfaces: {} Relaxation {INFLOW_RELAXATION} h/c₀ in `tension` and in the long \
             runs. What a variant fixes comes before that.",
            Settings::default(),
            free_surface::text("carried fields")
        )
    }

    fn runs(&self, tier: Tier) -> Vec<RunSpec> {
        let variants = if tier == Tier::Full { &Variant::ALL[..] } else { &FEW[..] };
        let of = |variant: Variant| {
            RUNS.iter().filter(move |run| run.tier <= tier).map(move |run| spec(run, variant))
        };
        variants.iter().copied().flat_map(of).collect()
    }

    fn execute(&self, spec: &RunSpec, _progress: &Progress) -> Findings {
        let Some(run) = RUNS.iter().find(|run| run.name == spec.layout) else {
            return Findings::not_built(&format!("no hard case {}", spec.layout), Vec::new());
        };
        match Variant::parse(&spec.variant) {
            Ok(variant) => {
                let start = Instant::now();
                let measured = (run.execute)(&Trial { variant, builder: &variant });
                findings(run, measured, start.elapsed().as_secs_f64())
            }
            Err(error) => Findings::not_built(&error, rows(run, None)),
        }
    }

    fn checks(&self, records: &[RunRecord]) -> Vec<Check> {
        results::checks(records)
    }

    fn orders(&self, _records: &[RunRecord]) -> Vec<Order> {
        Vec::new()
    }

    fn artifacts(&self, records: &[RunRecord]) -> Vec<Artifact> {
        results::artifacts(records, &self.policy())
    }
}

fn spec(run: &Run, variant: Variant) -> RunSpec {
    RunSpec {
        case: NAME.to_owned(),
        variant: variant.name().to_owned(),
        layout: run.name.to_owned(),
        labels: BTreeMap::new(),
        level: 0,
        spacing: run.spacing,
        // All else is constant, and part of the program.
        parameters: serde_json::Value::Null,
    }
}

/// The rows of a run, without values where there are none.
fn rows(run: &Run, values: Option<&[f64]>) -> Vec<Row> {
    let row = |(k, quantity): (usize, &&str)| {
        let value = values.and_then(|values| values.get(k)).copied().unwrap_or(f64::NAN);
        Row { value, scale: 1.0, ..Row::missing(*quantity, NORM) }
    };
    run.quantities.iter().enumerate().map(row).collect()
}

fn findings(run: &Run, measured: Measured, seconds: f64) -> Findings {
    let (outcome, rows) = match measured {
        Ok(values) => (Outcome::Completed, rows(run, Some(&values))),
        Err(outcome) => (outcome, rows(run, None)),
    };
    Findings {
        outcome,
        rows,
        profiles: Vec::new(),
        rasters: Vec::new(),
        counters: BTreeMap::new(),
        seconds,
    }
}
