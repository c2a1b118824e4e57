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
    /// Why the goal is known not to be met, see [`Miss`].
    #[serde(skip_serializing_if = "Option::is_none")]
    pub miss: Option<&'static str>,
}

/// A goal that is known not to be met, and why.
///
/// Its bounds stay what they are, and its verdict is `miss`: shown with every report, but no failure, so that
/// what fails beyond it is seen. A goal that is met passes, whatever is listed.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub struct Miss {
    /// Name of the method.
    pub variant: &'static str,
    /// Arrangement of the points.
    pub layout: &'static str,
    /// Name of the check, or how its name begins.
    pub check: &'static str,
    /// What was found to be the cause.
    pub reason: &'static str,
}

impl Miss {
    /// Whether a check is of this goal.
    pub fn is_of(&self, check: &Check) -> bool {
        self.variant == check.variant
            && self.layout == check.layout
            && check.check.starts_with(self.check)
    }
}

impl Check {
    /// Whether the measured number is finite and within the bounds, which belong to the range.
    pub fn holds(&self) -> bool {
        self.measured.is_finite()
            && self.lower.is_none_or(|lower| self.measured >= lower)
            && self.upper.is_none_or(|upper| self.measured <= upper)
    }

    /// `pass`, `fail`, or `miss` where that is known.
    pub fn verdict(&self) -> &'static str {
        match (self.holds(), self.miss) {
            (true, _) => "pass",
            (false, Some(_)) => "miss",
            (false, None) => "fail",
        }
    }

    /// Whether the goal is not met, and that was not known.
    pub fn fails(&self) -> bool {
        !self.holds() && self.miss.is_none()
    }
}

/// How many of some checks pass, are known to miss, and fail.
pub fn tally(checks: &[Check]) -> [usize; 3] {
    let count = |verdict| checks.iter().filter(|check| check.verdict() == verdict).count();
    ["pass", "miss", "fail"].map(count)
}

/// What the process reports to its caller when nothing went wrong with the request itself.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Verdict {
    /// No check failed, or nothing was to be checked: exit code 0.
    Holds,
    /// At least one check failed: exit code 1.
    Fails,
}

impl Verdict {
    /// The verdict over several checks.
    pub fn of(checks: &[Check]) -> Self {
        if checks.iter().any(Check::fails) { Self::Fails } else { Self::Holds }
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
