//! Uniform generalized interpolation (uGIMP): the hat averaged over a particle of fixed length.

use super::{AxisPosition, Row, ShapeFunction};
use crate::Scalar;

/// uGIMP: the mean of the linear hat over a box of `length` cells, \[Bardenhagen2004\].
///
/// ```text
///        1 − (4a² + l²)/(4l),   a < l/2
/// N_j =  1 − a,                 l/2 ≤ a ≤ 1 − l/2        a = |x − x_j| in cells
///        (1 + l/2 − a)²/(2l),   1 − l/2 < a < 1 + l/2
/// ```
///
/// Stored node `j` lies at coordinate `j − 1`: there is one ghost node beyond each end. The value on
/// the ghost node of a wall is the linear extrapolation of the two nodes next to it, so that its
/// weight is folded onto them and stays zero. The half cell at the wall then carries the linear hat:
/// weights stay non-negative and the wall node interpolates.
///
/// ```
/// use transpoint::shape::{AxisPosition, Gimp, ShapeFunction};
/// let at = AxisPosition { cell: 3, xi: 0.0, n_cells: 8, periodic: false };
/// let row = Gimp { length: 0.5 }.row(at);
/// assert_eq!(row.weight[..3], [0.0625, 0.875, 0.0625]);
/// assert_eq!(row.gradient[..3], [-0.5, 0.0, 0.5]);
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Gimp<T> {
    /// Particle length l in cells, `0 < l ≤ 1`; 1 is the uniform quadratic B-spline about the nodes.
    pub length: T,
}

impl<T: Scalar> ShapeFunction<T> for Gimp<T> {
    const WIDTH: usize = 3;
    const REACH: usize = 4;

    /// With d the signed distance to the nearest node, the box reaches `d + l/2` to its right, of
    /// which the overlap `clamp(d + l/2, 0, l)` has the right-hand slope; the left side mirrors it.
    #[inline(always)]
    fn row(&self, at: AxisPosition<T>) -> Row<T> {
        let (zero, one, half) = (T::zero(), T::one(), T::lit(0.5));
        let (length, per_length) = (self.length, one / self.length);
        let upper = at.xi >= half;
        let distance = if upper { at.xi - one } else { at.xi };
        let ends = [half * length - distance, half * length + distance];

        let at_lower_wall = !at.periodic && !upper && at.cell == 0;
        let at_upper_wall = !at.periodic && upper && at.cell + 1 == at.n_cells;
        let overlaps = if at_lower_wall {
            [zero, length]
        } else if at_upper_wall {
            [length, zero]
        } else {
            [ends[0].max(zero).min(length), ends[1].max(zero).min(length)]
        };
        let [left, right] = [overlaps[0] * per_length, overlaps[1] * per_length];
        let left_weight = left * (ends[0] - half * overlaps[0]);
        let right_weight = right * (ends[1] - half * overlaps[1]);
        Row {
            first: usize::from(upper),
            weight: [left_weight, one - (left_weight + right_weight), right_weight, zero],
            gradient: [-left, left - right, right, zero],
        }
    }

    #[inline(always)]
    fn node_coordinate(&self, index: usize, _n_cells: usize, _periodic: bool) -> T {
        T::from_index(index) - T::one()
    }
}
