//! The measures of a run, each a row.

use super::march::Recording;
use super::probe::PLACES;
use super::state::State;
use crate::case::Row;
use crate::cases::series;
use crate::cases::series::{
    Curve, deviation, first_above, impulse, largest, mean, noise, running_mean,
};
use crate::number::decade_above;
use crate::reference::dam_break::{VofQuantity, VofSpacing, vof};

/// Width of the running mean, T.
pub(super) const SMOOTH: f64 = 0.05;
/// P that counts as arrived.
const ARRIVED: f64 = 0.1;
/// The plateau, the second peak, the impulse, and the three ranges of the noise, T.
const PLATEAU: [f64; 2] = [1.75, 2.5];
const FIRST_PEAK: [f64; 2] = [1.2, 1.75];
const SECOND_PEAK: [f64; 2] = [2.5, 3.5];
const IMPULSE: [f64; 2] = [1.2, 3.6];
const NOISE: [(&str, [f64; 2]); 3] =
    [("noise", [1.3, 4.0]), ("noise-before", [1.3, 2.5]), ("noise-after", [2.5, 4.0])];
/// Before this the record of the experiment is noise.
const IMPACT: f64 = 1.0;
/// From when on the growth of points is measured, T.
const GROWTH: f64 = 2.0;
/// What is below this share is round-off and given by its decade.
const ROUND_OFF: f64 = 1e-9;

/// The measures of a curve of pressure: names and values.
pub(super) fn of_pressure(curve: &Curve) -> Vec<(&'static str, f64)> {
    let smooth = running_mean(curve, SMOOTH);
    let first = largest(&smooth, FIRST_PEAK[0], FIRST_PEAK[1]);
    let second = largest(&smooth, SECOND_PEAK[0], SECOND_PEAK[1]);
    let mut found = vec![
        ("arrival", first_above(&smooth, IMPACT, ARRIVED)),
        ("mean", mean(curve, PLATEAU[0], PLATEAU[1])),
        ("first-peak", first.1),
        ("first-peak-time", first.0),
        ("second-peak", second.1),
        ("second-peak-time", second.0),
        ("impulse", impulse(curve, IMPULSE[0], IMPULSE[1])),
    ];
    found.extend(NOISE.map(|(name, [from, to])| (name, noise(curve, &smooth, from, to))));
    found
}

/// The measures of the heights: front, run-up and water at the gauges.
pub(super) fn of_heights(
    column: impl Fn(VofQuantity) -> Vec<(f64, f64)>,
) -> Vec<(&'static str, f64)> {
    let (depth, top) = (column(VofQuantity::Depth2725), column(VofQuantity::Top2725));
    let far = |quantity, from, to| {
        let reference = vof(VofSpacing::Millimeters10, quantity);
        reference.map_or(f64::NAN, |found| deviation(&column(quantity), &found.points, from, to))
    };
    vec![
        ("front-deviation", far(VofQuantity::FrontAny, 0.2, 1.15)),
        ("depth2228-deviation", far(VofQuantity::Depth2228, 1.0, 2.5)),
        ("run-up", largest(&column(VofQuantity::RunUp), 1.2, 2.5).1),
        ("rebound", largest(&depth, 2.5, 4.0).1),
        ("rebound-mean", largest(&running_mean(&depth, SMOOTH), 2.5, 4.0).1),
        ("rebound-time", largest(&depth, 2.5, 4.0).0),
        ("rebound-top", largest(&top, 2.5, 4.0).1),
    ]
}

