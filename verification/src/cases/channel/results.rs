//! From the records of this case to checks, figures and tables.

use super::{claims, figures, tables};
use crate::judge::{Check, Miss};
use crate::record::RunRecord;
use crate::report::{Area, Artifact, Content};

/// A check of every run that it applies to: quantity, norm and bounds.
struct Goal {
    quantity: &'static str,
    norm: &'static str,
    lower: Option<f64>,
    upper: Option<f64>,
    /// Whether a run is judged by it.
    applies: fn(&RunRecord) -> bool,
}

const fn goal(
    quantity: &'static str,
    norm: &'static str,
    lower: Option<f64>,
    upper: Option<f64>,
    applies: fn(&RunRecord) -> bool,
) -> Goal {
    Goal { quantity, norm, lower, upper, applies }
}

fn is_tpm(record: &RunRecord) -> bool {
    record.spec.variant.starts_with("tpm")
}

/// TPM on cells that resolve the inlet, with a free end and the policy's relaxation.
fn is_resolved_tpm(record: &RunRecord) -> bool {
    is_tpm(record) && record.spec.layout != "coarse" && is_plain(record)
}

/// A free end and the relaxation of the policy.
fn is_plain(record: &RunRecord) -> bool {
    ["columns", "flux"].contains(&record.spec.label("run"))
}

/// TPM with the inlet of the volume-of-fluid run.
fn is_beside_vof(record: &RunRecord) -> bool {
    is_resolved_tpm(record) && record.spec.layout == "100mm" && record.spec.label("v0") == "0.4"
}

/// The run that is long enough to become steady.
fn is_long(record: &RunRecord) -> bool {
    is_beside_vof(record) && record.spec.variant == "tpm-vp2" && record.spec.label("run") == "flux"
}

/// Points that carry the mass.
fn carries_mass(record: &RunRecord) -> bool {
    !is_tpm(record)
}

/// All but `apic`, whose run blows up: that is on record, and no goal.
fn is_stable(record: &RunRecord) -> bool {
    record.spec.variant != "apic"
}

/// The rival whose points carry the mass, long enough for 10,000 steps.
fn is_long_rival(record: &RunRecord) -> bool {
    carries_mass(record) && is_stable(record) && record.spec.layout == "100mm"
}

/// Set beforehand. What comes in under hydrostatic pressure has the head ½ v₀² + g h_in, which bounds the
/// energy per mass of what is in the channel.
const GOALS: [Goal; 16] = [
    goal("mass", "slope", Some(0.995), Some(1.005), is_resolved_tpm),
    goal("grid-mass", "slope", Some(0.995), Some(1.005), is_resolved_tpm),
    goal("mass", "deviation", None, Some(0.01), is_resolved_tpm),
    goal("grid-mass", "deviation", None, Some(0.01), is_resolved_tpm),
    goal("mass", "vof@2", Some(0.95), Some(1.05), is_beside_vof),
    goal("mass", "vof@3", Some(0.95), Some(1.05), is_beside_vof),
    goal("mass", "vof@4", Some(0.95), Some(1.05), is_beside_vof),
    goal("grid-mass", "vof@2", Some(0.95), Some(1.05), is_beside_vof),
    goal("grid-mass", "vof@3", Some(0.95), Some(1.05), is_beside_vof),
    goal("grid-mass", "vof@4", Some(0.95), Some(1.05), is_beside_vof),
    goal("steady", "variation", None, Some(0.01), is_long),
    goal("run", "steps", Some(10_000.0), None, is_long),
    goal("run", "steps", Some(10_000.0), None, is_long_rival),
    goal("ledger", "step", None, Some(1e-12), carries_mass),
    goal("energy", "over-head", None, Some(1.0), is_stable),
    goal("run", "unfinished", None, Some(0.0), is_stable),
];

const COLUMNS: &str = "`columns`: a cell of the second column waits for a new point until one has left, so that its nominal \
                       mass lags by up to half a cell (0.4 kg), while the sum over its samples does not; slope and \
                       deviation see the one or the other. `flux`, whose points come in one by one, meets the goals.";

const fn columns(variant: &'static str, layout: &'static str, check: &'static str) -> Miss {
    Miss { variant, layout, check, reason: COLUMNS }
}

