//! Checks: a measured number against bounds that were set beforehand and are never tuned.

use std::process::ExitCode;

use serde::Serialize;

use crate::number::nullable;

/// One verdict.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Check {
    /// Name of the case.
    pub case: String,
    /// Name of the method.
    pub variant: String,
    /// Arrangement of the points.
    pub layout: String,
    /// What is checked.
    pub check: String,
    /// The number found; not a number fails.
    #[serde(with = "nullable")]
    pub measured: f64,
    /// Smallest value that passes.
    pub lower: Option<f64>,
    /// Largest value that passes.
    pub upper: Option<f64>,
}

impl Check {
    /// Whether the measured number is finite and within the bounds, which belong to the range.
    pub fn holds(&self) -> bool {
        self.measured.is_finite()
            && self.lower.is_none_or(|lower| self.measured >= lower)
            && self.upper.is_none_or(|upper| self.measured <= upper)
    }

    /// `pass` or `fail`.
    pub fn verdict(&self) -> &'static str {
        if self.holds() { "pass" } else { "fail" }
    }
}

/// What the process reports to its caller when nothing went wrong with the request itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// Every check holds, or nothing was to be checked: exit code 0.
    Holds,
    /// At least one check failed: exit code 1.
    Fails,
}

impl Verdict {
    /// The verdict over several checks.
    pub fn of(checks: &[Check]) -> Self {
        if checks.iter().all(Check::holds) { Self::Holds } else { Self::Fails }
    }
}

impl From<Verdict> for ExitCode {
    fn from(verdict: Verdict) -> Self {
        match verdict {
            Verdict::Holds => Self::SUCCESS,
            Verdict::Fails => Self::from(1),
        }
    }
}
