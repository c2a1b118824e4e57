//! Which points are worth their cost, and what lies between them.

/// Indices of the points that no cheaper one beats, cheapest first; points that are not finite and positive are left
/// out.
///
/// ```
/// use verification::work_precision::front;
/// let points = [(1.0, 0.5), (2.0, 0.7), (3.0, 0.1), (2.0, 0.2), (4.0, f64::NAN)];
/// assert_eq!(front(&points), [0, 3, 2]);
/// ```
pub fn front(points: &[(f64, f64)]) -> Vec<usize> {
    let usable = |&(cost, error): &(f64, f64)| {
        cost > 0.0 && error > 0.0 && cost.is_finite() && error.is_finite()
    };
    let mut order: Vec<usize> = (0..points.len()).filter(|&i| usable(&points[i])).collect();
    order.sort_by(|&a, &b| {
        points[a].0.total_cmp(&points[b].0).then(points[a].1.total_cmp(&points[b].1))
    });
    let mut least = f64::INFINITY;
    order.retain(|&i| {
        let better = points[i].1 < least;
        least = least.min(points[i].1);
        better
    });
    order
}

/// Where a line of points, sorted by the first entry with the second one falling, crosses a value of the second:
/// between two points the logarithms are joined by straight lines. Nothing is extrapolated.
fn crossing(line: &[(f64, f64)], value: f64) -> Option<f64> {
    let after = line.iter().position(|point| point.1 <= value)?;
    if after == 0 {
        return Some(line[0].0);
    }
    let ((x0, y0), (x1, y1)) = (line[after - 1], line[after]);
    let share = (y0.ln() - value.ln()) / (y0.ln() - y1.ln());
    Some((x0.ln() + share * (x1.ln() - x0.ln())).exp())
}

/// The points of a front in its order.
fn along(points: &[(f64, f64)]) -> Vec<(f64, f64)> {
    front(points).into_iter().map(|i| points[i]).collect()
}

/// Cost at which (cost, error) points reach an error; the least cost measured if all of them do, `None` if none does.
///
/// ```
/// use verification::work_precision::cost_at_error;
/// let points = [(1.0, 0.1), (100.0, 0.001)];
/// assert!((cost_at_error(&points, 0.01).unwrap() - 10.0).abs() < 1e-12);
/// assert_eq!(cost_at_error(&points, 0.0001), None);
/// ```
pub fn cost_at_error(points: &[(f64, f64)], error: f64) -> Option<f64> {
    crossing(&along(points), error)
}

/// Error that (cost, error) points reach at a cost; the least error measured if all are cheaper, `None` if all are
/// dearer.
///
/// ```
/// use verification::work_precision::error_at_cost;
/// let points = [(1.0, 0.1), (100.0, 0.001)];
/// assert!((error_at_cost(&points, 10.0).unwrap() - 0.01).abs() < 1e-12);
/// assert_eq!(error_at_cost(&points, 0.5), None);
/// ```
pub fn error_at_cost(points: &[(f64, f64)], cost: f64) -> Option<f64> {
    let mut line: Vec<(f64, f64)> =
        along(points).into_iter().map(|(cost, error)| (error, cost)).collect();
    line.reverse();
    crossing(&line, cost)
}
