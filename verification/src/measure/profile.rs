//! A field along one axis, measured as a profile: errors, overshoot, total variation, front width.
//!
//! For fields that are functions of one coordinate x, given at scattered points of a strip of D
//! dimensions. Two views of the same points:
//!
//! ```text
//! points   sorted by x, ties by the other coordinates
//! columns  cells of the same x: mean value Σ V q / Σ V at the mean place Σ V x / Σ V
//! ```
//!
//! A value that is not a number makes every measure not a number, or counts as outside.

use anyhow::{Result, ensure};
use std::collections::BTreeMap;
use transpoint::scene::GridSpec;

/// One point of a profile.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Point {
    /// Coordinate x along the profile, m.
    pub position: f64,
    /// Value q of the field.
    pub value: f64,
    /// Volume V, m^D; the weight in norms and means.
    pub volume: f64,
    /// Column of cells that holds the point.
    column: usize,
    /// Row of cells that holds the point.
    row: usize,
}

/// Mean over the points in the cells of the same x.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Column {
    /// Mean place Σ V x / Σ V, m.
    pub position: f64,
    /// Mean value Σ V q / Σ V.
    pub value: f64,
    /// Volume Σ V, m^D.
    pub volume: f64,
}

/// Where a front is and how wide.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Front {
    /// Place of half the jump, m.
    pub position: f64,
    /// Distance from 90 % to 10 % of the jump, in cells; 0.8 where the jump is between neighbors.
    pub width: f64,
}

/// Points sorted along one axis, and their column means; empty columns are left out.
#[derive(Clone, Debug, PartialEq)]
pub struct Profile {
    spacing: f64,
    points: Vec<Point>,
    columns: Vec<Column>,
}

impl Profile {
    /// The profile along `axis` of `values` at `positions` (m) with `volumes` (m^D).
    ///
    /// Points outside the grid go to the nearest column and row.
    ///
    /// # Errors
    ///
    /// If there is no such axis, if the grid has no cells or a cell size that is not above 0, or if
    /// the slices differ in length.
    pub fn new<const D: usize>(
        grid: &GridSpec<D>,
        axis: usize,
        positions: &[[f64; D]],
        values: &[f64],
        volumes: &[f64],
    ) -> Result<Self> {
        ensure!(axis < D, "axis is {axis}; allowed: below {D}");
        ensure!(
            grid.spacing.iter().all(|&h| h > 0.0) && grid.cells.iter().all(|&n| n > 0),
            "grid has cells {:?} of size {:?}; allowed: above 0",
            grid.cells,
            grid.spacing
        );
        ensure!(
            values.len() == positions.len() && volumes.len() == positions.len(),
            "{} values and {} volumes for {} points; allowed: one each",
            values.len(),
            volumes.len(),
            positions.len()
        );
        let mut order: Vec<usize> = (0..positions.len()).collect();
        let others = |a: usize, b: usize| {
            positions[a].iter().zip(&positions[b]).map(|(a, b)| a.total_cmp(b)).find(|o| o.is_ne())
        };
        order.sort_by(|&a, &b| {
            let along = positions[a][axis].total_cmp(&positions[b][axis]);
            along.then_with(|| others(a, b).unwrap_or(a.cmp(&b)))
        });
        let points = order.into_iter().map(|i| {
            let (column, row) = column_and_row(grid, axis, &positions[i]);
            let (position, value, volume) = (positions[i][axis], values[i], volumes[i]);
            Point { position, value, volume, column, row }
        });
        Ok(Self::of(grid.spacing[axis], points.collect()))
    }

    fn of(spacing: f64, points: Vec<Point>) -> Self {
        let columns = points
            .chunk_by(|a, b| a.column == b.column)
            .map(|column| {
                let volume: f64 = column.iter().map(|p| p.volume).sum();
                let mean = |q: fn(&Point) -> f64| {
                    column.iter().map(|p| q(p) * p.volume).sum::<f64>() / volume
                };
                Column { position: mean(|p| p.position), value: mean(|p| p.value), volume }
            })
            .collect();
        Self { spacing, points, columns }
    }

    /// The part with from ≤ x ≤ to, m; for plateaus, and to leave walls out.
    #[must_use]
    pub fn within(&self, from: f64, to: f64) -> Self {
        let inside = |p: &&Point| p.position >= from && p.position <= to;
        Self::of(self.spacing, self.points.iter().filter(inside).copied().collect())
    }

    /// Points sorted by x.
    pub fn points(&self) -> &[Point] {
        &self.points
    }

    /// Column means sorted by x.
    pub fn columns(&self) -> &[Column] {
        &self.columns
    }

    /// Mean error Σ |q − q_exact(x)| V / Σ V over the points, in units of the field.
    pub fn l1(&self, exact: impl Fn(f64) -> f64) -> f64 {
        self.mean(|p| (p.value - exact(p.position)).abs())
    }

