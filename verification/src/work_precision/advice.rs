//! The cheapest runs that reached an error, from measured data only.

use serde::Serialize;

use super::cost::Cost;
use super::measured::Measured;

/// The cheapest run of one method that reached the error asked for.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Advice {
    /// What its cost is counted in.
    pub cost_unit: &'static str,
    /// The cost.
    pub cost: f64,
    /// The run.
    pub run: Measured,
}

/// The cheapest run of each method whose error is at most `error`, the cheapest method first; in seconds where the
/// study was timed, in touches elsewhere. Nothing is interpolated: each line is a run that was made.
pub fn advise(points: &[Measured], error: f64) -> Vec<Advice> {
    let timed = points.iter().any(|point| point.seconds.is_finite());
    let cost = if timed { Cost::Seconds } else { Cost::Touches };
    let mut best: Vec<Advice> = Vec::new();
    for run in points.iter().filter(|run| run.error <= error && run.cost(cost).is_finite()) {
        let advice = Advice { cost_unit: cost.label(), cost: run.cost(cost), run: run.clone() };
        match best.iter_mut().find(|other| other.run.variant == run.variant) {
            Some(other) if other.cost <= advice.cost => {}
            Some(other) => *other = advice,
            None => best.push(advice),
        }
    }
    best.sort_by(|a, b| a.cost.total_cmp(&b.cost));
    best
}
