//! Plain kernels: each scheme written out by hand for one dimension, as fast as readable safe Rust
//! gets it. The generic solver is measured against them.
//!
//! They know slip walls, a full box and nothing else.

pub mod apic_quadratic;
pub mod mpm_linear;
pub mod points;
pub mod row;
pub mod scene;
pub mod tpm_linear;

use std::ops::{Add, AddAssign, Mul, Range};

use fearless_simd::{Simd, SimdFloat, SimdFloatElement, f32x4, f64x4};
use num_traits::Float;

pub use points::{Points, PointsMut, State};

/// `f32` or `f64`.
pub trait Real: Float + SimdFloatElement + AddAssign + Default + Send + Sync + 'static {
    /// Four numbers in one register; products and sums are rounded one by one, so that the results do
    /// not depend on the instruction set.
    type Four<S: Simd>: SimdFloat<S, Element = Self, Array = [Self; 4]>
        + Add<Output = Self::Four<S>>
        + Mul<Output = Self::Four<S>>;
    /// Rounds a literal.
    fn lit(x: f64) -> Self;
    /// Converts an index.
    fn index(i: usize) -> Self;
    /// Whole part of a number that is not negative.
    fn whole(self) -> usize;
    /// Exact widening.
    fn wide(self) -> f64;
}

macro_rules! real {
    ($($t:ty, $four:ident);*) => {$(
        impl Real for $t {
            type Four<S: Simd> = $four<S>;
            #[inline(always)]
            fn lit(x: f64) -> Self {
                x as Self
            }
            #[inline(always)]
            fn index(i: usize) -> Self {
                i as i32 as Self
            }
            #[inline(always)]
            fn whole(self) -> usize {
                self as i32 as usize
            }
            #[inline(always)]
            fn wide(self) -> f64 {
                f64::from(self)
            }
        }
    )*};
}
real!(f32, f32x4; f64, f64x4);

/// A plain kernel, whatever its scheme and precision.
pub trait Plain<const D: usize> {
    /// Advances by `dt` seconds.
    fn step(&mut self, dt: f64);
    /// The points in order of their identifiers.
    fn points(&self) -> State<D>;
    /// How often the points have been sorted.
    fn n_sorts(&self) -> u64;
}

/// Number of cell layers of a slab, the unit of work of a thread.
pub const SLAB: usize = 4;

/// Calls `work(first layer, layers, nodes)` for each slab of `n_layers` layers of cells: first all even
/// slabs, then all odd ones, so that slabs at work at the same time touch no common node. `nodes` starts
/// at the slab's first layer of nodes. The order of summation does not depend on the threads.
pub fn two_colours<N: Send>(
    nodes: &mut [N],
    layer: usize,
    n_layers: usize,
    parallel: bool,
    work: &(impl Fn(Range<usize>, &mut [N]) + Sync),
) {
    for colour in 0..2 {
        let first = (colour * SLAB * layer).min(nodes.len());
        let chunk = 2 * SLAB * layer;
        let run = |(k, nodes): (usize, &mut [N])| {
            let start = (2 * k + colour) * SLAB;
            if start < n_layers {
                work(start..(start + SLAB).min(n_layers), nodes);
            }
        };
        if parallel {
            use rayon::prelude::*;
            nodes[first..].par_chunks_mut(chunk).enumerate().for_each(run);
        } else {
            nodes[first..].chunks_mut(chunk).enumerate().for_each(run);
        }
    }
}

