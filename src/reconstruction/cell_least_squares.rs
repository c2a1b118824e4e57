//! Least squares at the centres of cells for everything: Sulsky and Gong's improved material point method.

use super::{Cloud, Flow, MovingLeastSquares, PointField, Reconstruction};
use crate::Scalar;
use crate::basis::{Fit, PolynomialBasis};
use crate::math::widen;
use crate::simd::Simd;

/// Density, stress and momentum by moving least squares at the centres of cells, \[SulskyGong2016\].
///
/// ```text
/// m_I = Σ_c V_c ρ_c N_I(x_c),   P_I = Σ_c V_c (ρv)_c N_I(x_c)
/// ```
///
/// Node velocities are thus those of the cells around, averaged; every cell that holds points counts as full. Goes
/// with [`WholeCells::All`](crate::quadrature::WholeCells).
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct CellLeastSquares<B, T>(pub MovingLeastSquares<B, T>);

impl<T, const D: usize, B> Reconstruction<T, D> for CellLeastSquares<B, T>
where
    T: Scalar,
    B: PolynomialBasis<T, D>,
{
    const REBUILDS_NODES: bool = false;
    const BY_CELLS: bool = true;

    #[inline(always)]
    fn support(&self) -> T {
        self.0.support
    }

    #[inline(always)]
    fn fit_center<S: Simd, P: PointField<T, D>>(
        &self,
        simd: S,
        cloud: &Cloud<'_, T, D>,
        cell: [usize; D],
        field: P,
    ) -> Fit<P::Field> {
        self.0.fit_center(simd, cloud, cell, field)
    }

    #[inline(always)]
    fn cell_flow<S: Simd, P: PointField<T, D, Field = Flow<T, D>> + Copy>(
        &self,
        simd: S,
        cloud: &Cloud<'_, T, D>,
        (slot, cell): (usize, [usize; D]),
        field: P,
    ) -> ([[T; 4]; 4], bool) {
        let own = || field.at(cloud.cells.points(slot).start);
        let fit = self.0.fit_center(simd, cloud, cell, field);
        let regular = !matches!(fit, Fit::Empty | Fit::Constant(_));
        let (momentum, density) = fit.value().unwrap_or_else(own);
        let mut rows = [[T::zero(); 4]; 4];
        rows[0] = widen(momentum.0);
        rows[0][3] = density.0;
        (rows, regular)
    }
}
