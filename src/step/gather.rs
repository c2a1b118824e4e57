//! The gather kernel: the nodes of a cell onto one point.

use std::marker::PhantomData;

use super::stencil_nodes::StencilNodes;
use crate::Scalar;
use crate::shape::{MAX_WIDTH, ShapeFunction};
use crate::simd::{Simd, SimdBase as _, load, splat};
use crate::stencil::{Rows, for_each_outer_row};

/// What a point gathers from its nodes; `moment[a]` is Σ N v (x − x_p)_a.
pub(super) struct Gathered<T, const D: usize> {
    pub velocity: [T; 4],
    pub increment: [T; 4],
    pub moment: [[T; 4]; D],
    pub divergence: T,
}

/// The functions of a point, their first moments, and the first node of each stencil row.
pub(super) struct Site<'a, T, const D: usize, H> {
    pub rows: &'a Rows<T, D>,
    pub moments: &'a [[T; MAX_WIDTH]; D],
    pub starts: &'a [u32],
    pub shape: PhantomData<H>,
}

/// Which sums are formed besides velocity and divergence; known at compile time where it matters.
#[derive(Clone, Copy)]
pub(super) struct Want {
    pub moments: bool,
    pub increment: bool,
}

/// Partial sums over the axes contracted so far; `slope` is their part of the divergence.
#[derive(Clone, Copy)]
struct Sums<T, F, const D: usize> {
    velocity: F,
    increment: F,
    moment: [F; D],
    slope: T,
}

impl<T: Scalar, const D: usize, H: ShapeFunction<T>> Site<'_, T, D, H> {
    /// Sums of v⁺ and, if asked for, of first moments and of Δt a.
    ///
    /// Node rows repeat the last velocity component in their last entry: weighted with N′ it becomes
    /// the derivative along the last axis at no cost.
    #[inline(always)]
    pub fn gather<S: Simd>(
        &self,
        simd: S,
        want: Want,
        velocity: &StencilNodes<T, S>,
        increment: &StencilNodes<T, S>,
    ) -> Gathered<T, D> {
        let lines = Lines { site: self, velocity, increment };
        let rows = self.rows;
        let total = match D {
            1 => lines.sum(simd, want, 0),
            2 => {
                let first = rows[0].first;
                let mut total = self.scaled(simd, want, &lines.sum(simd, want, first), 0, 0);
                for i in 1..H::WIDTH {
                    let line = lines.sum(simd, want, first + i);
                    self.accumulate(simd, want, &mut total, &line, 0, i);
                }
                total
            }
            _ => {
                let first = rows[0].first * H::REACH + rows[1].first;
                let plane = lines.plane(simd, want, first);
                let mut total = self.scaled(simd, want, &plane, 0, 0);
                for i in 1..H::WIDTH {
                    let plane = lines.plane(simd, want, first + i * H::REACH);
                    self.accumulate(simd, want, &mut total, &plane, 0, i);
                }
                total
            }
        };
        let velocity = total.velocity.to_array();
        let mut moment = [[T::zero(); 4]; D];
        if want.moments {
            for axis in 0..D {
                moment[axis] = total.moment[axis].to_array();
            }
        }
        let divergence = total.slope + velocity[3];
        Gathered { velocity, increment: total.increment.to_array(), moment, divergence }
    }

    /// The sums of the axes after `axis`, at index `k` of that axis.
    #[inline(always)]
    fn scaled<S: Simd>(
        &self,
        simd: S,
        want: Want,
        part: &Sums<T, T::Four<S>, D>,
        axis: usize,
        k: usize,
    ) -> Sums<T, T::Four<S>, D> {
        let row = &self.rows[axis];
        let weight = splat(simd, row.weight[k]);
        let mut slope = row.gradient[k] * part.velocity.as_array()[axis];
        // A line, the last axis, has no slope but that in its last entry.
        if axis + 2 < D {
            slope += row.weight[k] * part.slope;
        }
        let mut sums = Sums { velocity: part.velocity * weight, slope, ..*part };
        if want.increment {
            sums.increment = part.increment * weight;
        }
        if want.moments {
            sums.moment[axis] = part.velocity * splat(simd, self.moments[axis][k]);
            for later in axis + 1..D {
                sums.moment[later] = part.moment[later] * weight;
            }
        }
        sums
    }

    /// Adds the sums of the axes after `axis`, at index `k` of that axis.
    #[inline(always)]
    fn accumulate<S: Simd>(
        &self,
        simd: S,
        want: Want,
        total: &mut Sums<T, T::Four<S>, D>,
        part: &Sums<T, T::Four<S>, D>,
        axis: usize,
        k: usize,
    ) {
        let part = self.scaled(simd, want, part, axis, k);
        total.velocity += part.velocity;
        total.slope += part.slope;
        if want.increment {
            total.increment += part.increment;
        }
        if want.moments {
            for later in axis..D {
                total.moment[later] += part.moment[later];
            }
        }
    }

    /// `[i][j] = ∂v_i/∂x_j`, 1/s.
    #[inline(always)]
    pub fn velocity_gradient<S: Simd>(&self, simd: S, nodes: &[[T; 4]]) -> [[T; D]; D] {
        let (rows, inner) = (self.rows, D - 1);
        let zero = splat(simd, T::zero());
        let mut columns = [zero; D];
        for_each_outer_row::<T, D, H>(
            rows,
            #[inline(always)]
            |outer| {
                let start = self.starts[outer.row] as usize + rows[inner].first;
                let (mut value, mut slope) = (zero, zero);
                for (k, node) in nodes[start..start + H::WIDTH].iter().enumerate() {
                    let node = load(simd, node);
                    value += node * splat(simd, rows[inner].weight[k]);
                    slope += node * splat(simd, rows[inner].gradient[k]);
                }
                for axis in 0..inner {
                    let gradient = outer.replace(rows, axis, &rows[axis].gradient);
                    columns[axis] += value * splat(simd, gradient);
                }
                columns[inner] += slope * splat(simd, outer.weight);
            },
        );
        let mut gradient = [[T::zero(); D]; D];
        for (axis, column) in columns.iter().enumerate() {
            let column = column.to_array();
            for row in 0..D {
                gradient[row][axis] = column[row];
            }
        }
        gradient
    }
}

