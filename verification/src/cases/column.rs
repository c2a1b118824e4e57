//! Case `column`: a column of liquid whose surface lies anywhere in a cell.
//!
//! A column 4 cells wide, periodic along x, of the height H = (n + θ) h stands on a slip floor under gravity.
//! Its top is free. θ runs through (0, 1) in equal steps. Points lie on a lattice of spacing h/2 whose top
//! row ends at H; the row at the floor is as thick as what is left, h/4 to 3h/4, and every point has the
//! exact mass of its row. Label `study`:
//!
//! - `hydrostatic`: the start is the isothermal equilibrium, so that nothing should move. Largest
//!   |v|/√(gH), and errors of the pressure over ρgH, over 20 H/c.
//! - `settled`: the same from the method's own equilibrium, which is where the column stands after 40 H/c with
//!   PIC, at rest.
//! - `sudden-load`: gravity acts from t = 0 on a column without pressure, \[MorseIngard1968\]. The pressure
//!   at the base is a triangle wave of period 4H/c; its error over five periods, the height that its
//!   period stands for, and its damping.
//!
//! Label `volume`: the rule for the points of boundary cells, for methods that have one. A run is a sweep
//! over θ. An offset that blows up is counted and counts as infinite in every maximum; so is one at which a
//! point of the column at rest reaches √(gH).

mod hydrostatic;
mod results;
mod scene;
mod sudden_load;
mod sweep;
#[cfg(test)]
mod tests;

use std::collections::BTreeMap;

use serde::{Deserialize, Serialize};
use transpoint::{Settings, Variant, variants::PointVolume};

use crate::case::{Case, Findings, RunSpec, Tier};
use crate::convergence::Order;
use crate::judge::Check;
use crate::progress::Progress;
use crate::record::RunRecord;
use crate::report::Artifact;

/// Full cells n along the height.
const CELLS: usize = 6;
/// Courant number of the acoustic limit of full cells.
const COURANT: f64 = 0.3;
/// Offsets θ of a sweep in the paper tier, by study.
const OFFSETS: [(Study, usize); 3] =
    [(Study::Hydrostatic, 100), (Study::Settled, 100), (Study::SuddenLoad, 20)];
/// Offsets in the smoke tier.
const SMOKE_OFFSETS: usize = 3;
/// Duration, H/c: the periods of the wave.
const DURATION: f64 = 4.0 * sudden_load::PERIODS as f64;

/// Methods whose samples depend on where the surface lies; in a column `tpm-vp0` is `tpm`.
const WITH_VOLUMES: [Variant; 3] = [Variant::Tpm, Variant::TpmVp, Variant::TpmVpQuadratic];
/// Methods whose points carry their volume.
const CARRIED: [Variant; 4] = [Variant::Mpm, Variant::MpmVp, Variant::Gimp, Variant::Apic];
/// Rules for the points of boundary cells by name.
const VOLUMES: [(&str, PointVolume); 6] = [
    ("sphere", PointVolume::Sphere),
    ("carried-capped", PointVolume::CarriedCapped),
    ("volume-fraction", PointVolume::VolumeFraction),
    ("cell-center", PointVolume::CellCenter),
    ("plane", PointVolume::Plane),
    ("balanced", PointVolume::Balanced),
];
/// Name in place of a rule for methods without.
const NO_VOLUME: &str = "carried";

/// What happens to the column.
#[derive(Clone, Copy, Debug, PartialEq, Eq, Serialize, Deserialize)]
#[serde(rename_all = "kebab-case")]
enum Study {
    /// It starts in equilibrium.
    Hydrostatic,
    /// It starts in the equilibrium of the method.
    Settled,
    /// It starts without pressure.
    SuddenLoad,
}

impl Study {
    const fn name(self) -> &'static str {
        match self {
            Self::Hydrostatic => "hydrostatic",
            Self::Settled => "settled",
            Self::SuddenLoad => "sudden-load",
        }
    }
}

