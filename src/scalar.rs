//! The floating-point type of a simulation.

#![expect(clippy::inline_always, reason = "conversions of literals must vanish in hot kernels")]

use nalgebra::RealField;
use num_traits::{FromPrimitive, ToPrimitive};

/// A real scalar, `f32` or `f64`.
///
/// `num_traits::Float` is left out on purpose: together with [`RealField`] it makes every call of
/// `sqrt`, `abs` and the like ambiguous.
///
/// ```
/// use transpoint::Scalar;
/// fn half<T: Scalar>(x: T) -> T { x * T::lit(0.5) }
/// assert_eq!(half(3.0_f32), 1.5);
/// ```
pub trait Scalar: RealField + FromPrimitive + ToPrimitive + Copy {
    /// Converts a literal, rounding to the nearest value of this type.
    fn lit(x: f64) -> Self;

    /// Converts to `f64` for reports; exact for both `f32` and `f64`.
    fn as_f64(self) -> f64;

    /// Drops the fraction; NaN gives zero and values out of range saturate.
    fn truncate_to_i64(self) -> i64;
}

impl Scalar for f32 {
    #[inline(always)]
    fn lit(x: f64) -> Self {
        x as f32
    }

    #[inline(always)]
    fn as_f64(self) -> f64 {
        f64::from(self)
    }

    #[inline(always)]
    fn truncate_to_i64(self) -> i64 {
        self as i64
    }
}

impl Scalar for f64 {
    #[inline(always)]
    fn lit(x: f64) -> Self {
        x
    }

    #[inline(always)]
    fn as_f64(self) -> f64 {
        self
    }

    #[inline(always)]
    fn truncate_to_i64(self) -> i64 {
        self as i64
    }
}
