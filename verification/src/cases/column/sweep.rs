//! All offsets of a run, one after another, and what is left of them: a curve over θ and its worst.

use std::collections::BTreeMap;
use std::time::Instant;

use transpoint::scene::PointSpec;
use transpoint::simulation::PointState;
use transpoint::variants::Blend;
use transpoint::{Scene, Settings, Simulation, Variant};

use super::scene::{SPACING, Setup};
use super::{Parameters, Study, hydrostatic, sudden_load};
use crate::case::{Findings, Outcome, Profile, Row};
use crate::cases::march::{counters, march, march_watching};
use crate::progress::Progress;

/// Norms over the offsets: largest absolute value, its 95th percentile, and θ where it is largest.
pub(super) const NORMS: [&str; 3] = ["max", "p95", "worst-theta"];
/// Further rows: offsets that blew up; least stable time step of the others over the one of full cells.
const FURTHER: [(&str, &str); 2] = [("blow-ups", "count"), ("time-step", "least-ratio")];
/// Profiles of the base pressure over ρgH, found and exact, at one offset.
pub(super) const HISTORY: [&str; 2] = ["base-history", "base-history-exact"];
/// Time in which a column comes to rest with PIC, H/c.
const SETTLING: f64 = 40.0;
/// One step in so many is kept in it.
const THINNING: usize = 4;

/// What a study measures at each offset.
pub(super) const fn quantities(study: Study) -> [&'static str; 3] {
    match study {
        Study::Hydrostatic | Study::Settled => hydrostatic::QUANTITIES,
        Study::SuddenLoad => sudden_load::QUANTITIES,
    }
}

/// θ of one offset of a sweep.
pub(super) fn theta(offset: usize, offsets: usize) -> f64 {
    (offset as f64 + 0.5) / offsets as f64
}

/// The rows of a run that has no values.
pub(super) fn missing_rows(study: Study) -> Vec<Row> {
    let of_study = quantities(study).into_iter();
    of_study
        .flat_map(|quantity| NORMS.map(|norm| Row::missing(quantity, norm)))
        .chain(FURTHER.map(|(quantity, norm)| Row::missing(quantity, norm)))
        .collect()
}

/// What one offset left behind.
struct Trial {
    outcome: Outcome,
    /// In the order of [`quantities`]; infinite after a blow-up.
    values: [f64; 3],
    /// Stable time step at the end over the one of full cells at rest; infinite after a blow-up.
    step_ratio: f64,
    /// Found and exact base pressure over ρgH of each step; empty but at one offset.
    history: Vec<[f64; 2]>,
}

/// Runs every offset.
pub(super) fn execute(variant: Variant, parameters: &Parameters, progress: &Progress) -> Findings {
    let mut findings = Findings {
        outcome: Outcome::Completed,
        rows: missing_rows(parameters.study),
        profiles: Vec::new(),
        rasters: Vec::new(),
        counters: BTreeMap::new(),
        seconds: 0.0,
    };
    let mut trials = Vec::new();
    for offset in 0..parameters.offsets {
        let setup = Setup::new(parameters, theta(offset, parameters.offsets));
        let mut scene = setup.scene(parameters);
        let start = Instant::now();
        let settling = match parameters.study {
            Study::Settled => settle(variant, &setup, parameters, &mut scene),
            Study::Hydrostatic | Study::SuddenLoad => Outcome::Completed,
        };
        let mut simulation = match variant.build_2d(&scene, &parameters.settings) {
            Ok(simulation) => simulation,
            Err(error) => return Findings::not_built(&error, findings.rows),
        };
        let mut trial = match settling {
            Outcome::Completed => trial(&setup, parameters, simulation.as_mut()),
            failed => Trial::lost(failed, Vec::new()),
        };
        findings.seconds += start.elapsed().as_secs_f64();
        for (name, count) in counters(simulation.as_ref()) {
            *findings.counters.entry(name).or_default() += count;
        }
        if offset == shown(parameters.offsets) {
            findings.profiles = histories(&setup, &trial.history);
        }
        trial.history = Vec::new();
        trials.push(trial);
        progress.advance(offset as u64 + 1, parameters.offsets as u64);
    }
    summarize(&mut findings, parameters, &trials);
    findings
}

impl Trial {
    /// An offset that blew up.
    fn lost(outcome: Outcome, history: Vec<[f64; 2]>) -> Self {
        Self { outcome, values: [f64::INFINITY; 3], step_ratio: f64::INFINITY, history }
    }
}

/// Lets a column come to rest with PIC; the scene becomes that state, at rest.
fn settle(
    variant: Variant,
    setup: &Setup,
    parameters: &Parameters,
    scene: &mut Scene<2>,
) -> Outcome {
    let settings = Settings { blend: Blend::PerStep(0.0), ..parameters.settings };
    let mut simulation = match variant.build_2d(scene, &settings) {
        Ok(simulation) => simulation,
        Err(error) => return Outcome::NotBuilt { reason: error.to_string() },
    };
    let steps = (SETTLING * setup.height / (setup.sound_speed * setup.dt)).ceil() as u64;
    let progress = Progress::silent();
    let outcome = march(simulation.as_mut(), setup.dt, 0..steps, (&progress, steps));
    if outcome == Outcome::Completed {
        let at_rest = |p: &PointState<2>| PointSpec::new(p.position, [0.0; 2], p.density, p.mass);
        scene.points = simulation.observe().points.iter().map(at_rest).collect();
    }
    outcome
}

