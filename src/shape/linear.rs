//! Piecewise linear hat functions.

use super::{AxisPosition, Row, ShapeFunction};
use crate::Scalar;

/// The linear hat of the classic material point method \[Sulsky1994\].
///
/// ```text
/// N_j = 1 − |x − x_j|,  |x − x_j| ≤ 1,   x in cells, x_j = j
/// ```
///
/// Weights lie in `[0, 1]`, derivatives per cell are ±1. The derivative jumps at cell faces.
///
/// ```
/// use transpoint::shape::{AxisPosition, Linear, ShapeFunction};
/// let row = Linear.row(AxisPosition { cell: 0, xi: 0.25, n_cells: 4, periodic: false });
/// assert_eq!(row.weight[..2], [0.75, 0.25]);
/// assert_eq!(row.gradient[..2], [-1.0, 1.0]);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Linear;

impl<T: Scalar> ShapeFunction<T> for Linear {
    const WIDTH: usize = 2;
    const REACH: usize = 2;

    #[inline(always)]
    fn row(&self, at: AxisPosition<T>) -> Row<T> {
        let (zero, one) = (T::zero(), T::one());
        Row {
            first: 0,
            weight: [one - at.xi, at.xi, zero, zero],
            gradient: [-one, one, zero, zero],
        }
    }

    #[inline(always)]
    fn node_coordinate(&self, index: usize, _n_cells: usize, _periodic: bool) -> T {
        T::from_index(index)
    }
}
