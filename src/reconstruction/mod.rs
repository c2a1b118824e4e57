//! Fields at cell centres and nodes, rebuilt from the points around them.

mod carried;
mod cell_fit;
mod cell_least_squares;
mod columns;
mod gather;
mod moving_least_squares;
mod taylor_least_squares;

pub use carried::Carried;
pub use cell_fit::CellFit;
pub use cell_least_squares::CellLeastSquares;
pub use columns::{Columns, EachPoint, InColumns, PointField, Quad};
pub use gather::{Cloud, Neighborhood};
pub use moving_least_squares::MovingLeastSquares;
pub use taylor_least_squares::TaylorLeastSquares;

use crate::Scalar;
use crate::basis::Fit;
use crate::math::{Field, Value, Vector};
use crate::simd::{Simd, vectorized};

/// Momentum per volume ρv and density: what is fitted at the nodes.
pub type Flow<T, const D: usize> = (Vector<T, D>, Value<T>);

/// How fields are found between the points.
///
/// A reconstruction visits the points near a target through a [`Cloud`] and returns a fitted value.
/// Fields have to be finite in all cells that the support overlaps, also where the weight is zero.
pub trait Reconstruction<T: Scalar, const D: usize>: Copy + Send + Sync + 'static {
    /// Whether node velocities are reconstructed, not transferred from the points.
    const REBUILDS_NODES: bool;
    /// Whether cells that are sampled at their centers pass on momentum and mass, see [`Self::cell_flow`].
    const BY_CELLS: bool = false;

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

    /// Fits a field at a node given by its coordinates in cells from the lower corner; methods that do not rebuild
    /// nodes have none.
    #[inline(always)]
    fn fit_node<S: Simd, P: PointField<T, D>>(
        &self,
        _simd: S,
        _cloud: &Cloud<'_, T, D>,
        _node: [T; D],
        _field: P,
    ) -> Fit<P::Field> {
        Fit::Empty
    }

    /// Momentum per volume (kg/(m² s)) and density (kg/m³, last entry) in an active cell: the value at its center, and
    /// for each axis the change over one cell. Where the method is [`Self::BY_CELLS`], nodes get
    /// `∫ N (value + Σ_a slope_a (x − x_c)_a/h_a) dV` with linear hats. The flag tells whether the fit was a regular one.
    #[inline(always)]
    fn cell_flow<S: Simd, P: PointField<T, D, Field = Flow<T, D>> + Copy>(
        &self,
        _simd: S,
        _cloud: &Cloud<'_, T, D>,
        _at: (usize, [usize; D]),
        _field: P,
    ) -> ([[T; 4]; 4], bool) {
        ([[T::zero(); 4]; 4], true)
    }

    /// [`Self::fit_center`] for a single fit, outside of a kernel; `field(p)` is the value at point `p`.
    fn at_center<F: Field<T>>(
        &self,
        cloud: &Cloud<'_, T, D>,
        cell: [usize; D],
        field: impl Fn(usize) -> F,
    ) -> Fit<F> {
        vectorized!(D, simd => self.fit_center(simd, cloud, cell, EachPoint(field)))
    }

    /// [`Self::fit_node`] for a single fit, outside of a kernel.
    fn at_node<F: Field<T>>(
        &self,
        cloud: &Cloud<'_, T, D>,
        node: [T; D],
        field: impl Fn(usize) -> F,
    ) -> Fit<F> {
        vectorized!(D, simd => self.fit_node(simd, cloud, node, EachPoint(field)))
    }
}
