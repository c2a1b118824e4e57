//! Verdicts: one of each variant on each hard case, and those on record.

use super::NORM;
use super::list::{CASES, HardCase};
use crate::case::{Outcome, Row};
use crate::record::RunRecord;

/// The snapshot of all verdicts: `variant,hard_case,verdict`, the last one `pass`, `fail` or `none`.
const SNAPSHOT: &str = include_str!("verdicts.csv");
/// Headings of the snapshot and of the artifact that replaces it.
pub(super) const COLUMNS: [&str; 3] = ["variant", "hard_case", "verdict"];

/// How a variant fares on a hard case.
#[derive(Clone, Debug, PartialEq)]
pub(super) enum Verdict {
    /// Every goal is met; the number that is shown.
    Pass(f64),
    /// A goal is not met: its quantity, if it is not the first one, and the number.
    Fail(Option<&'static str>, f64),
    /// The run burst: completed steps, time, s, and the reason.
    Burst(u64, f64, String),
    /// The variant is not defined for it; the reason.
    None(String),
}

impl Verdict {
    /// The verdict of a run.
    pub(super) fn of(case: &HardCase, outcome: &Outcome, rows: &[Row]) -> Self {
        match outcome {
            Outcome::Completed => Self::of_rows(case, rows),
            Outcome::BlownUp { step, time, reason } => Self::Burst(*step, *time, reason.clone()),
            Outcome::NotBuilt { reason } => Self::None(reason.clone()),
        }
    }

    fn of_rows(case: &HardCase, rows: &[Row]) -> Self {
        let value = |quantity| {
            let of = |row: &&Row| row.quantity == quantity && row.norm == NORM;
            rows.iter().find(of).map_or(f64::NAN, |row| row.value)
        };
        for (k, goal) in case.goals.iter().enumerate() {
            let value = value(goal.quantity);
            if !goal.is_met(value) {
                return Self::Fail((k > 0).then_some(goal.quantity), value);
            }
        }
        Self::Pass(case.goals.first().map_or(f64::NAN, |goal| value(goal.quantity)))
    }

    /// `pass`, `fail` or `none`.
    pub(super) const fn word(&self) -> &'static str {
        match self {
            Self::Pass(_) => "pass",
            Self::Fail(..) | Self::Burst(..) => "fail",
            Self::None(_) => "none",
        }
    }

    /// What the atlas shows.
    pub(super) fn cell(&self) -> String {
        match self {
            Self::Pass(value) => format!("✓ {}", digits(*value)),
            Self::Fail(None, value) => format!("✗ {}", digits(*value)),
            Self::Fail(Some(quantity), value) => format!("✗ {quantity} {}", digits(*value)),
            Self::Burst(step, _, reason) => {
                let what = reason.split([':', '(']).next().unwrap_or(reason);
                format!("✗ burst in step {}: {}", step + 1, what.trim_end_matches(" at ").trim())
            }
            Self::None(_) => "–".to_owned(),
        }
    }
}

/// Two digits, as short as they go; `–` if there is no number.
pub(super) fn digits(value: f64) -> String {
    if !value.is_finite() {
        return "no number".to_owned();
    }
    if value == 0.0 {
        return "0".to_owned();
    }
    if (0.01..1000.0).contains(&value.abs()) {
        let before = value.abs().log10().floor() as i32 + 1;
        let text = format!("{value:.*}", usize::try_from(2 - before).unwrap_or(0));
        return text.trim_end_matches(".0").to_owned();
    }
    format!("{value:.1e}")
}

/// The verdict of a variant on a hard case; `None` without a record.
pub(super) fn find(records: &[RunRecord], variant: &str, case: &HardCase) -> Option<Verdict> {
    let of = |record: &&RunRecord| record.spec.variant == variant && record.spec.layout == case.run;
    let record = records.iter().find(of)?;
    Some(Verdict::of(case, &record.outcome, &record.rows))
}

/// The word on record.
pub(super) fn on_record(variant: &str, case: &str) -> Option<&'static str> {
    let start = format!("{variant},{case},");
    SNAPSHOT.lines().find_map(|line| line.strip_prefix(&start))
}

/// Number of verdicts on record that are of no hard case.
#[cfg(test)]
pub(super) fn strangers() -> usize {
    let known = |line: &&str| {
        line.split(',').nth(1).is_some_and(|name| CASES.iter().any(|case| case.name == name))
    };
    SNAPSHOT.lines().skip(1).filter(|line| !known(line)).count()
}

/// How many hard cases a variant passes, and the names of those that it fails.
pub(super) fn tally(records: &[RunRecord], variant: &str) -> (u64, u64, Vec<&'static str>) {
    let (mut passed, mut judged, mut failed) = (0, 0, Vec::new());
    for case in &CASES {
        let Some(verdict) = find(records, variant, case) else { continue };
        match verdict.word() {
            "pass" => (passed, judged) = (passed + 1, judged + 1),
            "fail" => {
                judged += 1;
                failed.push(case.name);
            }
            _ => (),
        }
    }
    (passed, judged, failed)
}