/// The last axis: stencil rows of nodes.
struct Lines<'a, T: Scalar, S: Simd, const D: usize, H> {
    site: &'a Site<'a, T, D, H>,
    velocity: &'a StencilNodes<T, S>,
    increment: &'a StencilNodes<T, S>,
}

impl<T: Scalar, S: Simd, const D: usize, H: ShapeFunction<T>> Lines<'_, T, S, D, H> {
    #[inline(always)]
    fn sum(&self, simd: S, want: Want, row: usize) -> Sums<T, T::Four<S>, D> {
        let last = &self.site.rows[D - 1];
        let first = last.first;
        let nodes = &self.velocity.0[row];
        let zero = splat(simd, T::zero());
        let mut moment = [zero; D];
        let mut velocity = nodes[first] * self.weight(simd, 0);
        for k in 1..H::WIDTH {
            velocity += nodes[first + k] * self.weight(simd, k);
        }
        if want.moments {
            moment[D - 1] = nodes[first] * self.moment(simd, 0);
            for k in 1..H::WIDTH {
                moment[D - 1] += nodes[first + k] * self.moment(simd, k);
            }
        }
        let mut increment = zero;
        if want.increment {
            let nodes = &self.increment.0[row];
            increment = nodes[first] * splat(simd, last.weight[0]);
            for k in 1..H::WIDTH {
                increment += nodes[first + k] * splat(simd, last.weight[k]);
            }
        }
        Sums { velocity, increment, moment, slope: T::zero() }
    }

    /// First moment of function `k` of the last axis.
    #[inline(always)]
    fn moment(&self, simd: S, k: usize) -> T::Four<S> {
        splat(simd, self.site.moments[D - 1][k])
    }

    /// (N, N, N, N′) of function `k` of the last axis.
    #[inline(always)]
    fn weight(&self, simd: S, k: usize) -> T::Four<S> {
        let last = &self.site.rows[D - 1];
        let (n, slope) = (last.weight[k], last.gradient[k]);
        load(simd, &[n, n, n, slope])
    }

    /// The last two axes of three, from stencil row `first` on.
    #[inline(always)]
    fn plane(&self, simd: S, want: Want, first: usize) -> Sums<T, T::Four<S>, D> {
        let line = self.sum(simd, want, first);
        let mut plane = self.site.scaled(simd, want, &line, 1, 0);
        for j in 1..H::WIDTH {
            let line = self.sum(simd, want, first + j);
            self.site.accumulate(simd, want, &mut plane, &line, 1, j);
        }
        plane
    }
}
