//! Quadratic B-splines about the vertices, corrected where nodes hold no fluid.

use super::{AxisPosition, Bare, Gimp, Row, ShapeFunction};
use crate::Scalar;

/// Quadratic B-splines about the vertices with boundary-corrected kernels, \[Nakamura2023\].
///
/// ```text
/// N′_i = N_i P(x_i − x)ᵀ M⁻¹ P(0),   M = Σ_i χ_i N_i P Pᵀ,   P = (1, x),   χ_i = 1 where a cell at node i holds points
/// ```
///
/// along every axis. Where a cell's neighbour along the axis is empty, or beyond a wall, the outer of the three
/// functions in the half cell next to it is left out; two functions that reproduce linear fields are the hat. So
/// nodes beyond the surface take no part, which a function of the whole support would give little mass and much
/// force. Away from surfaces and walls this is [`Gimp`] with length 1.
///
/// ```
/// use transpoint::shape::{AxisPosition, Bare, Corrected, ShapeFunction};
/// let at = AxisPosition { cell: 3, xi: 0.25, n_cells: 8, periodic: false };
/// let inside = Corrected::default();
/// assert_eq!(inside.row(at).weight[..3], [0.03125, 0.6875, 0.28125]);
/// let at_surface = ShapeFunction::<f64>::beside(&inside, Bare([[true, false]; 3]));
/// assert_eq!(at_surface.row_along(0, at).weight[..3], [0.0, 0.75, 0.25]);
/// ```
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Corrected {
    bare: Bare,
}

impl<T: Scalar> ShapeFunction<T> for Corrected {
    const WIDTH: usize = 3;
    const REACH: usize = 4;

    #[inline(always)]
    fn row(&self, at: AxisPosition<T>) -> Row<T> {
        Gimp { length: T::one() }.row(at)
    }

    #[inline(always)]
    fn row_along(&self, axis: usize, at: AxisPosition<T>) -> Row<T> {
        let half = usize::from(at.xi >= T::lit(0.5));
        if self.bare.0[axis][half] {
            // One cell between walls carries the hat in both halves.
            Gimp { length: T::one() }.row(AxisPosition {
                cell: 0,
                n_cells: 1,
                periodic: false,
                ..at
            })
        } else {
            self.row(at)
        }
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
