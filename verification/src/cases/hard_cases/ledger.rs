//! Hard case 16, `ledger`: what rearrangement does to mass, momentum and energy.
//!
//! Points that are put in, split or pushed about are a repair, and a repair must not make what it repairs. The dam
//! break of case `dam-break`, coarse as there: one point per cell, of 60 mm, to T = 2.5, with fractures filled with
//! mass of the neighbours where points carry no mass of their own, else with what the variant fixes. A variant that
//! rearranges nothing is not judged. The number of events stands beside: where there is none the rest is empty, and
//! the case is failed.

use transpoint::Simulation;
use transpoint::rearrangement::Totals;

use super::list::{Goal, HardCase, Run};
use super::trial::{Measured, Trial, march_until, refused};
use super::vortex::filled;
use crate::case::Tier;
use crate::cases::dam_break::{SOUND_SPEED, scaled_time, tank};
use crate::cases::free_surface::RELAXATION;

/// Cell size, m.
const SPACING: f64 = 0.06;
/// T at the end.
const END: f64 = 2.5;
/// Energy that events may add, over the kinetic one at its largest: round-off of a sum of some thousands.
const ROUND_OFF: f64 = 1e-12;

/// The run.
pub(super) const RUN: Run = Run {
    name: "ledger",
    spacing: SPACING,
    tier: Tier::Paper,
    quantities: &["energy-change", "mass-created", "mass-balance", "events", "momentum-jump"],
    execute,
};

/// The hard case.
pub(super) const CASE: HardCase = HardCase {
    name: "ledger",
    run: RUN.name,
    criterion: "dam break with rearrangement: events make less than 10⁻⁴ of the mass and no energy; mass is that of the \
                start and of the ledger to 10⁻¹²",
    goals: &[
        Goal::below("energy-change", ROUND_OFF),
        Goal::below("mass-created", 1e-4),
        Goal::below("mass-balance", 1e-12),
        Goal::above("events", 1.0),
    ],
};

/// Kinetic, potential and compression energy, J.
fn energy(totals: &Totals<2>) -> f64 {
    totals.conserved.kinetic_energy + totals.potential_energy + totals.compression_energy
}

fn execute(trial: &Trial<'_>) -> Measured {
    let settings = filled(trial, trial.surface(1, SPACING, SOUND_SPEED, RELAXATION));
    if trial.variant.settings(&settings).rearrangement.is_none() {
        return Err(refused(&"nothing is rearranged: fills need points without mass of their own"));
    }
    let mut simulation = trial.plane(&tank(SPACING, 1), &settings)?;
    let start = simulation.conserved().mass;
    let (mut kinetic, mut momentum) = (0.0_f64, 0.0_f64);
    march_until(simulation.as_mut(), END / scaled_time(1.0), |state: &dyn Simulation<2>| {
        let totals = state.conserved();
        kinetic = kinetic.max(totals.kinetic_energy);
        momentum = momentum.max(totals.momentum[0].hypot(totals.momentum[1]));
    })?;
    let ledger = simulation.ledger();
    let (mut sum, mut created) = (Totals::zero(), 0.0);
    for event in ledger.events() {
        let change = event.change();
        created += change.conserved.mass.abs();
        sum = sum.plus(1.0, &change);
    }
    let expected =
        start + sum.conserved.mass + ledger.entered().conserved.mass - ledger.left().conserved.mass;
    let [px, py] = sum.conserved.momentum;
    Ok(vec![
        energy(&sum) / kinetic,
        created / start,
        (simulation.conserved().mass - expected).abs() / start,
        ledger.events().len() as f64,
        px.hypot(py) / momentum,
    ])
}
