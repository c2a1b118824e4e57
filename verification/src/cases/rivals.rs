//! Case `rivals`: every variant of the library on four small scenes, under one policy, beside what it is made of.
//!
//! The scenes are those of other cases at a small size, with their measures; a layout names the scene:
//!
//! ```text
//! sine-wave   standing wave on cells of 20 and 10 mm (levels 0 and 1), jittered points, at T/4
//! riemann     pressure jump on cells of 2 mm, jittered points, with bulk viscosity
//! dam-break   column of water on cells of 40 mm, 2 x 2 points each, up to T = 2
//! courant     noise in a periodic box, jittered points that stay in place: the largest stable Courant number,
//!             to 0.1, by bisection with 1000 steps each; in the full tier also with 1 and 3 points per axis, on a
//!             lattice and displaced further
//! channel     inflow into an empty channel on cells of 50 mm, points supplied by the flux, up to 2 s
//! ```
//!
//! In `dam-break` and `channel`, fields that are carried go with the stress updated modified-last and reconstructed ones with
//! the stress updated last, and where points carry no mass of their own, fractures of the channel are filled, as in
//! those cases. What a variant fixes comes before that. A variant that cannot run a scene is refused with a reason,
//! which is a result as a burst is.

mod courant;
mod results;
mod stability;
#[cfg(test)]
mod tests;

use transpoint::Variant;

use super::channel::Channel;
use super::dam_break::DamBreak;
use super::riemann::Riemann;
use super::sine_wave::SineWave;
use super::{channel, dam_break, riemann, sine_wave};
use crate::case::{Case, Findings, RunSpec, Tier};
use crate::convergence::{self, Order};
use crate::judge::Check;
use crate::progress::Progress;
use crate::record::RunRecord;
use crate::report::Artifact;

/// A scene with the case that runs it.
#[derive(Clone, Copy)]
struct Scene {
    name: &'static str,
    case: &'static dyn Case,
    levels: usize,
    spec: fn(Variant, usize) -> RunSpec,
}

/// The layout of the runs that look for the largest stable Courant number.
const COURANT: &str = "courant";

/// Every scene, in the order of the matrix.
static SCENES: [Scene; 4] = [
    Scene { name: "sine-wave", case: &SineWave, levels: 2, spec: sine_wave::rival },
    Scene {
        name: "riemann",
        case: &Riemann,
        levels: 1,
        spec: |variant, _| riemann::rival(variant),
    },
    Scene {
        name: "dam-break",
        case: &DamBreak,
        levels: 1,
        spec: |variant, _| dam_break::rival(variant),
    },
    Scene {
        name: "channel",
        case: &Channel,
        levels: 1,
        spec: |variant, _| channel::rival(variant),
    },
];

/// The settings that a variant fixes, by name.
pub fn fixed(variant: Variant) -> Vec<(String, serde_json::Value)> {
    results::fixed(variant)
}

/// The case `rivals`.
#[derive(Clone, Copy, Debug)]
pub struct Rivals;

impl Case for Rivals {
    fn name(&self) -> &'static str {
        "rivals"
    }

    fn about(&self) -> &'static str {
        "every variant on four small scenes: what it is made of, whether it runs, and how far off it is"
    }

    fn variants(&self) -> Vec<&'static str> {
        Variant::ALL.map(Variant::name).to_vec()
    }

    fn levels(&self) -> usize {
        2
    }

    fn policy(&self) -> String {
        "All variants: the policies of the cases `sine-wave`, `riemann` (with bulk viscosity), `dam-break` and \
         `channel`, with what the variant fixes."
            .to_owned()
    }

    fn runs(&self, tier: Tier) -> Vec<RunSpec> {
        let mut runs = Vec::new();
        for scene in &SCENES {
            for variant in Variant::ALL {
                runs.extend((0..scene.levels).map(|level| RunSpec {
                    case: "rivals".to_owned(),
                    variant: variant.name().to_owned(),
                    layout: scene.name.to_owned(),
                    level,
                    ..(scene.spec)(variant, level)
                }));
            }
        }
        runs.extend(Variant::ALL.map(courant::spec));
        if tier == Tier::Full {
            runs.extend(Variant::ALL.into_iter().flat_map(courant::map));
        }
        runs
    }

    fn execute(&self, spec: &RunSpec, progress: &Progress) -> Findings {
        if spec.layout == COURANT {
            return courant::execute(spec, progress);
        }
        match SCENES.iter().find(|scene| scene.name == spec.layout) {
            Some(scene) => scene.case.execute(spec, progress),
            None => Findings::not_built(&format!("no scene {}", spec.layout), Vec::new()),
        }
    }

    fn checks(&self, records: &[RunRecord]) -> Vec<Check> {
        results::checks(records)
    }

    fn orders(&self, records: &[RunRecord]) -> Vec<Order> {
        convergence::orders(results::waves(records))
    }

    fn artifacts(&self, records: &[RunRecord]) -> Vec<Artifact> {
        results::artifacts(records, &self.policy())
    }
}
