//! Polynomial bases of moving least squares and their small symmetric systems.

use crate::Scalar;
use crate::math::Field;

/// Least ratio of a pivot to the total weight for which a moment matrix counts as regular.
///
/// Offsets are in units of the support's half width, so the first-order pivots are the variances
/// of the points' offsets; 10⁻⁵ is a cloud 0.3 % of the support thick.
pub const SINGULAR_PIVOT: f64 = 1e-5;

/// A polynomial basis about the target point: the first function is 1, the others vanish there.
///
/// ```
/// use transpoint::basis::{Linear, PolynomialBasis};
/// assert_eq!(<Linear as PolynomialBasis<f64, 2>>::values([0.25, -0.5]), [1.0, 0.25, -0.5]);
/// ```
pub trait PolynomialBasis<T: Scalar, const D: usize>: Copy + Send + Sync + 'static {
    /// Values of the basis functions, `[T; M]`.
    type Values: BasisValues<T>;

    /// Evaluates the basis at an offset in units of the support's half width.
    fn values(offset: [T; D]) -> Self::Values;
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

impl<T: Scalar, const D: usize> PolynomialBasis<T, D> for Constant {
    type Values = [T; 1];

    #[inline(always)]
    fn values(_offset: [T; D]) -> [T; 1] {
        [T::one()]
    }
}

macro_rules! basis {
    ($basis:ty, $dimension:literal, $length:literal, |$x:ident| $values:expr) => {
        impl<T: Scalar> PolynomialBasis<T, $dimension> for $basis {
            type Values = [T; $length];

            #[inline(always)]
            fn values($x: [T; $dimension]) -> [T; $length] {
                $values
            }
        }
    };
}

basis!(Linear, 1, 2, |x| [T::one(), x[0]]);
basis!(Linear, 2, 3, |x| [T::one(), x[0], x[1]]);
basis!(Linear, 3, 4, |x| [T::one(), x[0], x[1], x[2]]);
basis!(Quadratic, 1, 3, |x| [T::one(), x[0], x[0] * x[0]]);
basis!(Quadratic, 2, 6, |x| [T::one(), x[0], x[1], x[0] * x[0], x[0] * x[1], x[1] * x[1]]);
basis!(Quadratic, 3, 10, |x| [
    T::one(),
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

/// An array of basis values, and the system it belongs to.
pub trait BasisValues<T: Scalar>: Copy + Send + Sync {
    /// Moments of a point cloud with the sums of one field.
    type System<F: Field<T>>: MomentSystem<T, F, Values = Self>;
}

impl<T: Scalar, const M: usize> BasisValues<T> for [T; M] {
    type System<F: Field<T>> = Moments<T, F, M>;
}

/// The normal equations of a moving-least-squares fit, accumulated point by point.
pub trait MomentSystem<T: Scalar, F: Field<T>>: Sized {
    /// Basis values.
    type Values;

    /// An empty system.
    fn empty() -> Self;

    /// Adds a point with weight φ, basis values P, membership `own` (0 to 1) and field value.
    fn add(&mut self, weight: T, values: &Self::Values, own: T, field: F);

    /// Value of the fit at the target, or why there is none.
    ///
    /// `positivity` is θ of the positivity limiter.
    fn solve(&self, positivity: Option<T>) -> Fit<F>;
}

/// Result of a fit.
#[derive(Clone, Copy, Debug, PartialEq)]
pub enum Fit<F> {
    /// No point has weight.
    Empty,
    /// The full basis.
    Regular(F),
    /// The full basis, its gradient correction reduced by the positivity limiter.
    Limited(F),
    /// Too few or degenerate points: the constant basis.
    Constant(F),
}

impl<F> Fit<F> {
    /// The value, if there is one.
    pub fn value(self) -> Option<F> {
        match self {
            Self::Empty => None,
            Self::Regular(value) | Self::Limited(value) | Self::Constant(value) => Some(value),
        }
    }
}

/// A = Σ φ P Pᵀ, b = Σ φ P q and Σ φ P over own points.
#[derive(Clone, Copy, Debug)]
pub struct Moments<T, F, const M: usize> {
    matrix: [[T; M]; M],
    field: [F; M],
    own: [T; M],
}

impl<T: Scalar, F: Field<T>, const M: usize> MomentSystem<T, F> for Moments<T, F, M> {
    type Values = [T; M];

    #[inline(always)]
    fn empty() -> Self {
        Self { matrix: [[T::zero(); M]; M], field: [F::default(); M], own: [T::zero(); M] }
    }

    #[inline(always)]
    fn add(&mut self, weight: T, values: &[T; M], own: T, field: F) {
        for i in 0..M {
            let weighted = weight * values[i];
            for j in 0..=i {
                self.matrix[i][j] += weighted * values[j];
            }
            self.field[i].add_scaled(weighted, field);
            self.own[i] += weighted * own;
        }
    }

    #[inline(always)]
    fn solve(&self, positivity: Option<T>) -> Fit<F> {
        let total = self.matrix[0][0];
        if !(total > T::zero()) {
            return Fit::Empty;
        }
        let Some(mut coefficients) = first_column_of_inverse(&self.matrix) else {
            let mut value = F::default();
            value.add_scaled(T::one() / total, self.field[0]);
            return Fit::Constant(value);
        };
        let limited = positivity
            .is_some_and(|theta| limit_own_weight(&mut coefficients, &self.own, total, theta));
        let mut value = F::default();
        for k in 0..M {
            value.add_scaled(coefficients[k], self.field[k]);
        }
        if limited { Fit::Limited(value) } else { Fit::Regular(value) }
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
    for coefficient in coefficients.iter_mut() {
        *coefficient *= lambda;
    }
    coefficients[0] += (T::one() - lambda) / total;
    true
}

/// First column of the inverse of a symmetric matrix given by its lower triangle (LDLᵀ).
///
/// `None` when a pivot falls below [`SINGULAR_PIVOT`] times the total weight (first entry).
#[inline(always)]
fn first_column_of_inverse<T: Scalar, const M: usize>(matrix: &[[T; M]; M]) -> Option<[T; M]> {
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
