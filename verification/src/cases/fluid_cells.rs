//! What the cells of a plane grid hold, for measures that are the same for every method: volumes, depths,
//! pressures and the wet part.

use transpoint::scene::GridSpec;
use transpoint::simulation::PointState;
use transpoint::{InvalidInput, Simulation};

use crate::case::Raster;

/// Volumes and pressures of the cells of a plane grid.
///
/// The volume m/ρ of each point fills a square about its position; what of it lies beyond the grid counts in
/// the nearest cell.
#[derive(Clone, Debug)]
pub struct FluidCells {
    grid: GridSpec<2>,
    /// Edge of the squares, m.
    edge: f64,
    /// m², by columns as the grid numbers its cells.
    volumes: Vec<f64>,
    /// Number of points and Σ p, Pa.
    pressures: Vec<(u32, f64)>,
    /// Highest point of each column, m; not a number without one.
    tops: Vec<f64>,
}

impl FluidCells {
    /// Cells without points; `edge` (m) is at most a cell.
    pub fn new(grid: &GridSpec<2>, edge: f64) -> Self {
        let n = grid.cells[0] * grid.cells[1];
        Self {
            grid: grid.clone(),
            edge,
            volumes: vec![0.0; n],
            pressures: vec![(0, 0.0); n],
            tops: vec![f64::NAN; grid.cells[0]],
        }
    }

    /// The cells of a simulation.
    pub fn of(grid: &GridSpec<2>, edge: f64, simulation: &dyn Simulation<2>) -> Self {
        let mut cells = Self::new(grid, edge);
        simulation.visit_points(&mut |point| cells.add(point));
        cells
    }

    /// Adds a point.
    pub fn add(&mut self, point: &PointState<2>) {
        let [x, y] = [0, 1].map(|axis| self.shares(point.position[axis], axis));
        for (column, along) in x {
            for (row, up) in y {
                let cell = self.cell(column, row);
                self.volumes[cell] += point.volume() * along * up;
            }
        }
        let [column, row] = [0, 1].map(|axis| self.index(point.position[axis], axis));
        let cell = self.cell(column, row);
        let (count, sum) = &mut self.pressures[cell];
        *count += 1;
        *sum += point.pressure;
        self.tops[column] = self.tops[column].max(point.position[1]);
    }

    const fn cell(&self, column: usize, row: usize) -> usize {
        column * self.grid.cells[1] + row
    }

    /// Index of the cell along an axis; beyond the grid the last one.
    fn index(&self, at: f64, axis: usize) -> usize {
        let place = (at - self.grid.origin[axis]) / self.grid.spacing[axis];
        // Conversion from `f64` saturates.
        (place.floor() as usize).min(self.grid.cells[axis] - 1)
    }

    /// The two cells along an axis that a square lies in, with its shares.
    fn shares(&self, at: f64, axis: usize) -> [(usize, f64); 2] {
        let half = 0.5 * self.edge;
        let first = self.index(at - half, axis);
        let next = (first + 1).min(self.grid.cells[axis] - 1);
        let face = self.grid.origin[axis] + self.grid.spacing[axis] * (first + 1) as f64;
        let beyond = ((at + half - face) / self.edge).clamp(0.0, 1.0);
        [(first, 1.0 - beyond), (next, beyond)]
    }

    /// Middle of a column of cells, m.
    pub fn column_center(&self, column: usize) -> f64 {
        self.grid.origin[0] + self.grid.spacing[0] * (column as f64 + 0.5)
    }

    /// Middle of each column and volume in it over its width, m.
    pub fn depths(&self) -> Vec<(f64, f64)> {
        let rows = self.grid.cells[1];
        let depth = |(column, volumes): (usize, &[f64])| {
            let volume: f64 = volumes.iter().sum();
            (self.column_center(column), volume / self.grid.spacing[0])
        };
        self.volumes.chunks(rows).enumerate().map(depth).collect()
    }

    /// Middle of each column and upper edge of the square of its highest point, m.
    pub fn tops(&self) -> Vec<(f64, f64)> {
        let top =
            |(column, top): (usize, &f64)| (self.column_center(column), top + 0.5 * self.edge);
        self.tops.iter().enumerate().map(top).collect()
    }

    /// Mean pressure of the points of each cell from column `first` on, with the ends of its scale, Pa.
    ///
    /// # Errors
    /// When the grid makes no picture.
    pub fn pressure(
        &self,
        name: String,
        first: usize,
        bounds: [f64; 2],
    ) -> Result<Raster, InvalidInput> {
        let [columns, rows] = self.grid.cells;
        let mut values = Vec::with_capacity((columns - first) * rows);
        for row in 0..rows {
            for column in first..columns {
                let (count, sum) = self.pressures[self.cell(column, row)];
                values.push((count > 0).then(|| sum / f64::from(count)));
            }
        }
        let [h, up] = self.grid.spacing;
        let origin = [self.grid.origin[0] + h * first as f64, self.grid.origin[1]];
        Raster::field(name, [columns - first, rows], origin, [h, up], bounds, &values)
    }