/// Steps one column and measures on the way.
fn trial(setup: &Setup, parameters: &Parameters, simulation: &mut dyn Simulation<2>) -> Trial {
    let silent = Progress::silent();
    let (mut rest, mut load) = (hydrostatic::Watch::default(), sudden_load::Watch::default());
    let (mut done, steps) = (0, setup.steps);
    let mut outcome = march_watching(simulation, setup.dt, 0..steps, (&silent, steps), |state| {
        done += 1;
        match parameters.study {
            Study::Hydrostatic | Study::Settled if done % hydrostatic::STRIDE == 0 => {
                rest.see(setup, &state.observe());
            }
            Study::Hydrostatic | Study::Settled => (),
            Study::SuddenLoad => load.see(setup, &state.observe()),
        }
    });
    if outcome == Outcome::Completed && rest.is_lost() {
        let reason = "a point was faster than √(gH)".to_owned();
        outcome = Outcome::BlownUp { step: steps, time: simulation.time(), reason };
    }
    if outcome != Outcome::Completed {
        return Trial::lost(outcome, load.history);
    }
    let values = match parameters.study {
        Study::Hydrostatic | Study::Settled => rest.largest,
        Study::SuddenLoad => load.values(setup.height / SPACING),
    };
    let step_ratio =
        simulation.stable_dt(parameters.courant).dt / setup.stable_step(parameters.courant);
    Trial { outcome, values, step_ratio, history: load.history }
}

/// The offset whose history is shown: a row of points has just come up into the next cell.
pub(super) fn shown(offsets: usize) -> usize {
    offsets / 4
}

/// Found and exact base pressure over ρgH against ct/H.
fn histories(setup: &Setup, history: &[[f64; 2]]) -> Vec<Profile> {
    if history.is_empty() {
        return Vec::new();
    }
    let profile = |which: usize| {
        let pairs = history.iter().enumerate().step_by(THINNING).map(|(k, values)| {
            let time = (k as f64 + 1.5) * setup.dt;
            (time * setup.sound_speed / setup.height, values[which])
        });
        Profile::new(HISTORY[which], pairs)
    };
    vec![profile(0), profile(1)]
}

/// Rows, profiles and the outcome of all offsets.
fn summarize(findings: &mut Findings, parameters: &Parameters, trials: &[Trial]) {
    let quantities = quantities(parameters.study);
    let at = |offset| theta(offset, parameters.offsets);
    let blown: Vec<usize> =
        (0..trials.len()).filter(|&k| trials[k].outcome != Outcome::Completed).collect();
    let mut values = Vec::new();
    for (which, quantity) in quantities.into_iter().enumerate() {
        let of_quantity: Vec<f64> = trials.iter().map(|trial| trial.values[which]).collect();
        let found = worst(&of_quantity).map(|(max, p95, offset)| [max, p95, at(offset)]);
        values.extend(found.unwrap_or([f64::NAN; 3]));
        let pairs = of_quantity.iter().enumerate().map(|(offset, &value)| (at(offset), value));
        findings.profiles.push(Profile::new(quantity, pairs));
    }
    values.push(blown.len() as f64);
    values.push(trials.iter().map(|trial| trial.step_ratio).fold(f64::INFINITY, f64::min));
    for (row, value) in findings.rows.iter_mut().zip(values) {
        (row.value, row.scale) = (if value.is_finite() { value } else { f64::NAN }, 1.0);
    }
    if let Some(&first) = blown.first()
        && let Outcome::BlownUp { step, time, reason } = &trials[first].outcome
    {
        let (count, total, theta) = (blown.len(), trials.len(), at(first));
        let reason = format!("{count} of {total} offsets, first θ = {theta}: {reason}");
        findings.outcome = Outcome::BlownUp { step: *step, time: *time, reason };
    }
}

/// In the order of [`NORMS`], the last as the index of an offset.
pub(super) fn worst(values: &[f64]) -> Option<(f64, f64, usize)> {
    let size = |value: f64| if value.is_nan() { f64::INFINITY } else { value.abs() };
    let mut ranked: Vec<(f64, usize)> =
        values.iter().enumerate().map(|(offset, &value)| (size(value), offset)).collect();
    // Of equals the first offset comes last.
    ranked.sort_by(|a, b| a.0.total_cmp(&b.0).then(b.1.cmp(&a.1)));
    let &(largest, offset) = ranked.last()?;
    let rank = (0.95 * values.len() as f64).ceil() as usize;
    Some((largest, ranked[rank - 1].0, offset))
}
