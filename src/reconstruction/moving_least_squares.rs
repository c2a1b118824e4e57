//! Moving least squares on a square (cubic) support, Eqs. (17)-(20) of \[Song2020\].

use std::marker::PhantomData;

use super::{Cloud, Neighborhood, PointField, Reconstruction};
use crate::Scalar;
use crate::basis::{Fit, Limiters, MomentSystem, PolynomialBasis};
use crate::math::{Field, MAX_COMPONENTS};
use crate::simd::{Select as _, Simd, SimdBase as _, splat};

/// Moving least squares, \[LancasterSalkauskas1981\], with a product of cubic splines as weight.
///
/// ```text
/// q(x) = Σ_p Φ_p q_p,   Φ_p = φ_p P(x_p − x)ᵀ A⁻¹ P(0),   A = Σ_p φ_p P Pᵀ
/// ```
///
/// Where A is nearly singular the constant basis takes over; such fits are counted.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct MovingLeastSquares<B, T> {
    /// Half width R of the support, cells, `0.5 < R ≤ 4`.
    pub support: T,
    /// What keeps the fits from extrapolating; off by default.
    pub limiters: Limiters<T>,
    /// The polynomial basis.
    pub basis: PhantomData<B>,
}

impl<B, T: Scalar> MovingLeastSquares<B, T> {
    /// Unlimited reconstruction with the given half width in cells.
    pub fn new(support: T) -> Self {
        let limiters = Limiters { leverage: None, positivity: None };
        Self { support, limiters, basis: PhantomData }
    }
}

/// Cubic spline on [−1, 1] at four points, written with truncated powers so that it has no branch.
///
/// ```text
/// w(r) = (1 − |r|)₊³ − 4 (1/2 − |r|)₊³
/// ```
///
/// This is 3/4 of the spline's usual size; a constant factor cancels in every fit.
#[inline(always)]
fn weights<T: Scalar, S: Simd>(simd: S, r: T::Four<S>) -> T::Four<S> {
    let zero = splat(simd, T::zero());
    let distance = r.abs();
    let outer = (splat(simd, T::one()) - distance).max(zero);
    let inner = (splat(simd, T::lit(0.5)) - distance).max(zero);
    outer * outer * outer - splat(simd, T::lit(4.0)) * (inner * inner * inner)
}

/// Which points belong to a target, for the positivity limiter: those at offsets below `reach` cells along
/// every axis, and how much.
struct Own<W, T> {
    reach: T,
    weight: W,
}

impl<W, T: Scalar> Own<W, T> {
    fn within(reach: T, weight: W) -> Self {
        Self { reach, weight }
    }

    /// Whether points of a row of cells may belong to the target, by the axes across the row.
    #[inline(always)]
    fn has_row<const D: usize>(&self, row: [i32; D], target: [T; D]) -> bool {
        let half = T::lit(0.5);
        (0..D - 1).all(|axis| {
            let middle = T::lit(f64::from(row[axis])) + half;
            (middle - target[axis]).abs() < self.reach + half
        })
    }
}

impl<B, T: Scalar> MovingLeastSquares<B, T> {
    #[inline(always)]
    fn fit<S: Simd, P: PointField<T, D>, const D: usize>(
        &self,
        simd: S,
        cloud: &Cloud<'_, T, D>,
        target: [T; D],
        own: &Own<impl Fn([T::Four<S>; D]) -> T::Four<S>, T>,
        field: &P,
    ) -> Fit<P::Field>
    where
        B: PolynomialBasis<T, D>,
    {
        let mut system = B::System::<S>::empty(simd);
        if self.limiters.positivity.is_none() {
            self.add_points::<S, P, D, false>(simd, cloud, target, own, field, &mut system);
        } else {
            self.add_points::<S, P, D, true>(simd, cloud, target, own, field, &mut system);
        }
        system.solve(self.limiters)
    }

