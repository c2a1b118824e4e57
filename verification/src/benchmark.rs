//! A problem as a case: methods at several resolutions, with orders, figures and verdicts.
//!
//! One policy for all: points jittered by ±0.3 of their spacing; Δt a fixed share of the stable one at the start,
//! rounded down so that a whole number of steps ends at the end. Runs are told apart by the label `points` (per
//! cell) and by the label `courant`: `common` is the same number for all methods, `own` is nine tenths of the
//! largest with which the method ends the coarsest run with at most twice its error at the common one.

mod execute;
mod list;
mod own_courant;
mod results;
#[cfg(test)]
mod tests;
mod touches;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use transpoint::Variant;

use crate::case::{Case, Findings, RunSpec, Tier};
use crate::cases::free_surface;
use crate::cases::lattice::{JITTER, LAYOUTS};
use crate::convergence::{self, Order};
use crate::judge::{Check, Miss};
use crate::problems::{ErrorKind, Problem, Resolution};
use crate::progress::Progress;
use crate::record::RunRecord;
use crate::report::Artifact;
pub(crate) use execute::{Build, OF_THE_RUN, Runner, error_rows};
use list::SHOWN;
pub use list::{ALL, VARIANTS};

/// Courant number of the runs `common`.
pub const COURANT: f64 = free_surface::COURANT;
/// Share of its own largest stable Courant number that a method takes in the runs `own`.
pub const OWN_SHARE: f64 = 0.9;
/// Points per cell and axis.
pub const POINTS_PER_AXIS: [usize; 2] = [2, 3];
/// Seed of the jitter is this plus the cells.
const SEED: u64 = 20_201_100;

/// A problem of any dimension.
#[derive(Clone, Copy)]
pub enum AnyProblem {
    /// In one dimension.
    Line(&'static dyn Problem<1>),
    /// In two.
    Plane(&'static dyn Problem<2>),
}

/// Asks the problem, whatever its dimension.
macro_rules! ask {
    ($problem:expr, $inner:ident => $answer:expr) => {
        match $problem {
            AnyProblem::Line($inner) => $answer,
            AnyProblem::Plane($inner) => $answer,
        }
    };
}

/// How the time step of a run is chosen.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
pub enum Courant {
    /// The same number for all methods.
    Common,
    /// A share of the method's own largest stable number.
    Own,
}

impl Courant {
    /// As in labels.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Common => "common",
            Self::Own => "own",
        }
    }
}

/// Everything that a run depends on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
pub struct Parameters {
    /// Cells and points.
    pub resolution: Resolution,
    /// Choice of the time step.
    pub courant: Courant,
    /// Courant number of the runs `common`, share of the runs `own`.
    pub share: f64,
}

/// Jittered points at a number of cells.
pub(crate) fn resolution_of(cells: usize, points_per_axis: usize) -> Resolution {
    Resolution { cells, points_per_axis, jitter: JITTER, seed: SEED + cells as u64 }
}

/// The case of a problem.
pub struct Benchmark(pub AnyProblem);

