//! Outside truth under the names of this case: the volume-of-fluid runs.

use crate::cases::series;
use crate::reference::channel::{self, VofSpacing, VofTotal, WaterColumn};

/// Sizes of the cells of the volume-of-fluid runs with their names; the last is compared with.
pub(super) const RUNS: [(VofSpacing, &str); 2] =
    [(VofSpacing::Millimeters10, "VOF 10 mm"), (VofSpacing::Millimeters5, "VOF 5 mm")];
/// The run that is compared with.
const FINE: VofSpacing = VofSpacing::Millimeters5;

/// A total over time; empty if the data set is damaged, which its own test tells.
pub(super) fn curve(spacing: VofSpacing, quantity: VofTotal) -> Vec<(f64, f64)> {
    channel::total(spacing, quantity).map_or_else(|_| Vec::new(), |series| series.points)
}

/// Columns of water at an instant; none where there is no record.
pub(super) fn surface(spacing: VofSpacing, instant: f64) -> Vec<WaterColumn> {
    channel::surface(spacing, instant).unwrap_or_default()
}

/// Mass in the channel at an instant, kg. The last record is 3 ms before 4 s.
pub(super) fn mass(instant: f64) -> f64 {
    let curve = curve(FINE, VofTotal::Mass);
    let last = curve.last().map_or(f64::NAN, |point| point.0);
    series::at(&curve, if instant - last < 0.01 { instant.min(last) } else { instant })
}

/// Mean depth about x over a width at an instant, m; not a number without a record.
pub(super) fn depth(instant: f64, x: f64, width: f64) -> f64 {
    let columns = surface(FINE, instant);
    let near = columns.iter().filter(|column| (column.x - x).abs() < 0.5 * width);
    let (count, sum) = near.fold((0.0, 0.0), |(n, sum), column| (n + 1.0, sum + column.depth));
    sum / count
}

/// Time at which a mass has left, s, from the mass let in and the mass that is there.
pub(super) fn left(spacing: VofSpacing, mass: f64) -> f64 {
    let (entered, present) = (curve(spacing, VofTotal::MassIn), curve(spacing, VofTotal::Mass));
    let gone: Vec<_> = entered.iter().zip(&present).map(|(a, b)| (a.0, a.1 - b.1)).collect();
    series::first_above(&gone, 0.0, mass)
}
