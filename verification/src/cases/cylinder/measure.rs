//! Measures of the force on the cylinder.

use super::march::Recording;
use crate::case::Row;
use crate::number::decade_above;

/// Pairs of T = t U/D, ascending, and values.
pub(super) type Curve = [(f64, f64)];

/// Width of the running mean of the forces, T: two round trips of sound across the cylinder.
pub(super) const SMOOTH: f64 = 0.2;
/// Fewest periods of shedding that give a Strouhal number.
pub(super) const PERIODS: usize = 8;
/// Between two of its crossings a lift must lie beyond the mean on either side, so that noise makes none: by
/// this share of its standard deviation, and by this C_L.
const HYSTERESIS: (f64, f64) = (0.5, 0.2);
/// What is below this share is round-off and given by its decade.
const ROUND_OFF: f64 = 1e-12;

/// What a periodic force is known by.
#[derive(Clone, Copy, Debug, PartialEq)]
pub(super) struct Shedding {
    /// Whole periods between the first and the last upward crossing.
    pub(super) periods: usize,
    /// Frequency of the lift times D/U.
    pub(super) strouhal: f64,
    /// First and last crossing, T.
    pub(super) range: [f64; 2],
}

/// At each value the mean of all that are at most half a `width` away.
pub(super) fn running_mean(curve: &Curve, width: f64) -> Vec<(f64, f64)> {
    let (mut begin, mut end) = (0, 0);
    let smooth = |&(time, _): &(f64, f64)| {
        while curve[begin].0 < time - 0.5 * width {
            begin += 1;
        }
        while end < curve.len() && curve[end].0 <= time + 0.5 * width {
            end += 1;
        }
        (time, mean(&curve[begin..end]))
    };
    curve.iter().map(smooth).collect()
}

/// Mean of the values; not a number without any.
pub(super) fn mean(curve: &Curve) -> f64 {
    curve.iter().map(|point| point.1).sum::<f64>() / curve.len() as f64
}

/// Root mean square about the mean.
pub(super) fn deviation(curve: &Curve) -> f64 {
    let center = mean(curve);
    mean(&curve.iter().map(|&(time, value)| (time, (value - center).powi(2))).collect::<Vec<_>>())
        .sqrt()
}

/// The part of a curve from an instant on.
pub(super) fn from(curve: &Curve, start: f64) -> &Curve {
    &curve[curve.partition_point(|point| point.0 < start)..]
}

/// Instants at which a curve rises through its mean, linear between values; see [`HYSTERESIS`].
pub(super) fn upward_crossings(curve: &Curve) -> Vec<f64> {
    let center = mean(curve);
    let reach = (HYSTERESIS.0 * deviation(curve)).max(HYSTERESIS.1);
    let mut found = Vec::new();
    let (mut below, mut candidate) = (false, None);
    for pair in curve.windows(2) {
        let [(t0, y0), (t1, y1)] = [pair[0], pair[1]];
        let (y0, y1) = (y0 - center, y1 - center);
        if y1 < -reach {
            (below, candidate) = (true, None);
        }
        if below && candidate.is_none() && y0 <= 0.0 && y1 > 0.0 {
            candidate = Some(t0 + (t1 - t0) * y0 / (y0 - y1));
        }
        if y1 > reach {
            found.extend(candidate.take());
            below = false;
        }
    }
    found
}

/// Shedding in the part of a lift that is given; `None` with less than one period.
pub(super) fn shedding(lift: &Curve) -> Option<Shedding> {
    let crossings = upward_crossings(lift);
    let (first, last) = (*crossings.first()?, *crossings.last()?);
    let periods = crossings.len() - 1;
    let strouhal = periods as f64 / (last - first);
    (periods > 0).then_some(Shedding { periods, strouhal, range: [first, last] })
}

/// Mean over whole periods of the largest value in each, and of the smallest.
pub(super) fn extremes(curve: &Curve, shedding: &Shedding) -> [f64; 2] {
    let [first, last] = shedding.range;
    let width = (last - first) / shedding.periods as f64;
    let mut sums = [0.0; 2];
    for period in 0..shedding.periods {
        let begin = first + width * period as f64;
        let part = from(curve, begin);
        let part = &part[..part.partition_point(|point| point.0 < begin + width)];
        sums[0] += part.iter().map(|point| point.1).fold(f64::NEG_INFINITY, f64::max);
        sums[1] += part.iter().map(|point| point.1).fold(f64::INFINITY, f64::min);
    }
    sums.map(|sum| sum / shedding.periods as f64)
}

/// All rows; the values of what was not recorded are not numbers.
pub(super) fn rows(recording: &Recording) -> Vec<Row> {
    let mut found = force_rows(recording);
    found.extend(total_rows(recording));
    let row = |(quantity, norm, value): (&str, &str, f64)| Row {
        quantity: quantity.to_owned(),
        norm: norm.to_owned(),
        value,
        scale: f64::NAN,
    };
    found.into_iter().map(row).collect()
}

type Measure = (&'static str, &'static str, f64);

