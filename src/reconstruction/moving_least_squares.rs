//! Moving least squares on a square (cubic) support, Eqs. (17)-(20) of \[Song2020\].

use std::marker::PhantomData;

use super::{Cloud, Neighborhood, Reconstruction};
use crate::Scalar;
use crate::basis::{BasisValues, Fit, MomentSystem, PolynomialBasis};
use crate::math::Field;

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
    /// θ of the positivity limiter, `0 ≤ θ < 1`; `None`: off.
    pub positivity: Option<T>,
    /// The polynomial basis.
    pub basis: PhantomData<B>,
}

impl<B, T: Scalar> MovingLeastSquares<B, T> {
    /// Unlimited reconstruction with the given half width in cells.
    pub fn new(support: T) -> Self {
        Self { support, positivity: None, basis: PhantomData }
    }
}

/// Cubic spline on [−1, 1], w(0) = 2/3, written with truncated powers so that it has no branch.
///
/// ```text
/// w(r) = 4/3 [(1 − |r|)₊³ − 4 (1/2 − |r|)₊³]
/// ```
#[inline(always)]
pub fn weight<T: Scalar>(r: T) -> T {
    let distance = r.abs();
    let outer = (T::one() - distance).max(T::zero());
    let inner = (T::lit(0.5) - distance).max(T::zero());
    T::lit(4.0 / 3.0) * (outer * outer * outer - T::lit(4.0) * (inner * inner * inner))
}

impl<B, T: Scalar> MovingLeastSquares<B, T> {
    #[inline(always)]
    fn fit<F: Field<T>, const D: usize>(
        &self,
        cloud: &Cloud<'_, T, D>,
        target: [T; D],
        own: impl Fn([T; D]) -> T,
        field: impl Fn(usize) -> F,
    ) -> Fit<F>
    where
        B: PolynomialBasis<T, D>,
    {
        let mut system = <B::Values as BasisValues<T>>::System::<F>::empty();
        let per_support = T::one() / self.support;
        let limits = self.positivity.is_some();
        let neighborhood = Neighborhood::around(cloud.grid, target, self.support);
        cloud.visit(
            neighborhood,
            target,
            #[inline(always)]
            |point, offset| {
                let mut scaled = offset;
                let mut phi = T::one();
                for axis in 0..D {
                    scaled[axis] *= per_support;
                    phi *= weight(scaled[axis]);
                }
                if phi > T::zero() {
                    let own = if limits { own(offset) } else { T::zero() };
                    system.add(phi, &B::values(scaled), own, field(point));
                }
            },
        );
        system.solve(self.positivity)
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

    /// Own points are those of the cell.
    #[inline(always)]
    fn at_center<F: Field<T>>(
        &self,
        cloud: &Cloud<'_, T, D>,
        cell: [usize; D],
        field: impl Fn(usize) -> F,
    ) -> Fit<F> {
        let half = T::lit(0.5);
        let target = cell.map(|c| T::lit(c as f64 + 0.5));
        let own = |offset: [T; D]| {
            if offset.iter().all(|x| x.abs() <= half) { T::one() } else { T::zero() }
        };
        self.fit(cloud, target, own, field)
    }

    /// Points belong to a node by their hat weight.
    #[inline(always)]
    fn at_node<F: Field<T>>(
        &self,
        cloud: &Cloud<'_, T, D>,
        node: [T; D],
        field: impl Fn(usize) -> F,
    ) -> Fit<F> {
        let own = |offset: [T; D]| {
            offset.iter().fold(T::one(), |hat, x| hat * (T::one() - x.abs()).max(T::zero()))
        };
        self.fit(cloud, node, own, field)
    }
}
