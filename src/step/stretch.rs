//! Lengths that points carry along.

use std::marker::PhantomData;

use super::CELL_GRAIN;
use super::gather::Site;
use crate::Scalar;
use crate::cells::Cells;
use crate::grid::Grid;
use crate::parallel::fold_blocks;
use crate::shape::{MAX_WIDTH, ShapeFunction};
use crate::simd::vectorized;
use crate::stencil::{rows_at, shape_at_point, shape_in_cell};

/// Stretches the points' lengths with the flow: l_i ← l_i (1 + Δt ∂v_i/∂x_i), after \[Ma2009\].
///
/// `rows` are the first nodes of the stencil rows of each cell, `velocity` the nodes' velocity in m/s, `stretched` the
/// lengths, to be changed.
pub fn stretch<T: Scalar, const D: usize, H: ShapeFunction<T>>(
    (grid, cells, shape): (&Grid<T, D>, &Cells, &H),
    (rows, velocity, dt): (&[u32], &[[T; 4]], T),
    (position, length): (&[[T; D]], &[[T; D]]),
    stretched: &mut [[T; D]],
) {
    let n_rows = H::REACH.pow(D as u32 - 1);
    let moments = [[T::zero(); MAX_WIDTH]; D];
    let work = |slots: std::ops::Range<usize>, part: &mut [[T; D]]| {
        let begin = cells.first[slots.start] as usize;
        vectorized!(D, simd => {
            for slot in slots {
                let cell = grid.cell_coordinates(cells.index[slot]);
                let shape = shape_in_cell(shape, grid, cells, cell);
                let starts = &rows[slot * n_rows..(slot + 1) * n_rows];
                for point in cells.points(slot) {
                    let shape = shape_at_point(&shape, grid, length, point);
                    let at = rows_at(&shape, grid, cell, position[point]);
                    let site = Site::<T, D, H> {
                        rows: &at,
                        moments: &moments,
                        starts,
                        shape: PhantomData,
                    };
                    let gradient = site.velocity_gradient(simd, velocity);
                    for axis in 0..D {
                        part[point - begin][axis] *= T::one() + dt * gradient[axis][axis];
                    }
                }
            }
        });
    };
    let cut = |slot: usize| cells.first[slot] as usize;
    fold_blocks(cells.len(), CELL_GRAIN, stretched, &cut, &work, &|(), ()| ());
}
