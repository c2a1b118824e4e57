//! One-point Gauss quadrature in every cell.

use super::{PointVolumes, Quadrature, Samples};
use crate::Scalar;
use crate::cells::CellKind;
use crate::reconstruction::Cloud;

/// One Gauss point at the centre of every cell that holds points, Eqs. (21)-(24) of \[Song2020\].
///
/// Right where the fluid fills its cells; with a free surface use `Mixed`.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Gauss;

impl<T: Scalar, const D: usize> Quadrature<T, D> for Gauss {
    const USES_CENTERS: bool = true;
    const CLASSIFIES: bool = false;

    #[inline(always)]
    fn samples(&self, _kind: CellKind) -> Samples {
        Samples::Center
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