    /// Root mean square error √(Σ (q − q_exact(x))² V / Σ V) over the points.
    pub fn l2(&self, exact: impl Fn(f64) -> f64) -> f64 {
        self.mean(|p| (p.value - exact(p.position)).powi(2)).sqrt()
    }

    fn mean(&self, q: impl Fn(&Point) -> f64) -> f64 {
        let volume: f64 = self.points.iter().map(|p| p.volume).sum();
        self.points.iter().map(|p| q(p) * p.volume).sum::<f64>() / volume
    }

    /// Least and largest value of the points; not numbers if there is no point.
    pub fn limits(&self) -> [f64; 2] {
        let Some(first) = self.points.first() else { return [f64::NAN; 2] };
        self.points.iter().fold([first.value; 2], |[low, high], p| {
            if p.value.is_nan() {
                return [f64::NAN; 2];
            }
            // Comparisons with a bound that is not a number keep the bound.
            [if p.value < low { p.value } else { low }, if p.value > high { p.value } else { high }]
        })
    }

    /// max(0, max q − high) / (high − low) over the points.
    pub fn overshoot(&self, low: f64, high: f64) -> f64 {
        positive((self.limits()[1] - high) / (high - low))
    }

    /// max(0, low − min q) / (high − low) over the points.
    pub fn undershoot(&self, low: f64, high: f64) -> f64 {
        positive((low - self.limits()[0]) / (high - low))
    }

    /// Number of points outside `[low − tolerance, high + tolerance]`, in units of the field.
    pub fn n_outside(&self, low: f64, high: f64, tolerance: f64) -> usize {
        let inside = low - tolerance..=high + tolerance;
        self.points.iter().filter(|p| !inside.contains(&p.value)).count()
    }

    /// `tv-cells`: Σ |q_{c+1} − q_c| over the column means in the order of x.
    ///
    /// Blind to scatter within a column. |q_R − q_L| for a monotone profile.
    pub fn total_variation_cells(&self) -> f64 {
        self.columns.windows(2).map(|pair| (pair[1].value - pair[0].value).abs()).sum()
    }

    /// `tv-points`: Σ |q_{i+1} − q_i| over the points of one row of cells in the order of x, ties by
    /// the other coordinates; the mean over the rows of cells that hold points.
    ///
    /// The mean makes strips of different height comparable. Within a row of cells all points count
    /// as one sequence, so scatter across the row adds up: |q_R − q_L| for a monotone profile, but
    /// noise grows with the number of points per cell.
    pub fn total_variation_points(&self) -> f64 {
        let mut last: BTreeMap<usize, f64> = BTreeMap::new();
        let mut sum = 0.0;
        for point in &self.points {
            if let Some(previous) = last.insert(point.row, point.value) {
                sum += (point.value - previous).abs();
            }
        }
        sum / (last.len().max(1) as f64)
    }

    /// The front nearest to `near` (m) that leads from the value `left` to the value `right`.
    ///
    /// On the column means, with straight lines between them: the crossing of half the jump nearest
    /// to `near`; from there outwards to the first 90 % on the left and the first 10 % on the right.
    /// `None` if one of the three is not crossed.
    pub fn front(&self, near: f64, left: f64, right: f64) -> Option<Front> {
        // 1 on the left, 0 on the right, whether the front falls or rises.
        let share = |i: usize| (self.columns[i].value - right) / (left - right);
        let crossing = |i: usize, level: f64| {
            let part = (share(i) - level) / (share(i) - share(i + 1));
            let (a, b) = (self.columns[i].position, self.columns[i + 1].position);
            a + part * (b - a)
        };
        let n_pairs = self.columns.len().saturating_sub(1);
        let middle =
            (0..n_pairs).filter(|&i| share(i) > 0.5 && share(i + 1) <= 0.5).min_by(|&a, &b| {
                let distance = |i: usize| (crossing(i, 0.5) - near).abs();
                distance(a).total_cmp(&distance(b))
            })?;
        let start = (0..=middle).rev().find(|&i| share(i) >= 0.9 && share(i + 1) < 0.9)?;
        let end = (middle..n_pairs).find(|&i| share(i) > 0.1 && share(i + 1) <= 0.1)?;
        let width = (crossing(end, 0.1) - crossing(start, 0.9)) / self.spacing;
        Some(Front { position: crossing(middle, 0.5), width })
    }
}

/// max(0, a), not a number if a is not.
fn positive(a: f64) -> f64 {
    if a < 0.0 { 0.0 } else { a }
}

/// Cell index along `axis`, and flat index over the other axes.
fn column_and_row<const D: usize>(
    grid: &GridSpec<D>,
    axis: usize,
    position: &[f64; D],
) -> (usize, usize) {
    let (mut column, mut row) = (0, 0);
    for i in 0..D {
        let place = (position[i] - grid.origin[i]) / grid.spacing[i];
        // Negative and not a number become 0.
        let cell = (place as usize).min(grid.cells[i] - 1);
        if i == axis {
            column = cell;
        } else {
            row = row * grid.cells[i] + cell;
        }
    }
    (column, row)
}

#[cfg(test)]
mod tests;
