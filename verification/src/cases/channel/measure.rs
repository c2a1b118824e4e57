//! The measures of a run, each a row.

use super::Parameters;
use super::march::{Recording, mach};
use super::outside;
use super::state::State;
use crate::case::Row;
use crate::cases::series::{self, Curve};
use crate::number::decade_above;

/// Instants at which masses are compared, s.
pub(super) const COMPARED: [f64; 3] = [2.0, 3.0, 4.0];
/// Instants at which surfaces are compared, s.
pub(super) const SURFACES: [f64; 2] = [2.0, 4.0];
/// Mass that must have left for the front to have arrived, kg.
pub(super) const LEFT: f64 = 0.1;
/// Change within a second below which the mass is steady.
const STEADY: f64 = 0.01;

/// The least-squares slope of a curve up to a time, and its largest distance until then from the line
/// `flux` t through its first value, over its last value.
pub(super) fn inflow(curve: &Curve, until: f64, flux: f64) -> [f64; 2] {
    let part: Vec<_> =
        curve.iter().copied().filter(|point| point.0 <= until && point.1.is_finite()).collect();
    let (Some(first), Some(last)) = (part.first(), part.last()) else { return [f64::NAN; 2] };
    let n = part.len() as f64;
    let mean = |of: &dyn Fn(&(f64, f64)) -> f64| part.iter().map(of).sum::<f64>() / n;
    let (t, m) = (mean(&|point| point.0), mean(&|point| point.1));
    let covariance = mean(&|point| (point.0 - t) * (point.1 - m));
    let slope = covariance / mean(&|point| (point.0 - t).powi(2));
    let distance = |point: &(f64, f64)| (point.1 - first.1 - flux * (point.0 - first.0)).abs();
    [slope, part.iter().map(distance).fold(0.0, f64::max) / last.1]
}

/// Largest minus least value within the second before each time, over the value there.
fn variations(curve: &Curve) -> Vec<(f64, f64)> {
    let start = curve.first().map_or(f64::NAN, |point| point.0);
    let whole = curve.iter().enumerate().filter(|(_, point)| point.0 >= start + 1.0);
    whole
        .map(|(end, &(time, value))| {
            let within = curve[..=end].iter().rev().take_while(|point| point.0 >= time - 1.0);
            let (least, most) =
                within.fold((f64::INFINITY, 0.0), |(a, b): (f64, f64), p| (a.min(p.1), b.max(p.1)));
            (time, (most - least) / value)
        })
        .collect()
}

/// Since when the mass varies by less than the bound up to the end, s, and how much it does at the end.
pub(super) fn steady(curve: &Curve) -> [f64; 2] {
    let variations = variations(curve);
    let last = variations.last().map_or(f64::NAN, |point| point.1);
    let moving = variations.iter().rposition(|point| !(point.1 < STEADY));
    let since = variations.get(moving.map_or(0, |index| index + 1));
    [since.map_or(f64::NAN, |point| point.0 - 1.0), last]
}

/// All rows; the values of a part that was not sampled are not numbers.
pub(super) fn rows(parameters: &Parameters, recording: &Recording) -> Vec<Row> {
    let states = &recording.states;
    let curve = |of: &dyn Fn(&State) -> f64| -> Vec<(f64, f64)> {
        states.iter().map(|state| (state.time, of(state))).collect()
    };
    let (mass, grid_mass) = (curve(&|state| state.mass), curve(&|state| state.grid_mass));
    let (end, steps) = recording.end.map_or((f64::NAN, f64::NAN), |(end, n)| (end, n as f64));
    // `max` would hide what is not a number.
    let unfinished = if end >= parameters.end { 0.0 } else { parameters.end - end };
    let mut found: Vec<(&str, String, f64)> = vec![
        ("run", "end".to_owned(), end),
        ("run", "steps".to_owned(), steps),
        ("run", "unfinished".to_owned(), unfinished),
        ("run", "mach".to_owned(), mach(states)),
    ];
    let until = recording.outlet.or(recording.end.map(|end| end.0)).unwrap_or(f64::NAN);
    for (name, curve) in [("mass", &mass), ("grid-mass", &grid_mass)] {
        let [slope, deviation] = inflow(curve, until, parameters.flux());
        found.push((name, "slope".to_owned(), slope / parameters.flux()));
        found.push((name, "deviation".to_owned(), deviation));
        for instant in COMPARED {
            let value = series::at(curve, instant);
            let over = if parameters.is_that_of_vof() { outside::mass(instant) } else { f64::NAN };
            found.push((name, format!("mass@{instant}"), value));
            found.push((name, format!("vof@{instant}"), value / over));
        }
    }
    let left = curve(&|state| state.left);
    found.push(("front", "outlet".to_owned(), recording.outlet.unwrap_or(f64::NAN)));
    found.push(("front", "left".to_owned(), series::first_above(&left, 0.0, LEFT)));
    let [since, variation] = steady(&mass);
    found.push(("steady", "since".to_owned(), since));
    found.push(("steady", "variation".to_owned(), variation));
    let growth = series::at(&mass, 3.0) / series::at(&mass, 2.0) - 1.0;
    found.push(("steady", "growth@2".to_owned(), growth));
    let largest = |of: &dyn Fn(&State) -> f64| {
        states.get(1..).unwrap_or_default().iter().map(of).reduce(f64::max).unwrap_or(f64::NAN)
    };
    let head = parameters.head();
    found.push(("energy", "most".to_owned(), largest(&State::energy)));
    found.push((
        "energy",
        "over-head".to_owned(),
        largest(&|state| state.energy() / (head * state.mass)),
    ));
    for instant in SURFACES {
        found.push((
            "depth",
            format!("vof@{instant}"),
            depth_deviation(parameters, recording, instant),
        ));
    }
    let imbalance = recording.imbalance.unwrap_or([f64::NAN; 2]).map(decade_above);
    found.push(("ledger", "step".to_owned(), imbalance[0]));
    found.push(("ledger", "run".to_owned(), imbalance[1]));
    let row = |(quantity, norm, value): (&str, String, f64)| Row {
        quantity: quantity.to_owned(),
        norm,
        value,
        scale: f64::NAN,
    };
    found.into_iter().map(row).collect()
}

/// Root mean square difference of the depths from those of the volume-of-fluid run, m.
fn depth_deviation(parameters: &Parameters, recording: &Recording, instant: f64) -> f64 {
    let depths = recording.depths.iter().find(|depths| depths.0 == instant);
    let Some((_, depths)) = depths.filter(|_| parameters.is_that_of_vof()) else { return f64::NAN };
    let squares = depths
        .iter()
        .map(|&(x, depth)| (depth - outside::depth(instant, x, parameters.spacing)).powi(2));
    (squares.sum::<f64>() / depths.len() as f64).sqrt()
}
