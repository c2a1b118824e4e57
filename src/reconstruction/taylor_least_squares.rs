//! Taylor least squares within each cell, conserving mass and momentum.

use std::marker::PhantomData;

use nalgebra::{Matrix3, Vector3};

use super::{Cloud, Flow, PointField, Reconstruction};
use crate::Scalar;
use crate::basis::{Fit, Limiters, MomentSystem, PolynomialBasis};
use crate::math::{Field, MAX_COMPONENTS, widen};
use crate::simd::{Simd, SimdBase as _, splat};

/// Conservative Taylor least squares, \[Wobbes2019\], with linear polynomials.
///
/// ```text
/// q(x) = q_c + Σ_a s_a (x − x_c)_a/h_a  in every cell,   q_c = Σ_p m_p (v_p, 1) / V_c   for q = (ρv, ρ)
/// ```
///
/// The slopes s are fitted to the cell's points; they have zero mean over the cell, so that the integrals
/// `Σ_I ∫ N_I q = Σ_p m_p (v_p, 1)` stay whatever they are. Slopes are zero, and that is counted, where the points nearly lie in a plane.
/// Density for the pressure, and stress, are fitted without the constraint at the center, where the force is sampled
/// once. Cells cut by the surface are sampled at
/// their points: goes with [`WholeCells::Internal`](crate::quadrature::WholeCells).
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct TaylorLeastSquares<B>(PhantomData<B>);

impl<B> TaylorLeastSquares<B> {
    /// The reconstruction; it has no parameter.
    pub const fn new() -> Self {
        Self(PhantomData)
    }
}

/// Where a point lies about the center of its cell, cells.
#[inline(always)]
fn offset<T: Scalar, const D: usize>(
    cloud: &Cloud<'_, T, D>,
    cell: [usize; D],
    point: usize,
) -> [T; D] {
    std::array::from_fn(|axis| {
        let center = T::from_index(cell[axis]) + T::lit(0.5);
        cloud.grid.in_cells(cloud.position[point], axis) - center
    })
}

/// Least mean square distance of a cell's points from their best plane through its center, cells², for slopes to be
/// fitted; it is 1/12 for points all over the cell.
const LEAST_SPREAD: f64 = 0.02;

/// Slopes along the axes of four fields, given Σ y yᵀ and Σ y q over `n` points; `None` where these do not span the
/// space well enough.
#[inline(always)]
fn slopes<T: Scalar>(
    n: usize,
    squares: Matrix3<T>,
    products: [Vector3<T>; 4],
) -> Option<[Vector3<T>; 4]> {
    let least = T::lit(LEAST_SPREAD) * T::from_index(n);
    if squares.symmetric_eigenvalues().min() < least {
        return None;
    }
    let factor = squares.cholesky()?;
    Some(products.map(|product| factor.solve(&product)))
}

impl<T, const D: usize, B> Reconstruction<T, D> for TaylorLeastSquares<B>
where
    T: Scalar,
    B: PolynomialBasis<T, D>,
{
    const REBUILDS_NODES: bool = false;
    const BY_CELLS: bool = true;

    #[inline(always)]
    fn support(&self) -> T {
        T::lit(0.5)
    }

    #[inline(always)]
    fn fit_center<S: Simd, P: PointField<T, D>>(
        &self,
        simd: S,
        cloud: &Cloud<'_, T, D>,
        cell: [usize; D],
        field: P,
    ) -> Fit<P::Field> {
        let index = cell.iter().zip(cloud.grid.n_cells).fold(0, |index, (&c, n)| index * n + c);
        let range = cloud.cells.points(cloud.cells.slot_of[index] as usize);
        let (first, n) = (range.start, range.len());
        let points = field.run(cloud, range);
        let (zero, one) = (T::zero(), T::one());
        let mut system = B::System::<S>::empty(simd);
        let mut start = 0;
        while start < n {
            let mut within = [zero; 4];
            let mut place = [[zero; 4]; D];
            for lane in 0..(n - start).min(4) {
                within[lane] = one;
                let y = offset(cloud, cell, first + start + lane);
                for axis in 0..D {
                    place[axis][lane] = y[axis];
                }
            }
            let quad = field.quad(simd, &points, start);
            let place = place.map(|row| T::Four::<S>::load_array(simd, row));
            let components: &[T::Four<S>; MAX_COMPONENTS] = &quad.components;
            let values = B::values(splat(simd, one), place);
            let weight = T::Four::<S>::load_array(simd, within);
            system.add(weight, &values, &components[..P::Field::COMPONENTS]);
            start += 4;
        }
        system.solve(Limiters { leverage: None, positivity: None })
    }

    #[inline(always)]
    fn cell_flow<S: Simd, P: PointField<T, D, Field = Flow<T, D>> + Copy>(
        &self,
        _simd: S,
        cloud: &Cloud<'_, T, D>,
        (slot, cell): (usize, [usize; D]),
        field: P,
    ) -> ([[T; 4]; 4], bool) {
        let zero = T::zero();
        let mut rows = [[zero; 4]; 4];
        let per_volume = T::one() / cloud.grid.cell_volume();
        let row_of = |point: usize| {
            let (momentum, density) = field.at(point);
            let mut row = widen(momentum.0);
            row[3] = density.0;
            row
        };
        for point in cloud.cells.points(slot) {
            let row = row_of(point);
            let volume = cloud.mass[point] / cloud.density[point];
            for k in 0..4 {
                rows[0][k] += volume * per_volume * row[k];
            }
        }
        let n = cloud.cells.points(slot).len();
        // Axes that the grid has not are out of the way.
        let mut squares = Matrix3::identity() * T::from_index(n);
        for axis in 0..D {
            squares[(axis, axis)] = zero;
        }
        let mut products = [Vector3::zeros(); 4];
        for point in cloud.cells.points(slot) {
            let (row, y) = (row_of(point), offset(cloud, cell, point));
            for axis in 0..D {
                for other in 0..D {
                    squares[(axis, other)] += y[axis] * y[other];
                }
                for k in 0..4 {
                    products[k][axis] += y[axis] * (row[k] - rows[0][k]);
                }
            }
        }
        let Some(slopes) = slopes(n, squares, products) else { return (rows, false) };
        for (k, slopes) in slopes.iter().enumerate() {
            for axis in 0..D {
                rows[1 + axis][k] = slopes[axis];
            }
        }
        (rows, true)
    }
}