impl Benchmark {
    /// Errors that are measured, the one that ranks first.
    pub fn errors(&self) -> &'static [ErrorKind] {
        ask!(self.0, problem => problem.errors())
    }

    /// Whether fluid ends within the grid.
    pub fn has_free_surface(&self) -> bool {
        ask!(self.0, problem => problem.has_free_surface())
    }

    /// Whether the fluid has a viscosity.
    pub fn is_viscous(&self) -> bool {
        let coarsest = self.resolution(0, POINTS_PER_AXIS[0]);
        ask!(self.0, problem => problem.set_up(&coarsest).scene.viscosity.is_some())
    }

    /// Whether a method runs here with its stress updated modified-last, by the policy of free surfaces.
    pub fn is_modified_last(&self, variant: Variant) -> bool {
        self.has_free_surface() && free_surface::is_modified_last(variant)
    }

    /// Orders to expect of the first error.
    pub fn expected_order(&self) -> Option<(f64, f64)> {
        ask!(self.0, problem => problem.expected_order())
    }

    /// Number of axes.
    pub fn dimension(&self) -> usize {
        match self.0 {
            AnyProblem::Line(_) => 1,
            AnyProblem::Plane(_) => 2,
        }
    }

    /// The resolution of a level.
    pub fn resolution(&self, level: usize, points_per_axis: usize) -> Resolution {
        resolution_of(ask!(self.0, problem => problem.levels()[level]), points_per_axis)
    }

    /// One run.
    pub fn spec(
        &self,
        variant: Variant,
        level: usize,
        points_per_axis: usize,
        courant: Courant,
    ) -> RunSpec {
        let resolution = self.resolution(level, points_per_axis);
        let share = match courant {
            Courant::Common => COURANT,
            Courant::Own => OWN_SHARE,
        };
        let parameters = Parameters { resolution, courant, share };
        RunSpec {
            case: self.name().to_owned(),
            variant: variant.name().to_owned(),
            layout: LAYOUTS[1].to_owned(),
            labels: BTreeMap::from([
                ("courant".to_owned(), courant.name().to_owned()),
                (
                    "points".to_owned(),
                    vec![points_per_axis.to_string(); self.dimension()].join("x"),
                ),
            ]),
            level,
            spacing: ask!(self.0, problem => problem.spacing(resolution.cells)),
            // Plain data of numbers and names always has a JSON form.
            parameters: serde_json::to_value(parameters).unwrap_or_default(),
        }
    }

    /// Every run of the study of speed against error.
    pub fn sweep(&self) -> Vec<RunSpec> {
        let mut runs = Vec::new();
        for variant in VARIANTS {
            for level in 0..self.levels() {
                for points in POINTS_PER_AXIS {
                    runs.push(self.spec(variant, level, points, Courant::Common));
                }
                runs.push(self.spec(variant, level, POINTS_PER_AXIS[0], Courant::Own));
            }
        }
        runs
    }

    /// Records of the plain study: two points per axis and the common Courant number.
    fn plain<'a>(&self, records: &'a [RunRecord]) -> impl Iterator<Item = &'a RunRecord> + use<'a> {
        let points = vec!["2"; self.dimension()].join("x");
        records.iter().filter(move |record| {
            record.spec.label("courant") == Courant::Common.name()
                && record.spec.label("points") == points
        })
    }
}

impl Case for Benchmark {
    fn name(&self) -> &'static str {
        ask!(self.0, problem => problem.name())
    }

    fn about(&self) -> &'static str {
        ask!(self.0, problem => problem.about())
    }

    fn variants(&self) -> Vec<&'static str> {
        VARIANTS.map(Variant::name).to_vec()
    }

    fn levels(&self) -> usize {
        ask!(self.0, problem => problem.levels().len())
    }

    fn policy(&self) -> String {
        let common = format!(
            "All variants: jitter ±{JITTER} of the point spacing, Pcg64 seeded with {SEED} + cells; \
             Δt = {COURANT} of the stable one."
        );
        if self.has_free_surface() {
            let text = free_surface::text("mpm-vp, gimp-vp, bspline2");
            format!(
                "{common} Free surface: {text} Here τ = {} h/c₀.",
                free_surface::INFLOW_RELAXATION
            )
        } else {
            format!("{common} FLIP share 1, stress updated last.")
        }
    }

    fn runs(&self, tier: Tier) -> Vec<RunSpec> {
        let plain = |variants: &[Variant], levels: usize| {
            let mut runs = Vec::new();
            for &variant in variants {
                for level in 0..levels {
                    runs.push(self.spec(variant, level, POINTS_PER_AXIS[0], Courant::Common));
                }
            }
            runs
        };
        match tier {
            Tier::Smoke => plain(&[Variant::Mpm, Variant::Apic, Variant::CellAdjoint], 2),
            Tier::Paper => plain(&SHOWN, 3),
            Tier::Full => self.sweep(),
        }
    }

    fn execute(&self, spec: &RunSpec, progress: &Progress) -> Findings {
        ask!(self.0, problem => execute::execute(problem, spec, progress))
    }

    fn checks(&self, records: &[RunRecord]) -> Vec<Check> {
        results::checks(self, &self.orders(records))
    }

    fn misses(&self) -> &'static [Miss] {
        results::misses(self.name())
    }

    fn orders(&self, records: &[RunRecord]) -> Vec<Order> {
        let mut orders = convergence::orders(self.plain(records));
        orders.retain(|order| order.norm != OF_THE_RUN && order.levels > 2);
        orders
    }

    fn artifacts(&self, records: &[RunRecord]) -> Vec<Artifact> {
        results::artifacts(self, records)
    }
}
