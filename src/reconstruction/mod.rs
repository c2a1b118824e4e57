//! Fields at cell centres and nodes, rebuilt from the points around them.

mod carried;
mod gather;
mod moving_least_squares;

pub use carried::Carried;
pub use gather::{Cloud, Neighborhood};
pub use moving_least_squares::{MovingLeastSquares, weight};

use crate::Scalar;
use crate::basis::Fit;
use crate::math::Field;

/// How fields are found between the points.
///
/// A reconstruction visits the points near a target through a [`Cloud`] and returns a fitted value.
/// Both methods are called once per cell or node, so that the fields' types stay generic.
pub trait Reconstruction<T: Scalar, const D: usize>: Copy + Send + Sync + 'static {
    /// Whether node velocities are reconstructed, not transferred from the points.
    const REBUILDS_NODES: bool;

    /// Half width of the support along each axis, cells; zero: only the points of the cell itself.
    fn support(&self) -> T;

    /// Fits a field at the centre of an active cell; `field(p)` is its value at point `p`.
    fn at_center<F: Field<T>>(
        &self,
        cloud: &Cloud<'_, T, D>,
        cell: [usize; D],
        field: impl Fn(usize) -> F,
    ) -> Fit<F>;

    /// Fits a field at a node given by its coordinates in cells from the lower corner.
    fn at_node<F: Field<T>>(
        &self,
        cloud: &Cloud<'_, T, D>,
        node: [T; D],
        field: impl Fn(usize) -> F,
    ) -> Fit<F>;
}
