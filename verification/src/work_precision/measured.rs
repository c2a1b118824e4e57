//! One run of the sweep as a point of the study.

use serde::Serialize;

use super::timing;
use crate::benchmark::{Benchmark, OF_THE_RUN};
use crate::case::Outcome;
use crate::number::nullable;
use crate::record::RunRecord;

/// What a run costs.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum Cost {
    /// Accesses of the grid and of neighbours, the same on any machine.
    Touches,
    /// Seconds of one core of this machine.
    Seconds,
}

impl Cost {
    /// As on axes and in headings.
    pub const fn label(self) -> &'static str {
        match self {
            Self::Touches => "touches of nodes and neighbours",
            Self::Seconds => "seconds of one core",
        }
    }

    /// As in file names.
    pub const fn name(self) -> &'static str {
        match self {
            Self::Touches => "touches",
            Self::Seconds => "seconds",
        }
    }
}

/// Error and cost of one run.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Measured {
    /// Name of the method.
    pub variant: String,
    /// Points per cell, as in labels.
    pub points: String,
    /// Whether the Courant number is that of all or its own.
    pub courant: String,
    /// The Courant number.
    #[serde(with = "nullable")]
    pub courant_number: f64,
    /// Resolution step.
    pub level: usize,
    /// Cell size, m.
    pub spacing: f64,
    /// Relative error, the first of the problem; not a number where the run did not complete.
    #[serde(with = "nullable")]
    pub error: f64,
    /// Steps.
    #[serde(with = "nullable")]
    pub steps: f64,
    /// Points at the end.
    #[serde(with = "nullable")]
    pub n_points: f64,
    /// Bytes of state per point.
    #[serde(with = "nullable")]
    pub bytes: f64,
    /// Accesses, see [`Cost::Touches`].
    #[serde(with = "nullable")]
    pub touches: f64,
    /// Seconds of one core; not a number without a timing of this machine.
    #[serde(with = "nullable")]
    pub seconds: f64,
    /// Why the run did not complete; empty if it did.
    pub reason: String,
}

impl Measured {
    /// The cost on that scale.
    pub fn cost(&self, cost: Cost) -> f64 {
        match cost {
            Cost::Touches => self.touches,
            Cost::Seconds => self.seconds,
        }
    }
}

/// The points of a problem in the order of its sweep.
pub(super) fn collect(
    benchmark: &Benchmark,
    records: &[RunRecord],
    timings: &[RunRecord],
) -> Vec<Measured> {
    let kind = benchmark.errors()[0];
    let point = |record: &RunRecord| {
        let value = |quantity: &str, norm: &str| {
            record.row(quantity, norm).map_or(f64::NAN, |row| row.value)
        };
        let fact = |quantity: &str| value(quantity, OF_THE_RUN);
        let spec = &record.spec;
        let steps = fact("steps");
        let reason = match &record.outcome {
            Outcome::Completed => String::new(),
            Outcome::BlownUp { step, reason, .. } => format!("step {}: {reason}", step + 1),
            Outcome::NotBuilt { reason } => reason.clone(),
        };
        Measured {
            variant: spec.variant.clone(),
            points: spec.label("points").to_owned(),
            courant: spec.label("courant").to_owned(),
            courant_number: fact("courant"),
            level: spec.level,
            spacing: spec.spacing,
            error: value(kind.quantity, kind.norm),
            steps,
            n_points: fact("points"),
            bytes: fact("bytes-per-point"),
            touches: fact("touches"),
            seconds: steps * timing::seconds_per_step(timings, spec),
            reason,
        }
    };
    records.iter().map(point).collect()
}
