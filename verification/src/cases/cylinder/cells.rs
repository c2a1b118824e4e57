//! Means over the points of each cell, and the maps of them.

use transpoint::scene::{BodyShape, GridSpec};
use transpoint::{InvalidInput, Simulation};

use super::scene::{DENSITY, DIAMETER, SPEED};
use crate::case::Raster;

/// Ends of the scales: ω D/U and p/(ρ₀ U²).
const VORTICITY: [f64; 2] = [-6.0, 6.0];
const PRESSURE: [f64; 2] = [-1.5, 1.5];

/// Sums over the points of a cell.
#[derive(Clone, Copy, Debug, Default)]
struct Sums {
    count: u32,
    velocity: [f64; 2],
    pressure: f64,
}

/// What was counted in the cells.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub(super) struct Counts {
    /// Cells of the fluid without points.
    pub(super) voids: u32,
    /// Most points in a cell.
    pub(super) most: u32,
    /// Points in cells of the cylinder.
    pub(super) inside: u32,
}

/// The cells of a run, by columns.
pub(super) struct Cells {
    grid: GridSpec<2>,
    solid: Vec<bool>,
    sums: Vec<Sums>,
    /// Largest speed of a point, m/s.
    pub(super) largest_speed: f64,
}

impl Cells {
    pub(super) fn new(grid: GridSpec<2>, shape: BodyShape<2>) -> Self {
        let [columns, rows] = grid.cells;
        let center = |cell: usize| {
            let at = [cell / rows, cell % rows];
            std::array::from_fn(|axis| grid.spacing[axis] * (at[axis] as f64 + 0.5))
        };
        let solid = (0..columns * rows).map(|cell| shape.level(center(cell)) < 0.0).collect();
        Self { solid, sums: vec![Sums::default(); columns * rows], grid, largest_speed: 0.0 }
    }

    /// Sums over the points as they are.
    pub(super) fn look(&mut self, simulation: &dyn Simulation<2>) {
        let Self { grid, sums, largest_speed, .. } = self;
        sums.fill(Sums::default());
        *largest_speed = 0.0;
        simulation.visit_points(&mut |point| {
            let at: [usize; 2] = std::array::from_fn(|axis| {
                let place = (point.position[axis] / grid.spacing[axis]).floor();
                (place.max(0.0) as usize).min(grid.cells[axis] - 1)
            });
            let sum = &mut sums[at[0] * grid.cells[1] + at[1]];
            sum.count += 1;
            sum.pressure += point.pressure;
            for (total, v) in sum.velocity.iter_mut().zip(point.velocity) {
                *total += v;
            }
            let speed = point.velocity.iter().map(|v| v * v).sum::<f64>().sqrt();
            *largest_speed = largest_speed.max(speed);
        });
    }

    pub(super) fn count(&self) -> Counts {
        let mut counts = Counts::default();
        for (sum, &solid) in self.sums.iter().zip(&self.solid) {
            counts.most = counts.most.max(sum.count);
            counts.voids += u32::from(!solid && sum.count == 0);
            counts.inside += if solid { sum.count } else { 0 };
        }
        counts
    }

    /// Mean velocity of a cell; zero in the cylinder, none in a void and beyond the channel.
    fn velocity(&self, column: Option<usize>, row: Option<usize>) -> Option<[f64; 2]> {
        let [columns, rows] = self.grid.cells;
        let (column, row) = (column.filter(|&c| c < columns)?, row.filter(|&r| r < rows)?);
        let cell = column * rows + row;
        let sum = self.sums[cell];
        if self.solid[cell] {
            return Some([0.0; 2]);
        }
        (sum.count > 0).then(|| sum.velocity.map(|v| v / f64::from(sum.count)))
    }

    /// ∂v/∂x − ∂u/∂y by central differences of the means, 1/s.
    fn vorticity(&self, column: usize, row: usize) -> Option<f64> {
        let [hx, hy] = self.grid.spacing;
        let [left, right] = [column.checked_sub(1), Some(column + 1)]
            .map(|column| self.velocity(column, Some(row)));
        let [below, above] =
            [row.checked_sub(1), Some(row + 1)].map(|row| self.velocity(Some(column), row));
        Some((right?[1] - left?[1]) / (2.0 * hx) - (above?[0] - below?[0]) / (2.0 * hy))
    }

    /// Maps of the vorticity and of the pressure.
    ///
    /// # Errors
    /// When a map cannot be put on record.
    pub(super) fn rasters(&self) -> Result<Vec<Raster>, InvalidInput> {
        let [columns, rows] = self.grid.cells;
        let map = |name: &str, bounds: [f64; 2], value: &dyn Fn(usize, usize) -> Option<f64>| {
            let values: Vec<Option<f64>> = (0..rows)
                .flat_map(|row| (0..columns).map(move |column| (column, row)))
                .map(|(column, row)| {
                    let fluid = !self.solid[column * rows + row];
                    fluid.then(|| value(column, row)).flatten()
                })
                .collect();
            Raster::field(
                name,
                self.grid.cells,
                self.grid.origin,
                self.grid.spacing,
                bounds,
                &values,
            )
        };
        let pressure = |column: usize, row: usize| {
            let sum = self.sums[column * rows + row];
            let mean = sum.pressure / f64::from(sum.count) / (DENSITY * SPEED * SPEED);
            (sum.count > 0).then_some(mean)
        };
        let vorticity = |column: usize, row: usize| {
            self.vorticity(column, row).map(|vorticity| vorticity * DIAMETER / SPEED)
        };
        Ok(vec![map("vorticity", VORTICITY, &vorticity)?, map("pressure", PRESSURE, &pressure)?])
    }
}