    /// Four points of a run at a time; beyond its end they have no weight.
    #[inline(always)]
    fn add_points<S: Simd, P: PointField<T, D>, const D: usize, const LIMITS: bool>(
        &self,
        simd: S,
        cloud: &Cloud<'_, T, D>,
        target: [T; D],
        own: &Own<impl Fn([T::Four<S>; D]) -> T::Four<S>, T>,
        field: &P,
        system: &mut B::System<S>,
    ) where
        B: PolynomialBasis<T, D>,
    {
        const {
            assert!(P::Field::COMPONENTS <= MAX_COMPONENTS, "a field with too many components");
        };
        let one = splat(simd, T::one());
        let per_support = T::one() / self.support;
        let scale: [T; D] = std::array::from_fn(
            #[inline(always)]
            |axis| cloud.grid.inverse_spacing[axis] * per_support,
        );
        let mut within = [T::zero(); 8];
        within[..4].fill(T::one());
        let neighborhood = Neighborhood::around(cloud.grid, target, self.support);
        cloud.visit_runs(
            neighborhood,
            target,
            #[inline(always)]
            |run, base, row| {
                // One product and one sum per coordinate: origin and target are taken together.
                let mut shift = [one; D];
                for axis in 0..D {
                    let corner = cloud.grid.origin[axis] * scale[axis];
                    shift[axis] = splat(simd, base[axis] * per_support - corner);
                }
                let is_own = LIMITS && own.has_row(row, target);
                let points = field.run(cloud, run.start as usize..run.end as usize);
                let (mut first, end) = (0, run.len());
                while first < end {
                    let quad = field.quad(simd, &points, first);
                    let mut offset = quad.position;
                    let mut phi = one;
                    for axis in 0..D {
                        offset[axis] = offset[axis] * splat(simd, scale[axis]) + shift[axis];
                        let along = weights::<T, S>(simd, offset[axis]);
                        phi = if axis == 0 { along } else { phi * along };
                    }
                    let skipped = 4 - (end - first).min(4);
                    phi *= T::Four::<S>::from_slice(simd, &within[skipped..skipped + 4]);
                    let values = B::values(one, offset);
                    system.add(phi, &values, &quad.components[..P::Field::COMPONENTS]);
                    if is_own {
                        for axis in 0..D {
                            offset[axis] *= splat(simd, self.support);
                        }
                        system.add_own(phi, &values, (own.weight)(offset));
                    }
                    first += 4;
                }
            },
        );
    }
}

impl<T, const D: usize, B> Reconstruction<T, D> for MovingLeastSquares<B, T>
where
    T: Scalar,
    B: PolynomialBasis<T, D>,
{
    const REBUILDS_NODES: bool = true;

    #[inline(always)]
    fn support(&self) -> T {
        self.support
    }

    fn unlimited(&self, least: T) -> Self {
        Self {
            support: self.support.max(least),
            limiters: Limiters { positivity: None, ..self.limiters },
            ..*self
        }
    }

    /// Own points are those of the cell.
    #[inline(always)]
    fn fit_center<S: Simd, P: PointField<T, D>>(
        &self,
        simd: S,
        cloud: &Cloud<'_, T, D>,
        cell: [usize; D],
        field: P,
    ) -> Fit<P::Field> {
        let target = cell.map(|c| T::from_index(c) + T::lit(0.5));
        let half = T::lit(0.5);
        let (zero, one) = (splat(simd, T::zero()), splat(simd, T::one()));
        let own = Own::within(
            half,
            #[inline(always)]
            |offset: [T::Four<S>; D]| {
                let mut own = one;
                for distance in offset {
                    own = distance.abs().simd_le(splat(simd, half)).select(own, zero);
                }
                own
            },
        );
        self.fit(simd, cloud, target, &own, &field)
    }

    /// Points belong to a node by their hat weight.
    #[inline(always)]
    fn fit_node<S: Simd, P: PointField<T, D>>(
        &self,
        simd: S,
        cloud: &Cloud<'_, T, D>,
        node: [T; D],
        field: P,
    ) -> Fit<P::Field> {
        let (zero, one) = (splat(simd, T::zero()), splat(simd, T::one()));
        let own = Own::within(
            T::one(),
            #[inline(always)]
            |offset: [T::Four<S>; D]| {
                let mut hat = one;
                for distance in offset {
                    hat *= (one - distance.abs()).max(zero);
                }
                hat
            },
        );
        self.fit(simd, cloud, node, &own, &field)
    }
}
