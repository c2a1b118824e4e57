//! Run-time choice of the instruction set for the hot kernels.
//!
//! Kernels take a token of the instruction set as an argument and are compiled for the baseline, for AVX2
//! and for AVX-512, whose 32 registers hold the nodes of a cell in 2D; vectors have four numbers on all of
//! them. No fused multiply-add is used: every level rounds the same way.

pub use fearless_simd::prelude::*;
pub use fearless_simd::{Level, Simd};

use std::sync::atomic::{AtomicBool, Ordering};

static BASELINE_ONLY: AtomicBool = AtomicBool::new(false);

/// Keeps the kernels of this process to the instruction set that every processor of its kind has.
///
/// Results stay the same bits. For tests of that, and for tools that count or check instructions and
/// do not know all of the newer ones.
pub fn limit_to_baseline(limited: bool) {
    BASELINE_ONLY.store(limited, Ordering::Relaxed);
}

/// The instruction set that the kernels use.
pub fn level() -> Level {
    if BASELINE_ONLY.load(Ordering::Relaxed) { Level::baseline() } else { Level::new() }
}

/// As much as the widest vector wants to be aligned.
#[repr(align(64))]
struct Aligned(#[expect(dead_code, reason = "it is there for its place")] u8);

/// Makes the function that this is inlined into align its stack for vectors.
///
/// Otherwise it depends on the caller's stack whether a vector that is put aside there straddles two cache
/// lines or two pages; the latter, in a loop over points, was seen to make a step take half as long again.
#[inline(always)]
pub fn align_stack() {
    let aligned = Aligned(0);
    std::hint::black_box(&aligned);
}

/// Whether there is more than one dimension, as a constant on its own.
pub struct InSpace<const D: usize>;

impl<const D: usize> InSpace<D> {
    /// Whether there is.
    pub const HOLDS: bool = D > 1;
}

/// Evaluates an expression with `$simd` bound to the best token of this machine. In one dimension, where there is
/// little to gain, only the baseline is compiled.
macro_rules! vectorized {
    ($dimension:expr, $simd:ident => $operation:expr) => {'dispatch: {
        let level = $crate::simd::level();
        #[cfg(target_arch = "x86_64")]
        {
            use $crate::simd::Simd as _;
            // Two plain conditions, so that the compiler drops the branch before it compiles what is in it.
            if $crate::simd::InSpace::<{ $dimension }>::HOLDS {
                if let Some($simd) = level.as_avx512() {
                    break 'dispatch $simd.vectorize(
                        #[inline(always)]
                        || {
                            $crate::simd::align_stack();
                            $operation
                        },
                    );
                }
                if let Some($simd) = level.as_avx2() {
                    break 'dispatch $simd.vectorize(
                        #[inline(always)]
                        || {
                            $crate::simd::align_stack();
                            $operation
                        },
                    );
                }
            }
            let Some($simd) = level.as_sse2() else {
                unreachable!("every x86-64 processor has SSE2")
            };
            $operation
        }
        #[cfg(not(target_arch = "x86_64"))]
        {
            fearless_simd::dispatch!(level, $simd => $operation)
        }
    }};
}
pub(crate) use vectorized;

use crate::Scalar;

/// Four numbers from memory.
#[inline(always)]
pub fn load<T: Scalar, S: Simd>(simd: S, row: &[T; 4]) -> T::Four<S> {
    T::Four::<S>::load_array_ref(simd, row)
}

/// One number four times.
#[inline(always)]
pub fn splat<T: Scalar, S: Simd>(simd: S, value: T) -> T::Four<S> {
    T::Four::<S>::splat(simd, value)
}

/// One number per axis; the rest are zero.
///
/// Vectors are made from functions of the axis: an array of a few numbers that a function takes or returns by
/// value goes through integer registers, even where the function is inlined.
#[inline(always)]
pub fn lanes<T: Scalar, S: Simd, const D: usize>(
    simd: S,
    value: impl Fn(usize) -> T,
) -> T::Four<S> {
    let mut row = [T::zero(); 4];
    for axis in 0..D {
        row[axis] = value(axis);
    }
    load(simd, &row)
}
