//! Particle quadrature: every point is a sample.

use super::{PointVolumes, Quadrature, Samples};
use crate::Scalar;
use crate::cells::CellKind;
use crate::reconstruction::Cloud;

/// Σ over points with their carried volume m/ρ, \[Sulsky1994\].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Particle;

impl<T: Scalar, const D: usize> Quadrature<T, D> for Particle {
    const USES_CENTERS: bool = false;
    const CLASSIFIES: bool = false;

    #[inline(always)]
    fn samples(&self, _kind: CellKind) -> Samples {
        Samples::Points
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
