//! Affine particle-in-cell.

use super::Transfer;
use crate::Scalar;
use crate::math::Tensor;

/// Affine transfer, \[Jiang2015\], \[Jiang2017\]: conserves linear and angular momentum.
///
/// ```text
/// C_p = B_p D_p⁻¹,   B_p = Σ N v⁺ (x − x_p)ᵀ,   D_p = Σ N (x − x_p)(x − x_p)ᵀ
/// ```
///
/// D_p is diagonal for tensor-product functions; it is taken from the functions at hand, so that it
/// is right next to walls too. A point exactly on a node of the linear hat has D_p = 0 along that axis:
/// C is zero there.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Apic;

impl<T: Scalar, const D: usize> Transfer<T, D> for Apic {
    type Affine = Tensor<T, D>;
    const USES_INCREMENT: bool = false;
    const AFFINE: bool = true;

    #[inline(always)]
    fn flip_share(&self, _dt: T) -> T {
        T::zero()
    }

    #[inline(always)]
    fn affine_entry(affine: &Tensor<T, D>, row: usize, axis: usize) -> T {
        affine.0[row][axis]
    }

    fn affine_of(gradient: [[T; D]; D]) -> Tensor<T, D> {
        Tensor(gradient)
    }

    #[inline(always)]
    fn affine_from(columns: &[[T; 4]; D], second_moment: &[T; 4]) -> Tensor<T, D> {
        let mut affine = Tensor::default();
        for axis in 0..D {
            if second_moment[axis] > T::zero() {
                let inverse = T::one() / second_moment[axis];
                for row in 0..D {
                    affine.0[row][axis] = columns[axis][row] * inverse;
                }
            }
        }
        affine
    }
}
