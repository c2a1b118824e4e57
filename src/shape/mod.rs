//! Grid shape functions: one-dimensional rows whose tensor product gives the weights of a point.

mod bspline;
mod choice;
mod convected;
mod corrected;
mod dual_domain;
mod gimp;
mod least_squares;
mod linear;
mod staggered;

pub use bspline::{CubicBspline, QuadraticBspline};
pub use choice::{AboutVertices, FourWide, Quadratic};
pub use convected::ConvectedGimp;
pub use corrected::Corrected;
pub use dual_domain::DualDomain;
pub use gimp::Gimp;
pub use least_squares::LeastSquares;
pub use linear::Linear;
pub use staggered::Staggered;

use crate::Scalar;
use crate::simd::{Simd, SimdBase as _};

/// Most functions of one axis that are non-zero at a point (cubic B-spline).
pub const MAX_WIDTH: usize = 4;

/// Where a point sits along one axis, in cells.
///
/// The position is split into a cell and a local coordinate so that no accuracy is lost far from
/// the origin, and so that every shape function shares one cell search.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct AxisPosition<T> {
    /// Cell that holds the point, `0..n_cells`.
    pub cell: usize,
    /// Coordinate within the cell, `0 ≤ xi ≤ 1`.
    pub xi: T,
    /// Number of cells of the axis, at least one.
    pub n_cells: usize,
    /// Whether the axis is periodic: then there are no walls and every cell is interior.
    pub periodic: bool,
}

/// The functions of one axis at one point.
///
/// Entry `k < WIDTH` belongs to node `cell + first + k` of the axis; entries beyond `WIDTH` are zero.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row<T> {
    /// Offset of the first function from the cell's first node; zero unless the support depends on
    /// the half of the cell (uGIMP).
    pub first: usize,
    /// Values N, dimensionless.
    pub weight: [T; MAX_WIDTH],
    /// Derivatives dN/dξ per cell (divide by the spacing for 1/m).
    pub gradient: [T; MAX_WIDTH],
}

impl<T: Scalar> Row<T> {
    /// No function.
    #[inline(always)]
    pub fn zero() -> Self {
        Self { first: 0, weight: [T::zero(); MAX_WIDTH], gradient: [T::zero(); MAX_WIDTH] }
    }
}

/// Whether the neighbours of a cell hold no points: `[axis][lower, upper]`, of the axes that a grid has.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Bare(pub [[bool; 2]; 3]);

/// A family of grid shape functions, evaluated one axis at a time.
///
/// Every family keeps partition of unity, Σ N = 1, and linear reproduction, `Σ N_i x_i = x`, in
/// every cell, also next to walls, with the node coordinates of [`ShapeFunction::node_coordinate`].
/// The first (last) function alone is non-zero on the lower (upper) wall, so that a velocity
/// prescribed on the wall's nodes is met exactly on the wall; ghost nodes of a wall are skipped. "Derivatives"
/// are what a method uses as such: Σ G = 0 and `Σ G_i x_i = 1` hold for all, being the slopes of N only for some.
///
/// An axis of `n` cells stores `n + EXTRA` nodes. The points of cell `c` touch nodes
/// `c .. c + REACH` only. On a periodic axis node `n + k` is the image of node `k`.
pub trait ShapeFunction<T: Scalar>: Copy + Send + Sync {
    /// Functions that can be non-zero at one point, `≤ MAX_WIDTH`.
    const WIDTH: usize;
    /// Nodes that the points of one cell can touch, `WIDTH ≤ REACH ≤ MAX_WIDTH`.
    const REACH: usize;
    /// Stored nodes of an axis minus its cells, `REACH - 1`.
    const EXTRA: usize = Self::REACH - 1;

    /// Values and derivatives of the functions at a point.
    fn row(&self, at: AxisPosition<T>) -> Row<T>;

    /// The same along an axis, where that makes a difference.
    #[inline(always)]
    fn row_along(&self, _axis: usize, at: AxisPosition<T>) -> Row<T> {
        self.row(at)
    }

    /// Whether the functions depend on which neighbours of the cell are empty, see [`Self::beside`].
    #[inline(always)]
    fn looks_around(&self) -> bool {
        false
    }

    /// Whether every point has lengths of its own, see [`Self::stretched`].
    #[inline(always)]
    fn stretches(&self) -> bool {
        false
    }

    /// The family in a cell some of whose neighbours are empty.
    #[inline(always)]
    #[must_use]
    fn beside(&self, _bare: Bare) -> Self {
        *self
    }

    /// The family at a point of this length along each axis, cells.
    #[inline(always)]
    #[must_use]
    fn stretched(&self, _length: [T; 3]) -> Self {
        *self
    }

    /// The functions of all axes at a point, derivatives per metre.
    ///
    /// Families whose formula holds on every axis may work on all axes at once; the bits are the same.
    #[inline(always)]
    fn rows<S: Simd, const D: usize>(
        &self,
        _simd: S,
        at: &[AxisPosition<T>; D],
        inverse_spacing: T::Four<S>,
    ) -> [Row<T>; D] {
        let mut rows = [Row::zero(); D];
        for axis in 0..D {
            rows[axis] = self.row_along(axis, at[axis]);
            for k in 0..Self::WIDTH {
                rows[axis].gradient[k] *= inverse_spacing.as_array()[axis];
            }
        }
        rows
    }

    /// Coordinate of stored node `index` in cells from the axis' lower end (Greville abscissa).
    fn node_coordinate(&self, index: usize, n_cells: usize, periodic: bool) -> T;
}
