//! Fields of the nodes at the points.

use std::ops::Range;

use super::CELL_GRAIN;
use crate::Scalar;
use crate::cells::Cells;
use crate::grid::Grid;
use crate::math::{add_row, narrow};
use crate::parallel::fold_blocks;
use crate::shape::ShapeFunction;
use crate::stencil::{Rows, for_each_outer_row, rows_at, shape_at_point, shape_in_cell};

/// Grid, active cells and shape functions.
type Space<'a, T, const D: usize, H> = (&'a Grid<T, D>, &'a Cells, &'a H);

/// Σ N q at every point, of a field q in the first entries of the nodes' rows. `rows` are the first nodes of the
/// stencil rows of each cell; points are given by positions and lengths, m.
pub fn interpolate<T: Scalar, const D: usize, H: ShapeFunction<T>>(
    space: Space<'_, T, D, H>,
    (rows, field): (&[u32], &[[T; 4]]),
    points: (&[[T; D]], &[[T; D]]),
    out: &mut [[T; D]],
) {
    at_points(space, rows, points, out, |at, starts| {
        let last = &at[D - 1];
        let mut sum = [T::zero(); 4];
        for_each_outer_row::<T, D, H>(at, |outer| {
            let start = starts[outer.row] as usize + last.first;
            for (k, node) in field[start..start + H::WIDTH].iter().enumerate() {
                add_row(&mut sum, outer.weight * last.weight[k], *node);
            }
        });
        narrow(sum)
    });
}

/// ∇·v at every point, 1/s, of velocities in the nodes' rows.
pub fn divergence_at_points<T: Scalar, const D: usize, H: ShapeFunction<T>>(
    space: Space<'_, T, D, H>,
    (rows, velocity): (&[u32], &[[T; 4]]),
    points: (&[[T; D]], &[[T; D]]),
    out: &mut [T],
) {
    at_points(space, rows, points, out, |at, starts| {
        divergence_at::<T, D, H>(at, starts, velocity)
    });
}

/// `[i][j] = ∂q_i/∂x_j` at every point, of a field q in the first entries of the nodes' rows.
pub fn gradients_at_points<T: Scalar, const D: usize, H: ShapeFunction<T>>(
    space: Space<'_, T, D, H>,
    (rows, field): (&[u32], &[[T; 4]]),
    points: (&[[T; D]], &[[T; D]]),
    out: &mut [[[T; D]; D]],
) {
    at_points(space, rows, points, out, |at, starts| {
        let last = &at[D - 1];
        let mut gradient = [[T::zero(); D]; D];
        for_each_outer_row::<T, D, H>(at, |outer| {
            let start = starts[outer.row] as usize + last.first;
            for (k, node) in field[start..start + H::WIDTH].iter().enumerate() {
                for axis in 0..D {
                    let slope = if axis == D - 1 {
                        outer.weight * last.gradient[k]
                    } else {
                        outer.replace(at, axis, &at[axis].gradient) * last.weight[k]
                    };
                    for row in 0..D {
                        gradient[row][axis] += slope * node[row];
                    }
                }
            }
        });
        gradient
    });
}

/// ∇·v at one place, given the functions there and the first node of each stencil row.
#[inline(always)]
pub(super) fn divergence_at<T: Scalar, const D: usize, H: ShapeFunction<T>>(
    at: &Rows<T, D>,
    starts: &[u32],
    velocity: &[[T; 4]],
) -> T {
    let last = &at[D - 1];
    let mut sum = T::zero();
    for_each_outer_row::<T, D, H>(at, |outer| {
        let start = starts[outer.row] as usize + last.first;
        for (k, v) in velocity[start..start + H::WIDTH].iter().enumerate() {
            for axis in 0..D - 1 {
                let gradient = outer.replace(at, axis, &at[axis].gradient);
                sum += gradient * last.weight[k] * v[axis];
            }
            sum += outer.weight * last.gradient[k] * v[D - 1];
        }
    });
    sum
}

/// Visits every point with the functions there and the first node of each stencil row.
fn at_points<T: Scalar, const D: usize, H: ShapeFunction<T>, A: Send>(
    (grid, cells, shape): Space<'_, T, D, H>,
    rows: &[u32],
    (position, length): (&[[T; D]], &[[T; D]]),
    out: &mut [A],
    value: impl Fn(&Rows<T, D>, &[u32]) -> A + Sync,
) {
    let n_rows = H::REACH.pow(D as u32 - 1);
    let cut = |slot: usize| cells.first[slot] as usize;
    let work = |slots: Range<usize>, part: &mut [A]| {
        let begin = cut(slots.start);
        for slot in slots {
            let cell = grid.cell_coordinates(cells.index[slot]);
            let shape = shape_in_cell(shape, grid, cells, cell);
            let starts = &rows[slot * n_rows..(slot + 1) * n_rows];
            for point in cells.points(slot) {
                let shape = shape_at_point(&shape, grid, length, point);
                let at = rows_at(&shape, grid, cell, position[point]);
                part[point - begin] = value(&at, starts);
            }
        }
    };
    fold_blocks(cells.len(), CELL_GRAIN, out, &cut, &work, &|(), ()| ());
}
