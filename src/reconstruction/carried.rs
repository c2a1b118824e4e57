//! Carried values: every point keeps its own, as in MPM.

use super::{Cloud, PointField, Reconstruction};
use crate::Scalar;
use crate::basis::Fit;
use crate::math::Field;
use crate::simd::Simd;

/// No reconstruction: a cell's value is the volume-weighted mean of the points that it holds, and
/// node velocities are the mass-weighted means of the transfer, \[Sulsky1994\].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Carried;

impl<T: Scalar, const D: usize> Reconstruction<T, D> for Carried {
    const REBUILDS_NODES: bool = false;

    #[inline(always)]
    fn support(&self) -> T {
        T::zero()
    }

    #[inline(always)]
    fn fit_center<S: Simd, P: PointField<T, D>>(
        &self,
        _simd: S,
        cloud: &Cloud<'_, T, D>,
        cell: [usize; D],
        field: P,
    ) -> Fit<P::Field> {
        let index = cell.iter().zip(cloud.grid.n_cells).fold(0, |index, (&c, n)| index * n + c);
        let mut total = T::zero();
        let mut sum = P::Field::default();
        for point in cloud.cells.points(cloud.cells.slot_of[index] as usize) {
            let volume = cloud.mass[point] / cloud.density[point];
            total += volume;
            sum.add_scaled(volume, field.at(point));
        }
        if !(total > T::zero()) {
            return Fit::Empty;
        }
        let mut mean = P::Field::default();
        mean.add_scaled(T::one() / total, sum);
        Fit::Regular(mean)
    }
}