/// All rows; the values of a part that was not sampled are not numbers.
pub(super) fn rows(recording: &Recording) -> Vec<Row> {
    let mut found: Vec<(String, &'static str, f64)> = Vec::new();
    found.push(("run".to_owned(), "end", recording.end.unwrap_or(f64::NAN)));
    found.push(("water".to_owned(), "wetting", recording.wetting.unwrap_or(f64::NAN)));
    for (place, name) in PLACES.iter().enumerate() {
        let curve: Vec<_> =
            recording.pressures.iter().map(|(time, values)| (*time, values[place])).collect();
        let measures = of_pressure(&curve).into_iter();
        found.extend(measures.map(|(norm, value)| (format!("p-{name}"), norm, value)));
    }
    let heights = of_heights(|quantity| {
        recording.states.iter().map(|state| (state.time, state.height(quantity))).collect()
    });
    found.extend(heights.into_iter().map(|(norm, value)| ("water".to_owned(), norm, value)));
    found.extend(
        totals(recording).into_iter().map(|(name, norm, value)| (name.to_owned(), norm, value)),
    );
    for (kind, entry) in &recording.ledger {
        let counts = ["cells", "added", "removed"].into_iter().zip(entry.counts);
        found.extend(counts.map(|(norm, count)| (format!("ledger-{kind}"), norm, count as f64)));
        let names = ["mass", "momentum-x", "kinetic", "potential", "compression"];
        let changes = names.into_iter().zip(entry.changes);
        found.extend(changes.map(|(norm, change)| (format!("ledger-{kind}"), norm, change)));
    }
    let row = |(quantity, norm, value): (String, &str, f64)| Row {
        quantity,
        norm: norm.to_owned(),
        value,
        scale: f64::NAN,
    };
    found.into_iter().map(row).collect()
}

/// Energies over that at the start, drifts of the masses, numbers of points and fractures.
fn totals(recording: &Recording) -> Vec<(&'static str, &'static str, f64)> {
    let states = &recording.states;
    let curve = |of: &dyn Fn(&State) -> f64| -> Vec<(f64, f64)> {
        states.iter().map(|state| (state.time, of(state))).collect()
    };
    let start = states.first().copied().unwrap_or_default();
    let energy = curve(&|state| state.total() / start.total());
    let dissipated = |time: f64| 1.0 - series::at(&energy, time);
    let excess = energy.iter().map(|point| point.1 - 1.0).reduce(f64::max).unwrap_or(f64::NAN);
    // The first state has no mass on the nodes yet.
    let after = states.get(1..).unwrap_or_default();
    let drift = |reference: Option<f64>, of: &dyn Fn(&State) -> f64| {
        let reference = reference.unwrap_or(f64::NAN);
        let largest = after.iter().map(|state| (of(state) / reference - 1.0).abs());
        let largest = largest.reduce(f64::max).unwrap_or(f64::NAN);
        if largest < ROUND_OFF { decade_above(largest) } else { largest }
    };
    let points = curve(&|state| state.points as f64);
    let last = points.last().map_or(f64::NAN, |point| point.1);
    let fractures = recording.written.iter().map(|written| written.fractures as f64);
    let lasting = recording.written.iter().map(|written| written.lasting as f64);
    let most = recording.written.iter().map(|written| f64::from(written.most_points));
    vec![
        ("energy", "start", if states.is_empty() { f64::NAN } else { start.total() }),
        ("energy", "excess", excess),
        ("energy", "dissipated@2.5", dissipated(2.5)),
        ("energy", "dissipated@3.95", dissipated(3.95)),
        ("mass", "drift", drift(states.first().map(|state| state.mass), &|state| state.mass)),
        ("grid-mass", "drift", drift(after.first().map(|state| state.grid_mass), &|s| s.grid_mass)),
        ("points", "start", if states.is_empty() { f64::NAN } else { start.points as f64 }),
        ("points", "end", last),
        ("points", "growth", last / series::at(&points, GROWTH)),
        ("points", "most-in-a-cell", most.reduce(f64::max).unwrap_or(f64::NAN)),
        ("fractures", "most", fractures.reduce(f64::max).unwrap_or(f64::NAN)),
        ("fractures", "most-lasting", lasting.reduce(f64::max).unwrap_or(f64::NAN)),
    ]
}
