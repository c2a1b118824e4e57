//! Dual domains: the hat with a gradient that is continuous across faces.

use super::{AxisPosition, Bare, Row, ShapeFunction};
use crate::Scalar;

/// The functions of the dual domain material point method, \[Zhang2011\], one axis at a time.
///
/// Weights are those of the linear hat. The gradient goes over from equal parts of that of the hat and of means about
/// the nodes, in the middle of a cell, to those means on its faces:
///
/// ```text
/// G_i = α N_i′ + (1 − α) Σ_j N_j (1/V_j) ∫ N_j N_i′ dx,   V_j = ∫ N_j dx,   α = 2 ξ (1 − ξ)
/// ```
///
/// The printed α is a product over all nodes of a cell, and the printed mean about a node of a plane or solid grid
/// also averages across the axis of the derivative; here every axis has its own, so that products remain. The
/// integrals are taken over cells that hold points: beside an empty cell or a wall the mean is one-sided, and no
/// force reaches a node without mass. Stored node `j` lies at coordinate `j − 1`.
///
/// ```
/// use transpoint::shape::{AxisPosition, DualDomain, ShapeFunction};
/// let at = AxisPosition { cell: 3, xi: 0.0, n_cells: 8, periodic: false };
/// let row = DualDomain::default().row(at);
/// assert_eq!(row.weight, [0.0, 1.0, 0.0, 0.0]);
/// assert_eq!(row.gradient, [-0.5, 0.0, 0.5, 0.0]);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct DualDomain {
    bare: Bare,
}

impl DualDomain {
    #[inline(always)]
    #[expect(clippy::needless_bitwise_bool, reason = "a short circuit becomes a branch per point")]
    fn row_between<T: Scalar>(at: AxisPosition<T>, bare: [bool; 2]) -> Row<T> {
        let (zero, one, half) = (T::zero(), T::one(), T::lit(0.5));
        let eta = one - at.xi;
        let lower = bare[0] | (!at.periodic & (at.cell == 0));
        let upper = bare[1] | (!at.periodic & (at.cell + 1 == at.n_cells));
        // About the lower node, then about the upper one.
        let below = if lower { [zero, -one, one, zero] } else { [-half, zero, half, zero] };
        let above = if upper { [zero, -one, one, zero] } else { [zero, -half, zero, half] };
        let alpha = (one + one) * at.xi * eta;
        let hat = [zero, -one, one, zero];
        let mut gradient = [zero; 4];
        for k in 0..4 {
            let mean = eta * below[k] + at.xi * above[k];
            gradient[k] = alpha * hat[k] + (one - alpha) * mean;
        }
        Row { first: 0, weight: [zero, eta, at.xi, zero], gradient }
    }
}

impl<T: Scalar> ShapeFunction<T> for DualDomain {
    const WIDTH: usize = 4;
    const REACH: usize = 4;

    #[inline(always)]
    fn row(&self, at: AxisPosition<T>) -> Row<T> {
        Self::row_between(at, [false; 2])
    }

    #[inline(always)]
    fn row_along(&self, axis: usize, at: AxisPosition<T>) -> Row<T> {
        Self::row_between(at, self.bare.0[axis])
    }

    #[inline(always)]
    fn looks_around(&self) -> bool {
        true
    }

    #[inline(always)]
    fn beside(&self, bare: Bare) -> Self {
        Self { bare }
    }

    #[inline(always)]
    fn node_coordinate(&self, index: usize, _n_cells: usize, _periodic: bool) -> T {
        T::from_index(index) - T::one()
    }
}
