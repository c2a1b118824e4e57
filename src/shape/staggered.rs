//! Staggered grid: hats about cell centres, averaged onto the vertices.

use super::{AxisPosition, Row, ShapeFunction};
use crate::Scalar;

/// The functions of the staggered-grid material point method, \[Liang2019\].
///
/// Points share out to cell centres by hats ψ, and each centre to its vertices in equal parts; forces and strains
/// take the gradient of the linear hat at the centres. Along one axis both steps together are
///
/// ```text
/// N_j  = (ψ_{j−1/2} + ψ_{j+1/2}) / 2,   G_j = (ψ_{j−1/2} − ψ_{j+1/2}) / h,   ψ_c = 1 − |x − x_c|/h
/// ```
///
/// and in several dimensions their products. G is continuous across faces, so that points that cross them feel no
/// jump; it is not the derivative of N, which is ∓1/(2h) on the outer nodes. The half cell at a wall, which has no
/// centre beyond it, carries the linear hat, so that linear fields are kept there (in the original ψ is constant up to
/// the wall). Stored node `j` lies at coordinate `j − 1`.
///
/// ```
/// use transpoint::shape::{AxisPosition, ShapeFunction, Staggered};
/// let row = Staggered.row(AxisPosition { cell: 3, xi: 0.25, n_cells: 8, periodic: false });
/// assert_eq!(row.weight[..3], [0.125, 0.5, 0.375]);
/// assert_eq!(row.gradient[..3], [-0.25, -0.5, 0.75]);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Staggered;

impl<T: Scalar> ShapeFunction<T> for Staggered {
    const WIDTH: usize = 3;
    const REACH: usize = 4;

    #[inline(always)]
    fn row(&self, at: AxisPosition<T>) -> Row<T> {
        let (zero, one, half) = (T::zero(), T::one(), T::lit(0.5));
        let upper = at.xi >= half;
        let after = if upper { at.xi - half } else { at.xi + half };
        let before = one - after;
        let at_lower_wall = !at.periodic && !upper && at.cell == 0;
        let at_upper_wall = !at.periodic && upper && at.cell + 1 == at.n_cells;
        let (weight, gradient) = if at_lower_wall {
            ([zero, one - at.xi, at.xi, zero], [zero, -one, one, zero])
        } else if at_upper_wall {
            ([one - at.xi, at.xi, zero, zero], [-one, one, zero, zero])
        } else {
            ([half * before, half, half * after, zero], [-before, before - after, after, zero])
        };
        Row { first: usize::from(upper), weight, gradient }
    }

    #[inline(always)]
    fn node_coordinate(&self, index: usize, _n_cells: usize, _periodic: bool) -> T {
        T::from_index(index) - T::one()
    }
}