/// Found: slopes of the mass on the nodes from 0.983 to 1.021, deviations of 0.0100 to 0.035.
pub(super) const MISSES: [Miss; 13] = [
    columns("tpm-vp2", "100mm", "columns-0.4-grid-mass-slope"),
    columns("tpm-vp2", "100mm", "columns-0.4-mass-deviation"),
    columns("tpm-vp2", "100mm", "columns-0.4-grid-mass-deviation"),
    columns("tpm-vp0", "100mm", "columns-0.4-grid-mass-slope"),
    columns("tpm-vp0", "100mm", "columns-0.4-mass-deviation"),
    columns("tpm-vp0", "100mm", "columns-0.4-grid-mass-deviation"),
    columns("tpm-vp2", "50mm", "columns-0.4-grid-mass-slope"),
    columns("tpm-vp2", "50mm", "columns-0.4-grid-mass-deviation"),
    columns("tpm-vp2", "100mm", "columns-0.2-grid-mass-slope"),
    columns("tpm-vp2", "100mm", "columns-0.2-mass-deviation"),
    columns("tpm-vp2", "100mm", "columns-0.2-grid-mass-deviation"),
    columns("tpm-vp2", "100mm", "columns-0.6-grid-mass-slope"),
    Miss {
        variant: "tpm-vp2",
        layout: "100mm",
        check: "flux-0.2-grid-mass-slope",
        reason: "`flux` at 0.2 m/s, mass on the nodes: 1.006 of ρ₀ v₀ h_in, of which 0.0012 is the compression of \
                 the water that comes in; the mass of the points is 1.0012.",
    },
];

/// The run of that method, layout, supply and speed.
pub(super) fn find<'a>(
    records: &'a [RunRecord],
    variant: &str,
    layout: &str,
    run: &str,
    speed: &str,
) -> Option<&'a RunRecord> {
    records.iter().find(|record| {
        let spec = &record.spec;
        (spec.variant == variant)
            && (spec.layout == layout)
            && (spec.label("run") == run)
            && (spec.label("v0") == speed)
    })
}

/// A measure of a run, not a number if it has none.
pub(super) fn value(record: &RunRecord, quantity: &str, norm: &str) -> f64 {
    record.row(quantity, norm).map_or(f64::NAN, |row| row.value)
}

/// All verdicts.
pub(super) fn checks(records: &[RunRecord]) -> Vec<Check> {
    let mut checks = Vec::new();
    for record in records {
        let spec = &record.spec;
        for goal in GOALS.iter().filter(|goal| (goal.applies)(record)) {
            let Goal { quantity, norm, lower, upper, .. } = *goal;
            let (run, speed) = (spec.label("run"), spec.label("v0"));
            checks.push(Check {
                case: spec.case.clone(),
                variant: spec.variant.clone(),
                layout: spec.layout.clone(),
                check: format!("{run}-{speed}-{quantity}-{norm}"),
                measured: value(record, quantity, norm),
                lower,
                upper,
                miss: None,
            });
        }
    }
    checks
}

/// Figures, tables and curves.
pub(super) fn artifacts(records: &[RunRecord], policy: &str) -> Vec<Artifact> {
    let artifact = |stem: &str, title: &str, content| Artifact {
        stem: stem.to_owned(),
        title: title.to_owned(),
        area: Area::Accuracy,
        content,
    };
    let figure = |stem, title, figure| artifact(stem, title, Content::Figure(figure));
    let table = |stem, title, table| artifact(stem, title, Content::Table(table));
    let mut artifacts = figures::pressures(records);
    artifacts.extend([
        figure("fig21a_channel", "Mass in the channel (Fig. 21a)", figures::masses(records)),
        figure("fig21b_channel", "Mass before it flows out (Fig. 21b)", figures::inflow(records)),
        figure("channel_surface", "Surface of the water", figures::surface(records)),
        figure("channel_energy", "Energy of the water", figures::energy(records)),
        table("channel_mass", "Measures of the mass", tables::mass(records, policy)),
        table(
            "channel_runs",
            "Front, steadiness, energy and balance",
            tables::runs(records, policy),
        ),
        table("channel_claims", "Claims of the paper on the channel", claims::table(records)),
    ]);
    artifacts
}
