//! The atlas: verdicts of all variants on all hard cases, side by side.

use transpoint::Variant;

use super::NAME;
use super::list::{CASES, HardCase};
use super::long_table;
use super::verdict::{COLUMNS, Verdict, digits, find, on_record, tally};
use crate::cases::errors::artifact;
use crate::judge::Check;
use crate::record::RunRecord;
use crate::report::table::{Cell, Table};
use crate::report::{Artifact, Content};

/// One check per hard case: verdicts that are not those on record.
pub(super) fn checks(records: &[RunRecord]) -> Vec<Check> {
    let mut checks = Vec::new();
    for case in &CASES {
        let (mut judged, mut different) = (0, 0);
        for variant in Variant::ALL.map(Variant::name) {
            let Some(verdict) = find(records, variant, case) else { continue };
            judged += 1;
            different += u32::from(on_record(variant, case.name) != Some(verdict.word()));
        }
        if judged > 0 {
            checks.push(Check {
                case: NAME.to_owned(),
                variant: "all".to_owned(),
                layout: case.name.to_owned(),
                check: "verdicts-not-as-on-record".to_owned(),
                measured: f64::from(different),
                lower: None,
                upper: Some(0.0),
                miss: None,
            });
        }
    }
    checks
}

/// The atlas and what belongs to it.
pub(super) fn artifacts(records: &[RunRecord], policy: &str) -> Vec<Artifact> {
    let has = |variant: &str| records.iter().any(|record| record.spec.variant == variant);
    let names = Variant::ALL.map(Variant::name);
    let variants: Vec<&str> = names.iter().copied().filter(|variant| has(variant)).collect();
    let table = |stem, title, table| artifact(stem, title, Content::Table(table));
    let mut artifacts = vec![
        table("hard_cases_passed", "Hard cases passed", passed(records, &variants)),
        table(
            "hard_cases_atlas",
            "Every variant on the hard cases",
            atlas(records, &variants, policy),
        ),
        table("hard_cases_blowups", "Hard cases at which a run burst", blowups(records, &variants)),
        artifact(
            "hard_cases_verdicts",
            "Verdicts in the form of the snapshot",
            Content::Profiles(verdicts(records, &variants)),
        ),
    ];
    if let Some(long) = long_table::table(records, &variants) {
        artifacts.push(table("hard_cases_long", "Long runs with a free surface", long));
    }
    artifacts
}

fn atlas(records: &[RunRecord], variants: &[&str], policy: &str) -> Table {
    let mut columns = vec!["hard case".to_owned(), "criterion".to_owned()];
    columns.extend(variants.iter().map(|&variant| variant.to_owned()));
    let row = |case: &HardCase| {
        let HardCase { name, criterion, .. } = case;
        let mut row = vec![Cell::from(*name), Cell::from(*criterion)];
        row.extend(variants.iter().map(|variant| {
            let verdict = find(records, variant, case);
            Cell::Text(verdict.map_or_else(|| "not run".to_owned(), |verdict| verdict.cell()))
        }));
        row
    };
    let note = format!(
        "✓ passes, ✗ fails, – not defined for the variant (reasons: events.csv). The number is the first one that the \
         criterion names, or the one that fails it, then with its name: docs/hard-cases.md. {policy}"
    );
    Table { columns, rows: CASES.iter().map(row).collect(), note }
}

fn blowups(records: &[RunRecord], variants: &[&str]) -> Table {
    let mut rows = Vec::new();
    for case in &CASES {
        for variant in variants {
            if let Some(Verdict::Burst(step, time, reason)) = find(records, variant, case) {
                rows.push(vec![
                    Cell::from(case.name),
                    Cell::from(*variant),
                    Cell::Count(step + 1),
                    Cell::Text(digits(time)),
                    Cell::Text(reason),
                ]);
            }
        }
    }
    let columns = ["hard case", "variant", "step", "time in s", "what failed first, and where"];
    let note = "Time in units of the hard case where it has none of its own.".to_owned();
    Table { columns: columns.map(str::to_owned).to_vec(), rows, note }
}

fn passed(records: &[RunRecord], variants: &[&str]) -> Table {
    let mut tallies: Vec<_> =
        variants.iter().map(|variant| (*variant, tally(records, variant))).collect();
    tallies.sort_by_key(|(_, (passed, ..))| std::cmp::Reverse(*passed));
    let rows = tallies.into_iter().map(|(variant, (passed, judged, failed))| {
        vec![
            Cell::from(variant),
            Cell::Count(passed),
            Cell::Count(judged),
            Cell::Text(failed.join(", ")),
        ]
    });
    let columns = ["variant", "passed", "judged", "failed"];
    let note =
        format!("Of {}; those that are not defined for a variant are not judged.", CASES.len());
    Table { columns: columns.map(str::to_owned).to_vec(), rows: rows.collect(), note }
}

fn verdicts(records: &[RunRecord], variants: &[&str]) -> Table {
    let mut rows = Vec::new();
    for variant in variants {
        for case in &CASES {
            if let Some(verdict) = find(records, variant, case) {
                rows.push(vec![
                    Cell::from(*variant),
                    Cell::from(case.name),
                    Cell::from(verdict.word()),
                ]);
            }
        }
    }
    Table { columns: COLUMNS.map(str::to_owned).to_vec(), rows, note: String::new() }
}
