//! The nodes around a point, row by row.

use crate::Scalar;
use crate::grid::Grid;
use crate::shape::{MAX_WIDTH, Row, ShapeFunction};

/// Rows of shape functions of one point, with derivatives per metre.
pub type Rows<T, const D: usize> = [Row<T>; D];

/// Evaluates the shape functions at a position within a known cell.
#[inline(always)]
pub fn rows_at<T: Scalar, const D: usize, S: ShapeFunction<T>>(
    shape: &S,
    grid: &Grid<T, D>,
    cell: [usize; D],
    position: [T; D],
) -> Rows<T, D> {
    let zero = [T::zero(); MAX_WIDTH];
    let mut rows = [Row { first: 0, weight: zero, gradient: zero }; D];
    for axis in 0..D {
        rows[axis] = shape.row(grid.axis_position(position, cell, axis));
        for k in 0..S::WIDTH {
            rows[axis].gradient[k] *= grid.inverse_spacing[axis];
        }
    }
    rows
}

/// Evaluates the shape functions at the centre of a cell.
#[inline(always)]
pub fn rows_at_center<T: Scalar, const D: usize, S: ShapeFunction<T>>(
    shape: &S,
    grid: &Grid<T, D>,
    cell: [usize; D],
) -> Rows<T, D> {
    let center = std::array::from_fn(|axis| {
        grid.origin[axis] + grid.spacing[axis] * (T::from_index(cell[axis]) + T::lit(0.5))
    });
    rows_at(shape, grid, cell, center)
}

/// Coordinates of the nodes of a cell's stencil along each axis, m.
#[inline(always)]
pub fn node_positions<T: Scalar, const D: usize, S: ShapeFunction<T>>(
    shape: &S,
    grid: &Grid<T, D>,
    cell: [usize; D],
) -> [[T; MAX_WIDTH]; D] {
    let mut at = [[T::zero(); MAX_WIDTH]; D];
    for axis in 0..D {
        for k in 0..S::REACH {
            let node = cell[axis] + k;
            let coordinate = shape.node_coordinate(node, grid.n_cells[axis], grid.periodic[axis]);
            at[axis][k] = grid.origin[axis] + grid.spacing[axis] * coordinate;
        }
    }
    at
}

/// One stencil row: fixed indices along all axes but the last.
#[derive(Clone, Copy, Debug)]
pub struct OuterRow<T, const D: usize> {
    /// Number of the row within the cell's stencil.
    pub row: usize,
    /// Product of the weights of the outer axes.
    pub weight: T,
    /// Index along each outer axis.
    pub index: [usize; D],
}

impl<T: Scalar, const D: usize> OuterRow<T, D> {
    /// The product of weights with `values` in place of the weight along `axis`.
    #[inline(always)]
    pub fn replace(&self, rows: &Rows<T, D>, axis: usize, values: &[T; MAX_WIDTH]) -> T {
        let mut product = values[self.index[axis]];
        for other in 0..D - 1 {
            if other != axis {
                product *= rows[other].weight[self.index[other]];
            }
        }
        product
    }
}

/// Visits the stencil rows that a point touches.
#[inline(always)]
pub fn for_each_outer_row<T: Scalar, const D: usize, S: ShapeFunction<T>>(
    rows: &Rows<T, D>,
    mut visit: impl FnMut(OuterRow<T, D>),
) {
    let mut index = [0; D];
    match D {
        1 => visit(OuterRow { row: 0, weight: T::one(), index }),
        2 => {
            for i in 0..S::WIDTH {
                index[0] = i;
                let (row, weight) = (rows[0].first + i, rows[0].weight[i]);
                visit(OuterRow { row, weight, index });
            }
        }
        _ => {
            for i in 0..S::WIDTH {
                for j in 0..S::WIDTH {
                    index[0] = i;
                    index[1] = j;
                    let row = (rows[0].first + i) * S::REACH + rows[1].first + j;
                    let weight = rows[0].weight[i] * rows[1].weight[j];
                    visit(OuterRow { row, weight, index });
                }
            }
        }
    }
}

/// First moments N (x_i − x_p) of each axis' functions about a point, m.
#[inline(always)]
pub fn moments_at<T: Scalar, const D: usize, S: ShapeFunction<T>>(
    rows: &Rows<T, D>,
    node_at: &[[T; MAX_WIDTH]; D],
    position: [T; D],
) -> [[T; MAX_WIDTH]; D] {
    let mut moments = [[T::zero(); MAX_WIDTH]; D];
    for axis in 0..D {
        for k in 0..S::WIDTH {
            let offset = node_at[axis][rows[axis].first + k] - position[axis];
            moments[axis][k] = rows[axis].weight[k] * offset;
        }
    }
    moments
}
