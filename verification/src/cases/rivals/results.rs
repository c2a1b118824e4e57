//! The matrix of variants and scenes.

use transpoint::formulation::Formulation;
use transpoint::variants::{Kernel, Parts};
use transpoint::{Settings, Variant};

use super::stability::{bound, stability};
use super::{SCENES, courant};
use crate::case::Outcome;
use crate::cases::errors::artifact;
use crate::judge::Check;
use crate::record::RunRecord;
use crate::report::table::{Cell, Table};
use crate::report::{Artifact, Content};

/// What a scene asks of a variant, the same of all, set before the first run: quantity and norm of the number, and
/// the range in which it counts as met.
struct Goal {
    scene: &'static str,
    quantity: &'static str,
    norm: &'static str,
    relative: bool,
    range: (f64, f64),
    meaning: &'static str,
    /// The variant that has to meet it.
    best: Variant,
}

const GOALS: [Goal; 4] = [
    Goal {
        scene: "sine-wave",
        quantity: "pressure@T/4",
        norm: "point-l2",
        relative: true,
        range: (0.0, 0.05),
        meaning: "L2 error of pressure at the points on cells of 10 mm, relative, at most 0.05",
        best: Variant::TpmVpQuadratic,
    },
    Goal {
        scene: "riemann",
        quantity: "pressure",
        norm: "tv-cells",
        relative: false,
        range: (0.0, 990.0),
        meaning: "total variation of the cells' pressure, Pa, exact 900, at most a tenth more",
        best: Variant::TpmVpConstant,
    },
    Goal {
        scene: "dam-break",
        quantity: "energy",
        norm: "excess",
        relative: false,
        range: (f64::MIN, 0.005),
        meaning: "largest excess of energy over that at the start, relative, at most 0.005",
        best: Variant::TpmVpQuadratic,
    },
    Goal {
        scene: "channel",
        quantity: "mass",
        norm: "slope",
        relative: false,
        range: (0.995, 1.005),
        meaning: "growth of the points' mass over the flux of the inlet, within 0.005 of 1",
        best: Variant::TpmVpQuadratic,
    },
];

/// The records of the standing wave.
pub(super) fn waves(records: &[RunRecord]) -> impl Iterator<Item = &RunRecord> {
    records.iter().filter(|record| record.spec.layout == "sine-wave")
}

/// The finest record of a variant on a scene.
fn record<'a>(records: &'a [RunRecord], variant: &str, scene: &str) -> Option<&'a RunRecord> {
    let of = |record: &&RunRecord| record.spec.variant == variant && record.spec.layout == scene;
    records.iter().filter(of).max_by_key(|record| record.spec.level)
}

/// The run for the largest stable Courant number on the layout that every tier has.
fn usual<'a>(records: &'a [RunRecord], variant: &str) -> Option<&'a RunRecord> {
    let layout = courant::spec(Variant::parse(variant).ok()?).labels;
    records.iter().find(|record| record.spec.variant == variant && record.spec.labels == layout)
}

fn measured(goal: &Goal, record: &RunRecord) -> f64 {
    let Some(row) = record.row(goal.quantity, goal.norm) else { return f64::NAN };
    if goal.relative { row.value / row.scale } else { row.value }
}

/// What a cell of the matrix says, and whether it counts as met.
fn verdict(goal: &Goal, record: &RunRecord) -> (String, bool) {
    match &record.outcome {
        Outcome::Completed => {
            let value = measured(goal, record);
            let met = value >= goal.range.0 && value <= goal.range.1;
            let word = if met { "yes" } else { "no" };
            (format!("{word} {}", digits(value)), met)
        }
        Outcome::BlownUp { time, .. } => (format!("burst at {} s", digits(*time)), false),
        Outcome::NotBuilt { .. } => ("refused".to_owned(), false),
    }
}

/// Three digits, as short as they go.
fn digits(value: f64) -> String {
    if value == 0.0 || (1e-3..1e4).contains(&value.abs()) {
        format!("{value:.4}").trim_end_matches('0').trim_end_matches('.').to_owned()
    } else {
        format!("{value:.1e}")
    }
}

