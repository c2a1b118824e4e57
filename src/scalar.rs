//! The floating-point type of a simulation.

use std::ops::{Add, Mul, Sub};

use fearless_simd::{Simd, SimdFloat, SimdFloatElement, f32x4, f64x4};
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
pub trait Scalar: SimdFloatElement + RealField + FromPrimitive + ToPrimitive + Copy {
    /// Four numbers in one register. Products and sums are rounded one by one, so that results do not
    /// depend on the instruction set.
    type Four<S: Simd>: SimdFloat<S, Element = Self, Array = [Self; 4]>
        + Add<Output = Self::Four<S>>
        + Sub<Output = Self::Four<S>>
        + Mul<Output = Self::Four<S>>;

    /// Converts a literal, rounding to the nearest value of this type.
    fn lit(x: f64) -> Self;

    /// Converts to `f64` for reports; exact for both `f32` and `f64`.
    fn as_f64(self) -> f64;

    /// Drops the fraction; NaN gives zero and values out of range saturate.
    fn truncate(self) -> i32;

    /// Converts an index, exact below 2²⁴; signed 32-bit integers convert in one instruction.
    fn from_index(index: usize) -> Self;
}

impl Scalar for f32 {
    type Four<S: Simd> = f32x4<S>;

    #[inline(always)]
    fn lit(x: f64) -> Self {
        x as f32
    }

    #[inline(always)]
    fn as_f64(self) -> f64 {
        f64::from(self)
    }

    #[inline(always)]
    fn truncate(self) -> i32 {
        self as i32
    }

    #[inline(always)]
    fn from_index(index: usize) -> Self {
        index as i32 as f32
    }
}

impl Scalar for f64 {
    type Four<S: Simd> = f64x4<S>;

    #[inline(always)]
    fn lit(x: f64) -> Self {
        x
    }

    #[inline(always)]
    fn as_f64(self) -> f64 {
        self
    }

    #[inline(always)]
    fn truncate(self) -> i32 {
        self as i32
    }

    #[inline(always)]
    fn from_index(index: usize) -> Self {
        f64::from(index as i32)
    }
}
