//! Fits by cells that are chosen at run time, so that they are compiled together.

use super::{CellLeastSquares, Cloud, Flow, PointField, Reconstruction, TaylorLeastSquares};
use crate::Scalar;
use crate::basis::{Fit, PolynomialBasis};
use crate::simd::Simd;

/// One of the reconstructions that pass on momentum and mass by cells.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum CellFit<B, T> {
    /// Moving least squares at the centers.
    Moving(CellLeastSquares<B, T>),
    /// Conservative least squares in each cell.
    Taylor(TaylorLeastSquares<B>),
}

impl<T, const D: usize, B> Reconstruction<T, D> for CellFit<B, T>
where
    T: Scalar,
    B: PolynomialBasis<T, D>,
{
    const REBUILDS_NODES: bool = false;
    const BY_CELLS: bool = true;

    #[inline(always)]
    fn support(&self) -> T {
        match self {
            Self::Moving(fit) => fit.support(),
            Self::Taylor(fit) => fit.support(),
        }
    }

    #[inline(always)]
    fn fit_center<S: Simd, P: PointField<T, D>>(
        &self,
        simd: S,
        cloud: &Cloud<'_, T, D>,
        cell: [usize; D],
        field: P,
    ) -> Fit<P::Field> {
        match self {
            Self::Moving(fit) => fit.fit_center(simd, cloud, cell, field),
            Self::Taylor(fit) => fit.fit_center(simd, cloud, cell, field),
        }
    }

    #[inline(always)]
    fn cell_flow<S: Simd, P: PointField<T, D, Field = Flow<T, D>> + Copy>(
        &self,
        simd: S,
        cloud: &Cloud<'_, T, D>,
        at: (usize, [usize; D]),
        field: P,
    ) -> ([[T; 4]; 4], bool) {
        match self {
            Self::Moving(fit) => fit.cell_flow(simd, cloud, at, field),
            Self::Taylor(fit) => fit.cell_flow(simd, cloud, at, field),
        }
    }
}
