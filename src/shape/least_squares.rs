//! Gradients by moving least squares over the nodes.

use super::{AxisPosition, Row, ShapeFunction};
use crate::Scalar;

/// A family whose gradient is that of a weighted least-squares fit over its nodes: MLS-MPM, \[Hu2018\].
///
/// ```text
/// G_i = N_i (x_i − x) / D,   D = Σ N_i (x_i − x)²
/// ```
///
/// along every axis. With it, the gradient that [`Tpic`](crate::transfer::Tpic) carries is the affine matrix of
/// [`Apic`](crate::transfer::Apic), and the force its adjoint. In the middle of a cell away from walls, and on its faces,
/// it is the derivative of the quadratic B-spline. Where D = 0, on a wall, it is that too.
///
/// ```
/// use transpoint::shape::{AxisPosition, LeastSquares, QuadraticBspline, ShapeFunction};
/// let at = AxisPosition { cell: 3, xi: 0.5, n_cells: 8, periodic: false };
/// assert_eq!(LeastSquares(QuadraticBspline).row(at), QuadraticBspline.row(at));
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct LeastSquares<S>(pub S);

impl<T: Scalar, S: ShapeFunction<T>> ShapeFunction<T> for LeastSquares<S> {
    const WIDTH: usize = S::WIDTH;
    const REACH: usize = S::REACH;

    #[inline(always)]
    fn row(&self, at: AxisPosition<T>) -> Row<T> {
        let mut row = self.0.row(at);
        let cell = T::from_index(at.cell);
        let mut second = T::zero();
        for k in 0..S::WIDTH {
            let node = at.cell + row.first + k;
            let offset = self.0.node_coordinate(node, at.n_cells, at.periodic) - cell - at.xi;
            row.gradient[k] = row.weight[k] * offset;
            second += row.gradient[k] * offset;
        }
        if !(second > T::zero()) {
            // On a wall, where one function is all there is, or on a node of the hat: the limit is the slope itself.
            return self.0.row(at);
        }
        let inverse = T::one() / second;
        for k in 0..S::WIDTH {
            row.gradient[k] *= inverse;
        }
        row
    }

    #[inline(always)]
    fn node_coordinate(&self, index: usize, n_cells: usize, periodic: bool) -> T {
        self.0.node_coordinate(index, n_cells, periodic)
    }
}