fn force_rows(recording: &Recording) -> Vec<Measure> {
    let of = |axis: usize| -> Vec<(f64, f64)> {
        recording.samples.iter().map(|sample| (sample.time, sample.force[axis])).collect()
    };
    let raw = [of(0), of(1)];
    let [drag, lift] = [0, 1].map(|axis| running_mean(&raw[axis], SMOOTH));
    let start = recording.measured_from;
    let (drag, lift) = (from(&drag, start), from(&lift, start));
    let noise = |smooth: &Curve, raw: &Curve| {
        let rest = from(raw, start).iter().zip(smooth).map(|(raw, mean)| (raw.0, raw.1 - mean.1));
        deviation(&rest.collect::<Vec<_>>())
    };
    let found = shedding(lift).filter(|found| found.periods >= PERIODS);
    let of_shedding = |value: &dyn Fn(&Shedding) -> f64| found.as_ref().map_or(f64::NAN, value);
    vec![
        ("drag", "mean", mean(drag)),
        ("drag", "max", of_shedding(&|found| extremes(drag, found)[0])),
        ("drag", "min", of_shedding(&|found| extremes(drag, found)[1])),
        ("drag", "deviation", deviation(drag)),
        ("drag", "noise", noise(drag, &raw[0])),
        ("lift", "mean", mean(lift)),
        ("lift", "max", of_shedding(&|found| extremes(lift, found)[0])),
        ("lift", "min", of_shedding(&|found| extremes(lift, found)[1])),
        ("lift", "deviation", deviation(lift)),
        ("lift", "noise", noise(lift, &raw[1])),
        ("strouhal", "crossings", of_shedding(&|found| found.strouhal)),
        ("strouhal", "periods", of_shedding(&|found| found.periods as f64)),
    ]
}

/// Mass ledger, energy, cells without points, and points in the body.
fn total_rows(recording: &Recording) -> Vec<Measure> {
    let samples = &recording.samples;
    let largest = |of: &dyn Fn(&super::march::Sample) -> f64| {
        samples.iter().map(of).reduce(f64::max).unwrap_or(f64::NAN)
    };
    let ledger = largest(&|sample| sample.ledger_error);
    let energy = largest(&|sample| sample.kinetic_energy / recording.start_energy);
    let late = || samples.iter().filter(|sample| sample.time >= recording.measured_from);
    let voids: Vec<f64> = late().map(|sample| f64::from(sample.n_voids)).collect();
    let most = voids.iter().copied().reduce(f64::max).unwrap_or(f64::NAN);
    vec![
        ("run", "end", recording.end.unwrap_or(f64::NAN)),
        ("ledger", "error", if ledger < ROUND_OFF { decade_above(ledger) } else { ledger }),
        ("energy", "largest", energy),
        ("voids", "mean", voids.iter().sum::<f64>() / voids.len() as f64),
        ("voids", "most", most),
        ("points", "most-in-a-cell", largest(&|sample| f64::from(sample.most_points))),
        ("points", "in-the-body", largest(&|sample| f64::from(sample.n_inside))),
        ("speed", "largest", largest(&|sample| sample.largest_speed)),
    ]
}

#[cfg(test)]
mod tests {
    use super::*;

    /// 2 + 0.9 sin(2π 0.3 T), and noise that changes its sign with every value.
    fn wave(noise: f64) -> Vec<(f64, f64)> {
        let sign = |k: usize| if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        (0..1000)
            .map(|k| (k, 0.05 * k as f64))
            .map(|(k, t)| (t, 2.0 + 0.9 * (0.6 * std::f64::consts::PI * t).sin() + noise * sign(k)))
            .collect()
    }

    #[test]
    fn a_noisy_sine_has_its_frequency_and_amplitude() {
        for noise in [0.0, 0.1, 0.4] {
            let smooth = running_mean(&wave(noise), SMOOTH);
            let found = shedding(&smooth).expect("periods");
            assert!(found.periods >= PERIODS && found.periods < 15, "{found:?}");
            assert!((found.strouhal - 0.3).abs() < 1e-3, "{found:?}");
            let [upper, lower] = extremes(&smooth, &found);
            // The running mean takes 0.6 %, of the noise a fifth at most is left.
            let slack = 0.01 + 0.25 * noise;
            assert!((upper - 2.9).abs() < slack && (lower - 1.1).abs() < slack, "{upper} {lower}");
        }
    }

    #[test]
    fn noise_about_the_mean_makes_no_crossings() {
        let raw = upward_crossings(&wave(0.3)).len();
        assert!((14..=15).contains(&raw), "{raw}");
    }

    #[test]
    fn small_noise_of_a_steady_lift_has_no_frequency() {
        let noise: Vec<_> = wave(0.0).iter().map(|&(t, y)| (t, 0.2 * (y - 2.0))).collect();
        assert_eq!(shedding(&noise), None);
    }

    #[test]
    fn what_does_not_swing_has_no_frequency() {
        let still: Vec<_> = (0..100).map(|k| (f64::from(k), 1.0)).collect();
        assert_eq!(shedding(&still), None);
        assert_eq!(shedding(&[]), None);
        let ramp: Vec<_> = (0..100).map(|k| (f64::from(k), f64::from(k))).collect();
        assert_eq!(shedding(&ramp), None);
        assert!(mean(&[]).is_nan());
    }

    #[test]
    fn means_and_deviations_are_those_of_the_values() {
        let curve = [(0.0, 1.0), (1.0, 3.0)];
        assert_eq!((mean(&curve), deviation(&curve)), (2.0, 1.0));
        assert_eq!(from(&curve, 0.5), &curve[1..]);
        assert!(from(&curve, 2.0).is_empty());
    }
}
