//! One run of the sweep as a point of the study.

use serde::Serialize;
use transpoint::Variant;

use super::cost::Cost;
use super::instructions::{self, Flow, Kind};
use super::timing;
use crate::benchmark::{Benchmark, OF_THE_RUN, Parameters};
use crate::case::{Outcome, RunSpec};
use crate::number::nullable;
use crate::record::RunRecord;

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
    pub bytes_per_point: f64,
    /// Accesses, see [`Cost::Touches`].
    #[serde(with = "nullable")]
    pub touches: f64,
    /// Σ over steps of the points, see [`Cost::PointSteps`].
    #[serde(with = "nullable")]
    pub point_steps: f64,
    /// Instructions, see [`Cost::Instructions`]; not a number without a count of the method.
    #[serde(with = "nullable")]
    pub instructions: f64,
    /// Bytes of point state read and written, see [`Cost::Bytes`].
    #[serde(with = "nullable")]
    pub bytes: f64,
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
            Cost::Instructions => self.instructions,
            Cost::PointSteps => self.point_steps,
            Cost::Bytes => self.bytes,
            Cost::Seconds => self.seconds,
        }
    }
}

/// Times that a step passes over the state of a point: once to read it and once to write it.
const PASSES: f64 = 2.0;

/// Σ over steps of the points of a run, as the solver counted them; not a number where it has not.
fn point_steps(record: &RunRecord) -> f64 {
    record.counters.get("n_point_updates").map_or(f64::NAN, |&count| count as f64)
}

/// Instructions per point and step of a run; not a number where they have not been counted.
fn instructions_per_point_step(benchmark: &Benchmark, is_viscous: bool, spec: &RunSpec) -> f64 {
    let count = || {
        let variant = Variant::parse(&spec.variant).ok()?;
        let parameters: Parameters = serde_json::from_value(spec.parameters.clone()).ok()?;
        let kind = Kind {
            variant: &spec.variant,
            dimension: benchmark.dimension(),
            points_per_axis: parameters.resolution.points_per_axis,
            flow: Flow::of(is_viscous, benchmark.is_modified_last(variant))?,
        };
        Some(instructions::per_point_step(&kind))
    };
    count().unwrap_or(f64::NAN)
}

/// The points of a problem in the order of its sweep.
pub(super) fn collect(
    benchmark: &Benchmark,
    records: &[RunRecord],
    timings: &[RunRecord],
) -> Vec<Measured> {
    let kind = benchmark.errors()[0];
    // Asked for once: a scene is built for the answer.
    let is_viscous = benchmark.is_viscous();
    let point = |record: &RunRecord| {
        let value = |quantity: &str, norm: &str| {
            record.row(quantity, norm).map_or(f64::NAN, |row| row.value)
        };
        let fact = |quantity: &str| value(quantity, OF_THE_RUN);
        let spec = &record.spec;
        let steps = fact("steps");
        let bytes_per_point = fact("bytes-per-point");
        let point_steps = point_steps(record);
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
            bytes_per_point,
            touches: fact("touches"),
            point_steps,
            instructions: point_steps * instructions_per_point_step(benchmark, is_viscous, spec),
            bytes: PASSES * bytes_per_point * point_steps,
            seconds: steps * timing::seconds_per_step(timings, spec),
            reason,
        }
    };
    records.iter().map(point).collect()
}
