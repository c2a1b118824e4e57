//! The node rows of one cell, loaded once for all of its points.

use crate::Scalar;
use crate::shape::{MAX_WIDTH, ShapeFunction};
use crate::simd::{Simd, SimdBase as _, load, splat};

/// Most stencil rows of a cell, those of the cubic B-spline in 3D.
const MAX_ROWS: usize = MAX_WIDTH * MAX_WIDTH;

/// Stencil row → node → node row. Where the indices are known when a kernel is compiled, small blocks live in
/// registers, and none needs a check of its bounds.
pub(super) struct StencilNodes<T: Scalar, S: Simd>(pub [[T::Four<S>; MAX_WIDTH]; MAX_ROWS]);

impl<T: Scalar, S: Simd> StencilNodes<T, S> {
    /// A block of zeros.
    #[inline(always)]
    pub fn zero(simd: S) -> Self {
        Self([[splat(simd, T::zero()); MAX_WIDTH]; MAX_ROWS])
    }

    /// The nodes that follow upon `starts`, the first node of each stencil row, in an array that begins at
    /// node `begin`.
    #[inline(always)]
    pub fn load<H: ShapeFunction<T>, const D: usize>(
        simd: S,
        nodes: &[[T; 4]],
        starts: &[u32],
        begin: usize,
    ) -> Self {
        let mut block = Self::zero(simd);
        for row in 0..H::REACH.pow(D as u32 - 1) {
            let start = starts[row] as usize - begin;
            let nodes = &nodes[start..start + H::REACH];
            for k in 0..H::REACH {
                block.0[row][k] = load(simd, &nodes[k]);
            }
        }
        block
    }

    /// Writes the nodes back.
    #[inline(always)]
    pub fn store<H: ShapeFunction<T>, const D: usize>(
        &self,
        nodes: &mut [[T; 4]],
        starts: &[u32],
        begin: usize,
    ) {
        for row in 0..H::REACH.pow(D as u32 - 1) {
            let start = starts[row] as usize - begin;
            let nodes = &mut nodes[start..start + H::REACH];
            for k in 0..H::REACH {
                self.0[row][k].store_array(&mut nodes[k]);
            }
        }
    }
}
