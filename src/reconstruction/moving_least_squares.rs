//! Moving least squares on a square (cubic) support, Eqs. (17)-(20) of \[Song2020\].

use std::marker::PhantomData;
use std::ops::Range;

use super::{Cloud, Neighborhood, Reconstruction};
use crate::Scalar;
use crate::basis::{Fit, Limiters, MomentSystem, PolynomialBasis};
use crate::math::{Field, MAX_COMPONENTS};
use crate::simd::{Simd, SimdBase as _, load, splat};

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

/// Four points side by side: positions, m, and the components of a field.
struct Quad<V, const D: usize> {
    position: [V; D],
    components: [V; MAX_COMPONENTS],
}

impl<V, const D: usize> Quad<V, D> {
    /// The first four points of a run; where there are fewer, the last one several times.
    #[inline(always)]
    fn first_of<T, S, F>(
        simd: S,
        position: &[[T; D]],
        field: &impl Fn(usize) -> F,
        run: Range<u32>,
    ) -> Self
    where
        T: Scalar<Four<S> = V>,
        S: Simd,
        V: Copy,
        F: Field<T>,
    {
        let (first, last) = (run.start as usize, run.end as usize - 1);
        if run.len() >= 4 {
            Self::gather(
                simd,
                position,
                field,
                #[inline(always)]
                |lane| first + lane,
            )
        } else {
            Self::gather(
                simd,
                position,
                field,
                #[inline(always)]
                |lane| (first + lane).min(last),
            )
        }
    }

    /// Takes the points with four numbers.
    #[inline(always)]
    fn gather<T, S, F>(
        simd: S,
        position: &[[T; D]],
        field: &impl Fn(usize) -> F,
        number: impl Fn(usize) -> usize,
    ) -> Self
    where
        T: Scalar<Four<S> = V>,
        S: Simd,
        V: Copy,
        F: Field<T>,
    {
        let zero = T::zero();
        let mut at = [[zero; 4]; D];
        let mut values = [[zero; 4]; MAX_COMPONENTS];
        // The last one first: one check of its bounds then covers all four.
        for lane in (0..4).rev() {
            let point = number(lane);
            for axis in 0..D {
                at[axis][lane] = position[point][axis];
            }
            let mut components = [zero; MAX_COMPONENTS];
            field(point).write(&mut components[..F::COMPONENTS]);
            for k in 0..F::COMPONENTS {
                values[k][lane] = components[k];
            }
        }
        let none = splat(simd, zero);
        let mut quad = Self { position: [none; D], components: [none; MAX_COMPONENTS] };
        for axis in 0..D {
            quad.position[axis] = load(simd, &at[axis]);
        }
        for k in 0..F::COMPONENTS {
            quad.components[k] = load(simd, &values[k]);
        }
        quad
    }
}

impl<B, T: Scalar> MovingLeastSquares<B, T> {
    #[inline(always)]
    fn fit<S: Simd, F: Field<T>, const D: usize>(
        &self,
        simd: S,
        cloud: &Cloud<'_, T, D>,
        target: [T; D],
        own: impl Fn([T::Four<S>; D]) -> T::Four<S>,
        field: impl Fn(usize) -> F,
    ) -> Fit<F>
    where
        B: PolynomialBasis<T, D>,
    {
        let mut system = B::System::<S>::empty(simd);
        if self.limiters.positivity.is_none() {
            self.add_points::<S, F, D, false>(simd, cloud, target, own, field, &mut system);
        } else {
            self.add_points::<S, F, D, true>(simd, cloud, target, own, field, &mut system);
        }
        system.solve(self.limiters)
    }

    /// Four points of a run at a time; the last four are filled up with points of no weight.
    #[inline(always)]
    fn add_points<S: Simd, F: Field<T>, const D: usize, const LIMITS: bool>(
        &self,
        simd: S,
        cloud: &Cloud<'_, T, D>,
        target: [T; D],
        own: impl Fn([T::Four<S>; D]) -> T::Four<S>,
        field: impl Fn(usize) -> F,
        system: &mut B::System<S>,
    ) where
        B: PolynomialBasis<T, D>,
    {
        const { assert!(F::COMPONENTS <= MAX_COMPONENTS, "a field with too many components") };
        let one = splat(simd, T::one());
        let per_support = T::one() / self.support;
        let scale: [T; D] = std::array::from_fn(
            #[inline(always)]
            |axis| cloud.grid.inverse_spacing[axis] * per_support,
        );
        let neighborhood = Neighborhood::around(cloud.grid, target, self.support);
        cloud.visit_runs(
            neighborhood,
            target,
            #[inline(always)]
            |run, base| {
                // One product and one sum per coordinate: origin and target are taken together.
                let mut shift = [one; D];
                for axis in 0..D {
                    let corner = cloud.grid.origin[axis] * scale[axis];
                    shift[axis] = splat(simd, base[axis] * per_support - corner);
                }
                let mut first = run.start;
                while first < run.end {
                    let left = run.end - first;
                    let quad = Quad::first_of(simd, cloud.position, &field, first..run.end);
                    let mut offset = quad.position;
                    let mut phi = one;
                    for axis in 0..D {
                        offset[axis] = offset[axis] * splat(simd, scale[axis]) + shift[axis];
                        let along = weights::<T, S>(simd, offset[axis]);
                        phi = if axis == 0 { along } else { phi * along };
                    }
                    if left < 4 {
                        let mut within = [T::zero(); 4];
                        within[..left as usize].fill(T::one());
                        phi *= load(simd, &within);
                    }
                    let values = B::values(one, offset);
                    system.add(phi, &values, &quad.components[..F::COMPONENTS]);
                    if LIMITS {
                        for axis in 0..D {
                            offset[axis] *= splat(simd, self.support);
                        }
                        system.add_own(phi, &values, own(offset));
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
    fn fit_center<S: Simd, F: Field<T>>(
        &self,
        simd: S,
        cloud: &Cloud<'_, T, D>,
        cell: [usize; D],
        field: impl Fn(usize) -> F,
    ) -> Fit<F> {
        let target = cell.map(|c| T::from_index(c) + T::lit(0.5));
        self.fit(
            simd,
            cloud,
            target,
            #[inline(always)]
            |offset| {
                let mut own = [T::one(); 4];
                for distance in offset {
                    let distance = distance.abs().to_array();
                    for lane in 0..4 {
                        if !(distance[lane] <= T::lit(0.5)) {
                            own[lane] = T::zero();
                        }
                    }
                }
                load(simd, &own)
            },
            field,
        )
    }

    /// Points belong to a node by their hat weight.
    #[inline(always)]
    fn fit_node<S: Simd, F: Field<T>>(
        &self,
        simd: S,
        cloud: &Cloud<'_, T, D>,
        node: [T; D],
        field: impl Fn(usize) -> F,
    ) -> Fit<F> {
        let (zero, one) = (splat(simd, T::zero()), splat(simd, T::one()));
        self.fit(
            simd,
            cloud,
            node,
            #[inline(always)]
            |offset| {
                let mut hat = one;
                for distance in offset {
                    hat *= (one - distance.abs()).max(zero);
                }
                hat
            },
            field,
        )
    }
}
