//! Case `sine-wave`: a standing acoustic wave in a closed box, §4.1 and Fig. 9 of \[Song2020\].
//!
//! Water at rest density fills 0 ≤ x ≤ 1 m between slip walls and starts with
//! v(x) = (2πA/T) sin(2πx/L) and p = 0. Errors of pressure and velocity are taken at two instants:
//! `5us` is the paper's (10 steps of 5·10⁻⁷ s, A = 1 mm), `T/4` is a quarter of a period
//! (1000 steps of 5·10⁻⁶ s, A = 1 µm). Quantities are named `quantity@instant`.
//!
//! The points are a lattice of 2 per cell and axis (`regular`), or the same displaced by up to 0.3
//! of their spacing (`jittered`): on an undisturbed lattice every method looks alike.
//!
//! The study `isotropy` repeats the coarsest run along y, and a coarse 3D run along z: the errors
//! must be those of the run along x.

mod results;
mod scene;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use transpoint::{Settings, Variant};

use super::lattice::{self, JITTER, LAYOUTS};
use crate::case::{Case, Findings, RunSpec, Tier};
use crate::convergence::{self, Order};
use crate::judge::Check;
use crate::progress::Progress;
use crate::record::RunRecord;
use crate::report::Artifact;

/// Cell sizes of Fig. 9, coarsest first, m.
const SPACINGS: [f64; 5] = [0.02, 0.01, 0.008, 0.005, 0.004];
/// Cell size of the runs in 3D, m.
const SPACING_3D: f64 = 0.05;
/// Seed of the jitter is this plus the level.
const SEED: u64 = 20_200_904;

/// One of the two instants of measurement.
#[derive(Clone, Copy, Debug, PartialEq)]
struct Instant {
    name: &'static str,
    amplitude: f64,
    dt: f64,
    steps: u64,
}

const INSTANTS: [Instant; 2] = [
    Instant { name: "5us", amplitude: 1e-3, dt: 5e-7, steps: 10 },
    Instant { name: "T/4", amplitude: 1e-6, dt: 5e-6, steps: 1000 },
];

/// Everything that a run of this case depends on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// 2 or 3.
    dimension: usize,
    /// Axis along which the wave stands.
    axis: usize,
    /// Cell size, m.
    spacing: f64,
    /// Cells across the wave, per axis.
    width_cells: usize,
    /// Amplitude A of the displacement, m.
    amplitude: f64,
    /// Time step, s.
    dt: f64,
    /// Steps.
    steps: u64,
    /// Largest displacement of a point, point spacings.
    jitter: f64,
    /// Seed of the displacements.
    seed: u64,
    /// Settings of the solver.
    settings: Settings,
}

/// The case `sine-wave`.
#[derive(Clone, Copy, Debug)]
pub struct SineWave;

impl Case for SineWave {
    fn name(&self) -> &'static str {
        "sine-wave"
    }

    fn about(&self) -> &'static str {
        "standing acoustic wave in a closed box, orders of convergence (Fig. 9 of [Song2020])"
    }

    fn levels(&self) -> usize {
        SPACINGS.len()
    }

    fn policy(&self) -> String {
        format!(
            "All variants: {:?}. 2 points per cell and axis; jitter ±{JITTER} of the point \
             spacing, Pcg64 seeded with {SEED} + level.",
            Settings::default()
        )
    }

    fn runs(&self, tier: Tier) -> Vec<RunSpec> {
        let instants = match tier {
            Tier::Smoke => &INSTANTS[..1],
            Tier::Paper | Tier::Full => &INSTANTS[..],
        };
        let mut runs = Vec::new();
        for variant in Variant::CORE {
            for layout in LAYOUTS {
                for &instant in instants {
                    for level in 0..SPACINGS.len() {
                        runs.push(spec(variant, layout, instant, level, 2, 0));
                    }
                }
                let first = INSTANTS[0];
                runs.push(spec(variant, layout, first, 0, 2, 1));
                runs.push(spec(variant, layout, first, 0, 3, 0));
                runs.push(spec(variant, layout, first, 0, 3, 2));
            }
        }
        runs
    }

    fn execute(&self, spec: &RunSpec, progress: &Progress) -> Findings {
        let rows = scene::missing_rows(spec.label("instant"));
        let variant = match Variant::parse(&spec.variant) {
            Ok(variant) => variant,
            Err(error) => return Findings::not_built(&error, rows),
        };
        let parameters = match serde_json::from_value::<Parameters>(spec.parameters.clone()) {
            Ok(parameters) => parameters,
            Err(error) => return Findings::not_built(&error, rows),
        };
        let settings = &parameters.settings;
        let run = scene::Run { parameters: &parameters, instant: spec.label("instant"), progress };
        match parameters.dimension {
            2 => run.execute::<2>(|scene| variant.build_2d(scene, settings)),
            3 => run.execute::<3>(|scene| variant.build_3d(scene, settings)),
            other => Findings::not_built(&format!("dimension {other}"), rows),
        }
    }

    fn checks(&self, records: &[RunRecord]) -> Vec<Check> {
        results::checks(records, &self.orders(records))
    }

    fn orders(&self, records: &[RunRecord]) -> Vec<Order> {
        convergence::orders(results::of_study(records, "convergence"))
    }

    fn artifacts(&self, records: &[RunRecord]) -> Vec<Artifact> {
        results::artifacts(records, &self.policy())
    }
}

/// The run of a variant in the case `rivals`.
pub(super) fn rival(variant: Variant, level: usize) -> RunSpec {
    spec(variant, LAYOUTS[1], INSTANTS[1], level, 2, 0)
}

fn spec(
    variant: Variant,
    layout: &str,
    instant: Instant,
    level: usize,
    dimension: usize,
    axis: usize,
) -> RunSpec {
    let spacing = if dimension == 3 { SPACING_3D } else { SPACINGS[level] };
    // The width of 0.1 m is rounded to whole cells; areas are scaled back.
    let width_cells = ((0.1 / spacing).round() as usize).max(1);
    let parameters = Parameters {
        dimension,
        axis,
        spacing,
        width_cells,
        amplitude: instant.amplitude,
        dt: instant.dt,
        steps: instant.steps,
        jitter: lattice::jitter(layout),
        seed: SEED + level as u64,
        settings: Settings::default(),
    };
    let study = if (dimension, axis) == (2, 0) { "convergence" } else { "isotropy" };
    let labels = BTreeMap::from([
        ("axis".to_owned(), ["x", "y", "z"][axis].to_owned()),
        ("dimension".to_owned(), format!("{dimension}d")),
        ("instant".to_owned(), instant.name.to_owned()),
        ("study".to_owned(), study.to_owned()),
    ]);
    RunSpec {
        case: "sine-wave".to_owned(),
        variant: variant.name().to_owned(),
        layout: layout.to_owned(),
        labels,
        level,
        spacing,
        // Plain data of numbers and names always has a JSON form.
        parameters: serde_json::to_value(parameters).unwrap_or_default(),
    }
}
