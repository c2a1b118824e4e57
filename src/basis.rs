//! Polynomial bases of moving least squares and their small symmetric systems.

use std::ops::Mul;

use crate::Scalar;
use crate::math::{Field, MAX_COMPONENTS};
use crate::simd::{Simd, SimdBase as _, splat};

/// Least ratio of a pivot to the total weight for which a moment matrix counts as regular.
///
/// Offsets are in units of the support's half width, so the first-order pivots are the variances
/// of the points' offsets; 10⁻⁵ is a cloud 0.3 % of the support thick.
pub const SINGULAR_PIVOT: f64 = 1e-5;

/// A polynomial basis about the target point: the first function is 1, the others vanish there.
///
/// ```
/// use transpoint::basis::{Linear, PolynomialBasis};
/// let values = <Linear as PolynomialBasis<f64, 2>>::values(1.0, [0.25, -0.5]);
/// assert_eq!(values, [1.0, 0.25, -0.5]);
/// ```
pub trait PolynomialBasis<T: Scalar, const D: usize>: Copy + Send + Sync + 'static {
    /// Values of the M basis functions, `[V; M]`, at one point or at several side by side.
    type Values<V: Copy>;
    /// The normal equations of a fit with this basis.
    type System<S: Simd>: MomentSystem<T, S, Values = Self::Values<T::Four<S>>>;

    /// Evaluates the basis at an offset in units of the support's half width; `one` is 1.
    fn values<V: Copy + Mul<Output = V>>(one: V, offset: [V; D]) -> Self::Values<V>;
}

/// The constant basis {1}: Shepard's interpolation, \[Shepard1968\].
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Constant;

/// The linear basis {1, x, y, z}.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Linear;

/// The full quadratic basis {1, x, y, z, x², xy, …}.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Quadratic;

macro_rules! basis {
    ($basis:ty, $dimension:literal, $length:literal, |$one:ident, $x:ident| $values:expr) => {
        impl<T: Scalar> PolynomialBasis<T, $dimension> for $basis {
            type Values<V: Copy> = [V; $length];
            type System<S: Simd> = Moments<T, S, $length>;

            #[inline(always)]
            fn values<V: Copy + Mul<Output = V>>($one: V, $x: [V; $dimension]) -> [V; $length] {
                $values
            }
        }
    };
}

basis!(Constant, 1, 1, |one, _x| [one]);
basis!(Constant, 2, 1, |one, _x| [one]);
basis!(Constant, 3, 1, |one, _x| [one]);
basis!(Linear, 1, 2, |one, x| [one, x[0]]);
basis!(Linear, 2, 3, |one, x| [one, x[0], x[1]]);
basis!(Linear, 3, 4, |one, x| [one, x[0], x[1], x[2]]);
basis!(Quadratic, 1, 3, |one, x| [one, x[0], x[0] * x[0]]);
basis!(Quadratic, 2, 6, |one, x| [one, x[0], x[1], x[0] * x[0], x[0] * x[1], x[1] * x[1]]);
basis!(Quadratic, 3, 10, |one, x| [
    one,
    x[0],
    x[1],
    x[2],
    x[0] * x[0],
    x[0] * x[1],
    x[0] * x[2],
    x[1] * x[1],
    x[1] * x[2],
    x[2] * x[2]
]);

/// The normal equations of a moving-least-squares fit, accumulated four points at a time.
pub trait MomentSystem<T: Scalar, S: Simd>: Sized {
    /// Basis values at four points.
    type Values;

    /// An empty system.
    fn empty(simd: S) -> Self;

    /// Adds four points with weights φ, basis values P and the components of a field.
    fn add(&mut self, weight: T::Four<S>, values: &Self::Values, components: &[T::Four<S>]);

    /// Adds the membership (0 to 1) of four points, which the positivity limiter needs.
    fn add_own(&mut self, weight: T::Four<S>, values: &Self::Values, own: T::Four<S>);

    /// Value at the target of the fit of the field that was added, or why there is none.
    fn solve<F: Field<T>>(&self, limiters: Limiters<T>) -> Fit<F>;
}

