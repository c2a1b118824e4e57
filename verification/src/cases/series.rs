//! Measures of curves over time.

/// A curve: times and values, times ascending.
pub type Curve = [(f64, f64)];

/// How far a curve may end before a range and still cover it.
const SLACK: f64 = 0.02;

/// The values within a range; none where the curve ends before it.
pub fn within(curve: &Curve, from: f64, to: f64) -> &Curve {
    if curve.last().is_none_or(|last| last.0 < to - SLACK) {
        return &[];
    }
    let begin = curve.partition_point(|&(time, _)| time < from);
    let end = curve.partition_point(|&(time, _)| time <= to);
    &curve[begin..end]
}

/// The integral over a range by the trapezoidal rule; not a number where the curve does not cover it.
pub fn impulse(curve: &Curve, from: f64, to: f64) -> f64 {
    let part = within(curve, from, to);
    if part.len() < 2 {
        return f64::NAN;
    }
    part.windows(2).map(|pair| 0.5 * (pair[1].0 - pair[0].0) * (pair[0].1 + pair[1].1)).sum()
}

/// Mean over a range; not a number where the curve does not cover it.
pub fn mean(curve: &Curve, from: f64, to: f64) -> f64 {
    let part = within(curve, from, to);
    match (part.first(), part.last()) {
        (Some(first), Some(last)) => impulse(curve, from, to) / (last.0 - first.0),
        _ => f64::NAN,
    }
}

/// At each value the mean of all that are at most half a `width` away.
pub fn running_mean(curve: &Curve, width: f64) -> Vec<(f64, f64)> {
    let reach = 0.5 * width;
    let (mut begin, mut end) = (0, 0);
    let smooth = |&(time, _): &(f64, f64)| {
        while curve[begin].0 < time - reach {
            begin += 1;
        }
        while end < curve.len() && curve[end].0 <= time + reach {
            end += 1;
        }
        let part = &curve[begin..end];
        (time, part.iter().map(|point| point.1).sum::<f64>() / part.len() as f64)
    };
    curve.iter().map(smooth).collect()
}

/// Where a curve is largest within a range, and its value there.
pub fn largest(curve: &Curve, from: f64, to: f64) -> (f64, f64) {
    let part = within(curve, from, to).iter().copied();
    part.reduce(|a, b| if b.1 > a.1 { b } else { a }).unwrap_or((f64::NAN, f64::NAN))
}

/// The first time from `from` on at which a curve exceeds a value.
pub fn first_above(curve: &Curve, from: f64, value: f64) -> f64 {
    let found = curve.iter().find(|point| point.0 >= from && point.1 > value);
    found.map_or(f64::NAN, |point| point.0)
}

/// Root mean square over a range of a curve minus its running mean.
pub fn noise(curve: &Curve, smooth: &Curve, from: f64, to: f64) -> f64 {
    let (raw, smooth) = (within(curve, from, to), within(smooth, from, to));
    let squares = raw.iter().zip(smooth).map(|(raw, smooth)| (raw.1 - smooth.1).powi(2));
    // Without values 0/0 is not a number.
    (squares.sum::<f64>() / raw.len() as f64).sqrt()
}

/// The value at an instant, linear between those of the curve; not a number outside.
pub fn at(curve: &Curve, time: f64) -> f64 {
    let next = curve.partition_point(|point| point.0 < time);
    match (next.checked_sub(1).and_then(|k| curve.get(k)), curve.get(next)) {
        (Some(a), Some(b)) => a.1 + (b.1 - a.1) * (time - a.0) / (b.0 - a.0),
        (None, Some(b)) if b.0 == time => b.1,
        _ => f64::NAN,
    }
}

/// Root mean square over a range of the difference of two curves, at the values of the first.
pub fn deviation(curve: &Curve, reference: &Curve, from: f64, to: f64) -> f64 {
    let part = within(curve, from, to);
    let squares = part.iter().map(|&(time, value)| (value - at(reference, time)).powi(2));
    (squares.sum::<f64>() / part.len() as f64).sqrt()
}

#[cfg(test)]
mod tests {
    use super::*;

    fn line(slope: f64) -> Vec<(f64, f64)> {
        (0..=400).map(|k| f64::from(k) * 0.01).map(|time| (time, slope * time)).collect()
    }

    #[test]
    fn means_and_impulses_of_a_line_are_exact() {
        let curve = line(2.0);
        assert!((impulse(&curve, 1.0, 3.0) - 8.0).abs() < 1e-12);
        assert!((mean(&curve, 1.0, 3.0) - 4.0).abs() < 1e-12);
        // No value lies at the very end of a window, where round-off would decide.
        let smooth = running_mean(&curve, 0.105);
        assert!((at(&smooth, 2.0) - 4.0).abs() < 1e-12);
        assert!(noise(&curve, &smooth, 1.0, 3.0) < 1e-12);
        assert!((deviation(&curve, &line(1.0), 0.0, 4.0) - 4.0 / 3.0_f64.sqrt()).abs() < 0.01);
    }

    #[test]
    fn a_curve_that_ends_early_has_no_value() {
        let curve = line(1.0);
        assert!(mean(&curve, 3.0, 4.5).is_nan() && impulse(&curve, 3.0, 4.5).is_nan());
        assert!(largest(&curve, 3.0, 4.5).1.is_nan() && noise(&curve, &curve, 3.0, 5.0).is_nan());
        assert!(mean(&[], 0.0, 1.0).is_nan() && at(&[], 0.0).is_nan());
        assert!(running_mean(&[], 0.1).is_empty());
    }

    #[test]
    fn peaks_and_arrivals_are_found() {
        let curve: Vec<_> = line(1.0).iter().map(|&(t, _)| (t, 1.0 - (t - 2.9).abs())).collect();
        let (time, value) = largest(&curve, 2.5, 3.5);
        assert!((time - 2.9).abs() < 1e-12 && (value - 1.0).abs() < 1e-12);
        assert!((first_above(&curve, 1.0, 0.5) - 2.41).abs() < 0.011);
        assert!(first_above(&curve, 0.0, 2.0).is_nan());
    }

    #[test]
    fn an_alternating_part_is_noise() {
        let sign = |k: usize| if k.is_multiple_of(2) { 1.0 } else { -1.0 };
        let curve: Vec<_> =
            line(1.0).into_iter().enumerate().map(|(k, (t, y))| (t, y + 0.1 * sign(k))).collect();
        let found = noise(&curve, &running_mean(&curve, 0.105), 1.0, 3.0);
        assert!((found - 0.1).abs() < 0.011, "{found}");
    }
}
