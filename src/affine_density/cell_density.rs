//! Densities of cells from the linear fields of points.

use super::REACH;
use crate::Scalar;
use crate::math::{Value, Vector};
use crate::reconstruction::{Cloud, Neighborhood, PointField};
use crate::simd::{Simd, SimdBase as _, splat};

/// Density at the centre of a cell from the linear fields of the points in and around it, kg/m³. `fields` give density
/// and slope of the points.
#[inline(always)]
pub(crate) fn density_of_cell<S, T, const D: usize>(
    simd: S,
    cloud: &Cloud<'_, T, D>,
    cell: [usize; D],
    (densities, slopes): (
        impl PointField<T, D, Field = Value<T>>,
        impl PointField<T, D, Field = Vector<T, D>>,
    ),
) -> T
where
    S: Simd,
    T: Scalar,
{
    let grid = cloud.grid;
    let target = cell.map(|c| T::from_index(c) + T::lit(0.5));
    let (zero, one) = (splat(simd, T::zero()), splat(simd, T::one()));
    let (mut weight, mut sum) = (zero, zero);
    let mut within = [T::zero(); 8];
    within[..4].fill(T::one());
    let neighborhood = Neighborhood::around(grid, target, T::lit(REACH));
    cloud.visit_runs(
        neighborhood,
        target,
        #[inline(always)]
        |run, base, _row| {
            let range = run.start as usize..run.end as usize;
            let values = densities.run(cloud, range.clone());
            let tilts = slopes.run(cloud, range);
            let (mut first, end) = (0, run.len());
            while first < end {
                let quad = densities.quad(simd, &values, first);
                let tilt = slopes.quad(simd, &tilts, first);
                let (mut share, mut density) = (one, quad.components[0]);
                for axis in 0..D {
                    let scale = grid.inverse_spacing[axis];
                    let shift = splat(simd, base[axis] - grid.origin[axis] * scale);
                    let offset = quad.position[axis] * splat(simd, scale) + shift;
                    share *= spline::<T, S>(simd, offset);
                    density -= tilt.components[axis] * offset * splat(simd, grid.spacing[axis]);
                }
                let skipped = 4 - (end - first).min(4);
                share *= T::Four::<S>::from_slice(simd, &within[skipped..skipped + 4]);
                weight += share;
                sum += share * density;
                first += 4;
            }
        },
    );
    let total = |lanes: T::Four<S>| lanes.as_array().iter().fold(T::zero(), |sum, &x| sum + x);
    total(sum) / total(weight)
}

/// Quadratic B-spline, twice its usual size, at four offsets in cells: `(3/2 − |r|)₊² − 3 (1/2 − |r|)₊²`.
#[inline(always)]
fn spline<T: Scalar, S: Simd>(simd: S, offset: T::Four<S>) -> T::Four<S> {
    let zero = splat(simd, T::zero());
    let distance = offset.abs();
    let outer = (splat(simd, T::lit(REACH)) - distance).max(zero);
    let inner = (splat(simd, T::lit(0.5)) - distance).max(zero);
    outer * outer - splat(simd, T::lit(3.0)) * (inner * inner)
}
