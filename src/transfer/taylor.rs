//! Taylor particle-in-cell.

use super::Transfer;
use crate::Scalar;
use crate::math::Tensor;

/// Taylor transfer, \[Nakamura2023\]: points carry the gradient of the nodes' velocity.
///
/// ```text
/// C_p = Σ v⁺ ∇Nᵀ
/// ```
///
/// Linear momentum is kept; angular momentum only as far as ∇N and N (x − x_p)/D agree, see
/// [`Apic`](super::Apic).
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Tpic;

impl<T: Scalar, const D: usize> Transfer<T, D> for Tpic {
    type Affine = Tensor<T, D>;
    const USES_INCREMENT: bool = false;
    const AFFINE: bool = true;
    const BY_GRADIENT: bool = true;

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
    fn affine_from(columns: &[[T; 4]; D], _second_moment: &[T; 4]) -> Tensor<T, D> {
        let mut affine = Tensor::default();
        for axis in 0..D {
            for row in 0..D {
                affine.0[row][axis] = columns[axis][row];
            }
        }
        affine
    }
}
