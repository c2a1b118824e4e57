//! Stepper kernels: each scheme written out by hand for one dimension, as fast as readable safe Rust
//! gets it. The generic solver is measured against them.
//!
//! They know slip walls, a full box and nothing else.

/// Declares a scheme whose points scatter to nodes and gather from them; its file supplies
/// `scatter_layers`, `update_grid` and `gather_layers`.
macro_rules! scheme {
    ($name:ident, $d:literal, $node:ty, $extra:literal, $affine:literal, $doc:literal) => {
        #[doc = $doc]
        pub struct $name<T> {
            pub(super) points: $crate::plain::Points<T, $d>,
            pub(super) nodes: Vec<$node>,
            level: fearless_simd::Level,
        }

        impl<T: $crate::plain::Real> $name<T> {
            /// Starts from a scene.
            pub fn new(scene: &transpoint::Scene<$d>) -> Self {
                Self::at_level(scene, fearless_simd::Level::new())
            }

            /// Starts from a scene, to be run with a given instruction set.
            pub fn at_level(scene: &transpoint::Scene<$d>, level: fearless_simd::Level) -> Self {
                let n_nodes = scene.grid.cells.iter().map(|n| n + $extra).product();
                Self {
                    points: $crate::plain::Points::new(scene, $affine),
                    nodes: vec![<$node>::default(); n_nodes],
                    level,
                }
            }

            /// Sums over the points at the nodes.
            pub fn particles_to_grid(&mut self, dt: T) {
                let (points, level) = (&self.points, self.level);
                let layer = points.cells[1..].iter().map(|n| n + $extra).product();
                self.nodes.fill(<$node>::default());
                $crate::plain::two_colours(&mut self.nodes, layer, points.cells[0], &|layers, nodes| {
                    fearless_simd::dispatch!(level, simd => {
                        Self::scatter_layers(simd, points, layers, dt, nodes)
                    });
                });
            }

            /// Moves the points; true if any has left its cell.
            pub fn grid_to_particles(&mut self, dt: T) -> bool {
                let (level, nodes) = (self.level, &self.nodes);
                self.points.slabs(&|layers, points| {
                    fearless_simd::dispatch!(level, simd => {
                        Self::gather_layers(simd, points, layers, dt, nodes)
                    })
                })
            }

            /// The nodes.
            pub fn nodes(&self) -> &[$node] {
                &self.nodes
            }

            /// Replaces the nodes.
            pub fn set_nodes(&mut self, nodes: Vec<$node>) {
                self.nodes = nodes;
            }

            /// Sorts the points again.
            pub fn sort(&mut self) {
                self.points.sort();
            }
        }

        impl<T: $crate::plain::Real> $crate::plain::Stepper<$d> for $name<T> {
            fn step(&mut self, dt: f64) {
                let dt = T::lit(dt);
                self.particles_to_grid(dt);
                self.update_grid(dt);
                if self.grid_to_particles(dt) {
                    self.points.sort();
                }
            }

            fn points(&self) -> $crate::plain::State<$d> {
                self.points.state()
            }

            fn bytes_per_point(&self) -> usize {
                self.points.bytes_per_point()
            }

            fn n_sorts(&self) -> u64 {
                self.points.n_sorts
            }
        }
    };
}
pub mod apic_quadratic_2d;
pub mod apic_quadratic_3d;
pub mod mpm_linear_2d;
pub mod mpm_linear_3d;
pub mod points;
pub mod row;
pub mod scene;
pub mod tpm_linear;

use std::ops::{Add, AddAssign, DivAssign, Mul, MulAssign, Range};

use fearless_simd::{Simd, SimdFloat, SimdFloatElement, f32x4, f64x4};
use num_traits::Float;

pub use points::{Points, PointsMut, State};

/// `f32` or `f64`.
pub trait Real:
    Float + SimdFloatElement + AddAssign + DivAssign + Default + Send + Sync + 'static
{
    /// Four numbers in one register; products and sums are rounded one by one, so that the results do
    /// not depend on the instruction set.
    type Four<S: Simd>: SimdFloat<S, Element = Self, Array = [Self; 4]>
        + Add<Output = Self::Four<S>>
        + AddAssign
        + Mul<Output = Self::Four<S>>
        + MulAssign;
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
        #[allow(
            clippy::cast_lossless,
            clippy::cast_possible_wrap,
            reason = "signed 32-bit integers convert in one instruction"
        )]
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

/// A scheme that can be stepped, plain or generic, whatever its precision.
pub trait Stepper<const D: usize> {
    /// Advances by `dt` seconds.
    fn step(&mut self, dt: f64);
    /// The points in order of their identifiers.
    fn points(&self) -> State<D>;
    /// Bytes that each point carries.
    fn bytes_per_point(&self) -> usize;
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
        if rayon::current_num_threads() > 1 {
            use rayon::prelude::*;
            nodes[first..].par_chunks_mut(chunk).enumerate().for_each(run);
        } else {
            nodes[first..].chunks_mut(chunk).enumerate().for_each(run);
        }
    }
}
