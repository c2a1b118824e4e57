//! Contiguous-particle GIMP: the hat averaged over a box that the flow stretches.

use super::{AxisPosition, Gimp, Row, ShapeFunction};
use crate::Scalar;

/// cpGIMP, \[Bardenhagen2004\]: [`Gimp`] with a length of its own for every particle and axis.
///
/// ```text
/// l_i ← l_i (1 + Δt ∂v_i/∂x_i),   1/16 ≤ l_i/h ≤ 1
/// ```
///
/// At the start the box is a piece of a cell with the particle's volume. The bounds are part of the method here: a
/// longer box would reach nodes beyond the stencil; lengths that they change are counted.
///
/// ```
/// use transpoint::shape::{AxisPosition, ConvectedGimp, Gimp, ShapeFunction};
/// let at = AxisPosition { cell: 3, xi: 0.1, n_cells: 8, periodic: false };
/// let box_of = ConvectedGimp::default().stretched([0.25, 1.0, 0.5]);
/// assert_eq!(box_of.row_along(1, at), Gimp { length: 1.0 }.row(at));
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct ConvectedGimp<T> {
    length: [T; 3],
}

impl<T: Scalar> Default for ConvectedGimp<T> {
    fn default() -> Self {
        Self { length: [T::lit(0.5); 3] }
    }
}

impl<T: Scalar> ShapeFunction<T> for ConvectedGimp<T> {
    const WIDTH: usize = 3;
    const REACH: usize = 4;

    #[inline(always)]
    fn row(&self, at: AxisPosition<T>) -> Row<T> {
        self.row_along(0, at)
    }

    #[inline(always)]
    fn row_along(&self, axis: usize, at: AxisPosition<T>) -> Row<T> {
        Gimp { length: self.length[axis] }.row(at)
    }

    #[inline(always)]
    fn stretches(&self) -> bool {
        true
    }

    #[inline(always)]
    fn stretched(&self, length: [T; 3]) -> Self {
        Self { length }
    }

    #[inline(always)]
    fn node_coordinate(&self, index: usize, _n_cells: usize, _periodic: bool) -> T {
        T::from_index(index) - T::one()
    }
}