/// Limiters of a fit; each is off where it is `None`.
#[derive(Clone, Copy, Debug, Default, PartialEq)]
pub struct Limiters<T> {
    /// Most leverage Λ > 0: the noise of the points' values is amplified at most 1 + Λ times, in
    /// squares, compared to the constant fit.
    ///
    /// ```text
    /// Σ Φ_p² / φ_p = (1 + ℓ) / Σ φ_p,   ℓ = δᵀ C⁻¹ δ
    /// ```
    ///
    /// ℓ is the leverage \[HoaglinWelsch1978\] of the target, at δ from the points' weighted mean, and C their covariance. Points
    /// that line up along a wall let a fit extrapolate from their least scatter; where ℓ > Λ the gradient is
    /// scaled by √(Λ/ℓ).
    pub leverage: Option<T>,
    /// Least share θ of the constant fit's weight that the target's own points keep, `0 ≤ θ < 1`.
    pub positivity: Option<T>,
}

/// Result of a fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fit<F> {
    /// No point has weight.
    Empty,
    /// The full basis.
    Regular(F),
    /// The full basis, its gradient reduced by the limiter of the leverage alone.
    Tempered(F),
    /// The full basis, its gradient reduced by the positivity limiter.
    Limited(F),
    /// Too few or degenerate points: the constant basis.
    Constant(F),
}

impl<F> Fit<F> {
    /// The value, if there is one.
    pub fn value(self) -> Option<F> {
        match self {
            Self::Empty => None,
            Self::Regular(value)
            | Self::Tempered(value)
            | Self::Limited(value)
            | Self::Constant(value) => Some(value),
        }
    }
}

/// A = Σ φ P Pᵀ, b = Σ φ P q for each component q of the field, and Σ φ P over own points.
///
/// Each sum is four, over every fourth point of a run, that are added up in the end.
#[derive(Clone, Copy, Debug)]
pub struct Moments<T: Scalar, S: Simd, const M: usize> {
    simd: S,
    matrix: [[T::Four<S>; M]; M],
    field: [[T::Four<S>; M]; MAX_COMPONENTS],
    own: [T::Four<S>; M],
}

impl<T: Scalar, S: Simd, const M: usize> MomentSystem<T, S> for Moments<T, S, M> {
    type Values = [T::Four<S>; M];

    #[inline(always)]
    fn empty(simd: S) -> Self {
        let zero = [splat(simd, T::zero()); M];
        Self { simd, matrix: [zero; M], field: [zero; MAX_COMPONENTS], own: zero }
    }

    #[inline(always)]
    fn add(&mut self, weight: T::Four<S>, values: &Self::Values, components: &[T::Four<S>]) {
        for i in 0..M {
            // The first basis function is 1.
            let weighted = if i == 0 { weight } else { weight * values[i] };
            self.matrix[i][0] += weighted;
            for j in 1..=i {
                self.matrix[i][j] += weighted * values[j];
            }
            for (sums, component) in self.field.iter_mut().zip(components) {
                sums[i] += weighted * *component;
            }
        }
    }

    #[inline(always)]
    fn add_own(&mut self, weight: T::Four<S>, values: &Self::Values, own: T::Four<S>) {
        for i in 0..M {
            self.own[i] += weight * values[i] * own;
        }
    }

    #[inline(always)]
    fn solve<F: Field<T>>(&self, limiters: Limiters<T>) -> Fit<F> {
        let mut matrix = [[T::zero(); M]; M];
        for i in 0..M {
            for j in 0..=i {
                matrix[i][j] = self.matrix[i][j].reduce_sum();
            }
        }
        let total = matrix[0][0];
        if !(total > T::zero()) {
            return Fit::Empty;
        }
        let Some(mut coefficients) = first_column_of_inverse(&matrix) else {
            let mut constant = [T::zero(); M];
            constant[0] = T::one() / total;
            return Fit::Constant(self.combine(&constant));
        };
        let tempered =
            limiters.leverage.is_some_and(|most| limit_leverage(&mut coefficients, total, most));
        let limited = limiters.positivity.is_some_and(|theta| {
            let mut own = [T::zero(); M];
            for i in 0..M {
                own[i] = self.own[i].reduce_sum();
            }
            limit_own_weight(&mut coefficients, &own, total, theta)
        });
        let value = self.combine(&coefficients);
        match (limited, tempered) {
            (true, _) => Fit::Limited(value),
            (false, true) => Fit::Tempered(value),
            (false, false) => Fit::Regular(value),
        }
    }
}

impl<T: Scalar, S: Simd, const M: usize> Moments<T, S, M> {
    /// c · b for each component.
    #[inline(always)]
    fn combine<F: Field<T>>(&self, coefficients: &[T; M]) -> F {
        let mut components = [T::zero(); MAX_COMPONENTS];
        for (component, sums) in components[..F::COMPONENTS].iter_mut().zip(&self.field) {
            let mut sum = sums[0] * splat(self.simd, coefficients[0]);
            for i in 1..M {
                sum += sums[i] * splat(self.simd, coefficients[i]);
            }
            *component = sum.reduce_sum();
        }
        F::read(&components[..F::COMPONENTS])
    }
}

