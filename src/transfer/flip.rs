//! PIC, FLIP and their blends.

use super::Transfer;
use crate::Scalar;
use crate::variants::Blend;

/// Point velocity interpolated from the nodes in every step, \[Harlow1964\]; dissipative.
#[derive(Clone, Copy, Debug, Default, PartialEq, Eq)]
pub struct Pic;

/// Point velocity advanced by the nodes' change, blended with PIC,
/// \[Brackbill1986\], \[Stomakhin2013\].
///
/// ```text
/// v_p ← α (v_p + Σ N Δt a) + (1 − α) Σ N v⁺
/// ```
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Flip {
    /// How α is found.
    pub blend: Blend,
}

impl<T: Scalar, const D: usize> Transfer<T, D> for Pic {
    type Affine = ();
    const USES_INCREMENT: bool = false;
    const AFFINE: bool = false;

    #[inline(always)]
    fn flip_share(&self, _dt: T) -> T {
        T::zero()
    }

    #[inline(always)]
    fn affine_entry(_affine: &(), _row: usize, _axis: usize) -> T {
        T::zero()
    }

    fn affine_of(_gradient: [[T; D]; D]) {}

    #[inline(always)]
    fn affine_from(_columns: &[[T; 4]; D], _second_moment: &[T; 4]) {}
}

impl<T: Scalar, const D: usize> Transfer<T, D> for Flip {
    type Affine = ();
    const USES_INCREMENT: bool = true;
    const AFFINE: bool = false;

    #[inline(always)]
    fn flip_share(&self, dt: T) -> T {
        match self.blend {
            Blend::PerStep(share) => T::lit(share),
            Blend::RelaxationTime(tau) => (T::one() - dt / T::lit(tau)).max(T::zero()),
        }
    }

    #[inline(always)]
    fn affine_entry(_affine: &(), _row: usize, _axis: usize) -> T {
        T::zero()
    }

    fn affine_of(_gradient: [[T; D]; D]) {}

    #[inline(always)]
    fn affine_from(_columns: &[[T; 4]; D], _second_moment: &[T; 4]) {}
}