/// All verdicts: every variant has a result on every scene, and a TPM variant meets its goal.
pub(super) fn checks(records: &[RunRecord]) -> Vec<Check> {
    let mut checks = Vec::new();
    if records.is_empty() {
        return checks;
    }
    let check = |variant: &str, layout: &str, check: &str, measured, lower, upper| Check {
        case: "rivals".to_owned(),
        variant: variant.to_owned(),
        layout: layout.to_owned(),
        check: check.to_owned(),
        measured,
        lower,
        upper,
        miss: None,
    };
    for goal in &GOALS {
        let results = Variant::ALL
            .iter()
            .filter_map(|variant| record(records, variant.name(), goal.scene))
            .filter(|record| match &record.outcome {
                Outcome::NotBuilt { reason } => !reason.is_empty(),
                Outcome::Completed => measured(goal, record).is_finite(),
                Outcome::BlownUp { .. } => true,
            })
            .count();
        let all = Variant::ALL.len() as f64;
        checks.push(check("all", goal.scene, "with-a-result", results as f64, Some(all), None));
        let best = goal.best.name();
        if let Some(record) = record(records, best, goal.scene) {
            let name = format!("{}-{}", goal.quantity, goal.norm);
            let (lower, upper) = goal.range;
            let lower = (lower > f64::MIN).then_some(lower);
            let value = measured(goal, record);
            checks.push(check(best, goal.scene, &name, value, lower, Some(upper)));
        }
    }
    checks
}

/// The matrix, what the variants are made of, and where they are stable, if that was mapped.
pub(super) fn artifacts(records: &[RunRecord], policy: &str) -> Vec<Artifact> {
    let mut artifacts = vec![
        artifact(
            "rivals_matrix",
            "Every variant on four scenes",
            Content::Table(matrix(records, policy)),
        ),
        artifact("rivals_parts", "What the variants are made of", Content::Table(parts(records))),
    ];
    let map = stability(records);
    if !map.rows.is_empty() {
        let title = "Largest stable Courant numbers";
        artifacts.push(artifact("rivals_courant_map", title, Content::Table(map)));
    }
    artifacts
}

fn matrix(records: &[RunRecord], policy: &str) -> Table {
    let mut columns = vec!["variant".to_owned()];
    columns.extend(SCENES.iter().map(|scene| scene.name.to_owned()));
    columns.push("met".to_owned());
    let mut rows = Vec::new();
    for variant in Variant::ALL {
        let mut row = vec![Cell::from(variant.name())];
        let mut n_met = 0;
        for goal in &GOALS {
            let found = record(records, variant.name(), goal.scene);
            let (text, met) = found.map_or(("-".to_owned(), false), |record| verdict(goal, record));
            n_met += u64::from(met);
            row.push(Cell::Text(text));
        }
        row.push(Cell::Count(n_met));
        rows.push(row);
    }
    let goals: Vec<_> =
        GOALS.iter().map(|goal| format!("`{}`: {}", goal.scene, goal.meaning)).collect();
    let note =
        format!("{}. {policy} Reasons of bursts and refusals: events.csv.", goals.join("; "));
    Table { columns, rows, note }
}

fn parts(records: &[RunRecord]) -> Table {
    let columns = [
        "variant",
        "kernel",
        "nodes in 2D",
        "fields",
        "transfer",
        "pressure",
        "bound",
        "stable",
        "fixes",
        "about",
    ];
    let rows = Variant::ALL.iter().map(|&variant| {
        let Parts { kernel, fields, transfer, formulation, .. } = variant.parts();
        let pressure = match formulation {
            Formulation::Standard => "at samples",
            Formulation::VelocityPressure(_) => "by cell",
        };
        vec![
            Cell::from(variant.name()),
            Cell::Text(word(&kernel)),
            Cell::Count(nodes(kernel)),
            Cell::Text(word(&fields)),
            Cell::Text(word(&transfer)),
            Cell::from(pressure),
            Cell::Decimal(bound(variant)),
            usual(records, variant.name())
                .and_then(|record| record.row("courant", "largest-stable"))
                .map_or(Cell::from("-"), |row| Cell::Decimal(row.value)),
            Cell::Text(
                fixed(variant)
                    .iter()
                    .map(|(name, value)| format!("{name} = {value}"))
                    .collect::<Vec<_>>()
                    .join(", "),
            ),
            Cell::from(variant.about()),
        ]
    });
    Table {
        columns: columns.map(str::to_owned).to_vec(),
        rows: rows.collect(),
        note: "Pages: docs/methods. Names of parts are those of the modules of the library."
            .to_owned(),
    }
}

/// Nodes that a point touches in a plane.
const fn nodes(kernel: Kernel) -> u64 {
    kernel.width().pow(2) as u64
}

/// The name that something has in JSON.
fn word(value: &impl serde::Serialize) -> String {
    match serde_json::to_value(value) {
        Ok(serde_json::Value::String(word)) => word,
        other => format!("{other:?}"),
    }
}

/// The settings that a variant fixes, by name.
pub(super) fn fixed(variant: Variant) -> Vec<(String, serde_json::Value)> {
    let json = |settings: &Settings| match serde_json::to_value(settings) {
        Ok(serde_json::Value::Object(entries)) => entries,
        _ => serde_json::Map::new(),
    };
    let given = json(&Settings::default());
    json(&variant.settings(&Settings::default()))
        .into_iter()
        .filter(|(name, value)| given.get(name) != Some(value))
        .collect()
}