/// Positivity limiter: keeps the weight of the target's own points at θ of its Shepard value.
///
/// With `a` the own weight of the constant fit and `a − b` that of the full fit, the correction is
/// scaled by `λ = (1 − θ) a / b` where `a − b < θ a`. Linear moving least squares can give the points
/// of a cell a negative total weight in their own cell, which turns their pressure around.
#[inline(always)]
fn limit_own_weight<T: Scalar, const M: usize>(
    coefficients: &mut [T; M],
    own: &[T; M],
    total: T,
    theta: T,
) -> bool {
    let constant = own[0] / total;
    let full = crate::math::dot(*coefficients, *own);
    if full >= theta * constant {
        return false;
    }
    let lambda = (T::one() - theta) * constant / (constant - full);
    blend_with_constant(coefficients, total, lambda);
    true
}

/// Limiter of the leverage, see [`Limiters::leverage`].
#[inline(always)]
fn limit_leverage<T: Scalar, const M: usize>(coefficients: &mut [T; M], total: T, most: T) -> bool {
    let leverage = coefficients[0] * total - T::one();
    if leverage <= most {
        return false;
    }
    blend_with_constant(coefficients, total, (most / leverage).sqrt());
    true
}

/// λ times the full fit and 1 − λ times the constant one.
#[inline(always)]
fn blend_with_constant<T: Scalar, const M: usize>(coefficients: &mut [T; M], total: T, lambda: T) {
    for coefficient in coefficients.iter_mut() {
        *coefficient *= lambda;
    }
    coefficients[0] += (T::one() - lambda) / total;
}

/// First column of the inverse of a symmetric matrix given by its lower triangle.
///
/// `None` when a pivot falls below [`SINGULAR_PIVOT`] times the total weight (first entry).
#[inline(always)]
fn first_column_of_inverse<T: Scalar, const M: usize>(matrix: &[[T; M]; M]) -> Option<[T; M]> {
    if M == 3 { by_cofactors(matrix) } else { by_elimination(matrix) }
}

/// Three by three: the last two pivots at once, since a chain of divisions takes longest.
#[inline(always)]
fn by_cofactors<T: Scalar, const M: usize>(a: &[[T; M]; M]) -> Option<[T; M]> {
    let total = a[0][0];
    let per_total = T::one() / total;
    let mean = [a[1][0] * per_total, a[2][0] * per_total];
    let xx = a[1][1] - mean[0] * a[1][0];
    let xy = a[2][1] - mean[0] * a[2][0];
    let yy = a[2][2] - mean[1] * a[2][0];
    let determinant = xx * yy - xy * xy;
    let smallest = T::lit(SINGULAR_PIVOT) * total;
    if !(xx > smallest && determinant > smallest * xx) {
        return None;
    }
    let inverse = T::one() / determinant;
    let mut x = [T::zero(); M];
    x[1] = (mean[1] * xy - mean[0] * yy) * inverse;
    x[2] = (mean[0] * xy - mean[1] * xx) * inverse;
    x[0] = per_total - mean[0] * x[1] - mean[1] * x[2];
    Some(x)
}

/// By elimination (LDLᵀ).
#[inline(always)]
fn by_elimination<T: Scalar, const M: usize>(matrix: &[[T; M]; M]) -> Option<[T; M]> {
    let mut factor = *matrix;
    let smallest = T::lit(SINGULAR_PIVOT) * matrix[0][0];
    let mut inverse_pivot = [T::zero(); M];
    for j in 0..M {
        for k in 0..j {
            let l = factor[j][k];
            factor[j][j] -= l * l * inverse_pivot[k];
        }
        if !(factor[j][j] > smallest) {
            return None;
        }
        inverse_pivot[j] = T::one() / factor[j][j];
        for i in j + 1..M {
            for k in 0..j {
                let product = factor[i][k] * factor[j][k] * inverse_pivot[k];
                factor[i][j] -= product;
            }
        }
    }
    let mut x = [T::zero(); M];
    x[0] = T::one();
    for i in 1..M {
        for k in 0..i {
            x[i] -= factor[i][k] * inverse_pivot[k] * x[k];
        }
    }
    for i in (0..M).rev() {
        x[i] *= inverse_pivot[i];
        for k in i + 1..M {
            x[i] -= factor[k][i] * inverse_pivot[i] * x[k];
        }
    }
    Some(x)
}