    /// The fluid's share of a cell, at most 1; beyond the grid that of the nearest cell.
    fn fraction(&self, [column, row]: [isize; 2]) -> f64 {
        let [columns, rows] = self.grid.cells;
        let clamp = |index: isize, n: usize| index.clamp(0, n as isize - 1) as usize;
        let [h, up] = self.grid.spacing;
        (self.volumes[self.cell(clamp(column, columns), clamp(row, rows))] / (h * up)).min(1.0)
    }

    /// Whether a place is wet: whether the shares of the cells, bilinear between their centers, are at least
    /// ½ there, which is also where a volume-of-fluid run has its surface.
    pub fn is_wet(&self, place: [f64; 2]) -> bool {
        let at: [f64; 2] = std::array::from_fn(|axis| {
            (place[axis] - self.grid.origin[axis]) / self.grid.spacing[axis] - 0.5
        });
        let base = at.map(f64::floor);
        let mut fraction = 0.0;
        for corner in [[0, 0], [0, 1], [1, 0], [1, 1]] {
            let weight: f64 = (0..2)
                .map(|axis| {
                    let along = at[axis] - base[axis];
                    if corner[axis] == 1 { along } else { 1.0 - along }
                })
                .product();
            let cell = std::array::from_fn(|axis| base[axis] as isize + corner[axis]);
            fraction += weight * self.fraction(cell);
        }
        fraction >= 0.5
    }
}

#[cfg(test)]
mod tests {
    use super::*;

    fn point(position: [f64; 2], volume: f64, pressure: f64) -> PointState<2> {
        PointState {
            id: 0,
            position,
            velocity: [0.0; 2],
            density: 1000.0,
            pressure,
            mass: 1000.0 * volume,
            energy: 0.0,
            stress: [[0.0; 2]; 2],
            velocity_gradient: [[0.0; 2]; 2],
            density_slope: [0.0; 2],
        }
    }

    /// Cells of 1 m from x = −1, the lower two rows of the first three columns full of four points each.
    fn block() -> FluidCells {
        let grid = GridSpec { origin: [-1.0, 0.0], spacing: [1.0; 2], cells: [6, 4] };
        let mut cells = FluidCells::new(&grid, 0.5);
        for i in 0..6 {
            for j in 0..4 {
                let place = [-0.75 + 0.5 * f64::from(i), 0.25 + 0.5 * f64::from(j)];
                cells.add(&point(place, 0.25, 10.0 * place[0]));
            }
        }
        cells
    }

    #[test]
    fn a_block_is_as_deep_and_as_high_as_it_is() {
        let cells = block();
        let expected = [2.0, 2.0, 2.0, 0.0, 0.0, 0.0];
        for ((x, depth), (column, expected)) in cells.depths().into_iter().zip((0..).zip(expected))
        {
            assert_eq!(x, f64::from(column) - 0.5);
            assert!((depth - expected).abs() < 1e-12);
        }
        let tops = cells.tops();
        assert_eq!(tops[0], (-0.5, 2.0));
        assert!(tops[3].1.is_nan());
        for (place, wet) in
            [([0.0, 0.1], true), ([1.99, 1.0], true), ([1.0, 1.99], true), ([2.01, 1.0], false)]
        {
            assert_eq!(cells.is_wet(place), wet, "{place:?}");
        }
        assert!(cells.is_wet([-0.9, 1.9]) && !cells.is_wet([0.5, 2.1]));
    }

    #[test]
    fn squares_across_faces_and_walls_keep_their_volume() {
        let grid = GridSpec { origin: [0.0; 2], spacing: [1.0; 2], cells: [3, 2] };
        let mut cells = FluidCells::new(&grid, 0.5);
        cells.add(&point([1.1, 0.1], 1.0, 5.0));
        assert!((cells.volumes[0] - 0.3).abs() < 1e-12 && (cells.volumes[2] - 0.7).abs() < 1e-12);
        cells.add(&point([2.9, 1.9], 2.0, 7.0));
        assert!((cells.volumes.iter().sum::<f64>() - 3.0).abs() < 1e-12);
        // A square as large as a cell stays in it, whatever the rounding of its sides.
        let grid = GridSpec { origin: [-1e-3, 0.0], spacing: [1e-3; 2], cells: [40, 10] };
        let mut cells = FluidCells::new(&grid, 1e-3);
        for column in 0..40 {
            cells.add(&point([(f64::from(column) - 0.5) * 1e-3, 4.5e-3], 1e-6, 0.0));
        }
        assert!(cells.depths().iter().all(|&(_, depth)| (depth - 1e-3).abs() < 1e-12));
    }

    #[test]
    fn pictures_leave_out_the_first_columns() {
        let raster = block().pressure("p".to_owned(), 1, [0.0, 20.0]).expect("a picture");
        assert_eq!((raster.columns, raster.rows, raster.origin), (5, 4, [0.0, 0.0]));
        let mean = |code: u8| f64::from(code - Raster::LOWER) / 253.0 * 20.0;
        assert!((mean(raster.values[0]) - 5.0).abs() < 0.05);
        assert_eq!(raster.values[2], Raster::EMPTY);
    }
}
