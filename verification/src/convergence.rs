//! Observed orders of convergence.

use serde::Serialize;

use crate::number::nullable;
use crate::record::RunRecord;

/// Observed order of one error.
#[derive(Clone, Debug, PartialEq, Serialize)]
pub struct Order {
    /// Name of the case.
    pub case: String,
    /// Name of the method.
    pub variant: String,
    /// Arrangement of the points.
    pub layout: String,
    /// Quantity, `quantity@instant` where a case has several instants.
    pub quantity: String,
    /// Norm.
    pub norm: String,
    /// Least-squares slope over all levels; not a number if a level has no error.
    #[serde(with = "nullable")]
    pub order: f64,
    /// Slope between the two finest levels.
    #[serde(with = "nullable")]
    pub order_last: f64,
    /// Number of levels.
    pub levels: usize,
}

/// Errors of one method, quantity and norm against cell size, coarsest first.
#[derive(Clone, Debug, PartialEq)]
pub struct Series {
    /// Name of the case.
    pub case: String,
    /// Name of the method.
    pub variant: String,
    /// Arrangement of the points.
    pub layout: String,
    /// Quantity.
    pub quantity: String,
    /// Norm.
    pub norm: String,
    /// (h, error) per level; the error is not a number where the run blew up.
    pub points: Vec<(f64, f64)>,
}

impl Series {
    /// The observed order of this series.
    pub fn order(&self) -> Order {
        let tail = self.points.len().saturating_sub(2);
        Order {
            case: self.case.clone(),
            variant: self.variant.clone(),
            layout: self.layout.clone(),
            quantity: self.quantity.clone(),
            norm: self.norm.clone(),
            order: slope(&self.points),
            order_last: slope(&self.points[tail..]),
            levels: self.points.len(),
        }
    }
}

/// Least-squares slope of ln y over ln x; not a number with fewer than two different x, or if any
/// value is not positive and finite.
///
/// ```
/// use verification::convergence::slope;
/// assert!((slope(&[(0.1, 0.03), (0.2, 0.12), (0.4, 0.48)]) - 2.0).abs() < 1e-12);
/// assert!(slope(&[(0.1, f64::NAN), (0.2, 1.0)]).is_nan());
/// ```
pub fn slope(points: &[(f64, f64)]) -> f64 {
    let n = points.len() as f64;
    let logs: Vec<(f64, f64)> = points.iter().map(|&(x, y)| (x.ln(), y.ln())).collect();
    if logs.iter().any(|(x, y)| !x.is_finite() || !y.is_finite()) {
        return f64::NAN;
    }
    let mean_x = logs.iter().map(|(x, _)| x).sum::<f64>() / n;
    let mean_y = logs.iter().map(|(_, y)| y).sum::<f64>() / n;
    let variance: f64 = logs.iter().map(|(x, _)| (x - mean_x).powi(2)).sum();
    let covariance: f64 = logs.iter().map(|(x, y)| (x - mean_x) * (y - mean_y)).sum();
    if variance > 0.0 { covariance / variance } else { f64::NAN }
}

/// Collects one series per method, layout, quantity and norm, in the order of first appearance.
pub fn series<'a>(records: impl IntoIterator<Item = &'a RunRecord>) -> Vec<Series> {
    let mut all: Vec<Series> = Vec::new();
    for record in records {
        let spec = &record.spec;
        for row in &record.rows {
            let found = all.iter_mut().find(|series| {
                (series.case == spec.case)
                    && (series.variant == spec.variant)
                    && (series.layout == spec.layout)
                    && (series.quantity == row.quantity)
                    && (series.norm == row.norm)
            });
            let point = (spec.spacing, row.value);
            match found {
                Some(series) => series.points.push(point),
                None => all.push(Series {
                    case: spec.case.clone(),
                    variant: spec.variant.clone(),
                    layout: spec.layout.clone(),
                    quantity: row.quantity.clone(),
                    norm: row.norm.clone(),
                    points: vec![point],
                }),
            }
        }
    }
    for series in &mut all {
        series.points.sort_by(|a, b| b.0.total_cmp(&a.0));
    }
    all
}

/// The observed order of every series of the records.
pub fn orders<'a>(records: impl IntoIterator<Item = &'a RunRecord>) -> Vec<Order> {
    series(records).iter().map(Series::order).collect()
}
