//! Arithmetic on small arrays, and the additive fields that reconstruction and scattering share.

use crate::Scalar;

/// Σ aᵢ bᵢ.
#[inline(always)]
pub fn dot<T: Scalar, const N: usize>(a: [T; N], b: [T; N]) -> T {
    let mut sum = T::zero();
    for k in 0..N {
        sum += a[k] * b[k];
    }
    sum
}

/// A vector of the dimension in the first entries of a node row; the rest are zero.
#[inline(always)]
pub fn widen<T: Scalar, const D: usize>(vector: [T; D]) -> [T; 4] {
    let mut row = [T::zero(); 4];
    row[..D].copy_from_slice(&vector);
    row
}

/// The first entries of a node row.
#[inline(always)]
pub fn narrow<T: Scalar, const D: usize>(row: [T; 4]) -> [T; D] {
    let mut vector = [T::zero(); D];
    vector.copy_from_slice(&row[..D]);
    vector
}

/// A quantity that can be averaged: scalars, vectors, tensors, and `()` for what a scene lacks.
pub trait Field<T>: Copy + Default + std::fmt::Debug + Send + Sync + 'static {
    /// Adds `weight · other`.
    fn add_scaled(&mut self, weight: T, other: Self);
}

impl<T> Field<T> for () {
    #[inline(always)]
    fn add_scaled(&mut self, _weight: T, _other: Self) {}
}

/// A scalar field value.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Value<T>(pub T);

impl<T: Scalar> Default for Value<T> {
    fn default() -> Self {
        Self(T::zero())
    }
}

impl<T: Scalar> Field<T> for Value<T> {
    #[inline(always)]
    fn add_scaled(&mut self, weight: T, other: Self) {
        self.0 += weight * other.0;
    }
}

/// A node row: a vector in the first entries, a scalar in the last.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Row4<T>(pub [T; 4]);

impl<T: Scalar> Default for Row4<T> {
    fn default() -> Self {
        Self([T::zero(); 4])
    }
}

impl<T: Scalar> Field<T> for Row4<T> {
    #[inline(always)]
    fn add_scaled(&mut self, weight: T, other: Self) {
        add_row(&mut self.0, weight, other.0);
    }
}

/// A second-order tensor, `[row][column]`.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Tensor<T, const D: usize>(pub [[T; D]; D]);

impl<T: Scalar, const D: usize> Default for Tensor<T, D> {
    fn default() -> Self {
        Self([[T::zero(); D]; D])
    }
}

impl<T: Scalar, const D: usize> Field<T> for Tensor<T, D> {
    #[inline(always)]
    fn add_scaled(&mut self, weight: T, other: Self) {
        for i in 0..D {
            for j in 0..D {
                self.0[i][j] += weight * other.0[i][j];
            }
        }
    }
}

impl<T: Scalar, A: Field<T>, B: Field<T>> Field<T> for (A, B) {
    #[inline(always)]
    fn add_scaled(&mut self, weight: T, other: Self) {
        self.0.add_scaled(weight, other.0);
        self.1.add_scaled(weight, other.1);
    }
}

/// `row += weight · other`, the inner operation of every transfer.
#[inline(always)]
pub fn add_row<T: Scalar>(row: &mut [T; 4], weight: T, other: [T; 4]) {
    for k in 0..4 {
        row[k] += weight * other[k];
    }
}
