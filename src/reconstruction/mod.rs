//! Fields at cell centres and nodes, rebuilt from the points around them.

mod carried;
mod columns;
mod gather;
mod moving_least_squares;

pub use carried::Carried;
pub use columns::{Columns, EachPoint, InColumns, PointField, Quad};
pub use gather::{Cloud, Neighborhood};
pub use moving_least_squares::MovingLeastSquares;

use crate::Scalar;
use crate::basis::Fit;
use crate::math::Field;
use crate::simd::{Simd, vectorized};

/// How fields are found between the points.
///
/// A reconstruction visits the points near a target through a [`Cloud`] and returns a fitted value.
/// Fields have to be finite in all cells that the support overlaps, also where the weight is zero.
pub trait Reconstruction<T: Scalar, const D: usize>: Copy + Send + Sync + 'static {
    /// Whether node velocities are reconstructed, not transferred from the points.
    const REBUILDS_NODES: bool;

    /// Half width of the support along each axis, cells; zero: only the points of the cell itself.
    fn support(&self) -> T;

    /// The same without its limiter and with a support of at least `least` cells, for values that new or
    /// moved points are given.
    #[must_use]
    fn unlimited(&self, _least: T) -> Self {
        *self
    }

    /// Fits a field at the centre of an active cell.
    fn fit_center<S: Simd, P: PointField<T, D>>(
        &self,
        simd: S,
        cloud: &Cloud<'_, T, D>,
        cell: [usize; D],
        field: P,
    ) -> Fit<P::Field>;

    /// Fits a field at a node given by its coordinates in cells from the lower corner.
    fn fit_node<S: Simd, P: PointField<T, D>>(
        &self,
        simd: S,
        cloud: &Cloud<'_, T, D>,
        node: [T; D],
        field: P,
    ) -> Fit<P::Field>;

    /// [`Self::fit_center`] for a single fit, outside of a kernel; `field(p)` is the value at point `p`.
    fn at_center<F: Field<T>>(
        &self,
        cloud: &Cloud<'_, T, D>,
        cell: [usize; D],
        field: impl Fn(usize) -> F,
    ) -> Fit<F> {
        vectorized!(simd => self.fit_center(simd, cloud, cell, EachPoint(field)))
    }

    /// [`Self::fit_node`] for a single fit, outside of a kernel.
    fn at_node<F: Field<T>>(
        &self,
        cloud: &Cloud<'_, T, D>,
        node: [T; D],
        field: impl Fn(usize) -> F,
    ) -> Fit<F> {
        vectorized!(simd => self.fit_node(simd, cloud, node, EachPoint(field)))
    }
}
