//! The table of the long runs: how long a variant lasts, and what drifts or grows.

use super::NORM;
use super::list::HardCase;
use super::long_runs::{CASES, period, periods};
use super::verdict::Verdict;
use crate::case::Outcome;
use crate::record::RunRecord;
use crate::report::table::{Cell, Table};

/// Columns of each run, and the quantity of a number.
const COLUMNS: [(&str, Option<&str>); 10] = [
    ("", None),
    (" periods", None),
    (" energy per period", Some("energy-drift")),
    (" motion per period", Some("motion-drift")),
    (" growth per period", Some("growth")),
    (" mass", Some("mass-over-start")),
    (" potential", Some("potential-over-start")),
    (" rms v after 100", Some("rms-velocity-100")),
    (" rms v at the end", Some("rms-velocity-end")),
    (" max v", Some("largest-velocity")),
];

/// The table; `None` where no variant ran either.
pub(super) fn table(records: &[RunRecord], variants: &[&str]) -> Option<Table> {
    let find = |variant: &str, case: &HardCase| {
        let of =
            |record: &&RunRecord| record.spec.variant == variant && record.spec.layout == case.run;
        records.iter().find(of)
    };
    let has_run = |variant: &&str| CASES.iter().any(|case| find(variant, case).is_some());
    let mut rows = Vec::new();
    for variant in variants.iter().copied().filter(has_run) {
        let mut row = vec![Cell::from(variant)];
        for case in &CASES {
            row.extend(find(variant, case).map_or_else(not_run, |record| cells(case, record)));
        }
        rows.push(row);
    }
    let mut columns = vec!["variant".to_owned()];
    for case in &CASES {
        columns.extend(COLUMNS.iter().map(|(column, _)| format!("{}{column}", case.name)));
    }
    let criteria = CASES.map(|case| format!("{}: {}.", case.name, case.criterion)).join(" ");
    let note = format!(
        "{criteria} ✓ holds, ✗ does not, with the number that fails or what burst and where; growth is judged less \
         twice its standard error. Mass, and potential energy per mass, over those at the start. Velocities over ΩR in \
         the drop, after 100 periods, and over √(gH) in the tank, after 100 H/c: docs/hard-cases.md."
    );
    (!rows.is_empty()).then_some(Table { columns, rows, note })
}

fn not_run() -> Vec<Cell> {
    let mut cells = vec![Cell::from("not run")];
    cells.extend(COLUMNS[1..].iter().map(|_| Cell::Value(f64::NAN)));
    cells
}

/// Of one run, in the order of the columns.
fn cells(case: &HardCase, record: &RunRecord) -> Vec<Cell> {
    let value = |quantity: &str| {
        let of = |row: &&crate::case::Row| row.quantity == quantity && row.norm == NORM;
        record.rows.iter().find(of).map_or(f64::NAN, |row| row.value)
    };
    let verdict = match Verdict::of(case, &record.outcome, &record.rows) {
        Verdict::Burst(_, _, reason) => {
            let what = reason.split_once(": ").map_or(reason.as_str(), |(what, _)| what);
            format!("✗ burst: {what}")
        }
        other => other.cell(),
    };
    let lasted = match &record.outcome {
        Outcome::Completed => periods(case.run),
        Outcome::BlownUp { time, .. } => time / period(case.run),
        Outcome::NotBuilt { .. } => f64::NAN,
    };
    let mut cells = vec![Cell::Text(verdict), Cell::Decimal(lasted)];
    cells.extend(
        COLUMNS.iter().filter_map(|(_, quantity)| *quantity).map(|q| Cell::Value(value(q))),
    );
    cells
}
