//! The nodes around a point, row by row.

use crate::Scalar;
use crate::cells::Cells;
use crate::grid::Grid;
use crate::shape::{AxisPosition, MAX_WIDTH, Row, ShapeFunction};
use crate::simd::{Simd, SimdBase as _, lanes, load, splat};

/// Rows of shape functions of one point, with derivatives per metre.
pub type Rows<T, const D: usize> = [Row<T>; D];

/// The shape functions in a cell, where they depend on its neighbours.
#[inline(always)]
pub fn shape_in_cell<T: Scalar, const D: usize, S: ShapeFunction<T>>(
    shape: &S,
    grid: &Grid<T, D>,
    cells: &Cells,
    cell: [usize; D],
) -> S {
    if shape.looks_around() { shape.beside(cells.bare(grid, cell)) } else { *shape }
}

/// The shape functions of a point, where they depend on its lengths (m).
#[inline(always)]
pub fn shape_at_point<T: Scalar, const D: usize, S: ShapeFunction<T>>(
    shape: &S,
    grid: &Grid<T, D>,
    length: &[[T; D]],
    point: usize,
) -> S {
    if !shape.stretches() {
        return *shape;
    }
    let mut in_cells = [T::one(); 3];
    for axis in 0..D {
        in_cells[axis] = length[point][axis] * grid.inverse_spacing[axis];
    }
    shape.stretched(in_cells)
}

/// Derivatives along each axis, 1/m.
#[inline(always)]
pub fn gradients<T: Scalar, const D: usize>(rows: &Rows<T, D>) -> [[T; MAX_WIDTH]; D] {
    let mut gradients = [[T::zero(); MAX_WIDTH]; D];
    for axis in 0..D {
        gradients[axis] = rows[axis].gradient;
    }
    gradients
}

/// Evaluates the shape functions at a position within a known cell.
#[inline(always)]
pub fn rows_at<T: Scalar, const D: usize, S: ShapeFunction<T>>(
    shape: &S,
    grid: &Grid<T, D>,
    cell: [usize; D],
    position: [T; D],
) -> Rows<T, D> {
    let mut rows = [Row::zero(); D];
    for axis in 0..D {
        rows[axis] = shape.row_along(axis, grid.axis_position(position, cell, axis));
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

/// What the points of a cell share. Vectors hold one number per axis.
#[derive(Clone, Copy)]
pub struct Frame<T: Scalar, S: Simd, const D: usize> {
    simd: S,
    grid: Grid<T, D>,
    cell: [usize; D],
    /// Lower corner of the grid, m, and 1 / spacing, 1/m.
    origin: T::Four<S>,
    inverse_spacing: T::Four<S>,
    /// Nodes of the stencil along each axis, m.
    nodes: [T::Four<S>; MAX_WIDTH],
}

impl<T: Scalar, S: Simd, const D: usize> Frame<T, S, D> {
    /// The frame of a cell. The grid should be the one that the phase was given, not a copy: a copy of
    /// the padding in the spare lanes may be left out, and they then hold whatever lies on the stack.
    #[inline(always)]
    pub fn new<H: ShapeFunction<T>>(
        simd: S,
        shape: &H,
        grid: &Grid<T, D>,
        cell: [usize; D],
    ) -> Self {
        let mut nodes = [splat(simd, T::zero()); MAX_WIDTH];
        for k in 0..H::REACH {
            nodes[k] = lanes::<T, S, D>(simd, |axis| {
                let (n, periodic) = (grid.n_cells[axis], grid.periodic[axis]);
                let coordinate = shape.node_coordinate(cell[axis] + k, n, periodic);
                grid.origin[axis] + grid.spacing[axis] * coordinate
            });
        }
        let [origin, inverse_spacing] = grid.padded();
        let (origin, inverse_spacing) = (load(simd, origin), load(simd, inverse_spacing));
        Self { simd, grid: *grid, cell, origin, inverse_spacing, nodes }
    }

    /// Where a position lies in the cell along each axis, in cells.
    #[inline(always)]
    pub fn xi(&self, position: &[T; D]) -> T::Four<S> {
        let corner = lanes::<T, S, D>(self.simd, |axis| T::from_index(self.cell[axis]));
        let position = lanes::<T, S, D>(self.simd, |axis| position[axis]);
        (position - self.origin) * self.inverse_spacing - corner
    }

    /// The shape functions at a position.
    #[inline(always)]
    pub fn rows<H: ShapeFunction<T>>(&self, shape: &H, position: &[T; D]) -> Rows<T, D> {
        let Self { simd, grid, cell, .. } = self;
        let xi = self.xi(position);
        let mut at = [AxisPosition { cell: 0, xi: T::zero(), n_cells: 0, periodic: false }; D];
        for axis in 0..D {
            let (n_cells, periodic) = (grid.n_cells[axis], grid.periodic[axis]);
            at[axis] =
                AxisPosition { cell: cell[axis], xi: xi.as_array()[axis], n_cells, periodic };
        }
        shape.rows(*simd, &at, self.inverse_spacing)
    }

    /// Moments of the functions about the position at which they were taken.
    #[inline(always)]
    pub fn moments<H: ShapeFunction<T>>(
        &self,
        rows: &Rows<T, D>,
        position: &[T; D],
    ) -> Moments<T, S, D> {
        let simd = self.simd;
        let position = lanes::<T, S, D>(simd, |axis| position[axis]);
        let mut first = [[T::zero(); MAX_WIDTH]; D];
        let mut second = splat(simd, T::zero());
        for k in 0..H::WIDTH {
            let node =
                lanes::<T, S, D>(simd, |axis| self.nodes[rows[axis].first + k].as_array()[axis]);
            let offset = node - position;
            let moment = lanes::<T, S, D>(simd, |axis| rows[axis].weight[k]) * offset;
            second += moment * offset;
            for axis in 0..D {
                first[axis][k] = moment.as_array()[axis];
            }
        }
        Moments { first, second }
    }
}

/// Moments of each axis' functions about a point.
#[derive(Clone, Copy)]
pub struct Moments<T: Scalar, S: Simd, const D: usize> {
    /// N (x_i − x_p), m.
    pub first: [[T; MAX_WIDTH]; D],
    /// Diagonal of Σ N (x − x_p)(x − x_p)ᵀ, m².
    pub second: T::Four<S>,
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