/// Everything that a run of this case depends on.
#[derive(Clone, Copy, Debug, PartialEq, Serialize, Deserialize)]
#[serde(deny_unknown_fields)]
struct Parameters {
    /// What happens.
    study: Study,
    /// Full cells n along the height.
    cells: usize,
    /// Number of offsets θ.
    offsets: usize,
    /// Courant number.
    courant: f64,
    /// Duration, H/c.
    duration: f64,
    /// Settings of the solver.
    settings: Settings,
}

/// The case `column`.
#[derive(Clone, Copy, Debug)]
pub struct Column;

impl Case for Column {
    fn name(&self) -> &'static str {
        "column"
    }

    fn about(&self) -> &'static str {
        "column at rest and suddenly loaded, surface at every height in a cell [MorseIngard1968]"
    }

    fn variants(&self) -> Vec<&'static str> {
        let mut variants: Vec<Variant> = WITH_VOLUMES.into_iter().chain(CARRIED).collect();
        variants.sort_by_key(|variant| Variant::ALL.iter().position(|other| other == variant));
        variants.into_iter().map(Variant::name).collect()
    }

    fn levels(&self) -> usize {
        1
    }

    fn policy(&self) -> String {
        format!(
            "All variants: {:?}, but for the rule of the column `volume`. Courant number {COURANT} of \
             full cells; H = ({CELLS} + θ) h; 2 points per cell and axis.",
            Settings::default()
        )
    }

    fn runs(&self, tier: Tier) -> Vec<RunSpec> {
        let mut runs = Vec::new();
        for (study, offsets) in OFFSETS {
            let offsets = if tier == Tier::Smoke { SMOKE_OFFSETS } else { offsets };
            let mut add = |variant, volume, settings| {
                let parameters = Parameters {
                    study,
                    cells: CELLS,
                    offsets,
                    courant: COURANT,
                    duration: DURATION,
                    settings,
                };
                runs.push(spec(variant, volume, &parameters));
            };
            for (volume, point_volume) in VOLUMES {
                let settings = Settings { point_volume, ..Settings::default() };
                for variant in WITH_VOLUMES {
                    add(variant, volume, settings);
                }
            }
            for variant in CARRIED {
                add(variant, NO_VOLUME, Settings::default());
            }
        }
        runs
    }

    fn execute(&self, spec: &RunSpec, progress: &Progress) -> Findings {
        let parameters = match serde_json::from_value::<Parameters>(spec.parameters.clone()) {
            Ok(parameters) => parameters,
            Err(error) => return Findings::not_built(&error, Vec::new()),
        };
        match Variant::parse(&spec.variant) {
            Ok(variant) => sweep::execute(variant, &parameters, progress),
            Err(error) => Findings::not_built(&error, sweep::missing_rows(parameters.study)),
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

/// A column at rest of n = `cells` full cells and θ of another, its height in m and its speed of sound in m/s.
pub(super) fn at_rest(cells: usize, theta: f64) -> (transpoint::Scene<2>, f64, f64) {
    let parameters = Parameters {
        study: Study::Hydrostatic,
        cells,
        offsets: 1,
        courant: COURANT,
        duration: DURATION,
        settings: Settings::default(),
    };
    let setup = scene::Setup::new(&parameters, theta);
    (setup.scene(&parameters), setup.height, setup.sound_speed)
}

fn spec(variant: Variant, volume: &str, parameters: &Parameters) -> RunSpec {
    let labels = [("study", parameters.study.name()), ("volume", volume)];
    RunSpec {
        case: "column".to_owned(),
        variant: variant.name().to_owned(),
        layout: "regular".to_owned(),
        labels: BTreeMap::from(labels.map(|(name, value)| (name.to_owned(), value.to_owned()))),
        level: 0,
        spacing: scene::SPACING,
        // Plain data of numbers and names always has a JSON form.
        parameters: serde_json::to_value(parameters).unwrap_or_default(),
    }
}
