//! Pictures of means over the points of cells.

use transpoint::scene::GridSpec;
use transpoint::{InvalidInput, Simulation};

use crate::case::Raster;

/// Mean pressure over the points of each cell in units of `scale` (Pa), with the ends of its scale.
///
/// # Errors
/// When the grid makes no picture.
pub fn pressure(
    name: &str,
    grid: &GridSpec<2>,
    simulation: &dyn Simulation<2>,
    scale: f64,
    ends: [f64; 2],
) -> Result<Raster, InvalidInput> {
    let [columns, rows] = grid.cells;
    let mut sums = vec![(0_u32, 0.0); columns * rows];
    simulation.visit_points(&mut |point| {
        let [column, row] = std::array::from_fn(|axis| {
            let place = (point.position[axis] - grid.origin[axis]) / grid.spacing[axis];
            (place as usize).min(grid.cells[axis] - 1)
        });
        let sum = &mut sums[row * columns + column];
        *sum = (sum.0 + 1, sum.1 + point.pressure / scale);
    });
    let mean = |&(count, sum): &(u32, f64)| (count > 0).then(|| sum / f64::from(count));
    let values: Vec<_> = sums.iter().map(mean).collect();
    Raster::field(name, grid.cells, grid.origin, grid.spacing, ends, &values)
}
