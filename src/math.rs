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

/// Most components that a field may have: those of three scalars and of a second-order tensor in 3D.
pub const MAX_COMPONENTS: usize = 12;

/// A quantity that can be averaged: scalars, vectors, tensors, and `()` for what a scene lacks.
pub trait Field<T>: Copy + Default + std::fmt::Debug + Send + Sync + 'static {
    /// Number of components, at most [`MAX_COMPONENTS`] where fields are reconstructed.
    const COMPONENTS: usize;

    /// Adds `weight · other`.
    fn add_scaled(&mut self, weight: T, other: Self);

    /// Writes the components, one after another, to as many entries.
    fn write(&self, components: &mut [T]);

    /// The field with these components.
    fn read(components: &[T]) -> Self;
}

impl<T> Field<T> for () {
    const COMPONENTS: usize = 0;

    #[inline(always)]
    fn add_scaled(&mut self, _weight: T, _other: Self) {}

    #[inline(always)]
    fn write(&self, _components: &mut [T]) {}

    #[inline(always)]
    fn read(_components: &[T]) {}
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
    const COMPONENTS: usize = 1;

    #[inline(always)]
    fn add_scaled(&mut self, weight: T, other: Self) {
        self.0 += weight * other.0;
    }

    #[inline(always)]
    fn write(&self, components: &mut [T]) {
        components[0] = self.0;
    }

    #[inline(always)]
    fn read(components: &[T]) -> Self {
        Self(components[0])
    }
}

/// A vector.
#[derive(Clone, Copy, Debug, PartialEq)]
pub struct Vector<T, const D: usize>(pub [T; D]);

impl<T: Scalar, const D: usize> Default for Vector<T, D> {
    fn default() -> Self {
        Self([T::zero(); D])
    }
}

impl<T: Scalar, const D: usize> Field<T> for Vector<T, D> {
    const COMPONENTS: usize = D;

    #[inline(always)]
    fn add_scaled(&mut self, weight: T, other: Self) {
        for axis in 0..D {
            self.0[axis] += weight * other.0[axis];
        }
    }

    #[inline(always)]
    fn write(&self, components: &mut [T]) {
        components.copy_from_slice(&self.0);
    }

    #[inline(always)]
    fn read(components: &[T]) -> Self {
        Self(std::array::from_fn(|axis| components[axis]))
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
    const COMPONENTS: usize = D * D;

    #[inline(always)]
    fn add_scaled(&mut self, weight: T, other: Self) {
        for i in 0..D {
            for j in 0..D {
                self.0[i][j] += weight * other.0[i][j];
            }
        }
    }

    #[inline(always)]
    fn write(&self, components: &mut [T]) {
        components.copy_from_slice(self.0.as_flattened());
    }

    #[inline(always)]
    fn read(components: &[T]) -> Self {
        Self(std::array::from_fn(|i| std::array::from_fn(|j| components[D * i + j])))
    }
}

impl<T: Scalar, A: Field<T>, B: Field<T>> Field<T> for (A, B) {
    const COMPONENTS: usize = A::COMPONENTS + B::COMPONENTS;

    #[inline(always)]
    fn add_scaled(&mut self, weight: T, other: Self) {
        self.0.add_scaled(weight, other.0);
        self.1.add_scaled(weight, other.1);
    }

    #[inline(always)]
    fn write(&self, components: &mut [T]) {
        let (first, second) = components.split_at_mut(A::COMPONENTS);
        self.0.write(first);
        self.1.write(second);
    }

    #[inline(always)]
    fn read(components: &[T]) -> Self {
        let (first, second) = components.split_at(A::COMPONENTS);
        (A::read(first), B::read(second))
    }
}

/// `row += weight · other`, the inner operation of every transfer.
#[inline(always)]
pub fn add_row<T: Scalar>(row: &mut [T; 4], weight: T, other: [T; 4]) {
    for k in 0..4 {
        row[k] += weight * other[k];
    }
}
