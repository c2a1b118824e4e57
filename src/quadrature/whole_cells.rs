//! Quadrature by whole cells.

use super::{PointVolumes, Quadrature, Samples};
use crate::Scalar;
use crate::cells::CellKind;
use crate::reconstruction::Cloud;

/// Which cells are integrated as a whole.
#[derive(Clone, Copy, Debug, PartialEq, Eq)]
pub enum WholeCells {
    /// All that hold points, as by [`Gauss`](super::Gauss).
    All,
    /// Those full of fluid. Boundary cells are sampled at their points with the volume m/ρ that these carry, so
    /// that no mass is lost or made where a cell changes its kind.
    Internal,
}

impl<T: Scalar, const D: usize> Quadrature<T, D> for WholeCells {
    const USES_CENTERS: bool = true;
    const CLASSIFIES: bool = true;

    #[inline(always)]
    fn samples(&self, kind: CellKind) -> Samples {
        match (self, kind) {
            (Self::All, _) | (Self::Internal, CellKind::Internal) => Samples::Center,
            (Self::Internal, CellKind::Boundary) => Samples::Points,
        }
    }

    #[inline(always)]
    fn point_volumes<'a>(
        &self,
        _cloud: &'a Cloud<'a, T, D>,
        _slot: usize,
    ) -> PointVolumes<'a, T, D> {
        PointVolumes::Scaled(T::one())
    }
}
